//! Edges that are copies of one another, with a face of no area between them: boolean operations leave them.
//!
//! ```text
//!    ___________
//!   (___________)     two edges from vertex to vertex along one curve, and a face between them
//! ```
//!
//! Such a face has no triangles. A copy has the points of its original, so that the faces beside them meet as if there
//! were one edge.

use crate::geometry::vector::{length, sub};
use crate::shapes::{Edge, Face};

/// Parts of an edge between which it is compared with the other.
const PARTS: u32 = 16;
/// Of the length of an edge: a copy is no farther off, whatever the tolerance of a file.
const FARTHEST: f64 = 1e-4;

/// Marks the faces of no area, and of the edges beside them all but the one with the lowest number as its copies.
pub fn mark_copies(faces: &mut [Face], edges: &mut [Edge]) {
    for face in faces {
        if let Some(([one, two], reversed)) = copies(face, edges) {
            face.no_area = true;
            let [(a, back_a), (b, back_b)] = [one, two].map(|edge| original(edges, edge));
            if a != b {
                edges[a.max(b) as usize].original = Some((a.min(b), back_a ^ reversed ^ back_b));
            }
        }
    }
    for edge in 0..edges.len() {
        if edges[edge].original.is_some() {
            edges[edge].original = Some(original(edges, edge as u32));
        }
    }
}

/// The last original of an edge, which may be itself, and whether the edge runs the other way.
fn original(edges: &[Edge], edge: u32) -> (u32, bool) {
    let (mut at, mut back) = (edge, false);
    while let Some((next, reversed)) = edges[at as usize].original {
        (at, back) = (next, back ^ reversed);
    }
    (at, back)
}

/// The two edges of a face if one is a copy of the other, and whether they run in opposite directions.
fn copies(face: &Face, edges: &[Edge]) -> Option<([u32; 2], bool)> {
    let [wire] = &face.wires[..] else { return None };
    let [one, two] = &wire[..] else { return None };
    if one.edge == two.edge || one.location != two.location || !(one.orientation.bounds() && two.orientation.bounds()) {
        return None;
    }
    let [a, b] = [one, two].map(|used| &edges[used.edge as usize]);
    let ([Some(first), Some(last)], [Some(from), Some(to)]) = (a.ends, b.ends) else { return None };
    let reversed = (from, to) == (last, first);
    if first == last || !(reversed || (from, to) == (first, last)) || a.degenerate || b.degenerate {
        return None;
    }
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
    (apart <= near).then_some(([one.edge, two.edge], reversed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Orientation;
    use crate::geometry::curve::Curve;
    use crate::shapes::Use;

    /// A half circle of this radius from (1, 0) to (-1, 0), or back.
    fn arc(radius: f64, back: bool) -> Edge {
        let way = if back { -1.0 } else { 1.0 };
        let curve = Curve::Ellipse { p: [0.0; 3], a: [way * radius, 0.0, 0.0], b: [0.0, radius, 0.0] };
        let ends = if back { [(1, 0), (0, 0)] } else { [(0, 0), (1, 0)] };
        Edge::on_curve(curve, [0.0, std::f64::consts::PI], ends, 1e-7)
    }

    fn between(edges: [u32; 2]) -> Face {
        let used = |edge| Use {
            edge,
            location: 0,
            place: None,
            orientation: Orientation::Forward,
            ends: [(0, 0), (1, 0)],
            curve2: None,
        };
        let wires = vec![edges.map(used).to_vec()];
        Face { record: None, surface: None, tolerance: 1e-7, wires, own: None, no_area: false }
    }

    #[test]
    fn a_copy_of_a_copy_has_the_points_of_the_first() {
        // In any order of the faces; the last edge runs the other way.
        for pairs in [[[2, 1], [1, 0]], [[0, 1], [2, 1]]] {
            let mut edges = [arc(1.0, false), arc(1.0, false), arc(1.0, true)];
            let mut faces = pairs.map(between);
            mark_copies(&mut faces, &mut edges);
            assert!(faces.iter().all(|face| face.no_area), "{pairs:?}");
            assert_eq!(edges.map(|edge| edge.original), [None, Some((0, false)), Some((0, true))], "{pairs:?}");
        }
    }

    #[test]
    fn arcs_apart_enclose_an_area() {
        let mut edges = [arc(1.0, false), arc(1.000_001, false)];
        let mut faces = [between([0, 1])];
        mark_copies(&mut faces, &mut edges);
        assert!(!faces[0].no_area && edges[1].original.is_none());
    }
}
