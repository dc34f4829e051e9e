//! The scan-line method with edge table, active edge list and polygon table: no depth buffer at all.
//!
//! C. Wylie, G. Romney, D. Evans, A. Erdahl, "Half-tone perspective drawings by computer", 1967; W. Bouknight, 1970;
//! G. Watkins, "A real time visible surface algorithm", 1970.
//!
//! 1. row by row, take the active edges by x
//! 2. between neighbouring crossings the same polygons are in:  none: background;  one: that one, no depth is computed;
//!    more: the nearest
//! 3. where polygons may pass through one another, the nearest at both ends of the span is sought. The same at both is
//!    nearest throughout, for depth is linear; else the span is split at the pixel where they cross, found in integers:
//!
//! ```text
//!    z |  A .               . B        left end: A, right end: B
//!      |      .  .     .  .            [from, m) is asked again, and [m, to)
//!      |           . X .
//!      |      .  .     .  .
//!      +------------|--------- x
//!                   m
//! ```
//!
//! With a curved patch (`patch`) depth is not linear: where one is in together with others, each pixel is compared.
//!
//! Where polygons do not pass through one another, fewer comparisons are enough (`Coherence`).

use super::active_edges::ActiveEdges;
use super::canvas::Canvas;
use super::edge_record::{Active, Depth};
use super::edge_table::EdgeTable;
use super::limits::Watch;
use super::patch::Walk;
use super::polygon_table::{PolygonTable, Toggle};
use super::screen::{NEAR_TIE, NONE, Screen};
use super::statistics::Statistics;
use std::cmp::Ordering;

/// Which depths are compared. All but the first assume that no polygon passes through another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coherence {
    /// At both ends of each span, all polygons that are in: right for interpenetrating polygons as well.
    BothEnds,
    /// In each span, all polygons that are in.
    Naive,
    /// The same, but no comparison where an obscured polygon has been left.
    Leaving,
    /// Only the visible polygon and the one that is entered; all only where the visible one has been left.
    Visible,
}

pub fn render(
    screen: &Screen,
    canvas: &mut Canvas,
    coherence: Coherence,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    let table = EdgeTable::new(screen, watch)?;
    let mut active = ActiveEdges::<Depth>::new(screen, &table);
    let mut polygons = PolygonTable::new(screen.rule, screen.facets.len());
    while let Some(row) = active.next_row(statistics) {
        let mut scan = Scan { screen, canvas, polygons: &mut polygons, coherence, row, visible: NONE };
        scan.row(&active, watch, statistics)?;
        statistics
            .holds(table.bytes() + polygons.bytes() + super::statistics::bytes_of(&active.edges) + canvas.bytes());
    }
    Some(())
}

struct Scan<'a> {
    screen: &'a Screen,
    canvas: &'a mut Canvas,
    polygons: &'a mut PolygonTable,
    coherence: Coherence,
    row: i64,
    /// The polygon visible in the span before, or NONE.
    visible: u32,
}

