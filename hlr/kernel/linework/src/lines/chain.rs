//! Joins edges of equal key into chains. At a vertex where exactly two edges meet, these are joined; where more meet,
//! only the one pair that runs nearly straight on.
//!
//! ```text
//!        |                 a rib that ends on a rim does not divide the rim;
//!   -----+-----            four edges in a cross are two lines
//! ```

use hlr_exact::elementary::acos;

pub struct Chains {
    pub offsets: Vec<i32>,
    /// Positions in the given edge list, chain by chain.
    pub order: Vec<i32>,
    /// Walked from second to first vertex.
    pub reversed: Vec<bool>,
}

/// The positions of the vertices, and the largest turn (radians) that still counts as straight on.
pub struct Straight<'a> {
    pub points: &'a [[f64; 3]],
    pub turn: f64,
}

/// Ten degrees, in radians. Every other continuation must turn by this much more; otherwise none is chosen.
const CLEARLY: f64 = std::f64::consts::PI / 18.0;

const NONE: u32 = u32::MAX;

/// Open chains first (by their lowest end edge), then closed ones. Edges of different keys never join.
pub fn chain(edges: &[[i32; 2]], key: &[i32], straight: Option<&Straight>) -> Chains {
    let next = continuations(edges, key, straight);
    let mut out = Chains { offsets: vec![0], order: Vec::new(), reversed: Vec::new() };
    let mut used = vec![false; edges.len()];
    for pass in 0..2 {
        for first in 0..edges.len() {
            if used[first] {
                continue;
            }
            let (start_free, end_free) = (next[2 * first] == NONE, next[2 * first + 1] == NONE);
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
                if follow == NONE || used[follow as usize] {
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

/// next[2 i + s]: the edge that continues edge i at its end s, or none.
fn continuations(edges: &[[i32; 2]], key: &[i32], straight: Option<&Straight>) -> Vec<u32> {
    let mut ends: Vec<(i32, i32, u32)> = Vec::with_capacity(2 * edges.len());
    for (i, e) in edges.iter().enumerate() {
        ends.push((key[i], e[0], i as u32));
        ends.push((key[i], e[1], i as u32));
    }
    ends.sort_unstable();
    let mut next = vec![NONE; 2 * edges.len()];
    for meeting in ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let vertex = meeting[0].1;
        let mut join = |a: u32, b: u32| {
            for (own, other) in [(a, b), (b, a)] {
                let side = usize::from(edges[own as usize][1] == vertex);
                next[2 * own as usize + side] = other;
            }
        };
        match (meeting, straight) {
            ([a, b], _) if a.2 != b.2 => join(a.2, b.2),
            ([_, _, _, ..], Some(straight)) => {
                let around: Vec<u32> = meeting.iter().map(|m| m.2).collect();
                straight_pairs(edges, &around, vertex, straight).into_iter().for_each(|(a, b)| join(a, b));
            }
            _ => {}
        }
    }
    next
}

/// Pairs of edges at a vertex, each clearly the other's straightest continuation.
fn straight_pairs(edges: &[[i32; 2]], around: &[u32], vertex: i32, straight: &Straight) -> Vec<(u32, u32)> {
    let here = straight.points[vertex as usize];
    let ways: Vec<[f64; 3]> = around
        .iter()
        .map(|&e| {
            let [a, b] = edges[e as usize];
            let far = straight.points[if a == vertex { b } else { a } as usize];
            let way = [0, 1, 2].map(|k| far[k] - here[k]);
            let size = way.iter().map(|c| c * c).sum::<f64>().sqrt();
            way.map(|c| if size > 0.0 { c / size } else { 0.0 })
        })
        .collect();
    let turn = |i: usize, j: usize| {
        let cosine = -(0..3).map(|k| ways[i][k] * ways[j][k]).sum::<f64>();
        acos(cosine.clamp(-1.0, 1.0))
    };
    let only = |i: usize| {
        let (mut best, mut second) = ((f64::INFINITY, i), f64::INFINITY);
        for j in (0..ways.len()).filter(|&j| j != i) {
            let t = turn(i, j);
            if t < best.0 {
                (best, second) = ((t, j), best.0);
            } else {
                second = second.min(t);
            }
        }
        (best.0 <= straight.turn && second >= best.0 + CLEARLY).then_some(best.1)
    };
    (0..ways.len())
        .filter_map(|i| only(i).filter(|&j| i < j && only(j) == Some(i)).map(|j| (around[i], around[j])))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_and_a_loop() {
        let edges = [[1, 2], [0, 1], [2, 3], [5, 6], [6, 7], [5, 7]];
        let c = chain(&edges, &[0; 6], None);
        assert_eq!(c.offsets, [0, 3, 6]);
        assert_eq!(c.order, [1, 0, 2, 3, 4, 5]);
        assert_eq!(c.reversed, [false, false, false, false, false, true]);
    }

    #[test]
    fn forks_and_keys_end_chains() {
        assert_eq!(chain(&[[0, 1], [1, 2], [1, 3]], &[0; 3], None).offsets.len(), 4);
        assert_eq!(chain(&[[0, 1], [1, 2]], &[0, 1], None).offsets.len(), 3);
    }

    #[test]
    fn a_rim_goes_on_past_a_rib_and_a_cross_is_two_lines() {
        let points = [[-1.0, 0.1, 0.0], [0.0; 3], [1.0, 0.1, 0.0], [0.0, -1.0, 0.0], [0.1, 1.0, 0.0], [1.0, 0.0, 0.0]];
        let straight = Straight { points: &points, turn: 30f64.to_radians() };
        let rim = chain(&[[0, 1], [1, 2], [1, 3]], &[0; 3], Some(&straight));
        assert_eq!((rim.offsets, rim.order), (vec![0, 2, 3], vec![0, 1, 2]));
        let cross = chain(&[[0, 1], [1, 2], [1, 3], [1, 4]], &[0; 4], Some(&straight));
        assert_eq!((cross.offsets, cross.order), (vec![0, 2, 4], vec![0, 1, 2, 3]));
        // Of two equally straight continuations none is chosen.
        assert_eq!(chain(&[[0, 1], [1, 2], [1, 5]], &[0; 3], Some(&straight)).offsets.len(), 4);
    }
}
