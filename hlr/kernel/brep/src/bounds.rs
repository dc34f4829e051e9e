//! The box around each part, from its geometry and not from a mesh: the accuracy of the mesh depends on it.
//!
//! Planes, cylinders, cones and other ruled surfaces reach farthest on their edges. Spheres, tori and surfaces of
//! revolution are taken over the (u, v) range of the face, free-form surfaces by their control points there.

use hlr_exact::elementary::{self, sin_cos};
use std::f64::consts::{FRAC_PI_2, TAU};

use rayon::prelude::*;

use crate::format::{IDENTITY, Matrix, chained, moved, turned};
use crate::geometry::curve::Curve;
use crate::geometry::nurbs::used_poles;
use crate::geometry::spline_surface::SplineSurface;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, along, cross, dot, scaled, sub};
use crate::geometry::waves::waves;
use crate::model::Model;
use crate::part_topology::PartTopology;
use crate::shapes::{Edge, Face};

/// Lower and upper corner; the lower is beyond the upper where nothing is inside.
pub type Box3 = [Vector; 2];

pub const EMPTY: Box3 = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

pub(crate) type Range = [f64; 2];

const WHOLE: Range = [f64::NEG_INFINITY, f64::INFINITY];

/// The box of each part.
pub fn boxes(model: &Model) -> Vec<Box3> {
    model.topology.par_iter().map(|part| around(model, part, None, add_spline, EMPTY)).collect()
}

/// The box around a part that stands in a place, and around a box that is known already. Ends, arcs and faces' own
/// triangles come first. Splines and surfaces that may reach beyond them are then looked at, each for itself: so the box
/// is the same whatever the number of threads.
pub(crate) fn around(
    model: &Model,
    part: &PartTopology,
    place: Option<&Matrix>,
    add_spline: AddSpline,
    mut known: Box3,
) -> Box3 {
    let edges = part.edges.iter().map(|e| (&model.edges[e.edge as usize], stands(place, e.place)));
    let faces = part.faces.iter().map(|f| (&model.faces[f.face as usize], stands(place, f.place)));
    let is_known = |edge: &Edge| matches!(edge.curve, Some(Curve::Line { .. } | Curve::Ellipse { .. }));
    for (edge, place) in edges.clone() {
        add_ends(edge, &place, &mut known);
        if is_known(edge) {
            add_edge(model, edge, &place, &mut known);
        }
    }
    for (face, place) in faces.clone() {
        face.own.iter().flat_map(|own| &own.points).for_each(|point| add_point(&moved(&place, point), &mut known));
    }
    let edges_left: Vec<_> = edges.filter(|(edge, at)| !is_known(edge) && !hull_within(edge, at, &known)).collect();
    let faces_left: Vec<_> = faces.filter(|(face, at)| may_reach_beyond(face, at, &known)).collect();
    let with_edges = edges_left.par_iter().with_min_len(FEW).map(|(edge, place)| {
        let mut found = known;
        add_edge(model, edge, place, &mut found);
        found
    });
    let with_faces = faces_left.par_iter().with_min_len(FEW).map(|(face, place)| {
        let mut found = known;
        add_face(model, face, place, add_spline, &mut found);
        found
    });
    with_edges.chain(with_faces).reduce(|| known, union)
}

/// With fewer edges or faces a second thread gains nothing.
const FEW: usize = 16;

/// Where something stands that has a place in its part.
pub(crate) fn stands(part: Option<&Matrix>, within: Option<Matrix>) -> Matrix {
    match (part, within) {
        (Some(part), Some(within)) => chained(part, &within),
        (part, within) => part.copied().or(within).unwrap_or(IDENTITY),
    }
}

pub(crate) fn union(a: Box3, b: Box3) -> Box3 {
    [[0, 1, 2].map(|k| a[0][k].min(b[0][k])), [0, 1, 2].map(|k| a[1][k].max(b[1][k]))]
}

fn is_within(point: &Vector, found: &Box3) -> bool {
    (0..3).all(|k| found[0][k] <= point[k] && point[k] <= found[1][k])
}

/// Whether an edge is a spline, not continued beyond its ends, whose poles all lie within a box: then it does, too.
fn hull_within(edge: &Edge, place: &Matrix, found: &Box3) -> bool {
    let Some(Curve::Spline(n)) = &edge.curve else { return false };
    let (first, last) = n.domain();
    if edge.range[0] < first || edge.range[1] > last {
        return false;
    }
    n.poles.iter().all(|[x, y, z, w]| is_within(&moved(place, &[x / w, y / w, z / w]), found))
}

