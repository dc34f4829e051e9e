//! Counts how often a ray from the middle of a closed group passes through its surface.

use rayon::prelude::*;

/// A direction along no axis and in no plane that models favour. A ray that meets an edge by chance costs a search, no
/// more.
const RAY: [f64; 3] = [0.3574, 0.4915, 0.7942];

type Vec3 = [f64; 3];

/// Number of passes for each group in `asked`. Sums run in the order of the triangles, whatever the number of threads.
pub fn passes(points: &[Vec3], triangles: &[[i32; 3]], group: &[i32], asked: &[bool]) -> Vec<i32> {
    let mut middle = vec![[0.0; 3]; asked.len()];
    let mut count = vec![0.0; asked.len()];
    for (t, &g) in triangles.iter().zip(group).filter(|(_, g)| asked[**g as usize]) {
        let [p, q, r] = t.map(|v| &points[v as usize]);
        let sum = &mut middle[g as usize];
        for k in 0..3 {
            sum[k] += (p[k] + q[k] + r[k]) / 3.0;
        }
        count[g as usize] += 1.0;
    }
    for (sum, &count) in middle.iter_mut().zip(&count).filter(|(_, count)| **count > 0.0) {
        *sum = sum.map(|c| c / count);
    }
    // Seen from within, corners turn one way round the ray before it, and the other way behind.
    let hit = |t: &[i32; 3], g: i32| {
        let from = &middle[g as usize];
        let [p, q, r] = t.map(|v| [0, 1, 2].map(|k| points[v as usize][k] - from[k]));
        side(&p, &q) > 0.0 && side(&q, &r) > 0.0 && side(&r, &p) > 0.0
    };
    let hits: Vec<i32> = triangles
        .par_iter()
        .zip(group)
        .with_min_len(1 << 12)
        .filter(|(t, g)| asked[**g as usize] && hit(t, **g))
        .map(|(_, &g)| g)
        .collect();
    let mut out = vec![0; asked.len()];
    hits.into_iter().for_each(|g| out[g as usize] += 1);
    out
}

/// Side of the plane through the middle, a and b on which the ray runs.
fn side(a: &Vec3, b: &Vec3) -> f64 {
    let [x, y, z] = RAY;
    x * (a[1] * b[2] - a[2] * b[1]) + y * (a[2] * b[0] - a[0] * b[2]) + z * (a[0] * b[1] - a[1] * b[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn once_of_a_tetrahedron_twice_of_two_in_one_place_and_never_where_nobody_asks() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let one = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let all = [one, one, one].concat();
        let group = [[0; 4], [1; 4], [1; 4]].concat();
        assert_eq!(passes(&points, &all, &group, &[true, true, true]), [1, 2, 0]);
        assert_eq!(passes(&points, &all, &group, &[false, true, true]), [0, 2, 0]);
    }
}
