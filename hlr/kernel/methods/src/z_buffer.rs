//! The z-buffer: a depth for every pixel, polygons in any order.
//!
//! E. Catmull, "A subdivision algorithm for computer display of curved surfaces", 1974.
//!
//! 1. all depths start beyond the back plane, at +inf: with a start on the plane and a strict <, polygons in that plane
//!    would be lost
//! 2. for each polygon, for each pixel it owns: where it is nearer, write its depth and number
//!
//! Depth goes from pixel to pixel by -A/C, from row to row by -B/C. The literature's other convention, larger is
//! nearer, starts at -inf and writes where z > depth: initial value and comparison go together.

use super::canvas::Canvas;
use super::coverage::{Scratch, runs};
use super::limits::Watch;
use super::screen::{NEAR_TIE, NONE, Screen};
use super::statistics::{Statistics, bytes_of};
use std::cmp::Ordering;
use std::ops::Range;

/// Which depths are nearer: the scene's own depth always grows away from the viewer; under `Larger` its negative is
/// stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nearer {
    Smaller,
    Larger,
}

pub fn render(
    screen: &Screen,
    canvas: &mut Canvas,
    nearer: Nearer,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    let (background, sign) = match nearer {
        Nearer::Smaller => (f64::INFINITY, 1.0),
        Nearer::Larger => (f64::NEG_INFINITY, -1.0),
    };
    let depths = vec![background; canvas.pixels.len()];
    statistics.holds(canvas.bytes() + bytes_of(&depths));
    let mut buffer = Buffer { screen, canvas, depths, nearer };
    let mut scratch = Scratch::default();
    for number in 0..screen.facets.len() as u32 {
        let facet = &screen.facets[number as usize];
        let right = sign * facet.right;
        let mut over = false;
        runs(screen, number, facet.columns, facet.rows, &mut scratch, |row, from, to| {
            if let Some(patch) = screen.patch_of(facet) {
                let mut walk = patch.walk(from, row);
                buffer.span(number, row, from..to, |_| sign * walk.step(), statistics);
            } else {
                // The same as adding `right` pixel by pixel, but no sum has to wait for the one before.
                let z = sign * facet.depth_at(from, row);
                buffer.span(number, row, from..to, |column| z + right * (column - from) as f64, statistics);
            }
            over = watch.over();
            !over
        });
        if over {
            return None;
        }
    }
    Some(())
}

struct Buffer<'a> {
    screen: &'a Screen,
    canvas: &'a mut Canvas,
    depths: Vec<f64>,
    nearer: Nearer,
}

impl Buffer<'_> {
    /// Writes the pixels of a row that a facet owns; `depth` is called for each, from left to right.
    #[inline(always)]
    fn span(
        &mut self,
        number: u32,
        row: i64,
        columns: Range<i64>,
        mut depth: impl FnMut(i64) -> f64,
        statistics: &mut Statistics,
    ) {
        let Buffer { screen, canvas, depths, nearer } = self;
        statistics.spans += 1;
        statistics.comparisons += (columns.end - columns.start) as u64;
        let mut start = columns.start;
        for column in columns.clone() {
            let z = depth(column);
            let at = row as usize * canvas.width + column as usize;
            let won = match wins(*nearer, z, depths[at]) {
                Some(won) => won,
                None => {
                    let owner = canvas.pixels[at];
                    owner == NONE || screen.compare_exactly(number, owner, column, row, statistics) == Ordering::Less
                }
            };
            if won {
                depths[at] = z;
            } else {
                // The run of pixels won so far in this row is written at once.
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
}

/// Whether depth z wins over the one in the buffer; None where only integers can say.
#[inline(always)]
fn wins(nearer: Nearer, z: f64, stored: f64) -> Option<bool> {
    let ahead = match nearer {
        Nearer::Smaller => stored - z,
        Nearer::Larger => z - stored,
    };
    if ahead > NEAR_TIE {
        Some(true)
    } else if ahead < -NEAR_TIE {
        Some(false)
    } else {
        None
    }
}
