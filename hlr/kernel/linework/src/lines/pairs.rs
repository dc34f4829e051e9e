//! Finds all sides that cover stretches of others, in square cells of the paper, on all threads.
//!
//! Each side lies in the cells that its box, and a margin around it, touches along its way. In each cell every side is
//! compared with every other one. The cells are as large as a side is long, so a cell has few members; where it has
//! many, as in a stack of a thousand coincident lines, nothing is compared, and the answer is that there are too many.
//!
//! ```text
//!   ____________________________
//!   |        |   .____|___.    |      a side in three cells,
//!   |________|__/_____|________|
//!   |    ---'|-'      |        |      one beside it in two: they are compared in the one
//!   |________|________|________|      that they share
//! ```

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::cells::Cells;
use super::gaps::Side;
use super::members::{Gaps, Member};
use super::stretches::Stretches;

/// Comparisons for each side, and stretches for each side, beyond which there are too many: comparing each line with what
/// is drawn then takes less time, although on one thread (measured on two cores).
const MOST_TESTS: usize = 512;
const MOST_FOUND: usize = 16;
/// Fewer stretches than this are never too many.
const FEW: usize = 1 << 12;
/// One of so many runs of cells is looked through first: where these have more than their share of the stretches, there
/// will be too many in all.
const SAMPLE: usize = 16;
/// Sides for each band of rows.
const IN_A_BAND: usize = 1 << 11;
/// Cells of a band whose sides are compared on one thread.
const CELLS: usize = 64;

/// The stretch of a side that another one, `by`, covers; from and to are parameters on the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub side: u32,
    pub by: u32,
    pub from: f64,
    pub to: f64,
}

/// All stretches of sides that earlier ones cover, ascending by side, then by the other side. None where there are too
/// many, or a coordinate is no number.
pub(super) fn pairs(sides: &[Side], stretches: &Stretches) -> Option<Vec<Pair>> {
    let cells = Cells::of(sides, stretches.reach)?;
    let bands = cells.rows.min(sides.len() / IN_A_BAND + 1);
    // What covers a side lies beside it or beyond its ends by the reach at most, in a corner by both. Half of that is the
    // margin of each, and a little more, as places are rounded and boxes are kept as f32.
    let margin = 0.75 * stretches.reach + cells.rounding();
    let gaps = Gaps::of(&cells, stretches.widths);
    let in_band = in_bands(&cells, margin, sides, bands);
    let filled: Vec<Band> = in_band
        .into_par_iter()
        .enumerate()
        .map(|(k, here)| Band::filled(&cells, margin, sides, &here, rows_of(&cells, k, bands)))
        .collect();
    let most_tests = MOST_TESTS.saturating_mul(sides.len());
    filled.iter().try_fold(0usize, |sum, band| Some(sum + band.tests()).filter(|&sum| sum <= most_tests))?;
    let (found, most_found) = (AtomicUsize::new(0), FEW + MOST_FOUND * sides.len());
    let of_cells = |band: &Band, cells: &[u32]| {
        let pairs = if found.load(Ordering::Relaxed) > most_found {
            Vec::new()
        } else {
            band.pairs(cells, &gaps, sides, stretches)
        };
        found.fetch_add(pairs.len(), Ordering::Relaxed);
        pairs
    };
    // Bands have as many sides on average, but one may be much fuller than the others.
    let runs: Vec<(&Band, &[u32])> = filled
        .iter()
        .flat_map(|band| {
            let first = (0..band.offsets.len() - 1).step_by(CELLS);
            first.map(move |first| (band, &band.offsets[first..(first + CELLS + 1).min(band.offsets.len())]))
        })
        .collect();
    let of_runs = |sample: bool| -> Vec<Pair> {
        let chosen = runs.par_iter().enumerate().filter(|(k, _)| (k % SAMPLE == 0) == sample);
        chosen.flat_map_iter(|(_, (band, cells))| of_cells(band, cells)).collect()
    };
    let mut all = of_runs(true);
    if all.len() > FEW && all.len() > most_found / SAMPLE {
        return None;
    }
    all.append(&mut of_runs(false));
    if found.into_inner() > most_found {
        return None;
    }
    all.par_sort_unstable_by_key(|p| (p.side, p.by));
    // Found in each cell that both have in common.
    all.dedup_by_key(|p| (p.side, p.by));
    Some(all)
}

