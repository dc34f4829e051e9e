//! Finds edges that are certainly hidden before any exact test: N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer
//! visibility", SIGGRAPH 1993, made conservative and limited to whole cells.
//!
//! 1. The image is divided into square cells. A group covers a cell wholly if it covers its middle and none of its
//!    contours enters the cell: the number of polygons that cover a place changes only at contours. So no polygon is
//!    examined: along a row, the contours that cross the line through the cells' middles tell what is covered.
//! 2. A cell keeps the depth of the nearest group that covers it wholly: behind the group's farthest polygon, all is
//!    hidden.
//! 3. Each level of the pyramid keeps the farther depth of two by two cells below.
//! 4. A drawn edge that lies behind all cells that it touches by more than any contact tolerance is hidden from end to
//!    end: the exact pass would give the same result, and is skipped.
//!
//! ```text
//!    . . . . . .       # wholly covered    + entered by a contour       the edge - - lies in # only, and behind:
//!    . + + + + .                                                        hidden;  ---- leaves it: for the exact pass
//!    . + # #-+--
//!    . + # # + .
//!    . + + + + .
//! ```
//!
//! It departs from the paper in two ways. It stores groups instead of polygons, most of which are smaller than a cell.
//! It discards only drawn edges: the contours and polygons that other edges are compared with must stay complete.

use std::sync::atomic::{AtomicI32, Ordering};

use rayon::prelude::*;

use super::bands::{clipped_x, y_range};
use super::edge_table::Contour;
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use hlr_exact::Point;

/// Width in cells of a group of median size. With fewer, groups rarely cover a cell wholly; more cost more than they
/// save.
const CELLS_A_GROUP: f64 = 8.0;
const LEAST_CELLS: f64 = 64.0;
const MOST_CELLS: f64 = 2048.0;

pub struct DepthPyramid {
    x0: i64,
    y0: i64,
    shift: u32,
    /// Per level: cells per row, and rows. Level 0 is the finest.
    sizes: Vec<[usize; 2]>,
    levels: Vec<Vec<i32>>,
    /// Added to a group's depth; larger than any contact tolerance.
    margin: i64,
    /// Parts that cover at least one cell wholly.
    pub groups: usize,
}

/// The cells that a group's contours may reach.
struct Window {
    column: usize,
    row: usize,
    columns: usize,
    rows: usize,
}

