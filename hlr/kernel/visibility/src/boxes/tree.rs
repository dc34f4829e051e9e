//! A bounding volume hierarchy: which boxes overlap a given one. Items are divided along Morton's curve (`morton`).

use super::aabb::{Aabb, Item, around};
use super::morton::{ALONE, INDEX_BITS, Sorted, sorted};

pub struct Tree {
    pub(super) items: Vec<Item>,
    pub(super) nodes: Vec<Node>,
}

pub(super) struct Node {
    pub bounds: Aabb,
    pub first: u32,
    pub count: u32,
    /// Offset from this node to its second half; the first half is the next node. 0 for leaves.
    pub second: u32,
    /// The bits that all its items have in common.
    pub common: u8,
}

/// Most items of a leaf.
pub(super) const LEAF: usize = 12;

/// More nodes than ever wait in a query: at most one for each of the 33 bits of the curve, and of the items of one cell one
/// for each time that these are halved.
const DEEPEST: usize = 96;

impl Tree {
    /// The hierarchy of these items, made on all threads: not while others wait for it within a lock.
    pub fn new(items: &[Item]) -> Tree {
        Tree::of(items, &|_| 0, true)
    }

    /// The same, made on one thread.
    pub fn on_one_thread(items: &[Item]) -> Tree {
        Tree::of(items, &|_| 0, false)
    }

    /// `kind`: the bits of an item. Each node keeps those that all its items have in common.
    pub fn with_kinds(items: &[Item], kind: &(impl Fn(u32) -> u8 + Sync)) -> Tree {
        Tree::of(items, kind, true)
    }

    fn of(items: &[Item], kind: &(impl Fn(u32) -> u8 + Sync), threads: bool) -> Tree {
        let Sorted { codes, items } = sorted(items, LEAF, threads);
        let mut nodes = Vec::with_capacity(items.len() / 3 + 1);
        if !items.is_empty() {
            build(&codes, &items, 0, kind, threads, &mut nodes);
        }
        Tree { items, nodes }
    }

    /// Calls `visit` for every item whose box overlaps `query`.
    pub fn query(&self, query: &Aabb, mut visit: impl FnMut(u32)) {
        self.any(query, |item| {
            visit(item);
            false
        });
    }

    /// Whether `wanted` is true of an item whose box overlaps `query`. No more is searched after the first.
    #[inline]
    pub fn any(&self, query: &Aabb, wanted: impl FnMut(u32) -> bool) -> bool {
        self.any_within(query, |_| true, wanted)
    }

