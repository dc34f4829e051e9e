//! Which lines meet at their ends. Ends meet where they are no farther apart than a tolerance in x and in y; some that
//! are up to twice as far apart count as well, so that what belongs together is never taken apart.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::grid::rounded;
use crate::fit::plane::{Vec2, dot, length, minus};
use crate::lines::drawing::{Line, Lines};
use hlr_brep::sets::Sets;

/// Lines go on from one another where they turn by at most 30 degrees: the cosine.
const STRAIGHT: f64 = 0.866;

/// At a place with more ends than this all lines count as going on from one another: pairs would take too long.
const MOST_ENDS: usize = 16;

struct End {
    line: usize,
    visible: bool,
    at: Vec2,
    /// Where the line leaves to, length 1.
    away: Vec2,
}

/// For each line a number that those share which belong together: of one visibility, ends meeting. chosen: those that
/// are looked at; sought: what does not meet one of these may stay alone; straight: only where one goes on from the
/// other without a bend. tolerance: steps
pub fn joined(
    lines: &Lines,
    chosen: impl Fn(usize) -> bool + Sync,
    sought: impl Fn(usize) -> bool + Sync,
    tolerance: f64,
    straight: bool,
) -> Vec<usize> {
    let mut sets = Sets::new(lines.0.len());
    let all = (0..lines.0.len()).all(|i| !chosen(i) || sought(i));
    // The cells of ends that are sought, and those around them: what lies elsewhere does not meet one.
    let cell_of = |at: &Vec2| at.map(|c| (c / tolerance / 2.0).floor() as i64);
    let mut around = FxHashSet::default();
    if !all {
        let some = (0..lines.0.len()).filter(|&i| chosen(i) && sought(i)).flat_map(|i| ends(i, &lines.0[i], |_| true));
        for [x, y] in some.map(|end| cell_of(&end.at)) {
            (-1..=1).for_each(|i| around.extend((-1..=1).map(|j| [x + i, y + j])));
        }
    }
    let near = |at: &Vec2| all || around.contains(&cell_of(at));
    let ends: Vec<End> = lines
        .0
        .par_iter()
        .enumerate()
        .filter(|(i, _)| chosen(*i))
        .flat_map_iter(|(i, line)| ends(i, line, near))
        .collect();
    // Two ends within half a cell of one another share a cell of at least one of four grids, each shifted by half a cell.
    for shift in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let cell = |end: &End| (end.visible, [0, 1].map(|i| ((end.at[i] / tolerance + shift[i]) / 2.0).floor() as i64));
        // Ends of one cell stand side by side, in the order of lines.
        let mut cells: Vec<_> = ends.par_iter().enumerate().map(|(n, end)| (cell(end), n)).collect();
        cells.par_sort_unstable();
        for found in cells.chunk_by(|a, b| a.0 == b.0) {
            let first = &ends[found[0].1];
            if !straight || found.len() > MOST_ENDS {
                found.iter().for_each(|(_, n)| sets.unite(first.line, ends[*n].line));
                continue;
            }
            for (i, (_, a)) in found.iter().enumerate() {
                let a = &ends[*a];
                let before = found[..i].iter().map(|(_, b)| &ends[*b]);
                before.filter(|b| dot(&a.away, &b.away) < -STRAIGHT).for_each(|b| sets.unite(a.line, b.line));
            }
        }
    }
    (0..lines.0.len()).map(|i| sets.first(i)).collect()
}

/// The ends of a line that are `looked_at`, and where it leaves to from each; none of a line that is a point.
fn ends(number: usize, line: &Line, looked_at: impl Fn(&Vec2) -> bool) -> impl Iterator<Item = End> {
    let points = line.flat.iter().map(rounded);
    let first = end(number, line.visible, points.clone(), &looked_at);
    first.into_iter().chain(end(number, line.visible, points.rev(), &looked_at))
}

/// The end of a line where its points begin.
fn end(
    line: usize,
    visible: bool,
    mut points: impl Iterator<Item = Vec2>,
    looked_at: impl Fn(&Vec2) -> bool,
) -> Option<End> {
    let at = points.next().filter(looked_at)?;
    let way = minus(&points.find(|p| *p != at)?, &at);
    Some(End { line, visible, at, away: way.map(|c| c / length(&way)) })
}
