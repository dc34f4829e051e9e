//! An edge of a facet, followed from row to row by adding its slope, dx = 1 / m in the textbook, in whole columns and a
//! remainder: nothing is ever rounded.

use super::plane::{Point, STEPS, centre, first_centre};
use std::cmp::Ordering;

/// An edge on its way down the rows.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// First column whose centre is not left of the edge, in the current row: ceil(numerator / `over`).
    pub column: i64,
    /// Distance from the crossing to that centre, in 1 / `over` columns: 0 <= excess < over.
    pub excess: i64,
    /// dx per row: whole columns, and the remainder.
    step: i64,
    rest: i64,
    over: i64,
    /// The first row below the edge.
    pub end: i32,
    /// +1 down, -1 up.
    pub winding: i32,
    pub facet: u32,
    /// Number of the edge in its facet, for traces.
    pub number: u32,
}

impl Edge {
    /// The edge from p to q, set to its first row from `row` on; None where it covers no row of the frame.
    pub fn new(p: &Point, q: &Point, facet: u32, number: u32, row: i32, height: i32) -> Option<Edge> {
        let (top, bottom, winding) = if p[1] < q[1] { (p, q, 1) } else { (q, p, -1) };
        let first = first_centre(top[1]).max(row);
        let end = first_centre(bottom[1]).min(height);
        if first >= end {
            return None;
        }
        let [x0, y0, _] = *top;
        let (dx, dy) = (bottom[0] - x0, bottom[1] - y0);
        // The centre of column k is not left of the crossing where 256 k + 128 >= x0 + (y - y0) dx / dy.
        let over = STEPS * dy;
        let numerator = (x0 - STEPS / 2) * dy + (centre(first.into()) - y0) * dx;
        let column = -(-numerator).div_euclid(over);
        let step = (STEPS * dx).div_euclid(over);
        let rest = (STEPS * dx).rem_euclid(over);
        Some(Edge { column, excess: column * over - numerator, step, rest, over, end, winding, facet, number })
    }

    /// Goes on to the next row; returns whether the remainder added a column to the whole step.
    #[inline(always)]
    pub fn advance(&mut self) -> bool {
        self.column += self.step;
        self.excess -= self.rest;
        let carry = self.excess < 0;
        if carry {
            self.column += 1;
            self.excess += self.over;
        }
        carry
    }

    /// The whole columns of dx.
    pub fn whole(&self) -> i64 {
        self.step
    }

    /// dx as a fraction, for the order within a bucket of the edge table.
    pub fn slope(&self) -> f64 {
        self.step as f64 + self.rest as f64 / self.over as f64
    }

    /// Position in pixels at which it crosses the row; for traces.
    pub fn crossing(&self) -> f64 {
        self.column as f64 - self.excess as f64 / self.over as f64 + 0.5
    }

    /// Exact order of edges by where they cross the row.
    pub fn compare(&self, other: &Edge) -> Ordering {
        self.column.cmp(&other.column).then_with(|| (other.excess * self.over).cmp(&(self.excess * other.over)))
    }
}

impl AsRef<Edge> for Edge {
    #[inline(always)]
    fn as_ref(&self) -> &Edge {
        self
    }
}

/// Sorts edges by column; they are nearly sorted already. Returns the number of swaps.
#[inline]
pub fn insertion_sort<E: AsRef<Edge>>(edges: &mut [E]) -> u64 {
    let mut swaps = 0;
    for i in 1..edges.len() {
        let mut k = i;
        while k > 0 && edges[k - 1].as_ref().column > edges[k].as_ref().column {
            edges.swap(k - 1, k);
            swaps += 1;
            k -= 1;
        }
    }
    swaps
}
