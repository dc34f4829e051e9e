//! The mesh of a model: each edge once, then each underlying face once, on all threads.
//!
//! Chords that are too coarse for one of their faces, or cross there, are divided for all faces that share them; these
//! faces are then meshed again.

mod chord_errors;
mod one_face;
mod rounds;
mod tessellation;

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::edges::Polyline;
use crate::mesh::Fault;
use crate::model::Model;
use crate::shapes::Face;
pub use chord_errors::ChordErrors;
use rounds::meshed;
pub use tessellation::{MeshedFace, Tessellation, Watch};

/// Limit on the steps that one face takes in all rounds: 16 million triangles take half of them, most faces a few
/// thousand. From half of them on, its mesh is drawn as it is by then.
const MOST_STEPS: u64 = 1 << 29;
/// Limit on the points of all edges and all faces: 16 million triangles, about 4 GB of a drawing.
const MOST_POINTS: usize = 8_000_000;
/// Chord error by the size of a face: below it, the wish is the reason that a face needs too many points. Above it, its
/// surface is, and another mesher may fare better.
const ABSURD: f64 = 1e-5;

/// Limits on a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Points of all edges and all faces.
    pub points: usize,
    /// Steps that one face takes.
    pub steps: u64,
}

/// The limits that hold but for tests.
pub const LIMITS: Limits = Limits { points: MOST_POINTS, steps: MOST_STEPS };

/// Why there is no mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ended {
    /// The caller stopped the work.
    Stopped,
    /// The mesh would have more points than the limit.
    TooFine,
}

/// The mesh of a model for chord errors and a turning angle in radians.
pub fn tessellate(
    model: &Model,
    errors: &ChordErrors,
    angle: f64,
    limits: Limits,
    watch: &Watch,
) -> Result<Tessellation, Ended> {
    let used = AtomicUsize::new(0);
    let full = || used.load(Ordering::Relaxed) > limits.points;
    let stopped = || full() || (watch.stopped)();
    let limited = Watch { stopped: &stopped, done: watch.done };
    let made = meshed(model, errors, angle, &used, limits.steps, &limited);
    // Points are only ever added, and each edge and face has as many on any number of threads.
    if full() {
        return Err(Ended::TooFine);
    }
    let made = made.ok_or(Ended::Stopped)?;
    let refused = |(i, face): (usize, &MeshedFace)| {
        face.fault == Some(Fault::TooFine) && errors.whole < ABSURD * extent(&model.faces[i], &made.lines)
    };
    if made.faces.iter().enumerate().any(refused) { Err(Ended::TooFine) } else { Ok(made) }
}

/// The diagonal of the box around the border of a face.
fn extent(face: &Face, lines: &[Option<Polyline>]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let border = face.wires.iter().flatten().filter_map(|used| lines[used.edge as usize].as_ref());
    for point in border.flat_map(|line| &line.points) {
        for k in 0..3 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    (0..3).map(|k| (high[k] - low[k]).max(0.0).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests;
