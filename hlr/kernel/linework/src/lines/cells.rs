//! Square cells of the paper, in which sides of lines are looked for.

use super::distance;
use super::gaps::Side;

/// Cells for each side, at most.
const CELLS_EACH: f64 = 2.0;

/// As large as a side is long on average.
pub(super) struct Cells {
    pub low: [f64; 2],
    /// Width and height in all, mm.
    pub extent: [f64; 2],
    size: f64,
    pub columns: usize,
    pub rows: usize,
}

impl Cells {
    /// Cells for these sides, of which each is looked at within `reach` (mm). None where a coordinate is no number.
    pub(super) fn of(sides: &[Side], reach: f64) -> Option<Cells> {
        let (mut low, mut high, mut long) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], 0.0);
        for side in sides {
            for k in 0..2 {
                low[k] = low[k].min(side.from[k]).min(side.to[k]);
                high[k] = high[k].max(side.from[k]).max(side.to[k]);
            }
            long += distance(&side.from, &side.to);
        }
        let extent = [high[0] - low[0], high[1] - low[1]];
        if !(reach.is_finite() && f64::is_finite(long) && extent[0] + extent[1] > 0.0) {
            return None;
        }
        let most = CELLS_EACH * sides.len() as f64;
        let size = (long / sides.len() as f64).max(reach).max((extent[0] * extent[1] / most).sqrt());
        let size = size.max(extent[0].max(extent[1]) / most);
        let [columns, rows] = extent.map(|s| (s / size) as usize + 1);
        Some(Cells { low, extent, size, columns, rows })
    }

    /// How far off a coordinate may be that is kept as f32, mm.
    pub(super) fn rounding(&self) -> f64 {
        1e-6 * (self.extent[0] + self.extent[1])
    }

    /// The column (k = 0) or row (k = 1) of a coordinate.
    pub(super) fn cell(&self, x: f64, k: usize) -> usize {
        let count = [self.columns, self.rows][k];
        (((x - self.low[k]) / self.size).max(0.0) as usize).min(count - 1)
    }

    /// Calls `visit` with the column and row of each cell that a side comes as near to as `reach`, maybe more than once.
    pub(super) fn each(&self, side: &Side, reach: f64, mut visit: impl FnMut(usize, usize)) {
        let Side { from, to, .. } = side;
        let pieces = (distance(from, to) / self.size).ceil().max(1.0);
        // A little more, as the ends of pieces are rounded.
        let more = reach + 1e-6 * self.size;
        for i in 0..pieces as usize {
            let [(x0, x1), (y0, y1)] = [0, 1].map(|k| {
                let at = |i: usize| from[k] + (to[k] - from[k]) * (i as f64 / pieces);
                let (a, b) = (at(i), at(i + 1));
                (self.cell(a.min(b) - more, k), self.cell(a.max(b) + more, k))
            });
            for row in y0..=y1 {
                (x0..=x1).for_each(|column| visit(column, row));
            }
        }
    }
}
