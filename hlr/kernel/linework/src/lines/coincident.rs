//! Keeps one of several lines that coincide on paper: the front view of a box is four lines, not eight.
//!
//! A line is left out where a better one (lower rank: visible first, then kind, then nearer) runs close to it in nearly
//! the same direction. Ranks are a strict order, so of two lines exactly one is left out. Only drawn lines count as
//! better: the best are decided first, so that a stack of close lines does not vanish as a whole. Lines of one
//! visibility are close if they coincide; a hidden line also if it lies under the width of a visible line.
//!
//! ```text
//!   better  ===================
//!   worse        - - - - - - - - - - - -      left out on the left, drawn on the right
//! ```

use rayon::prelude::*;

use super::drawn::Drawn;
pub use super::gaps::Widths;
use super::gaps::{Covered, Side, along, at, gaps, rest, still_there};
use super::{Polyline, View, distance};

/// Sine of the angle beyond which two lines cross rather than coincide. It is large because the chords of a circle that
/// was divided in two ways differ in direction. Crossings at smaller angles are recognised by the length they cover.
const PARALLEL: f64 = 0.5;

/// Removes the stretches that better lines cover. `rank[i]` orders lines[i]; ranks are distinct.
pub fn uncovered(lines: Vec<Polyline>, rank: &[u32], widths: Widths, view: &View) -> Vec<Polyline> {
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_unstable_by_key(|&i| rank[i]);
    let gone = covered_by_better(&lines, &order, widths, view);
    lines
        .into_par_iter()
        .zip(gone.into_par_iter())
        .flat_map_iter(|(line, gaps)| if gaps.is_empty() { vec![line] } else { rest(&line, &gaps, widths, view) })
        .collect()
}

/// The stretches of each line that better ones cover, ascending. order: the best line first.
///
/// Lines are decided one after another, and each is compared with what is drawn so far alone. So a thousand lines that
/// all cover one another take a thousand comparisons, and not a million.
fn covered_by_better(lines: &[Polyline], order: &[usize], widths: Widths, view: &View) -> Vec<Vec<Covered>> {
    let (mut sides, mut first_side) = (Vec::new(), vec![0]);
    for (i, line) in lines.iter().enumerate() {
        let mut start = 0.0;
        for w in line.flat.windows(2) {
            sides.push(Side { visible: line.visible, line: i as u32, from: w[0], to: w[1], start });
            start += distance(&w[0], &w[1]);
        }
        first_side.push(sides.len());
    }
    let mut gone = vec![Vec::new(); lines.len()];
    let Some(mut drawn) = Drawn::none_of(&sides, widths.under.max(widths.same)) else { return gone };
    let mut covered = Vec::new();
    for &i in order {
        let own = first_side[i]..first_side[i + 1];
        covered.clear();
        for id in own.clone() {
            let side = &sides[id];
            drawn.each_near(id as u32, |other| {
                cover(side, &sides[other as usize], other, &gone, widths, &mut covered);
            });
            // A line that runs back over itself (a rim seen edge-on) is drawn once: its earlier sides stay.
            drawn.add(id as u32);
        }
        if covered.is_empty() {
            continue;
        }
        gone[i] = gaps(&mut covered, &lines[i], &sides, widths, view);
        for id in own.filter(|&id| sides[id].within_one_of(&gone[i])) {
            drawn.remove(id as u32);
        }
    }
    gone
}

/// Adds the stretches of a side that a side of a better line covers, or an earlier one of its own line.
///
/// other: the number of the better side; gone: of each line the stretches that are left out, where it covers nothing
fn cover(side: &Side, better: &Side, other: u32, gone: &[Vec<Covered>], widths: Widths, out: &mut Vec<Covered>) {
    let own = side.line == better.line;
    if own && heading(side, better) >= 0.0 {
        return;
    }
    let width = if side.visible == better.visible { widths.same } else { widths.under };
    let Some((from, to)) = covered(side, better, width, widths.same) else { return };
    let length = side.length();
    let mut put = |from: f64, to: f64| {
        out.push(Covered { from: side.start + from * length, to: side.start + to * length, own, by: [other; 2] });
    };
    let gone = &gone[better.line as usize];
    if own || gone.is_empty() {
        return put(from, to);
    }
    let place = |u: f64| better.start + along(better, &at(side, u)).clamp(0.0, 1.0) * better.length();
    still_there(from, to, [place(from), place(to)], gone, put);
}

