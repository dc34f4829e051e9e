//! The scan-line z-buffer: it holds one row of depths and only the polygons that cross that row.
//!
//! Two equivalent variants, with the same effort and the same picture:
//! - `PerPolygon`: an active list of polygons, each with its own active edges; crossings are paired polygon by polygon
//! - `Merged`: one list of all active edges by x, each with the number of its polygon. A pair is complete when the
//!   polygon's flag goes out again: with a concave polygon a and a second one b
//!
//! ```text
//!      crossing   1   2   3   4   5   6
//!      polygon    a   a   b   a   b   a       pairs 1-2, 3-5, 4-6
//! ```

use super::active_edges::ActiveEdges;
use super::canvas::{Canvas, Write};
use super::coverage::{edges_of, intervals};
use super::edge::{Edge, insertion_sort};
use super::edge_record::{Active, Depth};
use super::edge_table::EdgeTable;
use super::limits::Watch;
use super::polygon_table::{Along, PolygonTable, Toggle};
use super::screen::{NEAR_TIE, NONE, Screen};
use super::statistics::{Statistics, bytes_of};
use std::cmp::Ordering;
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lists {
    PerPolygon,
    Merged,
}

pub fn render(
    screen: &Screen,
    canvas: &mut Canvas,
    lists: Lists,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    match lists {
        Lists::PerPolygon => per_polygon(screen, canvas, watch, statistics),
        Lists::Merged => merged(screen, canvas, watch, statistics, &mut |_| {}),
    }
}

/// One row of depths and owners.
struct Row<'a> {
    screen: &'a Screen,
    depths: Vec<f64>,
    owners: Vec<u32>,
}

impl Row<'_> {
    fn new(screen: &Screen) -> Row<'_> {
        let width = screen.width as usize;
        Row { screen, depths: vec![f64::INFINITY; width], owners: vec![NONE; width] }
    }

    /// Fills the pixels from where a polygon is entered, with its depth there, to where it is left.
    fn fill(&mut self, number: u32, row: i64, along: Along, to: i64, canvas: &mut Canvas, statistics: &mut Statistics) {
        let (from, to) = (along.column, to.min(self.screen.width));
        if from >= to {
            return;
        }
        let facet = &self.screen.facets[number as usize];
        if let Some(patch) = self.screen.patch_of(facet) {
            let mut walk = patch.walk(from, row);
            self.span(number, row, from..to, |_| walk.step(), canvas, statistics);
        } else {
            self.span(number, row, from..to, |column| along.at(column), canvas, statistics);
        }
    }

    /// `depth` is called for each column, from left to right.
    #[inline(always)]
    fn span(
        &mut self,
        number: u32,
        row: i64,
        columns: Range<i64>,
        mut depth: impl FnMut(i64) -> f64,
        canvas: &mut Canvas,
        statistics: &mut Statistics,
    ) {
        statistics.spans += 1;
        statistics.comparisons += (columns.end - columns.start) as u64;
        let mut start = columns.start;
        for column in columns.clone() {
            let at = column as usize;
            let z = depth(column);
            let ahead = self.depths[at] - z;
            // A steep facet has no depth in floating point: then neither is certain.
            let (nearer, farther) = (ahead > NEAR_TIE, ahead < -NEAR_TIE);
            let won = nearer
                || (!farther
                    && (self.owners[at] == NONE
                        || self.screen.compare_exactly(number, self.owners[at], column, row, statistics)
                            == Ordering::Less));
            if won {
                (self.depths[at], self.owners[at]) = (z, number);
            } else {
                if start < column {
                    canvas.write(row, start, column, number, statistics);
                }
                start = column + 1;
            }
        }
        if start < columns.end {
            canvas.write(row, start, columns.end, number, statistics);
        }
    }

    fn clear(&mut self) {
        self.depths.fill(f64::INFINITY);
        self.owners.fill(NONE);
    }

    fn bytes(&self) -> usize {
        bytes_of(&self.depths) + bytes_of(&self.owners)
    }
}

