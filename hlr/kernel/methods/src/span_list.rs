//! The active span list: the spans of a row in the order of depth. No depth buffer, and nothing is compared twice.
//!
//! The scan-line idea one dimension lower: in a row each polygon is a segment in (x, z). Along x there are three kinds
//! of events; the first span in the list is visible.
//!
//! ```text
//!    z |   b-------.--------b         start   the span takes its place in the order
//!      |     c----X---c               crossing of neighbours: they change places
//!      |         . a                  end     it leaves; its neighbours are new to one another
//!      |   a--.
//!      +----------------------- x
//!        a first, then a before c, then c before a
//! ```
//!
//! Only neighbours can cross (Bentley and Ottmann 1979); columns are whole numbers, and a crossing is the first column
//! in which the farther of two neighbours is the nearer one. In one column ends come first, then crossings, then
//! starts.

use super::active_edges::ActiveEdges;
use super::canvas::Canvas;
use super::edge_record::Active;
use super::edge_table::EdgeTable;
use super::limits::Watch;
use super::polygon_table::{PolygonTable, Toggle};
use super::screen::Screen;
use super::statistics::{Statistics, bytes_of};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Column, and the two facets that change places there, the nearer one first.
type Crossing = (i64, u32, u32);

pub fn render(screen: &Screen, canvas: &mut Canvas, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
    let table = EdgeTable::new(screen, watch)?;
    let mut active = ActiveEdges::<()>::new(screen, &table);
    let mut polygons = PolygonTable::new(screen.rule, screen.facets.len());
    let mut row_of_spans = Spans { screen, row: 0, order: Vec::new(), crossings: BinaryHeap::new() };
    while let Some(row) = active.next_row(statistics) {
        row_of_spans.row = row;
        row_of_spans.run(&active, &mut polygons, canvas, watch, statistics)?;
        let spans = bytes_of(&row_of_spans.order) + row_of_spans.crossings.len() * size_of::<Crossing>();
        statistics.holds(table.bytes() + polygons.bytes() + bytes_of(&active.edges) + spans + canvas.bytes());
    }
    Some(())
}

struct Spans<'a> {
    screen: &'a Screen,
    row: i64,
    /// Nearest first.
    order: Vec<u32>,
    crossings: BinaryHeap<Reverse<Crossing>>,
}

impl Spans<'_> {
    fn run(
        &mut self,
        active: &ActiveEdges<()>,
        polygons: &mut PolygonTable,
        canvas: &mut Canvas,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        let edges = &active.edges;
        let width = self.screen.width;
        let within = |e: &Active<()>| e.edge.column.clamp(0, width);
        let (mut started, mut k) = (Vec::new(), 0);
        let mut seen_from = 0;
        self.order.clear();
        self.crossings.clear();
        while k < edges.len() {
            if watch.over() {
                return None;
            }
            // The next event: this edge, or a crossing before it.
            let edge = within(&edges[k]);
            let crossing = self.crossings.peek().map_or(i64::MAX, |c| c.0.0);
            let column = edge.min(crossing);
            self.show(seen_from, column, canvas, statistics);
            seen_from = column;
            started.clear();
            while k < edges.len() && within(&edges[k]) == column {
                let f = edges[k].edge.facet;
                // A polygon left and entered in one column keeps its place.
                match polygons.cross(f, edges[k].edge.winding) {
                    Toggle::Entered => started.push(f),
                    Toggle::Left if started.last() == Some(&f) => {
                        started.pop();
                    }
                    Toggle::Left if started.contains(&f) => started.retain(|&s| s != f),
                    Toggle::Left => self.end(f, column, statistics),
                    Toggle::Nothing => {}
                }
                k += 1;
            }
            self.cross(column, watch, statistics)?;
            // Beyond the frame the order does not matter.
            for &f in started.iter().filter(|_| column < self.screen.width) {
                self.start(f, column, statistics);
            }
        }
        Some(())
    }

    /// Writes the nearest span to [from, to).
    fn show(&self, from: i64, to: i64, canvas: &mut Canvas, statistics: &mut Statistics) {
        let (from, to) = (from.max(0), to.min(self.screen.width));
        if let (Some(&f), true) = (self.order.first(), from < to) {
            statistics.spans += 1;
            canvas.write(self.row, from, to, f, statistics);
        }
    }

    fn end(&mut self, facet: u32, column: i64, statistics: &mut Statistics) {
        let Some(at) = self.order.iter().position(|&f| f == facet) else { return };
        self.order.remove(at);
        statistics.span_ends += 1;
        if at > 0 {
            self.meet(at - 1, column);
        }
    }

    fn start(&mut self, facet: u32, column: i64, statistics: &mut Statistics) {
        statistics.span_starts += 1;
        let (screen, row) = (self.screen, self.row);
        let before = |&f: &u32| screen.compare(f, facet, column, row, statistics) == Ordering::Less;
        let at = self.order.partition_point(before);
        self.order.insert(at, facet);
        self.meet(at, column);
        if at > 0 {
            self.meet(at - 1, column);
        }
    }

    /// Schedules the crossing of the spans at places `at` and `at` + 1, if they have one from `column` on.
    fn meet(&mut self, at: usize, column: i64) {
        let (Some(&f), Some(&g)) = (self.order.get(at), self.order.get(at + 1)) else { return };
        // Searched from one column before: after an end, or another crossing in this column, they may have to change at
        // once.
        let there = self.screen.takes_over(f, g, column - 1, self.row);
        if there < self.screen.width {
            self.crossings.push(Reverse((there, f, g)));
        }
    }

    /// Carries out all crossings at `column`.
    fn cross(&mut self, column: i64, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
        while let Some(Reverse((_, f, g))) = self.crossings.peek().copied().filter(|c| c.0.0 <= column) {
            if watch.over() {
                return None;
            }
            self.crossings.pop();
            let Some(at) = self.order.windows(2).position(|pair| pair == [f, g]) else { continue };
            self.order.swap(at, at + 1);
            statistics.swaps += 1;
            self.meet(at + 1, column);
            if at > 0 {
                self.meet(at - 1, column);
            }
        }
        Some(())
    }
}
