//! The edge table: all edges that cross a row, bucket-sorted by the first row they cover; within a bucket by x, then
//! dx.
//!
//! Horizontal edges are not in it. An entry (`coverage::Edge`) holds x and dx = 1 / m as whole columns and remainders,
//! the row where it ends and the polygon it belongs to; z and dz, colour and its step join it when it becomes active
//! (`edge_record`). Edges are entered once, before the first row: where the list of active edges changes at vertices is
//! known from then on.

use super::coverage::edges_of;
use super::edge::Edge;
use super::limits::Watch;
use super::screen::Screen;
use super::statistics::bytes_of;

pub struct EdgeTable {
    edges: Vec<Edge>,
    /// Bucket of row y: edges[first[y]..first[y + 1]].
    first: Vec<u32>,
}

impl EdgeTable {
    /// The table of all facets; None where time ran out.
    pub fn new(screen: &Screen, watch: &Watch) -> Option<EdgeTable> {
        EdgeTable::of(screen, |_| true, watch)
    }

    /// The edges of some of the facets only.
    pub fn of(screen: &Screen, wanted: impl Fn(u32) -> bool, watch: &Watch) -> Option<EdgeTable> {
        let height = screen.height as i32;
        let mut entries: Vec<(i32, Edge)> = Vec::new();
        for number in (0..screen.facets.len() as u32).filter(|&f| wanted(f)) {
            if watch.over() {
                return None;
            }
            edges_of(screen, number, 0, height, |row, edge| entries.push((row, edge)));
        }
        entries.sort_unstable_by(|(r, e), (s, f)| {
            (r, e.column)
                .cmp(&(s, f.column))
                .then(e.slope().total_cmp(&f.slope()))
                .then((e.facet, e.number).cmp(&(f.facet, f.number)))
        });
        let mut first = vec![0u32; height as usize + 1];
        for (row, _) in &entries {
            first[*row as usize + 1] += 1;
        }
        for y in 0..height as usize {
            first[y + 1] += first[y];
        }
        Some(EdgeTable { edges: entries.into_iter().map(|(_, e)| e).collect(), first })
    }

    pub fn starting(&self, row: i64) -> &[Edge] {
        &self.edges[self.first[row as usize] as usize..self.first[row as usize + 1] as usize]
    }

    /// The first row from `row` on in which an edge starts: the scan goes on after a gap in y.
    pub fn next_start(&self, row: i64) -> Option<i64> {
        let rows = self.first.len() as i64 - 1;
        (row..rows).find(|&y| self.first[y as usize] < self.first[y as usize + 1])
    }

    pub fn bytes(&self) -> usize {
        bytes_of(&self.edges) + bytes_of(&self.first)
    }
}
