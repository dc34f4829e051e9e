//! The new faces on the plane: what edges with a face on one side only enclose there.

use super::builder::BodyBuilder;
use super::loops::{Side, faces};
use super::plane::Plane;
use crate::body::BodyFace;
use crate::format::{Orientation, SurfaceRecord};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, dot};
use crate::shapes::{Edge, Face, Use};

/// Chords by which an edge is judged that is no line, and by which each span of a spline is.
const CHORDS: usize = 48;
const OF_SPAN: usize = 4;
/// Of the size of a body: the width of a section that nobody sees.
const THIN: f64 = 1e-8;

/// Adds the faces on the plane.
///
/// # Errors
/// Why they cannot be found.
pub fn caps(made: &mut BodyBuilder, plane: &Plane, size: f64) -> Result<(), &'static str> {
    let alone: Vec<usize> =
        (0..made.sums.len()).filter(|&i| made.sums[i] != 0 && !made.body.edges[i].degenerate).collect();
    let axes = plane.axes();
    let mut sides = Vec::with_capacity(alone.len());
    let mut uses = Vec::with_capacity(alone.len());
    for &i in &alone {
        if made.sums[i].abs() != 1 || !made.on_plane[i] {
            return Err("its section does not close");
        }
        let edge = &made.body.edges[i];
        let mut ends = edge.ends.map(|end| end.map_or(u32::MAX, |(vertex, _)| vertex));
        let mut points = corners(edge).ok_or("an edge has no curve")?;
        let orientation = if made.sums[i] < 0 { Orientation::Forward } else { Orientation::Reversed };
        let of_edge = ends.map(|vertex| (vertex, 0));
        uses.push(Use { edge: i as u32, location: 0, place: None, orientation, ends: of_edge, curve2: None });
        if orientation == Orientation::Reversed {
            points.reverse();
            ends.reverse();
        }
        sides.push(Side { ends, points: points.iter().map(|p| axes.map(|axis| dot(&axis, p))).collect() });
    }
    let thin = THIN * size + plane.near;
    for loops in faces(&sides, thin)? {
        let wires: Vec<Vec<Use>> = loops.iter().map(|chain| chain.iter().map(|&k| uses[k].clone()).collect()).collect();
        let start = made.body.edges[wires[0][0].edge as usize].end_points[0].ok_or("an edge has no vertex")?;
        let data = [plane.foot(&start), axes[0], axes[1], plane.normal].concat();
        let surface = Surface::read(PLANE, &data);
        let record = Some(SurfaceRecord { kind: PLANE, data });
        let face = Face { record, surface, tolerance: plane.near, wires, own: None, no_area: false };
        made.add_face(BodyFace { face, reversed: false, of: None });
    }
    Ok(())
}

const PLANE: u8 = 1;

/// Points along an edge, both ends included.
fn corners(edge: &Edge) -> Option<Vec<Vector>> {
    let curve = edge.curve.as_ref()?;
    let count = match curve {
        Curve::Line { .. } => 1,
        Curve::Spline(spline) => CHORDS.max(OF_SPAN * spline.poles.len()),
        _ => CHORDS,
    };
    let [first, last] = edge.range;
    let mut points: Vec<Vector> =
        (0..=count).map(|k| curve.point(first + (last - first) * k as f64 / count as f64)).collect();
    for (place, end) in [(0, edge.end_points[0]), (count, edge.end_points[1])] {
        points[place] = end.unwrap_or(points[place]);
    }
    Some(points)
}
