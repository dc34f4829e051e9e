//! A bounding volume hierarchy that is searched against itself or another: finds all pairs of overlapping boxes, each
//! once.
//!
//! Two hierarchies are descended together, so that near items are found together. That takes a few comparisons per
//! item, whereas a search for each item alone would begin at the root. Items are sorted along Morton's curve (G.
//! Morton, "A computer oriented geodetic data base", 1966): one sort makes the hierarchy.

use rayon::prelude::*;

use crate::scan::box_tree::{Aabb, Item};

pub struct Tree {
    items: Vec<Item>,
    nodes: Vec<Node>,
}

struct Node {
    bounds: Aabb,
    first: u32,
    count: u32,
    /// Offset from this node to its second half; the first half is the next node. 0 for leaves.
    second: u32,
    /// The bits that all its items have in common.
    common: u8,
}

/// Most items of a leaf.
const LEAF: usize = 12;
/// With fewer items a second thread gains nothing: where items are listed,
const ALONE: usize = 4096;
/// and where pairs of them are tried.
const PAIRED_ALONE: usize = 512;
/// How often, on the way from a node to a leaf, the test `Apart` may fail before it is no longer tried.
const ASKED: u32 = 5;

/// The result of a search, merged from all pairs.
pub trait Found: Default + Send {
    fn join(&mut self, other: Self);
}

/// Called with two items whose boxes overlap; the first is of the first hierarchy.
pub trait Visit<F>: Fn(u32, u32, &mut F) + Sync {}
impl<F, V: Fn(u32, u32, &mut F) + Sync> Visit<F> for V {}

/// Whether no two of these items meet, given the bits they have in common. True only where that is certain.
pub trait Apart: Fn(&[Item], u8) -> bool + Sync {}
impl<A: Fn(&[Item], u8) -> bool + Sync> Apart for A {}

impl Tree {
    /// `kind`: the bits of an item. Each node keeps those that all its items have in common.
    pub fn new(items: &[Item], kind: &(impl Fn(u32) -> u8 + Sync)) -> Tree {
        let cube = MortonCube::of(items);
        let codes = items.par_iter().with_min_len(ALONE).enumerate();
        let mut order: Vec<u64> = codes.map(|(k, (a, _))| cube.code(a) << INDEX_BITS | k as u64).collect();
        if order.len() > ALONE {
            order.par_sort_unstable();
        } else {
            order.sort_unstable();
        }
        let item = |code: &u64| items[(code & ((1 << INDEX_BITS) - 1)) as usize];
        let mut sorted: Vec<Item> = order.par_iter().with_min_len(ALONE).map(item).collect();
        sort_within_cells(&mut sorted, &order, INDEX_BITS);
        let nodes = if sorted.is_empty() { Vec::new() } else { built(&order, &sorted, 0, kind) };
        Tree { items: sorted, nodes }
    }

    /// Visits pairs of items of this hierarchy.
    pub fn within<F: Found>(&self, visit: &impl Visit<F>, apart: &impl Apart) -> F {
        if self.nodes.is_empty() { F::default() } else { self.inside(0, 0, visit, apart) }
    }

    fn inside<F: Found>(&self, at: usize, asked: u32, visit: &impl Visit<F>, apart: &impl Apart) -> F {
        let node = &self.nodes[at];
        let mut out = F::default();
        let asks = node.common != 0 && asked < ASKED;
        if asks && apart(self.of(node), node.common) {
            return out;
        }
        let asked = asked + u32::from(asks);
        let Some([low, high]) = self.halves(at) else {
            let items = self.of(node);
            for (k, (a, s)) in items.iter().enumerate() {
                for (b, t) in &items[k + 1..] {
                    if a.overlaps(b) {
                        visit(*s, *t, &mut out);
                    }
                }
            }
            return out;
        };
        if node.count as usize > PAIRED_ALONE {
            let (a, b) =
                rayon::join(|| self.inside(low, asked, visit, apart), || self.inside(high, asked, visit, apart));
            out = a;
            out.join(b);
        } else {
            out = self.inside(low, asked, visit, apart);
            out.join(self.inside(high, asked, visit, apart));
        }
        self.meet(low, self, high, visit, &mut out);
        out
    }

    /// Visits pairs of one item of this hierarchy and one of another.
    pub fn between<F: Found>(&self, other: &Tree, visit: &impl Visit<F>) -> F {
        let mut out = F::default();
        if !self.nodes.is_empty() && !other.nodes.is_empty() {
            self.meet(0, other, 0, visit, &mut out);
        }
        out
    }

    fn of(&self, node: &Node) -> &[Item] {
        &self.items[node.first as usize..(node.first + node.count) as usize]
    }

    fn halves(&self, at: usize) -> Option<[usize; 2]> {
        let second = self.nodes[at].second as usize;
        (second > 0).then_some([at + 1, at + second])
    }

