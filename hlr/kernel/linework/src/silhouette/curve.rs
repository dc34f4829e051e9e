//! The curve along a silhouette: a circle where that is exact, otherwise cubic pieces through its points with their
//! tangents.

use hlr_exact::elementary::acos;
use std::f64::consts::{PI, TAU};

use super::TIE;
use super::face::{Face, SeenCircle};
use hlr_accuracy::{OUTLINE_CIRCLE, OUTLINE_CORNER, OUTLINE_TANGENT_STEP};
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::nurbs::Nurbs;
use hlr_brep::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub, unit};

/// Cosine of the angle between a tangent and the chord to the next point; below this the tangent is not used.
const ASTRAY: f64 = 0.3;

/// Cosine of the angle by which a long chord turns into the next one at a corner: 30 degrees.
const CORNER: f64 = 0.866;

/// Points on a whole circle, at least.
const FEWEST: f64 = 12.0;

/// The direction on the surface along which f stays constant; None where the gradient of f vanishes.
pub fn tangent(face: &Face, uv: [f64; 2], chord: f64) -> Option<Vector> {
    let [du, dv] = face.derivatives(uv);
    let speed = [length(&du), length(&dv)];
    if speed[0] == 0.0 || speed[1] == 0.0 {
        return None;
    }
    let step = OUTLINE_TANGENT_STEP * chord;
    let slope = |k: usize| {
        let mut beside = [uv; 2];
        beside[0][k] -= step / speed[k];
        beside[1][k] += step / speed[k];
        Some(face.f(beside[1])? - face.f(beside[0])?)
    };
    let (fu, fv) = (slope(0)?, slope(1)?);
    unit(&sub(&scaled(&du, fv / speed[0]), &scaled(&dv, fu / speed[1])))
}

/// The circle on which all points lie, where the surface is one of revolution seen along its axis, or a sphere.
pub fn circle(face: &Face, points: &[Vector], chord: f64) -> Option<Curve> {
    if points.len() < 4 {
        return None;
    }
    let (centre, axis) = match face.axis() {
        Some((origin, axis)) => (along(&origin, &axis, dot(&sub(&points[0], &origin), &axis)), axis),
        None => face.circle_of_sphere().map(|seen| (seen.centre, seen.axis))?,
    };
    let arm = sub(&points[0], &centre);
    let radius = length(&arm);
    // Nodes of the mesh at which |N . v| counts as 0 are points of the outline as they are.
    let near = OUTLINE_CIRCLE * chord + TIE * radius;
    let on = |p: &Vector| {
        let q = sub(p, &centre);
        dot(&q, &axis).abs() <= near && (length(&q) - radius).abs() <= near
    };
    // The circle runs in the order of the points.
    let way = cross(&arm, &sub(&points[1], &points[0]));
    let axis = if dot(&way, &axis) < 0.0 { scaled(&axis, -1.0) } else { axis };
    points.iter().all(on).then(|| Curve::Ellipse { p: centre, a: arm, b: cross(&axis, &arm) })
}

/// A circle with points of its own, evenly spaced.
pub struct Whole {
    pub curve: Curve,
    /// The last point is the first.
    pub points: Vec<Vector>,
    /// Unit normals of the surface at the points.
    pub normals: Vec<Vector>,
}

/// The circle in which a whole sphere is seen edge-on, the same for any mesh of the sphere; None for any other curve.
/// `normal`: of the surface at the first of the points.
pub fn whole_circle(face: &Face, points: &[Vector], normal: &Vector, chord: f64) -> Option<Whole> {
    let SeenCircle { sphere, centre, axis, radius } = face.circle_of_sphere()?;
    if points.first() != points.last() || circle(face, points, chord).is_none() {
        return None;
    }
    let sign = dot(normal, &sub(&points[0], &sphere)).signum();
    let least = (0..3).min_by(|&i, &j| axis[i].abs().total_cmp(&axis[j].abs()))?;
    let side = [0, 1, 2].map(|k| if k == least { 1.0 } else { 0.0 });
    let arm = scaled(&unit(&cross(&axis, &side))?, radius);
    let curve = Curve::Ellipse { p: centre, a: arm, b: cross(&axis, &arm) };
    let count = (PI / acos((1.0 - chord / radius).max(0.0))).ceil().max(FEWEST);
    let mut points: Vec<Vector> = (0..count as u32).map(|k| curve.point(TAU * f64::from(k) / count)).collect();
    points.push(points[0]);
    let normals = points.iter().map(|p| unit(&scaled(&sub(p, &sphere), sign))).collect::<Option<_>>()?;
    Some(Whole { curve, points, normals })
}

/// Whether the curve has a corner at an inner point, as where an outline runs into a degenerate triangle at the border of
/// its face: a long chord turns sharply into the next one.
pub fn corner(points: &[Vector], i: usize, chord: f64) -> bool {
    let (p, q) = (sub(&points[i], &points[i - 1]), sub(&points[i + 1], &points[i]));
    let (one, other) = (length(&p), length(&q));
    one.max(other) > OUTLINE_CORNER * chord && dot(&p, &q) < CORNER * one * other
}

