//! Which lines meet at their ends. Ends meet where they are no farther apart than a tolerance in x and in y; some that
//! are up to twice as far apart count as well, so that what belongs together is never taken apart.

use std::collections::HashMap;

use super::grid::rounded;
use crate::fit::plane::{Vec2, dot, length, minus};
use crate::lines::drawing::Lines;

/// Lines go on from one another where they turn by at most 30 degrees: the cosine.
const STRAIGHT: f64 = 0.866;

/// At a place with more ends than this all lines count as going on from one another: pairs would take too long.
const MOST_ENDS: usize = 16;

struct End {
    line: usize,
    /// Where the line leaves to, length 1.
    away: Vec2,
}

/// For each line a number that those share which belong together: of one visibility, ends meeting. straight: only
/// where one goes on from the other without a bend. tolerance: steps
pub fn joined(lines: &Lines, chosen: &[bool], tolerance: f64, straight: bool) -> Vec<usize> {
    let mut sets = Sets((0..lines.0.len()).collect());
    // Two ends within half a cell of one another share a cell of at least one of four grids, each shifted by half a cell.
    for shift in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let mut at: HashMap<(bool, [i64; 2]), Vec<End>> = HashMap::new();
        for (number, line) in lines.0.iter().enumerate().filter(|(i, _)| chosen[*i]) {
            for (end, away) in ends(&line.flat) {
                let cell = [0, 1].map(|i| ((end[i] / tolerance + shift[i]) / 2.0).floor() as i64);
                at.entry((line.visible, cell)).or_default().push(End { line: number, away });
            }
        }
        // The sets do not depend on the order in which cells come: each cell's ends are in the order of lines.
        for found in at.values() {
            if !straight || found.len() > MOST_ENDS {
                found.iter().for_each(|end| sets.unite(found[0].line, end.line));
                continue;
            }
            for (i, a) in found.iter().enumerate() {
                found[..i]
                    .iter()
                    .filter(|b| dot(&a.away, &b.away) < -STRAIGHT)
                    .for_each(|b| sets.unite(a.line, b.line));
            }
        }
    }
    (0..lines.0.len()).map(|i| sets.root(i)).collect()
}

/// Both ends of a line, and where it leaves to from each.
fn ends(flat: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    let mut points: Vec<Vec2> = flat.iter().map(rounded).collect();
    points.dedup();
    let end = |from: &Vec2, to: &Vec2| {
        let way = minus(to, from);
        (*from, way.map(|c| c / length(&way)))
    };
    let both = match points.as_slice() {
        [] | [_] => None,
        [a, b, ..] => Some([end(a, b), end(&points[points.len() - 1], &points[points.len() - 2])]),
    };
    both.into_iter().flatten()
}

/// Sets that are united; the least member stands for each.
struct Sets(Vec<usize>);

impl Sets {
    fn root(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}