/// Positive if two sides run in the same direction.
fn heading(s: &Side, t: &Side) -> f64 {
    (s.to[0] - s.from[0]) * (t.to[0] - t.from[0]) + (s.to[1] - s.from[1]) * (t.to[1] - t.from[1])
}

/// The stretch of `worse` within `width` beside `better` and `over` beyond its ends (mm), as parameters on `worse`.
///
/// ```text
///              _______________________          the width of a line covers lines beside it,
///   - - - - - |=======================|- - -    but not lines that continue beyond its end
///              ‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾
/// ```
fn covered(worse: &Side, better: &Side, width: f64, over: f64) -> Option<(f64, f64)> {
    let (a, b, p, q) = (&worse.from, &worse.to, &better.from, &better.to);
    let (vx, vy) = (q[0] - p[0], q[1] - p[1]);
    let (ux, uy) = (b[0] - a[0], b[1] - a[1]);
    let (m2, l2, cross) = (vx * vx + vy * vy, ux * ux + uy * uy, vx * uy - vy * ux);
    if m2 == 0.0 || l2 == 0.0 || cross * cross > PARALLEL * PARALLEL * m2 * l2 {
        return None;
    }
    let m = m2.sqrt();
    let away = |x: &[f64; 2]| (vx * (x[1] - p[1]) - vy * (x[0] - p[0])) / m;
    let along = |x: &[f64; 2]| (vx * (x[0] - p[0]) + vy * (x[1] - p[1])) / m;
    let (mut u0, mut u1) = (0.0f64, 1.0f64);
    for (start, end, low, high) in [(away(a), away(b), -width, width), (along(a), along(b), -over, m + over)] {
        let slope = end - start;
        if slope == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let (s, t) = ((low - start) / slope, (high - start) / slope);
        u0 = u0.max(s.min(t));
        u1 = u1.min(s.max(t));
    }
    (u1 > u0).then_some((u0, u1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARALLEL_VIEW: View = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };

    #[test]
    fn a_line_back_over_itself_is_drawn_once() {
        let rim = line(true, &[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0]]);
        let rest = uncovered(vec![rim], &[0], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 1);
        assert_eq!(rest[0].flat, [[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
    }

    #[test]
    fn what_another_line_covers_leaves_a_gap() {
        // The ends at the gap are near each other, but must not be joined.
        let bent = line(false, &[[0.0, -1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 0.02], [0.0, 0.02], [0.0, 1.0]]);
        let ink = line(true, &[[-0.1, 0.01], [1.1, 0.01]]);
        let rest = uncovered(vec![ink, bent], &[0, 1], Widths { same: 0.005, under: 0.02 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 3);
    }

    fn line(visible: bool, points: &[[f64; 2]]) -> Polyline {
        let space = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Polyline { chain: 0, visible, flat: points.to_vec(), space }
    }

    #[test]
    fn coincident_lines_are_drawn_once() {
        let lines = vec![
            line(true, &[[0.0, 0.0], [10.0, 0.0]]),
            line(false, &[[10.0, 0.0], [4.0, 0.0], [4.0, 5.0]]),
            line(false, &[[6.0, 0.001], [20.0, 0.001]]),
        ];
        let rest = uncovered(lines, &[0, 1, 2], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 3);
        assert_eq!(rest[1].flat[1], [4.0, 5.0]);
        assert!((rest[1].flat[0][1]).abs() < 0.05);
        assert!((rest[2].flat[0][0] - 10.01).abs() < 0.05 && rest[2].flat[1][0] == 20.0);
    }

    #[test]
    fn crossing_lines_are_left_alone() {
        let lines = vec![line(true, &[[0.0, 0.0], [10.0, 0.0]]), line(false, &[[0.0, -2.0], [10.0, 2.0]])];
        let rest = uncovered(lines.clone(), &[0, 1], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest, lines);
    }
}