/// Whether a face may reach farther than its edges, and beyond a box. All of its surface is looked at.
fn may_reach_beyond(face: &Face, place: &Matrix, found: &Box3) -> bool {
    let Some(surface) = face.surface.as_ref().filter(|surface| !reaches_on_edges(surface)) else { return false };
    match surface {
        Surface::Sphere(..) | Surface::Torus(..) | Surface::Spline(_) => {
            let mut whole = EMPTY;
            add_surface(surface, [WHOLE; 2], place, &mut whole);
            !whole.iter().all(|corner| is_within(corner, found))
        }
        _ => true,
    }
}

pub(crate) fn add_point(point: &Vector, found: &mut Box3) {
    for k in 0..3 {
        found[0][k] = found[0][k].min(point[k]);
        found[1][k] = found[1][k].max(point[k]);
    }
}

pub(crate) fn add_range(k: usize, range: Range, found: &mut Box3) {
    found[0][k] = found[0][k].min(range[0]);
    found[1][k] = found[1][k].max(range[1]);
}

pub(crate) fn add_ends(edge: &Edge, place: &Matrix, found: &mut Box3) {
    let points = edge.end_points.iter().flatten().chain(edge.polygon.iter().flatten());
    points.for_each(|point| add_point(&moved(place, point), found));
}

pub(crate) fn add_edge(model: &Model, edge: &Edge, place: &Matrix, found: &mut Box3) {
    if let Some(curve) = &edge.curve {
        add_curve(&curve.moved(place), edge.range, found);
    } else if let Some((number, surface)) = edge.only_on.as_deref()
        && let (Some(curve), Some(on)) = (&model.curves2[*number], edge.on.first())
    {
        for t in steps(on.range, SAMPLES) {
            let [u, v, _] = curve.point(t);
            add_point(&moved(place, &surface.point([u, v])), found);
        }
    }
}

/// Pieces of a curve that is only sampled.
const SAMPLES: usize = 32;

fn steps([first, last]: Range, count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| if k == count { last } else { first + (last - first) * (k as f64 / count as f64) })
}

/// Adds a curve, or the poles of a spline, which enclose it. Its ends may lie beyond them, where it is continued.
pub(crate) fn add_poles(curve: &Curve, range: Range, found: &mut Box3) {
    match curve {
        Curve::Spline(n) => {
            range.iter().for_each(|t| add_point(&curve.point(*t), found));
            n.poles.iter().for_each(|[x, y, z, w]| add_point(&[x / w, y / w, z / w], found));
        }
        _ => add_curve(curve, range, found),
    }
}

fn add_curve(curve: &Curve, range: Range, found: &mut Box3) {
    range.iter().for_each(|t| add_point(&curve.point(*t), found));
    match curve {
        Curve::Line { .. } => {}
        Curve::Ellipse { p, a, b } => {
            for k in 0..3 {
                let reach = waves(a[k], b[k], range);
                add_range(k, [p[k] + reach[0], p[k] + reach[1]], found);
            }
        }
        Curve::Spline(n) => {
            let (first, last) = n.domain();
            let [first, last] = [range[0].max(first), range[1].min(last)];
            let mut breaks = vec![first];
            breaks.extend(n.knots.iter().copied().filter(|k| (first..last).contains(k)));
            breaks.push(last);
            breaks.dedup();
            for span in breaks.windows(2).map(|ends| [ends[0], ends[1]]) {
                let poles = &n.poles[used_poles(&n.knots, n.degree, n.poles.len(), span)];
                if !poles.iter().all(|[x, y, z, w]| is_within(&[x / w, y / w, z / w], found)) {
                    add_turns(curve, span, 2 * n.degree, found);
                }
            }
        }
        _ => add_turns(curve, range, SAMPLES, found),
    }
}

/// Adds the samples of a curve, and where it turns back between two of them.
fn add_turns(curve: &Curve, range: Range, count: usize, found: &mut Box3) {
    let mut before: Option<(f64, Vector)> = None;
    for t in steps(range, count) {
        let [point, slope, _] = curve.derivatives(t);
        add_point(&point, found);
        if let Some((from, earlier)) = before {
            for k in (0..3).filter(|&k| earlier[k] * slope[k] < 0.0) {
                let (mut low, mut high) = (from, t);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    let same = curve.derivatives(middle)[1][k] * earlier[k] > 0.0;
                    if same { low = middle } else { high = middle }
                }
                add_point(&curve.point(0.5 * (low + high)), found);
            }
        }
        before = Some((t, slope));
    }
}

