//! A constrained Delaunay triangulation that grows point by point: each new point is inserted into its triangle, and
//! edges are flipped until all are Delaunay again.
//!
//! C. L. Lawson, "Software for C1 surface interpolation", Mathematical Software III, 1977. All decisions are signs of
//! exact determinants. Edges without a second triangle are never flipped.

use robust::{Coord, incircle};

use super::flip::{NONE, after_in, before_in, turn, twins};
use super::plane::{distance2, side};
use super::progress::Progress;

/// Limit on flips, in multiples of the number of triangles. More flips mean that the initial triangles are unusable.
const MOST_TURNS: usize = 200;
/// Further flips for each point that waits to be inserted: they take a part of the time that the point takes. Without
/// inner points, a long outline needs flips by the square of its length.
const MOST_TURNS_A_POINT: usize = 20;
/// Limit on the triangles from which a walk is tried anew.
const MOST_OTHERS: usize = 8;

pub struct Triangulation {
    triangles: Vec<[u32; 3]>,
    /// For each edge, 3 per triangle, the edge that runs along it in the opposite sense.
    twins: Vec<u32>,
    /// For each point an edge that begins at it.
    begins: Vec<u32>,
    stack: Vec<u32>,
}

impl Triangulation {
    /// `count`: number of points; some may be in no triangle. `fixed`: inner edges that must not be flipped.
    pub fn new(count: usize, triangles: Vec<[u32; 3]>, fixed: impl Fn(u32, u32) -> bool) -> Triangulation {
        let mut twins = twins(&triangles);
        let mut begins = vec![NONE; count];
        for (number, t) in triangles.iter().enumerate() {
            for k in 0..3 {
                begins[t[k] as usize] = (3 * number + k) as u32;
                if fixed(t[k], t[(k + 1) % 3]) {
                    twins[3 * number + k] = NONE;
                }
            }
        }
        Triangulation { triangles, twins, begins, stack: Vec::new() }
    }

    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    pub fn into_triangles(self) -> Vec<[u32; 3]> {
        self.triangles
    }

    fn start(&self, edge: usize) -> u32 {
        self.triangles[edge / 3][edge % 3]
    }

    /// Flips edges of the first `count` triangles that violate the Delaunay condition, and all edges that do so as a
    /// result. False if that exceeds the limit. `waiting`: number of points to be inserted after that.
    pub fn settle(&mut self, places: &[[f64; 2]], count: usize, waiting: usize, steps: &Progress) -> bool {
        self.stack.clear();
        self.stack.extend(0..3 * count as u32);
        let mut left = MOST_TURNS * self.triangles.len() + MOST_TURNS_A_POINT * waiting;
        while let Some(edge) = self.stack.pop() {
            steps.step();
            if self.turned(places, edge as usize) {
                let Some(less) = left.checked_sub(1) else { return false };
                left = less;
                // All four outer edges of the two triangles.
                let (one, other) = (edge as usize / 3, self.twins[edge as usize - edge as usize % 3] as usize / 3);
                self.stack.extend([3 * one + 1, 3 * one + 2, 3 * other + 1, 3 * other + 2].map(|e| e as u32));
            }
        }
        true
    }

    /// Flips an edge if the point opposite to it is inside the circumcircle of its triangle.
    fn turned(&mut self, places: &[[f64; 2]], edge: usize) -> bool {
        let twin = self.twins[edge] as usize;
        if self.twins[edge] == NONE {
            return false;
        }
        let [a, b, c, d] = [edge, twin, before_in(edge), before_in(twin)].map(|e| self.start(e));
        let at = |i: u32| {
            let [x, y] = places[i as usize];
            Coord { x, y }
        };
        if c == d || incircle(at(a), at(b), at(c), at(d)) <= 0.0 {
            return false;
        }
        turn(&mut self.triangles, &mut self.twins, edge, twin);
        let (one, other) = (3 * (edge / 3), 3 * (twin / 3));
        for (point, edge) in [(c, one), (b, one + 2), (d, other), (a, other + 2)] {
            self.begins[point as usize] = edge as u32;
        }
        true
    }

    /// A triangle with this corner; the first triangle where there is none.
    pub fn triangle_at(&self, point: u32) -> usize {
        self.begins.get(point as usize).copied().filter(|&e| e != NONE).unwrap_or(0) as usize / 3
    }

