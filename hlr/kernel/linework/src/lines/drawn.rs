//! The sides of lines that are drawn so far, in square cells of the paper.

use super::cells::Cells;
use super::gaps::{Side, Widths};
use super::members::{Gaps, Member};

pub(super) struct Drawn<'a> {
    sides: &'a [Side],
    cells: Cells,
    members: Vec<Vec<Member>>,
    /// How far beside a side is looked, mm.
    reach: f64,
    /// The last side that each side was near to.
    met: Vec<u32>,
}

impl<'a> Drawn<'a> {
    /// None drawn yet. None where a coordinate is no number.
    pub(super) fn none_of(sides: &'a [Side], reach: f64) -> Option<Drawn<'a>> {
        let cells = Cells::of(sides, reach)?;
        let (members, met) = (vec![Vec::new(); cells.columns * cells.rows], vec![u32::MAX; sides.len()]);
        Some(Drawn { sides, cells, members, reach, met })
    }

    /// How near the boxes of sides come where the one may cover the other.
    pub(super) fn gaps(&self, widths: Widths) -> Gaps {
        Gaps::of(&self.cells, widths)
    }

    pub(super) fn member(&self, side: u32) -> Member {
        Member::of(side, &self.sides[side as usize], &self.cells.low)
    }

    pub(super) fn add(&mut self, side: u32) {
        let member = self.member(side);
        self.each(side, 0.0, |members| {
            if members.last().is_none_or(|last| last.side != side) {
                members.push(member);
            }
        });
    }

    pub(super) fn remove(&mut self, side: u32) {
        self.each(side, 0.0, |members| members.retain(|member| member.side != side));
    }

    /// Calls `visit` with each drawn side that may come within reach of a side, of those that are `asked` for.
    pub(super) fn each_near(&mut self, side: u32, asked: impl Fn(&Member) -> bool, mut visit: impl FnMut(u32)) {
        let mut met = std::mem::take(&mut self.met);
        self.each(side, self.reach, |members| {
            for other in members.iter().filter(|member| asked(member)).map(|member| member.side) {
                if met[other as usize] != side {
                    met[other as usize] = side;
                    visit(other);
                }
            }
        });
        self.met = met;
    }

    /// Calls `visit` with the members of the cells that a side comes as near to as `reach`, maybe more than once.
    fn each(&mut self, side: u32, reach: f64, mut visit: impl FnMut(&mut Vec<Member>)) {
        let (cells, members) = (&self.cells, &mut self.members);
        cells.each(&self.sides[side as usize], reach, |column, row| visit(&mut members[row * cells.columns + column]));
    }
}

#[cfg(test)]
mod tests {
    use super::super::distance;
    use super::*;

    /// Sides of all lengths, scattered by a congruential generator.
    fn scattered(count: u32) -> Vec<Side> {
        let mut state = 1u32;
        let mut next = |size: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            size * f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut side = |line: u32| {
            let (from, size) = ([next(100.0), next(60.0)], [0.1, 2.0, 50.0][line as usize % 3]);
            let to = [from[0] + next(size), from[1] + next(size)];
            Side { visible: true, shallow: false, line, from, to, start: 0.0 }
        };
        (0..count).map(&mut side).collect()
    }

    fn nearest(a: &Side, b: &Side) -> f64 {
        let at = |s: &Side, u: f64| [0, 1].map(|k| s.from[k] + u * (s.to[k] - s.from[k]));
        let places = (0..=100).map(|i| f64::from(i) / 100.0);
        let to_b = |p: [f64; 2]| {
            let (x, y) = (b.to[0] - b.from[0], b.to[1] - b.from[1]);
            let u = (x * (p[0] - b.from[0]) + y * (p[1] - b.from[1])) / (x * x + y * y);
            distance(&p, &at(b, u.clamp(0.0, 1.0)))
        };
        places.map(|u| to_b(at(a, u))).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn what_is_drawn_within_reach_is_found_and_what_was_removed_is_not() {
        let sides = scattered(300);
        let mut drawn = Drawn::none_of(&sides, 0.4).expect("numbers");
        (0..200).for_each(|side| drawn.add(side));
        (0..200).step_by(5).for_each(|side| drawn.remove(side));
        let mut near = |side: u32| {
            let mut found = Vec::new();
            drawn.each_near(side, |_| true, |other| found.push(other));
            found.sort_unstable();
            found
        };
        let (mut close, mut looked_at) = (0, 0);
        for side in 200..300 {
            let found = near(side);
            looked_at += found.len();
            assert!(found.windows(2).all(|w| w[0] < w[1]) && found.iter().all(|s| s % 5 != 0 && *s < 200));
            for other in (0..200).filter(|s| s % 5 != 0) {
                if nearest(&sides[side as usize], &sides[other as usize]) < 0.4 {
                    close += 1;
                    assert!(found.contains(&other), "{side} {other}");
                }
            }
        }
        assert!(close > 100);
        assert!(looked_at < 100 * 40, "{looked_at} of 16,000 are looked at");
    }

    #[test]
    fn sides_that_are_no_numbers_are_left_alone() {
        let mut sides = scattered(3);
        sides[1].to[0] = f64::NAN;
        assert!(Drawn::none_of(&sides, 0.4).is_none());
        assert!(Drawn::none_of(&[], 0.4).is_none());
    }
}
