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
//! 5. A group of which all lies so is left out wherever polygons or contours are compared with drawn edges: what is
//!    behind it is, by more than any contact tolerance, behind the group that covers the cell too. That one is never left
//!    out itself, for its farthest depth is that of the cell.
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
//! And of what other edges are compared with it discards whole groups only: the contours and polygons of a group must
//! stay complete, or counts would not agree.

use std::ops::Range;
use std::sync::atomic::{AtomicI32, Ordering};

use rayon::prelude::*;

use super::bands::{Slanted, y_range};
use super::edge_table::Contour;
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use crate::boxes::aabb::Aabb;
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
    /// Per group, whether all of it is certainly hidden.
    pub hidden: Vec<bool>,
}

/// The cells that a group's contours may reach.
struct Window {
    column: usize,
    row: usize,
    columns: usize,
    rows: usize,
}

/// Contours by their group.
struct ByGroup {
    first: Vec<u32>,
    contours: Vec<Contour>,
}

impl ByGroup {
    fn new(mesh: &Mesh, all: &[Contour]) -> ByGroup {
        let mut first = vec![0u32; mesh.groups.len() + 1];
        for c in all {
            first[mesh.edge_group[c.edge as usize] as usize + 1] += 1;
        }
        for p in 0..mesh.groups.len() {
            first[p + 1] += first[p];
        }
        let mut at = first.clone();
        let mut contours = vec![Contour { edge: 0, jump: 0 }; all.len()];
        for c in all {
            let slot = &mut at[mesh.edge_group[c.edge as usize] as usize];
            contours[*slot as usize] = *c;
            *slot += 1;
        }
        ByGroup { first, contours }
    }

    fn of(&self, group: usize) -> &[Contour] {
        &self.contours[self.first[group] as usize..self.first[group + 1] as usize]
    }
}

/// Whether a cell is covered before a depth.
fn is_before(cell: i32, depth: i64) -> bool {
    cell != i32::MAX && depth > i64::from(cell)
}

