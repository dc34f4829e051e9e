//! Cuts small loops off the contour of a mesh.
//!
//! Where a surface is hollow across its outline, as at the neck of a vase, an edge of the mesh's contour runs on beyond
//! the place where the next one crosses it, and short edges inside of the surface lead back:
//!
//! ```text
//!     i           j               i           j      i, j: two edges of the contour
//!      \         /                 \         /       a, b: where they end and begin; a third edge, hidden, leads
//!       \       /                   \       /              from a to b
//!        \     /       drawn as      \     /
//!         \   /                       \   /
//!          \ /                         \ /
//!          / \
//!         b---a
//! ```
//!
//! The surface that the mesh stands for has no such spikes. A loop is cut off if it has few edges and lies close to the
//! edges that stay. Where an outline ends at a cusp and the mesh is not coarse, the loop there has many edges, and stays.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::distance;
use crate::fit::plane::{dot, minus, to_segment};

/// A loop has at most this many edges, with the two that cross.
const MOST_EDGES: usize = 6;
/// Of the shorter one of the two edges: how far a loop may reach beside the edges that stay. Across a smooth edge a
/// surface turns by less than 30 degrees, so that a spike half as long as the edge lies a quarter of it beside the next.
const WIDTH: f64 = 0.3;

/// A place on a chain: the position of an edge, and the parameter along it in the sense of the walk.
pub type Place = (usize, f64);

/// Where a loop is cut off.
pub struct Joint {
    /// Whether nothing that is seen is lost: what comes before it and after it is seen, or it is hidden like these.
    pub fits: bool,
    /// The place that stands for both ends of the loop.
    pub place: Place,
}

/// What is left of a chain.
#[derive(Default)]
pub struct Kept {
    /// Per edge; none where nothing is cut off, and low > high where nothing is left.
    ranges: Vec<[f64; 2]>,
    /// Per edge that is cut off: the places that stand for where it begins, and where it ends.
    joints: FxHashMap<usize, [Option<Place>; 2]>,
}

const WHOLE: [f64; 2] = [0.0, 1.0];
const NOTHING: [f64; 2] = [1.0, 0.0];

impl Kept {
    /// Of edge k.
    pub fn range(&self, k: usize) -> [f64; 2] {
        self.ranges.get(k).copied().unwrap_or(WHOLE)
    }

    /// Of the two places at which a loop is cut off, the one that stands for both.
    pub fn joint(&self, place: Place) -> Place {
        let Some(joints) = self.joints.get(&place.0) else { return place };
        let at = |end: usize| joints[end].filter(|_| self.ranges[place.0][end] == place.1);
        at(0).or(at(1)).unwrap_or(place)
    }

    /// Cuts the loops off a walk of edges, from `first` on, of a chain of `count` edges.
    ///
    /// `flat`: its vertices in millimetres on paper; the last is the first if it is closed. `least`: loops that reach no
    /// farther than this (mm) beside the edges that stay are cut off, however short these are. `joint`: of two places of
    /// the chain that are one point on paper, and the edges between them.
    pub fn cut_off(
        &mut self,
        flat: &[[f64; 2]],
        first: usize,
        count: usize,
        least: f64,
        joint: impl Fn(Place, Place, &[usize]) -> Joint,
    ) {
        let edges = flat.len() - 1;
        for [from, to] in loops(flat, least) {
            let (i, j) = ((first + from.0, from.1), (first + to.0 % edges, to.1));
            let within = |place: Place| {
                let [low, high] = self.range(place.0);
                low < place.1 && place.1 < high
            };
            let inner: SmallVec<[usize; MOST_EDGES]> = (from.0 + 1..to.0).map(|k| first + k % edges).collect();
            if !(within(i) && within(j) && inner.iter().all(|&k| self.range(k) == WHOLE)) {
                continue;
            }
            let joint = joint(i, j, &inner);
            if joint.fits {
                self.ranges.resize(count, WHOLE);
                inner.iter().for_each(|&k| self.ranges[k] = NOTHING);
                self.ranges[i.0][1] = i.1;
                self.ranges[j.0][0] = j.1;
                self.joints.entry(i.0).or_default()[1] = Some(joint.place);
                self.joints.entry(j.0).or_default()[0] = Some(joint.place);
            }
        }
    }
}

