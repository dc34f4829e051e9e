//! Fits cubic curves to a smoothed contour from corner to corner, divided at the kept vertices until they are close
//! enough.

use super::bezier::at;
use super::cubic::cubic;
use super::plane::{Vec2, minus, to_segment};
use crate::lines::distance;

/// Samples on each side of the contour besides its vertices.
const BETWEEN: usize = 2;
/// Places on a curve that are compared with the contour.
const PLACES: usize = 16;

/// One cubic curve along way[from..=to].
pub struct Piece {
    pub from: usize,
    pub to: usize,
    pub points: [Vec2; 4],
    pub straight: bool,
}

pub struct Fitting<'a> {
    way: &'a [Vec2],
    kept: &'a [usize],
    tangents: &'a [Option<Vec2>],
    /// Length along the kept vertices to each of them.
    along: Vec<f64>,
    misfit: f64,
    pub pieces: Vec<Piece>,
}

impl<'a> Fitting<'a> {
    pub fn new(way: &'a [Vec2], kept: &'a [usize], tangents: &'a [Option<Vec2>], misfit: f64) -> Fitting<'a> {
        let mut along = vec![0.0];
        for w in kept.windows(2) {
            along.push(along[along.len() - 1] + distance(&way[w[0]], &way[w[1]]));
        }
        Fitting { way, kept, tangents, along, misfit, pieces: Vec::new() }
    }

    /// Curves from corner to corner, through pinned vertices.
    pub fn all(&mut self, fixed: &[bool]) {
        let last = self.kept.len() - 1;
        let mut start = 0;
        for i in 1..=last {
            if i == last || self.tangents[i].is_none() || fixed[self.kept[i]] {
                self.between(start, i);
                start = i;
            }
        }
    }

    /// Curves from one kept vertex to another.
    fn between(&mut self, a: usize, b: usize) {
        let (from, to) = (self.kept[a], self.kept[b]);
        let none = self.tangents[a].is_none() && self.tangents[b].is_none();
        let split = match self.curve(a, b) {
            _ if b == a + 1 && none => None,
            Ok(points) => {
                self.pieces.push(Piece { from, to, points, straight: false });
                return;
            }
            Err(split) => split,
        };
        match split {
            Some(middle) => {
                self.between(a, middle);
                self.between(middle, b);
            }
            None => {
                let (p, q) = (self.way[from], self.way[to]);
                let third = |s: f64| [0, 1].map(|k| p[k] + (q[k] - p[k]) * s);
                self.pieces.push(Piece {
                    from,
                    to,
                    points: [p, third(1.0 / 3.0), third(2.0 / 3.0), q],
                    straight: true,
                });
            }
        }
    }

    /// The curve between two kept vertices; or, if none is close enough, the kept vertex at which to divide (if any).
    fn curve(&self, a: usize, b: usize) -> Result<[Vec2; 4], Option<usize>> {
        let samples = self.samples(a, b);
        let last = samples.len() - 1;
        let end = |i: usize, p: Vec2, q: Vec2| self.tangents[i].unwrap_or_else(|| minus(&q, &p));
        let mut asked: Vec<[Vec2; 2]> = samples.iter().map(|s| [s.1, [0.0; 2]]).collect();
        // At open ends and corners the tangent is the chord to the next kept vertex: the first sample is noisy.
        let shape = |i: usize| self.way[self.kept[i]];
        asked[0][1] = end(a, shape(a), shape(a + 1));
        asked[last][1] = end(b, shape(b - 1), shape(b));
        let (points, mut error) = cubic(&asked);
        for k in 1..PLACES {
            let p = at(&points, k as f64 / PLACES as f64);
            let off = (self.kept[a]..self.kept[b])
                .map(|i| to_segment(&p, &self.way[i], &self.way[i + 1]).0)
                .fold(f64::INFINITY, f64::min);
            error = error.max(off);
        }
        if error <= self.misfit {
            return Ok(points);
        }
        let half = 0.5 * (self.along[a] + self.along[b]);
        let off = |k: usize| (self.along[k] - half).abs();
        Err((a + 1..b).min_by(|&i, &j| off(i).total_cmp(&off(j))))
    }

    /// Points of the contour from one kept vertex to another, in order along the kept chords, even where the contour
    /// itself runs back and forth.
    fn samples(&self, a: usize, b: usize) -> Vec<(f64, Vec2)> {
        let mut out = Vec::new();
        let mut start = 0.0;
        for w in self.kept[a..=b].windows(2) {
            let (p, q) = (&self.way[w[0]], &self.way[w[1]]);
            let size = distance(p, q);
            out.push((start, *p));
            let first = out.len();
            for i in w[0]..w[1] {
                let (u, v) = (&self.way[i], &self.way[i + 1]);
                for j in 0..=BETWEEN {
                    let s = j as f64 / (BETWEEN + 1) as f64;
                    let place = [u[0] + (v[0] - u[0]) * s, u[1] + (v[1] - u[1]) * s];
                    if i > w[0] || j > 0 {
                        out.push((start + size * to_segment(&place, p, q).1, place));
                    }
                }
            }
            out[first..].sort_by(|x, y| x.0.total_cmp(&y.0));
            start += size;
        }
        out.push((start, self.way[self.kept[b]]));
        out
    }
}
