//! Finds seams: pieces between neighbouring nodes that exactly two borders share.

use std::collections::HashMap;

use super::border::Border;
use super::near::Near;

pub struct Seams {
    pub count: usize,
    /// Per corner that moves: the node that it becomes.
    pub moved: HashMap<u32, u32>,
    /// Per border: the nodes that are inserted into it, in its direction.
    pub inserted: Vec<Vec<u32>>,
}

impl Seams {
    pub fn find(borders: &[Border], near: &Near) -> Seams {
        let mut uses: HashMap<[u32; 2], u32> = HashMap::new();
        for chain in &near.chains {
            for piece in chain.windows(2).map(key).filter(|[a, b]| a != b) {
                *uses.entry(piece).or_default() += 1;
            }
        }
        let joined = |piece: &[u32]| piece[0] != piece[1] && uses[&key(piece)] == 2;
        let mut moved = HashMap::new();
        let mut inserted = Vec::with_capacity(borders.len());
        for (border, chain) in borders.iter().zip(&near.chains) {
            let last = chain.len() - 1;
            for (v, piece) in [(border.ends[0], &chain[..2]), (border.ends[1], &chain[last - 1..])] {
                let n = *near.node.get(&v).unwrap_or(&v);
                if n != v && joined(piece) {
                    moved.insert(v, n);
                }
            }
            inserted.push(
                (1..last)
                    .filter(|&k| joined(&chain[k - 1..=k]) || joined(&chain[k..=k + 1]))
                    .map(|k| chain[k])
                    .collect(),
            );
        }
        let count = uses.values().filter(|&&n| n == 2).count();
        Seams { count, moved, inserted }
    }
}

fn key(piece: &[u32]) -> [u32; 2] {
    [piece[0].min(piece[1]), piece[0].max(piece[1])]
}
