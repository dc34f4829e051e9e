//! Finds needles: triangles so thin that rounding of their coordinates decides their normal.

use rayon::prelude::*;

/// Triangles without area (normal zero), or lower than `least` of them, with the number of their longest side.
pub fn needles(
    points: &[[f64; 3]],
    triangles: &[[i32; 3]],
    normals: &[[f64; 3]],
    least: &(dyn Fn(usize) -> f64 + Sync),
) -> (Vec<i64>, Vec<i64>) {
    (0..triangles.len())
        .into_par_iter()
        .with_min_len(1 << 10)
        .filter_map(|t| {
            let flat = normals[t] == [0.0; 3];
            let least = least(t);
            if !flat && least <= 0.0 {
                return None;
            }
            let corner = triangles[t].map(|v| &points[v as usize]);
            let sides = [0, 1, 2].map(|k| [0, 1, 2].map(|c| corner[(k + 1) % 3][c] - corner[k][c]));
            let squares = sides.map(|s| s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
            let [u, v, _] = sides;
            let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let longest = (1..3).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
            let height = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt() / squares[longest].sqrt();
            (flat || height < least).then_some((t as i64, longest as i64))
        })
        .unzip()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_ones_and_those_without_area() {
        let points = [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 0.1, 0.0], [2.0, 3.0, 0.0], [6.0, 0.0, 0.0]];
        let triangles = [[0, 1, 3], [2, 0, 1], [0, 1, 4]];
        let normals = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]];
        assert_eq!(needles(&points, &triangles, &normals, &|_| 0.2), (vec![1, 2], vec![1, 2]));
        assert_eq!(needles(&points, &triangles, &normals, &|_| 0.0), (vec![2], vec![2]));
    }
}
