//! Parts cut by a plane: what lies beyond it is taken away, and bodies are closed there by planar faces.
//!
//! 1. A coarse mesh of the part says how the plane runs through each face (`trace`), and its signs at the corners of that
//!    mesh decide all that is a matter of topology: what lies on the plane, within `Plane::near`, counts as kept.
//! 2. Edges are divided where their curves pass through the plane (`edge_pieces`), and faces get new edges there: lines,
//!    circles and ellipses where these are exact, else splines (`section_curve`).
//! 3. Edges that are left with a face on one side only border the faces on the plane (`loops`).
//!
//! A face in the plane stays where the body lies below it, and goes where the body lies beyond it. An edge in the plane
//! from which a face rises is a border of the section as it is.

mod assemble;
mod border;
mod caps;
mod check;
mod edge_pieces;
mod loops;
mod made;
mod near_misses;
mod plane;
mod regions;
mod section_curve;
mod section_point;
mod section_spline;
mod separate;
mod shares;
mod trace;

use std::sync::atomic::AtomicUsize;

use rayon::prelude::*;

use crate::body::{Body, model_of};
use crate::geometry::vector::{Vector, dot, length, sub};
use crate::model::Model;
use crate::tessellate::{Ended, LIMITS, Watch, tessellate};
use border::Border;
use edge_pieces::{Pieces, divided, extremes};
use near_misses::{edge_misses, misses};
pub use plane::Plane;
use regions::Regions;
use shares::{Share, Shares};
use trace::section;

/// Of the size of a body: chord error of the mesh that leads the way.
const GUIDE: f64 = 1e-4;
/// Chord errors of that mesh by which a surface may bulge beyond it.
const BULGE: f64 = 2.0;
/// Radians from chord to chord of that mesh.
const GUIDE_ANGLE: f64 = 0.2;

/// Why a part is not cut whose faces are triangles alone.
pub const BARE: &str = "its faces are triangles without surfaces";

const NEARLY: &str = "the plane nearly touches it";

/// What a plane leaves of a part.
pub enum Cut {
    /// It does not reach beyond the plane.
    Whole,
    Gone,
    /// Its pieces, one or several.
    Pieces(Vec<Body>),
    /// It cannot be cut here: why.
    Failed(&'static str),
    Stopped,
}

/// Cuts a part of a model, in its own frame.
pub fn cut(model: &Model, part: usize, plane: &Plane, stopped: &(dyn Fn() -> bool + Sync)) -> Cut {
    match try_cut(model, part, plane, stopped) {
        Ok(cut) => cut,
        Err(why) => Cut::Failed(why),
    }
}

fn try_cut(
    model: &Model,
    part: usize,
    plane: &Plane,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Cut, &'static str> {
    if model.parts[part].faces.iter().any(|face| model.faces[face.face as usize].surface.is_none()) {
        return Err(BARE);
    }
    let mut body = Body::of_part(model, part)?;
    if !is_closed(&body) {
        return Err("it is no closed body");
    }
    for edge in &mut body.edges {
        edge.joints = extremes(edge, &plane.normal);
    }
    let size = size(&body);
    let guide = model_of(vec![body.clone()], false);
    let watch = Watch { stopped, done: &AtomicUsize::new(0) };
    let guided = match tessellate(&guide, GUIDE * size, GUIDE_ANGLE, LIMITS, &watch) {
        Ok(guided) => guided,
        Err(Ended::Stopped) => return Ok(Cut::Stopped),
        Err(Ended::TooFine) => return Err("its mesh is too fine"),
    };
    if guided.faces.iter().any(|face| face.fault.is_some()) {
        return Err("a face has no mesh");
    }
    body.edges.iter_mut().for_each(|edge| edge.joints.clear());
    let mut vertices = vertices(&body, &guided.lines)?;
    let mut pieces = Vec::with_capacity(body.edges.len());
    for (edge, line) in body.edges.iter().zip(&guided.lines) {
        let line = line.as_ref().ok_or("an edge has no curve")?;
        let ends = edge.ends.map(|end| end.map_or(0, |(vertex, _)| vertex));
        let found = divided(edge, line, ends, plane, &mut vertices);
        if edge.curve.is_none() && !found.breaks.is_empty() {
            return Err("an edge has no curve in space");
        }
        if edge_misses(edge, line, &found, plane, BULGE * GUIDE * size) {
            return Err(NEARLY);
        }
        pieces.push(found);
    }
    let border = Border { edges: &body.edges, lines: &guided.lines, pieces: &pieces };
    let mut shares = Vec::with_capacity(body.faces.len());
    for (own, found) in body.faces.iter().zip(&guided.faces) {
        if misses(&own.face, found, plane, BULGE * GUIDE * size) {
            return Err(NEARLY);
        }
        shares.push(share(&own.face, own.reversed, found, &border, plane, &mut vertices)?);
    }
    if shares.iter().all(|share| matches!(share, Share::Whole)) {
        return Ok(Cut::Whole);
    }
    let found = Shares { body: &body, guided: &guided, pieces: &pieces, shares: &shares, vertices: &vertices };
    let Some(left) = assemble::assembled(&found, plane, size)? else { return Ok(Cut::Gone) };
    let checked = check::check(&body, &guided, &left, plane, GUIDE * size, GUIDE_ANGLE, &watch);
    if stopped() {
        return Ok(Cut::Stopped);
    }
    checked.map(|()| Cut::Pieces(left))
}

fn share(
    face: &crate::shapes::Face,
    reversed: bool,
    found: &crate::tessellate::MeshedFace,
    border: &Border,
    plane: &Plane,
    vertices: &mut Vec<Vector>,
) -> Result<Share, &'static str> {
    let mesh = &found.mesh;
    if mesh.triangles.is_empty() {
        // A face of no area goes with its edges.
        let used = || face.wires.iter().flatten().map(|used| &border.pieces[used.edge as usize]);
        let gone = |pieces: &Pieces| pieces.kept.is_empty();
        return match (used().any(gone), used().all(gone), used().all(|pieces| pieces.breaks.is_empty())) {
            (false, _, true) => Ok(Share::Whole),
            (_, true, true) => Ok(Share::Gone),
            _ => Err("a face of no area lies across the plane"),
        };
    }
    let corners = || mesh.triangles.iter().flatten().map(|&i| &mesh.points[i as usize]);
    if corners().all(|p| !plane.is_beyond(p)) {
        if corners().all(|p| plane.holds(p)) {
            let upward: f64 = mesh
                .triangles
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|i| mesh.points[i as usize]);
                    dot(&crate::geometry::vector::cross(&sub(&b, &a), &sub(&c, &a)), &plane.normal)
                })
                .sum();
            return Ok(if (upward > 0.0) != reversed { Share::Whole } else { Share::Gone });
        }
        return Ok(Share::Whole);
    }
    if corners().all(|p| plane.is_beyond(p)) {
        return Ok(Share::Gone);
    }
    let regions = Regions::new(face, found, border, plane);
    let section = section(face, found, border, &regions, plane, vertices)?;
    Ok(Share::Part(Box::new((section, regions))))
}

