//! How deep surfaces touch in a view, and which groups come that near another one.

use hlr_mesh::groups::Groups;

use super::Vec3;
use crate::boxes::meeting::boxes_meet;

/// What is asked of a camera.
pub trait Look {
    /// Of a perspective view, the distance from the eye to the image plane.
    fn distance(&self) -> Option<f64>;
    /// Of a perspective view, the distance of a point from the eye's plane, positive in front of the eye.
    fn ahead(&self, p: &Vec3) -> f64;
    /// Coordinates to the right, up, and away from the viewer.
    fn image(&self, p: &Vec3) -> Vec3;
}

/// Depths in model units within which surfaces touch: of B-rep groups with curved faces, and of those with planar faces
/// alone; share: of the scene's diagonal, for meshes without B-rep.
#[derive(Clone, Copy, Debug)]
pub struct Depths {
    pub curved: f64,
    pub planar: f64,
    pub share: f64,
}

impl Depths {
    /// Per group: a surface nearer than this touches it. Model units.
    pub fn of_groups(self, groups: &Groups) -> Vec<f64> {
        let least = if groups.without_brep.contains(&true) { self.share * diagonal(groups) } else { 0.0 };
        let depth = |g: usize| {
            let own = if groups.planar[g] { self.planar } else { self.curved };
            if groups.without_brep[g] { own.max(least) } else { own }
        };
        (0..groups.len()).map(depth).collect()
    }
}

/// Of the box around all groups.
fn diagonal(groups: &Groups) -> f64 {
    let used = || (0..groups.len()).filter(|&g| groups.used(g));
    let side = |k: usize| {
        let low = used().map(|g| groups.low[g][k]).fold(f64::INFINITY, f64::min);
        used().map(|g| groups.high[g][k]).fold(f64::NEG_INFINITY, f64::max) - low
    };
    [0, 1, 2].map(side).iter().map(|s| s * s).sum::<f64>().sqrt()
}

/// Per group, in depth units of the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// What is hidden by less counts as touching.
    pub delta: Vec<f64>,
    /// The most that anything is moved before it is compared with this group: half of its thickness.
    pub cap: Vec<f64>,
}

/// Of the eye's distance from the image plane: nothing nearer to the eye is drawn (`NEAR` in `hlr/image/camera.py`).
const NEAREST: f64 = 1e-3;

impl Contact {
    /// rounding: depth within which lines touch the surfaces on which they lie, model units.
    pub fn of(groups: &Groups, look: &impl Look, depths: Depths, rounding: f64) -> Contact {
        let mut delta = depths.of_groups(groups);
        let tight = delta.iter_mut().zip(&groups.tight).filter(|(_, tight)| **tight);
        tight.for_each(|(delta, _)| *delta = rounding);
        // Half a part's thickness at most, or the far side of a thin sheet would show through. An open sheet may have
        // no thickness: it gets at least the rounding of its file.
        let half = |g: usize| 0.5 * groups.extent[g];
        let cap = |g: usize| if groups.closed[g] { half(g) } else { half(g).max(rounding) };
        let mut cap: Vec<f64> = (0..groups.len()).map(cap).collect();
        if let Some(distance) = look.distance() {
            for g in 0..groups.len() {
                let slope = slope(groups, g, look, distance);
                delta[g] = delta[g] * slope * slope;
                cap[g] = cap[g] * slope * slope;
            }
        }
        Contact { delta, cap }
    }
}

/// Depth in perspective is -distance² / z. The root of its slope at the group's centre, or, where the group surrounds
/// the eye, halfway to its far end: a slope taken near the eye would let everything beyond show through.
fn slope(groups: &Groups, g: usize, look: &impl Look, distance: f64) -> f64 {
    let box_of = if groups.used(g) { [groups.low[g], groups.high[g]] } else { [[0.0; 3]; 2] };
    let ahead = corners(box_of).map(|c| look.ahead(&c));
    let mean = ahead.iter().sum::<f64>() / 8.0;
    let far = ahead.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    distance / mean.max(0.5 * far).max(distance * NEAREST)
}

fn corners(of: [Vec3; 2]) -> [Vec3; 8] {
    std::array::from_fn(|i| [of[i >> 2 & 1][0], of[i >> 1 & 1][1], of[i & 1][2]])
}

/// Per group: its box, `reach` wider on all sides, meets that of another. None where they lie too far apart for a grid.
pub fn meeting(groups: &Groups, reach: f64) -> Option<Vec<bool>> {
    if (0..groups.len()).filter(|&g| groups.used(g)).nth(1).is_none() {
        return Some(vec![false; groups.len()]);
    }
    let moved = |corners: &[Vec3], by: f64| corners.iter().map(|c| c.map(|c| c + by)).collect::<Vec<_>>();
    boxes_meet(&moved(&groups.low, -reach), &moved(&groups.high, reach))
}