/// The value where a slope is zero is right to the square of what is left of the parameter.
const HALVINGS: usize = 30;

fn add_face(model: &Model, face: &Face, place: &Matrix, add_spline: AddSpline, found: &mut Box3) {
    let Some(surface) = &face.surface else { return };
    if let Surface::Spline(spline) = surface {
        // The poles of its curves in (u, v) are at hand. Mostly not even what they enclose reaches beyond the box.
        let mut hull = EMPTY;
        add_surface(surface, uv_range(model, face, surface, add_poles), place, &mut hull);
        if hull.iter().all(|corner| is_within(corner, found)) {
            return;
        }
        return add_spline(spline, uv_range(model, face, surface, add_curve), place, found);
    }
    add_surface(surface, uv_range(model, face, surface, add_curve), place, found);
}

pub(crate) fn reaches_on_edges(surface: &Surface) -> bool {
    match surface {
        Surface::Plane(_) | Surface::Cylinder(..) | Surface::Cone(..) | Surface::Extrusion(..) => true,
        Surface::Offset(basis, _) => reaches_on_edges(basis),
        Surface::Spline(spline) => spline.is_ruled(),
        _ => false,
    }
}

/// The ranges of u and v of a face, from its curves in (u, v). Where an outline goes once around in one direction, it
/// says nothing of where the face ends in the other.
///
/// `add`: adds a curve, as `add_curve` does, or something that encloses it.
pub(crate) fn uv_range(model: &Model, face: &Face, surface: &Surface, add: fn(&Curve, Range, &mut Box3)) -> [Range; 2] {
    let mut all = EMPTY;
    let (mut around, periods) = ([false; 2], surface.periods());
    for wire in &face.wires {
        let mut way = [0.0; 2];
        for used in wire {
            let found = used.curve2.and_then(|(number, range)| Some((model.curves2[number].as_ref()?, range)));
            let Some((curve, range)) = found else { return [WHOLE; 2] };
            add(curve, range, &mut all);
            let gone = sub(&curve.point(range[1]), &curve.point(range[0]));
            let sign = if used.orientation == crate::format::Orientation::Reversed { -1.0 } else { 1.0 };
            for k in (0..2).filter(|_| used.orientation.bounds()) {
                way[k] += sign * gone[k];
            }
        }
        for k in 0..2 {
            around[k] |= periods[k] > 0.0 && way[k].abs() > 0.5 * periods[k];
        }
    }
    [0, 1].map(|k| if around[1 - k] || all[0][k] > all[1][k] { WHOLE } else { [all[0][k], all[1][k]] })
}

pub(crate) fn add_surface(surface: &Surface, [u, v]: [Range; 2], place: &Matrix, found: &mut Box3) {
    match surface {
        Surface::Sphere(frame, radius) => {
            let v = [v[0].max(-FRAC_PI_2), v[1].min(FRAC_PI_2)];
            add_ring(frame.vectors(), 0.0, *radius, [u, v], place, found);
        }
        Surface::Torus(frame, major, minor) => add_ring(frame.vectors(), *major, *minor, [u, v], place, found),
        Surface::Revolution(origin, axis, curve) => {
            for point in hull(curve, v) {
                let arm = sub(&point, origin);
                let upright = scaled(axis, dot(axis, &arm));
                let (out, side) = (sub(&arm, &upright), cross(axis, &arm));
                let middle = moved(place, &add(origin, &upright));
                let [a, b] = [out, side].map(|way| turned(place, &way));
                for k in 0..3 {
                    let reach = waves(a[k], b[k], u);
                    add_range(k, [middle[k] + reach[0], middle[k] + reach[1]], found);
                }
            }
        }
        Surface::Spline(spline) => add_spline(spline, [u, v], place, found),
        Surface::Offset(basis, distance) => {
            let mut inner = EMPTY;
            add_surface(basis, [u, v], place, &mut inner);
            // The offset lies in the frame of the surface.
            let most = place.iter().map(|row| row[..3].iter().map(|c| c * c).sum::<f64>().sqrt()).fold(0.0, f64::max);
            let by = distance.abs() * most;
            for k in (0..3).filter(|k| inner[0][*k] <= inner[1][*k]) {
                add_range(k, [inner[0][k] - by, inner[1][k] + by], found);
            }
        }
        _ => {}
    }
}

