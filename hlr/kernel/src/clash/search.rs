//! Which triangles may meet: those whose boxes overlap, of groups whose boxes overlap, and of one group where asked for.

use rayon::prelude::*;

use super::meet::{Meeting, Numbered, meet};
use crate::exact::Point;
use crate::scan::box_tree::{Aabb, BoxTree};

#[derive(Clone, Copy, Debug)]
pub struct Clash {
    /// Of the group with the lower number first; within a group the lower triangle first.
    pub triangles: [u32; 2],
    pub meeting: Meeting,
}

#[derive(Default)]
pub struct Clashes {
    pub found: Vec<Clash>,
    /// Pairs of groups, and groups against themselves, that were searched.
    pub searched: usize,
    pub tests: u64,
}

pub struct Surfaces<'a> {
    pub points: &'a [Point],
    pub triangles: &'a [[i32; 3]],
    pub group: &'a [i32],
    /// Per group, whether it is searched for passing through itself.
    pub itself: &'a [bool],
}

/// Triangles of one task.
const CHUNK: usize = 512;

impl Surfaces<'_> {
    fn numbered(&self, t: u32) -> Numbered<'_> {
        let number = self.triangles[t as usize];
        Numbered { corner: number.map(|v| &self.points[v as usize]), number }
    }

    fn bounds(&self, t: u32) -> Aabb {
        Aabb::of(&self.numbered(t).corner)
    }

    /// Sorted by groups, then triangles. Cut short where `stopped` says so.
    pub fn clashes(&self, stopped: &(dyn Fn() -> bool + Sync)) -> Clashes {
        let count = self.itself.len();
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); count];
        let mut boxes = vec![Aabb::EMPTY; count];
        for (t, &g) in self.group.iter().enumerate() {
            members[g as usize].push(t as u32);
            boxes[g as usize] = boxes[g as usize].union(&self.bounds(t as u32));
        }
        let pairs = self.pairs(&boxes, &members);
        let mut wanted = vec![false; count];
        for &[a, b] in &pairs {
            wanted[a as usize] |= a == b || members[a as usize].len() >= members[b as usize].len();
            wanted[b as usize] |= members[a as usize].len() < members[b as usize].len();
        }
        let trees: Vec<Option<BoxTree>> = (0..count)
            .into_par_iter()
            .map(|g| wanted[g].then(|| BoxTree::new(members[g].iter().map(|&t| (self.bounds(t), t)).collect())))
            .collect();
        // The larger group is the tree; the smaller one's triangles ask it, in tasks of a chunk each.
        let tasks: Vec<([u32; 2], &[u32])> = pairs
            .iter()
            .flat_map(|&[a, b]| {
                let swap = members[a as usize].len() < members[b as usize].len();
                let (tree, asking) = if swap { (b, a) } else { (a, b) };
                members[asking as usize].chunks(CHUNK).map(move |chunk| ([tree, asking], chunk))
            })
            .collect();
        let parts: Vec<(Vec<Clash>, u64)> = tasks
            .into_par_iter()
            .map(|([tree, asking], chunk)| {
                let mut out = (Vec::new(), 0);
                if let (false, Some(boxes_of)) = (stopped(), &trees[tree as usize]) {
                    let common = boxes[tree as usize].common(&boxes[asking as usize]);
                    for &t in chunk {
                        let around = self.bounds(t);
                        if around.overlaps(&common) {
                            boxes_of.query(&around, |u| self.try_pair(t, u, tree == asking, tree < asking, &mut out));
                        }
                    }
                }
                out
            })
            .collect();
        let mut all = Clashes { searched: pairs.len(), ..Clashes::default() };
        for (found, tests) in parts {
            all.found.extend(found);
            all.tests += tests;
        }
        all.found.par_sort_unstable_by_key(|c| {
            let [s, t] = c.triangles;
            (self.group[s as usize], self.group[t as usize], s, t)
        });
        all
    }

    fn try_pair(&self, t: u32, u: u32, same: bool, tree_first: bool, out: &mut (Vec<Clash>, u64)) {
        let (a, b) = (self.numbered(t), self.numbered(u));
        if same && (u <= t || a.number.iter().filter(|v| b.number.contains(v)).count() > 1) {
            return; // once only, and neighbours along an edge meet there by right
        }
        out.1 += 1;
        if let Some(meeting) = meet(&a, &b) {
            out.0.push(Clash { triangles: if tree_first { [u, t] } else { [t, u] }, meeting });
        }
    }

    /// Groups whose boxes overlap in more than their borders, the lower number first; and those asked for themselves.
    fn pairs(&self, boxes: &[Aabb], members: &[Vec<u32>]) -> Vec<[u32; 2]> {
        let live = (0..boxes.len() as u32).filter(|&g| !members[g as usize].is_empty());
        let tree = BoxTree::new(live.clone().map(|g| (boxes[g as usize], g)).collect());
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
