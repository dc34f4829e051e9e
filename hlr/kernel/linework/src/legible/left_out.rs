//! Which lines a pen cannot show. Lines of one visibility only are compared.
//!
//! A figure, lines that meet at their ends, is too small where it fits a square as wide as the pen.
//!
//! Of the others a line is left out where, all along and on both sides, another runs alongside closer than the pen is wide, and
//! one of these stays: no white paper would have shown between them. The border of such a region has nothing on its
//! other side and stays, so outlines do not change. Lines that go on from one another stay or go together, so that no
//! edge gets a gap. Important classes stay first, then long lines, then those at the left and below.

use rayon::prelude::*;

use super::grid::{Grid, NOWHERE, STEPS, Segment};
use super::ink::Ink;
use super::joints::joined;
use crate::fit::arc::grow;
use crate::fit::plane::{Vec2, length};
use crate::lines::drawing::{Kind, Line, Lines};

/// What becomes of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Fate {
    Drawn = 0,
    Small = 1,
    Between = 2,
}

/// Places are looked at every so many pens along a line.
const PIECE: f64 = 0.5;

/// The fate of each line. pens: widths of hidden and of visible lines, millimetres; accuracy: ends within it meet;
/// order: the classes, the least important first.
pub fn left_out(lines: &Lines, ink: &Ink, pens: [f64; 2], accuracy: f64, order: &[Kind]) -> Vec<Fate> {
    // Points are rounded to whole steps here: ends that meet may be a step apart.
    let tolerance = (accuracy * STEPS).max(1.0);
    let mut fates = smaller_than_a_pen(lines, &ink.boxes, pens, tolerance);
    if !fates.contains(&Fate::Drawn) {
        // All of the drawing is smaller than the pen: a dot is better than nothing.
        return vec![Fate::Drawn; lines.0.len()];
    }
    let of = |visible: bool| {
        let (pen, grid) = (pens[usize::from(visible)] * STEPS, ink.grids[usize::from(visible)].as_ref());
        grid.map_or(Vec::new(), |grid| between_others(lines, grid, pen, tolerance, order, &fates))
    };
    let (hidden, visible) = rayon::join(|| of(false), || of(true));
    hidden.into_iter().chain(visible).for_each(|line| fates[line as usize] = Fate::Between);
    fates
}

/// Lines of figures that fit a square as wide as the pen are `Small`, all others `Drawn`.
fn smaller_than_a_pen(lines: &Lines, boxes: &[[Vec2; 2]], pens: [f64; 2], tolerance: f64) -> Vec<Fate> {
    let fits = |line: &Line, [low, high]: &[Vec2; 2]| {
        let pen = pens[usize::from(line.visible)] * STEPS;
        (0..2).all(|k| high[k] - low[k] < pen)
    };
    // A figure is small where all its lines are: what meets none of these need not be looked at.
    let small: Vec<bool> = lines.0.iter().zip(boxes).map(|(line, around)| fits(line, around)).collect();
    if !small.contains(&true) {
        return vec![Fate::Drawn; lines.0.len()];
    }
    let figure = joined(lines, |_| true, |i| small[i], tolerance, false);
    let mut around = vec![NOWHERE; lines.0.len()];
    for (own, &figure) in boxes.iter().zip(&figure) {
        own.iter().for_each(|corner| grow(&mut around[figure], corner));
    }
    let fate = |(line, &figure)| if fits(line, &around[figure]) { Fate::Small } else { Fate::Drawn };
    lines.0.iter().zip(&figure).map(fate).collect()
}

/// The lines of a grid that lie between others closer than the pen is wide, steps. Small figures do not count.
fn between_others(lines: &Lines, grid: &Grid, pen: f64, tolerance: f64, order: &[Kind], fates: &[Fate]) -> Vec<u32> {
    let counts = |line: u32| fates[line as usize] == Fate::Drawn;
    let mut of = grid.lines();
    of.retain(|own| counts(own[0].line));
    let between: Vec<bool> = of.par_iter().map(|own| everywhere(grid, own, pen, counts, true)).collect();
    if !between.contains(&true) {
        return Vec::new();
    }
    let mut sought = vec![false; lines.0.len()];
    of.iter().zip(&between).for_each(|(own, between)| sought[own[0].line as usize] = *between);
    let mut looked_at = vec![false; lines.0.len()];
    of.iter().for_each(|own| looked_at[own[0].line as usize] = true);
    let run = joined(lines, |i| looked_at[i], |i| sought[i], tolerance, true);
    let mut open = vec![true; lines.0.len()];
    for (own, _) in of.iter().zip(&between).filter(|(_, between)| !**between) {
        open[run[own[0].line as usize]] = false;
    }
    let mut runs: Vec<Vec<&[Segment]>> = vec![Vec::new(); lines.0.len()];
    for own in of {
        runs[run[own[0].line as usize]].push(own);
    }
    let mut candidates: Vec<(Key, usize)> = (0..runs.len())
        .filter(|&r| open[r] && !runs[r].is_empty())
        .map(|r| (key(lines, &runs[r], pen, order), r))
        .collect();
    candidates.sort_unstable();
    let mut out = Vec::new();
    // A run is open until it is decided to stay: lines in it cannot stand for others.
    for (_, r) in candidates {
        let stays = |line: u32| counts(line) && !open[run[line as usize]];
        if runs[r].iter().all(|own| everywhere(grid, own, pen, stays, false)) {
            out.extend(runs[r].iter().map(|own| own[0].line));
        } else {
            open[r] = false;
        }
    }
    out
}

/// Whether everywhere along a line one of the `counting` lines lies within a pen: on both sides, or on one.
fn everywhere(grid: &Grid, own: &[Segment], pen: f64, counting: impl Fn(u32) -> bool, both: bool) -> bool {
    own.iter().all(|segment| {
        segment.places(PIECE * pen).all(|place| {
            let (mut left, mut right) = (false, false);
            let mut found = false;
            grid.beside(segment, &place, pen, |offset, other| {
                if counting(other.line) {
                    left |= offset > 0.0;
                    right |= offset < 0.0;
                    found = if both { left && right } else { left || right };
                }
                !found
            });
            found
        })
    })
}

/// In which order runs are decided: class, then length in powers of two of the pen, both falling; then place.
type Key = (usize, i32, [i64; 4]);

fn key(lines: &Lines, run: &[&[Segment]], pen: f64, order: &[Kind]) -> Key {
    let (mut around, mut long, mut place) = (NOWHERE, 0.0, 0);
    for own in run {
        let kind = lines.0[own[0].line as usize].kind;
        place = place.max(order.iter().position(|k| *k == kind).unwrap_or(0));
        for segment in *own {
            long += length(&segment.way());
            [segment.a, segment.b].iter().for_each(|p| grow(&mut around, p));
        }
    }
    let [[x0, y0], [x1, y1]] = around.map(|p| p.map(|c| c as i64));
    let doublings = (1..40).filter(|k| long >= pen * (1u64 << k) as f64).count() as i32;
    (order.len() - place, -doublings, [x0, y0, x1, y1])
}
