//! What an active edge carries from row to row besides x: depth and colour, each with its step, as the textbook's entry
//! of the edge table has them.
//!
//! From row y to y + 1 an edge of slope m moves by 1 / m, and the depth of its plane along it by -(A / m + B) / C.
//! Depth is kept where it is needed, at the first centre right of the edge: with dx = s + r, s whole columns and r < 1,
//! a row down is
//!
//! ```text
//!      o                  -(A s + B) / C   to the pixel s columns further
//!       \                 -A / C           more, in rows in which the rest adds up to a column
//!    ----\o---
//!    -----\-o-            o  the first centre right of the edge
//! ```
//!
//! Steps are rounded to 2^-11 of a step of depth, so after 8192 rows with two steps each a depth is off by up to four:
//! less than half of `NEAR_TIE`. Depths nearer than that are compared exactly, from the planes, so rounding decides
//! nothing. (Whole numbers over C need no rounding, but at 128 bits they take a tenth to a third more of a method's
//! time.) Where an intermediate depth might overflow, no depth is kept.
//!
//! Colour need not be exact. It is kept where the edge crosses the row, in floating point; between two corners p and q
//! it changes by (q - p) / (y_q - y_p) per row. Along the row it goes from edge to edge in the same way (`shading`).

use super::edge::Edge;
use super::plane::{STEPS, centre};
use super::polygon_table::Along;
use super::screen::{Facet, STEEP, Screen};

/// Values that an active edge carries.
pub trait Carried: Copy {
    /// The values at the edge's first row.
    fn start(screen: &Screen, edge: &Edge, row: i64) -> Self;
    /// Goes on to the next row; carry: the edge has gone a column further than its whole step.
    fn advance(&mut self, carry: bool);
}

impl Carried for () {
    fn start(_: &Screen, _: &Edge, _: i64) {}

    #[inline(always)]
    fn advance(&mut self, _: bool) {}
}

impl<A: Carried, B: Carried> Carried for (A, B) {
    fn start(screen: &Screen, edge: &Edge, row: i64) -> (A, B) {
        (A::start(screen, edge, row), B::start(screen, edge, row))
    }

    fn advance(&mut self, carry: bool) {
        self.0.advance(carry);
        self.1.advance(carry);
    }
}

/// An edge with the values that it carries.
#[derive(Clone, Copy, Debug)]
pub struct Active<C> {
    pub edge: Edge,
    pub carried: C,
}

impl<C: Carried> Active<C> {
    pub fn new(screen: &Screen, edge: &Edge, row: i64) -> Active<C> {
        Active { edge: *edge, carried: C::start(screen, edge, row) }
    }

    #[inline(always)]
    pub fn advance(&mut self) {
        let carry = self.edge.advance();
        self.carried.advance(carry);
    }
}

impl<C> AsRef<Edge> for Active<C> {
    #[inline(always)]
    fn as_ref(&self) -> &Edge {
        &self.edge
    }
}

/// Depth of the edge's plane at the first centre right of the edge, and its increments, in 2048ths of a step of depth.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    z: i64,
    /// -(A s + B) / C and -A / C.
    down: i64,
    right: i64,
}

/// Parts of a step of depth.
const PARTS: f64 = 2048.0;
/// The z of an unknown depth.
const UNKNOWN: i64 = i64::MIN;

impl Depth {
    fn at(facet: &Facet, edge: &Edge, row: i64) -> Depth {
        let whole = edge.whole() as f64;
        let rows = (i64::from(edge.end) - row) as f64;
        let z = facet.depth_at(edge.column, row);
        // A bound of every sum that one of its depths may be; NaN is not below the limit either.
        let away = (edge.column - i64::from(facet.columns[0])) as f64;
        let reach = facet.start.abs()
            + facet.right.abs() * (away.abs() + (whole.abs() + 1.0) * rows)
            + facet.down.abs() * (rows + (row - i64::from(facet.rows[0])) as f64);
        if reach < STEEP {
            let parts = |v: f64| (v * PARTS).round() as i64;
            Depth { z: parts(z), down: parts(facet.right * whole + facet.down), right: parts(facet.right) }
        } else {
            Depth { z: UNKNOWN, down: 0, right: 0 }
        }
    }

    /// Depth in steps, within half of `NEAR_TIE`; NaN where it is unknown.
    #[inline(always)]
    pub fn get(&self) -> f64 {
        if self.z == UNKNOWN { f64::NAN } else { self.z as f64 / PARTS }
    }
}

impl Carried for Depth {
    fn start(screen: &Screen, edge: &Edge, row: i64) -> Depth {
        Depth::at(&screen.facets[edge.facet as usize], edge, row)
    }