/// The loops of a walk, those of most edges first, then the longest: so they do not depend on where it begins, and in
/// which sense it runs. On a closed walk of n edges edge n is edge 0, and so on.
fn loops(flat: &[[f64; 2]], least: f64) -> Vec<[Place; 2]> {
    let count = flat.len() - 1;
    let walk = Walk { flat, count, closed: flat[0] == flat[count] };
    let mut found: Vec<(usize, f64, [Place; 2])> = Vec::new();
    for i in 0..count {
        // The edge before i is met at a vertex only.
        let last = if walk.closed { i + count - 1 } else { count };
        for j in i + 2..(i + MOST_EDGES).min(last) {
            let Some((s, t)) = walk.crossing(i, j) else { continue };
            let wide = least.max(WIDTH * walk.length(i).min(walk.length(j)));
            if walk.is_narrow(i, j, s, wide) {
                let inner: f64 = (i + 1..j).map(|k| walk.length(k)).sum();
                let long = inner + (1.0 - s) * walk.length(i) + t * walk.length(j);
                found.push((j - i, long, [(i, s), (j, t)]));
            }
        }
    }
    found.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
    found.into_iter().map(|(_, _, cut)| cut).collect()
}

struct Walk<'a> {
    flat: &'a [[f64; 2]],
    /// Edges.
    count: usize,
    closed: bool,
}

