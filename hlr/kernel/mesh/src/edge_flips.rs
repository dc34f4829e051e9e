//! Edge flips that remove needles: triangles whose three corners lie in one line but for rounding.
//!
//! Exporters put them where a vertex of a neighbour lies on an edge. The longest side of a needle a b c becomes the
//! other diagonal of its two triangles; the surface moves by no more than the needle is high, whatever the fold there:
//!
//! ```text
//!        d                     d
//!      /   \                 / | \
//!    /       \      ->     /   |   \
//!   c --------- a         c ---|--- a
//!     `-. b .-'             `- b -'
//! ```

use super::listed_twice::ListedTwice;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap, HashSet, VecDeque};

/// Share of the longest side: a triangle lower than this is a needle however exact the coordinates are.
const ROUNDING: f64 = 1e-6;

/// Share of the longest side: a triangle higher than this is no needle however coarse the coordinates are.
const SLENDER: f64 = 4e-3;

/// A flip must make the lower triangle of the two at least this many times as high as before.
const HIGHER: f64 = 2.0;

/// Limit of flips per needle, on average: rows of needles on one side take several each.
const ROUNDS: usize = 16;

/// The triangles that changed, ascending.
#[derive(Debug, Default, PartialEq)]
pub struct Turned {
    pub triangle: Vec<u32>,
    pub corners: Vec<[i32; 3]>,
    /// Per changed triangle: the earlier triangle whose face and colour it has now. A needle takes those of its
    /// neighbour.
    pub like: Vec<u32>,
    /// Where each corner was before the flips: three times the triangle, plus 0..3.
    pub stood: Vec<[u32; 3]>,
}

/// Flips needles; `low`, in model units: a triangle lower than this has no normal that the coordinates support.
///
/// An edge is flipped only where it has two triangles, oppositely oriented, and the other diagonal is no edge yet. Where
/// triangles are listed from both sides, both sides are flipped.
pub fn without_needles(points: &[[f64; 3]], triangles: &[[i32; 3]], low: f64) -> Turned {
    let shapes = Shapes { points, low };
    let needles: Vec<u32> = (0..triangles.len() as u32)
        .into_par_iter()
        .with_min_len(1 << 10)
        .filter(|&t| shapes.is_needle(triangles[t as usize]))
        .collect();
    if needles.is_empty() {
        return Turned::default();
    }
    let mut work = Work::new(shapes, triangles, &needles);
    let first: Vec<u32> = needles.into_iter().filter(|&t| !work.listed_twice.comes_later(t)).collect();
    work.run(&first);
    let mut turned = Turned::default();
    for (t, now) in work.with_copies() {
        turned.triangle.push(t);
        turned.corners.push(now.corners);
        turned.like.push(now.like);
        turned.stood.push(now.stood);
    }
    turned
}

struct Shapes<'a> {
    points: &'a [[f64; 3]],
    low: f64,
}

impl Shapes<'_> {
    fn square(&self, a: i32, b: i32) -> f64 {
        let (p, q) = (&self.points[a as usize], &self.points[b as usize]);
        (0..3).map(|c| (q[c] - p[c]) * (q[c] - p[c])).sum()
    }

    /// Returns the square of height / longest side, the square of the longest side, and that side's number.
    fn measures(&self, t: [i32; 3]) -> (f64, f64, usize) {
        let squares = [0, 1, 2].map(|k| self.square(t[k], t[(k + 1) % 3]));
        let longest = (1..3).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
        // Computed from the corner opposite the longest side: its two sides are the short ones, and their cross product
        // is the most exact.
        let [o, p, q] = [2, 0, 1].map(|k| &self.points[t[(longest + k) % 3] as usize]);
        let [u, v] = [p, q].map(|p| [0, 1, 2].map(|c| p[c] - o[c]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let area = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        (area / squares[longest], squares[longest], longest)
    }

    fn height(&self, t: [i32; 3]) -> f64 {
        self.measures(t).0
    }

    /// Runs for every triangle, so it needs no divisions and roots.
    fn is_needle(&self, t: [i32; 3]) -> bool {
        let [p, q, r] = t.map(|v| &self.points[v as usize]);
        let (u, v) = ([q[0] - p[0], q[1] - p[1], q[2] - p[2]], [r[0] - p[0], r[1] - p[1], r[2] - p[2]]);
        let w = [r[0] - q[0], r[1] - q[1], r[2] - q[2]];
        let dot = |s: &[f64; 3]| s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let longest = dot(&u).max(dot(&v)).max(dot(&w));
        let least = (self.low * self.low).min(SLENDER * SLENDER * longest).max(ROUNDING * ROUNDING * longest);
        dot(&n) <= least * longest
    }
}

/// Result of trying to flip a triangle's longest side.
#[derive(Clone, Copy)]
struct Now {
    corners: [i32; 3],
    like: u32,
    stood: [u32; 3],
}

impl Now {
    /// The same from the other side.
    fn reversed(self) -> Now {
        let ([a, b, c], [i, j, k]) = (self.corners, self.stood);
        Now { corners: [a, c, b], stood: [i, k, j], ..self }
    }
}

/// The first two triangles at an edge, and how many there are.
#[derive(Clone, Copy, Default)]
struct Edge {
    triangles: [u32; 2],
    count: u32,
}

struct Work<'a> {
    shapes: Shapes<'a>,
    triangles: &'a [[i32; 3]],
    changed: BTreeMap<u32, Now>,
    /// Corners of needles, and all edges that end there.
    near: HashSet<i32>,
    /// Of triangles with such a corner. Only the first of each set is worked on.
    listed_twice: ListedTwice,
    edges: HashMap<(i32, i32), Edge>,
}

