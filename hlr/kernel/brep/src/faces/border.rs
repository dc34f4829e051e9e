//! The border of a face as closed loops in the parameter plane of its surface.

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::cap;
use super::chain::{NEAR, chained};
use super::node::Node;
use super::uses::{Run, run};
use crate::edges::{Polyline, from_chord};
use crate::format::Orientation;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{length, sub};
use crate::mesh::{FaceLoops, Fault, LoopPoint};
use crate::model::Model;
use crate::shapes::{Face, Use};
use hlr_accuracy::CHORD_MOST;

/// Share of the face's extent in (u, v) below which two points of one node are one point.
const SAME: f64 = 1e-6;

#[derive(Clone, Debug)]
pub struct Border {
    pub loops: FaceLoops,
    /// The vertex or corner for each node number in `loops`.
    pub nodes: Vec<Node>,
    /// For each chord of each loop its edge and its number along the edge; None between the ends of two edges.
    pub chords: Vec<Vec<Option<(u32, u32)>>>,
    /// How far its points are off the surface, at most.
    pub off: f64,
}

impl Border {
    /// Chords whose middle in (u, v) lies too far off the chord in space, each as edge and number along the edge.
    pub fn coarse(&self, surface: &Surface, deflection: f64) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        if matches!(surface, Surface::Plane(_)) {
            return found;
        }
        for (points, chords) in self.loops.loops.iter().zip(&self.chords) {
            let count = points.len();
            for (i, chord) in chords.iter().enumerate() {
                let (Some(chord), [p, q]) = (chord, [points[i], points[(i + 1) % count]]) else { continue };
                let turns = if i + 1 < count { [0.0; 2] } else { whole_turns(p.uv, q.uv, self.loops.periods) };
                let middle = [0, 1].map(|k| 0.5 * (p.uv[k] + q.uv[k] + turns[k]));
                let off = from_chord(&surface.point(middle), &p.point, &q.point);
                // Where the edge itself is off the surface, dividing it does not help.
                let own = |p: &LoopPoint| length(&sub(&surface.point(p.uv), &p.point));
                if off > deflection * CHORD_MOST && off > deflection * CHORD_MOST + own(&p).max(own(&q)) {
                    found.push(*chord);
                }
            }
        }
        found
    }
}

/// # Errors
/// An edge cannot be located on the surface, or the edges form no closed loops.
pub fn border(model: &Model, face: &Face, polylines: &[Option<Polyline>], deflection: f64) -> Result<Border, Fault> {
    let Some(surface) = &face.surface else { return Err(Fault::Degenerate) };
    let periods = surface.periods();
    let mut wires: Vec<Vec<Run>> = Vec::new();
    let mut inner = Vec::new();
    for wire in &face.wires {
        let mut runs = Vec::with_capacity(wire.len());
        for used in wire {
            match run(model, surface, used, polylines, face.tolerance, deflection)? {
                Some(run) => runs.push(run),
                None => inner.push(used),
            }
        }
        wires.push(runs);
    }
    // An edge inside the face is passed in both directions: a slit.
    for used in inner.into_iter().filter(|used| used.orientation == Orientation::Internal) {
        let slit = [Orientation::Forward, Orientation::Reversed].map(|orientation| Use { orientation, ..used.clone() });
        let runs: Result<Vec<_>, _> =
            slit.iter().map(|used| run(model, surface, used, polylines, face.tolerance, deflection)).collect();
        wires.push(runs?.into_iter().flatten().collect());
    }
    let all = || wires.iter().flatten().flat_map(|run| &run.uv);
    let extent = [0, 1].map(|k| {
        let (low, high) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), uv| (l.min(uv[k]), h.max(uv[k])));
        high - low
    });
    let off = wires.iter().flatten().map(|run| run.off).fold(0.0, f64::max);
    let loops = FaceLoops { loops: Vec::new(), periods };
    let mut out = Border { loops, nodes: Vec::new(), chords: Vec::new(), off };
    let count = all().count();
    out.nodes.reserve(count);
    let mut around: Vec<(usize, f64)> = Vec::new();
    let mut numbers: FxHashMap<Node, u32> = FxHashMap::with_capacity_and_hasher(count, FxBuildHasher);
    for runs in &wires {
        for order in chained(runs, extent, periods)? {
            let count = order.iter().map(|&(i, _)| runs[i].uv.len()).sum();
            let (mut points, mut chords) = (Vec::with_capacity(count), Vec::with_capacity(count));
            let count = order.len();
            for (k, &(i, shift)) in order.iter().enumerate() {
                let run = &runs[i];
                let last = run.uv.len() - 1;
                let (next, next_shift) = order[(k + 1) % count];
                let at = |uv: [f64; 2], shift: [f64; 2]| [uv[0] + shift[0], uv[1] + shift[1]];
                // The run ends where the next edge begins; at a pole, that may be elsewhere in (u, v).
                let (end, begin) = (at(run.uv[last], shift), at(runs[next].uv[0], next_shift));
                let turns = if k + 1 < count { [0.0; 2] } else { whole_turns(end, begin, periods) };
                if k + 1 == count && turns[0] != 0.0 && turns[1] == 0.0 {
                    around.push((out.loops.loops.len(), turns[0]));
                }
                let joined = (0..2).all(|k| (end[k] - begin[k] - turns[k]).abs() <= NEAR * extent[k]);
                for corner in 0..if joined { last } else { last + 1 } {
                    let node = node(run, corner, last);
                    let number = *numbers.entry(node).or_insert_with(|| {
                        out.nodes.push(node);
                        out.nodes.len() as u32 - 1
                    });
                    points.push(LoopPoint { uv: at(run.uv[corner], shift), point: run.points[corner], node: number });
                    let chord = if run.backward { last.wrapping_sub(corner + 1) } else { corner };
                    chords.push((corner < last && !run.degenerate).then_some((run.edge, chord as u32)));
                }
            }
            out.loops.loops.push(points);
            out.chords.push(chords);
        }
    }
    if let &[(number, turn)] = &around[..] {
        let Border { loops, nodes, chords, .. } = &mut out;
        let limits = [face.tolerance, deflection];
        cap::close(surface, turn, &mut loops.loops[number], &mut chords[number], nodes, limits);
    }
    together(&mut out.loops);
    unite(&mut out.loops, out.nodes.len(), extent);
    if out.loops.loops.is_empty() { Err(Fault::Open) } else { Ok(out) }
}

