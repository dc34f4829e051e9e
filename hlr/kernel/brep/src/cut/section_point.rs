//! Points on a surface and a plane, and curves through them.

use super::plane::Plane;
use crate::geometry::curve::Curve;
use crate::geometry::nurbs::Nurbs;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, dot};

const NEWTON_STEPS: usize = 20;
/// Of the size of a body: what is closer together lies in one place.
pub const EXACT: f64 = 1e-9;

/// A curve in space over a range, and the same in (u, v) over the same range; None on a plane.
pub struct SectionCurve {
    pub curve: Curve,
    pub range: [f64; 2],
    pub curve2: Option<Curve>,
}

/// Parameters on the surface, and the place.
pub type Point = ([f64; 2], Vector);

/// The point of a section between two others, close to their middle in (u, v).
pub fn middle(surface: &Surface, a: &Point, b: &Point, plane: &Plane) -> Option<Point> {
    on_both(surface, [0, 1].map(|k| 0.5 * (a.0[k] + b.0[k])), plane)
}

/// The point on surface and plane that is reached from a point of the surface along its steepest line.
pub fn on_both(surface: &Surface, mut uv: [f64; 2], plane: &Plane) -> Option<Point> {
    let mut before = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let (point, du, dv) = surface.d1(uv);
        let height = plane.height(&point);
        if height.abs() >= before || height == 0.0 {
            let close = height.abs().min(before) <= plane.near;
            return close.then_some((uv, point));
        }
        before = height.abs();
        let (e, f, g) = (dot(&du, &du), dot(&du, &dv), dot(&dv, &dv));
        let (a, b) = (dot(&plane.normal, &du), dot(&plane.normal, &dv));
        let determinant = e * g - f * f;
        let (x, y) = ((g * a - f * b) / determinant, (e * b - f * a) / determinant);
        let slope = a * x + b * y;
        if !(slope > 0.0 && determinant > 0.0) {
            return (before <= plane.near).then_some((uv, point));
        }
        uv = [uv[0] - height * x / slope, uv[1] - height * y / slope];
    }
    let point = surface.point(uv);
    (plane.height(&point).abs() <= plane.near).then_some((uv, point))
}

/// The curve in (u, v) leads straight from point to point: its middle only says which of several points of the surface is
/// meant.
pub fn with_curve2(curve: Curve, range: [f64; 2], points: &[Point], mut parameters: Vec<f64>) -> SectionCurve {
    let last = parameters.len() - 1;
    (parameters[0], parameters[last]) = (range[0], range[1]);
    for k in 1..=last {
        parameters[k] = parameters[k].max(parameters[k - 1]).min(range[1]);
    }
    let mut kept: Vec<usize> = (0..last).filter(|&k| k == 0 || parameters[k] > parameters[k - 1]).collect();
    kept.retain(|&k| k == 0 || parameters[k] < range[1]);
    kept.push(last);
    let mut knots: Vec<f64> = kept.iter().map(|&k| parameters[k]).collect();
    knots.insert(0, range[0]);
    knots.push(range[1]);
    let poles = kept.iter().map(|&k| [points[k].0[0], points[k].0[1], 0.0, 1.0]).collect();
    let curve2 = Curve::Spline(Nurbs { degree: 1, rational: false, sampled: true, knots, poles });
    SectionCurve { curve, range, curve2: Some(curve2) }
}
