//! Finds triangles that may meet: their boxes and those of their groups overlap. Pairs within a group only on request.

use rayon::prelude::*;

use super::height_field::{MOST, is_height_field, only_at, seen_along};
use super::surfaces::Surfaces;
use super::triangle_pair::{Meeting, Numbered, apart, lies_on, meet, on_one_side};
use super::uncrossed::{UncrossedFaces, uncrossed_faces};
use crate::boxes::aabb::{Aabb, Item};
use crate::boxes::pairs::Found;
use crate::boxes::tree::Tree;

/// With fewer triangles a second thread gains nothing.
const MANY: usize = 1 << 12;

#[derive(Clone, Copy, Debug)]
pub struct Clash {
    /// The triangle of the group with the lower number first; within a group the lower triangle first.
    pub triangles: [u32; 2],
    pub meeting: Meeting,
}

#[derive(Default)]
pub struct Clashes {
    pub found: Vec<Clash>,
    /// Number of searches: pairs of groups, and groups against themselves.
    pub searched: usize,
    pub tests: u64,
}

#[derive(Default)]
struct Part {
    found: Vec<Clash>,
    tests: u64,
}

impl Found for Part {
    fn join(&mut self, mut other: Part) {
        self.found.append(&mut other.found);
        self.tests += other.tests;
    }
}