fn per_polygon(screen: &Screen, canvas: &mut Canvas, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
    // Polygons sorted by first row; the next one to start is at the end.
    let mut waiting: Vec<u32> = (0..screen.facets.len() as u32).collect();
    waiting.sort_unstable_by_key(|&f| std::cmp::Reverse((screen.facets[f as usize].rows[0], f)));
    let mut active: Vec<ActivePolygon> = Vec::new();
    let mut buffer = Row::new(screen);
    for row in 0..screen.height {
        active.retain(|a| {
            let stays = i64::from(screen.facets[a.facet as usize].rows[1]) > row;
            statistics.edge_ends += if stays { 0 } else { a.edges.len() as u64 };
            stays
        });
        while let Some(facet) = waiting.pop_if(|f| i64::from(screen.facets[*f as usize].rows[0]) <= row) {
            active.push(ActivePolygon::new(screen, facet, row));
        }
        if active.is_empty() {
            if waiting.is_empty() {
                break;
            }
            continue;
        }
        buffer.clear();
        for a in &mut active {
            if watch.over() {
                return None;
            }
            a.enter(screen, row, statistics);
            statistics.swaps += insertion_sort(&mut a.edges);
            intervals(&a.edges, screen.rule, |left, right| {
                let along = screen.along(&left.edge, &left.carried, row);
                buffer.fill(a.facet, row, along, right.edge.column, canvas, statistics);
            });
            a.edges.iter_mut().for_each(Active::advance);
        }
        let edges: usize = active.iter().map(|a| bytes_of(&a.edges) + bytes_of(&a.waiting)).sum();
        statistics.holds(buffer.bytes() + bytes_of(&waiting) + bytes_of(&active) + edges + canvas.bytes());
    }
    // Edges that reach the last row end there.
    statistics.edge_ends += active.iter().map(|a| a.edges.len() as u64).sum::<u64>();
    Some(())
}

/// A polygon that crosses the row, with its edges.
struct ActivePolygon {
    facet: u32,
    edges: Vec<Active<Depth>>,
    waiting: Vec<(i32, Edge)>,
}

impl ActivePolygon {
    fn new(screen: &Screen, facet: u32, row: i64) -> ActivePolygon {
        let mut waiting = Vec::new();
        edges_of(screen, facet, row as i32, screen.height as i32, |start, edge| waiting.push((start, edge)));
        waiting.sort_unstable_by_key(|&(start, _)| std::cmp::Reverse(start));
        ActivePolygon { facet, edges: Vec::new(), waiting }
    }

    fn enter(&mut self, screen: &Screen, row: i64, statistics: &mut Statistics) {
        let before = self.edges.len();
        self.edges.retain(|e| i64::from(e.edge.end) > row);
        statistics.edge_ends += (before - self.edges.len()) as u64;
        while let Some((_, edge)) = self.waiting.pop_if(|(start, _)| i64::from(*start) <= row) {
            self.edges.push(Active::new(screen, &edge, row));
            statistics.edge_starts += 1;
        }
    }
}

/// `paired` gets every pair of crossings, in the order in which pairs are completed.
pub fn merged(
    screen: &Screen,
    canvas: &mut Canvas,
    watch: &Watch,
    statistics: &mut Statistics,
    paired: &mut dyn FnMut(Write),
) -> Option<()> {
    let table = EdgeTable::new(screen, watch)?;
    let mut active = ActiveEdges::<Depth>::new(screen, &table);
    let mut polygons = PolygonTable::new(screen.rule, screen.facets.len());
    let mut entered = vec![Along::UNKNOWN; screen.facets.len()];
    let mut buffer = Row::new(screen);
    while let Some(row) = active.next_row(statistics) {
        buffer.clear();
        for e in &active.edges {
            if watch.over() {
                return None;
            }
            let Active { edge, carried } = e;
            let f = edge.facet as usize;
            match polygons.cross(edge.facet, edge.winding) {
                Toggle::Entered => entered[f] = screen.along(edge, carried, row),
                Toggle::Left if entered[f].column < edge.column => {
                    let (from, to) = (entered[f].column as u32, edge.column as u32);
                    paired(Write { row: row as u32, from, to, facet: edge.facet });
                    buffer.fill(edge.facet, row, entered[f], edge.column, canvas, statistics);
                }
                _ => {}
            }
        }
        let edges = table.bytes() + bytes_of(&active.edges) + polygons.bytes() + bytes_of(&entered);
        statistics.holds(buffer.bytes() + edges + canvas.bytes());
    }
    Some(())
}
