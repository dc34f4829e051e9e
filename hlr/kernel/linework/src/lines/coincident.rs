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

use std::collections::HashMap;

use rayon::prelude::*;

pub use super::gaps::Widths;
use super::gaps::{Covered, Side, along, at, gaps, rest, still_there};
use super::{Polyline, View, distance};
use hlr_exact::Point;
use hlr_exact::snap::Grid;
use hlr_visibility::scan::bands::{Bands, clipped_x, y_range};

/// Sine of the angle beyond which two lines cross rather than coincide. It is large because the chords of a circle that
/// was divided in two ways differ in direction. Crossings at smaller angles are recognised by the length they cover.
const PARALLEL: f64 = 0.5;
/// A stretch of one side, in parameters, that another side covers, either of its own line or of another.
#[derive(Clone, Copy, PartialEq)]
struct Hit {
    side: u32,
    from: f64,
    to: f64,
    own: bool,
    better: u32,
}

/// Once so many others cover a side entirely, worse ones are not listed. Among thousands of short lines that all cover
/// one another, the list would grow without bound; and only the best of them are drawn.
const ENOUGH: usize = 16;

struct Entry {
    xmin: i32,
    xmax: i32,
    side: u32,
}

/// Removes the stretches that better lines cover. `rank[i]` orders lines[i]; ranks are distinct.
pub fn uncovered(lines: Vec<Polyline>, rank: &[u32], widths: Widths, view: &View) -> Vec<Polyline> {
    let mut sides = Vec::new();
    let mut first_side = Vec::with_capacity(lines.len());
    for (i, line) in lines.iter().enumerate() {
        first_side.push(sides.len());
        for w in line.flat.windows(2) {
            sides.push(Side { visible: line.visible, line: i as u32, from: w[0], to: w[1] });
        }
    }
    let hits = coverings(&sides, rank, widths);
    let mut by_line: Vec<Vec<Covered>> = vec![Vec::new(); lines.len()];
    let starts: Vec<f64> = lines
        .iter()
        .flat_map(|line| {
            line.flat.windows(2).scan(0.0, |at, w| {
                let start = *at;
                *at += distance(&w[0], &w[1]);
                Some(start)
            })
        })
        .collect();
    let mut of_line: Vec<Vec<Hit>> = vec![Vec::new(); lines.len()];
    for hit in hits {
        of_line[sides[hit.side as usize].line as usize].push(hit);
    }
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_unstable_by_key(|&i| rank[i]);
    for i in order {
        if of_line[i].is_empty() {
            continue;
        }
        let mut covered = Vec::new();
        for hit in &of_line[i] {
            let (s, t) = (&sides[hit.side as usize], &sides[hit.better as usize]);
            let (start, length) = (starts[hit.side as usize], distance(&s.from, &s.to));
            let mut put = |from: f64, to: f64| {
                covered.push(Covered {
                    from: start + from * length,
                    to: start + to * length,
                    own: hit.own,
                    by: [hit.better; 2],
                });
            };
            let gone: &[Covered] = if hit.own { &[] } else { &by_line[t.line as usize] };
            if gone.is_empty() {
                put(hit.from, hit.to);
                continue;
            }
            // Where the better line is left out itself, it covers nothing.
            let place =
                |u: f64| starts[hit.better as usize] + along(t, &at(s, u)).clamp(0.0, 1.0) * distance(&t.from, &t.to);
            still_there(hit.from, hit.to, [place(hit.from), place(hit.to)], gone, put);
        }
        by_line[i] = gaps(covered, &lines[i], &sides, widths, view);
    }
    lines
        .into_par_iter()
        .zip(by_line.into_par_iter())
        .flat_map_iter(|(line, gaps)| if gaps.is_empty() { vec![line] } else { rest(&line, &gaps, widths, view) })
        .collect()
}

