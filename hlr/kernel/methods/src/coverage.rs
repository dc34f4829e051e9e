//! Pixel ownership: a polygon owns the pixels whose centres lie inside it.
//!
//! A centre on an edge that two polygons share belongs to exactly one of them. Rows are cut half-open, an edge covers
//! the rows y_min <= y < y_max, and so are columns: of the crossings x0 and x1 of a row the pixels x0 <= x < x1 are
//! between them. So top and left edges own their pixels, bottom and right ones do not:
//!
//! ```text
//!      + - - - - +
//!      | o o o o .      o  owned
//!      | o o o o .      .  the right neighbour's, or the one's below
//!      + . . . . +
//! ```
//!
//! Horizontal edges cover no row and are never looked at. A sliver owns what it contains and nothing else.

use super::edge::{Edge, insertion_sort};
use super::plane::{centre, first_centre};
use super::scene::Rule;
use super::screen::{Facet, Screen};

/// All edges of a facet that cover rows within [row, end), each at its first one.
pub fn edges_of(screen: &Screen, number: u32, row: i32, end: i32, mut take: impl FnMut(i32, Edge)) {
    let facet = &screen.facets[number as usize];
    let mut k = 0;
    for l in screen.loops_of(facet) {
        for (i, p) in l.iter().enumerate() {
            let q = &l[if i + 1 == l.len() { 0 } else { i + 1 }];
            if let Some(edge) = Edge::new(p, q, number, k, row, end) {
                take(first_centre(p[1].min(q[1])).max(row), edge);
            }
            k += 1;
        }
    }
}

/// Scratch memory for `runs`.
#[derive(Default)]
pub struct Scratch {
    waiting: Vec<(i32, Edge)>,
    active: Vec<Edge>,
}

/// The runs of pixels [from, to) of each row that a facet owns, within a window of columns and rows; `visit` is called
/// row by row from the top, left to right, and ends the walk by returning false.
pub fn runs(
    screen: &Screen,
    number: u32,
    columns: [i32; 2],
    rows: [i32; 2],
    scratch: &mut Scratch,
    mut visit: impl FnMut(i64, i64, i64) -> bool,
) {
    let facet = &screen.facets[number as usize];
    let (low, high) = (i64::from(columns[0].max(facet.columns[0])), i64::from(columns[1].min(facet.columns[1])));
    let (first, end) = (rows[0].max(facet.rows[0]), rows[1].min(facet.rows[1]));
    if low >= high || first >= end {
        return;
    }
    let Scratch { waiting, active } = scratch;
    waiting.clear();
    active.clear();
    edges_of(screen, number, first, end, |row, edge| waiting.push((row, edge)));
    waiting.sort_unstable_by_key(|&(row, _)| std::cmp::Reverse(row));
    for row in first..end {
        active.retain(|e| e.end > row);
        while waiting.last().is_some_and(|&(start, _)| start == row) {
            active.extend(waiting.pop().map(|(_, e)| e));
        }
        insertion_sort(active);
        let mut go_on = true;
        intervals(active, screen.rule, |left, right| {
            let (from, to) = (left.column.max(low), right.column.min(high));
            go_on = go_on && (from >= to || visit(row.into(), from, to));
        });
        if !go_on {
            return;
        }
        for edge in active.iter_mut() {
            edge.advance();
        }
    }
}

/// The inside intervals between the sorted crossings of one polygon with a row: the edges left and right of each.
#[inline]
pub fn intervals<E: AsRef<Edge>>(edges: &[E], rule: Rule, mut visit: impl FnMut(&E, &E)) {
    let (mut winding, mut left) = (0, None);
    for e in edges {
        let before = rule.inside(winding);
        winding += e.as_ref().winding;
        match (before, rule.inside(winding), left) {
            (false, true, _) => left = Some(e),
            (true, false, Some(l)) if e.as_ref().column > l.as_ref().column => visit(l, e),
            _ => {}
        }
    }
}

/// Whether a facet owns a pixel, by the same rule, edge by edge: for methods that ask about single points.
pub fn owns(screen: &Screen, facet: &Facet, column: i64, row: i64) -> bool {
    let inside = |v: i64, range: [i32; 2]| i64::from(range[0]) <= v && v < i64::from(range[1]);
    if !inside(column, facet.columns) || !inside(row, facet.rows) {
        return false;
    }
    let (x, y) = (centre(column), centre(row));
    let mut winding = 0;
    for l in screen.loops_of(facet) {
        let mut p = &l[l.len() - 1];
        for q in l {
            let ([px, py, _], [qx, qy, _]) = (*p, *q);
            if (py <= y) != (qy <= y) {
                // Positive where the centre is right of the edge as it runs down, or left of it as it runs up.
                let side = (qy - py) * (x - px) - (y - py) * (qx - px);
                if py <= y && side >= 0 {
                    winding += 1;
                } else if py > y && side <= 0 {
                    winding -= 1;
                }
            }
            p = q;
        }
    }
    screen.rule.inside(winding)
}