/// Adds a spline surface over ranges.
pub(crate) type AddSpline = fn(&SplineSurface, [Range; 2], &Matrix, &mut Box3);

/// Adds the poles.
pub(crate) fn add_spline(spline: &SplineSurface, ranges: [Range; 2], place: &Matrix, found: &mut Box3) {
    spline.poles_over(ranges).for_each(|pole| add_point(&moved(place, &pole), found));
}

/// Adds origin + (major + minor cos v) (cos u x + sin u y) + minor sin v z.
fn add_ring(
    [origin, x, y, z]: [Vector; 4],
    major: f64,
    minor: f64,
    [u, v]: [Range; 2],
    place: &Matrix,
    out: &mut Box3,
) {
    let middle = moved(place, &origin);
    let [x, y, z] = [x, y, z].map(|way| turned(place, &way));
    for k in 0..3 {
        for wave in waves(x[k], y[k], u) {
            let reach = waves(minor * wave, minor * z[k], v);
            add_range(k, [middle[k] + major * wave + reach[0], middle[k] + major * wave + reach[1]], out);
        }
    }
}

/// Points whose convex hull holds the curve over a range.
fn hull(curve: &Curve, range: Range) -> Vec<Vector> {
    let domain = curve.domain(0.0);
    let [first, last] = [range[0].max(domain[0]), range[1].min(domain[1])];
    match curve {
        Curve::Line { .. } => range.iter().filter(|t| t.is_finite()).map(|t| curve.point(*t)).collect(),
        Curve::Ellipse { p, a, b } => {
            let [first, last] = if range[1] - range[0] < TAU { range } else { domain };
            let middles = steps([first, last], ARCS).take(ARCS).flat_map(|t| {
                // Two tangents meet over the middle of the arc between them.
                let half = 0.5 * (last - first) / ARCS as f64;
                let (sin, cos) = sin_cos(t + half);
                let over = 1.0 / elementary::cos(half);
                [curve.point(t), along(&along(p, a, cos * over), b, sin * over)]
            });
            middles.chain([curve.point(last)]).collect()
        }
        Curve::Spline(n) => {
            let used = used_poles(&n.knots, n.degree, n.poles.len(), [first, last]);
            n.poles[used].iter().map(|[x, y, z, w]| [x / w, y / w, z / w]).collect()
        }
        _ => steps([first, last], SAMPLES).map(|t| curve.point(t)).collect(),
    }
}

/// Arcs that an ellipse is divided into.
const ARCS: usize = 16;

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const FULL: Range = [0.0, TAU];

    #[test]
    fn a_ring_reaches_as_far_as_its_points() {
        let frame = [[1.0, 2.0, 3.0], [0.6, 0.8, 0.0], [-0.48, 0.36, 0.8], [0.64, -0.48, 0.6]];
        for (u, v) in [(FULL, FULL), ([0.2, 1.4], [2.0, 4.5]), ([5.0, 7.0], [-1.0, 0.3])] {
            let mut exact = EMPTY;
            add_ring(frame, 3.0, 1.0, [u, v], &IDENTITY, &mut exact);
            let mut sampled = EMPTY;
            for s in steps(u, 400) {
                for t in steps(v, 400) {
                    let out = along(&scaled(&frame[1], s.cos()), &frame[2], s.sin());
                    let point = along(&along(&frame[0], &out, 3.0 + t.cos()), &frame[3], t.sin());
                    add_point(&point, &mut sampled);
                }
            }
            for k in 0..3 {
                let off = [sampled[0][k] - exact[0][k], exact[1][k] - sampled[1][k]];
                assert!(off.iter().all(|off| (-1e-12..2e-4).contains(off)), "{off:?}");
            }
        }
    }

    #[test]
    fn the_hull_of_an_arc_holds_it_closely() {
        let arc = Curve::Ellipse { p: [0.0; 3], a: [1.0, 0.0, 0.0], b: [0.0, 1.0, 0.0] };
        let points = hull(&arc, [0.0, PI]);
        let top = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!((1.0..1.02).contains(&top), "{top}");
    }
}
