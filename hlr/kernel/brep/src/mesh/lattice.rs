//! Inner points of a doubly curved face: rows of equilateral triangles in the chart, sized by the field of spacings.
//!
//! ```text
//!      .   .   .   .      Rows are as far apart as their own spacing asks for, so that they follow a spacing that
//!    .   .   .   .   .    changes along y. Where it changes along x as well, the chart is cut into blocks.
//! ```

use super::border_grid::BorderGrid;
use super::progress::Progress;
use super::spacing::Field;

/// Height of an equilateral triangle of side 1.
const HEIGHT: f64 = 0.866;
/// Largest ratio of spacings within a row of one block.
const EVEN: f64 = 1.3;
/// Neighbouring rows get the same number of steps if the numbers they ask for differ by no more than this factor.
const RUN: f64 = 1.14;
/// Least distance of inner points from the border, in spacings.
pub const MARGIN: f64 = 0.45;
/// Counts of rows and steps are rounded up, unless their fraction is no larger than this.
const HAIR: f64 = 0.05;

/// Points inside the loops; None where they would be more than `most`.
pub fn points(field: &Field, border: &BorderGrid, most: usize, steps: &Progress) -> Option<Vec<[f64; 2]>> {
    let mut lattice = Lattice { field, border, points: Vec::new(), crossed: Vec::new(), most, steps };
    let counts = field.counts();
    lattice.block([0, counts[0]], [0, counts[1]])?;
    Some(lattice.points)
}

struct Lattice<'a> {
    field: &'a Field,
    border: &'a BorderGrid<'a>,
    points: Vec<[f64; 2]>,
    crossed: Vec<f64>,
    most: usize,
    steps: &'a Progress<'a>,
}

/// A row of a block of cells.
pub struct Level {
    pub y: f64,
    pub spacing: f64,
    odd: bool,
    /// Number of equal steps along the block.
    pub steps: f64,
}

/// Whether spacings change along the rows of a block of cells.
pub fn is_uneven(field: &Field, i: [usize; 2], j: [usize; 2]) -> bool {
    i[1] - i[0] > 1
        && (j[0]..j[1]).any(|row| {
            let (low, high) = range(field, i, row);
            high > EVEN * low
        })
}

/// Smallest and largest spacing in a row of cells.
fn range(field: &Field, i: [usize; 2], row: usize) -> (f64, f64) {
    let each = (i[0]..i[1]).map(|k| field.in_cell(k, row));
    each.fold((f64::INFINITY, 0.0), |(low, high), h| (low.min(h), high.max(h)))
}

/// The rows of a block of cells; None where there are too many.
pub fn levels(field: &Field, i: [usize; 2], j: [usize; 2]) -> Option<Vec<Level>> {
    let (xs, ys) = (&field.chart[0], &field.chart[1]);
    // The topmost line is border; a line between blocks belongs to the block before it.
    let open = j[1] < field.counts()[1];
    let sizes: Vec<f64> = (j[0]..j[1])
        .map(|row| {
            let (low, high) = range(field, i, row);
            (low * high).sqrt()
        })
        .collect();
    let heights: Vec<f64> = (j[0]..j[1]).map(|row| ys[row + 1] - ys[row]).collect();
    let total: f64 = heights.iter().zip(&sizes).map(|(y, h)| y / (HEIGHT * h)).sum();
    let count = (total - HAIR).ceil().max(1.0);
    let across = (xs[i[1]] - xs[i[0]]) / sizes.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    if (count * across).is_nan() || count * across > 1e9 {
        return None;
    }
    let (mut row, mut passed) = (0, 0.0);
    let mut levels = Vec::with_capacity(count as usize);
    for number in 1..=count as usize {
        if number == count as usize && !open {
            break;
        }
        // The height at which the wanted number of rows is reached.
        let wanted = total * number as f64 / count;
        while row + 1 < sizes.len() && passed + heights[row] / (HEIGHT * sizes[row]) < wanted {
            passed += heights[row] / (HEIGHT * sizes[row]);
            row += 1;
        }
        let y = (ys[j[0] + row] + (wanted - passed) * HEIGHT * sizes[row]).min(ys[j[1]]);
        levels.push(Level { y, spacing: sizes[row], odd: number % 2 == 1, steps: 0.0 });
    }
    even_out(&mut levels, xs[i[1]] - xs[i[0]]);
    Some(levels)
}

