//! Every mesh edge with its triangles: once per model, whatever the view.

use rayon::prelude::*;

pub struct Topology {
    pub edges: Vec<[i32; 2]>,
    pub offsets: Vec<i32>,
    pub incident: Vec<i32>,
}

/// Edges (lo < hi, ascending) and the triangles incident to each, ascending. Triangles with a repeated corner
/// contribute their remaining edge twice, which cancels in every jump.
pub fn topology(triangles: &[[i32; 3]]) -> Topology {
    let mut sides: Vec<(u64, u32)> = Vec::with_capacity(3 * triangles.len());
    for (t, &[p, q, r]) in triangles.iter().enumerate() {
        for (a, b) in [(p, q), (q, r), (r, p)] {
            if a != b {
                sides.push((((a.min(b) as u64) << 32) | a.max(b) as u64, t as u32));
            }
        }
    }
    sides.par_sort_unstable();
    let mut out = Topology {
        edges: Vec::with_capacity(sides.len() / 2),
        offsets: Vec::with_capacity(sides.len() / 2 + 1),
        incident: Vec::with_capacity(sides.len()),
    };
    let mut last = u64::MAX;
    for &(key, t) in &sides {
        if key != last {
            out.offsets.push(out.incident.len() as i32);
            out.edges.push([(key >> 32) as i32, (key & 0xffff_ffff) as i32]);
            last = key;
        }
        out.incident.push(t as i32);
    }
    out.offsets.push(out.incident.len() as i32);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_has_six_edges_of_two_triangles() {
        let t = topology(&[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        assert_eq!(t.edges, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]);
        assert!(t.offsets.windows(2).all(|w| w[1] - w[0] == 2));
    }
}
