//! The curve of a new edge: where a plane passes through a surface, from vertex to vertex.

use super::plane::Plane;
use super::section_point::{EXACT, Point, SectionCurve, middle, on_both, with_curve2};
use super::section_spline::spline;
use super::trace::Run;
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub, unit};
use hlr_exact::elementary::atan2;
use std::f64::consts::TAU;

/// Of the way from a pole to the next point: where the parameter that has no meaning at the pole is taken.
const BESIDE: f64 = 1e-3;

/// The curve of a run. `ends`: its vertices' places; `size`: of the body. The curve ends there or, where these are off the
/// surface, beside them.
///
/// # Errors
/// Why there is none.
pub fn section_curve(
    surface: &Surface,
    run: &Run,
    ends: [Vector; 2],
    plane: &Plane,
    size: f64,
) -> Result<SectionCurve, &'static str> {
    if matches!(surface, Surface::Plane(_)) {
        let (curve, last) = line(&ends).ok_or("two vertices lie in one place")?;
        return Ok(SectionCurve { curve, range: [0.0, last], curve2: None });
    }
    // A vertex lies on its edges; what meets there may be off the surface by the tolerance of a file.
    let mut points = run.points.clone();
    let last = points.len() - 1;
    for (k, inner) in [(0, 1), (last, last - 1)] {
        points[k].0 = beside_pole(surface, points[k].0, points[inner].0, plane, size);
        points[k] = on_both(surface, points[k].0, plane).unwrap_or(points[k]);
    }
    let (points, ends) = (&points, [points[0].1, points[last].1]);
    let middles: Vec<Point> = points
        .windows(2)
        .map(|w| middle(surface, &w[0], &w[1], plane))
        .collect::<Option<_>>()
        .ok_or("its surface touches the plane")?;
    let fits = |off: &dyn Fn(&Vector) -> f64| points.iter().chain(&middles).all(|(_, p)| off(p) <= EXACT * size);
    if let Some((Curve::Line { p, a }, last)) = line(&ends) {
        let off = |q: &Vector| length(&cross(&sub(q, &p), &a));
        if fits(&off) {
            let parameters: Vec<f64> = points.iter().map(|(_, q)| dot(&sub(q, &p), &a)).collect();
            return Ok(with_curve2(Curve::Line { p, a }, [0.0, last], points, parameters));
        }
    }
    if let Some(found) = conic(surface, plane, points) {
        let off = |q: &Vector| from_ellipse(&found, q);
        if fits(&off) {
            return Ok(on_ellipse(found, points));
        }
    }
    spline(surface, points, plane, size)
}

fn line([from, to]: &[Vector; 2]) -> Option<(Curve, f64)> {
    let way = sub(to, from);
    Some((Curve::Line { p: *from, a: unit(&way)? }, length(&way)))
}

/// The parameters of the end of a run, where it is a pole: the one that has no meaning there is that of points close by.
fn beside_pole(surface: &Surface, end: [f64; 2], inner: [f64; 2], plane: &Plane, size: f64) -> [f64; 2] {
    let (_, du, dv) = surface.d1(end);
    let (free, at) = if length(&du) <= EXACT * size {
        (0, 1)
    } else if length(&dv) <= EXACT * size {
        (1, 0)
    } else {
        return end;
    };
    let mut close = inner;
    close[at] = end[at] + BESIDE * (inner[at] - end[at]);
    let found = on_both(surface, close, plane).map_or(inner, |(uv, _)| uv);
    let mut out = end;
    out[free] = found[free];
    out
}

/// An ellipse's centre and two half axes at right angles.
type Ellipse = [Vector; 3];

/// The circle or ellipse in which a surface may meet the plane, turning in the sense of the run.
fn conic(surface: &Surface, plane: &Plane, points: &[Point]) -> Option<Ellipse> {
    let first = &points[0].1;
    let about = |centre: Vector| {
        let a = sub(first, &centre);
        [centre, a, cross(&plane.normal, &a)]
    };
    let mut found = match surface {
        Surface::Sphere(..) => about(plane.foot(&surface.centre()?)),
        Surface::Cylinder(frame, radius) => {
            let [origin, _, _, axis] = frame.vectors();
            let rise = dot(&axis, &plane.normal);
            let across = cross(&axis, &plane.normal);
            if length(&across) <= 1e-12 {
                about(plane.foot(&origin))
            } else {
                let centre = along(&origin, &axis, -plane.height(&origin) / rise);
                let b = scaled(&unit(&across)?, *radius);
                let a = scaled(&cross(&plane.normal, &unit(&across)?), radius / rise.abs());
                [centre, a, b]
            }
        }
        Surface::Torus(..) | Surface::Cone(..) | Surface::Revolution(..) => {
            let (origin, axis) = match surface {
                Surface::Cone(frame, ..) => (frame.vectors()[0], frame.vectors()[3]),
                _ => surface.axis()?,
            };
            let axis = unit(&axis)?;
            if length(&cross(&axis, &plane.normal)) <= 1e-12 {
                about(along(&origin, &axis, dot(&sub(first, &origin), &axis)))
            } else if let Surface::Torus(frame, major, _) = surface {
                // The plane contains the axis.
                let out = sub(first, &origin);
                let radial = unit(&along(&out, &frame.vectors()[3], -dot(&out, &frame.vectors()[3])))?;
                let centres = [1.0, -1.0].map(|side| along(&origin, &radial, side * major));
                let radius = |c: &Vector| length(&sub(first, c));
                about(centres[usize::from(radius(&centres[1]) < radius(&centres[0]))])
            } else {
                return None;
            }
        }
        _ => return None,
    };
    // The sense in which the run passes it.
    let turn = |p: &Vector| {
        let d = sub(p, &found[0]);
        atan2(dot(&d, &found[2]) / dot(&found[2], &found[2]), dot(&d, &found[1]) / dot(&found[1], &found[1]))
    };
    let sum: f64 = points.windows(2).map(|w| wrapped(turn(&w[1].1) - turn(&w[0].1))).sum();
    if sum < 0.0 {
        found[2] = scaled(&found[2], -1.0);
    }
    found.iter().flatten().all(|c| c.is_finite()).then_some(found)
}