    /// The same. `enter`: whether a node, of which `query` overlaps the box, may have such an item at all.
    #[inline]
    pub(super) fn any_within(
        &self,
        query: &Aabb,
        enter: impl Fn(usize) -> bool,
        mut wanted: impl FnMut(u32) -> bool,
    ) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let mut stack = [0u32; DEEPEST];
        let mut top = 1;
        while top > 0 {
            top -= 1;
            let at = stack[top];
            let node = &self.nodes[at as usize];
            if !node.bounds.overlaps(query) || !enter(at as usize) {
                continue;
            }
            if node.second > 0 {
                stack[top] = at + node.second;
                stack[top + 1] = at + 1;
                top += 2;
            } else {
                for (bounds, item) in self.of_node(node) {
                    if bounds.overlaps(query) && wanted(*item) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Of each node the owner of all its items, where that is one.
    pub(super) fn only_owners(&self, owner: &[u32]) -> Vec<Option<u32>> {
        let mut owners = vec![None; self.nodes.len()];
        // Halves come after their node.
        for (at, node) in self.nodes.iter().enumerate().rev() {
            owners[at] = if node.second > 0 {
                let [a, b]: [Option<u32>; 2] = [owners[at + 1], owners[at + node.second as usize]];
                a.filter(|_| a == b)
            } else {
                let mut all = self.of_node(node).iter().map(|(_, item)| owner[*item as usize]);
                let first = all.next();
                first.filter(|first| all.all(|other| other == *first))
            };
        }
        owners
    }

    pub(super) fn of_node(&self, node: &Node) -> &[Item] {
        &self.items[node.first as usize..(node.first + node.count) as usize]
    }
}

/// Adds the nodes of items, of which the first has number `first`: they are divided where the highest differing bit of
/// their codes changes, or in the middle if none differs.
fn build(
    codes: &[u64],
    items: &[Item],
    first: u32,
    kind: &(impl Fn(u32) -> u8 + Sync),
    threads: bool,
    nodes: &mut Vec<Node>,
) {
    let count = items.len();
    if count <= LEAF {
        let common = items.iter().fold(u8::MAX, |common, &(_, item)| common & kind(item));
        nodes.push(Node { bounds: around(items), first, count: count as u32, second: 0, common });
        return;
    }
    let differ = (codes[0] ^ codes[count - 1]) >> INDEX_BITS;
    let half = match differ.checked_ilog2() {
        Some(bit) => codes.partition_point(|code| code >> (bit + INDEX_BITS) & 1 == 0),
        None => count / 2,
    };
    let (at, then) = (nodes.len(), first + half as u32);
    let ((codes_low, codes_high), (low, high)) = (codes.split_at(half), items.split_at(half));
    nodes.push(Node { bounds: Aabb::EMPTY, first, count: count as u32, second: 0, common: 0 });
    if threads && count > ALONE {
        let built = |codes: &[u64], items: &[Item], first: u32| {
            let mut nodes = Vec::with_capacity(items.len() / 3 + 1);
            build(codes, items, first, kind, threads, &mut nodes);
            nodes
        };
        let (a, b) = rayon::join(|| built(codes_low, low, first), || built(codes_high, high, then));
        nodes.extend(a);
        nodes[at].second = (nodes.len() - at) as u32;
        nodes.extend(b);
    } else {
        build(codes_low, low, first, kind, threads, nodes);
        nodes[at].second = (nodes.len() - at) as u32;
        build(codes_high, high, then, kind, threads, nodes);
    }
    let (a, b) = (&nodes[at + 1], &nodes[at + nodes[at].second as usize]);
    (nodes[at].bounds, nodes[at].common) = (a.bounds.union(&b.bounds), a.common & b.common);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::below;

    #[test]
    fn finds_what_a_plain_search_finds() {
        let mut random = below(1);
        let mut cube = |size: i32| {
            let low = [random(100), random(100), random(100)];
            Aabb { low, high: [low[0] + random(size), low[1] + random(size), low[2] + random(size)] }
        };
        for count in [0, 1, 500, 3 * ALONE as u32] {
            let boxes: Vec<Item> = (0..count).map(|i| (cube(20), i)).collect();
            let trees = [Tree::new(&boxes), Tree::on_one_thread(&boxes)];
            for _ in 0..if count > 500 { 20 } else { 200 } {
                let q = cube(30);
                let expected: Vec<u32> = boxes.iter().filter(|(b, _)| b.overlaps(&q)).map(|&(_, i)| i).collect();
                for tree in &trees {
                    let mut found = Vec::new();
                    tree.query(&q, |i| found.push(i));
                    found.sort_unstable();
                    assert_eq!(found, expected);
                }
            }
        }
    }

    #[test]
    fn a_search_for_any_ends_with_the_first_that_is_wanted() {
        let nested = |i: u32| (Aabb { low: [-(i as i32); 3], high: [i as i32; 3] }, i);
        let tree = Tree::new(&(0..1000).map(nested).collect::<Vec<Item>>());
        let all = Aabb { low: [-1000; 3], high: [1000; 3] };
        let mut visited = 0;
        let mut any = |wanted: bool| {
            visited = 0;
            let found = tree.any(&all, |_| {
                visited += 1;
                wanted
            });
            (found, visited)
        };
        assert_eq!(any(true), (true, 1));
        assert_eq!(any(false), (false, 1000));
        assert!(!Tree::new(&[]).any(&all, |_| true));
    }

    #[test]
    fn a_hierarchy_as_deep_as_can_be_is_searched_through() {
        // Each bit of the curve divides one item from all others; those in the corner are one cell.
        let at = |axis: usize, x: i32| {
            let low = [0, 1, 2].map(|k| if k == axis { x } else { 0 });
            Aabb { low, high: low.map(|c| c + 1) }
        };
        let mut boxes: Vec<Item> = (0..90).map(|k| (at(k % 3, 1 << (k / 3)), k as u32)).collect();
        boxes.extend((90..5000).map(|k| (at(0, 0), k)));
        let tree = Tree::new(&boxes);
        let mut found = 0;
        tree.query(&Aabb { low: [0; 3], high: [i32::MAX; 3] }, |_| found += 1);
        assert_eq!(found, boxes.len());
    }
}
