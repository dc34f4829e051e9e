//! Edges that touch polygons seen at a slant.
//!
//! Two tessellations that touch are a certain distance apart, at right angles to their surfaces
//! (`CONTACT_AT_RIGHT_ANGLES`). The count moves an edge toward the viewer by somewhat more (`Mesh::delta`), the same for
//! all polygons of a group, so that it stays consistent. Where a polygon is seen at a slant, that is too little: the edge
//! lies farther behind it, as seen by the viewer, and is hidden. The rim of a bore is then broken along the outline of its
//! shaft, by the facets of both. Such edges are compared once more, polygon by polygon, each with the tolerance that it
//! has at this angle.
//!
//! ```text
//!    viewer  >------------->|<-- d / |N.v| -->o     the edge o is a distance d beneath the polygon's plane,
//!                       .·' polygon         .·'     and d / |N.v| behind it
//! ```

use rayon::prelude::*;

use super::exact_query::ExactQuery;
use super::invisibility::{Piece, Segment, State};
use super::merged::merged;
use super::mesh::Mesh;
use crate::boxes::aabb::Aabb;
use hlr_accuracy::CONTACT_AT_RIGHT_ANGLES;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::{Cover, is_beside};

/// |N . v|: for polygons seen at less, the tolerance grows no more.
const LEAST: f64 = 0.05;

/// Polygons as they are seen. depth_scale: depth units of the grid per unit in the image.
#[derive(Clone, Copy)]
pub struct Slant<'a> {
    pub mesh: &'a Mesh<'a>,
    pub depth_scale: f64,
}

impl Slant<'_> {
    /// The cosine of the angle between the line of sight and the normal of a polygon.
    pub fn facing(&self, t: usize) -> f64 {
        let (p, q, r) = self.mesh.corners(t);
        let place = |p: &Point| [f64::from(p[0]), f64::from(p[1]), f64::from(p[2]) / self.depth_scale];
        let (p, q, r) = (place(p), place(q), place(r));
        let (u, v) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        n[2].abs() / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt().max(f64::MIN_POSITIVE)
    }

    /// How far an edge is moved toward the viewer before it is compared with this polygon alone.
    pub fn delta(&self, drawn_group: i32, t: usize) -> i64 {
        let group = self.mesh.triangle_group[t];
        let delta = self.mesh.delta(drawn_group, group);
        // A surface does not touch itself beside its own folds.
        if delta == 0 || group == drawn_group {
            return delta;
        }
        let slanted = (delta as f64 * CONTACT_AT_RIGHT_ANGLES / self.facing(t).max(LEAST)) as i64;
        slanted.min(self.mesh.groups[group as usize].cap).max(delta)
    }

    /// The most that `delta` may be.
    fn most_delta(&self, drawn_group: i32, t: usize) -> i64 {
        let group = self.mesh.triangle_group[t];
        let delta = self.mesh.delta(drawn_group, group);
        if group == drawn_group {
            delta
        } else {
            Slant::most(delta).min(self.mesh.groups[group as usize].cap).max(delta)
        }
    }

    /// The same, whatever the group.
    pub fn most(delta: i64) -> i64 {
        (delta as f64 * (CONTACT_AT_RIGHT_ANGLES / LEAST)) as i64
    }

    /// Whether the edge a-b, of this group, lies behind the polygon by more than the count allows, and touches it.
    pub fn touches<A: Arithmetic>(&self, group: i32, [a, b]: [&Point; 2], t: usize) -> bool {
        let (delta, slanted) = (self.mesh.delta(group, self.mesh.triangle_group[t]), self.delta(group, t));
        let (p, q, r) = self.mesh.corners(t);
        if slanted <= delta || is_beside::<A>(a, b, [p, q, r]) {
            return false;
        }
        let Some(cover): Option<Cover<A>> = self.mesh.cover(t) else { return false };
        let (one, two) = (cover.sides(a), cover.sides(b));
        if (0..3).any(|k| one[k] < A::Area::ZERO && two[k] < A::Area::ZERO) {
            return false;
        }
        let beneath = [cover.beneath(a, &one), cover.beneath(b, &two)];
        beneath.iter().any(|g| *g > cover.shift(delta)) && beneath.iter().any(|g| *g <= cover.shift(slanted))
    }

    /// Pieces (ascending by edge) in which these edges are compared once more, and how many changed. Of an edge whose
    /// counts contradict one another then, the pieces stay.
    pub fn applied<A: Arithmetic>(
        &self,
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
            let (ends, group) = (self.mesh.ends(edge as usize), self.mesh.edge_group[edge as usize]);
            let mut polygons = Vec::new();
            exact.in_front(exact.tree(), Aabb::of(&[ends.0, ends.1]), |t| polygons.push((t, ends)));
            let decided = |delta: &dyn Fn(usize) -> i64| {
                let mut segments = Vec::new();
                exact.decide_by::<A>(polygons.iter().copied(), delta, &mut segments).then_some(segments)
            };
            let touching = decided(&|t| self.delta(group, t))?;
            // An edge that goes on to be hidden by more does not touch: it passes through. One tolerance for all polygons
            // tells that, for it does not change from one to the next.
            let through = decided(&|t| self.most_delta(group, t))?;
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
}

#[cfg(test)]
mod tests {
    use super::super::mesh::DRAWN;
    use super::super::own_faces::OwnFaces;
    use super::super::scene::{Group, Numbers, Scene, solve};
    use super::super::sweep::Steps;
    use super::*;
    use State::{Diving, Hidden, Visible, Within};

    /// What becomes of a wire along y behind a triangle whose depth grows by `slope` along x. behind: at its ends; the
    /// contact tolerance is 1.
    fn states(slope: f64, behind: [f64; 2], of_one_group: bool) -> (Vec<State>, u64) {
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
            edge_group: &[0, 0, 0, i32::from(!of_one_group)],
            role: &[0, 0, 0, DRAWN],
            groups: &[group; 2],
        };
        let found = solve(&scene, OwnFaces::NONE, Steps::ALL, Numbers::Exact, &|| false).expect("an answer");
        (found.pieces.iter().map(|p| p.segment.state).collect(), found.counters.slanted)
    }

    #[test]
    fn the_tolerance_is_measured_at_right_angles_to_what_is_seen_at_a_slant() {
        let slope = f64::sqrt(99.0); // |N . v| is a tenth: touching are depths of up to 4
        assert_eq!(states(slope, [3.9; 2], false), (vec![Visible, Within, Visible], 1));
        assert_eq!(states(slope, [4.1; 2], false), (vec![Visible, Hidden, Visible], 0));
        assert_eq!(states(slope, [0.9; 2], false), (vec![Visible, Within, Visible], 0));
        assert_eq!(states(0.0, [1.1; 2], false), (vec![Visible, Hidden, Visible], 0));
        assert_eq!(states(slope, [3.9; 2], true), (vec![Visible, Hidden, Visible], 0));
    }

    #[test]
    fn what_passes_through_does_not_touch() {
        let slope = f64::sqrt(99.0);
        let (found, asked) = states(slope, [-4.0, 14.0], false);
        assert_eq!(found, [Visible, Diving, Hidden, Visible]);
        assert_eq!(asked, 1);
    }
}