    /// Inserts the last one of the places; the search begins at the triangle `near`. False if the place is on the border,
    /// at another point, or outside, and where the border is in the way from there and from others nearby.
    pub fn insert(&mut self, places: &[[f64; 2]], near: usize, steps: &Progress) -> bool {
        let point = places.len() as u32 - 1;
        let p = &places[point as usize];
        let found = self.walk(places, p, near, steps).or_else(|| self.walk_from_others(places, p, steps));
        let Some(found) = found else { return false };
        let on: Vec<usize> = (3 * found..3 * found + 3).filter(|&e| self.beside(places, e, p) == 0.0).collect();
        self.begins.resize(places.len(), NONE);
        match on[..] {
            [] => self.fan(point, &[3 * found, 3 * found + 1, 3 * found + 2]),
            [edge] if self.twins[edge] != NONE => {
                let twin = self.twins[edge] as usize;
                self.fan(point, &[before_in(edge), after_in(twin), before_in(twin), after_in(edge)]);
            }
            _ => return false,
        }
        while let Some(edge) = self.stack.pop() {
            // The new point is on this edge's own side.
            steps.step();
            let twin = self.twins[edge as usize] as usize;
            if self.turned(places, edge as usize) {
                self.stack.extend([3 * (edge as usize / 3) + 1, 3 * (twin / 3) + 2].map(|e| e as u32));
            }
        }
        true
    }

    fn beside(&self, places: &[[f64; 2]], edge: usize, p: &[f64; 2]) -> f64 {
        side(&places[self.start(edge) as usize], &places[self.start(after_in(edge)) as usize], p)
    }

    /// Walks from triangle to triangle, across edges that have the place on their other side.
    fn walk(&self, places: &[[f64; 2]], p: &[f64; 2], start: usize, steps: &Progress) -> Option<usize> {
        let (mut here, mut from) = (start, NONE);
        for _ in 0..self.triangles.len() {
            steps.step();
            let mut next = None;
            let mut outside = false;
            for edge in 3 * here..3 * here + 3 {
                if edge as u32 != from && self.beside(places, edge, p) < 0.0 {
                    outside = true;
                    if self.twins[edge] != NONE {
                        next = Some(edge);
                        break;
                    }
                }
            }
            match next {
                Some(edge) => (here, from) = (self.twins[edge] as usize / 3, self.twins[edge]),
                None if outside => return None,
                None => return Some(here),
            }
        }
        None
    }

    /// Walks from the nearest ones of some triangles, where the border was in the way.
    fn walk_from_others(&self, places: &[[f64; 2]], p: &[f64; 2], steps: &Progress) -> Option<usize> {
        let every = self.triangles.len().isqrt();
        let away = |t: usize| {
            let corner = &places[self.triangles[t][0] as usize];
            distance2(p, corner, corner)
        };
        let mut others: Vec<(f64, usize)> = (0..self.triangles.len()).step_by(every).map(|t| (away(t), t)).collect();
        steps.steps(others.len() as u64);
        others.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        others.iter().take(MOST_OTHERS).find_map(|&(_, t)| self.walk(places, p, t, steps))
    }

    /// Replaces the triangles of a closed chain of edges by triangles from a point inside to each edge.
    fn fan(&mut self, point: u32, chain: &[usize]) {
        let mut outer = [(0u32, 0u32, NONE); 4];
        let mut numbers = [0usize; 4];
        let mut count = 0;
        for (k, &edge) in chain.iter().enumerate() {
            outer[k] = (self.start(edge), self.start(after_in(edge)), self.twins[edge]);
            if !numbers[..count].contains(&(edge / 3)) {
                numbers[count] = edge / 3;
                count += 1;
            }
        }
        while count < chain.len() {
            numbers[count] = self.triangles.len();
            self.triangles.push([0; 3]);
            self.twins.extend([NONE; 3]);
            count += 1;
        }
        for k in 0..count {
            let (from, to, twin) = outer[k];
            let (here, next) = (3 * numbers[k], 3 * numbers[(k + 1) % count]);
            self.triangles[here / 3] = [from, to, point];
            self.twins[here] = twin;
            if twin != NONE {
                self.twins[twin as usize] = here as u32;
            }
            self.twins[here + 1] = next as u32 + 2;
            self.twins[next + 2] = here as u32 + 1;
            self.begins[from as usize] = here as u32;
            self.stack.push(here as u32);
        }
        self.begins[point as usize] = 3 * numbers[0] as u32 + 2;
    }

