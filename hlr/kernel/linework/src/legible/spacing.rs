//! How much ink lies at which distance from another line that runs alongside.

use rayon::prelude::*;

use super::grid::{Grid, NOWHERE, STEPS, Segment, ink, measurable, rounded, segments};
use crate::fit::arc::grow;
use crate::fit::plane::{Vec2, length};
use crate::lines::drawing::Lines;

/// Bins per millimetre of the distance.
pub const BINS: f64 = 64.0;

/// The longest piece of a line of which one place is looked at, millimetres. A line has one piece at least: where it is
/// crowded all along, it is found wherever it is looked at.
const PIECE: f64 = 0.5;

/// Pieces are longer where there would be more than this many: so many places tell a share to a percent.
const PLACES: f64 = 4_096.0;

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

/// Of hidden lines, of visible lines, and of hidden lines beside visible ones; reaches: for each, up to which distance is
/// looked, millimetres. None where there is too much ink to be measured.
pub fn spacings(lines: &Lines, reaches: [f64; 3]) -> [Option<Spacing>; 3] {
    let of = |visible: bool| segments(lines.0.iter().enumerate().filter(move |(_, line)| line.visible == visible));
    let ink = rayon::join(|| of(false), || of(true));
    let [hidden, visible] = [&ink.0, &ink.1].map(|segments| measurable(segments).then_some(&segments[..]));
    let grids = rayon::join(
        || hidden.map(|segments| Grid::new(segments, reaches[0] * STEPS)),
        || visible.map(|segments| Grid::new(segments, reaches[1] * STEPS)),
    );
    let measured = |own: Option<&[Segment]>, beside: &Option<Grid>, is_visible: bool, reach: f64| {
        Some(spacing(lines, is_visible, own?, beside.as_ref()?, reach))
    };
    let of_hidden = || [measured(hidden, &grids.0, false, reaches[0]), measured(hidden, &grids.1, false, reaches[2])];
    let ([hidden, under], visible) = rayon::join(of_hidden, || measured(visible, &grids.1, true, reaches[1]));
    [hidden, visible, under]
}

/// Of the lines of one visibility, which `own` are of, beside those of a grid.
fn spacing(lines: &Lines, visible: bool, own: &[Segment], grid: &Grid, reach: f64) -> Spacing {
    let chosen = lines.0.par_iter().with_min_len(ALONE).filter(|line| line.visible == visible);
    let smallest = chosen.map(|line| size(&line.flat)).reduce(|| f64::INFINITY, f64::min);
    let count = (reach * BINS) as usize;
    let all_ink = ink(own);
    let step = (PIECE * STEPS).max(all_ink / PLACES);
    let of_lines: Vec<&[Segment]> = own.chunk_by(|a, b| a.line == b.line).collect();
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

/// The side of the square that holds all points, millimetres.
fn size(points: &[Vec2]) -> f64 {
    let mut around = NOWHERE;
    points.iter().for_each(|p| grow(&mut around, &rounded(p)));
    (around[1][0] - around[0][0]).max(around[1][1] - around[0][1]) / STEPS
}

/// Adds the pieces of a line, each by the distance of what is nearest beside its middle.
fn add(grid: &Grid<'_>, line: &[Segment], step: f64, reach: f64, bins: &mut [u64]) {
    let ink = ink(line);
    let count = (ink / step).ceil().max(1.0);
    let piece = ink / count;
    let (mut k, mut before) = (0.0, 0.0);
    for segment in line {
        let way = segment.way();
        let size = length(&way);
        let end = before + size.round();
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
