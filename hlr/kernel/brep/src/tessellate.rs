//! The mesh of a model: each edge once, then each underlying face once, on all threads.
//!
//! Chords that are too coarse for one of their faces, or cross there, are divided for all faces that share them; these
//! faces are then meshed again.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use hlr_accuracy::MESH_COARSER;
use rayon::prelude::*;

use crate::copied_points::{copy_points, of_originals};
use crate::each_face::each_face;
use crate::edges::{Polyline, polyline};
use crate::faces::{Border, Node, border};
use crate::mesh::{Done, FaceMesh, Fault, Interrupted, Progress, border_share, mesh_face, upon_one_another};
use crate::model::Model;
use crate::shapes::Face;

/// Limit on the rounds in which chords are divided.
const MOST_ROUNDS: usize = 12;
/// Limit on the rounds in which the chords of a face are divided because they are too coarse, and on those in which they
/// are because its chord error could not be proved: either its chords or its surface may be the reason.
const ROUNDS_UNCERTIFIED: usize = 6;
/// Limit on the rounds for two chords that lie upon one another: no division parts such edges.
const ROUNDS_UPON: usize = 4;
/// Limit on the steps that one face takes in all rounds: 16 million triangles take half of them, most faces a few
/// thousand. From half of them on, its mesh is drawn as it is by then.
const MOST_STEPS: u64 = 1 << 29;
/// Where they run out before there is any mesh, the face is meshed for a larger chord error (`MESH_COARSER`). One of so
/// many parts of the steps is for that, in each round anew: chords may be divided for the face on their other side.
const PARTS: u64 = 16;
/// Limit on the points of all edges and all faces: 16 million triangles, about 4 GB of a drawing.
const MOST_POINTS: usize = 8_000_000;
/// Chord error by the size of a face: below it, the wish is the reason that a face needs too many points. Above it, its
/// surface is, and another mesher may fare better.
const ABSURD: f64 = 1e-5;
/// An edge with more corners is not divided any further.
const MOST_CORNERS: usize = 100_000;

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

pub struct Tessellation {
    /// Polylines by edge; None for an edge without any curve.
    pub lines: Vec<Option<Polyline>>,
    /// Meshes by face.
    pub faces: Vec<MeshedFace>,
}

#[derive(Clone, Debug, Default)]
pub struct MeshedFace {
    pub mesh: FaceMesh,
    /// The vertex or corner for each node number of the mesh.
    pub nodes: Vec<Node>,
    /// The reason if there is no mesh.
    pub fault: Option<Fault>,
    /// How far the edges of the face are off its surface, at most.
    pub off: f64,
}

/// Progress of the work, and the request to stop it.
pub struct Watch<'a> {
    pub stopped: &'a (dyn Fn() -> bool + Sync),
    /// Units done so far: `OF_A_FACE` for each face.
    pub done: &'a AtomicUsize,
}