/// How many groups come within the contact tolerance of another: their boxes, grown by it, meet. None where they lie too
/// far apart for a grid.
///
/// The boxes lie along the model's axes in parallel views, where depth is a distance. In perspective it is not: there
/// they are boxes around the images of the corners. delta: per group; spare: the factor of the largest that covers all
/// rounding; lift: how far lines may be off their surfaces, model units.
pub fn coming_near(groups: &Groups, look: &impl Look, delta: &[f64], spare: f64, lift: f64) -> Option<usize> {
    let used: Vec<usize> = (0..groups.len()).filter(|&g| groups.used(g)).collect();
    if used.len() < 2 {
        return Some(0);
    }
    let most = spare * used.iter().map(|&g| delta[g]).fold(0.0, f64::max);
    let lifted = |&g: &usize| [groups.low[g].map(|c| c - lift), groups.high[g].map(|c| c + lift)];
    let (low, high): (Vec<Vec3>, Vec<Vec3>) = match look.distance() {
        None => {
            let by = 0.5 * most;
            used.iter().map(lifted).map(|[low, high]| (low.map(|c| c - by), high.map(|c| c + by))).unzip()
        }
        Some(distance) => {
            let around: Vec<[Vec3; 8]> = used.iter().map(lifted).map(corners).collect();
            if around.iter().flatten().any(|c| look.ahead(c) <= NEAREST * distance) {
                return Some(used.len());
            }
            around.iter().map(|corners| seen(&corners.map(|c| look.image(&c)), 0.5 * most)).unzip()
        }
    };
    Some(boxes_meet(&low, &high)?.iter().filter(|meets| **meets).count())
}

/// The box around points of the image, deeper by `deeper` at both ends.
fn seen(points: &[Vec3; 8], deeper: f64) -> (Vec3, Vec3) {
    let mut low = points.iter().fold([f64::INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].min(p[k])));
    let mut high = points.iter().fold([f64::NEG_INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].max(p[k])));
    low[2] -= deeper;
    high[2] += deeper;
    (low, high)
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
            without_brep: vec![false; N],
            tight: vec![false; N],
            planar: vec![true; N],
            extent: vec![1.0; N],
            low: corners.map(|c| c[0]).to_vec(),
            high: corners.map(|c| c[1]).to_vec(),
            crossing: Vec::new(),
        }
    }

    /// From above; with an eye at the origin's height where `distance` is given.
    struct Above(Option<f64>);

    impl Look for Above {
        fn distance(&self) -> Option<f64> {
            self.0
        }

        fn ahead(&self, p: &Vec3) -> f64 {
            -p[2]
        }

        fn image(&self, p: &Vec3) -> Vec3 {
            let Some(distance) = self.0 else { return [p[0], p[1], -p[2]] };
            let factor = distance / -p[2];
            [p[0] * factor, p[1] * factor, -distance * factor]
        }
    }

    const DEPTHS: Depths = Depths { curved: 5.0, planar: 2.0, share: 0.5 };

    #[test]
    fn tolerances_are_capped_by_half_the_thickness() {
        let mut groups = boxes([[[0.0; 3], [1.0; 3]]; 3]);
        groups.tight[1] = true;
        groups.closed[2] = false;
        groups.extent[2] = 0.0;
        let found = Contact::of(&groups, &Above(None), DEPTHS, 0.25);
        assert_eq!(found, Contact { delta: vec![2.0, 0.25, 2.0], cap: vec![0.5, 0.5, 0.25] });
    }

    #[test]
    fn depth_is_steep_near_the_eye_and_no_steeper_around_it() {
        let at = |near: f64, far: f64| [[0.0, 0.0, -far], [1.0, 1.0, -near]];
        let groups = boxes([at(9.0, 11.0), at(19.0, 21.0), at(-30.0, 10.0)]);
        let found = Contact::of(&groups, &Above(Some(10.0)), DEPTHS, 0.25);
        assert_eq!(found.delta, [2.0, 0.5, 8.0]);
        assert_eq!(found.cap, [0.5, 0.125, 2.0]);
    }

    #[test]
    fn groups_come_near_within_their_tolerance() {
        let groups = boxes([[[0.0, 0.0, -10.0], [1.0, 1.0, -9.0]], [[0.0, 0.0, -8.0], [1.0, 1.0, -7.0]]]);
        let near = |look: &Above, delta: f64, lift: f64| coming_near(&groups, look, &[delta; 2], 1.0, lift);
        for look in [Above(None), Above(Some(10.0))] {
            assert_eq!(near(&look, 0.5, 0.0), Some(0));
            assert_eq!(near(&look, 2.5, 0.0), Some(2));
            assert_eq!(near(&look, 0.7, 0.3), Some(2));
        }
        // The eye is within a box.
        assert_eq!(near(&Above(Some(10.0)), 0.0, 7.0), Some(2));
        assert_eq!(coming_near(&boxes([[[0.0; 3], [1.0; 3]]]), &Above(None), &[9.0], 1.0, 9.0), Some(0));
    }

    #[test]
    fn boxes_meet_within_their_reach() {
        let row = boxes([[[0.0; 3], [1.0; 3]], [[2.0, 0.0, 0.0], [3.0, 1.0, 1.0]], [[9.0; 3], [10.0; 3]]]);
        assert_eq!(meeting(&row, 0.0), Some(vec![false; 3]));
        assert_eq!(meeting(&row, 0.6), Some(vec![true, true, false]));
        let mut one = boxes([[[0.0; 3], [1.0; 3]]; 2]);
        one.low[1] = [f64::INFINITY; 3];
        assert_eq!(meeting(&one, 1.0), Some(vec![false; 2]));
    }

    #[test]
    fn bare_meshes_touch_within_a_share_of_the_scene() {
        let mut groups = boxes([[[0.0; 3], [1.0; 3]], [[0.0; 3], [30.0, 40.0, 1.0]], [[0.0; 3], [1.0; 3]]]);
        groups.planar[2] = false;
        assert_eq!(DEPTHS.of_groups(&groups), [2.0, 2.0, 5.0]);
        groups.without_brep[1] = true;
        assert_eq!(DEPTHS.of_groups(&groups), [2.0, 0.5 * 2501f64.sqrt(), 5.0]);
    }
}
