//! Finds triangles that may meet: their boxes and those of their groups overlap. Pairs within a group only on request.

use rayon::prelude::*;

use super::height_field::{MOST, is_height_field, only_at, seen_along};
use super::surfaces::Surfaces;
use super::triangle_pair::{Facet, Meeting, apart, lies_on, meet};
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
        let (order, first) = self.by_group();
        let members: Vec<&[u32]> = first.windows(2).map(|w| &order[w[0]..w[1]]).collect();
        let around = |of: &[u32]| {
            let bounds = of.par_iter().with_min_len(MANY).map(|&t| self.bounds(t));
            bounds.reduce(|| Aabb::EMPTY, |a, b| a.union(&b))
        };
        let near = || {
            let boxes: Vec<Aabb> = members.par_iter().map(|of| around(of)).collect();
            let pairs = self.pairs(&boxes, &members);
            let wanted = wanted(&boxes, &pairs);
            (pairs, wanted)
        };
        let ((pairs, wanted), uncrossed) = rayon::join(near, || uncrossed_faces(self, stopped));
        let seen = |t: u32| {
            if !self.itself[self.group[t as usize] as usize] {
                return 0;
            }
            seen_along(self.triangles[t as usize].map(|v| &self.points[v as usize]))
        };
        let tree = |of: &[u32], within: &Aabb| {
            let items = of.par_iter().with_min_len(MANY).map(|&t| (self.bounds(t), t));
            let items: Vec<Item> = items.filter(|(bounds, _)| bounds.overlaps(within)).collect();
            Tree::with_kinds(&items, &seen)
        };
        // Of each group a tree of what may cross something of it, and one of its uncrossed faces, which may cross others.
        let trees: Vec<[Tree; 2]> = members
            .par_iter()
            .zip(&wanted)
            .map(|(of, within)| {
                if uncrossed.is_empty() {
                    return [tree(of, within), tree(&[], within)];
                }
                let (left_out, tried): (Vec<u32>, Vec<u32>) =
                    of.iter().partition(|&&t| uncrossed.contains(self.planar.of[t as usize]));
                [tree(&tried, within), tree(&left_out, within)]
            })
            .collect();
        let try_pair = |s: u32, near: &[u32], out: &mut Part| {
            if !stopped() {
                self.try_pairs(s, near, out);
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
        let mut all = Clashes::default();
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
    fn of_exceptions(&self, uncrossed: &UncrossedFaces, try_pair: &(impl Fn(u32, &[u32], &mut Part) + Sync)) -> Part {
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
                try_pair(*s, &[*t], &mut out);
            }
            out
        });
        tried.reduce(Part::default, |mut a, b| {
            a.join(b);
            a
        })
    }

    /// Tests a triangle with others whose boxes overlap its box: of different groups, its group the lower, or all of one.
    fn try_pairs(&self, s: u32, near: &[u32], out: &mut Part) {
        let a = self.numbered(s);
        let own = Facet::new(&a);
        near.iter().for_each(|&t| self.try_pair(s, &own, t, out));
    }

    #[inline]
    fn try_pair(&self, s: u32, own: &Facet, t: u32, out: &mut Part) {
        let same = self.group[s as usize] == self.group[t as usize];
        if same && self.planar.of_one_face(s, t) {
            return;
        }
        let (a, b) = (own.of, &self.numbered(t));
        let other = Facet::new(b);
        if same && (self.stands_on(s, own, t, &other) || self.stands_on(t, &other, s, own)) {
            return;
        }
        if lies_on(a, b) || lies_on(b, a) {
            return;
        }
        if same {
            let mut shared = a.number.iter().filter(|v| b.number.contains(v));
            match (shared.next(), shared.next()) {
                (Some(_), Some(_)) => return, // neighbours along an edge meet there by right
                (Some(&v), None) if only_at(a, b, v) => return,
                _ => {}
            }
        }
        out.tests += 1;
        if apart(own, &other) {
            return;
        }
        let ((s, a), (t, b)) = if same && t < s { ((t, b), (s, a)) } else { ((s, a), (t, b)) };
        if let Some(meeting) = meet(a, b) {
            out.found.push(Clash { triangles: [s, t], meeting });
        }
    }

    /// Whether triangle t stands on the planar face of s, and does not pass through it.
    #[inline]
    fn stands_on(&self, s: u32, a: &Facet, t: u32, b: &Facet) -> bool {
        let feet = self.planar.feet_on(self.planar.of[s as usize], t, &b.of.number);
        feet != 0 && a.has_on_one_side(b, feet)
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

/// Per group the box of what may cross something: all of a group that is searched for passing through itself, and of
/// others what lies in the boxes of the groups that they are paired with.
fn wanted(boxes: &[Aabb], pairs: &[[u32; 2]]) -> Vec<Aabb> {
    let mut wanted = vec![Aabb::EMPTY; boxes.len()];
    for &[a, b] in pairs {
        let (a, b) = (a as usize, b as usize);
        let common = boxes[a].common(&boxes[b]);
        wanted[a] = wanted[a].union(&common);
        wanted[b] = wanted[b].union(&common);
    }
    wanted
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::{NO_PLANE, PlanarFaces};
    use super::*;
    use crate::random::below;

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

    /// Triangles of random places and sizes, in groups that lie side by side and reach into one another.
    fn side_by_side(random: &mut impl FnMut(i32) -> i32, groups: i32) -> (Vec<[i32; 3]>, Vec<[i32; 3]>, Vec<i32>) {
        let (mut points, mut triangles, mut group) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..60 * groups {
            let middle = [700 * (k % groups) + random(1000), random(1000), random(1000)];
            let first = points.len() as i32;
            points.extend((0..3).map(|_| middle.map(|c| c + random(600))));
            triangles.push([first, first + 1, first + 2]);
            group.push(k % groups);
        }
        (points, triangles, group)
    }

    #[test]
    fn finds_what_trying_every_pair_finds() {
        let mut random = below(5);
        let (points, triangles, group) = side_by_side(&mut random, 4);
        let planar = PlanarFaces::without_neighbours(vec![NO_PLANE; triangles.len()]);
        for itself in [[false; 4], [true, false, false, true]] {
            let surfaces =
                Surfaces { points: &points, triangles: &triangles, group: &group, itself: &itself, planar: &planar };
            let asked = |&[s, t]: &[u32; 2]| {
                let [a, b] = [s, t].map(|t| group[t as usize]);
                a < b || a == b && s < t && itself[a as usize]
            };
            let all = (0..group.len() as u32).flat_map(|s| (0..group.len() as u32).map(move |t| [s, t]));
            let crossing = |&[s, t]: &[u32; 2]| meet(&surfaces.numbered(s), &surfaces.numbered(t)).is_some();
            let mut expected: Vec<[u32; 2]> = all.filter(|pair| asked(pair) && crossing(pair)).collect();
            expected.sort_by_key(|&[s, t]| (group[s as usize], group[t as usize], s, t));
            let found: Vec<[u32; 2]> = surfaces.clashes(&|| false).found.iter().map(|c| c.triangles).collect();
            assert!(found.len() > 20, "{}", found.len());
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn of_a_group_only_what_lies_in_the_box_of_another_is_looked_at() {
        let cube = |x: i32, size: i32| Aabb { low: [x, 0, 0], high: [x + size, size, size] };
        let boxes = [cube(0, 10), cube(20, 10), cube(8, 14), cube(100, 5), cube(21, 10)];
        let found = wanted(&boxes, &[[0, 2], [1, 2], [2, 4], [3, 3]]);
        let between = |from: i32, to: i32| Aabb { low: [from, 0, 0], high: [to, 10, 10] };
        assert_eq!(found, [between(8, 10), between(20, 22), between(8, 22), cube(100, 5), between(21, 22)]);
        assert!(!wanted(&boxes, &[])[0].overlaps(&boxes[0]));
    }
}
