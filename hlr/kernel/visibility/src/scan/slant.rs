//! The contact tolerance of a polygon seen at a slant.
//!
//! Two tessellations that touch are a certain distance apart, at right angles to their surfaces
//! (`TOUCHING_AT_RIGHT_ANGLES`). An edge this far beneath a polygon lies the farther behind it, as seen by the viewer, the
//! more obliquely that is seen.
//!
//! ```text
//!    viewer  >------------->|<-- d / |N.v| -->o     the edge o is a distance d beneath the polygon's plane,
//!                       .·' polygon         .·'     and d / |N.v| behind it
//! ```

use super::mesh::Mesh;
use hlr_accuracy::{CONTACT_AT_RIGHT_ANGLES, TOUCHING_AT_RIGHT_ANGLES, TOUCHING_BESIDE_A_LINE};
use hlr_exact::Point;
use hlr_exact::arithmetic::Arithmetic;
use hlr_exact::predicates::Cover;
use hlr_exact::snap::DELTA_LIMIT;

/// |N . v|: for polygons seen at less, the tolerance grows no more. The rim of a bore comes from behind its shaft where
/// the shaft is seen edge-on: with more, one chord of the rim would be missing there.
const LEAST: f64 = 0.005;

/// Polygons as they are seen. depth_scale: depth units of the grid per unit in the image.
#[derive(Clone, Copy)]
pub struct Slant<'a> {
    pub mesh: &'a Mesh<'a>,
    pub depth_scale: f64,
}

impl Slant<'_> {
    /// The cosine of the angle between the line of sight and the normal of a polygon.
    pub fn facing(&self, t: usize) -> f64 {
        self.normal(t)[2].abs()
    }

    /// The unit normal of a polygon, outward of a closed body: x right, y up, z toward the viewer.
    pub fn normal(&self, t: usize) -> [f64; 3] {
        let n = self.across(t);
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt().max(f64::MIN_POSITIVE);
        n.map(|c| c / length)
    }

    /// A normal of a polygon as that one, but of any length.
    pub fn across(&self, t: usize) -> [f64; 3] {
        let (p, q, r) = self.mesh.corners(t);
        // Depth grows away from the viewer.
        let place = |p: &Point| [f64::from(p[0]), f64::from(p[1]), -f64::from(p[2]) / self.depth_scale];
        let (p, q, r) = (place(p), place(q), place(r));
        let (u, v) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    }

    /// How far an edge is moved toward the viewer before it is compared with this polygon alone.
    pub fn delta(&self, drawn_group: i32, t: usize) -> i64 {
        let group = self.mesh.triangle_group[t];
        let delta = self.mesh.delta(drawn_group, group);
        // A surface does not touch itself beside its own folds.
        if delta == 0 || group == drawn_group {
            return delta;
        }
        let crossing = self.mesh.crosses(drawn_group, group);
        self.slanted(delta, if crossing { TOUCHING_BESIDE_A_LINE } else { TOUCHING_AT_RIGHT_ANGLES }, t)
    }

    /// The same for a polygon of the edge's own group, where the body touches itself.
    pub fn delta_of_itself(&self, t: usize) -> i64 {
        let group = &self.mesh.groups[self.mesh.triangle_group[t] as usize];
        self.slanted(group.delta.min(group.cap), TOUCHING_AT_RIGHT_ANGLES, t)
    }

    /// How deep beneath a polygon of its own group an outline may lie in its true place, by the chord errors of both. It
    /// may lie far behind where that is seen edge-on, whatever the thickness of the body.
    pub fn delta_of_chords(&self, t: usize) -> i64 {
        let delta = self.mesh.groups[self.mesh.triangle_group[t] as usize].delta as f64;
        (delta * CONTACT_AT_RIGHT_ANGLES / self.facing(t).max(LEAST)).min(DELTA_LIMIT) as i64
    }

    /// at_right_angles: of the contact depth.
    fn slanted(&self, delta: i64, at_right_angles: f64, t: usize) -> i64 {
        let slanted = (delta as f64 * at_right_angles / self.facing(t).max(LEAST)) as i64;
        slanted.min(self.mesh.groups[self.mesh.triangle_group[t] as usize].cap).max(delta)
    }

    /// The most that `delta` may be for a polygon.
    pub fn most_delta(&self, drawn_group: i32, t: usize) -> i64 {
        self.most_of_group(drawn_group, self.mesh.triangle_group[t])
    }

    /// The most that `delta` may be for the polygons of a group.
    pub fn most_of_group(&self, drawn_group: i32, group: i32) -> i64 {
        let delta = self.mesh.delta(drawn_group, group);
        if group == drawn_group {
            delta
        } else {
            Slant::most(delta).min(self.mesh.groups[group as usize].cap).max(delta)
        }
    }

    /// The same, whatever the groups.
    pub fn most(delta: i64) -> i64 {
        (delta as f64 * (TOUCHING_AT_RIGHT_ANGLES / LEAST)) as i64
    }

    /// Whether an edge of this group, whose ends lie so far beneath the polygon t, lies behind it by more than the count
    /// allows, and touches it.
    pub fn touches<A: Arithmetic>(&self, group: i32, beneath: &[A::Volume; 2], cover: &Cover<A>, t: usize) -> bool {
        let delta = self.mesh.delta(group, self.mesh.triangle_group[t]);
        // The slant is asked for last: it takes a root.
        beneath.iter().any(|g| *g > cover.shift(delta)) && {
            let slanted = self.delta(group, t);
            slanted > delta && beneath.iter().any(|g| *g <= cover.shift(slanted))
        }
    }
}