impl DepthPyramid {
    pub fn new(mesh: &Mesh, table: &PolygonTable, contours: &[Contour]) -> DepthPyramid {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for p in &mesh.points {
            for k in [0, 1] {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        let low = if mesh.points.is_empty() { [0, 0] } else { low };
        let size = [0, 1].map(|k| (i64::from(high[k]) - i64::from(low[k])).max(0) + 1);
        let side = size[0].max(size[1]);
        let wanted = (CELLS_A_GROUP * (mesh.groups.len() as f64).sqrt()).clamp(LEAST_CELLS, MOST_CELLS);
        let mut shift = 1;
        while (side >> shift) as f64 >= wanted {
            shift += 1;
        }
        let cells = size.map(|s| (s >> shift) as usize + 1);
        let mut out = DepthPyramid {
            x0: i64::from(low[0]),
            y0: i64::from(low[1]),
            shift,
            sizes: vec![cells],
            levels: Vec::new(),
            margin: mesh.groups.iter().map(|p| p.delta).max().unwrap_or(0),
            groups: 0,
        };
        let (nearest, groups) = out.nearest(mesh, table, contours);
        out.levels.push(nearest);
        out.groups = groups;
        out.raise();
        out
    }

    /// Steps 1 and 2: the depths of the finest level, and how many groups cover at least one cell.
    fn nearest(&self, mesh: &Mesh, table: &PolygonTable, contours: &[Contour]) -> (Vec<i32>, usize) {
        let mut first = vec![0u32; mesh.groups.len() + 1];
        for c in contours {
            first[mesh.edge_group[c.edge as usize] as usize + 1] += 1;
        }
        for p in 0..mesh.groups.len() {
            first[p + 1] += first[p];
        }
        let mut at = first.clone();
        let mut own = vec![Contour { edge: 0, jump: 0 }; contours.len()];
        for c in contours {
            let slot = &mut at[mesh.edge_group[c.edge as usize] as usize];
            own[*slot as usize] = *c;
            *slot += 1;
        }
        let [columns, rows] = self.sizes[0];
        let cells: Vec<AtomicI32> = (0..columns * rows).map(|_| AtomicI32::new(i32::MAX)).collect();
        let groups = (0..mesh.groups.len())
            .into_par_iter()
            .filter(|&p| {
                let own = &own[first[p] as usize..first[p + 1] as usize];
                let mut covers = false;
                self.covered(mesh, own, |cell| {
                    cells[cell].fetch_min(table.extents[p].farthest, Ordering::Relaxed);
                    covers = true;
                });
                covers
            })
            .count();
        (cells.into_iter().map(AtomicI32::into_inner).collect(), groups)
    }

    /// Calls `visit` for every cell that the polygons within these contours, all of one group, cover wholly.
    fn covered(&self, mesh: &Mesh, contours: &[Contour], mut visit: impl FnMut(usize)) {
        let Some(window) = self.window(mesh, contours) else { return };
        // Per cell: the change of the count where the middle line of the row enters it, and whether a contour enters
        // it.
        let mut change = vec![0i32; window.columns * window.rows];
        let mut entered = vec![false; window.columns * window.rows];
        for c in contours {
            let (a, b) = mesh.ends(c.edge as usize);
            let (lower, upper) = y_range(a, b);
            for row in self.row(lower)..=self.row(upper) {
                let (from, to) = self.columns(a, b, row);
                let line = (row - window.row) * window.columns;
                entered[line + from - window.column..=line + to - window.column].fill(true);
                let middle = self.y0 + ((row as i64) << self.shift) + (1i64 << (self.shift - 1));
                if i64::from(lower) <= middle && middle < i64::from(upper) {
                    // The change from left to right: what lies left of the upward contour was covered so far.
                    let jump = if a[1] < b[1] { -c.jump } else { c.jump };
                    change[line + from - window.column] += jump;
                }
            }
        }
        for row in 0..window.rows {
            let mut count = 0;
            for column in 0..window.columns {
                let k = row * window.columns + column;
                count += change[k];
                if count > 0 && !entered[k] {
                    visit((window.row + row) * self.sizes[0][0] + window.column + column);
                }
            }
        }
    }

    fn window(&self, mesh: &Mesh, contours: &[Contour]) -> Option<Window> {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for c in contours {
            let (a, b) = mesh.ends(c.edge as usize);
            for k in [0, 1] {
                low[k] = low[k].min(a[k]).min(b[k]);
                high[k] = high[k].max(a[k]).max(b[k]);
            }
        }
        if low[0] > high[0] {
            return None;
        }
        let (column, row) = (self.column(low[0]), self.row(low[1]));
        let out = Window { column, row, columns: self.column(high[0]) - column + 1, rows: self.row(high[1]) - row + 1 };
        // With fewer than three cells per side, contours enter all of them.
        (out.columns > 2 && out.rows > 2).then_some(out)
    }

    /// Step 3: builds the coarser levels, up to one cell.
    fn raise(&mut self) {
        while let (Some(&[columns, rows]), Some(below)) = (self.sizes.last(), self.levels.last()) {
            if columns * rows <= 1 {
                return;
            }
            let size = [columns.div_ceil(2), rows.div_ceil(2)];
            let mut level = vec![i32::MIN; size[0] * size[1]];
            for (k, &depth) in below.iter().enumerate() {
                let cell = &mut level[(k / columns / 2) * size[0] + k % columns / 2];
                *cell = depth.max(*cell);
            }
            self.sizes.push(size);
            self.levels.push(level);
        }
    }

    /// Step 4: whether the edge a -> b is hidden from end to end. True only where that is certain.
    pub fn hides(&self, a: &Point, b: &Point) -> bool {
        let depth = i64::from(a[2].min(b[2])) - self.margin;
        let behind = |cell: i32| cell != i32::MAX && depth > i64::from(cell);
        let (lower, upper) = y_range(a, b);
        let (rows, columns) =
            ((self.row(lower), self.row(upper)), (self.column(a[0].min(b[0])), self.column(a[0].max(b[0]))));
        // The level on which the edge's box is two cells wide at most.
        let mut level = 0;
        while level + 1 < self.levels.len()
            && ((rows.1 >> level) - (rows.0 >> level) > 1 || (columns.1 >> level) - (columns.0 >> level) > 1)
        {
            level += 1;
        }
        let all = (rows.0 >> level..=rows.1 >> level).all(|row| {
            (columns.0 >> level..=columns.1 >> level)
                .all(|column| behind(self.levels[level][row * self.sizes[level][0] + column]))
        });
        all || (level > 0
            && (rows.0..=rows.1).all(|row| {
                let (from, to) = self.columns(a, b, row);
                let line = row * self.sizes[0][0];
                self.levels[0][line + from..=line + to].iter().all(|&cell| behind(cell))
            }))
    }

    fn column(&self, x: i32) -> usize {
        ((i64::from(x) - self.x0) >> self.shift).clamp(0, self.sizes[0][0] as i64 - 1) as usize
    }

    fn row(&self, y: i32) -> usize {
        ((i64::from(y) - self.y0) >> self.shift).clamp(0, self.sizes[0][1] as i64 - 1) as usize
    }

    /// The first and the last cell of a row that a -> b may touch.
    fn columns(&self, a: &Point, b: &Point, row: usize) -> (usize, usize) {
        let low = self.y0 + ((row as i64) << self.shift);
        let (from, to) = clipped_x(a, b, low, low + (1i64 << self.shift));
        (self.column(from), self.column(to))
    }
}
