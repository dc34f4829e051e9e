//! How much ink lies at which distance from another line that runs alongside.

use rayon::prelude::*;

use super::grid::{Grid, STEPS, Segment, ink};
use super::ink::Ink;
use crate::fit::plane::length;

/// Bins per millimetre of the distance.
pub const BINS: f64 = 64.0;

/// The longest piece of a line of which one place is looked at, millimetres. A line has one piece at least: where it is
/// crowded all along, it is found wherever it is looked at.
const PIECE: f64 = 0.5;

/// Pieces are longer where there would be more than this many: so many places tell a share to a percent.
const PLACES: f64 = 4_096.0;

/// How many segments can be looked at in the time that a place takes.
const AT_A_PLACE: f64 = 8.0;

/// With fewer lines, or segments, a second thread gains nothing.
const ALONE: usize = 128;

/// Nearer than this, a place is crowded with any pen: nothing nearer is sought, so that blots take no longer. Steps.
const NEAR: f64 = STEPS / BINS;

/// Ink of one visibility by its distance to the nearest line alongside.
pub struct Spacing {
    /// Millimetres of ink in each bin of distance; those of `reach` and more are in none.
    pub bins: Vec<f64>,
    /// Millimetres of all ink.
    pub ink: f64,
    /// The side of the smallest square that holds one of the lines, millimetres.
    pub smallest: f64,
}

impl Spacing {
    /// Up to the end of each bin, the share of all ink; of ink of less than a millimetre, millimetres.
    pub fn shares(&self) -> Vec<f64> {
        let mut nearer = 0.0;
        let share = |bin: &f64| {
            nearer += bin;
            nearer / self.ink.max(1.0)
        };
        self.bins.iter().map(share).collect()
    }
}

/// Of hidden lines, of visible lines, and of hidden lines beside visible ones; reaches: for each, up to which distance is
/// looked, millimetres. None where there is too much ink to be measured.
pub fn spacings(ink: &Ink, reaches: [f64; 3]) -> [Option<Spacing>; 3] {
    let [hidden, visible] = ink.grids.each_ref().map(Option::as_ref);
    let [small_hidden, small_visible] = ink.smallest;
    let measured = |own: Option<&Grid>, smallest: f64, beside: Option<&Grid>, reach: f64| {
        Some(spacing(own?, smallest, beside?, reach))
    };
    let of_hidden =
        || [measured(hidden, small_hidden, hidden, reaches[0]), measured(hidden, small_hidden, visible, reaches[2])];
    let ([hidden, under], visible) = rayon::join(of_hidden, || measured(visible, small_visible, visible, reaches[1]));
    [hidden, visible, under]
}

/// Of the lines of one grid beside those of another.
fn spacing(own: &Grid, smallest: f64, grid: &Grid, reach: f64) -> Spacing {
    let count = (reach * BINS) as usize;
    let all_ink = ink(&own.segments);
    let step = (PIECE * STEPS).max(all_ink / PLACES);
    let of_lines = own.lines();
    let bins = of_lines
        .par_iter()
        .with_min_len(ALONE)
        .fold(
            || vec![0u64; count],
            |mut bins, line| {
                add(grid, line, step, reach * STEPS, &mut bins);
                bins
            },
        )
        .reduce(|| vec![0u64; count], |a, b| a.iter().zip(&b).map(|(x, y)| x + y).collect());
    Spacing { bins: bins.into_iter().map(|steps| steps as f64 / STEPS).collect(), ink: all_ink / STEPS, smallest }
}

/// Adds the pieces of a line, each by the distance of what is nearest beside its middle.
fn add(grid: &Grid, line: &[Segment], step: f64, reach: f64, bins: &mut [u64]) {
    let ink = ink(line);
    let count = (ink / step).ceil().max(1.0);
    let piece = ink / count;
    let (mut k, mut before) = (0.0, 0.0);
    for segment in line {
        let way = segment.way();
        let size = length(&way);
        let end = before + size.round();
        let places = ((end / piece - 0.5).ceil().min(count) - k).max(0.0);
        if places * AT_A_PLACE > grid.segments.len() as f64 && !grid.any_beside(segment, reach) {
            k += places;
        }
        while k < count && (k + 0.5) * piece < end {
            let share = (((k + 0.5) * piece - before) / size).min(1.0);
            let place = [0, 1].map(|i| segment.a[i] + way[i] * share);
            let mut nearest = reach;
            grid.beside(segment, &place, reach, |offset, _| {
                nearest = nearest.min(offset.abs());
                nearest > NEAR
            });
            if let Some(bin) = bins.get_mut((nearest / STEPS * BINS) as usize) {
                *bin += piece.round() as u64;
            }
            k += 1.0;
        }
        before = end;
    }
}