impl Surfaces<'_> {
    /// Triangles in the order of their groups, and where each group begins.
    fn by_group(&self) -> (Vec<u32>, Vec<usize>) {
        let mut first = vec![0; self.itself.len() + 1];
        self.group.iter().for_each(|&g| first[g as usize + 1] += 1);
        for g in 1..first.len() {
            first[g] += first[g - 1];
        }
        if self.group.is_sorted() {
            return ((0..self.group.len() as u32).collect(), first);
        }
        let (mut order, mut next) = (vec![0; self.group.len()], first.clone());
        for (t, &g) in self.group.iter().enumerate() {
            order[next[g as usize]] = t as u32;
            next[g as usize] += 1;
        }
        (order, first)
    }

    /// All clashes, sorted by groups, then triangles; incomplete if `stopped` returned true.
    pub fn clashes(&self, stopped: &(dyn Fn() -> bool + Sync)) -> Clashes {
        let count = self.itself.len();
        let (order, first) = self.by_group();
        let members: Vec<&[u32]> = first.windows(2).map(|w| &order[w[0]..w[1]]).collect();
        let around = |of: &[u32]| {
            let bounds = of.par_iter().with_min_len(MANY).map(|&t| self.bounds(t));
            bounds.reduce(|| Aabb::EMPTY, |a, b| a.union(&b))
        };
        let near = || {
            let boxes: Vec<Aabb> = members.par_iter().map(|of| around(of)).collect();
            self.pairs(&boxes, &members)
        };
        let (pairs, uncrossed) = rayon::join(near, || uncrossed_faces(self, stopped));
        let mut wanted = vec![false; count];
        for &[a, b] in &pairs {
            wanted[a as usize] = true;
            wanted[b as usize] = true;
        }
        let seen = |t: u32| {
            if !self.itself[self.group[t as usize] as usize] {
                return 0;
            }
            seen_along(self.triangles[t as usize].map(|v| &self.points[v as usize]))
        };
        let tree = |of: &[u32]| {
            let items: Vec<Item> = of.par_iter().with_min_len(MANY).map(|&t| (self.bounds(t), t)).collect();
            Tree::with_kinds(&items, &seen)
        };
        // Of each group a tree of what may cross something of it, and one of its uncrossed faces, which may cross others.
        let trees: Vec<[Tree; 2]> = members
            .par_iter()
            .zip(&wanted)
            .map(|(of, &wanted)| {
                let of = if wanted { *of } else { &[] };
                if uncrossed.is_empty() {
                    return [tree(of), tree(&[])];
                }
                let (left_out, tried): (Vec<u32>, Vec<u32>) =
                    of.iter().partition(|&&t| uncrossed.contains(self.planar.of[t as usize]));
                [tree(&tried), tree(&left_out)]
            })
            .collect();
        let try_pair = |s: u32, t: u32, out: &mut Part| {
            if !stopped() {
                self.try_pair(s, t, out);
            }
        };
        let apart = |items: &[Item], along: u8| {
            let triangles = items.iter().map(|&(_, t)| self.triangles[t as usize]);
            items.len() <= MOST && !stopped() && is_height_field(self.points, triangles, along)
        };
        let parts: Vec<Part> = pairs
            .par_iter()
            .map(|&[a, b]| {
                let (first, second) = (&trees[a as usize], &trees[b as usize]);
                if a == b {
                    return first[0].within(&try_pair, &apart);
                }
                let mut out = Part::default();
                for (own, other) in first.iter().flat_map(|own| second.iter().map(move |other| (own, other))) {
                    out.join(own.between(other, &try_pair));
                }
                out
            })
            .collect();
        let exceptions = self.of_exceptions(&uncrossed, &try_pair);
        let mut all = Clashes { searched: pairs.len(), ..Clashes::default() };
        for part in parts.into_iter().chain([exceptions]) {
            all.found.extend(part.found);
            all.tests += part.tests;
        }
        all.found.par_sort_unstable_by_key(|c| {
            let [s, t] = c.triangles;
            (self.group[s as usize], self.group[t as usize], s, t)
        });
        // Two uncrossed faces may be an exception of one another.
        all.found.dedup_by_key(|c| c.triangles);
        all
    }

    /// What crosses uncrossed faces within their group after all.
    fn of_exceptions(&self, uncrossed: &UncrossedFaces, try_pair: &(impl Fn(u32, u32, &mut Part) + Sync)) -> Part {
        let exceptions = &uncrossed.exceptions;
        let Some(&(last, _)) = exceptions.last() else { return Part::default() };
        let mut members: Vec<Vec<Item>> = vec![Vec::new(); last as usize + 1];
        for (t, &face) in self.planar.of.iter().enumerate().filter(|&(_, &face)| uncrossed.contains(face)) {
            if let Some(items) = members.get_mut(face as usize) {
                items.push((self.bounds(t as u32), t as u32));
            }
        }
        let tried = exceptions.par_iter().map(|(face, t)| {
            let (mut out, around) = (Part::default(), self.bounds(*t));
            for (_, s) in members[*face as usize].iter().filter(|(bounds, _)| bounds.overlaps(&around)) {
                try_pair(*s, *t, &mut out);
            }
            out
        });
        tried.reduce(Part::default, |mut a, b| {
            a.join(b);
            a
        })
    }

    /// Tests two triangles whose boxes overlap: of different groups, the lower group first, or both of one group.
    fn try_pair(&self, s: u32, t: u32, out: &mut Part) {
        let same = self.group[s as usize] == self.group[t as usize];
        if same && self.planar.of_one_face(s, t) {
            return;
        }
        let (s, t) = if same { (s.min(t), s.max(t)) } else { (s, t) };
        let (a, b) = (self.numbered(s), self.numbered(t));
        if same && (self.stands_on(s, &a, t, &b) || self.stands_on(t, &b, s, &a)) {
            return;
        }
        if lies_on(&a, &b) || lies_on(&b, &a) {
            return;
        }
        if same {
            let mut shared = a.number.iter().filter(|v| b.number.contains(v));
            match (shared.next(), shared.next()) {
                (Some(_), Some(_)) => return, // neighbours along an edge meet there by right
                (Some(&v), None) if only_at(self.points, &a.number, &b.number, v) => return,
                _ => {}
            }
        }
        out.tests += 1;
        if apart(&a, &b) {
            return;
        }
        if let Some(meeting) = meet(&a, &b) {
            out.found.push(Clash { triangles: [s, t], meeting });
        }
    }

    /// Whether triangle t stands on the planar face of s, and does not pass through it.
    #[inline]
    fn stands_on(&self, s: u32, a: &Numbered, t: u32, b: &Numbered) -> bool {
        let feet = self.planar.feet_on(self.planar.of[s as usize], t, &b.number);
        feet != 0 && on_one_side(a, b, feet)
    }

    /// Pairs of groups whose boxes overlap in more than their borders, the lower number first; and groups paired with
    /// themselves on request.
    fn pairs(&self, boxes: &[Aabb], members: &[&[u32]]) -> Vec<[u32; 2]> {
        let live = (0..boxes.len() as u32).filter(|&g| !members[g as usize].is_empty());
        let items: Vec<Item> = live.clone().map(|g| (boxes[g as usize], g)).collect();
        let tree = Tree::new(&items);
        let mut pairs = Vec::new();
        for a in live {
            if self.itself[a as usize] {
                pairs.push([a, a]);
            }
            let first = pairs.len();
            tree.query(&boxes[a as usize], |b| {
                if b > a && boxes[a as usize].enters(&boxes[b as usize]) {
                    pairs.push([a, b]);
                }
            });
            pairs[first..].sort_unstable();
        }
        pairs
    }
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::{NO_PLANE, PlanarFaces};
    use super::*;

    #[test]
    fn triangles_of_one_plane_are_not_tried() {
        let points = [[0, 0, 0], [9, 0, 0], [0, 9, 0], [3, 3, -5], [4, 3, 7], [3, 4, 7]].map(|p| p.map(|c| 1000 * c));
        let triangles = [[0, 1, 2], [3, 4, 5]];
        let tests = |group: &[i32], plane: &[i32]| {
            let itself = [true; 2];
            let planar = PlanarFaces::without_neighbours(plane.to_vec());
            let found = Surfaces { points: &points, triangles: &triangles, group, itself: &itself, planar: &planar };
            let found = found.clashes(&|| false);
            (found.tests, found.found.len())
        };
        assert_eq!(tests(&[0, 0], &[NO_PLANE; 2]), (1, 1));
        assert_eq!(tests(&[0, 0], &[7, 8]), (1, 1));
        assert_eq!(tests(&[0, 0], &[7, 7]), (0, 0));
        assert_eq!(tests(&[0, 1], &[7, 7]), (1, 1));
    }
}
