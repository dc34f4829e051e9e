//! Keeps one of several lines that coincide on paper: the front view of a box is four lines, not eight.
//!
//! A line is left out where a better one (lower rank: visible first, then kind, then nearer) runs close to it in nearly
//! the same direction. Ranks are a strict order, so of two lines exactly one is left out. Only drawn lines count as
//! better: the best are decided first, so that a stack of close lines does not vanish as a whole. Lines of one
//! visibility are close if they coincide; a hidden line also if it lies under the width of a visible line, and a shallow
//! intersection line if it is as near to a line of its own parts (`owners`).
//!
//! ```text
//!   better  ===================
//!   worse        - - - - - - - - - - - -      left out on the left, drawn on the right
//! ```

use rayon::prelude::*;

use super::drawn::Drawn;
pub use super::gaps::Widths;
use super::gaps::{Covered, Side, along, at, gaps, rest, still_there};
use super::members::Member;
use super::owners::Order;
use super::pairs::{Pair, pairs};
use super::stretches::{Stretches, same_way};
use super::{Polyline, View, distance};

/// Removes the stretches that better lines cover. `order`: of lines[i]; ranks are distinct.
pub fn uncovered(lines: Vec<Polyline>, order: &Order, widths: Widths, view: &View) -> Vec<Polyline> {
    let gone = covered_by_better(&lines, order, widths, view);
    let cut = |(line, gaps): (&Polyline, &Vec<Covered>)| (!gaps.is_empty()).then(|| rest(line, gaps, widths, view));
    let pieces: Vec<Option<Vec<Polyline>>> = lines.par_iter().zip(&gone).map(cut).collect();
    let mut out = Vec::with_capacity(lines.len());
    for (line, pieces) in lines.into_iter().zip(pieces) {
        match pieces {
            None => out.push(line),
            Some(pieces) => out.extend(pieces),
        }
    }
    out
}

/// The stretches of each line that better ones cover, ascending.
///
/// Lines are decided one after another, the best first, and a side covers nothing once it is left out itself. Which sides
/// cover which others is found before, for all at once. If there are too many, each line is compared with what is drawn
/// so far alone: so a thousand lines that all cover one another take a thousand comparisons, and not a million.
fn covered_by_better(lines: &[Polyline], order: &Order, widths: Widths, view: &View) -> Vec<Vec<Covered>> {
    let (mut sides, mut first_side) = (Vec::new(), vec![0]);
    for (i, line) in lines.iter().enumerate() {
        let (mut start, shallow) = (0.0, order.owners[i].shallow);
        for w in line.flat.windows(2) {
            sides.push(Side { visible: line.visible, shallow, line: i as u32, from: w[0], to: w[1], start });
            start += distance(&w[0], &w[1]);
        }
        first_side.push(sides.len());
    }
    let stretches = Stretches { order: *order, widths, reach: widths.under.max(widths.same) };
    let cutting = Cutting { lines, sides: &sides, first_side: &first_side, stretches, view };
    match pairs(&sides, &cutting.stretches) {
        Some(pairs) => cutting.by_pairs(&pairs),
        None => cutting.by_drawn(),
    }
}

/// The lines, side by side, of which stretches are cut out. The sides of line i are first_side[i]..first_side[i + 1].
struct Cutting<'a> {
    lines: &'a [Polyline],
    sides: &'a [Side],
    first_side: &'a [usize],
    stretches: Stretches<'a>,
    view: &'a View,
}

