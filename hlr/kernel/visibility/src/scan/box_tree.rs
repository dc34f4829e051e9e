//! A bounding volume hierarchy of axis-aligned boxes: median split along the longest side, eight boxes per leaf.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aabb {
    pub low: [i32; 3],
    pub high: [i32; 3],
}

impl Aabb {
    pub const EMPTY: Aabb = Aabb { low: [i32::MAX; 3], high: [i32::MIN; 3] };

    pub fn of(points: &[&[i32; 3]]) -> Aabb {
        points.iter().fold(Aabb::EMPTY, |b, p| b.union(&Aabb { low: **p, high: **p }))
    }

    #[inline]
    pub fn union(&self, other: &Aabb) -> Aabb {
        let mut out = *self;
        for k in 0..3 {
            out.low[k] = out.low[k].min(other.low[k]);
            out.high[k] = out.high[k].max(other.high[k]);
        }
        out
    }

    #[inline(always)]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    /// Whether the boxes overlap in more than their borders. A box without thickness may lie inside another.
    pub fn enters(&self, other: &Aabb) -> bool {
        (0..3).all(|k| self.low[k] < other.high[k] && other.low[k] < self.high[k])
    }

    pub fn common(&self, other: &Aabb) -> Aabb {
        let mut out = *self;
        for k in 0..3 {
            out.low[k] = out.low[k].max(other.low[k]);
            out.high[k] = out.high[k].min(other.high[k]);
        }
        out
    }

    /// The box extended toward the viewer by `depth`.
    pub fn toward_viewer(mut self, depth: i64) -> Aabb {
        self.low[2] = (i64::from(self.low[2]) - depth).max(i64::from(i32::MIN)) as i32;
        self
    }
}

/// A box, and the number of what it is around.
pub type Item = (Aabb, u32);

struct Node {
    bounds: Aabb,
    /// Leaf: first item. Inner: index of the right child (the left one follows its parent).
    link: u32,
    /// Leaf: number of items; 0 for inner nodes.
    count: u32,
}

pub struct BoxTree {
    nodes: Vec<Node>,
    items: Vec<Item>,
}

const LEAF: usize = 8;

impl BoxTree {
    pub fn new(mut items: Vec<Item>) -> BoxTree {
        let mut nodes = Vec::with_capacity(items.len() / 2 + 1);
        if !items.is_empty() {
            split(&mut items, 0, &mut nodes);
        }
        BoxTree { nodes, items }
    }

    /// The same tree, built on all threads: not while others wait for it within a lock.
    pub fn by_all_threads(mut items: Vec<Item>) -> BoxTree {
        let nodes = if items.is_empty() { Vec::new() } else { halved(&mut items, 0) };
        BoxTree { nodes, items }
    }

    /// Calls `visit` for every item whose box overlaps `query`.
    pub fn query(&self, query: &Aabb, mut visit: impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = [0u32; 64];
        let mut top = 1;
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            if !node.bounds.overlaps(query) {
                continue;
            }
            if node.count > 0 {
                for (bounds, item) in &self.items[node.link as usize..(node.link + node.count) as usize] {
                    if bounds.overlaps(query) {
                        visit(*item);
                    }
                }
            } else {
                // Depth is log2 of the item count: 64 entries are never used up.
                stack[top] = node.link;
                stack[top + 1] = index + 1;
                top += 2;
            }
        }
    }
}

/// More items than this are divided on several threads.
const MANY: usize = 1 << 10;

/// The nodes of items that begin at number `first`; the same in whatever order they are made.
fn halved(items: &mut [Item], first: usize) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(items.len() / 2 + 1);
    if items.len() <= MANY {
        split(items, first, &mut nodes);
        return nodes;
    }
    let bounds = around(items);
    let (left, right) = halves(items, &bounds);
    let then = first + left.len();
    let (left, right) = rayon::join(|| halved(left, first), || halved(right, then));
    nodes.push(Node { bounds, link: left.len() as u32 + 1, count: 0 });
    for part in [left, right] {
        let begin = nodes.len() as u32;
        // The links of inner nodes are places among the nodes.
        let moved = |node: Node| if node.count > 0 { node } else { Node { link: node.link + begin, ..node } };
        nodes.extend(part.into_iter().map(moved));
    }
    nodes
}

fn around(items: &[Item]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |b, (a, _)| b.union(a))
}

/// Puts the lower half along the longest side of their bounds first; returns both halves.
fn halves<'i>(items: &'i mut [Item], bounds: &Aabb) -> (&'i mut [Item], &'i mut [Item]) {
    let axis = (0..3).max_by_key(|&k| i64::from(bounds.high[k]) - i64::from(bounds.low[k])).unwrap_or(0);
    let half = items.len() / 2;
    items.select_nth_unstable_by_key(half, |(b, i)| (i64::from(b.low[axis]) + i64::from(b.high[axis]), *i));
    items.split_at_mut(half)
}

fn split(items: &mut [Item], first: usize, nodes: &mut Vec<Node>) {
    let (bounds, here) = (around(items), nodes.len());
    if items.len() <= LEAF {
        nodes.push(Node { bounds, link: first as u32, count: items.len() as u32 });
        return;
    }
    nodes.push(Node { bounds, link: 0, count: 0 });
    let (left, right) = halves(items, &bounds);
    let then = first + left.len();
    split(left, first, nodes);
    nodes[here].link = nodes.len() as u32;
    split(right, then, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_a_plain_search_finds() {
        let mut state = 1u64;
        let mut random = |n: i32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) as i32).rem_euclid(n)
        };
        let mut cube = |size: i32| {
            let low = [random(100), random(100), random(100)];
            Aabb { low, high: [low[0] + random(size), low[1] + random(size), low[2] + random(size)] }
        };
        for count in [500, 3 * MANY as u32] {
            let boxes: Vec<(Aabb, u32)> = (0..count).map(|i| (cube(20), i)).collect();
            let tree = if count > 500 { BoxTree::by_all_threads(boxes.clone()) } else { BoxTree::new(boxes.clone()) };
            for _ in 0..if count > 500 { 20 } else { 200 } {
                let q = cube(30);
                let mut found = Vec::new();
                tree.query(&q, |i| found.push(i));
                found.sort_unstable();
                let expected: Vec<u32> = boxes.iter().filter(|(b, _)| b.overlaps(&q)).map(|&(_, i)| i).collect();
                assert_eq!(found, expected);
            }
        }
    }
}
