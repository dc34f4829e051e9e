//! Properties of groups: triangles that are treated as one surface.

type Vec3 = [f64; 3];

/// Columns with one entry per group.
#[derive(Clone, Debug, Default, PartialEq)]
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
    pub without_brep: Vec<bool>,
    /// Lines that lie exactly on other groups' triangles.
    pub tight: Vec<bool>,
    /// Only planar faces.
    pub planar: Vec<bool>,
    /// Its thickness; the smallest side of its box where that is less or it is open. Model units.
    pub extent: Vec<f64>,
    /// Its box; the lower corner is beyond the upper one where it is empty.
    pub low: Vec<Vec3>,
    pub high: Vec<Vec3>,
    /// Pairs of groups that have an intersection line: the lower number first, each pair once, ascending. No column.
    pub crossing: Vec<[i32; 2]>,
}

impl Groups {
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
        for column in [&mut out.closed, &mut out.cull, &mut out.inward, &mut out.without_brep] {
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

    /// These groups, of which these pairs have intersection lines.
    pub fn with_crossing(&self, pairs: &[[i32; 2]]) -> Groups {
        let mut crossing: Vec<[i32; 2]> = pairs.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        crossing.sort_unstable();
        crossing.dedup();
        Groups { crossing, ..self.clone() }
    }

    /// These groups where some pass through themselves: they are neither sound nor culled.
    pub fn unsound(&self, which: &[bool]) -> Groups {
        let mut out = self.clone();
        for g in (0..which.len()).filter(|&g| which[g]) {
            (out.sound[g], out.cull[g]) = (false, false);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tests::{built, tetrahedra};

    #[test]
    fn wires_of_one_owner_are_one_group() {
        let points = [[0.0; 3], [1.0, 2.0, 3.0], [-1.0, 0.0, 9.0]];
        let one = built(&tetrahedra(&[(0.0, 1.0)], &[true])).bodies.groups;
        let (found, group) = one.with_wires(&points, &[[0, 1], [0, 2], [1, 2]], &[7, 3, 7], true);
        assert_eq!(group, [2, 1, 2]);
        assert_eq!((found.low[1], found.high[1]), ([-1.0, 0.0, 0.0], [0.0, 0.0, 9.0]));
        assert_eq!((found.low[2], found.high[2]), ([-1.0, 0.0, 0.0], [1.0, 2.0, 9.0]));
        assert_eq!(found.tight, [false, true, true]);
        assert_eq!(found.closed, [true, false, false]);
        assert_eq!(
            (found.sound, found.without_brep, found.extent[1]),
            (vec![false, true, true], vec![true, false, false], 0.0)
        );
    }

    #[test]
    fn opened_and_unsound_groups_are_not_culled() {
        let all = || vec![true; 2];
        let two = Groups { closed: all(), cull: all(), sound: all(), ..Groups::default() };
        let opened = two.opened(&[false, true]);
        assert_eq!((&opened.closed[..], &opened.cull[..]), (&[true, false][..], &[true, false][..]));
        assert_eq!(opened.sound, [true, true]);
        let unsound = two.unsound(&[true, false]);
        assert_eq!((&unsound.sound[..], &unsound.cull[..]), (&[false, true][..], &[false, true][..]));
        assert_eq!(unsound.closed, [true, true]);
    }
}
