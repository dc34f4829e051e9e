//! The section of a surface that is neither a line nor an ellipse: a cubic spline through points of it.

use super::plane::Plane;
use super::section_point::{EXACT, Point, SectionCurve, middle, with_curve2};
use crate::geometry::curve::Curve;
use crate::geometry::nurbs::Nurbs;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub, unit};

/// Of the size of a body: how far a spline may be off.
const FITTED: f64 = 2e-7;
/// How far a cubic curve is off at a quarter of the way, over its slope in the middle, where it is off by nothing.
const ASKEW: f64 = 0.2;
const MOST_HALVINGS: u32 = 14;
const MOST_POINTS: usize = 20_000;

/// A point with the direction of the section there.
#[derive(Clone, Copy)]
struct Station {
    point: Point,
    way: Vector,
}

/// A cubic spline through points of the section, tangent to it, with as many points as it needs.
pub fn spline(surface: &Surface, points: &[Point], plane: &Plane, size: f64) -> Result<SectionCurve, &'static str> {
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

#[allow(clippy::too_many_arguments)] // a stretch, what it is measured by, and how deep the halving is
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
    // A curve that is off to one side before the middle and to the other behind it runs askew there.
    let way = sub(&scaled(&chord, 1.5), &scaled(&add(&a.way, &b.way), 2.0 * step));
    let across = |v: &Vector| length(&along(v, &here.way, -dot(v, &here.way)));
    let beside = across(&off).max(ASKEW * across(&way));
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