    fn meet<F: Found>(&self, at: usize, other: &Tree, there: usize, visit: &impl Visit<F>, out: &mut F) {
        let (mine, theirs) = (&self.nodes[at], &other.nodes[there]);
        if !mine.bounds.overlaps(&theirs.bounds) {
            return;
        }
        let ways = match (self.halves(at), other.halves(there)) {
            (None, None) => return self.leaves(mine, other, theirs, visit, out),
            (Some([low, high]), None) => [(low, there), (high, there)],
            (Some([low, high]), _) if mine.count >= theirs.count => [(low, there), (high, there)],
            (_, Some([low, high])) => [(at, low), (at, high)],
        };
        if (mine.count + theirs.count) as usize > PAIRED_ALONE {
            let run = |(a, b): (usize, usize)| {
                let mut found = F::default();
                self.meet(a, other, b, visit, &mut found);
                found
            };
            let (a, b) = rayon::join(|| run(ways[0]), || run(ways[1]));
            out.join(a);
            out.join(b);
        } else {
            ways.into_iter().for_each(|(a, b)| self.meet(a, other, b, visit, out));
        }
    }

    fn leaves<F: Found>(&self, mine: &Node, other: &Tree, theirs: &Node, visit: &impl Visit<F>, out: &mut F) {
        let (a, b) = (self.of(mine), other.of(theirs));
        let mut near = [0usize; LEAF];
        let mut count = 0;
        for (k, (bounds, _)) in b.iter().enumerate() {
            near[count] = k;
            count += usize::from(bounds.overlaps(&mine.bounds));
        }
        if count == 0 {
            return;
        }
        for (bounds, s) in a.iter().filter(|(bounds, _)| bounds.overlaps(&theirs.bounds)) {
            for &k in &near[..count] {
                if bounds.overlaps(&b[k].0) {
                    visit(*s, b[k].1, out);
                }
            }
        }
    }
}

/// Bits of a position along Morton's curve that are the number of the item, and bits of each of its coordinates.
const INDEX_BITS: u32 = 31;
const SIDE_BITS: u32 = 11;

/// A cube around the middles of boxes, divided into cells along Morton's curve. Middles are sums of two coordinates.
struct MortonCube {
    low: [i64; 3],
    side: u64,
    /// Sums lose so many bits.
    down: u32,
}

impl MortonCube {
    fn of(items: &[Item]) -> MortonCube {
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for middle in items.iter().map(|(bounds, _)| middle(bounds)) {
            low = [0, 1, 2].map(|k| low[k].min(middle[k]));
            high = [0, 1, 2].map(|k| high[k].max(middle[k]));
        }
        let side = (0..3).map(|k| high[k].saturating_sub(low[k])).max().unwrap_or(0).max(0) as u64;
        MortonCube { low, side, down: (64 - side.leading_zeros()).saturating_sub(SIDE_BITS) }
    }

    /// The position of a box's middle along the curve: the bits of its coordinates, interleaved.
    fn code(&self, of: &Aabb) -> u64 {
        let spread = |x: u64| {
            let x = (x | x << 16) & 0x0700_00FF;
            let x = (x | x << 8) & 0x0700_F00F;
            let x = (x | x << 4) & 0x430C_30C3;
            (x | x << 2) & 0x4924_9249
        };
        let middle = middle(of);
        (0..3).fold(0, |out, k| out | spread((middle[k] - self.low[k]) as u64 >> self.down) << k)
    }
}

fn middle(of: &Aabb) -> [i64; 3] {
    [0, 1, 2].map(|k| i64::from(of.low[k]) + i64::from(of.high[k]))
}

/// Sorts the items of each cell that are more than a leaf takes along a curve through that cell alone: most items may lie
/// in one cell, where one lies far away. codes: of the items, ascending; shift: bits of them that do not count.
fn sort_within_cells(items: &mut [Item], codes: &[u64], shift: u32) {
    let mut rest = items;
    for cell in codes.chunk_by(|a, b| a >> shift == b >> shift) {
        let (own, after) = rest.split_at_mut(cell.len());
        rest = after;
        if own.len() <= LEAF {
            continue;
        }
        let cube = MortonCube::of(own);
        if cube.side > 0 {
            own.sort_by_cached_key(|(bounds, item)| (cube.code(bounds), *item));
            let finer: Vec<u64> = own.iter().map(|(bounds, _)| cube.code(bounds)).collect();
            sort_within_cells(own, &finer, 0);
        }
    }
}

fn around(items: &[Item]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |b, (a, _)| b.union(a))
}

/// Builds the nodes: items are divided where their highest differing bit changes, or in the middle if none differs.
fn built(order: &[u64], items: &[Item], first: u32, kind: &(impl Fn(u32) -> u8 + Sync)) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(items.len() / 3 + 1);
    build(order, items, first, kind, &mut nodes);
    nodes
}

