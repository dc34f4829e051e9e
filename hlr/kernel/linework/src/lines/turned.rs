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
//! Edges with dents turn back several times. The longest way between two turns is left of what they cover:
//!
//! ```text
//!          <---- 3 ----.        a closed line begins with way 2; of an open one, what lies along way 2 at its ends
//!     --------- 2 ------>       is left out
//!     <-- 1 --
//! ```

use super::gaps::{Side, Widths, along, at};
use super::stretches::{PARALLEL, covered, same_way};
use super::{Polyline, distance};
use hlr_accuracy::COVER_CROSSING;

/// Widths of coincidence within which the ends of a closed line lie: they may differ in the last digits.
const CLOSED: f64 = 1e-3;

/// Widths of the ink. Half of a small hidden rim would otherwise become too short for the other half to leave anything out
/// of it: what covers a shorter stretch counts as crossing.
const SHORT_HIDDEN: f64 = 3.0 * COVER_CROSSING;

/// A side, with the number of the vertex where it begins.
type Numbered = (usize, Side);

/// Lets a closed line that runs back over itself begin at a turn. Leaves out what runs back at the ends of an open one.
pub fn begin_at_a_turn(line: &mut Polyline, widths: Widths) {
    if !runs_back(line) {
        return;
    }
    let sides: Vec<Numbered> = sides(line).collect();
    let turns: Vec<usize> = (1..sides.len()).filter(|&k| turns_back(&sides[k - 1].1, &sides[k].1)).collect();
    let ways: Vec<&[Numbered]> =
        [0].iter().chain(&turns).zip(turns.iter().chain([&sides.len()])).map(|(&from, &to)| &sides[from..to]).collect();
    let last = line.flat.len() - 1;
    if distance(&line.flat[0], &line.flat[last]) <= CLOSED * widths.same {
        if let Some(first) = beginning(&ways, widths) {
            begin_at(line, first);
        }
    } else if line.visible || line.length() >= SHORT_HIDDEN * widths.under {
        let (from, to) = what_is_left(&ways, last, widths);
        line.flat = line.flat[from..=to].to_vec();
        line.space = line.space[from..=to].to_vec();
    }
}

/// The vertex at which a closed line of these ways begins instead; None where it stays as it is.
fn beginning(ways: &[&[Numbered]], widths: Widths) -> Option<usize> {
    let [first, .., last] = ways else { return None };
    let (start, end) = (&first[0].1, &last[last.len() - 1].1);
    if turns_back(end, start) {
        let longest = longest(ways.iter().map(|way| long(way)), widths);
        let goes = longest > 0 && lies_on(first, ways[longest], widths.same);
        return goes.then(|| ways[longest][0].0);
    }
    // The last way goes on as the first.
    let back = |(_, side): &Numbered| passes(side, &start.from, widths.same) && !same_way(side, start);
    if !ways[1..].iter().any(|way| way.iter().any(back)) {
        return None;
    }
    let lengths = ways[1..].iter().map(|way| long(way) + if way[0].0 == last[0].0 { long(first) } else { 0.0 });
    Some(ways[1 + longest(lengths, widths)][0].0)
}

/// The first and the last vertex of what is left of an open line of these ways.
fn what_is_left(ways: &[&[Numbered]], last: usize, widths: Widths) -> (usize, usize) {
    let longest = longest(ways.iter().map(|way| long(way)), widths);
    let most = long(ways[longest]) - widths.same;
    let goes = |way: &&&[Numbered]| long(way) < most && lies_on(way, ways[longest], widths.same);
    let before = ways[..longest].iter().take_while(goes).count();
    let after = ways[longest + 1..].iter().rev().take_while(goes).count();
    let to = ways.len() - after;
    (if before > 0 { ways[before][0].0 } else { 0 }, if after > 0 { ways[to][0].0 } else { last })
}

/// The first of the lengths that is the greatest but for the width of a line.
fn longest(lengths: impl Iterator<Item = f64> + Clone, widths: Widths) -> usize {
    let most = lengths.clone().fold(0.0, f64::max);
    lengths.into_iter().position(|length| length >= most - widths.same).unwrap_or(0)
}

/// Whether another way covers all of one.
fn lies_on(way: &[Numbered], other: &[Numbered], width: f64) -> bool {
    // Where one side was covered, the next one is, or not far from there.
    let mut here = 0usize;
    way.iter().all(|(_, side)| {
        let mut done = 0.0;
        while done < 1.0 {
            let around = (0..other.len()).flat_map(|far| [here.checked_sub(far), Some(here + far + 1)]).flatten();
            let next = around.filter(|&k| k < other.len()).find_map(|k| {
                let (from, to) = covered(side, &other[k].1, width, width)?;
                (from <= done && to > done).then_some((k, to))
            });
            let Some((k, to)) = next else { return false };
            (here, done) = (k, to);
        }
        true
    })
}