impl Cutting<'_> {
    /// The numbers of the lines, the best first.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.lines.len()).collect();
        order.par_sort_unstable_by_key(|&i| self.stretches.order.rank[i]);
        order
    }

    fn by_pairs(&self, pairs: &[Pair]) -> Vec<Vec<Covered>> {
        let (mut gone, mut removed) = (vec![Vec::new(); self.lines.len()], vec![false; self.sides.len()]);
        // The pairs of each line are a run: their sides ascend.
        let mut runs = vec![0..0; self.lines.len()];
        let mut end = 0;
        for run in pairs.chunk_by(|a, b| self.line_of(a.side) == self.line_of(b.side)) {
            runs[self.line_of(run[0].side)] = end..end + run.len();
            end += run.len();
        }
        let mut covered = Vec::new();
        for i in self.order() {
            covered.clear();
            // The sides of this line that lie on an earlier turn of it.
            let mut around = vec![];
            for of_side in pairs[runs[i].clone()].chunk_by(|a, b| a.side == b.side) {
                let first = covered.len();
                for pair in of_side.iter().filter(|pair| !removed[pair.by as usize] && !self.is_idle(pair, &around)) {
                    self.cover(pair, &gone, &mut covered);
                }
                if self.lies_on_another_turn(of_side[0].side, &covered[first..]) {
                    around.push(of_side[0].side);
                }
            }
            if !covered.is_empty() {
                self.cut_out(i, &mut covered, &mut gone, |side| removed[side] = true);
            }
        }
        gone
    }

    fn by_drawn(&self) -> Vec<Vec<Covered>> {
        let mut gone = vec![Vec::new(); self.lines.len()];
        let Some(mut drawn) = Drawn::none_of(self.sides, self.stretches.reach) else { return gone };
        let gaps = drawn.gaps(self.stretches.widths);
        let mut covered = Vec::new();
        for i in self.order() {
            covered.clear();
            let mut around = vec![];
            for side in (self.first_side[i] as u32)..self.first_side[i + 1] as u32 {
                let first = covered.len();
                let member = drawn.member(side);
                let may_cover = |by: &Member| by.may_cover(&member, &gaps);
                drawn.each_near(side, may_cover, |by| {
                    let own = self.stretches.order(self.sides, side, by) == Some((side, by));
                    let [worse, better] = [side, by].map(|s| &self.sides[s as usize]);
                    if own && let Some((from, to)) = self.stretches.covered(worse, better) {
                        let pair = Pair { side, by, from, to };
                        if !self.is_idle(&pair, &around) {
                            self.cover(&pair, &gone, &mut covered);
                        }
                    }
                });
                drawn.add(side);
                if self.lies_on_another_turn(side, &covered[first..]) {
                    around.push(side);
                }
            }
            if !covered.is_empty() {
                self.cut_out(i, &mut covered, &mut gone, |side| drawn.remove(side as u32));
            }
        }
        gone
    }

    /// Whether earlier turns of its own line cover all of a side. covered: its stretches that are covered.
    fn lies_on_another_turn(&self, side: u32, covered: &[Covered]) -> bool {
        let one = &self.sides[side as usize];
        let turn = |c: &&Covered| c.own && c.by.iter().all(|&by| same_way(one, &self.sides[by as usize]));
        let mut turns: Vec<&Covered> = covered.iter().filter(turn).collect();
        turns.sort_unstable_by(|a, b| a.from.total_cmp(&b.from));
        let reached = turns.iter().fold(one.start, |here, c| if c.from <= here { here.max(c.to) } else { here });
        !turns.is_empty() && reached >= one.start + one.length()
    }

    /// Whether the better of two turns of one line lies on another turn itself, one of `around` (ascending): it then
    /// covers no later one, for turns close together must not all vanish but the first.
    fn is_idle(&self, pair: &Pair, around: &[u32]) -> bool {
        let [side, better] = [pair.side, pair.by].map(|s| &self.sides[s as usize]);
        around.binary_search(&pair.by).is_ok() && same_way(side, better)
    }

    fn line_of(&self, side: u32) -> usize {
        self.sides[side as usize].line as usize
    }

    /// Leaves the covered stretches out of line i, and tells which of its sides are left out whole.
    fn cut_out(&self, i: usize, covered: &mut [Covered], gone: &mut [Vec<Covered>], mut left_out: impl FnMut(usize)) {
        let wide = !self.lines[i].visible || self.stretches.order.owners[i].shallow;
        gone[i] = gaps(covered, &self.lines[i], self.sides, wide, self.stretches.widths, self.view);
        let own = self.first_side[i]..self.first_side[i + 1];
        own.filter(|&side| self.sides[side].within_one_of(&gone[i])).for_each(&mut left_out);
    }

    /// Adds what a pair covers. gone: of each line the stretches that are left out, where it covers nothing.
    fn cover(&self, pair: &Pair, gone: &[Vec<Covered>], out: &mut Vec<Covered>) {
        let [side, better] = [pair.side, pair.by].map(|s| &self.sides[s as usize]);
        let (length, own) = (side.length(), side.line == better.line);
        let mut put = |from: f64, to: f64| {
            out.push(Covered { from: side.start + from * length, to: side.start + to * length, own, by: [pair.by; 2] });
        };
        let gone = &gone[better.line as usize];
        if own || gone.is_empty() {
            return put(pair.from, pair.to);
        }
        let place = |u: f64| better.start + along(better, &at(side, u)).clamp(0.0, 1.0) * better.length();
        still_there(pair.from, pair.to, [place(pair.from), place(pair.to)], gone, put);
    }
}