/// Stretches of sides covered by sides of better lines.
fn coverings(sides: &[Side], rank: &[u32], widths: Widths) -> Vec<Hit> {
    let corners: Vec<[f64; 3]> =
        sides.iter().flat_map(|s| [[s.from[0], s.from[1], 0.0], [s.to[0], s.to[1], 0.0]]).collect();
    let Some(grid) = Grid::around(&corners) else { return Vec::new() };
    let snapped: Vec<Point> = corners.iter().map(|p| grid.snap(p)).collect();
    let reach = (widths.under.max(widths.same) * grid.scale_xy).ceil().min(f64::from(1 << 29)) as i32 + 1;
    let grow = |(low, high): (i32, i32)| (low.saturating_sub(reach), high.saturating_add(reach));
    let ranges: Vec<(i32, i32)> = snapped.chunks_exact(2).map(|p| grow(y_range(&p[0], &p[1]))).collect();
    let bands = Bands::choose(&ranges, 2.0);
    let (offsets, items) = bands.bucket(&ranges);
    let mut found: Vec<Hit> = (0..bands.count)
        .into_par_iter()
        .flat_map_iter(|k| {
            let (y0, y1) = bands.limits(k);
            let (y0, y1) = (y0 - i64::from(reach), y1 + i64::from(reach));
            let mut entries: Vec<Entry> = items[offsets[k] as usize..offsets[k + 1] as usize]
                .iter()
                .map(|&i| {
                    let i = i as usize;
                    let (xmin, xmax) = grow(clipped_x(&snapped[2 * i], &snapped[2 * i + 1], y0, y1));
                    Entry { xmin, xmax, side: i as u32 }
                })
                .collect();
            entries.sort_unstable_by_key(|e| (e.xmin, e.side));
            sweep(&entries, sides, &ranges, rank, widths)
        })
        .collect();
    found.par_sort_by(|a, b| {
        let places = a.from.total_cmp(&b.from).then(a.to.total_cmp(&b.to));
        a.side.cmp(&b.side).then(places).then(a.own.cmp(&b.own)).then(a.better.cmp(&b.better))
    });
    found.dedup();
    found
}

fn sweep(entries: &[Entry], sides: &[Side], ranges: &[(i32, i32)], rank: &[u32], widths: Widths) -> Vec<Hit> {
    let mut active: Vec<&Entry> = Vec::new();
    let mut found = Vec::new();
    let mut whole: HashMap<u32, Vec<u32>> = HashMap::new();
    for e in entries {
        let (s, range) = (&sides[e.side as usize], ranges[e.side as usize]);
        let mut i = 0;
        while i < active.len() {
            let other = active[i];
            if other.xmax < e.xmin {
                active.swap_remove(i);
                continue;
            }
            i += 1;
            let o = ranges[other.side as usize];
            if range.0 > o.1 || o.0 > range.1 {
                continue;
            }
            let t = &sides[other.side as usize];
            let yields = if s.line == t.line {
                // A line that runs back over itself (a rim seen edge-on) is drawn once: its earlier sides stay.
                if heading(s, t) >= 0.0 {
                    continue;
                }
                e.side > other.side
            } else {
                rank[s.line as usize] > rank[t.line as usize]
            };
            let (worse, better, id, by) = if yields { (s, t, e.side, other.side) } else { (t, s, other.side, e.side) };
            let own = s.line == t.line;
            // A side of the same line certainly covers this one: it counts as the best rank.
            let place = if own { 0 } else { rank[better.line as usize] };
            let known = whole.get(&id);
            if known.is_some_and(|best| best.len() == ENOUGH && best[ENOUGH - 1] <= place) {
                continue;
            }
            let width = if worse.visible == better.visible { widths.same } else { widths.under };
            if let Some((u0, u1)) = covered(worse, better, width, widths.same) {
                found.push(Hit { side: id, from: u0, to: u1, own, better: by });
                if (u0, u1) == (0.0, 1.0) {
                    let best = whole.entry(id).or_default();
                    best.insert(best.partition_point(|&r| r <= place), place);
                    best.truncate(ENOUGH);
                }
            }
        }
        active.push(e);
    }
    found
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
    let (m, l) = ((vx * vx + vy * vy).sqrt(), (ux * ux + uy * uy).sqrt());
    if m == 0.0 || l == 0.0 || (vx * uy - vy * ux).abs() > PARALLEL * m * l {
        return None;
    }
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
