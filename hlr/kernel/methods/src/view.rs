//! Transforms planes of the model into the camera's coordinates.

use super::non_planar::Flat;
use super::scene::Camera;

/// Maps planes of the model to the screen.
pub struct View {
    inverse: [[f64; 4]; 4],
}

impl View {
    /// For planes measured from an origin. None where the camera's matrix has no inverse.
    pub fn new(origin: &[f64; 3], camera: &Camera) -> Option<View> {
        let [x, y, z] = *origin;
        let moved = camera.matrix.map(|[a, b, c, d]| [a, b, c, a * x + b * y + c * z + d]);
        Some(View { inverse: inverse(&moved)? })
    }

    /// A plane n . (p - base) as A u + B v + C q + D w, which keeps its sign wherever w is positive.
    pub fn plane(&self, plane: &Flat) -> [f64; 4] {
        let [a, b, c] = plane.normal;
        let given = [a, b, c, -(a * plane.base[0] + b * plane.base[1] + c * plane.base[2])];
        std::array::from_fn(|k| (0..4).map(|i| given[i] * self.inverse[i][k]).sum())
    }

    /// Whether the viewer, at depth -inf, is in front of the plane.
    pub fn before(&self, plane: &Flat) -> bool {
        self.plane(plane)[2] < 0.0
    }
}

/// The inverse by Gauss-Jordan elimination, with pivots.
fn inverse(m: &[[f64; 4]; 4]) -> Option<[[f64; 4]; 4]> {
    let mut a: [[f64; 8]; 4] =
        std::array::from_fn(|i| std::array::from_fn(|k| if k < 4 { m[i][k] } else { f64::from(u8::from(k - 4 == i)) }));
    for c in 0..4 {
        let pivot = (c..4).max_by(|&i, &k| a[i][c].abs().total_cmp(&a[k][c].abs()))?;
        a.swap(c, pivot);
        let by = a[c][c];
        if by == 0.0 || !by.is_finite() {
            return None;
        }
        a[c].iter_mut().for_each(|v| *v /= by);
        let row = a[c];
        for (_, other) in a.iter_mut().enumerate().filter(|(i, _)| *i != c) {
            let by = other[c];
            other.iter_mut().zip(row).for_each(|(v, r)| *v -= by * r);
        }
    }
    Some(std::array::from_fn(|i| std::array::from_fn(|k| a[i][4 + k])))
}