    /// Numbers of the triangles around an inner point.
    pub fn around(&self, point: u32) -> impl Iterator<Item = usize> + '_ {
        let first = self.begins[point as usize] as usize;
        let next = move |edge: &usize| Some(self.twins[before_in(*edge)] as usize).filter(|&e| e != first);
        std::iter::successors(Some(first), next).map(|edge| edge / 3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::shapes::Random;

    #[test]
    fn points_put_in_at_random_make_delaunay_triangles() {
        let mut random = Random(5);
        let mut places = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut net = Triangulation::new(4, vec![[0, 1, 2], [0, 2, 3]], |_, _| false);
        for k in 0..500u32 {
            // Some points are on edges, some at existing points, some on the border, some outside.
            let round = |x: f64| if k % 3 == 0 { (8.0 * x).round() / 8.0 } else { 1.1 * x };
            places.push([round(random.next()), round(random.next())]);
            let [x, y] = places[places.len() - 1];
            let inside = x > 0.0 && x < 1.0 && y > 0.0 && y < 1.0;
            let new = !places[..places.len() - 1].contains(&[x, y]);
            let near = net.triangle_at(k % 7 % places.len() as u32);
            assert_eq!(net.insert(&places, near, &Progress::free()), inside && new, "{x} {y}");
            if !(inside && new) {
                places.pop();
            }
        }
        assert_eq!(net.triangles.len(), 2 + 2 * (places.len() - 4));
        let total: f64 = net.triangles.iter().map(|t| side_of(&places, t)).sum();
        assert!((total - 2.0).abs() < 1e-12);
        let coord = |i: u32| Coord { x: places[i as usize][0], y: places[i as usize][1] };
        for t in &net.triangles {
            assert!(side_of(&places, t) > 0.0);
            let [a, b, c] = t.map(coord);
            assert!((0..places.len() as u32).all(|d| incircle(a, b, c, coord(d)) <= 0.0));
        }
        for point in 4..places.len() as u32 {
            assert!(net.around(point).all(|t| net.triangles[t].contains(&point)));
        }
        let before = net.triangles.clone();
        assert!(net.settle(&places, net.triangles.len(), 0, &Progress::free()));
        assert_eq!(net.triangles, before);
    }

    #[test]
    fn a_place_behind_a_notch_is_found_and_one_in_the_notch_is_not() {
        // A U: the left arm is triangles 2 and 3, the right arm 4 and 5.
        let corners = [[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]];
        let corners = corners.map(|p| p.map(f64::from));
        let triangles = vec![[0, 1, 4], [0, 4, 5], [0, 5, 6], [0, 6, 7], [1, 2, 3], [1, 3, 4]];
        for (place, inside) in [([2.5, 1.9], true), ([0.5, 1.9], true), ([1.5, 1.5], false), ([4.0, 1.0], false)] {
            for near in 0..triangles.len() {
                let mut net = Triangulation::new(corners.len(), triangles.clone(), |_, _| false);
                let places: Vec<_> = corners.iter().copied().chain([place]).collect();
                assert_eq!(net.insert(&places, near, &Progress::free()), inside, "{place:?} {near}");
                assert_eq!(net.triangles.len(), triangles.len() + if inside { 2 } else { 0 });
                assert!(net.triangles.iter().all(|t| side_of(&places, t) > 0.0));
            }
        }
    }

    fn side_of(places: &[[f64; 2]], t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| places[i as usize]);
        side(&a, &b, &c)
    }

    /// Two rows of points, 1 apart. A fan from the last upper point over the lower row, then one from the first lower
    /// point over the upper row.
    fn fans(count: u32) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
        let row = |y: f64| (0..count).map(move |k| [f64::from(k), y]);
        let mut triangles: Vec<[u32; 3]> = (1..count - 1).map(|k| [k, k + 1, 2 * count - 1]).collect();
        triangles.extend((count..2 * count - 1).map(|k| [0, k + 1, k]));
        triangles.push([0, 1, 2 * count - 1]);
        (row(0.0).chain(row(1.0)).collect(), triangles)
    }

    #[test]
    fn a_long_fan_may_take_more_flips_if_points_wait() {
        let (places, triangles) = fans(2000);
        let settled = |waiting: usize| {
            let mut net = Triangulation::new(places.len(), triangles.clone(), |_, _| false);
            net.settle(&places, triangles.len(), waiting, &Progress::free())
        };
        assert!(!settled(0) && settled(500_000));
    }

    #[test]
    fn a_fan_over_a_row_is_turned_and_a_fixed_edge_is_not() {
        let (places, triangles) = fans(20);
        let mut net = Triangulation::new(40, triangles.clone(), |_, _| false);
        assert!(net.settle(&places, net.triangles.len(), 0, &Progress::free()));
        let longest = |net: &Triangulation| {
            let edge = |a: u32, b: u32| (places[a as usize][0] - places[b as usize][0]).abs();
            net.triangles
                .iter()
                .map(|t| edge(t[0], t[1]).max(edge(t[1], t[2])).max(edge(t[2], t[0])))
                .fold(0.0, f64::max)
        };
        assert!(longest(&net) <= 1.0);
        let mut net = Triangulation::new(40, triangles, |a, b| (a.min(b), a.max(b)) == (0, 39));
        assert!(net.settle(&places, net.triangles.len(), 0, &Progress::free()));
        assert!(longest(&net) == 19.0);
    }
}
