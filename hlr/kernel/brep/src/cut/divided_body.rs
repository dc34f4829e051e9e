//! What a plane keeps of each edge and of each face of a body.

use super::border::Border;
use super::edge_pieces::{Pieces, divided};
use super::near_misses::{edge_misses, misses};
use super::plane::Plane;
use super::regions::Regions;
use super::trace::{Section, section};
use crate::body::{Body, BodyFace};
use crate::geometry::vector::{Vector, cross, dot, sub};
use crate::tessellate::{MeshedFace, Tessellation};

const NEARLY: &str = "the plane nearly touches it";

/// What is left of a face.
pub enum Left {
    Whole,
    Nothing,
    Part(Box<(Section, Regions)>),
}

/// A body and its coarse mesh, as a plane divides them.
pub struct DividedBody {
    pub body: Body,
    pub coarse: Tessellation,
    /// By edge.
    pub pieces: Vec<Pieces>,
    /// By face.
    pub left: Vec<Left>,
    /// Places of all vertices.
    pub vertices: Vec<Vector>,
}

impl DividedBody {
    /// bulge: how far surfaces may reach beyond the mesh; seams: as of `Regions::new`.
    ///
    /// # Errors
    /// Why the body cannot be divided.
    pub fn new(
        body: Body,
        coarse: Tessellation,
        plane: &Plane,
        bulge: f64,
        seams: bool,
    ) -> Result<DividedBody, &'static str> {
        let mut vertices = vertices(&body, &coarse)?;
        let mut pieces = Vec::with_capacity(body.edges.len());
        for (edge, line) in body.edges.iter().zip(&coarse.lines) {
            let line = line.as_ref().ok_or("an edge has no curve")?;
            let ends = edge.ends.map(|end| end.map_or(0, |(vertex, _)| vertex));
            let found = divided(edge, line, ends, plane, &mut vertices);
            if edge.curve.is_none() && !found.breaks.is_empty() {
                return Err("an edge has no curve in space");
            }
            if edge_misses(edge, line, &found, plane, bulge) {
                return Err(NEARLY);
            }
            pieces.push(found);
        }
        let border = Border { edges: &body.edges, lines: &coarse.lines, pieces: &pieces };
        let mut left = Vec::with_capacity(body.faces.len());
        for (own, found) in body.faces.iter().zip(&coarse.faces) {
            if misses(&own.face, found, plane, bulge) {
                return Err(NEARLY);
            }
            left.push(left_of(own, found, &border, plane, seams, &mut vertices)?);
        }
        Ok(DividedBody { body, coarse, pieces, left, vertices })
    }

    /// Whether all of the body is left.
    pub fn is_whole(&self) -> bool {
        self.left.iter().all(|left| matches!(left, Left::Whole))
    }
}

/// The places of a body's vertices.
fn vertices(body: &Body, coarse: &Tessellation) -> Result<Vec<Vector>, &'static str> {
    let count = body.edges.iter().flat_map(|edge| edge.ends).flatten().map(|(vertex, _)| vertex + 1).max();
    let mut out = vec![[f64::NAN; 3]; count.unwrap_or(0) as usize];
    for (edge, line) in body.edges.iter().zip(&coarse.lines) {
        let line = line.as_ref().ok_or("an edge has no curve")?;
        for (end, at) in edge.ends.into_iter().zip([0, line.points.len() - 1]) {
            if let Some((vertex, _)) = end {
                out[vertex as usize] = line.points[at];
            }
        }
    }
    Ok(out)
}

fn left_of(
    own: &BodyFace,
    found: &MeshedFace,
    border: &Border,
    plane: &Plane,
    seams: bool,
    vertices: &mut Vec<Vector>,
) -> Result<Left, &'static str> {
    let mesh = &found.mesh;
    if mesh.triangles.is_empty() {
        return of_no_area(own, border);
    }
    let corners = || mesh.triangles.iter().flatten().map(|&i| &mesh.points[i as usize]);
    if corners().all(|p| plane.is_beyond(p)) {
        return Ok(Left::Nothing);
    }
    if corners().any(|p| plane.is_beyond(p)) {
        let regions = Regions::new(&own.face, found, border, plane, seams);
        let section = section(&own.face, found, border, &regions, plane, vertices)?;
        return Ok(Left::Part(Box::new((section, regions))));
    }
    // A face in the plane stays where the body lies below it.
    let is_in_plane = corners().all(|p| plane.holds(p));
    Ok(if is_in_plane && is_turned_up(found, plane) == own.reversed { Left::Nothing } else { Left::Whole })
}

/// What is left of a face of no area: it goes with its edges.
fn of_no_area(own: &BodyFace, border: &Border) -> Result<Left, &'static str> {
    let used = || own.face.wires.iter().flatten().map(|used| &border.pieces[used.edge as usize]);
    let across = used().any(|pieces| !pieces.breaks.is_empty());
    match (used().all(|pieces| !pieces.kept.is_empty()), used().all(|pieces| pieces.kept.is_empty())) {
        (true, _) if !across => Ok(Left::Whole),
        (_, true) if !across => Ok(Left::Nothing),
        _ => Err("a face of no area lies across the plane"),
    }
}

/// Whether the normals of a mesh, counterclockwise in (u, v), point to where that of the plane does.
fn is_turned_up(found: &MeshedFace, plane: &Plane) -> bool {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| found.mesh.points[i as usize]);
        dot(&cross(&sub(&b, &a), &sub(&c, &a)), &plane.normal)
    };
    found.mesh.triangles.iter().map(of).sum::<f64>() > 0.0
}
