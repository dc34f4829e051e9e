//! Faces of no area, between an edge and a copy of it: boolean operations leave them.
//!
//! ```text
//!    ___________
//!   (___________)     two edges from vertex to vertex along one curve, and a face between them
//! ```
//!
//! Such a face has no triangles. Its edges have the same points, so that the faces beside it meet as if it were not there.

use crate::geometry::vector::{length, sub};
use crate::shapes::{Copies, Edge, Face};

/// Parts of an edge between which it is compared with the other.
const PARTS: u32 = 16;
/// Of the length of an edge: a copy is no farther off, whatever the tolerance of a file.
const FARTHEST: f64 = 1e-4;

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
