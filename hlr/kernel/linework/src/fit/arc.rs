//! Ellipses on paper: principal axes from conjugate diameters, and the image of a circle under central projection.

use super::plane::Vec2;
use hlr_brep::geometry::curve::Vec3;
use hlr_exact::elementary::{atan2, cos, sin, sin_cos};

/// The ellipse centre + cos s axes[0] + sin s axes[1]. The axes are perpendicular, the longer one first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    pub centre: Vec2,
    pub axes: [Vec2; 2],
    /// s = sign (u + phase) where u is the parameter of the affine ellipse this one was made from.
    phase: f64,
    sign: f64,
    /// Eccentricity of the change of parameter under central projection, and the angle at which it begins.
    pull: f64,
    turn: f64,
}

impl Ellipse {
    /// The image of p + cos t a + sin t b, homogeneous vectors; None if it is no ellipse or reaches behind the eye.
    ///
    /// Where w = pw (1 + e cos(t - turn)) is not constant, cos(t - turn) = (cos u - e) / (1 - e cos u) makes the image
    /// affine in cos u and sin u: t is to u as the true anomaly is to the eccentric one.
    pub fn image(p: &Vec3, a: &Vec3, b: &Vec3) -> Option<Ellipse> {
        let reach = (a[2] * a[2] + b[2] * b[2]).sqrt();
        let (e, turn) = (reach / p[2], if reach == 0.0 { 0.0 } else { atan2(b[2], a[2]) });
        if p[2] <= 0.0 || e > 1.0 - 1e-9 {
            return None;
        }
        let (c, s) = (cos(turn), sin(turn));
        let f = 1.0 / (p[2] * (1.0 - e * e));
        let root = (1.0 - e * e).sqrt();
        let plane = |k: usize| {
            let (along, across) = (c * a[k] + s * b[k], c * b[k] - s * a[k]);
            [(p[k] - e * along) * f, (along - e * p[k]) * f, across * root * f]
        };
        let (x, y) = (plane(0), plane(1));
        let (centre, u, v) = ([x[0], y[0]], [x[1], y[1]], [x[2], y[2]]);
        // Rotating the parameter by -phase makes the conjugate axes perpendicular.
        let dot = |a: &Vec2, b: &Vec2| a[0] * b[0] + a[1] * b[1];
        let phi = 0.5 * atan2(2.0 * dot(&u, &v), dot(&u, &u) - dot(&v, &v));
        let (c, s) = (cos(phi), sin(phi));
        let major = [c * u[0] + s * v[0], c * u[1] + s * v[1]];
        let minor = [c * v[0] - s * u[0], c * v[1] - s * u[1]];
        Some(Ellipse { centre, axes: [major, minor], phase: -phi, sign: 1.0, pull: e, turn })
    }

    pub fn at(&self, s: f64) -> Vec2 {
        let (sin, cos) = sin_cos(s);
        [0, 1].map(|k| self.centre[k] + cos * self.axes[0][k] + sin * self.axes[1][k])
    }

    /// The angle s on paper for the parameter t of the curve in space. It rises or falls with t by 2 pi per turn.
    pub fn angle(&self, t: f64) -> f64 {
        let theta = t - self.turn;
        let u = if self.pull == 0.0 {
            theta
        } else {
            // atan2 of the half angles keeps the branch: u - theta never exceeds half a turn.
            let turns = (theta / std::f64::consts::TAU).round();
            let half = 0.5 * (theta - turns * std::f64::consts::TAU);
            let (s, c) = sin_cos(half);
            2.0 * atan2((1.0 - self.pull).sqrt() * s, (1.0 + self.pull).sqrt() * c) + turns * std::f64::consts::TAU
        };
        self.sign * (u + self.phase)
    }

    /// Half lengths of the axes.
    pub fn radii(&self) -> [f64; 2] {
        self.axes.map(|v| (v[0] * v[0] + v[1] * v[1]).sqrt())
    }

    /// Bounding box of the piece between two angles.
    pub fn bounds(&self, from: f64, to: f64) -> [Vec2; 2] {
        arc_bounds(&|s| self.at(s), &self.axes, [from, to])
    }
}

/// Bounding box of the piece of an ellipse between two angles; `at`: its points.
pub fn arc_bounds(at: &dyn Fn(f64) -> Vec2, axes: &[Vec2; 2], [from, to]: [f64; 2]) -> [Vec2; 2] {
    let mut out = [at(from), at(from)];
    grow(&mut out, &at(to));
    for (across, along) in axes[1].iter().zip(&axes[0]) {
        let extreme = atan2(*across, *along);
        let first = ((from.min(to) - extreme) / std::f64::consts::PI).ceil() as i64;
        let last = ((from.max(to) - extreme) / std::f64::consts::PI).floor() as i64;
        for n in first..=last.min(first + 1) {
            grow(&mut out, &at(extreme + n as f64 * std::f64::consts::PI));
        }
    }
    out
}

pub fn grow(bounds: &mut [Vec2; 2], p: &Vec2) {
    for k in 0..2 {
        bounds[0][k] = bounds[0][k].min(p[k]);
        bounds[1][k] = bounds[1][k].max(p[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_of_a_circle_near_the_eye() {
        let (p, a, b) = ([1.0, 2.0, 3.0], [1.5, 0.2, 1.1], [-0.3, 0.7, 1.7]);
        let Some(ellipse) = Ellipse::image(&p, &a, &b) else { panic!() };
        let [u, v] = ellipse.axes;
        assert!((u[0] * v[0] + u[1] * v[1]).abs() < 1e-12);
        let mut last = f64::NEG_INFINITY;
        for i in -30..60 {
            let t = f64::from(i) * 0.2;
            let s = ellipse.angle(t);
            assert!(s > last, "rises");
            last = s;
            let q = ellipse.at(s);
            let h: Vec<f64> = (0..3).map(|k| p[k] + t.cos() * a[k] + t.sin() * b[k]).collect();
            assert!((q[0] - h[0] / h[2]).abs() < 1e-12 && (q[1] - h[1] / h[2]).abs() < 1e-12);
        }
        assert!(
            (ellipse.angle(1.0 + std::f64::consts::TAU) - ellipse.angle(1.0) - std::f64::consts::TAU).abs() < 1e-12
        );
    }

    #[test]
    fn a_circle_that_reaches_the_eye_is_no_ellipse() {
        assert_eq!(Ellipse::image(&[0.0, 0.0, 1.0], &[1.0, 0.0, 0.8], &[0.0, 1.0, 0.7]), None);
    }
}
