//! Cuts out of a line the stretches that other lines cover.

use super::{Polyline, View, distance};
use hlr_accuracy::{COVER_CROSSING, COVER_INK};

/// The distances in millimetres on paper within which one line covers another.
#[derive(Clone, Copy, Debug)]
pub struct Widths {
    /// For lines of equal visibility.
    pub same: f64,
    /// For a hidden line beside a visible one, and for a shallow intersection line beside a line of its parts.
    pub under: f64,
}

pub(super) struct Side {
    pub(super) visible: bool,
    /// Of a shallow intersection line.
    pub(super) shallow: bool,
    pub(super) line: u32,
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    /// Arc length of its line up to it.
    pub(super) start: f64,
}

impl Side {
    pub(super) fn length(&self) -> f64 {
        distance(&self.from, &self.to)
    }

    /// Whether one of the stretches (ascending) of its line holds all of it.
    pub(super) fn within_one_of(&self, stretches: &[Covered]) -> bool {
        let before = stretches.partition_point(|s| s.from <= self.start);
        before > 0 && self.start + self.length() <= stretches[before - 1].to
    }
}

/// A stretch of a line, in arc length.
#[derive(Clone, Copy)]
pub(super) struct Covered {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) own: bool,
    /// The sides that cover its two ends.
    pub(super) by: [u32; 2],
}

/// The point of a side at a parameter.
pub(super) fn at(s: &Side, u: f64) -> [f64; 2] {
    [0, 1].map(|k| s.from[k] + u * (s.to[k] - s.from[k]))
}

/// The parameter of the point of a side nearest to a given point.
pub(super) fn along(s: &Side, p: &[f64; 2]) -> f64 {
    let (x, y) = (s.to[0] - s.from[0], s.to[1] - s.from[1]);
    let size = x * x + y * y;
    if size > 0.0 { (x * (p[0] - s.from[0]) + y * (p[1] - s.from[1])) / size } else { 0.0 }
}

/// Calls `put` with the parts of from..to that lie outside `gone` (ascending). `places`: the arc lengths of `from` and
/// `to` on the line that `gone` was cut out of.
pub(super) fn still_there(from: f64, to: f64, places: [f64; 2], gone: &[Covered], mut put: impl FnMut(f64, f64)) {
    let (low, high) = (places[0].min(places[1]), places[0].max(places[1]));
    let back = |v: f64| {
        let share = if places[1] == places[0] { 0.0 } else { (v - places[0]) / (places[1] - places[0]) };
        from + share.clamp(0.0, 1.0) * (to - from)
    };
    let mut here = low;
    let mut keep = |a: f64, b: f64| {
        let (u, v) = (back(a), back(b));
        put(u.min(v), u.max(v));
    };
    let first = gone.partition_point(|g| g.to < low);
    for g in gone[first..].iter().take_while(|g| g.from <= high) {
        if g.from > here {
            keep(here, g.from);
        }
        here = here.max(g.to);
    }
    if here < high {
        keep(here, high);
    }
}

/// The stretches (in arc length) that are left out, ascending. Rests shorter than twice the width of coincidence are
/// left out too: a line that slants off would leave dots. Longer rests, up to twice the drawn line width, are left out
/// only where they lie under a drawn line themselves. So are ends that come off a line by hardly more than its width
/// (`END_OFF`): of a rim that touches a shaft, the last bit beside the shaft's outline.
/// wide: of a hidden line, or a shallow intersection line, whose width is that of the ink.
pub(super) fn gaps(
    covered: &mut [Covered],
    line: &Polyline,
    sides: &[Side],
    wide: bool,
    widths: Widths,
    view: &View,
) -> Vec<Covered> {
    covered.sort_unstable_by(|a, b| a.from.total_cmp(&b.from).then(a.to.total_cmp(&b.to)).then(a.by.cmp(&b.by)));
    let (total, width) = (line.length(), if wide { widths.under } else { widths.same });
    let goes = |from: f64, to: f64, beside: [u32; 2]| {
        to - from <= 2.0 * widths.same
            || (wide && to - from <= 2.0 * width && {
                let ink: Vec<&Side> = beside.iter().map(|&s| &sides[s as usize]).filter(|s| s.visible).collect();
                let under = |p: &[f64; 2]| ink.iter().any(|s| away(s, p) <= width);
                let way = stretch(line, from, to, view).flat;
                // Between two covered points, the middle is farthest from the visible line.
                way.iter().all(under) && way.windows(2).all(|w| under(&[0, 1].map(|k| 0.5 * (w[0][k] + w[1][k]))))
            })
    };
    let comes_off = |from: f64, to: f64, beside: u32| {
        // The line that covers the rest may bend there.
        let (at, by) = (beside as usize, sides[beside as usize].line);
        let around = || sides[at.saturating_sub(1)..sides.len().min(at + 2)].iter().filter(|side| side.line == by);
        let near = |p: &[f64; 2]| around().any(|side| away(side, p) <= END_OFF * widths.same);
        !wide && to - from <= END_LONG * widths.same && stretch(line, from, to, view).flat.iter().all(near)
    };
    let mut merged: Vec<Covered> = Vec::new();
    for &mut one in covered {
        match merged.last_mut() {
            Some(last) if goes(last.to, one.from, [last.by[1], one.by[0]]) => {
                if one.to > last.to {
                    (last.to, last.by[1]) = (one.to, one.by[1]);
                }
                last.own &= one.own;
            }
            _ => merged.push(one),
        }
    }
    if let Some(first) = merged.first_mut()
        && (goes(0.0, first.from, [first.by[0]; 2]) || comes_off(0.0, first.from, first.by[0]))
    {
        first.from = 0.0;
    }
    if let Some(last) = merged.last_mut()
        && (goes(last.to, total, [last.by[1]; 2]) || comes_off(last.to, total, last.by[1]))
    {
        last.to = total;
    }
    let crossing = COVER_CROSSING * if wide { width.max(COVER_INK * widths.same) } else { width };
    merged.retain(|c| c.to - c.from >= crossing || c.to - c.from >= total);
    merged
}

