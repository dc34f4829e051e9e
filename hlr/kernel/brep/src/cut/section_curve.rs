//! The curve of a new edge: where a plane passes through a surface, from vertex to vertex.

use super::plane::Plane;
use super::trace::Run;
use crate::geometry::curve::Curve;
use crate::geometry::nurbs::Nurbs;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub, unit};
use hlr_exact::elementary::atan2;
use std::f64::consts::TAU;

/// Of the size of a body: what departs no farther from a line or an ellipse is one, or from its own curve lies on it.
const EXACT: f64 = 1e-9;
/// Of the size of a body: how far a spline may be off.
const FITTED: f64 = 2e-7;
const MOST_HALVINGS: u32 = 14;
const MOST_POINTS: usize = 20_000;
const NEWTON_STEPS: usize = 20;
/// Of the way from a pole to the next point: where the parameter that has no meaning at the pole is taken.
const BESIDE: f64 = 1e-3;

/// A curve in space over a range, and the same in (u, v) over the same range; None on a plane.
pub struct SectionCurve {
    pub curve: Curve,
    pub range: [f64; 2],
    pub curve2: Option<Curve>,
}

type Point = ([f64; 2], Vector);

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

/// The point of a section between two others, close to their middle in (u, v).
fn middle(surface: &Surface, a: &Point, b: &Point, plane: &Plane) -> Option<Point> {
    on_both(surface, [0, 1].map(|k| 0.5 * (a.0[k] + b.0[k])), plane)
}

/// The point on surface and plane that is reached from a point of the surface along its steepest line.
fn on_both(surface: &Surface, mut uv: [f64; 2], plane: &Plane) -> Option<Point> {
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

/// The curve in (u, v) leads straight from point to point: its middle only says which of several points of the surface is
/// meant.
fn with_curve2(curve: Curve, range: [f64; 2], points: &[Point], mut parameters: Vec<f64>) -> SectionCurve {
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

/// A point with the direction of the section there.
#[derive(Clone, Copy)]
struct Station {
    point: Point,
    way: Vector,
}

/// A cubic spline through points of the section, tangent to it, with as many points as it needs.
fn spline(surface: &Surface, points: &[Point], plane: &Plane, size: f64) -> Result<SectionCurve, &'static str> {
    let station = |point: Point, chord: &Vector| {
        let (_, du, dv) = surface.d1(point.0);
        let way = unit(&cross(&plane.normal, &cross(&du, &dv))).or_else(|| unit(chord)).unwrap_or([0.0; 3]);
        Station { point, way: if dot(&way, chord) < 0.0 { scaled(&way, -1.0) } else { way } }
    };
    let mut stations: Vec<Station> = Vec::new();
    for pair in points.windows(2) {
        let chord = sub(&pair[1].1, &pair[0].1);
        if length(&chord) <= EXACT * size && !stations.is_empty() {
            continue;
        }
        let [from, to] = [station(pair[0], &chord), station(pair[1], &chord)];
        if stations.is_empty() {
            stations.push(from);
        }
        let from = Station { point: stations[stations.len() - 1].point, ..from };
        refined(surface, from, to, plane, size, 0, &station, &mut stations)?;
    }
    if stations.len() < 2 {
        return Err("two vertices lie in one place");
    }
    let mut knots = vec![0.0];
    for pair in stations.windows(2) {
        knots.push(knots[knots.len() - 1] + arc(&pair[0], &pair[1]));
    }
    let range = [0.0, knots[knots.len() - 1]];
    let last = stations.len() - 1;
    let pole = |p: Vector| [p[0], p[1], p[2], 1.0];
    let mut poles = Vec::with_capacity(2 * stations.len());
    for (k, one) in stations.iter().enumerate() {
        let at = &one.point.1;
        if k == 0 {
            poles.push(pole(*at));
        } else {
            poles.push(pole(along(at, &one.way, -(knots[k] - knots[k - 1]) / 3.0)));
        }
        if k == last {
            poles.push(pole(*at));
        } else {
            poles.push(pole(along(at, &one.way, (knots[k + 1] - knots[k]) / 3.0)));
        }
    }
    let inner = knots[1..last].iter().flat_map(|&t| [t, t]);
    let all = [range[0]; 4].into_iter().chain(inner).chain([range[1]; 4]).collect();
    let curve = Curve::Spline(Nurbs { degree: 3, rational: false, sampled: true, knots: all, poles });
    let points: Vec<Point> = stations.iter().map(|s| s.point).collect();
    Ok(with_curve2(curve, range, &points, knots))
}

/// The length of the arc between two stations, from their chord and the angle by which it turns.
fn arc(a: &Station, b: &Station) -> f64 {
    let chord = length(&sub(&b.point.1, &a.point.1));
    let turn = length(&sub(&b.way, &a.way));
    chord * (1.0 + turn * turn / 24.0)
}

#[allow(clippy::too_many_arguments)]
fn refined(
    surface: &Surface,
    a: Station,
    b: Station,
    plane: &Plane,
    size: f64,
    depth: u32,
    station: &dyn Fn(Point, &Vector) -> Station,
    out: &mut Vec<Station>,
) -> Result<(), &'static str> {
    let between = middle(surface, &a.point, &b.point, plane).ok_or("its surface touches the plane")?;
    let chord = sub(&b.point.1, &a.point.1);
    let here = station(between, &chord);
    let step = arc(&a, &b) / 8.0;
    let on_curve = add(&scaled(&add(&a.point.1, &b.point.1), 0.5), &scaled(&sub(&a.way, &b.way), step));
    let off = sub(&on_curve, &between.1);
    let beside = length(&along(&off, &here.way, -dot(&off, &here.way)));
    let astray = length(&off) > 0.25 * length(&chord);
    if (beside > FITTED * size || astray) && length(&chord) > FITTED * size {
        if depth == MOST_HALVINGS || out.len() > MOST_POINTS {
            return Err("its section bends too much");
        }
        refined(surface, a, here, plane, size, depth + 1, station, out)?;
        return refined(surface, here, b, plane, size, depth + 1, station, out);
    }
    out.push(b);
    Ok(())
}