/// The difference end - begin, rounded to whole periods.
fn whole_turns(end: [f64; 2], begin: [f64; 2], periods: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| if periods[k] > 0.0 { ((end[k] - begin[k]) / periods[k]).round() * periods[k] } else { 0.0 })
}

fn node(run: &Run, corner: usize, last: usize) -> Node {
    if run.degenerate || corner == 0 {
        Node::Vertex(run.ends[0])
    } else if corner == last {
        Node::Vertex(run.ends[1])
    } else {
        Node::Edge(run.edge, run.location, if run.backward { last - corner } else { corner } as u32)
    }
}

/// Puts the points of one node, where loops touch, at one place in (u, v): curves in (u, v) end there only nearly.
fn unite(loops: &mut FaceLoops, nodes: usize, extent: [f64; 2]) {
    if loops.loops.iter().map(Vec::len).sum::<usize>() == nodes {
        return;
    }
    let mut first: Vec<Option<[f64; 2]>> = vec![None; nodes];
    for point in loops.loops.iter_mut().flatten() {
        let place = *first[point.node as usize].get_or_insert(point.uv);
        let turns = whole_turns(point.uv, place, loops.periods);
        let place = [place[0] + turns[0], place[1] + turns[1]];
        if (0..2).all(|k| (point.uv[k] - place[k]).abs() <= SAME * extent[k]) {
            point.uv = place;
        }
    }
}

/// Moves loops of a periodic surface by whole periods to the largest loop.
fn together(loops: &mut FaceLoops) {
    let bounds = |points: &Vec<LoopPoint>, k: usize| {
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.uv[k]), h.max(p.uv[k])))
    };
    for k in 0..2 {
        let period = loops.periods[k];
        if period <= 0.0 || loops.loops.len() < 2 {
            continue;
        }
        let ranges: Vec<(f64, f64)> = loops.loops.iter().map(|points| bounds(points, k)).collect();
        let widest = ranges.iter().copied().fold((0.0, 0.0), |a, b| if b.1 - b.0 > a.1 - a.0 { b } else { a });
        for (points, range) in loops.loops.iter_mut().zip(ranges) {
            let middle = 0.5 * (range.0 + range.1);
            let turns = if middle < widest.0 {
                ((widest.0 - middle) / period).ceil()
            } else if middle > widest.1 {
                -((middle - widest.1) / period).ceil()
            } else {
                continue;
            };
            for point in points {
                point.uv[k] += turns * period;
            }
        }
    }
}
