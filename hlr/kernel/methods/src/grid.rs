//! A uniform grid: the facets that reach into each cell. A ray passes from cell to cell and stops at the first hit
//! before the next one.
//!
//! A. Fujimoto, T. Tanaka, K. Iwata, "ARTS: accelerated ray-tracing system", 1986.

use super::boxes::Box3;
use super::limits::Watch;
use super::screen::{NEAR_TIE, Screen};
use super::statistics::{Statistics, bytes_of};
use hlr_exact::elementary::cbrt;

pub struct Grid {
    /// Cells along columns, rows and depth.
    cells: [usize; 3],
    size: [f64; 3],
    low: f64,
    /// Cell c holds facets[first[c]..first[c + 1]].
    first: Vec<u32>,
    facets: Vec<u32>,
    boxes: Vec<Box3>,
}

impl Grid {
    /// A grid with about as many cells as facets.
    pub fn new(screen: &Screen, watch: &Watch) -> Option<Grid> {
        let boxes: Vec<Box3> = (0..screen.facets.len() as u32).map(|f| Box3::of(screen, f)).collect();
        let (low, high) = boxes.iter().fold((i64::MAX, i64::MIN), |(l, h), b| (l.min(b.depth[0]), h.max(b.depth[1])));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low as f64, high as f64 + 1.0) };
        let along = cbrt(boxes.len() as f64).ceil().clamp(1.0, 256.0) as usize;
        let cells = [along.min(screen.width as usize), along.min(screen.height as usize), along];
        let extent = [screen.width as f64, screen.height as f64, high - low];
        let size = std::array::from_fn(|k| extent[k] / cells[k] as f64);
        let mut grid =
            Grid { cells, size, low, first: vec![0; cells.iter().product::<usize>() + 1], facets: vec![], boxes };
        // Count, add up, fill.
        let mut entries = 0usize;
        for b in 0..grid.boxes.len() {
            if watch.over() {
                return None;
            }
            for c in grid.reached(&grid.boxes[b]) {
                if watch.over() {
                    return None;
                }
                grid.first[c + 1] += 1;
                entries += 1;
            }
        }
        // Entries are numbered with 32 bits.
        let room = if entries > u32::MAX as usize { usize::MAX } else { entries * size_of::<u32>() };
        if !watch.has_room(room) {
            return None;
        }
        for c in 1..grid.first.len() {
            grid.first[c] += grid.first[c - 1];
        }
        grid.facets = vec![0; grid.first.last().copied().unwrap_or(0) as usize];
        let mut next = grid.first.clone();
        for b in 0..grid.boxes.len() {
            for c in grid.reached(&grid.boxes[b]) {
                if watch.over() {
                    return None;
                }
                grid.facets[next[c] as usize] = b as u32;
                next[c] += 1;
            }
        }
        Some(grid)
    }

    fn cell(&self, axis: usize, at: f64) -> usize {
        ((at / self.size[axis]) as usize).min(self.cells[axis] - 1)
    }

    fn reached(&self, b: &Box3) -> impl Iterator<Item = usize> + use<> {
        let [nx, ny, _] = self.cells;
        let span = |axis: usize, low: f64, high: f64| self.cell(axis, low)..=self.cell(axis, high);
        let columns = span(0, b.columns[0].into(), (b.columns[1] - 1).into());
        let rows = span(1, b.rows[0].into(), (b.rows[1] - 1).into());
        let depths = span(2, b.depth[0] as f64 - self.low, b.depth[1] as f64 - self.low);
        depths.flat_map(move |z| {
            let columns = columns.clone();
            rows.clone().flat_map(move |y| columns.clone().map(move |x| (z * ny + y) * nx + x))
        })
    }

    /// Visits facets in the cells along the ray, near to far; `test` returns the depth of the nearest hit so far.
    pub fn along(
        &self,
        column: i32,
        row: i32,
        statistics: &mut Statistics,
        mut test: impl FnMut(u32, &mut Statistics) -> f64,
    ) {
        let (x, y) = (self.cell(0, column.into()), self.cell(1, row.into()));
        let mut nearest = f64::INFINITY;
        for z in 0..self.cells[2] {
            let begins = self.low + z as f64 * self.size[2];
            statistics.box_tests += 1;
            // With a margin of some steps of depth: the border of a cell is rounded.
            if begins - NEAR_TIE > nearest {
                return;
            }
            let c = (z * self.cells[1] + y) * self.cells[0] + x;
            for &f in &self.facets[self.first[c] as usize..self.first[c + 1] as usize] {
                if self.boxes[f as usize].is_hit(column, row) {
                    nearest = test(f, statistics);
                }
            }
        }
    }

    pub fn bytes(&self) -> usize {
        bytes_of(&self.first) + bytes_of(&self.facets) + bytes_of(&self.boxes)
    }
}