/// Whether each edge is used as often in one sense as in the other.
fn is_closed(body: &Body) -> bool {
    let mut sums = vec![0i32; body.edges.len()];
    for face in &body.faces {
        for used in face.face.wires.iter().flatten() {
            sums[used.edge as usize] += shares::sense(used.orientation, face.reversed);
        }
    }
    !body.faces.is_empty() && sums.iter().zip(&body.edges).all(|(sum, edge)| *sum == 0 || edge.degenerate)
}

/// The diagonal of the box around the edges' ends and some points between them.
fn size(body: &Body) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut add = |p: &Vector| {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
        }
    };
    for edge in &body.edges {
        edge.end_points.iter().flatten().for_each(&mut add);
        if let Some(curve) = &edge.curve {
            (1..4)
                .for_each(|k| add(&curve.point(edge.range[0] + 0.25 * f64::from(k) * (edge.range[1] - edge.range[0]))));
        }
    }
    length(&sub(&high, &low))
}

/// The places of a body's vertices.
fn vertices(body: &Body, lines: &[Option<crate::edges::Polyline>]) -> Result<Vec<Vector>, &'static str> {
    let count = body.edges.iter().flat_map(|edge| edge.ends).flatten().map(|(vertex, _)| vertex + 1).max();
    let mut out = vec![[f64::NAN; 3]; count.unwrap_or(0) as usize];
    for (edge, line) in body.edges.iter().zip(lines) {
        let line = line.as_ref().ok_or("an edge has no curve")?;
        for (k, at) in [0, line.points.len() - 1].into_iter().enumerate() {
            if let Some((vertex, _)) = edge.ends[k] {
                out[vertex as usize] = line.points[at];
            }
        }
    }
    Ok(out)
}

/// Cuts several parts, each by its plane, side by side.
pub fn cut_all(model: &Model, cuts: &[(usize, Plane)], stopped: &(dyn Fn() -> bool + Sync)) -> Vec<Cut> {
    cuts.par_iter().map(|(part, plane)| cut(model, *part, plane, stopped)).collect()
}