/// The rows of band k of `bands`.
fn rows_of(cells: &Cells, k: usize, bands: usize) -> Range<usize> {
    cells.rows * k / bands..cells.rows * (k + 1) / bands
}

/// The sides that come into each band.
fn in_bands(cells: &Cells, margin: f64, sides: &[Side], bands: usize) -> Vec<Vec<u32>> {
    let band_of: Vec<u32> = (0..bands).flat_map(|k| rows_of(cells, k, bands).map(move |_| k as u32)).collect();
    let ranges: Vec<(u32, u32)> = sides
        .par_iter()
        .map(|Side { from, to, .. }| {
            let (y0, y1) = (from[1].min(to[1]) - margin, from[1].max(to[1]) + margin);
            (band_of[cells.cell(y0, 1)], band_of[cells.cell(y1, 1)])
        })
        .collect();
    let mut found = vec![Vec::new(); bands];
    for (side, &(first, last)) in ranges.iter().enumerate() {
        found[first as usize..=last as usize].iter_mut().for_each(|band| band.push(side as u32));
    }
    found
}

/// A band of rows, cell by cell: members[offsets[c]..offsets[c + 1]].
struct Band {
    offsets: Vec<u32>,
    members: Vec<Member>,
}

impl Band {
    /// here: the sides that come into these rows.
    fn filled(cells: &Cells, margin: f64, sides: &[Side], here: &[u32], rows: Range<usize>) -> Band {
        let count = cells.columns * rows.len();
        let (mut last, mut offsets) = (vec![u32::MAX; count], vec![0u32; count + 1]);
        let mut entries: Vec<(u32, Member)> = Vec::new();
        for &s in here {
            let side = &sides[s as usize];
            let member = Member::of(s, side, &cells.low);
            cells.each(side, margin, |column, row| {
                if !rows.contains(&row) {
                    return;
                }
                let cell = (row - rows.start) * cells.columns + column;
                if last[cell] != s {
                    last[cell] = s;
                    offsets[cell + 1] += 1;
                    entries.push((cell as u32, member));
                }
            });
        }
        for cell in 0..count {
            offsets[cell + 1] += offsets[cell];
        }
        let mut next = offsets.clone();
        let mut members = vec![Member::default(); entries.len()];
        for (cell, member) in entries {
            members[next[cell as usize] as usize] = member;
            next[cell as usize] += 1;
        }
        Band { offsets, members }
    }

    /// How many comparisons there are.
    fn tests(&self) -> usize {
        let count = |w: &[u32]| (w[1] - w[0]) as usize;
        self.offsets.windows(2).map(count).map(|n| n * n.saturating_sub(1) / 2).sum()
    }

    /// offsets: of some cells, one after another, and of the one behind them.
    fn pairs(&self, offsets: &[u32], gaps: &Gaps, sides: &[Side], stretches: &Stretches) -> Vec<Pair> {
        let mut out = Vec::new();
        for w in offsets.windows(2) {
            let here = &self.members[w[0] as usize..w[1] as usize];
            for (k, a) in here.iter().enumerate() {
                for b in &here[k + 1..] {
                    if a.may_cover(b, gaps)
                        && let Some((side, by)) = stretches.order(sides, a.side, b.side)
                        && let Some((from, to)) = stretches.covered(&sides[side as usize], &sides[by as usize])
                    {
                        out.push(Pair { side, by, from, to });
                    }
                }
            }
        }
        out
    }
}