/// Times the width of coincidence, which is half of the accuracy: how long an end may be that is left out though it comes
/// off the line that covers the rest, and how far off it may come. So it has that line within the accuracy.
const END_LONG: f64 = 7.0;
const END_OFF: f64 = 1.9;

/// Distance of a point from a side.
fn away(s: &Side, p: &[f64; 2]) -> f64 {
    distance(p, &at(s, along(s, p).clamp(0.0, 1.0)))
}

/// The pieces of a line outside its gaps.
pub(super) fn rest(line: &Polyline, gaps: &[Covered], widths: Widths, view: &View) -> Vec<Polyline> {
    let total = line.length();
    let width = if line.visible { widths.same } else { widths.under };
    let mut out: Vec<Polyline> = Vec::new();
    let mut before = 0.0;
    let mut before_own = false;
    let ends = gaps.iter().map(|g| (g.from, g.to, g.own)).chain([(total, total, false)]);
    for (from, to, own) in ends {
        if from > before {
            let mut piece = stretch(line, before, from, view);
            piece.left_out = [before > 0.0, from < total];
            match out.last_mut() {
                Some(last) if before_own && goes_on(last, &piece, 4.0 * width) => {
                    last.flat.extend(&piece.flat);
                    last.space.extend(&piece.space);
                    last.left_out[1] = piece.left_out[1];
                }
                _ => out.push(piece),
            }
        }
        (before, before_own) = (to, own);
    }
    out.retain(|l| l.flat.len() > 1);
    out
}

/// Whether a piece begins where the one before ended, because the stretch left out between them ran back over the line.
fn goes_on(before: &Polyline, piece: &Polyline, gap: f64) -> bool {
    match (before.flat.last(), piece.flat.first()) {
        (Some(end), Some(start)) => distance(end, start) <= gap,
        _ => false,
    }
}

/// The part of a line between two arc lengths.
fn stretch(line: &Polyline, from: f64, to: f64, view: &View) -> Polyline {
    let mut out = Polyline { chain: line.chain, visible: line.visible, ..Polyline::default() };
    let mut at = 0.0;
    for i in 1..line.flat.len() {
        let (a, b) = (&line.flat[i - 1], &line.flat[i]);
        let length = distance(a, b);
        let (start, end) = (at, at + length);
        at = end;
        let is_last = i + 1 == line.flat.len();
        if length == 0.0 || end < from || start > to {
            continue;
        }
        let mut put = |u: f64| {
            let mix = |x: f64, y: f64, t: f64| x + (y - x) * t;
            let flat = [mix(a[0], b[0], u), mix(a[1], b[1], u)];
            let (p, q) = (&line.space[i - 1], &line.space[i]);
            let s = view.in_space(u, view.depth(p), view.depth(q));
            if out.flat.last() != Some(&flat) {
                out.flat.push(flat);
                out.space.push([mix(p[0], q[0], s), mix(p[1], q[1], s), mix(p[2], q[2], s)]);
            }
        };
        put(((from - start) / length).clamp(0.0, 1.0));
        put(if is_last && to >= end { 1.0 } else { ((to - start) / length).clamp(0.0, 1.0) });
    }
    out
}