#[cfg(test)]
mod tests {
    use super::super::owners::Owners;
    use super::*;

    const PARALLEL_VIEW: View = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };

    /// Lines of parts that nothing is sunk into.
    fn strangers(count: usize) -> Vec<Owners> {
        (0..count as i32).map(|part| Owners { parts: [part, -1], shallow: false }).collect()
    }

    fn drawn(lines: Vec<Polyline>, rank: &[u32], widths: Widths, view: &View) -> Vec<Polyline> {
        let owners = strangers(lines.len());
        uncovered(lines, &Order { rank, owners: &owners }, widths, view)
    }

    #[test]
    fn a_line_back_over_itself_is_drawn_once() {
        let rim = line(true, &[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [5.0, 0.001], [0.0, 0.0]]);
        let rest = drawn(vec![rim], &[0], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 1);
        assert_eq!(rest[0].flat, [[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
    }

    #[test]
    fn a_line_that_runs_around_over_itself_is_drawn_once() {
        let square = |a: f64| [[-a, -a], [10.0 + a, -a], [10.0 + a, 10.0 + a], [-a, 10.0 + a]];
        let widths = Widths { same: 0.01, under: 0.01 };
        let lines = |turns: u32, climb: f64| {
            let mut points: Vec<[f64; 2]> = (0..turns).flat_map(|k| square(climb * f64::from(k))).collect();
            points.push(points[0]);
            drawn(vec![line(true, &points)], &[0], widths, &PARALLEL_VIEW)
        };
        let once = lines(1, 0.0);
        assert_eq!((once.len(), once[0].flat.len()), (1, 5), "closed, and not cut at its ends");
        // So many turns are too many for pairs.
        for turns in [2, 5, 300] {
            let rest = lines(turns, 0.0);
            assert_eq!(rest.len(), 1, "{turns}");
            assert!((rest[0].length() - 40.0).abs() < 0.1, "{turns}");
        }
        // Of turns beside one another, both stay; of those closer together than they can be told apart, each second one.
        let length = |turns, climb| lines(turns, climb).iter().map(Polyline::length).sum::<f64>();
        assert!(length(2, 0.05) > 70.0);
        assert!((length(40, 0.006) - 20.0 * 40.0).abs() < 20.0, "{}", length(40, 0.006));
    }

    #[test]
    fn what_another_line_covers_leaves_a_gap() {
        // The ends at the gap are near each other, but must not be joined.
        let bent = line(false, &[[0.0, -1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 0.02], [0.0, 0.02], [0.0, 1.0]]);
        let ink = line(true, &[[-0.1, 0.01], [1.1, 0.01]]);
        let rest = drawn(vec![ink, bent], &[0, 1], Widths { same: 0.005, under: 0.02 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 3);
    }

    fn line(visible: bool, points: &[[f64; 2]]) -> Polyline {
        let space = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Polyline { visible, flat: points.to_vec(), space, ..Polyline::default() }
    }

    #[test]
    fn coincident_lines_are_drawn_once() {
        let lines = vec![
            line(true, &[[0.0, 0.0], [10.0, 0.0]]),
            line(false, &[[10.0, 0.0], [4.0, 0.0], [4.0, 5.0]]),
            line(false, &[[6.0, 0.001], [20.0, 0.001]]),
        ];
        let rest = drawn(lines, &[0, 1, 2], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest.len(), 3);
        assert_eq!(rest[1].flat[1], [4.0, 5.0]);
        assert!((rest[1].flat[0][1]).abs() < 0.05);
        assert!((rest[2].flat[0][0] - 10.01).abs() < 0.05 && rest[2].flat[1][0] == 20.0);
    }

    #[test]
    fn an_end_that_comes_off_by_little_goes_too_but_none_beyond_the_end_of_the_other_line() {
        let widths = Widths { same: 0.02, under: 0.02 };
        let straight = || line(true, &[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
        let left = |points: &[[f64; 2]]| {
            let rest = drawn(vec![straight(), line(true, points)], &[0, 1], widths, &PARALLEL_VIEW);
            rest[1..].iter().map(Polyline::length).sum::<f64>()
        };
        // It comes off within the accuracy, which is twice the width.
        assert_eq!(left(&[[2.0, 0.0], [4.0, 0.0], [4.16, 0.036]]), 0.0);
        assert_eq!(left(&[[4.84, 0.036], [5.0, 0.0], [6.0, 0.0]]), 0.0);
        assert!(left(&[[2.0, 0.0], [4.0, 0.0], [4.16, 0.05]]) > 0.05);
        assert!(left(&[[2.0, 0.0], [4.0, 0.0], [4.5, 0.036]]) > 0.15);
        assert!((left(&[[2.0, 0.0], [10.0, 0.0], [10.13, 0.0]]) - 0.13).abs() < 0.03);
    }

    #[test]
    fn crossing_lines_are_left_alone() {
        let lines = vec![line(true, &[[0.0, 0.0], [10.0, 0.0]]), line(false, &[[0.0, -2.0], [10.0, 2.0]])];
        let rest = drawn(lines.clone(), &[0, 1], Widths { same: 0.01, under: 0.01 }, &PARALLEL_VIEW);
        assert_eq!(rest, lines);
    }

    #[test]
    fn the_pairs_of_all_sides_give_what_is_drawn_one_by_one() {
        // Short lines in few directions, rounded to a coarse grid: many coincide.
        let mut state = 7u32;
        let mut next = |most: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from((state >> 10) % most)
        };
        let lines: Vec<Polyline> = (0..900)
            .map(|_| {
                let at = [next(60), next(40)];
                let to = [at[0] + next(9), at[1] + next(2)];
                line(next(2) > 0.0, &[at, to, [to[0] + next(3) - 4.0, to[1]]])
            })
            .collect();
        let rank: Vec<u32> = (0..lines.len() as u32).map(|i| i * 7 % 900).collect();
        let (mut sides, mut first_side) = (Vec::new(), vec![0]);
        for (i, one) in lines.iter().enumerate() {
            let mut start = 0.0;
            for w in one.flat.windows(2) {
                sides.push(Side { visible: one.visible, shallow: false, line: i as u32, from: w[0], to: w[1], start });
                start += distance(&w[0], &w[1]);
            }
            first_side.push(sides.len());
        }
        let widths = Widths { same: 0.01, under: 0.2 };
        let owners = strangers(lines.len());
        let order = Order { rank: &rank, owners: &owners };
        let stretches = Stretches { order, widths, reach: 0.2 };
        let all = pairs(&sides, &stretches).expect("not too many");
        let cutting =
            Cutting { lines: &lines, sides: &sides, first_side: &first_side, stretches, view: &PARALLEL_VIEW };
        let plain = |gone: Vec<Vec<Covered>>| -> Vec<Vec<(f64, f64)>> {
            gone.iter().map(|line| line.iter().map(|c| (c.from, c.to)).collect()).collect()
        };
        let (found, wanted) = (plain(cutting.by_pairs(&all)), plain(cutting.by_drawn()));
        assert!(found.iter().filter(|line| !line.is_empty()).count() > 300);
        assert_eq!(found, wanted);
    }

    #[test]
    fn a_stack_of_lines_is_too_many_for_pairs_and_is_drawn_once() {
        let lines: Vec<Polyline> = (0..3000).map(|_| line(true, &[[0.0, 0.0], [10.0, 0.0]])).collect();
        let sides: Vec<Side> = (0..3000)
            .map(|line| Side { visible: true, shallow: false, line, from: [0.0, 0.0], to: [10.0, 0.0], start: 0.0 })
            .collect();
        let rank: Vec<u32> = (0..3000).collect();
        let widths = Widths { same: 0.01, under: 0.2 };
        let owners = strangers(lines.len());
        let order = Order { rank: &rank, owners: &owners };
        assert_eq!(pairs(&sides, &Stretches { order, widths, reach: 0.2 }), None);
        assert_eq!(drawn(lines, &rank, widths, &PARALLEL_VIEW).len(), 1);
    }
}
