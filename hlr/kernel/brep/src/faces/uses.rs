//! One edge of a wire, in the direction in which the wire runs: its points in space and in (u, v).

use super::invert::{anywhere, near};
use crate::edges::Polyline;
use crate::format::{Orientation, moved};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, cross, dot, length, sub};
use crate::mesh::Fault;
use crate::model::Model;
use crate::shapes::{Use, Vertex};
use hlr_accuracy::EDGE_IN_FACE;

/// Points run in the sense of the wire; the polyline's chords are numbered along the edge.
pub struct Run {
    pub edge: u32,
    pub location: u32,
    pub backward: bool,
    pub degenerate: bool,
    pub ends: [Vertex; 2],
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<Vector>,
    /// How far the points are off the surface at (u, v), at most.
    pub off: f64,
}

impl Run {
    /// First and last (u, v).
    pub fn uv_ends(&self) -> [[f64; 2]; 2] {
        [self.uv[0], self.uv[self.uv.len() - 1]]
    }
}

/// The run of an edge; None for an edge inside the face, which bounds nothing.
pub fn run(
    model: &Model,
    surface: &Surface,
    used: &Use,
    polylines: &[Option<Polyline>],
    tolerance: f64,
    deflection: f64,
) -> Result<Option<Run>, Fault> {
    let backward = match used.orientation {
        Orientation::Forward => false,
        Orientation::Reversed => true,
        _ => return Ok(None),
    };
    let edge = &model.edges[used.edge as usize];
    let Some(line) = &polylines[used.edge as usize] else { return Err(Fault::Degenerate) };
    let place = |p: &Vector| used.place.as_ref().map_or(*p, |m| moved(m, p));
    let mut points: Vec<Vector> = line.points.iter().map(place).collect();
    let curve = used.curve2.and_then(|(curve, range)| Some((model.curves2[curve].as_ref()?, range)));
    let (mut uv, off) = match (surface, curve) {
        (Surface::Plane(_), _) => on_plane(surface, &points),
        (_, Some((curve, range))) => {
            let limit = (EDGE_IN_FACE * deflection).min(tolerance.max(edge.tolerance)).max(1e-9 * extent(&points));
            by_curve(surface, curve, range, edge.range, line, &points, limit)
        }
        (_, None) if edge.degenerate => return Err(Fault::Degenerate),
        (_, None) => by_points(surface, &points).ok_or(Fault::Degenerate)?,
    };
    if !uv.iter().flatten().all(|c| c.is_finite()) {
        return Err(Fault::Degenerate);
    }
    let mut ends = used.ends;
    if backward {
        uv.reverse();
        points.reverse();
        ends.reverse();
    }
    let degenerate = edge.degenerate;
    Ok(Some(Run { edge: used.edge, location: used.location, backward, degenerate, ends, uv, points, off }))
}

fn extent(points: &[Vector]) -> f64 {
    points.iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()))
}

/// The run in a plane, and how far it is off the plane at most.
fn on_plane(surface: &Surface, points: &[Vector]) -> (Vec<[f64; 2]>, f64) {
    let (origin, x, y) = surface.d1([0.0; 2]);
    let normal = cross(&x, &y);
    let from_origin = || points.iter().map(|p| sub(p, &origin));
    let uv = from_origin().map(|d| [dot(&d, &x), dot(&d, &y)]).collect();
    (uv, from_origin().map(|d| dot(&d, &normal).abs()).fold(0.0, f64::max))
}

/// The run by the edge's curve in (u, v); where that is off the edge in space, by inversion of the edge's own points.
/// And how far the run is off the surface then, at most.
fn by_curve(
    surface: &Surface,
    curve: &Curve,
    [first, last]: [f64; 2],
    range: [f64; 2],
    line: &Polyline,
    points: &[Vector],
    limit: f64,
) -> (Vec<[f64; 2]>, f64) {
    let same = first == range[0] && last == range[1];
    let scale = (last - first) / (range[1] - range[0]);
    let (mut out, mut most) = (Vec::with_capacity(points.len()), 0.0f64);
    for (&t, point) in line.parameters.iter().zip(points) {
        let [u, v, _] = curve.point(if same { t } else { first + (t - range[0]) * scale });
        let mut uv = [u, v];
        let from_surface = |uv: &[f64; 2]| length(&sub(point, &surface.point(*uv)));
        let mut off = from_surface(&uv);
        if off > limit
            && let Some(better) = near(surface, point, uv)
            && from_surface(&better) < 0.5 * off
        {
            (uv, off) = (better, from_surface(&better));
        }
        most = most.max(off);
        out.push(uv);
    }
    (out, most)
}

/// The same, of an edge without a curve in (u, v).
fn by_points(surface: &Surface, points: &[Vector]) -> Option<(Vec<[f64; 2]>, f64)> {
    let size = extent(points);
    let domain = surface.domain(size);
    let (mut out, mut most): (Vec<[f64; 2]>, f64) = (Vec::with_capacity(points.len()), 0.0);
    for point in points {
        let found = out.last().and_then(|before| near(surface, point, *before));
        let from_surface = |uv: &[f64; 2]| length(&sub(point, &surface.point(*uv)));
        let uv = found.filter(|uv| from_surface(uv) <= 1e-4 * size).or_else(|| anywhere(surface, point, domain))?;
        most = most.max(from_surface(&uv));
        out.push(uv);
    }
    Some((out, most))
}
