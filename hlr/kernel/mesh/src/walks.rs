//! Walks: the mesh edges along which an edge of the source runs, a crease, an outline, in order.

use std::ops::Range;

use super::tables::Tables;

/// Walks over mesh edges: the edges of the source, its creases and borders, intersection lines, outlines. Sorted by
/// part; -1 stands for none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Walks {
    /// Walk w runs along edges[offsets[w]..offsets[w + 1]], each `reversed` or from its lower to its higher vertex.
    pub offsets: Vec<i32>,
    pub edges: Vec<i32>,
    pub reversed: Vec<bool>,
    pub kind: Vec<u8>,
    pub part: Vec<i32>,
    /// The edge of the source within its part.
    pub index: Vec<i32>,
    /// Of an intersection line the second part.
    pub other: Vec<i32>,
    /// Of an outline the face within its part.
    pub face: Vec<i32>,
    /// Two planar faces meet there at an angle.
    pub straight: Vec<bool>,
    /// Of an intersection line its curve.
    pub curve: Vec<i32>,
    /// Along this intersection line one surface is nowhere deep in the other.
    pub shallow: Vec<bool>,
}

impl Walks {
    pub fn len(&self) -> usize {
        self.part.len()
    }

    pub fn is_empty(&self) -> bool {
        self.part.is_empty()
    }

    /// Where the mesh edges of a walk are in `edges`.
    pub fn run(&self, walk: usize) -> Range<usize> {
        self.offsets[walk] as usize..self.offsets[walk + 1] as usize
    }

    /// These walks and those of another, sorted by part; within a part these come first.
    pub fn merged(&self, other: &Walks) -> Walks {
        let mut order: Vec<(&Walks, usize)> = Vec::with_capacity(self.len() + other.len());
        order.extend((0..self.len()).map(|walk| (self, walk)));
        order.extend((0..other.len()).map(|walk| (other, walk)));
        order.sort_by_key(|&(of, walk)| of.part[walk]);
        let mut out = Walks::with_room(order.len(), self.edges.len() + other.edges.len());
        for (of, walk) in order {
            let run = of.run(walk);
            out.push(&of.edges[run.clone()], &of.reversed[run], of, walk);
        }
        out
    }

    /// The walks after edges got other numbers: target, of each edge, -1 where it is gone; swapped: its lower vertex is
    /// now its higher one. A walk that lost an edge in between goes on as another.
    pub fn moved(&self, target: &[i32], swapped: &[bool]) -> Walks {
        let mut out = Walks::with_room(self.len(), self.edges.len());
        let (mut edges, mut reversed) = (Vec::new(), Vec::new());
        for walk in 0..self.len() {
            for at in self.run(walk) {
                let edge = self.edges[at] as usize;
                if target[edge] >= 0 {
                    edges.push(target[edge]);
                    reversed.push(self.reversed[at] ^ swapped[edge]);
                } else {
                    out.flush(&mut edges, &mut reversed, self, walk);
                }
            }
            out.flush(&mut edges, &mut reversed, self, walk);
        }
        out
    }

    /// Of each of `count` mesh edges the walk along an edge of the source of which it is a chord. Where several share
    /// it, any of them gives the curve of the fold.
    pub fn along_source(&self, count: usize) -> Vec<i32> {
        let mut found = vec![-1; count];
        for walk in (0..self.len()).filter(|&walk| self.index[walk] >= 0) {
            self.edges[self.run(walk)].iter().for_each(|&edge| found[edge as usize] = walk as i32);
        }
        found
    }

    fn with_room(walks: usize, edges: usize) -> Walks {
        let mut offsets = Vec::with_capacity(walks + 1);
        offsets.push(0);
        Walks {
            offsets,
            edges: Vec::with_capacity(edges),
            reversed: Vec::with_capacity(edges),
            kind: Vec::with_capacity(walks),
            part: Vec::with_capacity(walks),
            index: Vec::with_capacity(walks),
            other: Vec::with_capacity(walks),
            face: Vec::with_capacity(walks),
            straight: Vec::with_capacity(walks),
            curve: Vec::with_capacity(walks),
            shallow: Vec::with_capacity(walks),
        }
    }

