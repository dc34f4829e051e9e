//! Dashes of hidden lines (ISO 128-2, ASME Y14.2), fitted to each stroke: a stroke begins and ends with a dash, a
//! closed one has a whole number of dashes, and at a corner two dashes meet. Where a hidden line goes straight on from
//! a visible one, a gap comes first: a dash there would lengthen the visible line.
//!
//! The gap keeps its width and the dashes take up the rest. Short strokes have shorter dashes, then shorter gaps, and
//! the shortest are drawn through, so that a small hidden circle is still a circle.

use hlr_exact::elementary::log10;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::digits::put;
use super::length::{Measured, between, ends, rows};
use super::strokes::{Strokes, WHOLE};
use crate::fit::plane::Vec2;

/// Shortest dash, in gap lengths.
const DASH_PER_GAP: f64 = 2.0;
/// Shortest gap that still reads as a gap, as a share of the nominal one.
const SHORTEST_GAP: f64 = 0.5;
/// Fewest dashes of a closed stroke: with fewer it would not read as closed.
const FEWEST_AROUND: f64 = 4.0;
/// Cosine of the angle from which a bend is a corner: 30 degrees.
const CORNER: f64 = 0.866;
/// Cosine of the angle up to which a hidden line goes straight on from a visible one: 15 degrees.
const STRAIGHT_ON: f64 = 0.966;
/// Most corners at which dashes meet. A stroke with more gets one even pattern, as its own would be too long.
const MOST_CORNERS: usize = 16;

/// With fewer strokes a second thread gains nothing.
const ALONE: usize = 64;

/// Millimetres by which the last dash or gap of an open stroke is longer than the stroke needs.
const PAST_THE_END: f64 = 0.02;

/// Lengths of dash and gap in millimetres.
#[derive(Clone, Copy, Debug)]
pub struct Pattern {
    pub dash: f64,
    pub gap: f64,
}

/// Lengths of dash, gap, dash, ... in 10^-places millimetres, repeated along the stroke, and how far into them it
/// begins. No lengths: a continuous line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fitted {
    pub lengths: Vec<i64>,
    pub offset: i64,
    pub places: usize,
}

impl Fitted {
    /// The lengths and the offset in millimetres, as SVG and PDF write them; both empty for a continuous line.
    pub fn text(&self) -> (String, String) {
        let number = |steps: i64| {
            let mut out = Vec::new();
            put(&mut out, steps, self.places);
            out.into_iter().map(char::from).collect::<String>()
        };
        let lengths: Vec<String> = self.lengths.iter().map(|v| number(*v)).collect();
        (lengths.join(" "), if self.lengths.is_empty() { String::new() } else { number(self.offset) })
    }
}

/// Where visible strokes end, and the directions in which they would go on.
#[derive(Default)]
pub struct Ends(FxHashMap<[i64; 2], SmallVec<[Vec2; 1]>>);

impl Ends {
    pub fn add(&mut self, visible: &Strokes) {
        let strokes = (0..visible.closed.len()).into_par_iter().with_min_len(ALONE);
        let found: Vec<_> = strokes.map(|s| ends(visible, s)).collect();
        for (point, out) in found.into_iter().flatten().flatten() {
            self.0.entry(point).or_default().push(out);
        }
    }

    /// Whether a visible stroke ends at this point and would go on against `out`.
    fn continued(&self, point: &[i64; 2], out: &Vec2) -> bool {
        self.0.get(point).is_some_and(|all| all.iter().any(|v| dot(v, out) < -STRAIGHT_ON))
    }
}