impl DepthPyramid {
    pub fn new(mesh: &Mesh, table: &PolygonTable, contours: &[Contour]) -> DepthPyramid {
        let around =
            |points: &[Point]| points.iter().fold(Aabb::EMPTY, |all, p| all.union(&Aabb { low: *p, high: *p }));
        let all = mesh.points.par_chunks(1 << 14).map(around).reduce(|| Aabb::EMPTY, |a, b| a.union(&b));
        let ([low @ .., _], [high @ .., _]) = (all.low, all.high);
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
            hidden: Vec::new(),
        };
        let own = ByGroup::new(mesh, contours);
        let (nearest, groups) = out.nearest(mesh, table, &own);
        out.levels.push(nearest);
        out.groups = groups;
        out.raise();
        let all = (0..mesh.groups.len()).into_par_iter().with_min_len(64);
        out.hidden = all.map(|p| out.hides_all(mesh, own.of(p), table.extents[p].bounds.low[2])).collect();
        out
    }

    /// Steps 1 and 2: the depths of the finest level, and how many groups cover at least one cell.
    fn nearest(&self, mesh: &Mesh, table: &PolygonTable, own: &ByGroup) -> (Vec<i32>, usize) {
        let [columns, rows] = self.sizes[0];
        let cells: Vec<AtomicI32> = (0..columns * rows).map(|_| AtomicI32::new(i32::MAX)).collect();
        let groups = (0..mesh.groups.len())
            .into_par_iter()
            .filter(|&p| {
                let mut covers = false;
                let farthest = table.extents[p].farthest;
                self.covered(mesh, own.of(p), |cell| {
                    // Few lie before all that came earlier; only these need the cell for themselves.
                    if cells[cell].load(Ordering::Relaxed) > farthest {
                        cells[cell].fetch_min(farthest, Ordering::Relaxed);
                    }
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
            for (row, from, to) in self.cells(a, b) {
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
                .all(|column| is_before(self.levels[level][row * self.sizes[level][0] + column], depth))
        });
        all || (level > 0 && self.cells(a, b).all(|(row, from, to)| self.all_before(row, from, to, depth)))
    }

    /// Step 5: whether the polygons within these contours, all of one group, are hidden. True only where that is certain.
    /// nearest: depth of the group's nearest corner.
    fn hides_all(&self, mesh: &Mesh, contours: &[Contour], nearest: i32) -> bool {
        let Some(rows) = self.rows(mesh, contours) else { return false };
        let depth = i64::from(nearest) - self.margin;
        // Per row the cells from the first to the last that contours enter.
        let mut spans = vec![(usize::MAX, 0); rows.len()];
        for c in contours {
            let (a, b) = mesh.ends(c.edge as usize);
            for (row, from, to) in self.cells(a, b) {
                if !self.all_before(row, from, to, depth) {
                    return false;
                }
                let span = &mut spans[row - rows.start];
                *span = (span.0.min(from), span.1.max(to));
            }
        }
        rows.zip(spans).all(|(row, (from, to))| self.all_before(row, from, to, depth))
    }

    /// Whether all these cells are covered before a depth.
    fn all_before(&self, row: usize, from: usize, to: usize, depth: i64) -> bool {
        let line = row * self.sizes[0][0];
        self.levels[0][line + from..=line + to].iter().all(|&cell| is_before(cell, depth))
    }

    /// The rows that contours reach; None without contours.
    fn rows(&self, mesh: &Mesh, contours: &[Contour]) -> Option<Range<usize>> {
        let ends = || contours.iter().map(|c| mesh.ends(c.edge as usize)).map(|(a, b)| y_range(a, b));
        let (low, high) = (ends().map(|y| y.0).min()?, ends().map(|y| y.1).max()?);
        Some(self.row(low)..self.row(high) + 1)
    }

    fn column(&self, x: i32) -> usize {
        ((i64::from(x) - self.x0) >> self.shift).clamp(0, self.sizes[0][0] as i64 - 1) as usize
    }

    fn row(&self, y: i32) -> usize {
        ((i64::from(y) - self.y0) >> self.shift).clamp(0, self.sizes[0][1] as i64 - 1) as usize
    }

    /// Row by row, the first and the last cell that a -> b may touch.
    #[inline]
    fn cells<'a>(&'a self, a: &'a Point, b: &'a Point) -> impl Iterator<Item = (usize, usize, usize)> + 'a {
        let (lower, upper) = y_range(a, b);
        let (first, last) = (self.row(lower), self.row(upper));
        let slanted = (first < last).then(|| Slanted::new(a, b));
        (first..=last).map(move |row| {
            let low = self.y0 + ((row as i64) << self.shift);
            let (from, to) = match &slanted {
                Some(edge) => edge.between(low, low + (1i64 << self.shift)),
                None => (a[0].min(b[0]), a[0].max(b[0])),
            };
            (row, self.column(from), self.column(to))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::edge_table::EdgeTable;
    use super::super::mesh::SnappedGroup;
    use super::*;
    use hlr_exact::arithmetic::Exact;

    /// Which of these rectangles are left out; each is a group: left, lower, right and upper side, and depth.
    fn hidden(rectangles: &[[i32; 5]], delta: i64) -> Vec<bool> {
        let count = rectangles.len() as i32;
        let points =
            rectangles.iter().flat_map(|&[x0, y0, x1, y1, z]| [[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]);
        let triangles: Vec<[i32; 3]> =
            (0..count).flat_map(|g| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|v| v + 4 * g))).collect();
        let edges: Vec<[i32; 2]> =
            (0..count).flat_map(|g| [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]].map(|e| e.map(|v| v + 4 * g))).collect();
        let offsets: Vec<i32> =
            (0..count).flat_map(|g| [0, 1, 3, 4, 5].map(|at| at + 6 * g)).chain([6 * count]).collect();
        let incident: Vec<i32> = (0..count).flat_map(|g| [0, 0, 1, 1, 0, 1].map(|t| t + 2 * g)).collect();
        let each = |times: usize| (0..count).flat_map(|g| vec![g; times]).collect::<Vec<i32>>();
        let (triangle_group, edge_group) = (each(2), each(5));
        let mesh = Mesh {
            points: points.collect(),
            triangles: &triangles,
            triangle_group: &triangle_group,
            edges: &edges,
            offsets: &offsets,
            incident: &incident,
            edge_group: &edge_group,
            crossing: &[],
            role: &vec![0; edges.len()],
            groups: vec![SnappedGroup { cull: false, sound: true, delta, cap: delta, tight: false }; rectangles.len()],
        };
        let table = PolygonTable::new::<Exact>(&mesh);
        let contours = EdgeTable::new(&mesh, &table).contours;
        DepthPyramid::new(&mesh, &table, &contours).hidden
    }

    #[test]
    fn a_group_is_left_out_where_all_of_it_lies_behind_others() {
        const WALL: [i32; 5] = [0, 0, 60_000, 60_000, 100];
        let behind = |z: i32| [20_000, 20_000, 30_000, 30_000, z];
        assert_eq!(hidden(&[WALL, behind(111), behind(200)], 10), [false, true, true]);
        // Within the tolerance, before the wall, and beside it in part.
        assert_eq!(hidden(&[WALL, behind(110), behind(0)], 10), [false; 3]);
        assert_eq!(hidden(&[WALL, [50_000, 20_000, 61_000, 30_000, 200], [70_000, 0, 71_000, 9, 200]], 10), [false; 3]);
        // Its border is covered, its middle not.
        let frame = [[0, 0, 60_000, 20_000, 0], [0, 40_000, 60_000, 60_000, 0], [0, 0, 20_000, 60_000, 0]];
        let framed = [&frame[..], &[[40_000, 0, 60_000, 60_000, 0], [9_000, 9_000, 51_000, 51_000, 200]]].concat();
        assert_eq!(hidden(&framed, 0), [false; 5]);
    }
}