fn key(a: i32, b: i32) -> (i32, i32) {
    (a.min(b), a.max(b))
}

impl<'a> Work<'a> {
    fn new(shapes: Shapes<'a>, triangles: &'a [[i32; 3]], needles: &[u32]) -> Self {
        let near: HashSet<i32> = needles.iter().flat_map(|&t| triangles[t as usize]).collect();
        let mut is_near = vec![false; shapes.points.len()];
        near.iter().for_each(|&v| is_near[v as usize] = true);
        let listed_twice = ListedTwice::of(triangles, |corners| corners.iter().any(|&v| is_near[v as usize]));
        let mut edges: HashMap<(i32, i32), Edge> = HashMap::new();
        for (t, corners) in triangles.iter().enumerate().filter(|(t, _)| !listed_twice.comes_later(*t as u32)) {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                if is_near[a as usize] || is_near[b as usize] {
                    let edge = edges.entry(key(a, b)).or_default();
                    if let Some(place) = edge.triangles.get_mut(edge.count as usize) {
                        *place = t as u32;
                    }
                    edge.count += 1;
                }
            }
        }
        Work { shapes, triangles, changed: BTreeMap::new(), near, listed_twice, edges }
    }

    /// What changed, with the copies of each triangle.
    fn with_copies(self) -> BTreeMap<u32, Now> {
        let mut all = self.changed;
        for (first, copies) in &self.listed_twice.copies {
            if let Some(&now) = all.get(first) {
                all.extend(copies.iter().map(|c| (c.triangle, if c.reversed { now.reversed() } else { now })));
            }
        }
        all
    }

    fn now(&self, t: u32) -> Now {
        let first = Now { corners: self.triangles[t as usize], like: t, stood: [3 * t, 3 * t + 1, 3 * t + 2] };
        self.changed.get(&t).copied().unwrap_or(first)
    }

    /// Flips needles beside ordinary triangles first, then needles beside needles.
    fn run(&mut self, needles: &[u32]) {
        let mut next: VecDeque<u32> = needles.iter().copied().collect();
        let mut against: VecDeque<u32> = VecDeque::new();
        for _ in 0..ROUNDS * needles.len() {
            let turned = loop {
                let (t, pairs) = match (next.pop_front(), against.front()) {
                    (Some(t), _) => (t, false),
                    (None, Some(&t)) => {
                        against.pop_front();
                        (t, true)
                    }
                    (None, None) => return,
                };
                match self.turn(t, pairs) {
                    Found::Turned(touched) => break touched,
                    Found::Needle => against.push_back(t),
                    Found::Nothing => {}
                }
            };
            next.extend(turned);
        }
    }

    /// Flips the longest side of triangle t if t is a needle. Where the neighbour is a needle as well, only with
    /// `pairs`.
    fn turn(&mut self, t: u32, pairs: bool) -> Found {
        let needle = self.now(t);
        if !self.shapes.is_needle(needle.corners) {
            return Found::Nothing;
        }
        let longest = self.shapes.measures(needle.corners).2;
        let [c, a, b] = [0, 1, 2].map(|k| needle.corners[(longest + k) % 3]);
        let from_b = needle.stood[(longest + 2) % 3];
        let Some(&Edge { triangles: [one, two], count: 2 }) = self.edges.get(&key(a, c)) else {
            return Found::Nothing;
        };
        let u = if one == t { two } else { one };
        let mut neighbour = self.now(u);
        let along = |of: &Now| (0..3).find(|&k| of.corners[k] == a && of.corners[(k + 1) % 3] == c);
        // Of a triangle that is there from both sides, either may be listed first.
        let other_side = along(&neighbour).is_none() && [t, u].iter().any(|&t| self.listed_twice.two_sided(t));
        if other_side {
            neighbour = neighbour.reversed();
        }
        let Some(k) = along(&neighbour) else { return Found::Nothing };
        let d = neighbour.corners[(k + 2) % 3];
        let known = self.near.contains(&b) || self.near.contains(&d);
        if d == b || !known || self.edges.contains_key(&key(b, d)) {
            return Found::Nothing;
        }
        let (first, second) = ([a, b, d], [b, c, d]);
        // Heights that differ by rounding alone count as equal.
        let (before, after) = (self.shapes.square(a, c), self.shapes.square(b, d));
        let noise = ROUNDING * ROUNDING * before;
        let lower = |s: [i32; 3], t: [i32; 3]| self.shapes.height(s).min(self.shapes.height(t)).max(noise);
        let (old, new) = (lower(needle.corners, neighbour.corners), lower(first, second));
        let mut better = new > HIGHER * HIGHER * old;
        if self.shapes.is_needle(neighbour.corners) {
            if !pairs {
                return Found::Needle;
            }
            // Four collinear corners give no higher triangle; a shorter side may have a higher triangle beyond it.
            better |= after < before && HIGHER * HIGHER * new >= old;
        }
        if !better {
            return Found::Nothing;
        }
        let like = neighbour.like;
        let [from_a, from_c, from_d] = [0, 1, 2].map(|j| neighbour.stood[(k + j) % 3]);
        self.changed.insert(t, Now { corners: first, like, stood: [from_a, from_b, from_d] });
        let second = Now { corners: second, like, stood: [from_b, from_c, from_d] };
        self.changed.insert(u, if other_side { second.reversed() } else { second });
        self.edges.remove(&key(a, c));
        self.edges.insert(key(b, d), Edge { triangles: [t, u], count: 2 });
        self.hand_over(key(b, c), t, u);
        self.hand_over(key(d, a), u, t);
        // Both triangles and those beyond their other sides are tried again: they may have waited for this flip.
        let mut touched = vec![t, u];
        for edge in [key(a, b), key(b, c), key(c, d), key(d, a)] {
            if let Some(Edge { triangles, count: 2 }) = self.edges.get(&edge) {
                touched.extend(triangles.iter().filter(|&&s| s != t && s != u));
            }
        }
        Found::Turned(touched)
    }

    fn hand_over(&mut self, edge: (i32, i32), from: u32, to: u32) {
        if let Some(edge) = self.edges.get_mut(&edge) {
            edge.triangles.iter_mut().filter(|t| **t == from).for_each(|t| *t = to);
        }
    }
}

