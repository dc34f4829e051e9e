//! Rasterizes faces with one sample per pixel: the exact span of each row, updated from row to row in integers.
//!
//! J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4, 1965, for polygons:
//! with n(j) = E(0, j), floored to steps of the grid, a left edge (a > 0) owns the columns
//!
//! ```text
//!     a i + n(j) >= 0      i >= -floor(n(j) / a)              quotient and remainder of n(j + 1) = n(j) + b
//!                                                             follow from those of n(j) by an addition and a carry
//! ```
//!
//! and a right one those up to floor(n(j) / -a). There are no edge functions left within the row.

use super::face::Face;
use super::grid::{LANES, TILE_HEIGHT, TILE_WIDTH};
use super::sampling::Sampling;
use super::slope::{Slope, nearer, window};
use super::tile::Tile;

/// floor(n(j) / d) as j grows.
#[derive(Clone, Copy)]
pub struct Quotient {
    value: i64,
    rest: i64,
    /// Increment of the value per row.
    value_by_row: i64,
    rest_by_row: i64,
    divisor: i64,
}

impl Quotient {
    const fn constant(value: i64) -> Quotient {
        Quotient { value, rest: 0, value_by_row: 0, rest_by_row: 0, divisor: 1 }
    }

    #[inline(always)]
    fn new(n: i64, by_row: i64, divisor: i64) -> Quotient {
        let over = 1.0 / divisor as f64;
        let (value, rest) = divided(n, divisor, over);
        let (value_by_row, rest_by_row) = divided(by_row, divisor, over);
        Quotient { value, rest, value_by_row, rest_by_row, divisor }
    }

    #[inline(always)]
    fn step(&mut self) {
        let rest = self.rest.wrapping_add(self.rest_by_row).wrapping_sub(self.divisor);
        // Minus one where there is no carry.
        let none = rest >> 63;
        self.rest = rest.wrapping_add(self.divisor & none);
        self.value = self.value.wrapping_add(self.value_by_row).wrapping_add(1).wrapping_add(none);
    }
}

/// Floor and remainder of n / d, for |n| < 2^45: the quotient in floating point is off by one at most.
#[inline(always)]
fn divided(n: i64, d: i64, over: f64) -> (i64, i64) {
    let q = (n as f64 * over) as i64;
    let r = n.wrapping_sub(q.wrapping_mul(d));
    let (q, r) = if r < 0 { (q.wrapping_sub(1), r.wrapping_add(d)) } else { (q, r) };
    let (q, r) = if r < 0 { (q.wrapping_sub(1), r.wrapping_add(d)) } else { (q, r) };
    if r >= d { (q.wrapping_add(1), r.wrapping_sub(d)) } else { (q, r) }
}

#[inline(always)]
pub fn fill(tile: &mut Tile, face: &Face, first: [i32; 2], sampling: &Sampling) {
    let mut scan = Scan::new(face, first, sampling);
    while let Some((row, from, to)) = scan.next_span() {
        let samples = tile.row(row);
        let mut column = from;
        while column < to {
            let at = column / LANES * LANES;
            let z = scan.slope.lanes(row, at, sampling);
            let mut outside = [0i32; LANES];
            for (l, v) in outside.iter_mut().enumerate() {
                let i = (at + l) as i32;
                *v = (i.wrapping_sub(column as i32) | (to as i32 - 1).wrapping_sub(i)) >> 31;
            }
            if let Some(lanes) = samples[at..].first_chunk_mut::<LANES>() {
                nearer(&outside, &z, face.triangle, lanes);
            }
            column = at + LANES;
        }
    }
}

/// The spans of a face in a tile, row by row.
pub struct Scan {
    left: [Quotient; 2],
    right: [Quotient; 2],
    row: usize,
    end: usize,
    pub slope: Slope,
}

impl Scan {
    #[inline(always)]
    pub fn new(face: &Face, first: [i32; 2], sampling: &Sampling) -> Scan {
        let (rows, _) = window(face, first);
        let (mut top, mut end) = (rows[0] as i64, rows[1] as i64);
        let half = 1i32 << (sampling.shift - 1);
        let (x, y) = ((first[0] << sampling.shift).wrapping_add(half), (first[1] << sampling.shift).wrapping_add(half));
        let mut left = [Quotient::constant(0); 2];
        let mut right = [Quotient::constant(TILE_WIDTH as i64 - 1); 2];
        let (mut lefts, mut rights) = (0, 0);
        for (k, n) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (face.y[k].wrapping_sub(face.y[n]), face.x[n].wrapping_sub(face.x[k]));
            let value = i64::from(a)
                .wrapping_mul(i64::from(x.wrapping_sub(face.x[k])))
                .wrapping_add(i64::from(b).wrapping_mul(i64::from(y.wrapping_sub(face.y[k]))));
            // Left and top edges own what lies on them.
            let value = value.wrapping_sub(i64::from(!(a > 0 || (a == 0 && b > 0)))) >> sampling.shift;
            let (a, b) = (i64::from(a), i64::from(b));
            let start = value.wrapping_add(b.wrapping_mul(rows[0] as i64));
            if a > 0 {
                left[lefts & 1] = Quotient::new(start, b, a);
                lefts += 1;
            } else if a < 0 {
                right[rights & 1] = Quotient::new(start, b, -a);
                rights += 1;
            } else if b > 0 {
                top = top.max(-value.div_euclid(b));
            } else if b < 0 {
                end = end.min(value.div_euclid(-b) + 1);
            }
        }
        let mut scan =
            Scan { left, right, row: rows[0], end: end.max(0) as usize, slope: Slope::new(face, first, sampling) };
        while (scan.row as i64) < top && scan.row < scan.end {
            scan.step();
        }
        scan
    }

    /// The next row in which the face owns anything: first column, and one after the last.
    #[inline(always)]
    pub fn next_span(&mut self) -> Option<(usize, usize, usize)> {
        while self.row < self.end.min(TILE_HEIGHT) {
            let row = self.row;
            let from = (-self.left[0].value).max(-self.left[1].value).max(0);
            let to = self.right[0].value.min(self.right[1].value).min(TILE_WIDTH as i64 - 1) + 1;
            self.step();
            if from < to {
                return Some((row, from as usize, to as usize));
            }
        }
        None
    }

    #[inline(always)]
    fn step(&mut self) {
        self.row += 1;
        self.left[0].step();
        self.left[1].step();
        self.right[0].step();
        self.right[1].step();
    }
}