impl Walk<'_> {
    /// The vertex before edge k; on a closed walk edges are counted on after the last.
    fn vertex(&self, k: usize) -> [f64; 2] {
        self.flat[if self.closed { k % self.count } else { k }]
    }

    fn length(&self, k: usize) -> f64 {
        distance(&self.vertex(k), &self.vertex(k + 1))
    }

    /// The parameters at which two edges cross, within both, if the second goes on roughly as the first.
    fn crossing(&self, i: usize, j: usize) -> Option<(f64, f64)> {
        let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
        let (a, c) = (self.vertex(i), self.vertex(j));
        let (u, v, w) = (minus(&self.vertex(i + 1), &a), minus(&self.vertex(j + 1), &c), minus(&c, &a));
        if dot(&u, &v) <= 0.0 {
            return None;
        }
        let area = cross(u, v);
        let (s, t) = (cross(w, v) / area, cross(w, u) / area);
        (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0).then_some((s, t))
    }

    /// Whether the corners of the loop lie close to the edges that stay: two before it, and two after it.
    fn is_narrow(&self, i: usize, j: usize, s: f64, wide: f64) -> bool {
        let (a, b) = (self.vertex(i), self.vertex(i + 1));
        let cut = [0, 1].map(|k| a[k] + s * (b[k] - a[k]));
        let before = if self.closed { [i + self.count - 1, i] } else { [i.saturating_sub(1), i] };
        let after = [j + 1, if self.closed { j + 2 } else { (j + 2).min(self.count) }];
        let stay =
            [before.map(|k| self.vertex(k)).to_vec(), vec![cut], after.map(|k| self.vertex(k)).to_vec()].concat();
        let is_near = |p: [f64; 2]| stay.windows(2).any(|side| to_segment(&p, &side[0], &side[1]).0 <= wide);
        (i + 1..=j).all(|k| is_near(self.vertex(k)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The outline of a neck: chords of a circle, seen from outside, each of which runs on beyond the next one.
    fn neck(count: usize, spike: f64) -> Vec<[f64; 2]> {
        let angle = std::f64::consts::TAU / count as f64;
        let long = 10.0 * (0.5 * angle).tan() + spike;
        let point = |k: usize, along: f64| {
            let (s, c) = (angle * k as f64).sin_cos();
            [10.0 * c - along * s, 10.0 * s + along * c]
        };
        (0..count).flat_map(|k| [point(k, -long), point(k, long)]).collect()
    }

    fn closed(mut flat: Vec<[f64; 2]>, first: usize) -> Vec<[f64; 2]> {
        flat.rotate_left(first);
        flat.push(flat[0]);
        flat
    }

    #[test]
    fn spikes_are_cut_off_wherever_a_closed_outline_begins() {
        let flat = neck(20, 0.2);
        for first in 0..6 {
            let found = loops(&closed(flat.clone(), first), 0.0);
            assert_eq!(found.len(), 20, "{first}: {found:?}");
            assert!(found.iter().all(|[from, to]| to.0 == from.0 + 2 && (from.1 + to.1 - 1.0).abs() < 1e-9));
            assert!(found.iter().filter(|cut| cut[1].0 >= 40).count() == 1, "{first}");
        }
        // An open outline has one place less to cut.
        assert_eq!(loops(&flat, 0.0).len(), 19);
    }

    #[test]
    fn what_is_left_does_not_depend_on_where_the_walk_begins_and_in_which_sense_it_runs() {
        // Chords of uneven lengths, so that loops lie within one another and overlap.
        let mut flat = neck(24, 0.3);
        flat.iter_mut().enumerate().for_each(|(i, p)| p[0] += 0.9 * ((7 * i + i * i) % 11) as f64 / 11.0);
        let left = |flat: Vec<[f64; 2]>| {
            let mut kept = Kept::default();
            kept.cut_off(&flat, 0, flat.len() - 1, 0.1, |place, _, _| Joint { fits: true, place });
            let at = |k: usize, t: f64| [0, 1].map(|i| flat[k][i] + t * (flat[k + 1][i] - flat[k][i]));
            let there = (0..flat.len() - 1).map(|k| (k, kept.range(k))).filter(|(_, [low, high])| low < high);
            let mut ends: Vec<[[i64; 2]; 2]> = there
                .map(|(k, range)| range.map(|t| at(k, t).map(|c| (c * 1e6).round() as i64)))
                .map(|[a, b]| if a < b { [a, b] } else { [b, a] })
                .collect();
            ends.sort_unstable();
            ends
        };
        let one = left(closed(flat.clone(), 0));
        assert!(one.len() < flat.len());
        for first in 1..flat.len() {
            assert_eq!(left(closed(flat.clone(), first)), one, "{first}");
        }
        flat.reverse();
        assert_eq!(left(closed(flat, 5)), one);
    }

    #[test]
    fn what_is_left_of_edges_ends_in_one_point() {
        let flat = closed(neck(20, 0.2), 1);
        let mut kept = Kept::default();
        kept.cut_off(&flat, 3, 50, 0.0, |place, _, _| Joint { fits: true, place });
        assert_eq!((kept.range(0), kept.range(60)), ([0.0, 1.0], [0.0, 1.0]), "not of this walk");
        let gone = (3..43).filter(|&k| kept.range(k)[0] > kept.range(k)[1]).count();
        assert_eq!(gone, 20);
        for k in (3..43).filter(|&k| kept.range(k)[0] < kept.range(k)[1]) {
            let [low, _] = kept.range(k);
            let before = kept.joint((k, low));
            assert_eq!(kept.range(before.0)[1], before.1, "{k}");
            assert_eq!(kept.joint((k, 0.5)), (k, 0.5));
            let at = |(k, t): Place| [0, 1].map(|i| flat[k - 3][i] + t * (flat[k - 2][i] - flat[k - 3][i]));
            assert!(distance(&at(before), &at((k, low))) < 1e-9);
        }
    }

    #[test]
    fn wide_loops_and_those_of_many_edges_stay() {
        // Up to one side, back across in some steps, and down to the other side.
        let spike = |high: f64, steps: usize| {
            let back = |k: usize| [9.0 - 8.0 * k as f64 / steps as f64, high];
            [vec![[0.0, 0.0]], (0..=steps).map(back).collect(), vec![[10.0, 0.0]]].concat()
        };
        assert_eq!(loops(&spike(1.0, 1), 0.0).len(), 1);
        assert!(loops(&spike(5.0, 1), 0.0).is_empty());
        assert_eq!(loops(&spike(5.0, 1), 6.0).len(), 1, "however short the edges");
        assert_eq!(loops(&spike(1.0, MOST_EDGES - 2), 0.0).len(), 1);
        assert!(loops(&spike(1.0, MOST_EDGES - 1), 0.0).is_empty());
        // What crosses nothing has none, and neither has a triangle.
        assert!(loops(&closed(neck(20, -0.2), 0), 1.0).is_empty());
        assert!(loops(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], 1.0).is_empty());
    }
}