/// The mesh of a model for a chord error and a turning angle in radians.
pub fn tessellate(
    model: &Model,
    deflection: f64,
    angle: f64,
    limits: Limits,
    watch: &Watch,
) -> Result<Tessellation, Ended> {
    let used = AtomicUsize::new(0);
    let full = || used.load(Ordering::Relaxed) > limits.points;
    let stopped = || full() || (watch.stopped)();
    let limited = Watch { stopped: &stopped, done: watch.done };
    let made = meshed(model, deflection, angle, &used, limits.steps, &limited);
    // Points are only ever added, and each edge and face has as many on any number of threads.
    if full() {
        return Err(Ended::TooFine);
    }
    let made = made.ok_or(Ended::Stopped)?;
    let refused = |(i, face): (usize, &MeshedFace)| {
        face.fault == Some(Fault::TooFine) && deflection < ABSURD * extent(&model.faces[i], &made.lines)
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

/// The mesh; None if it was stopped. `used`: points so far. `most_steps`: of one face.
fn meshed(
    model: &Model,
    deflection: f64,
    angle: f64,
    used: &AtomicUsize,
    most_steps: u64,
    watch: &Watch,
) -> Option<Tessellation> {
    let shares = shares_of_edges(model);
    let mut lines: Vec<Option<Polyline>> = model
        .edges
        .par_iter()
        .zip(&shares)
        .map(|(edge, share)| {
            if (watch.stopped)() {
                return None;
            }
            let line = polyline(model, edge, share * deflection, angle);
            used.fetch_add(line.as_ref().map_or(0, |line| line.points.len()), Ordering::Relaxed);
            line
        })
        .collect();
    if (watch.stopped)() {
        return None;
    }
    copy_points(&model.edges, &mut lines, |_| true);
    let faces_of = faces_of_edges(model);
    let mut faces: Vec<MeshedFace> = vec![MeshedFace::default(); model.faces.len()];
    let mut wanted: Vec<usize> = (0..model.faces.len()).collect();
    // Faces whose coarse chords cannot be divided any further: they are meshed with these chords.
    let mut settled: BTreeSet<usize> = BTreeSet::new();
    // Rounds in which a face was meshed without a proof of its chord error, and steps that it took.
    let mut unproved = vec![0; model.faces.len()];
    let taken: Vec<AtomicU64> = model.faces.iter().map(|_| AtomicU64::new(0)).collect();
    let told: Vec<AtomicUsize> = model.faces.iter().map(|_| AtomicUsize::new(0)).collect();
    for round in 0..=MOST_ROUNDS {
        let tries = each_face(
            &mut wanted,
            model,
            &lines,
            |i| {
                let divisible = round < MOST_ROUNDS && !settled.contains(&i);
                let same = round < ROUNDS_UPON;
                let left = most_steps.saturating_sub(taken[i].load(Ordering::Relaxed));
                let told = Some(Done { all: watch.done, face: &told[i] });
                let steps = Progress::new(watch.stopped, told, left);
                let face = &model.faces[i];
                let tried =
                    steps.watched(|| try_face(model, face, &lines, deflection, angle, [divisible, same], &steps));
                taken[i].fetch_add(steps.count(), Ordering::Relaxed);
                let tried = match tried {
                    Err(Interrupted::TooMuch) => {
                        let few = Progress::half_spent(watch.stopped, told, most_steps / PARTS);
                        few.watched(|| coarser(model, face, &lines, deflection, angle, &few))
                    }
                    tried => tried,
                };
                let tried = match tried {
                    Ok(tried) => tried,
                    Err(Interrupted::TooMuch) => failed(Fault::TooMuchWork, Vec::new()),
                    Err(Interrupted::Stopped) => return None,
                };
                let (now, before) = (tried.face.mesh.points.len(), faces[i].mesh.points.len());
                used.fetch_add(now.saturating_sub(before), Ordering::Relaxed);
                if !tried.waits {
                    steps.reached(1.0);
                }
                Some(tried)
            },
            watch.stopped,
        )?;
        let last = round == MOST_ROUNDS;
        let mut divided: BTreeSet<(u32, u32)> = BTreeSet::new();
        let mut waiting = Vec::new();
        for (i, Tried { face, coarse, waits }) in tries {
            if waits {
                waiting.push(i);
            }
            let rounds = match face.fault {
                _ if waits => round,
                Some(Fault::NotCertified(..)) => {
                    unproved[i] += 1;
                    unproved[i] - 1
                }
                _ => 0,
            };
            if !last && rounds < ROUNDS_UNCERTIFIED {
                divided.extend(coarse);
            }
            faces[i] = face;
        }
        let mut changed = BTreeSet::new();
        for (edge, chords) in by_edge(&of_originals(divided, &model.edges, &lines)) {
            if let Some(line) = &mut lines[edge as usize]
                && line.points.len() < MOST_CORNERS
                && line.divide(model, &model.edges[edge as usize], &chords, deflection)
            {
                changed.insert(edge);
            }
        }
        let copied = copy_points(&model.edges, &mut lines, |edge| changed.contains(&edge));
        changed.extend(copied);
        let mut again: BTreeSet<usize> = changed.iter().flat_map(|&e| faces_of[e as usize].iter().copied()).collect();
        for i in waiting {
            if again.insert(i) {
                settled.insert(i);
            }
        }
        wanted = again.into_iter().collect();
        if wanted.is_empty() {
            break;
        }
    }
    Some(Tessellation { lines, faces })
}

fn by_edge(divided: &BTreeSet<(u32, u32)>) -> Vec<(u32, Vec<usize>)> {
    let all: Vec<(u32, u32)> = divided.iter().copied().collect();
    all.chunk_by(|a, b| a.0 == b.0).map(|group| (group[0].0, group.iter().map(|c| c.1 as usize).collect())).collect()
}

/// Share of the deflection that the chords of each edge may use: the smallest share of its faces.
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

#[derive(Default)]
struct Tried {
    face: MeshedFace,
    /// Chords to be divided, each as edge and number along the edge.
    coarse: Vec<(u32, u32)>,
    /// The face was not meshed, because its chords are to be divided first.
    waits: bool,
}

/// A face without a mesh, and the chords to be divided.
fn failed(fault: Fault, coarse: Vec<(u32, u32)>) -> Tried {
    Tried { face: MeshedFace { fault: Some(fault), ..MeshedFace::default() }, coarse, waits: false }
}

/// Meshes one face. `divisible`: chords that are too coarse can still be divided, and the face is meshed only after
/// that. `same`: so can chords that lie upon one another.
fn try_face(
    model: &Model,
    face: &Face,
    lines: &[Option<Polyline>],
    deflection: f64,
    angle: f64,
    [divisible, same]: [bool; 2],
    steps: &Progress,
) -> Tried {
    if face.no_area {
        return Tried::default();
    }
    if let Some(own) = &face.own {
        let uv = if own.uv.is_empty() { vec![[f64::NAN; 2]; own.points.len()] } else { own.uv.clone() };
        let mesh = FaceMesh {
            uv,
            normals: vec![[0.0; 3]; own.points.len()],
            points: own.points.clone(),
            nodes: Vec::new(),
            triangles: own.triangles.clone(),
            turned: Vec::new(),
            torn: 0.0,
            unfinished: 0.0,
        };
        return Tried { face: MeshedFace { mesh, ..MeshedFace::default() }, coarse: Vec::new(), waits: false };
    }
    let Some(surface) = &face.surface else { return failed(Fault::Degenerate, Vec::new()) };
    let found = match border(model, face, lines, deflection) {
        Ok(found) => found,
        Err(fault) => return failed(fault, Vec::new()),
    };
    let coarse = if divisible { found.coarse(surface, deflection) } else { Vec::new() };
    if !coarse.is_empty() {
        return Tried { waits: true, ..failed(Fault::NotCertified(f64::INFINITY, Vec::new()), coarse) };
    }
    let Border { mut loops, nodes, chords, off } = found;
    // Two edges that consist of the same single chord enclose nothing at this deflection.
    let encloses = |l: &Vec<crate::mesh::LoopPoint>| l.len() > 2;
    let kept: Vec<usize> = (0..loops.loops.len()).filter(|&i| encloses(&loops.loops[i])).collect();
    if kept.is_empty() {
        // An edge and its own copy.
        let one = |row: &Vec<Option<(u32, u32)>>| row.iter().all(|c| c.map(|c| c.0) == row[0].map(|c| c.0));
        if chords.iter().all(one) {
            return failed(Fault::Open, Vec::new());
        }
        return Tried { face: MeshedFace { nodes, ..MeshedFace::default() }, coarse: Vec::new(), waits: false };
    }
    let chords: Vec<_> = kept.iter().map(|&i| &chords[i]).collect();
    loops.loops.retain(encloses);
    match mesh_face(surface, &loops, deflection, angle, steps) {
        Ok(mesh) => Tried { face: MeshedFace { mesh, nodes, fault: None, off }, coarse: Vec::new(), waits: false },
        Err(fault) => {
            let named: Vec<[usize; 2]> = match &fault {
                Fault::Crossing(pairs) => {
                    let upon = if same { vec![false; pairs.len()] } else { upon_one_another(&loops, pairs) };
                    let parted = pairs.iter().zip(upon).filter(|(_, upon)| !upon);
                    parted.flat_map(|(&[a, i, b, j], _)| [[a, i], [b, j]]).collect()
                }
                Fault::NotCertified(_, coarse) => coarse.clone(),
                _ => Vec::new(),
            };
            let coarse = named.iter().filter_map(|&[l, c]| *chords.get(l)?.get(c)?).collect();
            failed(fault, coarse)
        }
    }
}

/// Meshes a face for a larger chord error, as it is before points are inserted. Any fault is that of too much work.
fn coarser(
    model: &Model,
    face: &Face,
    lines: &[Option<Polyline>],
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Tried {
    let most = MESH_COARSER * deflection;
    let mut tried = try_face(model, face, lines, most, angle, [false; 2], steps);
    if tried.face.fault.is_some() {
        return failed(Fault::TooMuchWork, Vec::new());
    }
    tried.face.mesh.unfinished = tried.face.mesh.unfinished.max(most);
    tried
}

#[cfg(test)]
mod tests;
