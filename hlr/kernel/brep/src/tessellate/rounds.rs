//! Rounds of meshing: the faces are meshed, the chords that they find too coarse are divided, and all faces that share
//! these are meshed again.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use rayon::prelude::*;

use super::chord_errors::ChordErrors;
use super::one_face::{Divisible, Tried, coarser, failed, try_face};
use super::tessellation::{MeshedFace, Tessellation, Watch};
use crate::copied_points::{copy_points, of_originals};
use crate::each_face::each_face;
use crate::edges::{Polyline, polyline};
use crate::mesh::{Done, Fault, Interrupted, Progress, border_share};
use crate::model::Model;

/// Limit on the rounds in which chords are divided.
const MOST_ROUNDS: usize = 12;
/// Limit on the rounds in which the chords of a face are divided because they are too coarse, and on those in which they
/// are because its chord error could not be proved: either its chords or its surface may be the reason.
const ROUNDS_UNCERTIFIED: usize = 6;
/// Limit on the rounds for two chords that lie upon one another: no division parts such edges.
const ROUNDS_UPON: usize = 4;
/// Where the steps run out before there is any mesh, the face is meshed for a larger chord error (`MESH_COARSER`). One
/// of so many parts of the steps is for that, in each round anew: chords may be divided for the face on their other
/// side.
const PARTS: u64 = 16;
/// An edge with more corners is not divided any further.
const MOST_CORNERS: usize = 100_000;

/// The mesh; None if it was stopped. `used`: points so far. `most_steps`: of one face.
pub fn meshed(
    model: &Model,
    errors: &ChordErrors,
    angle: f64,
    used: &AtomicUsize,
    most_steps: u64,
    watch: &Watch,
) -> Option<Tessellation> {
    let lines = lines_of_edges(model, errors, angle, used, watch)?;
    let faces = model.faces.len();
    let mut rounds = Rounds {
        model,
        errors,
        angle,
        used,
        most_steps,
        watch,
        lines,
        faces: vec![MeshedFace::default(); faces],
        settled: BTreeSet::new(),
        unproved: vec![0; faces],
        taken: (0..faces).map(|_| AtomicU64::new(0)).collect(),
        told: (0..faces).map(|_| AtomicUsize::new(0)).collect(),
    };
    let faces_of = faces_of_edges(model);
    let mut wanted: Vec<usize> = (0..faces).collect();
    for round in 0..=MOST_ROUNDS {
        let work = |i| rounds.try_one(i, round);
        let tries = each_face(&mut wanted, model, &rounds.lines, work, watch.stopped)?;
        let (coarse, waiting) = rounds.take(tries, round);
        let changed = rounds.divide(coarse);
        let mut again: BTreeSet<usize> = changed.iter().flat_map(|&e| faces_of[e as usize].iter().copied()).collect();
        for i in waiting {
            if again.insert(i) {
                rounds.settled.insert(i);
            }
        }
        wanted = again.into_iter().collect();
        if wanted.is_empty() {
            break;
        }
    }
    Some(Tessellation { lines: rounds.lines, faces: rounds.faces })
}

/// The edges and faces of a model as far as they are meshed.
struct Rounds<'a> {
    model: &'a Model,
    errors: &'a ChordErrors,
    angle: f64,
    /// Points of all edges and faces.
    used: &'a AtomicUsize,
    /// Of one face, in all rounds.
    most_steps: u64,
    watch: &'a Watch<'a>,
    lines: Vec<Option<Polyline>>,
    faces: Vec<MeshedFace>,
    /// Faces whose coarse chords cannot be divided any further: they are meshed with these chords.
    settled: BTreeSet<usize>,
    /// Of each face: the rounds in which it was meshed without a proof of its chord error.
    unproved: Vec<usize>,
    /// Of each face: the steps that it took.
    taken: Vec<AtomicU64>,
    /// Of each face: the units of progress that were told.
    told: Vec<AtomicUsize>,
}