enum Found {
    Turned(Vec<u32>),
    /// The triangle beyond the longest side is a needle as well.
    Needle,
    Nothing,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(points: &[[f64; 3]], triangles: &[[i32; 3]], low: f64) -> Vec<[i32; 3]> {
        let turned = without_needles(points, triangles, low);
        let mut now = triangles.to_vec();
        for (t, corners) in turned.triangle.iter().zip(&turned.corners) {
            now[*t as usize] = *corners;
        }
        now
    }

    fn area(points: &[[f64; 3]], triangles: &[[i32; 3]]) -> f64 {
        let part = |t: &[i32; 3]| {
            let [p, q, r] = t.map(|v| points[v as usize]);
            ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2.0
        };
        triangles.iter().map(part).sum()
    }

    fn needles(points: &[[f64; 3]], triangles: &[[i32; 3]], low: f64) -> usize {
        triangles.iter().filter(|&&t| Shapes { points, low }.is_needle(t)).count()
    }

    /// Ten vertices of a neighbour on one side of a triangle, all in one line but for rounding.
    fn chain() -> (Vec<[f64; 3]>, Vec<[i32; 3]>) {
        let mut points: Vec<[f64; 3]> = (0..12).map(|i| [f64::from(i), 1e-9 * f64::from(i * 7 % 5), 0.0]).collect();
        points.extend([[5.0, 8.0, 0.0], [5.0, -8.0, 0.0]]);
        let mut triangles: Vec<[i32; 3]> = (0..10).map(|i| [i, i + 1, 11]).collect();
        triangles.push([0, 11, 12]);
        triangles.extend((0..11).map(|i| [i + 1, i, 13]));
        (points, triangles)
    }

