//! Directions and placements that were rounded, as OpenCASCADE rights them (gp_Dir, gp_Trsf::SetValues).

use super::locations::{Matrix, determinant};
use crate::geometry::vector::{Vector, dot, sub};
use hlr_exact::elementary::power;

/// The vector divided by its length; None where it has none.
pub fn unit<const N: usize>(mut vector: [f64; N]) -> Option<[f64; N]> {
    let size = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    vector.iter_mut().for_each(|c| *c /= size);
    (size > 0.0 && size.is_finite()).then_some(vector)
}

/// The placement with a rotation, times a scale that is negative for a mirror image. None where it has no volume.
pub fn square_placement(rows: &Matrix) -> Option<Matrix> {
    let volume = determinant(rows);
    let scale = volume.signum() * power(volume.abs(), 1.0 / 3.0);
    if scale == 0.0 || !scale.is_finite() {
        return None;
    }
    let per = 1.0 / scale;
    let unscaled = rows.map(|[a, b, c, _]| [a * per, b * per, c * per]);
    let columns = square(&transposed(&unscaled))?;
    let turn = square(&transposed(&columns))?;
    Some([0, 1, 2].map(|i| [turn[i][0] * scale, turn[i][1] * scale, turn[i][2] * scale, rows[i][3]]))
}

/// The rows made unit vectors, each at right angles to those before it.
fn square([a, b, c]: &[Vector; 3]) -> Option<[Vector; 3]> {
    let along = |of: &Vector, way: &Vector| way.map(|w| w * dot(of, way));
    let a = unit(*a)?;
    let b = unit(sub(b, &along(b, &a)))?;
    let (by_a, by_b) = (along(c, &a), along(c, &b));
    let c = unit([0, 1, 2].map(|k| c[k] - (by_a[k] + by_b[k])))?;
    Some([a, b, c])
}

fn transposed(rows: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|j| [rows[0][j], rows[1][j], rows[2][j]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_mirror_image_is_one_again() {
        let rounded = [[0.6001, 0.8, 0.0, 1.0], [0.8, -0.6, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0]];
        let found = square_placement(&rounded).unwrap();
        let turn = found.map(|[a, b, c, _]| [a, b, c]);
        let size = -determinant(&found).cbrt();
        for i in 0..3 {
            for j in 0..3 {
                let wanted = if i == j { size * size } else { 0.0 };
                assert!((dot(&turn[i], &turn[j]) - wanted).abs() < 1e-15, "{found:?}");
            }
        }
        assert!((size - 1.0).abs() < 1e-4 && found[2][3] == 3.0);
        assert_eq!(square_placement(&[[0.0; 4]; 3]), None);
    }
}