impl Rounds<'_> {
    /// Meshes a face with the chords as they are; None where the work was stopped.
    fn try_one(&self, i: usize, round: usize) -> Option<Tried> {
        let (model, face, stopped) = (self.model, &self.model.faces[i], self.watch.stopped);
        let error = self.errors.faces[i];
        let divisible = Divisible {
            coarse: round < MOST_ROUNDS && !self.settled.contains(&i),
            upon_one_another: round < ROUNDS_UPON,
        };
        let left = self.most_steps.saturating_sub(self.taken[i].load(Ordering::Relaxed));
        let told = Some(Done { all: self.watch.done, face: &self.told[i] });
        let steps = Progress::new(stopped, told, left);
        let tried = steps.watched(|| try_face(model, face, &self.lines, error, self.angle, divisible, &steps));
        self.taken[i].fetch_add(steps.count(), Ordering::Relaxed);
        let tried = match tried {
            Err(Interrupted::TooMuch) => {
                let few = Progress::half_spent(stopped, told, self.most_steps / PARTS);
                few.watched(|| coarser(model, face, &self.lines, error, self.angle, &few))
            }
            tried => tried,
        };
        let tried = match tried {
            Ok(tried) => tried,
            Err(Interrupted::TooMuch) => failed(Fault::TooMuchWork, Vec::new()),
            Err(Interrupted::Stopped) => return None,
        };
        let (now, before) = (tried.face.mesh.points.len(), self.faces[i].mesh.points.len());
        self.used.fetch_add(now.saturating_sub(before), Ordering::Relaxed);
        if !tried.waits {
            steps.reached(1.0);
        }
        Some(tried)
    }

    /// Keeps the meshes of a round. Returns the chords to be divided, as edge and number along it, and the faces that
    /// wait for that.
    fn take(&mut self, tries: Vec<(usize, Tried)>, round: usize) -> (BTreeSet<(u32, u32)>, Vec<usize>) {
        let (mut divided, mut waiting) = (BTreeSet::new(), Vec::new());
        for (i, Tried { face, coarse, waits }) in tries {
            if waits {
                waiting.push(i);
            }
            let rounds = match face.fault {
                _ if waits => round,
                Some(Fault::NotCertified(..)) => {
                    self.unproved[i] += 1;
                    self.unproved[i] - 1
                }
                _ => 0,
            };
            if round < MOST_ROUNDS && rounds < ROUNDS_UNCERTIFIED {
                divided.extend(coarse);
            }
            self.faces[i] = face;
        }
        (divided, waiting)
    }

    /// Divides chords, on the edges that have copies and on the copies. Returns the edges that have changed.
    fn divide(&mut self, chords: BTreeSet<(u32, u32)>) -> BTreeSet<u32> {
        let (model, lines) = (self.model, &mut self.lines);
        let mut changed = BTreeSet::new();
        for (edge, chords) in by_edge(&of_originals(chords, &model.edges, lines)) {
            if let Some(line) = &mut lines[edge as usize]
                && line.points.len() < MOST_CORNERS
                && line.divide(model, &model.edges[edge as usize], &chords, self.errors.edges[edge as usize])
            {
                changed.insert(edge);
            }
        }
        let copied = copy_points(&model.edges, lines, |edge| changed.contains(&edge));
        changed.extend(copied);
        changed
    }
}

/// The polylines of all edges; None where the work was stopped.
fn lines_of_edges(
    model: &Model,
    errors: &ChordErrors,
    angle: f64,
    used: &AtomicUsize,
    watch: &Watch,
) -> Option<Vec<Option<Polyline>>> {
    let mut lines: Vec<Option<Polyline>> = model
        .edges
        .par_iter()
        .zip(&shares_of_edges(model))
        .zip(&errors.edges)
        .map(|((edge, share), error)| {
            if (watch.stopped)() {
                return None;
            }
            let line = polyline(model, edge, share * error, angle);
            used.fetch_add(line.as_ref().map_or(0, |line| line.points.len()), Ordering::Relaxed);
            line
        })
        .collect();
    if (watch.stopped)() {
        return None;
    }
    copy_points(&model.edges, &mut lines, |_| true);
    Some(lines)
}

fn by_edge(divided: &BTreeSet<(u32, u32)>) -> Vec<(u32, Vec<usize>)> {
    let all: Vec<(u32, u32)> = divided.iter().copied().collect();
    all.chunk_by(|a, b| a.0 == b.0).map(|group| (group[0].0, group.iter().map(|c| c.1 as usize).collect())).collect()
}

/// Share of the chord error asked for that the chords of each edge may use: the smallest share of its faces.
fn shares_of_edges(model: &Model) -> Vec<f64> {
    let mut shares = vec![1.0f64; model.edges.len()];
    for face in &model.faces {
        let share = face.surface.as_ref().map_or(1.0, border_share);
        for used in face.wires.iter().flatten() {
            shares[used.edge as usize] = shares[used.edge as usize].min(share);
        }
    }
    for (i, edge) in model.edges.iter().enumerate() {
        if let Some((original, _)) = edge.original {
            shares[original as usize] = shares[original as usize].min(shares[i]);
        }
    }
    shares
}

fn faces_of_edges(model: &Model) -> Vec<Vec<usize>> {
    let mut out = vec![Vec::new(); model.edges.len()];
    for (i, face) in model.faces.iter().enumerate() {
        for used in face.wires.iter().flatten() {
            let list: &mut Vec<usize> = &mut out[used.edge as usize];
            if list.last() != Some(&i) {
                list.push(i);
            }
        }
    }
    out
}