/// An angle between minus and plus half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn from_ellipse([centre, a, b]: &Ellipse, p: &Vector) -> f64 {
    let d = sub(p, centre);
    let t = atan2(dot(&d, b) / dot(b, b), dot(&d, a) / dot(a, a));
    let (sin, cos) = hlr_exact::elementary::sin_cos(t);
    length(&sub(&d, &add(&scaled(a, cos), &scaled(b, sin))))
}

fn on_ellipse(ellipse: Ellipse, points: &[Point]) -> SectionCurve {
    let [p, a, b] = ellipse;
    let mut parameters: Vec<f64> = Vec::with_capacity(points.len());
    for (_, point) in points {
        let d = sub(point, &p);
        let angle = atan2(dot(&d, &b) / dot(&b, &b), dot(&d, &a) / dot(&a, &a));
        let before = parameters.last().copied();
        parameters.push(before.map_or(angle, |before| before + wrapped(angle - before)));
    }
    let range = [parameters[0], parameters[parameters.len() - 1]];
    with_curve2(Curve::Ellipse { p, a, b }, range, points, parameters)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(kind: u8, sizes: &[f64]) -> Surface {
        let axes = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].concat();
        Surface::read(kind, &[&axes[..], sizes].concat()).unwrap()
    }

    fn tilted(level: f64) -> Plane {
        Plane { normal: [0.6, 0.0, 0.8], level, near: 1e-9 }
    }

    /// The curve through points of the surface near these parameters.
    fn through(surface: &Surface, plane: &Plane, near: impl Iterator<Item = [f64; 2]>) -> SectionCurve {
        let points: Vec<Point> = near.map(|uv| on_both(surface, uv, plane).unwrap()).collect();
        let run = Run { region: 0, ends: [0, 1], points };
        let ends = [run.points[0].1, run.points[run.points.len() - 1].1];
        section_curve(surface, &run, ends, plane, 10.0).unwrap()
    }

    fn is_on(found: &SectionCurve, surface: &Surface, plane: &Plane, most: f64) {
        for k in 0..=200 {
            let t = found.range[0] + (found.range[1] - found.range[0]) * f64::from(k) / 200.0;
            let point = found.curve.point(t);
            let [u, v, _] = found.curve2.as_ref().unwrap().point(t);
            let uv = crate::faces::near(surface, &point, [u, v]).unwrap();
            assert!(plane.height(&point).abs() < most, "{t}");
            assert!(length(&sub(&surface.point(uv), &point)) < most, "{t}");
        }
    }

    fn turn(from: f64, to: f64) -> impl Iterator<Item = [f64; 2]> {
        (0..=12).map(move |k| [from + (to - from) * f64::from(k) / 12.0, 0.0])
    }

    #[test]
    fn planes_cut_spheres_in_circles_and_cylinders_in_ellipses() {
        let (sphere, cylinder) = (frame(4, &[5.0]), frame(2, &[2.0]));
        for (from, to) in [(0.3, 5.9), (5.9, 0.3)] {
            let found = through(&sphere, &tilted(0.0), turn(from, to));
            assert!(matches!(found.curve, Curve::Ellipse { a, b, .. } if (length(&a) - length(&b)).abs() < 1e-12));
            is_on(&found, &sphere, &tilted(0.0), 1e-12);
            let found = through(&cylinder, &tilted(1.0), turn(from, to));
            assert!(
                matches!(found.curve, Curve::Ellipse { a, b, .. } if (length(&a) / length(&b) - 1.25).abs() < 1e-12)
            );
            is_on(&found, &cylinder, &tilted(1.0), 1e-12);
        }
    }

    #[test]
    fn other_sections_are_splines_that_keep_to_surface_and_plane() {
        let cone = frame(3, &[2.0, 0.3]);
        let found = through(&cone, &tilted(1.0), turn(0.3, 5.9));
        assert!(matches!(found.curve, Curve::Spline(_)));
        is_on(&found, &cone, &tilted(1.0), 4e-6);
    }

    #[test]
    fn a_plane_along_a_cylinder_or_through_an_apex_cuts_rulings() {
        let plane = Plane { normal: [1.0, 0.0, 0.0], level: 0.0, near: 1e-9 };
        for surface in [frame(2, &[2.0]), frame(3, &[2.0, 0.3])] {
            let found = through(&surface, &plane, [[1.5, 0.0], [1.6, 1.0], [1.57, 3.0]].into_iter());
            assert!(matches!(found.curve, Curve::Line { .. }));
            is_on(&found, &surface, &plane, 1e-12);
        }
    }
}
