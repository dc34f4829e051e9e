//! Inner points of a bent face: rows of equilateral triangles in the chart, as wide as the field of spacings says.
//!
//! ```text
//!      .   .   .   .      Rows are as far apart as their own spacing asks for, so that they follow a spacing that
//!    .   .   .   .   .    changes along y. Where it changes along x as well, the chart is cut into blocks.
//! ```

use super::border::Border;
use super::size::Field;
use super::steps::Steps;

/// Height of an equilateral triangle.
const HEIGHT: f64 = 0.866;
/// Spacings within a row of one block differ by no more.
const EVEN: f64 = 1.3;
/// In spacings: points are kept so far off the border.
const MARGIN: f64 = 0.45;
/// Rows and columns that would be fewer by a hair are fewer.
const HAIR: f64 = 0.05;

/// Points inside the loops; None where they would be more than `most`.
pub fn points(field: &Field, border: &Border, most: usize, steps: &Steps) -> Option<Vec<[f64; 2]>> {
    let mut lattice = Lattice { field, border, points: Vec::new(), crossed: Vec::new(), most, steps };
    let counts = field.counts();
    lattice.block([0, counts[0]], [0, counts[1]])?;
    Some(lattice.points)
}

struct Lattice<'a> {
    field: &'a Field,
    border: &'a Border<'a>,
    points: Vec<[f64; 2]>,
    crossed: Vec<f64>,
    most: usize,
    steps: &'a Steps<'a>,
}

impl Lattice<'_> {
    fn block(&mut self, i: [usize; 2], j: [usize; 2]) -> Option<()> {
        let uneven = (j[0]..j[1]).any(|row| {
            let (low, high) = self.range(i, row);
            high > EVEN * low
        });
        if !uneven || i[1] - i[0] == 1 {
            return self.rows(i, j);
        }
        let [x, y] = [(0, i), (1, j)].map(|(k, r)| self.field.chart[k][r[1]] - self.field.chart[k][r[0]]);
        if (x >= y || j[1] - j[0] == 1) && i[1] - i[0] > 1 {
            let middle = usize::midpoint(i[0], i[1]);
            self.block([i[0], middle], j)?;
            self.block([middle, i[1]], j)
        } else {
            let middle = usize::midpoint(j[0], j[1]);
            self.block(i, [j[0], middle])?;
            self.block(i, [middle, j[1]])
        }
    }

    /// Least and greatest spacing in a row of cells.
    fn range(&self, i: [usize; 2], row: usize) -> (f64, f64) {
        let each = (i[0]..i[1]).map(|k| self.field.in_cell(k, row));
        each.fold((f64::INFINITY, 0.0), |(low, high), h| (low.min(h), high.max(h)))
    }

    fn rows(&mut self, i: [usize; 2], j: [usize; 2]) -> Option<()> {
        let (xs, ys) = (&self.field.chart[0], &self.field.chart[1]);
        let (left, right) = (xs[i[0]], xs[i[1]]);
        let counts = self.field.counts();
        // The outermost lines are border; a line between blocks belongs to the block before it.
        let (open_right, open_above) = (i[1] < counts[0], j[1] < counts[1]);
        let sizes: Vec<f64> = (j[0]..j[1])
            .map(|row| {
                let (low, high) = self.range(i, row);
                (low * high).sqrt()
            })
            .collect();
        let heights: Vec<f64> = (j[0]..j[1]).map(|row| ys[row + 1] - ys[row]).collect();
        let total: f64 = heights.iter().zip(&sizes).map(|(y, h)| y / (HEIGHT * h)).sum();
        let count = (total - HAIR).ceil().max(1.0);
        let across = (right - left) / sizes.iter().fold(f64::INFINITY, |m, h| m.min(*h));
        if (count * across).is_nan() || count * across > 1e9 {
            return None;
        }
        let (mut row, mut passed) = (0, 0.0);
        for number in 1..=count as usize {
            if number == count as usize && !open_above {
                break;
            }
            // Where the rows passed make the wanted number.
            let wanted = total * number as f64 / count;
            while row + 1 < sizes.len() && passed + heights[row] / (HEIGHT * sizes[row]) < wanted {
                passed += heights[row] / (HEIGHT * sizes[row]);
                row += 1;
            }
            let y = (ys[j[0] + row] + (wanted - passed) * HEIGHT * sizes[row]).min(ys[j[1]]);
            self.row([left, right], open_right, y, sizes[row], number % 2 == 1)?;
        }
        Some(())
    }

    fn row(&mut self, [left, right]: [f64; 2], open: bool, y: f64, spacing: f64, odd: bool) -> Option<()> {
        self.border.crossed(y, &mut self.crossed);
        let count = ((right - left) / spacing - HAIR).ceil().max(1.0);
        let step = (right - left) / count;
        let shift = if odd { 0.5 } else { 1.0 };
        for pair in self.crossed.chunks_exact(2) {
            // Numbers of the points between two crossings.
            let number = |x: f64| (x - left) / step - shift;
            let from = number(pair[0]).ceil().max(0.0) as usize;
            let last = if odd || open { count - 1.0 } else { count - 2.0 };
            let to = number(pair[1]).floor().min(last);
            if to < 0.0 {
                continue;
            }
            for k in from..=to as usize {
                self.steps.step();
                let p = [left + (k as f64 + shift) * step, y];
                if !self.border.is_near(p, MARGIN * spacing) {
                    self.points.push(p);
                }
            }
            if self.points.len() > self.most {
                return None;
            }
        }
        Some(())
    }
}
