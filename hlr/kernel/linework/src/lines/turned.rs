//! A line that runs back over itself begins where that leaves one line, not two.
//!
//! The rim of a cylinder seen from the side runs to one end, back over all of itself, and to its start again. Its earlier
//! sides stay (`stretches`), so it would be drawn in two pieces if it began in the middle:
//!
//! ```text
//!     from the middle:  1 ----> 2 at the right end; back over 1, on to 3 at the left end; back over that
//!     drawn:            left end ====== gap ====== right end, for what 1 covers ends a little beside its start
//!
//!     from an end:      one line
//! ```
//!
//! So a closed line begins where it first turns back. Of an open one, of a rim that is hidden in part, a way to the first
//! turn, or from the last, is left out where the longer way beside it covers it.

use super::gaps::{Side, Widths, along, at};
use super::stretches::{PARALLEL, same_way};
use super::{Polyline, distance};

/// Widths of coincidence within which the ends of a closed line lie: they may differ in the last digits.
const CLOSED: f64 = 1e-3;

/// Lets a closed line that runs back over its start begin at a turn, and leaves short ways back out of an open one.
pub fn begin_at_a_turn(line: &mut Polyline, widths: Widths) {
    let count = line.flat.len();
    if !runs_back(line) {
        return;
    }
    let sides: Vec<(usize, Side)> = sides(line).collect();
    let turns: Vec<usize> = (1..sides.len()).filter(|&k| turns_back(&sides[k - 1].1, &sides[k].1)).collect();
    let [turn, ..] = turns[..] else { return };
    let ends = [line.flat[0], line.flat[count - 1]];
    if distance(&ends[0], &ends[1]) <= CLOSED * widths.same {
        let (first, last) = (&sides[0].1, &sides[sides.len() - 1].1);
        if !turns_back(last, first) && covers(&sides[turn..], first, &ends[0], widths) {
            begin_at(&mut line.flat, sides[turn].0);
            begin_at(&mut line.space, sides[turn].0);
        }
        return;
    }
    let ways: Vec<&[(usize, Side)]> =
        [0].iter().chain(&turns).zip(turns.iter().chain([&sides.len()])).map(|(&from, &to)| &sides[from..to]).collect();
    let goes = |way: &[(usize, Side)], by: &[(usize, Side)]| {
        long(way) + widths.same < long(by)
            && way.iter().all(|(_, s)| covers(by, s, &s.from, widths) && covers(by, s, &s.to, widths))
    };
    let from = if goes(ways[0], ways[1]) { ways[1][0].0 } else { 0 };
    let last = ways.len() - 1;
    let to = if goes(ways[last], ways[last - 1]) { ways[last][0].0 } else { count - 1 };
    if from < to {
        line.flat = line.flat[from..=to].to_vec();
        line.space = line.space[from..=to].to_vec();
    }
}

/// Whether one of these sides goes through a point of another side, and not the same way.
fn covers(sides: &[(usize, Side)], other: &Side, point: &[f64; 2], widths: Widths) -> bool {
    sides.iter().any(|(_, s)| {
        let nearest = at(s, along(s, point).clamp(0.0, 1.0));
        distance(&nearest, point) <= widths.same && !same_way(s, other)
    })
}

fn long(way: &[(usize, Side)]) -> f64 {
    way.iter().map(|(_, s)| s.length()).sum()
}

/// The sides of a line that have a length, with the number of the vertex where each begins.
fn sides(line: &Polyline) -> impl Iterator<Item = (usize, Side)> {
    line.flat
        .windows(2)
        .enumerate()
        .filter(|(_, w)| w[0] != w[1])
        .map(|(k, w)| (k, Side { visible: line.visible, shallow: false, line: 0, from: w[0], to: w[1], start: 0.0 }))
}

/// Lets a closed row of points begin, and end, at one of them.
fn begin_at<P: Copy + PartialEq>(points: &mut Vec<P>, first: usize) {
    let shared = points.first() == points.last();
    let rest = &points[usize::from(shared)..=first];
    *points = [&points[first..], rest].concat();
}

/// Whether any side runs back along the one before it: of most lines none does.
fn runs_back(line: &Polyline) -> bool {
    let mut before: Option<Side> = None;
    for (_, side) in sides(line) {
        if before.is_some_and(|before| turns_back(&before, &side)) {
            return true;
        }
        before = Some(side);
    }
    false
}

/// Whether the second of two sides runs back along the first.
fn turns_back(before: &Side, after: &Side) -> bool {
    let [u, v] = [before, after].map(|s| [s.to[0] - s.from[0], s.to[1] - s.from[1]]);
    let (dot, cross) = (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0]);
    let (u2, v2) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    dot < 0.0 && cross * cross <= PARALLEL * PARALLEL * u2 * v2
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTHS: Widths = Widths { same: 0.01, under: 0.01 };

    fn line(points: &[[f64; 2]]) -> Polyline {
        let space = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Polyline { flat: points.to_vec(), space, ..Polyline::default() }
    }

    #[test]
    fn a_rim_from_its_middle_begins_at_its_end() {
        let mut rim = line(&[[5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 0.0]]);
        begin_at_a_turn(&mut rim, WIDTHS);
        assert_eq!(rim.flat, [[10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
        assert_eq!(rim.space[1], [5.0, 0.001, 0.0]);
    }

    #[test]
    fn ends_that_differ_in_the_last_digit_and_vertices_there_twice_make_no_difference() {
        let mut rim = line(&[[5.0, 0.0], [10.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 1e-9]]);
        begin_at_a_turn(&mut rim, WIDTHS);
        assert_eq!(
            rim.flat,
            [[10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 1e-9], [5.0, 0.0], [10.0, 0.0], [10.0, 0.0]]
        );
        assert_eq!(rim.space.len(), rim.flat.len());
    }

    #[test]
    fn of_a_rim_that_is_hidden_in_part_the_longest_way_is_left() {
        for first in [[3.0, 0.0], [7.0, 0.0]] {
            let mut rim = line(&[first, [0.0, 0.0], [5.0, 0.001], [10.0, 0.0], [8.0, 0.0]]);
            begin_at_a_turn(&mut rim, WIDTHS);
            assert_eq!(rim.flat, [[0.0, 0.0], [5.0, 0.001], [10.0, 0.0]]);
            assert_eq!(rim.space.len(), 3);
        }
    }

    #[test]
    fn other_lines_begin_where_they_did() {
        let square = line(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]]);
        // A needle beside its start, and a rim that begins at its end already.
        let needle = line(&[[0.0, 0.0], [4.0, 0.0], [10.0, 0.0], [6.0, 0.5], [6.0, 8.0], [0.0, 8.0], [0.0, 0.0]]);
        let rim = line(&[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0]]);
        // A way back that lies beside the way there.
        let beside = line(&[[3.0, 0.5], [0.0, 0.0], [10.0, 0.0]]);
        for line in [square, needle, rim, beside] {
            let mut same = line.clone();
            begin_at_a_turn(&mut same, WIDTHS);
            assert_eq!(same, line);
        }
    }
}
