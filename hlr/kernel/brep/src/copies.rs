//! Faces of no area, between an edge and a copy of it: boolean operations leave them.
//!
//! ```text
//!    ___________
//!   (___________)     two edges from vertex to vertex along one curve, and a face between them
//! ```
//!
//! Such a face has no triangles. Its edges have the same points, so that the faces beside it meet as if it were not there.

use std::collections::BTreeSet;

use crate::edges::Polyline;
use crate::geometry::vector::{length, sub};
use crate::shapes::{Edge, Face};

/// Parts of an edge between which it is compared with the other.
const PARTS: u32 = 16;
/// Of the length of an edge: a copy is no farther off, whatever the tolerance of a file.
const FARTHEST: f64 = 1e-4;

/// The two edges of a face of no area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Copies {
    pub edges: [u32; 2],
    /// Whether they run in opposite directions.
    pub reversed: bool,
}

/// The edges of a face if one is a copy of the other.
pub fn copies(face: &Face, edges: &[Edge]) -> Option<Copies> {
    let [wire] = &face.wires[..] else { return None };
    let [one, two] = &wire[..] else { return None };
    if one.edge == two.edge || one.location != two.location || !(one.orientation.bounds() && two.orientation.bounds()) {
        return None;
    }
    let [a, b] = [one, two].map(|used| &edges[used.edge as usize]);
    let runs = |edge: &Edge| !edge.degenerate && edge.range[0] < edge.range[1];
    let ([Some(first), Some(last)], [from, to], true) = (a.ends, b.ends, runs(a) && runs(b)) else { return None };
    let reversed = match (from == Some(first) && to == Some(last), from == Some(last) && to == Some(first)) {
        (true, false) => false,
        (false, true) => true,
        _ => return None,
    };
    let (of_a, of_b) = (a.curve.as_ref()?, b.curve.as_ref()?);
    let at = |edge: &Edge, share: f64| edge.range[0] + share * (edge.range[1] - edge.range[0]);
    let (mut long, mut apart, mut before) = (0.0, 0.0f64, of_a.point(a.range[0]));
    for i in 0..=PARTS {
        let share = f64::from(i) / f64::from(PARTS);
        let here = of_a.point(at(a, share));
        let there = of_b.point(at(b, if reversed { 1.0 - share } else { share }));
        long += length(&sub(&here, &before));
        apart = apart.max(length(&sub(&here, &there)));
        before = here;
    }
    let near = a.tolerance.max(b.tolerance).min(FARTHEST * long);
    (apart <= near).then_some(Copies { edges: [one.edge, two.edge], reversed })
}

impl Copies {
    /// Adds to chords, edge and number along the edge, those of the other edge that are copies of them.
    pub fn mirror(&self, chords: &mut BTreeSet<(u32, u32)>, lines: &[Option<Polyline>]) {
        let [one, two] = self.edges;
        for (from, to) in [(one, two), (two, one)] {
            let Some(last) = lines[from as usize].as_ref().and_then(|l| l.points.len().checked_sub(2)) else { return };
            let of: Vec<u32> = chords.range((from, 0)..=(from, u32::MAX)).map(|&(_, k)| k).collect();
            chords.extend(of.into_iter().map(|k| (to, if self.reversed { last as u32 - k } else { k })));
        }
    }

    /// Gives the second edge the points of the first.
    pub fn copy(&self, edges: &[Edge], lines: &mut [Option<Polyline>]) {
        let [one, two] = self.edges.map(|e| e as usize);
        let Some(line) = &lines[one] else { return };
        let ([from, to], [first, last]) = (edges[one].range, edges[two].range);
        let share = |t: &f64| if self.reversed { (to - t) / (to - from) } else { (t - from) / (to - from) };
        let mut made = Polyline {
            parameters: line.parameters.iter().map(|t| first + share(t).clamp(0.0, 1.0) * (last - first)).collect(),
            points: line.points.clone(),
        };
        if self.reversed {
            made.parameters.reverse();
            made.points.reverse();
        }
        lines[two] = Some(made);
    }
}
