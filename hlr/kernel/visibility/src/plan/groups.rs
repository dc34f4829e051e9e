//! Properties of groups: triangles that the pass treats as one surface.

use hlr_mesh::bodies::Bodies;

use super::Vec3;
use crate::boxes::meeting::boxes_meet;

/// Columns with one entry per group.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    /// Every edge is used as often in one direction as in the other.
    pub closed: Vec<bool>,
    /// Closed, and turned outward: faces turned away need not be looked at.
    pub cull: Vec<bool>,
    /// Closed, and turned inward, as a cavity is.
    pub inward: Vec<bool>,
    /// Does not pass through itself, as far as its source tells.
    pub sound: Vec<bool>,
    /// A piece of a mesh without B-rep.
    pub bare: Vec<bool>,
    /// Lines that lie exactly on other groups' triangles.
    pub tight: Vec<bool>,
    /// Only planar faces.
    pub planar: Vec<bool>,
    /// Its thickness; the smallest side of its box where that is less or it is open. Model units.
    pub extent: Vec<f64>,
    /// Its box; the lower corner is beyond the upper one where it is empty.
    pub low: Vec<Vec3>,
    pub high: Vec<Vec3>,
}

/// Depths in model units within which surfaces touch: of B-rep groups with curved faces, and of those with planar faces
/// alone; share: of the scene's diagonal, for meshes without B-rep.
#[derive(Clone, Copy, Debug)]
pub struct Depths {
    pub curved: f64,
    pub planar: f64,
    pub share: f64,
}

impl Groups {
    /// brep: per part.
    pub fn of(bodies: &Bodies, brep: &[bool]) -> Groups {
        let solid = || bodies.part_of.iter().map(|&part| brep[part as usize]);
        Groups {
            closed: bodies.closed.clone(),
            cull: bodies.cull.clone(),
            inward: bodies.inward.clone(),
            sound: bodies.closed.iter().zip(solid()).map(|(&closed, solid)| closed && solid).collect(),
            bare: solid().map(|solid| !solid).collect(),
            tight: vec![false; bodies.closed.len()],
            planar: bodies.planar.clone(),
            extent: bodies.extent.clone(),
            low: bodies.low.clone(),
            high: bodies.high.clone(),
        }
    }

    pub fn len(&self) -> usize {
        self.closed.len()
    }

    pub fn is_empty(&self) -> bool {
        self.closed.is_empty()
    }

    /// Whether a group holds anything.
    pub fn used(&self, group: usize) -> bool {
        self.low[group][0].is_finite()
    }

    /// These groups, and an open one for each distinct owner of edges without triangles. Returns the groups, and that of
    /// each edge. tight: the edges lie exactly on triangles of other groups.
    pub fn with_wires(&self, points: &[Vec3], wires: &[[i32; 2]], owner: &[i64], tight: bool) -> (Groups, Vec<i32>) {
        let mut owners = owner.to_vec();
        owners.sort_unstable();
        owners.dedup();
        let (before, more) = (self.len(), owners.len());
        let mut out = self.clone();
        for column in [&mut out.closed, &mut out.cull, &mut out.inward, &mut out.bare] {
            column.resize(before + more, false);
        }
        for column in [&mut out.sound, &mut out.planar] {
            column.resize(before + more, true);
        }
        out.tight.resize(before + more, tight);
        out.extent.resize(before + more, 0.0);
        out.low.resize(before + more, [f64::INFINITY; 3]);
        out.high.resize(before + more, [f64::NEG_INFINITY; 3]);
        let mut group = Vec::with_capacity(wires.len());
        for (wire, own) in wires.iter().zip(owner) {
            let g = before + owners.partition_point(|other| other < own);
            group.push(g as i32);
            for p in wire.map(|v| &points[v as usize]) {
                out.low[g] = [0, 1, 2].map(|k| out.low[g][k].min(p[k]));
                out.high[g] = [0, 1, 2].map(|k| out.high[g][k].max(p[k]));
            }
        }
        (out, group)
    }

    /// These groups after triangles of some were taken away: they are open, and their faces are not culled.
    pub fn opened(&self, which: &[bool]) -> Groups {
        let mut out = self.clone();
        for g in (0..which.len()).filter(|&g| which[g]) {
            (out.closed[g], out.cull[g]) = (false, false);
        }
        out
    }

    /// These groups where some pass through themselves: they are neither sound nor culled.
    pub fn unsound(&self, which: &[bool]) -> Groups {
        let mut out = self.clone();
        for g in (0..which.len()).filter(|&g| which[g]) {
            (out.sound[g], out.cull[g]) = (false, false);
        }
        out
    }