/// Gives as many consecutive rows as possible the same number of steps. Where the number changes, the points of two
/// rows shift against one another, and triangles become right-angled.
fn even_out(levels: &mut [Level], width: f64) {
    let mut rest = levels;
    while !rest.is_empty() {
        let (mut low, mut high, mut count) = (f64::INFINITY, 0.0f64, 0);
        for level in &*rest {
            let wanted = width / level.spacing;
            let (l, h) = (low.min(wanted), high.max(wanted));
            if count > 0 && h > RUN * l {
                break;
            }
            (low, high, count) = (l, h, count + 1);
        }
        let steps = ((low * high).sqrt() - HAIR).ceil().max(1.0);
        let (run, after) = rest.split_at_mut(count);
        run.iter_mut().for_each(|level| level.steps = steps);
        rest = after;
    }
}

/// The points of a row along x. `open`: the right end is a point too, if the row has one there.
pub fn across(ends: [f64; 2], open: bool, level: &Level) -> impl Iterator<Item = f64> {
    let even = Even::new(ends, open, level);
    (0..even.count).map(move |k| even.at(k))
}

/// Points at equal distances.
struct Even {
    left: f64,
    step: f64,
    shift: f64,
    count: usize,
}

impl Even {
    fn new([left, right]: [f64; 2], open: bool, level: &Level) -> Even {
        let steps = level.steps;
        let shift = if level.odd { 0.5 } else { 1.0 };
        let count = if level.odd || open { steps as usize } else { steps as usize - 1 };
        Even { left, step: (right - left) / steps, shift, count }
    }

    fn at(&self, number: usize) -> f64 {
        self.left + (number as f64 + self.shift) * self.step
    }

    fn number(&self, x: f64) -> f64 {
        (x - self.left) / self.step - self.shift
    }
}

impl Lattice<'_> {
    fn block(&mut self, i: [usize; 2], j: [usize; 2]) -> Option<()> {
        if !is_uneven(self.field, i, j) {
            return self.rows(i, j);
        }
        let [x, y] = [(0, i), (1, j)].map(|(k, r)| self.field.chart[k][r[1]] - self.field.chart[k][r[0]]);
        if x >= y || j[1] - j[0] == 1 {
            let middle = usize::midpoint(i[0], i[1]);
            self.block([i[0], middle], j)?;
            self.block([middle, i[1]], j)
        } else {
            let middle = usize::midpoint(j[0], j[1]);
            self.block(i, [j[0], middle])?;
            self.block(i, [middle, j[1]])
        }
    }

    fn rows(&mut self, i: [usize; 2], j: [usize; 2]) -> Option<()> {
        let xs = &self.field.chart[0];
        let ends = [xs[i[0]], xs[i[1]]];
        let open = i[1] < self.field.counts()[0];
        for level in levels(self.field, i, j)? {
            self.row(ends, open, &level)?;
        }
        Some(())
    }

    fn row(&mut self, ends: [f64; 2], open: bool, level: &Level) -> Option<()> {
        self.border.crossed(level.y, &mut self.crossed);
        let even = Even::new(ends, open, level);
        for pair in self.crossed.chunks_exact(2) {
            // Numbers of the points between two crossings with the border.
            let from = even.number(pair[0]).ceil().max(0.0) as usize;
            let to = even.number(pair[1]).floor().min(even.count as f64 - 1.0);
            if to < 0.0 {
                continue;
            }
            for k in from..=to as usize {
                self.steps.step();
                let p = [even.at(k), level.y];
                if !self.border.is_near(p, MARGIN * level.spacing) {
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
