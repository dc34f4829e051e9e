//! Join edges of equal key at vertices where exactly two of them meet.

pub struct Chains {
    pub offsets: Vec<i32>,
    /// Positions in the given edge list, chain by chain.
    pub order: Vec<i32>,
    /// Walked from second to first vertex.
    pub reversed: Vec<bool>,
}

/// Open chains first (by their lowest end edge), then closed ones. Edges of different keys never join.
pub fn chain(edges: &[[i32; 2]], key: &[i32]) -> Chains {
    let mut ends: Vec<(i32, i32, u32)> = Vec::with_capacity(2 * edges.len());
    for (i, e) in edges.iter().enumerate() {
        ends.push((key[i], e[0], i as u32));
        ends.push((key[i], e[1], i as u32));
    }
    ends.sort_unstable();
    // next[2 i + s]: the edge that continues edge i at its end s, or none.
    let mut next = vec![u32::MAX; 2 * edges.len()];
    let mut i = 0;
    while i < ends.len() {
        let mut j = i;
        while j < ends.len() && (ends[j].0, ends[j].1) == (ends[i].0, ends[i].1) {
            j += 1;
        }
        if j == i + 2 && ends[i].2 != ends[i + 1].2 {
            let vertex = ends[i].1;
            for (own, other) in [(ends[i].2, ends[i + 1].2), (ends[i + 1].2, ends[i].2)] {
                let side = usize::from(edges[own as usize][1] == vertex);
                next[2 * own as usize + side] = other;
            }
        }
        i = j;
    }
    let mut out = Chains { offsets: vec![0], order: Vec::new(), reversed: Vec::new() };
    let mut used = vec![false; edges.len()];
    for pass in 0..2 {
        for first in 0..edges.len() {
            if used[first] {
                continue;
            }
            let (start_free, end_free) = (next[2 * first] == u32::MAX, next[2 * first + 1] == u32::MAX);
            if pass == 0 && !start_free && !end_free {
                continue;
            }
            let mut current = first;
            let mut backward = pass == 0 && !start_free;
            loop {
                used[current] = true;
                out.order.push(current as i32);
                out.reversed.push(backward);
                let leave = usize::from(!backward);
                let vertex = edges[current][leave];
                let follow = next[2 * current + leave];
                if follow == u32::MAX || used[follow as usize] {
                    break;
                }
                current = follow as usize;
                backward = edges[current][1] == vertex;
            }
            out.offsets.push(out.order.len() as i32);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_and_a_loop() {
        let edges = [[1, 2], [0, 1], [2, 3], [5, 6], [6, 7], [5, 7]];
        let c = chain(&edges, &[0; 6]);
        assert_eq!(c.offsets, [0, 3, 6]);
        assert_eq!(c.order, [1, 0, 2, 3, 4, 5]);
        assert_eq!(c.reversed, [false, false, false, false, false, true]);
    }

    #[test]
    fn forks_and_keys_end_chains() {
        assert_eq!(chain(&[[0, 1], [1, 2], [1, 3]], &[0; 3]).offsets.len(), 4);
        assert_eq!(chain(&[[0, 1], [1, 2]], &[0, 1]).offsets.len(), 3);
    }
}
