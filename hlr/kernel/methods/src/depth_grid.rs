//! Rounds depth to whole steps, and bounds the floating-point error before the rounding.

use super::plane::{DEPTH_LIMIT, Point, STEPS};
use super::scene::{Camera, Scene};

/// Depth of step 0, and size of a step: the finest power of two with which 2^48 steps reach from the nearest to the
/// farthest depth.
#[derive(Clone, Copy, Debug)]
pub struct DepthGrid {
    zero: f64,
    step: f64,
}

/// Share of a polygon's extent in depth: the most that a corner's depth may change when its place is rounded.
const SHARE: f64 = 1.0 / 16.0;

impl DepthGrid {
    /// The grid for corners in pixels and depth.
    pub fn new(camera: &Camera, corners: &[[f64; 3]]) -> DepthGrid {
        let (mut low, mut high) =
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[2]), h.max(p[2])));
        if camera.image_space && camera.front.is_finite() && camera.back.is_finite() {
            (low, high) = (camera.front, camera.back);
        }
        let range = high - low;
        if range.is_nan() || range <= 0.0 {
            return DepthGrid { zero: if low.is_finite() { low } else { 0.0 }, step: 1.0 };
        }
        let mut step = 1.0f64;
        while range > DEPTH_LIMIT * step {
            step *= 2.0;
        }
        while range <= DEPTH_LIMIT * step * 0.5 && step > 1e-290 {
            step *= 0.5;
        }
        // Step 0 is at a whole multiple of the step, so depths with few digits are not rounded at all.
        DepthGrid { zero: (low / step).floor() * step, step }
    }

    /// A depth as a number of steps, unrounded.
    pub fn number(&self, depth: f64) -> f64 {
        (depth - self.zero) / self.step
    }

    /// A difference of depths in steps.
    pub fn steps(&self, difference: f64) -> f64 {
        difference / self.step
    }

    pub fn depth(&self, number: f64) -> f64 {
        number * self.step + self.zero
    }

    /// Sets the depths of a polygon's corners whose image positions are already rounded: the depth of its plane at the
    /// rounded position, not at the original one up to half a 256th of a pixel beside it. So the plane is exact to a
    /// step, however steep.
    ///
    /// `best`: three corners that span the plane. Where a polygon is so nearly edge-on that this would lead to depths
    /// far beyond its own, the corners keep their own depths.
    pub fn lay(&self, exact: &[[f64; 3]], best: [&[f64; 3]; 3], rounded: &mut [Point]) {
        let difference = |a: &[f64; 3], b: &[f64; 3]| [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        let (u, v) = (difference(best[0], best[1]), difference(best[0], best[2]));
        let area = u[0] * v[1] - u[1] * v[0];
        let right = (u[2] * v[1] - v[2] * u[1]) / area;
        let down = (u[0] * v[2] - v[0] * u[2]) / area;
        let (low, high) = exact.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[2]), h.max(p[2])));
        let most = (right.abs() + down.abs()) * 0.5 / STEPS as f64;
        let (right, down) = if most <= SHARE * (high - low) { (right, down) } else { (0.0, 0.0) };
        let limit = DEPTH_LIMIT * (1.0 + 2.0 * SHARE);
        for (p, rounded) in exact.iter().zip(rounded) {
            let moved = |k: usize| rounded[k] as f64 / STEPS as f64 - p[k];
            let number = self.number(p[2]) + self.steps(right * moved(0) + down * moved(1));
            rounded[2] = number.round_ties_even().clamp(-limit, limit) as i64;
        }
    }
}

/// How far floating point may have moved a corner on its way from the model to the screen.
pub struct Noise {
    /// In pixels times w, depth times w, and w.
    image: f64,
    depth: f64,
    w: f64,
}

/// Share of the coordinates of the model: the error of a few operations.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

impl Noise {
    pub fn new(scene: &Scene, camera: &Camera) -> Noise {
        let mut reach = [0.0f64; 3];
        for p in scene.points {
            for k in 0..3 {
                reach[k] = reach[k].max(p[k].abs());
            }
        }
        let row = |k: usize| {
            let m = &camera.matrix[k];
            ROUNDING * ((0..3).map(|i| m[i].abs() * reach[i]).sum::<f64>() + m[3].abs())
        };
        let w = if camera.near.is_finite() { row(3) } else { 0.0 };
        Noise { image: row(0).max(row(1)), depth: row(2), w }
    }

    /// Error in pixels and in depth at a corner, given its 1 / w.
    pub fn at(&self, corner: &[f64; 3], reciprocal: f64) -> [f64; 2] {
        let off = |own: f64, value: f64| (own + value.abs() * self.w) * reciprocal.abs();
        [off(self.image, corner[0].abs().max(corner[1].abs())), off(self.depth, corner[2])]
    }
}
