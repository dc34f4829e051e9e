//! Edges that touch polygons seen at a slant.
//!
//! The count moves an edge toward the viewer by one tolerance (`Mesh::delta`) for all polygons of a group, so that it
//! stays consistent. For polygons seen at a slant that is too little (`slant`), and they hide what touches them: the rim
//! of a bore is broken along the outline of its shaft, by the facets of both. Such edges are compared once more, polygon
//! by polygon, each with the tolerance that it has at this angle.

use rayon::prelude::*;

use super::exact_query::ExactQuery;
use super::invisibility::{Piece, Segment, State};
use super::merged::merged;
use super::slant::Slant;
use crate::boxes::aabb::Aabb;
use hlr_exact::arithmetic::Arithmetic;

/// Pieces (ascending by edge) in which these edges are compared once more, and how many of them were. Of an edge whose
/// counts contradict one another then, the pieces stay.
pub fn compared_again<A: Arithmetic>(
    slant: &Slant,
    exact: &ExactQuery,
    edges: &[u32],
    pieces: Vec<Piece>,
    stopped: &(dyn Fn() -> bool + Sync),
) -> (Vec<Piece>, u64) {
    let of = |edge: u32| {
        let first = pieces.partition_point(|p| p.edge < edge);
        first..first + pieces[first..].partition_point(|p| p.edge == edge)
    };
    let hidden = |edge: &u32| pieces[of(*edge)].iter().any(|p| p.segment.state == State::Hidden);
    let asked: Vec<u32> = edges.iter().copied().filter(hidden).collect();
    if asked.is_empty() {
        return (pieces, 0);
    }
    exact.prepare();
    let anew = |&edge: &u32| {
        if stopped() {
            return None;
        }
        let (ends, group) = (slant.mesh.ends(edge as usize), slant.mesh.edge_group[edge as usize]);
        let mut polygons = Vec::new();
        exact.in_front(exact.tree(), Aabb::of(&[ends.0, ends.1]), |t| polygons.push((t, ends)));
        let decided = |delta: &dyn Fn(usize) -> i64| {
            let mut segments = Vec::new();
            exact.decide_by::<A>(polygons.iter().copied(), delta, &mut segments).then_some(segments)
        };
        // An edge that goes on to be hidden by more does not touch: it passes through. One tolerance for all polygons
        // tells that, for it does not change from one to the next.
        let through = decided(&|t| slant.most_delta(group, t))?;
        if through.iter().all(|segment| segment.state == State::Hidden) {
            return None;
        }
        let touching = decided(&|t| slant.delta(group, t))?;
        let before: Vec<Segment> = pieces[of(edge)].iter().map(|p| p.segment).collect();
        let found = merged(&touching, &through, State::more_hidden);
        Some((edge, merged(&before, &found, |old, new| if new == State::Diving { old } else { new })))
    };
    let found: Vec<_> = asked.par_iter().filter_map(anew).collect();
    let mut out = Vec::with_capacity(pieces.len() + found.len());
    let mut from = 0;
    for (edge, segments) in &found {
        let old = of(*edge);
        out.extend_from_slice(&pieces[from..old.start]);
        out.extend(segments.iter().map(|&segment| Piece { edge: *edge, segment }));
        from = old.end;
    }
    out.extend_from_slice(&pieces[from..]);
    (out, found.len() as u64)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::DRAWN;
    use super::super::own_faces::OwnFaces;
    use super::super::scene::{Group, Numbers, Scene, solve};
    use super::super::sweep::Steps;
    use super::*;
    use State::{Diving, Hidden, Visible, Within};

    /// Whether the wire is of the triangle's group, or of one that crosses it somewhere.
    #[derive(Clone, Copy, PartialEq)]
    enum Kind {
        OneGroup,
        Touching,
        Crossing,
    }
    use Kind::{Crossing, OneGroup, Touching};

    /// What becomes of a wire along y behind a triangle whose depth grows by `slope` along x. behind: at its ends; the
    /// contact tolerance is 1.
    fn pieces(slope: f64, behind: [f64; 2], kind: Kind) -> (Vec<Segment>, u64) {
        let at = |x: f64, y: f64| [x, y, slope * x];
        // The last two give the grid room.
        let [a, b] = behind;
        let points = [
            at(-3.0, -4.0),
            at(3.0, -4.0),
            at(0.0, 8.0),
            [0.0, -8.0, a],
            [0.0, 9.0, b],
            [0.0, 0.0, -64.0],
            [0.0, 0.0, 64.0],
        ];
        let group = Group { cull: false, sound: false, delta: 1.0, cap: 9.0, tight: false };
        let scene = Scene {
            points: &points,
            triangles: &[[0, 1, 2]],
            triangle_group: &[0],
            edges: &[[0, 1], [1, 2], [0, 2], [3, 4]],
            offsets: &[0, 1, 2, 3, 3],
            incident: &[0, 0, 0],
            edge_group: &[0, 0, 0, i32::from(kind != Kind::OneGroup)],
            crossing: if kind == Kind::Crossing { &[[0, 1]] } else { &[] },
            role: &[0, 0, 0, DRAWN],
            groups: &[group; 2],
        };
        let found = solve(&scene, OwnFaces::NONE, Steps::ALL, Numbers::Exact, &|| false).expect("an answer");
        (found.pieces.iter().map(|p| p.segment).collect(), found.counters.slanted_contacts)
    }

    fn states(slope: f64, behind: [f64; 2], kind: Kind) -> (Vec<State>, u64) {
        let (found, asked) = pieces(slope, behind, kind);
        (found.iter().map(|segment| segment.state).collect(), asked)
    }

    #[test]
    fn the_tolerance_is_measured_at_right_angles_to_what_is_seen_at_a_slant() {
        // |N . v| is a tenth: touching are depths of up to 8, and 4.5 where there is an intersection line somewhere.
        let slope = f64::sqrt(99.0);
        assert_eq!(states(slope, [7.9; 2], Touching), (vec![Visible, Within, Visible], 1));
        assert_eq!(states(slope, [8.1; 2], Touching), (vec![Visible, Hidden, Visible], 0));
        assert_eq!(states(slope, [4.4; 2], Crossing), (vec![Visible, Within, Visible], 1));
        assert_eq!(states(slope, [4.6; 2], Crossing), (vec![Visible, Hidden, Visible], 0));
        assert_eq!(states(slope, [0.9; 2], Touching), (vec![Visible, Within, Visible], 0));
        assert_eq!(states(0.0, [1.1; 2], Touching), (vec![Visible, Hidden, Visible], 0));
        assert_eq!(states(slope, [3.9; 2], OneGroup), (vec![Visible, Hidden, Visible], 0));
    }

    #[test]
    fn what_passes_through_does_not_touch() {
        let slope = f64::sqrt(99.0);
        let (found, asked) = pieces(slope, [-4.0, 14.0], Touching);
        assert_eq!(found.iter().map(|segment| segment.state).collect::<Vec<_>>(), [Visible, Diving, Hidden, Visible]);
        // Hidden from where it is one unit behind, not four.
        assert!((found[2].start - 5.0 / 18.0).abs() < 1e-6, "{found:?}");
        assert_eq!(asked, 1);
    }
}