/// Cubic pieces through the points, as a B-spline with a continuous tangent but at corners, which are inner points.
pub fn through(points: &[Vector], tangents: &[Option<Vector>], corner: &dyn Fn(usize) -> bool) -> Option<Nurbs> {
    let last = points.len() - 1;
    let closed = points[0] == points[last];
    let ways: Vec<Vector> = (0..=last)
        .map(|i| {
            let before = if i > 0 {
                i - 1
            } else if closed {
                last - 1
            } else {
                i
            };
            let after = if i < last {
                i + 1
            } else if closed {
                1
            } else {
                i
            };
            let way = unit(&sub(&points[after], &points[before])).unwrap_or([0.0; 3]);
            let Some(t) = tangents[i] else { return way };
            let t = if dot(&t, &way) < 0.0 { scaled(&t, -1.0) } else { t };
            if dot(&t, &way) < ASTRAY { way } else { t }
        })
        .collect();
    let mut knots = vec![0.0; 4];
    let mut poles = vec![points[0]];
    let corners: Vec<bool> = (0..=last).map(|i| i > 0 && i < last && corner(i)).collect();
    for i in 0..last {
        let (p, q) = (&points[i], &points[i + 1]);
        // At a corner both pieces run along their own chords.
        let way = |k: usize| if corners[k] { unit(&sub(q, p)).unwrap_or(ways[k]) } else { ways[k] };
        let (t, u) = (&way(i), &way(i + 1));
        // Control points at the distance they have on a circular arc that turns as much.
        let half = (0.5 * (1.0 + dot(t, u).clamp(-0.5, 1.0))).sqrt();
        let span = 2.0 * length(&sub(q, p)) / (1.0 + half);
        poles.push(add(p, &scaled(t, span / 3.0)));
        poles.push(along(q, u, -span / 3.0));
        let end = knots[knots.len() - 1] + span;
        knots.extend([end; 2]);
        if corners[i + 1] {
            poles.push(*q);
            knots.push(end);
        }
    }
    poles.push(points[last]);
    let end = knots[knots.len() - 1];
    knots.extend([end; 2]);
    let rising = knots.windows(2).all(|w| w[0] <= w[1]) && end > 0.0;
    let poles = poles.into_iter().map(|[x, y, z]| [x, y, z, 1.0]).collect();
    (rising && end.is_finite()).then_some(Nurbs { degree: 3, rational: false, sampled: true, knots, poles })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_through_a_helix_stay_near_it() {
        let at = |t: f64| ([t.cos(), t.sin(), 0.3 * t], unit(&[-t.sin(), t.cos(), 0.3]));
        let (points, mut tangents): (Vec<Vector>, Vec<_>) = (0..=20).map(|i| at(f64::from(i) * 0.2)).unzip();
        // One tangent reversed, one unknown and one wrong: the others still decide the curve.
        tangents[3] = tangents[3].map(|t| scaled(&t, -1.0));
        let Some(curve) = through(&points, &tangents, &|_| false) else { panic!() };
        let (low, high) = curve.domain();
        let curve = Curve::Spline(curve);
        let worst = (0..=500).map(|i| {
            let [x, y, z] = curve.point(low + (high - low) * f64::from(i) / 500.0);
            let (sin, cos) = (z / 0.3).sin_cos();
            length(&[x - cos, y - sin, 0.0])
        });
        assert!(worst.fold(0.0, f64::max) < 1e-5);
    }

    #[test]
    fn a_curve_with_a_corner_keeps_to_both_sides_of_it() {
        // A quarter of a circle of radius 1, then straight up out of its plane. Chords of 0.16 are long beyond 0.02.
        let at = |k: u32| {
            let (y, x) = (f64::from(k) * 0.157).sin_cos();
            [x, y, 0.0]
        };
        let end = at(10);
        let points: Vec<Vector> = (0..=10).map(at).chain([[end[0], end[1], 0.5]]).collect();
        let found: Vec<usize> = (1..11).filter(|&i| corner(&points, i, 1e-3)).collect();
        assert_eq!(found, [10]);
        assert!(!corner(&points, 10, 0.1));
        let worst = |corner: &dyn Fn(usize) -> bool| {
            let Some(curve) = through(&points, &vec![None; 12], corner) else { panic!() };
            assert_eq!(curve.knots.len(), curve.poles.len() + 4);
            let (low, high) = curve.domain();
            let off = (0..=500).map(|i| {
                let [x, y, z] = curve.point(low + (high - low) * f64::from(i) / 500.0);
                if z > 0.0 { length(&[x - end[0], y - end[1], 0.0]) } else { (x.hypot(y) - 1.0).abs() }
            });
            off.fold(0.0, f64::max)
        };
        assert!(worst(&|i| i == 10) < 5e-3);
        // With a continuous tangent it swings out beside the corner.
        assert!(worst(&|_| false) > 2e-2);
    }
}