fn dot(a: &Vec2, b: &Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Pattern {
    /// Lengths of dash and gap in millimetres, so that so many `dashes` and `gaps` fill a length.
    fn fill(&self, length: f64, dashes: f64, gaps: f64) -> [f64; 2] {
        let gap = self.gap.min(length / (DASH_PER_GAP * dashes + gaps));
        [(length - gaps * gap) / dashes, gap]
    }

    /// Number of dashes in a length with `more` gaps than dashes (-1, 0 or 1); 0: a continuous line.
    fn count(&self, length: f64, more: f64, fewest: f64) -> f64 {
        let shortest = SHORTEST_GAP * self.gap;
        let wanted = ((length - more * self.gap) / (self.dash + self.gap)).round().max(fewest);
        let room = ((length - more * shortest) / ((DASH_PER_GAP + 1.0) * shortest)).floor();
        if room >= fewest { wanted.min(room) } else { 0.0 }
    }

    /// Dash and gap of a stretch without corners; None: continuous. gaps: whether it begins, and ends, with a gap.
    fn open(&self, length: f64, gaps: [bool; 2]) -> Option<[f64; 2]> {
        let at_ends = gaps.iter().filter(|g| **g).count() as f64;
        let fewest = if at_ends > 0.0 { 1.0 } else { 2.0 };
        let n = self.count(length, at_ends - 1.0, fewest);
        (n > 0.0).then(|| self.fill(length, n, n - 1.0 + at_ends))
    }

    /// The dashes of one stroke. gaps: whether it begins, and ends, with a gap.
    pub fn fitted(&self, rows: &[Measured], closed: bool, gaps: [bool; 2]) -> Fitted {
        let total: f64 = rows.iter().map(|m| m.length).sum();
        let corners = self.corners(rows, closed, total);
        if corners.is_empty() {
            if closed {
                let n = self.count(total, 0.0, FEWEST_AROUND);
                return if n > 0.0 { rounded(&self.fill(total, n, n), 0.0, n) } else { Fitted::default() };
            }
            let Some([dash, gap]) = self.open(total, gaps) else { return Fitted::default() };
            // The rounding error at the end is added to the last gap; otherwise it would be drawn as a tiny dash.
            let gap = if gaps[1] { gap + PAST_THE_END * (dash + gap) / total } else { gap };
            return rounded(&[dash, gap], if gaps[0] { dash } else { 0.0 }, total / (dash + gap));
        }
        // Stretches from corner to corner. A closed stroke begins inside its last stretch, or at a corner.
        let mut stops = corners.clone();
        if closed {
            stops.push(corners[0] + total);
        } else {
            stops.insert(0, 0.0);
            stops.push(total);
        }
        let last = stops.len() - 2;
        let mut lengths: Vec<f64> = Vec::new();
        for (i, w) in stops.windows(2).enumerate() {
            let ends = [!closed && i == 0 && gaps[0], !closed && i == last && gaps[1]];
            let mut run = stretch(w[1] - w[0], self.open(w[1] - w[0], ends), ends);
            // The dash before the corner continues after it.
            if let Some(before) = lengths.last_mut() {
                *before += run.remove(0);
            }
            lengths.extend(run);
        }
        if closed {
            // Here the last dash meets the first one.
            let back = lengths.pop().unwrap_or(0.0);
            if lengths.is_empty() {
                return Fitted::default();
            }
            lengths[0] += back;
            return rounded(&lengths, (total - corners[0] + back).rem_euclid(total), 1.0);
        }
        if lengths.len() == 1 {
            return Fitted::default();
        }
        if let Some(last) = lengths.iter_mut().rfind(|v| **v > 0.0) {
            *last += PAST_THE_END;
        }
        if lengths.len() % 2 == 1 {
            lengths.push(0.0); // an empty gap behind the last dash
        }
        rounded(&lengths, 0.0, 1.0)
    }

    /// Lengths along the stroke at which it has a corner, between stretches that have room for dashes of their own.
    fn corners(&self, rows: &[Measured], closed: bool, total: f64) -> Vec<f64> {
        let room = self.dash + self.gap;
        let mut out: Vec<f64> = Vec::new();
        let mut at = 0.0;
        for w in rows.windows(2) {
            at += w[0].length;
            if dot(&w[0].ends, &w[1].begins) < CORNER && (closed || (at >= room && total - at >= room)) {
                out.push(at);
            }
        }
        if closed && rows.len() > 1 && dot(&rows[rows.len() - 1].ends, &rows[0].begins) < CORNER {
            out.insert(0, 0.0);
        }
        let mut kept: Vec<f64> = Vec::new();
        for at in out {
            if kept.last().is_none_or(|before| at - before >= room) {
                kept.push(at);
            }
        }
        if closed && kept.len() > 1 && kept[0] + total - kept[kept.len() - 1] < room {
            kept.pop();
        }
        if kept.len() > MOST_CORNERS || (closed && kept.len() < 2) { Vec::new() } else { kept }
    }
}

/// Dash, gap, dash, ... of one stretch. It begins and ends with a dash, whose length may be zero.
fn stretch(length: f64, fitted: Option<[f64; 2]>, gaps: [bool; 2]) -> Vec<f64> {
    let Some([dash, gap]) = fitted else { return vec![length] };
    let mut out = if gaps[0] { vec![0.0, gap] } else { Vec::new() };
    let n = ((length - gap * (f64::from(gaps[0]) + f64::from(gaps[1]) - 1.0)) / (dash + gap)).round() as usize;
    for i in 0..n {
        out.push(dash);
        if i + 1 < n || gaps[1] {
            out.push(gap);
        }
    }
    if gaps[1] {
        out.push(0.0);
    }
    out
}

/// times: how often the pattern is repeated. More repeats get more digits, so that the sum of the rounding errors stays
/// below half of PAST_THE_END.
fn rounded(lengths: &[f64], offset: f64, times: f64) -> Fitted {
    let places = (log10(times.max(1.0)).ceil() as usize + 2).clamp(3, 9);
    let scale = 10f64.powi(places as i32);
    let grid = |v: f64| (v * scale).round() as i64;
    Fitted { lengths: lengths.iter().map(|v| grid(*v)).collect(), offset: grid(offset), places }
}

/// The dashes of each stroke of a hidden layer.
pub fn dashes(strokes: &Strokes, pattern: &Pattern, visible: &Ends) -> Vec<Fitted> {
    let one = |s: usize| {
        let rows = rows(strokes, s);
        let ends = rows.first().zip(rows.last()).and_then(|(begin, end)| between(strokes, s, begin, end));
        let gaps = ends.map_or([false; 2], |both| both.map(|(point, out)| visible.continued(&point, &out)));
        let round = strokes.op[strokes.starts[s] as usize] == WHOLE;
        pattern.fitted(&rows, strokes.closed[s] || round, gaps)
    };
    (0..strokes.closed.len()).into_par_iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const USUAL: Pattern = Pattern { dash: 3.0, gap: 0.75 };

    fn straight(length: f64, degrees: f64) -> Measured {
        let (s, c) = degrees.to_radians().sin_cos();
        Measured { length, begins: [c, s], ends: [c, s] }
    }

    /// Intervals along a stroke (millimetres) in which a renderer draws with this pattern.
    fn ink(fitted: &Fitted, total: f64) -> Vec<[f64; 2]> {
        if fitted.lengths.is_empty() {
            return vec![[0.0, total]];
        }
        let unit = 10f64.powi(-(fitted.places as i32));
        let (mut at, mut i, mut out) = (-(fitted.offset as f64) * unit, 0, Vec::new());
        while at < total - 1e-9 {
            let next = at + fitted.lengths[i % fitted.lengths.len()] as f64 * unit;
            if i % 2 == 0 && next > 0.0 && next > at {
                out.push([at.max(0.0), next.min(total)]);
            }
            (at, i) = (next, i + 1);
        }
        out
    }

    #[test]
    fn open_strokes_begin_and_end_with_a_dash() {
        for k in 1..4000 {
            let total = f64::from(k) * 0.1;
            let drawn = ink(&USUAL.fitted(&[straight(total, 0.0)], false, [false; 2]), total);
            assert!(drawn[0][0] == 0.0 && (drawn[drawn.len() - 1][1] - total).abs() < 0.06, "{total} {drawn:?}");
            let (first, last) = (drawn[0], drawn[drawn.len() - 1]);
            assert!(((first[1] - first[0]) - (last[1] - last[0])).abs() < 0.06, "{total} {drawn:?}");
            let widest = drawn.windows(2).map(|w| w[1][0] - w[0][1]).fold(0.0, f64::max);
            assert!(if total < 1.875 { drawn.len() == 1 } else { (0.37..0.76).contains(&widest) }, "{total} {drawn:?}");
        }
    }

    #[test]
    fn a_gap_comes_first_where_a_visible_line_goes_on() {
        for k in 20..400 {
            let total = f64::from(k) * 0.25;
            for gaps in [[true, false], [false, true], [true, true]] {
                let drawn = ink(&USUAL.fitted(&[straight(total, 0.0)], false, gaps), total);
                let (begin, end) = (drawn[0][0], total - drawn[drawn.len() - 1][1]);
                assert_eq!([begin > 0.3, end > 0.3], gaps, "{total} {drawn:?}");
            }
        }
    }

    #[test]
    fn closed_strokes_close_with_a_gap() {
        for k in 1..2000 {
            let total = f64::from(k) * 0.1;
            let fitted = USUAL.fitted(&[straight(total, 0.0)], true, [false; 2]);
            let period: i64 = fitted.lengths.iter().sum();
            if total < 4.5 {
                assert!(fitted.lengths.is_empty(), "{total}");
                continue;
            }
            let times = total * 10f64.powi(fitted.places as i32) / period as f64;
            assert!((times - times.round()).abs() < 0.03 && times > 3.9, "{total} {times}");
        }
    }

    #[test]
    fn dashes_meet_at_corners() {
        let around = [straight(20.0, 0.0), straight(11.0, 90.0), straight(20.0, 180.0), straight(11.0, 270.0)];
        let drawn = ink(&USUAL.fitted(&around, true, [false; 2]), 62.0);
        for corner in [20.0, 31.0, 51.0] {
            assert!(drawn.iter().any(|d| d[0] < corner - 1.0 && corner + 1.0 < d[1]), "{corner} {drawn:?}");
        }
        assert!(drawn[0][0] == 0.0 && (drawn[drawn.len() - 1][1] - 62.0).abs() < 0.06);
        // The same loop begun elsewhere.
        let moved = [straight(7.0, 0.0), around[1], around[2], around[3], straight(13.0, 0.0)];
        let moved = ink(&USUAL.fitted(&moved, true, [false; 2]), 62.0);
        for corner in [7.0, 18.0, 38.0, 49.0] {
            assert!(moved.iter().any(|d| d[0] < corner - 1.0 && corner + 1.0 < d[1]), "{corner} {moved:?}");
        }
        let open = ink(&USUAL.fitted(&around[..2], false, [true, false]), 31.0);
        assert!(open[0][0] > 0.3 && open.iter().any(|d| d[0] < 19.0 && 21.0 < d[1]));
        assert!((open[open.len() - 1][1] - 31.0).abs() < 0.06);
    }

    #[test]
    fn stairs_with_no_room_for_dashes_on_each_step_are_dashed_all_the_same() {
        let steps = |i: usize| if i.is_multiple_of(2) { straight(1.0, 0.0) } else { straight(1.0, 90.0) };
        let rows: Vec<Measured> = (0..14).map(steps).chain([straight(20.0, 0.0)]).collect();
        let drawn = ink(&USUAL.fitted(&rows, false, [false; 2]), 34.0);
        // At a corner two dashes join into one.
        let longest = drawn.iter().map(|d| d[1] - d[0]).fold(0.0, f64::max);
        assert!(longest < 2.5 * USUAL.dash, "{longest} {drawn:?}");
    }

    #[test]
    fn every_dash_has_its_gap() {
        // A renderer repeats a list of odd length with dashes and gaps exchanged.
        for legs in 1..6 {
            for gaps in [[false, false], [true, false], [false, true], [true, true]] {
                let rows: Vec<Measured> = (0..legs).map(|i| straight(17.0, f64::from(i) * 90.0)).collect();
                assert_eq!(USUAL.fitted(&rows, false, gaps).lengths.len() % 2, 0, "{legs} {gaps:?}");
            }
        }
    }

    #[test]
    fn a_jagged_line_is_dashed_all_the_same() {
        let rows: Vec<Measured> = (0..100).map(|i| straight(1.0, f64::from(i % 2) * 60.0)).collect();
        let drawn = ink(&USUAL.fitted(&rows, false, [false; 2]), 100.0);
        assert!(drawn.len() > 15, "{drawn:?}");
    }
}
