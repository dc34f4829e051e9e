//! The active edge list: the edges that cross the current row, by x.
//!
//! 1. edges that end leave before the row is drawn
//! 2. the bucket of edges that start is merged in: both are sorted
//! 3. x of each edge goes on by 1 / m; where edges cross, the list is nearly sorted, and insertion sort repairs it at
//!    the cost of one swap per crossing
//!
//! The list changes only where an edge starts, where one ends and where two cross: these events are counted.
//!
//! The scan ends when the active list and the edge table are both empty; across a gap between rows it goes on at the
//! next edge.

use super::edge::{Edge, insertion_sort};
use super::edge_record::{Active, Carried};
use super::edge_table::EdgeTable;
use super::screen::Screen;
use super::statistics::{Statistics, bytes_of};

pub struct ActiveEdges<'a, C> {
    screen: &'a Screen,
    table: &'a EdgeTable,
    pub edges: Vec<Active<C>>,
    merged: Vec<Active<C>>,
    row: i64,
}

impl<'a, C: Carried> ActiveEdges<'a, C> {
    pub fn new(screen: &'a Screen, table: &'a EdgeTable) -> ActiveEdges<'a, C> {
        ActiveEdges { screen, table, edges: Vec::new(), merged: Vec::new(), row: -1 }
    }

    /// Goes on to the next row with edges; None where there is none left.
    pub fn next_row(&mut self, statistics: &mut Statistics) -> Option<i64> {
        self.row += 1;
        let row = self.row as i32;
        let before = self.edges.len();
        self.edges.retain(|e| e.edge.end > row);
        statistics.edge_ends += (before - self.edges.len()) as u64;
        if self.edges.is_empty() {
            self.row = self.table.next_start(self.row)?;
        }
        self.edges.iter_mut().for_each(Active::advance);
        statistics.swaps += insertion_sort(&mut self.edges);
        let starting = self.table.starting(self.row);
        statistics.edge_starts += starting.len() as u64;
        self.merge(starting);
        statistics.holds(self.table.bytes() + bytes_of(&self.edges) + bytes_of(&self.merged));
        Some(self.row)
    }

    fn merge(&mut self, starting: &[Edge]) {
        if starting.is_empty() {
            return;
        }
        self.merged.clear();
        let mut old = self.edges.iter().copied().peekable();
        for new in starting {
            while let Some(e) = old.next_if(|e| e.edge.column <= new.column) {
                self.merged.push(e);
            }
            self.merged.push(Active::new(self.screen, new, self.row));
        }
        self.merged.extend(old);
        std::mem::swap(&mut self.edges, &mut self.merged);
    }
}