    #[inline(always)]
    fn advance(&mut self, carry: bool) {
        self.z += self.down + if carry { self.right } else { 0 };
    }
}

/// Values of the two corners of the edge, interpolated to where it crosses the row. Without `CORRECT` the values
/// themselves (and 1), which are linear on the screen; with it value / w and 1 / w, which are linear on the surface.
#[derive(Clone, Copy, Debug)]
pub struct Colour<const CORRECT: bool> {
    pub value: [f64; 4],
    /// Change per row.
    pub down: [f64; 4],
}

impl<const CORRECT: bool> Carried for Colour<CORRECT> {
    fn start(screen: &Screen, edge: &Edge, row: i64) -> Self {
        let (p, q) = screen.ends(edge.facet, edge.number);
        let (py, qy) = (screen.points[p][1], screen.points[q][1]);
        let high = (qy - py) as f64;
        let t = (centre(row) - py) as f64 / high;
        let linear = |k: usize| {
            let [x, y, z, reciprocal] = screen.values[k];
            if CORRECT { [x * reciprocal, y * reciprocal, z * reciprocal, reciprocal] } else { [x, y, z, 1.0] }
        };
        let (v, u) = (linear(p), linear(q));
        Colour {
            value: std::array::from_fn(|k| v[k] + (u[k] - v[k]) * t),
            down: std::array::from_fn(|k| (u[k] - v[k]) * STEPS as f64 / high),
        }
    }

    fn advance(&mut self, _: bool) {
        for k in 0..4 {
            self.value[k] += self.down[k];
        }
    }
}

impl Screen {
    /// Depth along the row from the edge at which a facet is entered, taken from that edge's record; starts at the
    /// first column of the frame where the edge lies left of it.
    #[inline(always)]
    pub fn along(&self, edge: &Edge, depth: &Depth, row: i64) -> Along {
        let facet = &self.facets[edge.facet as usize];
        let (column, depth) = if edge.column < 0 { (0, facet.depth_at(0, row)) } else { (edge.column, depth.get()) };
        Along { column, depth, right: facet.right }
    }

    /// Depth where an edge crosses a row, and its change to the next, -(A / m + B) / C, in the units of the camera; for
    /// traces.
    pub fn crossing_depth(&self, edge: &Edge, depth: &Depth) -> [f64; 2] {
        let facet = &self.facets[edge.facet as usize];
        let z = depth.get() - facet.right * (edge.column as f64 + 0.5 - edge.crossing());
        let down = facet.right * edge.slope() + facet.down;
        [self.depths.depth(z), self.depths.depth(down) - self.depths.depth(0.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::{Plane, Point, first_centre, widest};
    use crate::screen::NEAR_TIE;

    #[test]
    fn depth_along_an_edge_is_off_by_less_than_half_a_tie() {
        let mut state = 3u64;
        let mut next = |n: i64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 15) as i64 % n
        };
        let (mut worst, mut known, mut unknown) = (0.0f64, 0, 0);
        for _ in 0..500 {
            // Pictures of 8192 pixels, and corners beyond them; of every second one depth is nearly the same.
            let deep = if next(2) == 0 { 1 << 48 } else { 1 << 20 };
            let corners: Vec<Point> =
                (0..3).map(|_| [next(1 << 22) - (1 << 20), next(1 << 21), next(deep) - (1 << 47)]).collect();
            if widest(&corners).is_none() {
                continue;
            }
            let plane = Plane::through([0, 1, 2].map(|k| &corners[k])).facing();
            let facet = Facet::flat(plane, [0, 8192], [0, 8192]);
            let Some(mut edge) = Edge::new(&corners[0], &corners[1], 0, 0, 0, 8192) else { continue };
            let mut row = i64::from(first_centre(corners[0][1].min(corners[1][1])).max(0));
            let mut depth = Depth::at(&facet, &edge, row);
            while row < i64::from(edge.end) {
                let exact = plane.depth(centre(edge.column), centre(row));
                let (whole, rest) = (exact.div_euclid(plane.c.into()), exact.rem_euclid(plane.c.into()));
                let found = depth.get();
                if found.is_nan() {
                    unknown += 1;
                } else {
                    known += 1;
                    let off = (found.floor() as i128 - whole) as f64 + found.fract() - rest as f64 / plane.c as f64;
                    worst = worst.max(off.abs());
                }
                let carry = edge.advance();
                depth.advance(carry);
                row += 1;
            }
        }
        assert!(known > 10 * unknown && unknown > 0, "{known} known, {unknown} not");
        assert!(0.01 < worst && worst < NEAR_TIE / 2.0, "off by {worst}");
    }
}