fn build(order: &[u64], items: &[Item], first: u32, kind: &(impl Fn(u32) -> u8 + Sync), nodes: &mut Vec<Node>) {
    let count = items.len();
    if count <= LEAF {
        let bounds = around(items);
        let common = items.iter().fold(u8::MAX, |common, &(_, item)| common & kind(item));
        nodes.push(Node { bounds, first, count: count as u32, second: 0, common });
        return;
    }
    let differ = (order[0] ^ order[count - 1]) >> INDEX_BITS;
    let half = match differ.checked_ilog2() {
        Some(bit) => order.partition_point(|code| code >> (bit + INDEX_BITS) & 1 == 0),
        None => count / 2,
    };
    let (at, then) = (nodes.len(), first + half as u32);
    let ((order_low, order_high), (low, high)) = (order.split_at(half), items.split_at(half));
    nodes.push(Node { bounds: Aabb::EMPTY, first, count: count as u32, second: 0, common: 0 });
    if count > ALONE {
        let (a, b) = rayon::join(|| built(order_low, low, first, kind), || built(order_high, high, then, kind));
        nodes.extend(a);
        nodes[at].second = (nodes.len() - at) as u32;
        nodes.extend(b);
    } else {
        build(order_low, low, first, kind, nodes);
        nodes[at].second = (nodes.len() - at) as u32;
        build(order_high, high, then, kind, nodes);
    }
    let (a, b) = (&nodes[at + 1], &nodes[at + nodes[at].second as usize]);
    (nodes[at].bounds, nodes[at].common) = (a.bounds.union(&b.bounds), a.common & b.common);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Pairs(Vec<[u32; 2]>);

    impl Found for Pairs {
        fn join(&mut self, mut other: Self) {
            self.0.append(&mut other.0);
        }
    }

    #[test]
    fn finds_what_nested_loops_find() {
        let mut state = 1u64;
        let mut random = |n: i32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) as i32).rem_euclid(n)
        };
        for count in [0, 1, 30, 700, ALONE as u32 + 100] {
            let mut boxes = |first: u32| -> Vec<Item> {
                let mut cube = || {
                    let low = [random(1000), random(1000), random(1000)];
                    Aabb { low, high: [low[0] + random(60), low[1] + random(60), low[2] + random(60)] }
                };
                (0..count).map(|k| (cube(), first + k)).collect()
            };
            let (a, b) = (boxes(0), boxes(count));
            let plain = |of: &dyn Fn(usize) -> usize, a: &[Item], b: &[Item]| -> Vec<[u32; 2]> {
                let pairs = (0..a.len()).flat_map(|i| (of(i)..b.len()).map(move |j| (i, j)));
                let mut all: Vec<_> =
                    pairs.filter(|&(i, j)| a[i].0.overlaps(&b[j].0)).map(|(i, j)| [a[i].1, b[j].1]).collect();
                all.sort_unstable();
                all
            };
            let (own, both) = (plain(&|i| i + 1, &a, &a), plain(&|_| 0, &a, &b));
            let (s, t) = (Tree::new(&a, &|_| 0), Tree::new(&b, &|_| 0));
            let visit = |i: u32, j: u32, out: &mut Pairs| out.0.push([i, j]);
            let mut found = s.within(&visit, &|_, _| false).0;
            found.iter_mut().for_each(|pair| pair.sort_unstable());
            found.sort_unstable();
            assert_eq!(found, own);
            let mut found = s.between(&t, &visit).0;
            found.sort_unstable();
            assert_eq!(found, both);
        }
    }
    #[test]
    fn one_item_far_away_does_not_throw_all_others_together() {
        // 32 x 32 x 32 cubes in no order, and one that is 100,000 times as far off as these are wide.
        let small = |k: u32| {
            let at = |shift: u32| (((k * 7919) >> shift) & 31) as i32 * 10;
            let low = [at(0), at(5), at(10)];
            Aabb { low, high: low.map(|c| c + 8) }
        };
        let mut items: Vec<Item> = (0..1 << 15).map(|k| (small(k), k)).collect();
        items.push((Aabb { low: [1 << 30; 3], high: [(1 << 30) + 8; 3] }, 1 << 15));
        // A large one in the middle of them has no say in how they are divided.
        items.push((Aabb { low: [-(1 << 28); 3], high: [1 << 28, 1 << 28, -1] }, (1 << 15) + 1));
        let tree = Tree::new(&items, &|_| 0);
        let wide = |node: &Node| (0..3).map(|k| node.bounds.high[k] - node.bounds.low[k]).max().unwrap();
        let leaves: Vec<i32> =
            tree.nodes.iter().filter(|n| n.second == 0 && n.bounds.high[0] < 1 << 20).map(wide).collect();
        assert!(leaves.len() > 2000);
        let narrow = leaves.iter().filter(|w| **w <= 80).count();
        assert!(10 * narrow > 9 * leaves.len(), "{narrow} of {}", leaves.len());
        let found = tree.within(&|s, t, out: &mut Pairs| out.0.push([s, t]), &|_, _| false).0;
        assert!(found.is_empty());
    }
}
