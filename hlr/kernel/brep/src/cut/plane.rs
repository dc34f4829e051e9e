//! The plane of a cut.

use crate::geometry::vector::{Vector, along, cross, dot, unit};

/// Of the size of a body: how far places may differ by rounding alone.
pub(super) const ROUNDING: f64 = 1e-13;

/// What lies on the side to which `normal`, of length 1, points is taken away.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub normal: Vector,
    /// How far it lies along its normal.
    pub level: f64,
    /// What lies so close to it lies on it.
    pub near: f64,
}

impl Plane {
    /// How far a point lies beyond it.
    pub fn height(&self, point: &Vector) -> f64 {
        dot(&self.normal, point) - self.level
    }

    pub fn is_beyond(&self, point: &Vector) -> bool {
        self.height(point) > self.near
    }

    pub fn holds(&self, point: &Vector) -> bool {
        self.height(point).abs() <= self.near
    }

    /// Two directions in it, which make a right-handed frame with the normal.
    pub fn axes(&self) -> [Vector; 2] {
        let size = self.normal.map(f64::abs);
        let least = if size[0] <= size[1] && size[0] <= size[2] {
            0
        } else if size[1] <= size[2] {
            1
        } else {
            2
        };
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let x = unit(&cross(&axis, &self.normal)).unwrap_or([1.0, 0.0, 0.0]);
        [x, cross(&self.normal, &x)]
    }

    /// The nearest point of the plane.
    pub fn foot(&self, point: &Vector) -> Vector {
        along(point, &self.normal, -self.height(point))
    }
}
