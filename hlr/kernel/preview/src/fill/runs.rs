//! Runs of equal values in the rows of a map. A row of a picture has few of them: what is done run by run costs next to
//! nothing, however fine the grid.

use std::iter::once;
use std::ops::Range;

use rayon::prelude::*;

pub struct Runs {
    width: usize,
    /// Per run: its first place, counted row by row; one more for the end.
    starts: Vec<u32>,
    /// Per row: its first run; one more for the end.
    rows: Vec<usize>,
}

impl Runs {
    pub fn new<T: Sync>(map: &[T], width: usize, same: impl Fn(&T, &T) -> bool + Sync) -> Runs {
        let of_row = |(y, row): (usize, &[T])| -> Vec<u32> {
            let changes = (1..row.len()).filter(|&x| !same(&row[x - 1], &row[x]));
            once(0).chain(changes).map(|x| (y * width + x) as u32).collect()
        };
        let found: Vec<Vec<u32>> = map.par_chunks(width).enumerate().map(of_row).collect();
        let mut rows = vec![0];
        for row in &found {
            rows.push(rows[rows.len() - 1] + row.len());
        }
        let mut starts = found.concat();
        starts.push(map.len() as u32);
        Runs { width, starts, rows }
    }

    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The places of a run.
    pub fn places(&self, run: usize) -> Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }

    /// The runs of a row.
    pub fn row(&self, y: usize) -> Range<usize> {
        self.rows[y]..self.rows[y + 1]
    }

    /// The columns where the runs of a row begin.
    pub fn columns(&self, y: usize) -> impl Iterator<Item = usize> {
        self.row(y).map(move |k| self.starts[k] as usize - y * self.width)
    }

    /// All pairs of runs that touch: one and the next in its row, or the upper and the lower one.
    pub fn touching(&self, mut meet: impl FnMut(usize, usize)) {
        for row in self.rows.windows(2) {
            (row[0] + 1..row[1]).for_each(|k| meet(k - 1, k));
        }
        for rows in self.rows.windows(3) {
            let (mut upper, mut lower) = (rows[0], rows[1]);
            while upper < rows[1] && lower < rows[2] {
                meet(upper, lower);
                let ends = [self.starts[upper + 1] as usize + self.width, self.starts[lower + 1] as usize];
                upper += usize::from(ends[0] <= ends[1]);
                lower += usize::from(ends[1] <= ends[0]);
            }
        }
    }
}
