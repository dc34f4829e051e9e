//! The edges of chains on paper and in space, and the pieces into which visibility divides them.

use super::camera::Camera;
use super::distance;
use super::loops::{Joint, Kept, Place};
use hlr_accuracy::RUN_NOISE;
use hlr_visibility::scan::invisibility::State;

/// Hidden runs of fewer mean edge lengths of the chain are noise.
const NOISE_EDGES: f64 = 2.5;

/// A piece of one mesh edge; parameters run from the edge's first to its second vertex.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub start: f64,
    pub end: f64,
    pub state: State,
}

/// All edges of a mesh, and the pieces of those that are drawn. Only what the chains use is looked at.
pub struct Geometry<'a> {
    pub camera: &'a Camera,
    /// Model coordinates.
    pub space: &'a [[f64; 3]],
    /// The same before points moved onto true intersection lines: where visibility was decided.
    pub meshed: &'a [[f64; 3]],
    pub edges: &'a [[i32; 2]],
    /// Sorted by edge, those of one edge along it; and the edge of each.
    pub pieces: &'a [Piece],
    pub piece_edge: &'a [i32],
}

impl Geometry<'_> {
    /// A point in millimetres on paper.
    pub(super) fn flat(&self, point: usize) -> [f64; 2] {
        self.camera.point(&self.space[point])
    }

    pub(super) fn pieces_of(&self, edge: i32) -> &[Piece] {
        let first = self.piece_edge.partition_point(|&e| e < edge);
        let count = self.piece_edge[first..].iter().take_while(|&&e| e == edge).count();
        &self.pieces[first..first + count]
    }

    /// The length (mm on paper) below which hidden runs of a mesh contour are noise. On saddle-shaped surfaces such a
    /// contour folds back and forth by an edge or two and hides itself there.
    pub fn noise(&self, edges: &[i32], short: f64) -> f64 {
        let ends = edges.iter().map(|&e| self.edges[e as usize]);
        let total: f64 = ends.map(|[a, b]| distance(&self.flat(a as usize), &self.flat(b as usize))).sum();
        short.max((NOISE_EDGES * total / edges.len().max(1) as f64).min(RUN_NOISE * short))
    }
}

/// The edges of one chain, in the order of a walk.
pub(super) struct Chain<'a> {
    pub(super) geometry: &'a Geometry<'a>,
    pub(super) edges: &'a [i32],
    pub(super) reversed: &'a [bool],
    /// What is left of it where loops are cut off.
    pub(super) kept: Kept,
}

impl Chain<'_> {
    /// Cuts off small loops, walk by walk: an edge that is clipped, or does not go on from the one before, begins another.
    pub(super) fn cut_off_loops(&mut self, least: f64) {
        let g = self.geometry;
        let count = self.edges.len();
        let is_there = |k: usize| !g.pieces_of(self.edges[k]).is_empty();
        let goes_on = |k: &usize| is_there(*k) && self.ends(*k - 1).1 == self.ends(*k).0;
        let mut kept = Kept::default();
        let mut first = 0;
        while first < count {
            let end = (first + 1..count).find(|k| !goes_on(k)).unwrap_or(count);
            if is_there(first) {
                let vertices = [self.ends(first).0].into_iter().chain((first..end).map(|k| self.ends(k).1));
                let flat: Vec<[f64; 2]> = vertices.map(|v| g.flat(v)).collect();
                kept.cut_off(&flat, first, count, least, |from, to, inner| self.joint(from, to, inner, least));
            }
            first = end;
        }
        self.kept = kept;
    }

    /// Of a loop from one place to another, which lies behind it or before it, over the edges `inner`. Where the line is
    /// seen, the nearer place stands for both, for nothing hides it. Where two edges cross, one may begin to hide the other,
    /// so the line is looked at for `beside` (mm) before the loop and after it.
    fn joint(&self, from: Place, to: Place, inner: &[usize], beside: f64) -> Joint {
        let share = |place: Place| beside / self.length(place.0);
        let before = self.seen(from.0, from.1 - share(from), from.1) > 0.0;
        let after = self.seen(to.0, to.1, to.1 + share(to)) > 0.0;
        let ends = || self.seen(from.0, from.1, 1.0) + self.seen(to.0, 0.0, to.1);
        let of_loop = || ends() + inner.iter().map(|&k| self.seen(k, 0.0, 1.0)).sum::<f64>();
        let depth = |place: Place| self.geometry.camera.view().depth(&self.at(place).1);
        let place = if (depth(from) <= depth(to)) == before { from } else { to };
        Joint { fits: before == after && (before || of_loop() <= beside), place }
    }

    /// How much of edge k is seen between two parameters of the walk, in millimetres on paper.
    fn seen(&self, k: usize, from: f64, to: f64) -> f64 {
        let (low, high) = if self.reversed[k] { (1.0 - to, 1.0 - from) } else { (from, to) };
        let pieces = self.geometry.pieces_of(self.edges[k]).iter().filter(|piece| piece.state != State::Hidden);
        let share: f64 = pieces.map(|piece| (piece.end.min(high) - piece.start.max(low)).max(0.0)).sum();
        share * self.length(k)
    }

    /// Of edge k, in millimetres on paper.
    fn length(&self, k: usize) -> f64 {
        let (a, b) = self.ends(k);
        distance(&self.geometry.flat(a), &self.geometry.flat(b))
    }

    pub(super) fn ends(&self, k: usize) -> (usize, usize) {
        let [a, b] = self.geometry.edges[self.edges[k] as usize];
        if self.reversed[k] { (b as usize, a as usize) } else { (a as usize, b as usize) }
    }

    pub(super) fn at(&self, place: Place) -> ([f64; 2], [f64; 3]) {
        let g = self.geometry;
        let (k, t) = self.kept.joint(place);
        let (a, b) = self.ends(k);
        if t <= 0.0 {
            return (g.flat(a), g.space[a]);
        }
        if t >= 1.0 {
            return (g.flat(b), g.space[b]);
        }
        let (view, p, q) = (g.camera.view(), &g.space[a], &g.space[b]);
        let u = view.in_space(t, view.depth(p), view.depth(q));
        let mix = |x: f64, y: f64, t: f64| x + (y - x) * t;
        let ends = [g.flat(a), g.flat(b)];
        let flat = [0, 1].map(|k| mix(ends[0][k], ends[1][k], t));
        (flat, [mix(p[0], q[0], u), mix(p[1], q[1], u), mix(p[2], q[2], u)])
    }
}