    #[test]
    fn a_chain_of_needles_on_one_side() {
        let (points, mut triangles) = chain();
        for low in [0.0, 1e-7] {
            assert_eq!(needles(&points, &triangles, low), 10);
            let now = after(&points, &triangles, low);
            assert_eq!(needles(&points, &now, low), 0);
            assert!((area(&points, &now) - area(&points, &triangles)).abs() < 1e-6);
            assert!(now.iter().filter(|t| t.contains(&12)).count() == 11);
        }
        triangles.reverse();
        assert_eq!(needles(&points, &after(&points, &triangles, 0.0), 0.0), 0);
    }

    #[test]
    fn both_sides_are_flipped_whichever_is_listed_first() {
        let (points, one_side) = chain();
        let back = |t: &[i32; 3]| [t[0], t[2], t[1]];
        for swapped in [1, 2, 3, 100] {
            let listed = |(k, t): (usize, &[i32; 3])| if k % swapped == 0 { [back(t), *t] } else { [*t, back(t)] };
            let triangles: Vec<[i32; 3]> = one_side.iter().enumerate().flat_map(listed).collect();
            let now = after(&points, &triangles, 0.0);
            assert_eq!((needles(&points, &triangles, 0.0), needles(&points, &now, 0.0)), (20, 0));
            let up = |t: &&[i32; 3]| area(&points, &[**t]) > 0.0;
            let front: Vec<[i32; 3]> = now.iter().filter(up).copied().collect();
            assert_eq!(front.len(), one_side.len());
            assert!((area(&points, &front) - area(&points, &one_side).abs()).abs() < 1e-6);
        }
    }

    #[test]
    fn needles_against_one_another() {
        let points =
            [[0.0; 3], [1.0, 1e-12, 0.0], [3.0, 0.0, 0.0], [2.0, -1e-12, 0.0], [1.5, 4.0, 0.0], [1.5, -4.0, 0.0]];
        // On either side of 0-2 one with a corner on it.
        let triangles = [[0, 2, 1], [2, 0, 3], [0, 1, 4], [1, 2, 4], [0, 5, 3], [3, 5, 2]];
        let now = after(&points, &triangles, 0.0);
        assert_eq!(needles(&points, &now, 0.0), 0);
        assert!((area(&points, &now) - area(&points, &triangles)).abs() < 1e-9);
    }

    #[test]
    fn what_cannot_be_turned_stays() {
        let points = [[0.0; 3], [2.0, 1e-12, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0], [2.0, -4.0, 3.0]];
        let whole = [[0, 1, 2], [0, 2, 3]];
        assert_eq!(after(&points, &whole, 0.0), [[0, 1, 3], [1, 2, 3]]);
        for stays in [
            // The other diagonal is an edge already; an open border; the same way round; three triangles at the side.
            &[[0, 1, 2], [0, 2, 3], [1, 3, 4]][..],
            &[[0, 1, 2]],
            &[[0, 1, 2], [2, 0, 3]],
            &[[0, 1, 2], [0, 2, 3], [0, 2, 4]],
            // Slender, but none for exact coordinates.
            &[[0, 1, 3], [1, 2, 3]],
        ] {
            assert_eq!(without_needles(&points, stays, 0.0), Turned::default());
        }
    }

    #[test]
    fn colours_are_those_of_the_neighbour() {
        let points = [[0.0; 3], [2.0, 1e-12, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0]];
        let turned = without_needles(&points, &[[2, 3, 0], [1, 2, 0]], 0.0);
        assert_eq!((turned.triangle, turned.like), (vec![0, 1], vec![0, 0]));
        assert_eq!(turned.corners, [[1, 2, 3], [0, 1, 3]]);
        assert_eq!(turned.stood, [[3, 0, 1], [2, 3, 1]]);
    }

    #[test]
    fn coarse_coordinates_make_needles_higher() {
        let points = [[0.0; 3], [2.0, 1e-3, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0]];
        let triangles = [[0, 1, 2], [0, 2, 3]];
        assert_eq!(after(&points, &triangles, 1e-4), triangles);
        assert_eq!(after(&points, &triangles, 2e-3), [[0, 1, 3], [1, 2, 3]]);
        // A short triangle is no needle, however coarse they are.
        let short = points.map(|p| [p[0], p[1] * 20.0, p[2]]);
        assert_eq!(after(&short, &triangles, 1.0), triangles);
    }
}
