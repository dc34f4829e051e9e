//! A hierarchy searched against itself or another: finds all pairs of overlapping boxes, each once.
//!
//! Two hierarchies are descended together, so that near items are found together. That takes a few comparisons per
//! item, whereas a search for each item alone would begin at the root.

use super::aabb::Item;
use super::tree::{LEAF, Node, Tree};

/// With fewer items a second thread gains nothing.
const PAIRED_ALONE: usize = 512;
/// How often, on the way from a node to a leaf, the test `Apart` may fail before it is no longer tried.
const ASKED: u32 = 5;

/// The result of a search, merged from all pairs.
pub trait Found: Default + Send {
    fn join(&mut self, other: Self);
}

/// Called with an item of the first hierarchy and some whose boxes overlap its box: what is worked out of it serves all of
/// these.
pub trait Visit<F>: Fn(u32, &[u32], &mut F) + Sync {}
impl<F, V: Fn(u32, &[u32], &mut F) + Sync> Visit<F> for V {}

/// Whether no two of these items meet, given the bits they have in common. True only where that is certain.
pub trait Apart: Fn(&[Item], u8) -> bool + Sync {}
impl<A: Fn(&[Item], u8) -> bool + Sync> Apart for A {}

impl Tree {
    /// Visits pairs of items of this hierarchy.
    pub fn within<F: Found>(&self, visit: &impl Visit<F>, apart: &impl Apart) -> F {
        if self.nodes.is_empty() { F::default() } else { self.inside(0, 0, visit, apart) }
    }

    fn inside<F: Found>(&self, at: usize, asked: u32, visit: &impl Visit<F>, apart: &impl Apart) -> F {
        let node = &self.nodes[at];
        let mut out = F::default();
        let asks = node.common != 0 && asked < ASKED;
        if asks && apart(self.of_node(node), node.common) {
            return out;
        }
        let asked = asked + u32::from(asks);
        let Some([low, high]) = self.halves(at) else {
            let items = self.of_node(node);
            for (k, (a, s)) in items.iter().enumerate() {
                let (mut near, mut count) = ([0; LEAF], 0);
                for (b, t) in &items[k + 1..] {
                    near[count] = *t;
                    count += usize::from(a.overlaps(b));
                }
                if count > 0 {
                    visit(*s, &near[..count], &mut out);
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
        let (a, b) = (self.of_node(mine), other.of_node(theirs));
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
            let (mut met, mut many) = ([0; LEAF], 0);
            for &k in &near[..count] {
                met[many] = b[k].1;
                many += usize::from(bounds.overlaps(&b[k].0));
            }
            if many > 0 {
                visit(*s, &met[..many], out);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::aabb::Aabb;
    use super::*;
    use crate::random::below;

    #[derive(Default)]
    struct Pairs(Vec<[u32; 2]>);

    impl Found for Pairs {
        fn join(&mut self, mut other: Self) {
            self.0.append(&mut other.0);
        }
    }

    #[test]
    fn finds_what_nested_loops_find() {
        let mut random = below(1);
        for count in [0, 1, 30, 700, 4200] {
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
            let (s, t) = (Tree::new(&a), Tree::new(&b));
            let visit = |i: u32, near: &[u32], out: &mut Pairs| out.0.extend(near.iter().map(|&j| [i, j]));
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
        let tree = Tree::new(&items);
        let wide = |node: &Node| (0..3).map(|k| node.bounds.high[k] - node.bounds.low[k]).max().unwrap();
        let leaves: Vec<i32> =
            tree.nodes.iter().filter(|n| n.second == 0 && n.bounds.high[0] < 1 << 20).map(wide).collect();
        assert!(leaves.len() > 2000);
        let narrow = leaves.iter().filter(|w| **w <= 80).count();
        assert!(10 * narrow > 9 * leaves.len(), "{narrow} of {}", leaves.len());
        let visit = |s: u32, near: &[u32], out: &mut Pairs| out.0.extend(near.iter().map(|&t| [s, t]));
        let found = tree.within(&visit, &|_, _| false).0;
        assert!(found.is_empty());
    }
}
