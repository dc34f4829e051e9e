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
mod builder;
mod caps;
mod check;
mod divided_body;
mod edge_pieces;
mod enclosed;
mod joined;
mod loops;
mod near_misses;
mod plane;
mod regions;
mod section_curve;
mod section_point;
mod section_spline;
mod separate;
mod trace;

use std::collections::HashSet;
use std::iter::once;
use std::sync::atomic::AtomicUsize;

use rayon::prelude::*;

use crate::body::{Body, model_of};
use crate::model::Model;
use crate::tessellate::{ChordErrors, Ended, LIMITS, Watch, tessellate};
use assemble::assembled;
use check::check;
use divided_body::DividedBody;
use edge_pieces::extremes;
use hlr_accuracy::CUT_BULGE;
pub use plane::Plane;
use plane::ROUNDING;

/// Of the size of a body: chord error of the coarse mesh.
const COARSE: f64 = 1e-4;
/// Radians from chord to chord of that mesh.
const COARSE_ANGLE: f64 = 0.2;

/// Why a part is not cut whose faces are triangles alone.
pub const BARE: &str = "its faces are triangles without surfaces";

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
    let body = Body::of_part(model, part)?;
    if !body.is_closed() {
        return Err("it is no closed body");
    }
    if body.solids == 0 && body.is_nested() {
        return Err("one body of its faces lies within another");
    }
    let moved = through_a_corner(&body, plane);
    let beside = moved.filter(|moved| (moved.level - plane.level).abs() > ROUNDING * body.size());
    // A plane that runs beside a corner by rounding alone runs through it.
    let plane = if beside.is_none() { moved.as_ref().unwrap_or(plane) } else { plane };
    let cut = cut_body(&body, plane, How { films: true, seams: true }, stopped);
    if cut.is_ok() {
        return cut;
    }
    let mut tries: Vec<(&Plane, bool)> = beside.iter().map(|moved| (moved, true)).collect();
    if has_seams(&body) {
        tries.extend(once((plane, false)).chain(beside.iter().map(|moved| (moved, false))));
    }
    // Beside a seam that is not quite in one plane, a film may be left.
    let how = |seams| How { films: false, seams };
    tries
        .into_iter()
        .map(|(plane, seams)| cut_body(&body, plane, how(seams), stopped))
        .find(Result::is_ok)
        .unwrap_or(cut)
}

/// Whether a face uses an edge twice.
fn has_seams(body: &Body) -> bool {
    let mut used: HashSet<u32> = HashSet::new();
    body.faces.iter().any(|own| {
        used.clear();
        own.face.wires.iter().flatten().any(|each| !used.insert(each.edge))
    })
}

/// How a body is cut. A narrow strip beside a seam, and half a ball with the seam in its middle, are cut where faces end at
/// their seams; others are not, or the seam would be an edge of what is left.
///
/// films: as of `check`; seams: whether faces go on across their seams
#[derive(Clone, Copy)]
struct How {
    films: bool,
    seams: bool,
}

/// The plane through the lowest of the corners that lie on it, where it runs beside that. A sphere whose seam lies
/// nearly in the plane is cut along the seam: between the two, what is left of the sphere would be too narrow to follow.
///
/// It runs through a corner exactly. In the middle of several that differ by rounding alone it would run through none.
fn through_a_corner(body: &Body, plane: &Plane) -> Option<Plane> {
    let ends = body.edges.iter().flat_map(|edge| edge.end_points).flatten();
    let lowest = ends.filter(|point| plane.holds(point)).map(|point| plane.height(&point)).reduce(f64::min)?;
    (lowest != 0.0).then_some(Plane { level: plane.level + lowest, ..*plane })
}

fn cut_body(body: &Body, plane: &Plane, how: How, stopped: &(dyn Fn() -> bool + Sync)) -> Result<Cut, &'static str> {
    let deflection = COARSE * body.size();
    let watch = Watch { stopped, done: &AtomicUsize::new(0) };
    let cornered = with_corners(body, plane, CUT_BULGE * deflection);
    let coarse = match tessellate(&cornered, &ChordErrors::same(&cornered, deflection), COARSE_ANGLE, LIMITS, &watch) {
        Ok(coarse) => coarse,
        Err(Ended::Stopped) => return Ok(Cut::Stopped),
        Err(Ended::TooFine) => return Err("its mesh is too fine"),
    };
    if coarse.faces.iter().any(|face| face.fault.is_some()) {
        return Err("a face has no mesh");
    }
    let divided = DividedBody::new(body.clone(), coarse, plane, CUT_BULGE * deflection, how.seams)?;
    if divided.is_whole() {
        return Ok(Cut::Whole);
    }
    let Some(pieces) = assembled(&divided, plane)? else { return Ok(Cut::Gone) };
    let checked = check(&divided, &pieces, plane, how.films, deflection, COARSE_ANGLE, &watch);
    if stopped() {
        return Ok(Cut::Stopped);
    }
    checked.map(|()| Cut::Pieces(pieces))
}

/// A body as a model, with corners where its edges lie farthest along the normal of the plane, within reach of it.
fn with_corners(body: &Body, plane: &Plane, reach: f64) -> Model {
    let mut body = body.clone();
    for edge in &mut body.edges {
        edge.joints = extremes(edge, plane, reach);
    }
    model_of(vec![body], false)
}

/// Cuts several parts, each by its plane, side by side.
pub fn cut_all(model: &Model, cuts: &[(usize, Plane)], stopped: &(dyn Fn() -> bool + Sync)) -> Vec<Cut> {
    cuts.par_iter().map(|(part, plane)| cut(model, *part, plane, stopped)).collect()
}
