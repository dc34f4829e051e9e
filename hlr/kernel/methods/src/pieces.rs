//! Pieces of polygons for the painters (depth sort and BSP tree), and how they are painted.
//!
//! A piece is its polygon and the half-planes of the image that remain after cuts. The side of a cut on which a pixel
//! lies comes from one evaluation of one line for both pieces: whatever the result, the pixel belongs to exactly one of
//! them, and no gap opens. Depth and id remain those of the polygon.
//!
//! A painter trusts its order and compares no depths. But the order comes from planes before rounding, or from corners
//! in floating point. Where two depths are closer than rounding may have moved them (`Facet::slack`), the exact
//! comparison decides the pixel, which is counted. Ties are decided there too: the lowest id wins. An order from before
//! rounding (that of the BSP tree) is not trusted at borders either: rounding may have made two polygons overlap that
//! were side by side.

use super::canvas::Canvas;
use super::coverage::{Scratch, runs};
use super::limits::Watch;
use super::plane::{STEPS, centre};
use super::screen::{Facet, NONE, Screen};
use super::statistics::Statistics;
use hlr_exact::elementary::hypot;
use std::cmp::Ordering;

/// Half of an image: pixels (column, row) where line[0] column + line[1] row + line[2] >= 0, or all others.
#[derive(Clone, Copy, Debug)]
pub struct Half {
    pub line: [f64; 3],
    pub positive: bool,
}

impl Half {
    #[inline(always)]
    fn holds(&self, column: i64, base: f64) -> bool {
        (self.line[0] * column as f64 + base >= 0.0) == self.positive
    }

    /// Whether a pixel's centre is so near to the cut that rounding may have put it on the wrong side.
    fn is_near(&self, column: i64, row: i64) -> bool {
        let [a, b, c] = self.line;
        (a * column as f64 + b * row as f64 + c).abs() <= BORDER / STEPS as f64 * hypot(a, b)
    }

    /// The part of the columns [from, to) of a row within the half. The line is monotonic along it, rounding included.
    pub fn trim(&self, row: i64, from: i64, to: i64) -> (i64, i64) {
        let base = self.line[1] * row as f64 + self.line[2];
        match (self.holds(from, base), self.holds(to - 1, base)) {
            (true, true) => (from, to),
            (false, false) => (from, from),
            (starts, _) => {
                let (mut low, mut high) = (from, to - 1);
                while high - low > 1 {
                    let middle = low + (high - low) / 2;
                    if self.holds(middle, base) == starts { low = middle } else { high = middle }
                }
                if starts { (from, high) } else { (high, to) }
            }
        }
    }
}

/// Paints pieces over those painted before.
pub struct Painter<'a> {
    pub screen: &'a Screen,
    pub canvas: &'a mut Canvas,
    /// Per facet: its place in the order is in doubt; empty where none is.
    pub wary: &'a [bool],
    /// Whether the order comes from before rounding.
    unrounded: bool,
    scratch: Scratch,
}

/// 256ths of a pixel: distance from a border within which rounding may have changed which polygon covers which.
const BORDER: f64 = 2.0;

impl<'a> Painter<'a> {
    pub fn new(screen: &'a Screen, canvas: &'a mut Canvas, wary: &'a [bool], unrounded: bool) -> Painter<'a> {
        Painter { screen, canvas, wary, unrounded, scratch: Scratch::default() }
    }

    /// Paints a facet, or the part of it within the halves.
    pub fn paint(&mut self, number: u32, halves: &[Half], watch: &Watch, statistics: &mut Statistics) -> Option<()> {
        let Painter { screen, canvas, wary, unrounded, scratch } = self;
        let facet = &screen.facets[number as usize];
        let doubt = |f: u32| wary.get(f as usize).is_some_and(|&w| w);
        let doubted = doubt(number);
        let at_border = |column: i64, row: i64, under: &Facet| {
            *unrounded
                && (near_edge(screen, facet, column, row)
                    || near_edge(screen, under, column, row)
                    || halves.iter().any(|h| h.is_near(column, row)))
        };
        let mut over = false;
        runs(screen, number, facet.columns, facet.rows, scratch, |row, mut from, mut to| {
            for half in halves {
                if from < to {
                    (from, to) = half.trim(row, from, to);
                }
            }
            if from < to {
                statistics.spans += 1;
            }
            let mut start = from;
            for column in from..to {
                let owner = canvas.at(column, row);
                if owner != NONE {
                    let under = &screen.facets[owner as usize];
                    let apart = (facet.depth_at(column, row) - under.depth_at(column, row)).abs();
                    let trusted = apart > facet.slack + under.slack;
                    if !trusted || doubted || doubt(owner) || at_border(column, row, under) {
                        statistics.settled += 1;
                        if screen.compare(number, owner, column, row, statistics) != Ordering::Less {
                            if start < column {
                                canvas.write(row, start, column, number, statistics);
                            }
                            start = column + 1;
                        }
                    }
                }
            }
            if start < to {
                canvas.write(row, start, to, number, statistics);
            }
            over = watch.over();
            !over
        });
        (!over).then_some(())
    }
}

/// Whether a pixel's centre lies within `BORDER` of the line through an edge of a facet.
fn near_edge(screen: &Screen, facet: &Facet, column: i64, row: i64) -> bool {
    let (x, y) = (centre(column) as f64, centre(row) as f64);
    screen.loops_of(facet).any(|l| {
        let mut p = &l[l.len() - 1];
        l.iter().any(|q| {
            let (dx, dy) = ((q[0] - p[0]) as f64, (q[1] - p[1]) as f64);
            let off = dx * (y - p[1] as f64) - dy * (x - p[0] as f64);
            p = q;
            off * off <= BORDER * BORDER * (dx * dx + dy * dy)
        })
    })
}