    /// Adds a walk along these edges, which is of the same edge, face and parts as walk `walk` of `of`.
    fn push(&mut self, edges: &[i32], reversed: &[bool], of: &Walks, walk: usize) {
        self.edges.extend(edges);
        self.reversed.extend(reversed);
        self.offsets.push(self.edges.len() as i32);
        self.kind.push(of.kind[walk]);
        self.part.push(of.part[walk]);
        self.index.push(of.index[walk]);
        self.other.push(of.other[walk]);
        self.face.push(of.face[walk]);
        self.straight.push(of.straight[walk]);
        self.curve.push(of.curve[walk]);
        self.shallow.push(of.shallow[walk]);
    }

    /// The same where there are any edges, which are then taken out.
    fn flush(&mut self, edges: &mut Vec<i32>, reversed: &mut Vec<bool>, of: &Walks, walk: usize) {
        if !edges.is_empty() {
            self.push(edges, reversed, of, walk);
        }
        edges.clear();
        reversed.clear();
    }
}

/// The walks of all edges of B-reps, none of which is called straight yet; and steps along which no triangle has an
/// edge: their edges follow `edges`, which ascend. A step from a vertex to itself is left out.
pub fn source_walks(tables: &Tables, edges: &[[i32; 2]]) -> (Walks, Vec<[i32; 2]>) {
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
    let mut loose: Vec<[i32; 2]> = missing.iter().map(|m| m.1).collect();
    loose.sort_unstable();
    loose.dedup();
    for (place, key) in missing {
        let number = loose.binary_search(&key).unwrap_or(0);
        out.edges[place] = (edges.len() + number) as i32;
    }
    out.kind.clone_from(&tables.edge_class);
    out.part = super::tables::per_item(&tables.edge_start);
    out.index.clone_from(&tables.edge_index);
    (out.other, out.face, out.curve) = (vec![-1; count], vec![-1; count], vec![-1; count]);
    (out.straight, out.shallow) = (vec![false; count], vec![false; count]);
    (out, loose)
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
        let (walks, loose) = source_walks(&tables, &[[0, 1], [1, 2], [6, 7]]);
        assert_eq!((walks.offsets, walks.edges), (vec![0, 2, 3, 4], vec![1, 0, 3, 2]));
        assert_eq!((walks.reversed, loose), (vec![true, true, true, false], vec![[4, 5]]));
        assert_eq!((walks.part, walks.curve), (vec![0, 0, 1], vec![-1; 3]));
    }

    /// Walks of these parts and edges; walk w is edge w of the source.
    fn walks(of: &[(i32, &[i32])]) -> Walks {
        let mut out = Walks::with_room(0, 0);
        for (w, &(part, edges)) in of.iter().enumerate() {
            let about = Walks {
                kind: vec![w as u8],
                part: vec![part],
                index: vec![w as i32],
                other: vec![-1],
                face: vec![-1],
                straight: vec![w == 0],
                curve: vec![-1],
                shallow: vec![w == 1],
                ..Walks::default()
            };
            out.push(edges, &vec![false; edges.len()], &about, 0);
        }
        out
    }

    #[test]
    fn merged_walks_are_sorted_by_part_and_the_first_ones_come_first() {
        let found = walks(&[(0, &[0, 1]), (2, &[2])]).merged(&walks(&[(0, &[3]), (1, &[4, 5]), (2, &[6])]));
        assert_eq!((found.part, found.edges), (vec![0, 0, 1, 2, 2], vec![0, 1, 3, 4, 5, 2, 6]));
        assert_eq!((found.offsets, found.index), (vec![0, 2, 3, 5, 6, 7], vec![0, 0, 1, 1, 2]));
        assert_eq!(found.straight, [true, true, false, false, false]);
        assert_eq!(found.shallow, [false, false, true, true, false]);
    }

    #[test]
    fn a_walk_that_loses_an_edge_goes_on_as_another() {
        let found = walks(&[(0, &[0, 1, 2]), (1, &[3]), (1, &[4, 5])]);
        let found = found.moved(&[7, -1, 6, -1, 5, 4], &[true, false, false, false, false, true]);
        assert_eq!((found.offsets, found.edges), (vec![0, 1, 2, 4], vec![7, 6, 5, 4]));
        assert_eq!((found.reversed, found.index), (vec![true, false, false, true], vec![0, 0, 2]));
    }

    #[test]
    fn an_edge_is_a_chord_of_the_last_walk_along_an_edge_of_the_source() {
        let mut walks = walks(&[(0, &[0, 1]), (0, &[2]), (0, &[1, 3])]);
        walks.index[1] = -1;
        assert_eq!(walks.along_source(5), [0, 2, -1, 2, -1]);
    }
}
