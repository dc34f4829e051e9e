//! Puts together what a plane leaves of a body: faces, new faces on the plane, and pieces that hang together.

use rustc_hash::FxHashMap;

use super::builder::BodyBuilder;
use super::caps::caps;
use super::divided_body::{DividedBody, Left};
use super::plane::Plane;
use super::regions::Regions;
use super::section_curve::section_curve;
use super::separate::separate;
use super::trace::Section;
use crate::body::{Body, BodyFace};
use crate::format::Orientation;
use crate::shapes::{Edge, Face, Use};

/// The bodies that are left; None: nothing is.
///
/// # Errors
/// Why they cannot be put together.
pub fn assembled(divided: &DividedBody, plane: &Plane) -> Result<Option<Vec<Body>>, &'static str> {
    let size = divided.body.size();
    let body = Body { curves2: divided.body.curves2.clone(), ..Body::default() };
    let mut made = BodyBuilder { body, on_plane: Vec::new(), sums: Vec::new() };
    let mut pieces = EdgePieces { divided, known: FxHashMap::default() };
    for (own, left) in divided.body.faces.iter().zip(&divided.left) {
        let faces: Vec<Vec<Vec<Use>>> = match left {
            Left::Nothing => continue,
            Left::Whole => {
                let of_wire = |wire: &Vec<Use>| wire.iter().flat_map(|used| pieces.uses(used, &mut made)).collect();
                vec![own.face.wires.iter().map(of_wire).collect()]
            }
            Left::Part(found) => {
                let (section, regions) = &**found;
                let found = borders(&own.face, section, regions, &mut pieces, &mut made, plane, size)?;
                found.into_iter().map(|wire| vec![wire]).collect()
            }
        };
        for wires in faces {
            made.add_face(BodyFace { face: Face { wires, ..own.face.clone() }, ..*own });
        }
    }
    caps(&mut made, plane, size)?;
    if made.body.faces.is_empty() {
        return Ok(None);
    }
    separate(made.body, divided).map(Some)
}

/// The borders of what is left of a face, one for each region: all in one wire, whose edges are put in order when it is
/// meshed.
fn borders(
    face: &Face,
    section: &Section,
    regions: &Regions,
    pieces: &mut EdgePieces,
    made: &mut BodyBuilder,
    plane: &Plane,
    size: f64,
) -> Result<Vec<Vec<Use>>, &'static str> {
    let divided = pieces.divided;
    let mut uses = vec![Vec::new(); regions.count as usize];
    // Pieces with no region beside them: what is left there of the face has no area.
    let mut flat = Vec::new();
    for used in face.wires.iter().flatten() {
        let degenerate = divided.body.edges[used.edge as usize].degenerate;
        // Where the section ends at a pole, the line of the pole in (u, v) ends there, too: without an edge of its own, it
        // is as long as it has to be.
        if degenerate && section.runs.iter().any(|run| run.ends.contains(&used.ends[0].0)) {
            continue;
        }
        let line = divided.coarse.lines[used.edge as usize].as_ref().ok_or("an edge has no curve")?;
        let kept = &divided.pieces[used.edge as usize].kept;
        for (piece, own) in kept.iter().zip(pieces.uses(used, made)) {
            match regions.of_piece(used, piece, line, degenerate) {
                Some(region) => uses[region as usize].push(own),
                None if !degenerate => flat.push(own),
                None => {}
            }
        }
    }
    for &(edge, ahead) in &section.follows {
        let orientation = if ahead { Orientation::Forward } else { Orientation::Reversed };
        let own = face.wires.iter().flatten().find(|used| used.edge == edge).ok_or("an edge is missing")?;
        let follow = pieces.uses(&Use { orientation, ..own.clone() }, made);
        let [follow] = &follow[..] else { return Err("an edge lies partly in the plane") };
        let back = |used: &Use| used.orientation.sense(true) == orientation.sense(false);
        let at = flat.iter().position(|used: &Use| used.edge == follow.edge && back(used));
        flat.remove(at.ok_or("an edge lies partly in the plane")?);
    }
    match &mut uses[..] {
        [one] => one.append(&mut flat),
        _ if !flat.is_empty() => return Err("what is left of a face is too narrow"),
        _ => {}
    }
    let surface = face.surface.as_ref().ok_or("a face has no surface")?;
    for run in &section.runs {
        let ends = run.ends.map(|vertex| divided.vertices[vertex as usize]);
        let found = section_curve(surface, run, ends, plane, size)?;
        let of_run = run.ends.map(|vertex| (vertex, 0));
        let mut edge = Edge::on_curve(found.curve, found.range, of_run, plane.near);
        edge.end_points = ends.map(Some);
        let edge = made.add_edge(edge, true);
        let curve2 = found.curve2.map(|curve| {
            made.body.curves2.push(Some(curve));
            (made.body.curves2.len() - 1, found.range)
        });
        let own = Use { edge, location: 0, place: None, orientation: Orientation::Forward, ends: of_run, curve2 };
        uses[run.region as usize].push(own);
    }
    Ok(uses)
}

/// The pieces of edges that are kept, each made once.
struct EdgePieces<'a> {
    divided: &'a DividedBody,
    known: FxHashMap<(u32, usize), u32>,
}

impl EdgePieces<'_> {
    /// The use of an edge by a face as uses of its pieces.
    fn uses(&mut self, used: &Use, made: &mut BodyBuilder) -> Vec<Use> {
        let pieces = &self.divided.pieces[used.edge as usize];
        let edge = &self.divided.body.edges[used.edge as usize];
        let mut out = Vec::with_capacity(pieces.kept.len());
        for (k, piece) in pieces.kept.iter().enumerate() {
            let number = *self.known.entry((used.edge, k)).or_insert_with(|| {
                let mut part = Edge { range: piece.range, ends: piece.ends.map(|v| Some((v, 0))), ..edge.clone() };
                for (side, &vertex) in piece.ends.iter().enumerate() {
                    let is_own = edge.ends[side] == Some((vertex, 0)) && piece.range[side] == edge.range[side];
                    if !is_own {
                        part.end_points[side] = Some(self.divided.vertices[vertex as usize]);
                    }
                }
                made.add_edge(part, pieces.on)
            });
            let curve2 = used.curve2.map(|(curve, [first, last])| {
                let rate = (last - first) / (edge.range[1] - edge.range[0]);
                let whole = piece.range == edge.range;
                let at = |t: f64| first + (t - edge.range[0]) * rate;
                (curve, if whole { [first, last] } else { piece.range.map(at) })
            });
            out.push(Use { edge: number, ends: piece.ends.map(|vertex| (vertex, 0)), curve2, ..used.clone() });
        }
        out
    }
}