impl Scan<'_> {
    fn row(&mut self, active: &ActiveEdges<Depth>, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
        let edges = &active.edges;
        let mut k = 0;
        while k < edges.len() {
            if watch.over() {
                return None;
            }
            let column = edges[k].edge.column;
            let known = self.visible;
            while k < edges.len() && edges[k].edge.column == column {
                let Active { edge, carried } = &edges[k];
                let (screen, row) = (self.screen, self.row);
                let toggle = self.polygons.cross_at(edge.facet, edge.winding, || screen.along(edge, carried, row));
                self.crossed(toggle, edge.facet, column, statistics);
                k += 1;
            }
            let Some(next) = edges.get(k) else { break };
            let (from, to) = (column.max(0), next.edge.column.min(self.screen.width));
            if from >= to {
                continue;
            }
            match (self.polygons.inside.len(), self.coherence) {
                (0, _) => {
                    self.visible = NONE;
                    continue;
                }
                (1, _) => self.visible = self.polygons.inside[0],
                _ if self.is_curved() => {
                    self.curved(from, to, watch, statistics)?;
                    continue;
                }
                (_, Coherence::BothEnds) => {
                    self.span(from, to, watch, statistics)?;
                    continue;
                }
                (_, Coherence::Naive) => self.visible = self.nearest(from, statistics),
                // No polygon was entered, and the visible one is still in: nothing to compare.
                (_, Coherence::Leaving) if self.visible == known && known != NONE => {}
                (_, Coherence::Leaving) => self.visible = self.nearest(from, statistics),
                (_, Coherence::Visible) => {
                    if self.visible == NONE {
                        self.visible = self.nearest(from, statistics);
                    }
                }
            }
            statistics.spans += 1;
            self.canvas.write(self.row, from, to, self.visible, statistics);
        }
        // A row starts with no visible polygon.
        self.visible = NONE;
        Some(())
    }

    /// Updates what is known to be visible for an edge at `column`.
    fn crossed(&mut self, toggle: Toggle, facet: u32, column: i64, statistics: &mut Statistics) {
        match (self.coherence, toggle) {
            (Coherence::Leaving, Toggle::Entered) => self.visible = NONE,
            (Coherence::Leaving | Coherence::Visible, Toggle::Left) if facet == self.visible => self.visible = NONE,
            (Coherence::Visible, Toggle::Entered) => {
                if self.polygons.inside.len() == 1 {
                    self.visible = facet;
                } else if self.visible != NONE {
                    let at = column.clamp(0, self.screen.width - 1);
                    if self.screen.compare(facet, self.visible, at, self.row, statistics) == Ordering::Less {
                        self.visible = facet;
                    }
                }
            }
            _ => {}
        }
    }

    /// The nearest of the polygons that are in: by the depths of the edge records where these are certain.
    fn nearest(&self, column: i64, statistics: &mut Statistics) -> u32 {
        let inside = &self.polygons.inside;
        let (mut best, mut depth) = (inside[0], self.polygons.depth(0, column));
        for (k, &f) in inside.iter().enumerate().skip(1) {
            statistics.comparisons += 1;
            let z = self.polygons.depth(k, column);
            // The depth of a steep polygon is NaN: then neither is certain.
            let (nearer, farther) = (depth - z > NEAR_TIE, z - depth > NEAR_TIE);
            let mut exactly = || self.screen.compare_exactly(f, best, column, self.row, statistics) == Ordering::Less;
            if nearer || (!farther && exactly()) {
                (best, depth) = (f, z);
            }
        }
        best
    }

    /// Whether a curved patch is among the polygons that are in.
    fn is_curved(&self) -> bool {
        let facets = &self.screen.facets;
        !self.screen.patches.is_empty() && self.polygons.inside.iter().any(|&f| facets[f as usize].patch != NONE)
    }

    /// Fills the span [from, to) with a patch in it pixel by pixel, since a patch may pass through others any number of
    /// times. Each depth follows from the one before.
    fn curved(&mut self, from: i64, to: i64, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
        let (screen, row) = (self.screen, self.row);
        let inside = &self.polygons.inside;
        let mut walks: Vec<Option<Walk>> =
            inside.iter().map(|&f| screen.patch_of(&screen.facets[f as usize]).map(|p| p.walk(from, row))).collect();
        let (mut start, mut shown) = (from, NONE);
        for column in from..to {
            if watch.over() {
                return None;
            }
            let (mut best, mut depth) = (NONE, f64::INFINITY);
            for (k, (&f, walk)) in inside.iter().zip(&mut walks).enumerate() {
                let z = walk.as_mut().map_or_else(|| self.polygons.depth(k, column), Walk::step);
                if best == NONE {
                    (best, depth) = (f, z);
                    continue;
                }
                statistics.comparisons += 1;
                let (nearer, farther) = (depth - z > NEAR_TIE, z - depth > NEAR_TIE);
                let mut exactly = || screen.compare_exactly(f, best, column, row, statistics) == Ordering::Less;
                if nearer || (!farther && exactly()) {
                    (best, depth) = (f, z);
                }
            }
            if best != shown {
                if start < column {
                    statistics.spans += 1;
                    self.canvas.write(row, start, column, shown, statistics);
                }
                statistics.splits += u64::from(shown != NONE);
                (start, shown) = (column, best);
            }
        }
        statistics.spans += 1;
        self.canvas.write(row, start, to, shown, statistics);
        self.visible = shown;
        Some(())
    }

    /// Fills the span [from, to), split where polygons cross.
    fn span(&mut self, from: i64, to: i64, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
        let left = self.nearest(from, statistics);
        let right = if to - from == 1 { left } else { self.nearest(to - 1, statistics) };
        self.between(from, left, to, right, watch, statistics)
    }

    fn between(
        &mut self,
        from: i64,
        left: u32,
        to: i64,
        right: u32,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        if watch.over() {
            return None;
        }
        if left == right {
            statistics.spans += 1;
            self.canvas.write(self.row, from, to, left, statistics);
            self.visible = left;
            return Some(());
        }
        statistics.splits += 1;
        let m = self.screen.takes_over(left, right, from, self.row).clamp(from + 1, to - 1);
        let before = if m - from == 1 { left } else { self.nearest(m - 1, statistics) };
        self.between(from, left, m, before, watch, statistics)?;
        let after = if to - m == 1 { right } else { self.nearest(m, statistics) };
        self.between(m, after, to, right, watch, statistics)
    }
}
