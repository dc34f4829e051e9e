//! Each edge of the source as a walk: the mesh edges that it runs along, in order.

use super::tables::Tables;

#[derive(Clone, Debug, Default)]
pub struct Walks {
    /// Walk i runs along edges[offsets[i]..offsets[i + 1]], each `reversed` or from its lower to its higher vertex.
    pub offsets: Vec<i32>,
    pub edges: Vec<i32>,
    pub reversed: Vec<bool>,
    pub kind: Vec<u8>,
    pub part: Vec<i32>,
    pub index: Vec<i32>,
    /// Edges that no triangle has; they were added, and their numbers follow those of the others.
    pub loose: Vec<[i32; 2]>,
}

/// The walks of all edges of B-reps; `edges` ascend. A step from a vertex to itself is left out.
pub fn source_walks(tables: &Tables, edges: &[[i32; 2]]) -> Walks {
    let count = tables.edge_index.len();
    let mut out = Walks { offsets: Vec::with_capacity(count + 1), ..Walks::default() };
    let mut missing: Vec<(usize, [i32; 2])> = Vec::new();
    out.offsets.push(0);
    for chain in tables.edge_offsets.windows(2) {
        for step in tables.edge_nodes[chain[0] as usize..chain[1] as usize].windows(2) {
            let (a, b) = (step[0], step[1]);
            if a == b {
                continue;
            }
            let key = [a.min(b), a.max(b)];
            let found = edges.binary_search(&key);
            if found.is_err() {
                missing.push((out.edges.len(), key));
            }
            out.edges.push(found.unwrap_or(0) as i32);
            out.reversed.push(a > b);
        }
        out.offsets.push(out.edges.len() as i32);
    }
    out.loose = missing.iter().map(|m| m.1).collect();
    out.loose.sort_unstable();
    out.loose.dedup();
    for (place, key) in missing {
        let number = out.loose.binary_search(&key).unwrap_or(0);
        out.edges[place] = (edges.len() + number) as i32;
    }
    out.kind.clone_from(&tables.edge_class);
    out.part = super::tables::per_item(&tables.edge_start);
    out.index.clone_from(&tables.edge_index);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_along_edges_and_off_them() {
        let tables = Tables {
            edge_start: vec![0, 2, 3],
            edge_offsets: vec![0, 4, 6, 8],
            edge_nodes: vec![2, 1, 1, 0, 5, 4, 6, 7],
            edge_index: vec![0, 3, 0],
            edge_class: vec![0, 1, 3],
            ..Tables::default()
        };
        let walks = source_walks(&tables, &[[0, 1], [1, 2], [6, 7]]);
        assert_eq!((walks.offsets, walks.edges), (vec![0, 2, 3, 4], vec![1, 0, 3, 2]));
        assert_eq!((walks.reversed, walks.loose), (vec![true, true, true, false], vec![[4, 5]]));
        assert_eq!(walks.part, [0, 0, 1]);
    }
}
