//! Boxes in a hierarchy that is searched against itself or another: all pairs that overlap, each once.
//!
//! Two hierarchies are gone down side by side, so what lies near one another is found together: per item that takes a few
//! comparisons, where each item alone would begin at the root.

use crate::scan::box_tree::Aabb;

pub type Item = (Aabb, u32);

pub struct Tree<'a> {
    pub bounds: Aabb,
    pub count: usize,
    node: Node<'a>,
}

enum Node<'a> {
    Leaf(&'a [Item]),
    Inner(Box<[Tree<'a>; 2]>),
}

/// Items of a leaf, at most.
const LEAF: usize = 24;
/// Items below which nothing is gained by a second thread.
const ALONE: usize = 4096;

/// What is found, added up over all pairs.
pub trait Found: Default + Send {
    fn join(&mut self, other: Self);
}

/// Called with two items whose boxes overlap; the first is of the first hierarchy.
pub trait Visit<F>: Fn(u32, u32, &mut F) + Sync {}
impl<F, V: Fn(u32, u32, &mut F) + Sync> Visit<F> for V {}

impl<'a> Tree<'a> {
    /// Median split along the longest side. Items are put in the order of the leaves.
    pub fn new(items: &'a mut [Item]) -> Tree<'a> {
        let bounds = items.iter().fold(Aabb::EMPTY, |b, (a, _)| b.union(a));
        let count = items.len();
        if count <= LEAF {
            return Tree { bounds, count, node: Node::Leaf(items) };
        }
        let axis = (0..3).max_by_key(|&k| i64::from(bounds.high[k]) - i64::from(bounds.low[k])).unwrap_or(0);
        let half = count / 2;
        items.select_nth_unstable_by_key(half, |(b, i)| (i64::from(b.low[axis]) + i64::from(b.high[axis]), *i));
        let (low, high) = items.split_at_mut(half);
        let (low, high) = if count > ALONE {
            rayon::join(|| Tree::new(low), || Tree::new(high))
        } else {
            (Tree::new(low), Tree::new(high))
        };
        Tree { bounds, count, node: Node::Inner(Box::new([low, high])) }
    }

    /// Pairs of items of this hierarchy.
    pub fn within<F: Found>(&self, visit: &impl Visit<F>) -> F {
        let mut out = F::default();
        match &self.node {
            Node::Leaf(items) => {
                for (k, (a, s)) in items.iter().enumerate() {
                    for (b, t) in &items[k + 1..] {
                        if a.overlaps(b) {
                            visit(*s, *t, &mut out);
                        }
                    }
                }
            }
            Node::Inner(halves) => {
                let [low, high] = &**halves;
                if self.count > ALONE {
                    let (a, b) = rayon::join(|| low.within(visit), || high.within(visit));
                    out = a;
                    out.join(b);
                } else {
                    out = low.within(visit);
                    out.join(high.within(visit));
                }
                out.join(low.between(high, visit));
            }
        }
        out
    }

    /// Pairs of an item of this hierarchy and one of another.
    pub fn between<F: Found>(&self, other: &Tree, visit: &impl Visit<F>) -> F {
        let mut out = F::default();
        self.meet(other, visit, &mut out);
        out
    }

    fn meet<F: Found>(&self, other: &Tree, visit: &impl Visit<F>, out: &mut F) {
        if !self.bounds.overlaps(&other.bounds) {
            return;
        }
        match (&self.node, &other.node) {
            (Node::Leaf(mine), Node::Leaf(theirs)) => {
                let mut near = [0usize; LEAF];
                let mut count = 0;
                for (k, (b, _)) in theirs.iter().enumerate() {
                    near[count] = k;
                    count += usize::from(b.overlaps(&self.bounds));
                }
                if count == 0 {
                    return;
                }
                for (a, s) in mine.iter().filter(|(a, _)| a.overlaps(&other.bounds)) {
                    for &k in &near[..count] {
                        if a.overlaps(&theirs[k].0) {
                            visit(*s, theirs[k].1, out);
                        }
                    }
                }
            }
            (Node::Inner(halves), _) if self.count >= other.count || matches!(other.node, Node::Leaf(_)) => {
                let [low, high] = &**halves;
                if self.count + other.count > ALONE {
                    let (a, b) = rayon::join(|| low.between(other, visit), || high.between(other, visit));
                    out.join(a);
                    out.join(b);
                } else {
                    low.meet(other, visit, out);
                    high.meet(other, visit, out);
                }
            }
            (_, Node::Inner(halves)) => {
                let [low, high] = &**halves;
                if self.count + other.count > ALONE {
                    let (a, b) = rayon::join(|| self.between(low, visit), || self.between(high, visit));
                    out.join(a);
                    out.join(b);
                } else {
                    self.meet(low, visit, out);
                    self.meet(high, visit, out);
                }
            }
            (Node::Inner(_), Node::Leaf(_)) => unreachable!("taken by the arm before"),
        }
    }
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
        for count in [0, 1, 30, 700, 9000] {
            let mut boxes = |first: u32| -> Vec<Item> {
                let mut cube = || {
                    let low = [random(1000), random(1000), random(1000)];
                    Aabb { low, high: [low[0] + random(60), low[1] + random(60), low[2] + random(60)] }
                };
                (0..count).map(|k| (cube(), first + k)).collect()
            };
            let (mut a, mut b) = (boxes(0), boxes(count));
            let plain = |of: &dyn Fn(usize) -> usize, a: &[Item], b: &[Item]| -> Vec<[u32; 2]> {
                let pairs = (0..a.len()).flat_map(|i| (of(i)..b.len()).map(move |j| (i, j)));
                let mut all: Vec<_> =
                    pairs.filter(|&(i, j)| a[i].0.overlaps(&b[j].0)).map(|(i, j)| [a[i].1, b[j].1]).collect();
                all.sort_unstable();
                all
            };
            let (own, both) = (plain(&|i| i + 1, &a, &a), plain(&|_| 0, &a, &b));
            let (s, t) = (Tree::new(&mut a), Tree::new(&mut b));
            let visit = |i: u32, j: u32, out: &mut Pairs| out.0.push([i, j]);
            let mut found = s.within(&visit).0;
            found.iter_mut().for_each(|pair| pair.sort_unstable());
            found.sort_unstable();
            assert_eq!(found, own);
            let mut found = s.between(&t, &visit).0;
            found.sort_unstable();
            assert_eq!(found, both);
        }
    }
}