/// Whether a side goes through a point.
fn passes(side: &Side, point: &[f64; 2], width: f64) -> bool {
    distance(&at(side, along(side, point).clamp(0.0, 1.0)), point) <= width
}

fn long(way: &[Numbered]) -> f64 {
    way.iter().map(|(_, s)| s.length()).sum()
}

/// The sides of a line that have a length, with the number of the vertex where each begins.
fn sides(line: &Polyline) -> impl Iterator<Item = Numbered> {
    line.flat
        .windows(2)
        .enumerate()
        .filter(|(_, w)| w[0] != w[1])
        .map(|(k, w)| (k, Side { visible: line.visible, shallow: false, line: 0, from: w[0], to: w[1], start: 0.0 }))
}

/// Lets a closed line begin, and end, at one of its vertices.
fn begin_at(line: &mut Polyline, first: usize) {
    // Ends that are one on paper may differ by rounding in space.
    let shared = line.flat.first() == line.flat.last() && line.space.first() == line.space.last();
    line.flat = begun_at(&line.flat, first, shared);
    line.space = begun_at(&line.space, first, shared);
}

fn begun_at<P: Copy>(points: &[P], first: usize, shared: bool) -> Vec<P> {
    [&points[first..], &points[usize::from(shared)..=first]].concat()
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
    fn of_a_dented_edge_the_longest_way_is_left() {
        let x = |places: &[f64]| line(&places.iter().map(|&x| [x, 0.0]).collect::<Vec<_>>());
        let dent = [5.0, 7.0, 0.0, 10.0, 3.0, 5.0];
        for first in 0..5 {
            let mut closed = x(&[&dent[first..5], &dent[..=first]].concat());
            begin_at_a_turn(&mut closed, WIDTHS);
            assert_eq!(closed.flat[..2], [[0.0, 0.0], [10.0, 0.0]], "{first}");
            assert_eq!((closed.flat.len(), closed.flat.first()), (6, closed.flat.last()));
        }
        let mut open = x(&[3.0, 5.0, 0.0, 10.0, 4.0, 8.0]);
        begin_at_a_turn(&mut open, WIDTHS);
        assert_eq!(open.flat, [[0.0, 0.0], [10.0, 0.0]]);
        let mut beyond = x(&[-1.0, 5.0, 0.0, 10.0, 4.0, 8.0]);
        begin_at_a_turn(&mut beyond, WIDTHS);
        assert_eq!(beyond.flat, [[-1.0, 0.0], [5.0, 0.0], [0.0, 0.0], [10.0, 0.0]]);
    }

    #[test]
    fn a_short_hidden_line_keeps_its_ends() {
        for (size, left) in [(0.1, 3), (0.2, 2)] {
            let mut hidden = line(&[[0.3 * size, 0.0], [0.0, 0.0], [size, 0.0]]);
            let mut seen = Polyline { visible: true, ..hidden.clone() };
            begin_at_a_turn(&mut hidden, WIDTHS);
            begin_at_a_turn(&mut seen, WIDTHS);
            assert_eq!((hidden.flat.len(), seen.flat.len()), (left, 2));
        }
    }

    #[test]
    fn ends_that_are_one_on_paper_alone_are_both_kept() {
        let mut rim = line(&[[5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 0.0]]);
        rim.space[4][2] = 1e-16;
        begin_at_a_turn(&mut rim, WIDTHS);
        assert_eq!(rim.flat, [[10.0, 0.0], [5.0, 0.001], [0.0, 0.0], [5.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
        assert!(rim.flat.iter().zip(&rim.space).all(|(f, s)| f[0] == s[0]));
    }

    #[test]
    fn other_lines_begin_where_they_did() {
        let square = line(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]]);
        // A needle beside its start, and a rim that begins at its end already.
        let needle = line(&[[0.0, 0.0], [4.0, 0.0], [10.0, 0.0], [6.0, 0.5], [6.0, 8.0], [0.0, 8.0], [0.0, 0.0]]);
        let rim = line(&[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0]]);
        // A way back that lies beside the way there.
        let beside = line(&[[3.0, 0.5], [0.0, 0.0], [10.0, 0.0]]);
        // Both ends of the way back lie on the way there, but the middle does not.
        let bent = line(&[[3.0, 0.0], [0.0, 0.0], [1.5, 0.6], [3.0, 0.0], [10.0, 0.0]]);
        for line in [square, needle, rim, beside, bent] {
            let mut same = line.clone();
            begin_at_a_turn(&mut same, WIDTHS);
            assert_eq!(same, line);
        }
    }
}