    /// Per group: its box, `reach` wider on all sides, meets that of another. None where they lie too far apart for a
    /// grid.
    pub fn meeting(&self, reach: f64) -> Option<Vec<bool>> {
        if (0..self.len()).filter(|&g| self.used(g)).nth(1).is_none() {
            return Some(vec![false; self.len()]);
        }
        let moved = |corners: &[Vec3], by: f64| corners.iter().map(|c| c.map(|c| c + by)).collect::<Vec<_>>();
        boxes_meet(&moved(&self.low, -reach), &moved(&self.high, reach))
    }

    /// Per group: a surface nearer than this touches it. Model units.
    pub fn contact_depths(&self, depths: Depths) -> Vec<f64> {
        let least = if self.bare.contains(&true) { depths.share * self.diagonal() } else { 0.0 };
        let depth = |g: usize| {
            let own = if self.planar[g] { depths.planar } else { depths.curved };
            if self.bare[g] { own.max(least) } else { own }
        };
        (0..self.len()).map(depth).collect()
    }

    /// Of the box around all groups.
    fn diagonal(&self) -> f64 {
        let used = || (0..self.len()).filter(|&g| self.used(g));
        let side = |k: usize| {
            let low = used().map(|g| self.low[g][k]).fold(f64::INFINITY, f64::min);
            used().map(|g| self.high[g][k]).fold(f64::NEG_INFINITY, f64::max) - low
        };
        [0, 1, 2].map(side).iter().map(|s| s * s).sum::<f64>().sqrt()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Closed boxes of a B-rep from corner to corner, one unit thick.
    pub fn boxes<const N: usize>(corners: [[Vec3; 2]; N]) -> Groups {
        Groups {
            closed: vec![true; N],
            cull: vec![true; N],
            inward: vec![false; N],
            sound: vec![true; N],
            bare: vec![false; N],
            tight: vec![false; N],
            planar: vec![true; N],
            extent: vec![1.0; N],
            low: corners.map(|c| c[0]).to_vec(),
            high: corners.map(|c| c[1]).to_vec(),
        }
    }

    #[test]
    fn wires_of_one_owner_are_one_group() {
        let points = [[0.0; 3], [1.0, 2.0, 3.0], [-1.0, 0.0, 9.0]];
        let (found, group) =
            boxes([[[0.0; 3], [1.0; 3]]]).with_wires(&points, &[[0, 1], [0, 2], [1, 2]], &[7, 3, 7], true);
        assert_eq!(group, [2, 1, 2]);
        assert_eq!((found.low[1], found.high[1]), ([-1.0, 0.0, 0.0], [0.0, 0.0, 9.0]));
        assert_eq!((found.low[2], found.high[2]), ([-1.0, 0.0, 0.0], [1.0, 2.0, 9.0]));
        assert_eq!(found.tight, [false, true, true]);
        assert_eq!(found.closed, [true, false, false]);
        assert_eq!((found.sound, found.bare, found.extent[1]), (vec![true; 3], vec![false; 3], 0.0));
    }

    #[test]
    fn opened_and_unsound_groups_are_not_culled() {
        let two = boxes([[[0.0; 3], [1.0; 3]]; 2]);
        let opened = two.opened(&[false, true]);
        assert_eq!((&opened.closed[..], &opened.cull[..]), (&[true, false][..], &[true, false][..]));
        assert_eq!(opened.sound, [true, true]);
        let unsound = two.unsound(&[true, false]);
        assert_eq!((&unsound.sound[..], &unsound.cull[..]), (&[false, true][..], &[false, true][..]));
        assert_eq!(unsound.closed, [true, true]);
    }

    #[test]
    fn boxes_meet_within_their_reach() {
        let row = boxes([[[0.0; 3], [1.0; 3]], [[2.0, 0.0, 0.0], [3.0, 1.0, 1.0]], [[9.0; 3], [10.0; 3]]]);
        assert_eq!(row.meeting(0.0), Some(vec![false; 3]));
        assert_eq!(row.meeting(0.6), Some(vec![true, true, false]));
        let mut one = boxes([[[0.0; 3], [1.0; 3]]; 2]);
        one.low[1] = [f64::INFINITY; 3];
        assert_eq!(one.meeting(1.0), Some(vec![false; 2]));
    }

    #[test]
    fn bare_meshes_touch_within_a_share_of_the_scene() {
        let depths = Depths { curved: 5.0, planar: 2.0, share: 0.5 };
        let mut groups = boxes([[[0.0; 3], [1.0; 3]], [[0.0; 3], [30.0, 40.0, 1.0]], [[0.0; 3], [1.0; 3]]]);
        groups.planar[2] = false;
        assert_eq!(groups.contact_depths(depths), [2.0, 2.0, 5.0]);
        groups.bare[1] = true;
        assert_eq!(groups.contact_depths(depths), [2.0, 0.5 * 2501f64.sqrt(), 5.0]);
    }
}
