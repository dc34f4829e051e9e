//! Curved patches z = f(x, y), f a polynomial of at most the third degree in x and in y, by forward differences.
//!
//! Along a row f is a cubic: its third difference is constant, and three additions lead from a pixel to the next.
//!
//! ```text
//!     z        z + d1        ...            z  += d1
//!     d1       d1 + d2       ...            d1 += d2
//!     d2       d2 + d3       ...            d2 += d3
//! ```
//!
//! In two dimensions f is a sum of differences times binomials, d_ij C(u, i) C(v, j), at u columns and v rows from the
//! patch's first pixel: sixteen numbers give the forward differences at every pixel. They are rounded once, to so many
//! bits that no depth is off by more than a quarter of a step; everything after that is in whole numbers. So every
//! method gets the same depth at a pixel, whatever its path there, and compares it exactly with that of a plane or of
//! another patch.

use super::depth_grid::DepthGrid;
use super::scene::Cubic;
use hlr_exact::elementary::{exp2, log2};

/// A patch over its pixels.
#[derive(Clone, Debug)]
pub struct Patch {
    column: i64,
    row: i64,
    /// Depths are counted in 2^-bits of a step.
    pub bits: u32,
    differences: [[i128; 4]; 4],
}

/// Depths along a row.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    differences: [i128; 4],
    unit: f64,
}

/// C(n, 0) to C(n, 3).
fn binomials(n: i64) -> [i128; 4] {
    let n = i128::from(n);
    [1, n, n * (n - 1) / 2, n * (n - 1) * (n - 2) / 6]
}

/// Turns coefficients of powers of x into those of powers of x - base.
fn shifted([a, b, c, d]: [f64; 4], base: f64) -> [f64; 4] {
    [a + base * (b + base * (c + base * d)), b + base * (2.0 * c + 3.0 * base * d), c + 3.0 * base * d, d]
}

/// Turns coefficients of powers into forward differences at 0: u^2 = C(u, 1) + 2 C(u, 2), u^3 = C(u, 1) + 6 C(u, 2) + 6
/// C(u, 3).
fn differences([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    [a, b + c + d, 2.0 * c + 6.0 * d, 6.0 * d]
}

/// Applies one change to the rows of a table and the other to its columns.
fn both(table: [[f64; 4]; 4], change: [&dyn Fn([f64; 4]) -> [f64; 4]; 2]) -> [[f64; 4]; 4] {
    let transposed = |t: [[f64; 4]; 4]| -> [[f64; 4]; 4] { std::array::from_fn(|i| std::array::from_fn(|k| t[k][i])) };
    transposed(transposed(table.map(change[1])).map(change[0]))
}

impl Patch {
    /// The patch over columns and rows, end exclusive; `sign`: direction of depth, +1 or -1.
    pub fn new(curve: &Cubic, sign: f64, columns: [i32; 2], rows: [i32; 2], depths: &DepthGrid) -> Patch {
        let base = [f64::from(columns[0]) + 0.5 - curve.origin[0], f64::from(rows[0]) + 0.5 - curve.origin[1]];
        let local = both(curve.coefficients, [&|c| shifted(c, base[0]), &|c| shifted(c, base[1])]);
        let mut steps = both(local, [&differences, &differences]).map(|r| r.map(|d| depths.steps(sign * d)));
        steps[0][0] = depths.number(sign * both(local, [&differences, &differences])[0][0]);
        let reach = |[low, high]: [i32; 2]| binomials(i64::from(high - low)).map(|b| b.max(0) as f64);
        let (across, down) = (reach(columns), reach(rows));
        let sum = |term: &dyn Fn(usize, usize) -> f64| {
            (0..16).map(|k| term(k / 4, k % 4) * across[k / 4] * down[k % 4]).sum::<f64>()
        };
        // The rounding of all differences, half a unit each, must not add up to more than a quarter of a step; all must
        // fit.
        let wanted = log2(2.0 * sum(&|_, _| 1.0)).ceil();
        let room = 124.0 - log2(sum(&|i, j| steps[i][j].abs()).max(1.0)).ceil();
        let bits = wanted.min(room).clamp(0.0, 100.0) as u32;
        let unit = exp2(f64::from(bits));
        let whole = |d: f64| (d * unit).round_ties_even() as i128;
        Patch { column: columns[0].into(), row: rows[0].into(), bits, differences: steps.map(|r| r.map(whole)) }
    }

    /// Forward differences along a row, at a column.
    fn at_pixel(&self, column: i64, row: i64) -> [i128; 4] {
        let (across, down) = (binomials(column - self.column), binomials(row - self.row));
        let here: [i128; 4] = std::array::from_fn(|i| (0..4).map(|j| self.differences[i][j] * down[j]).sum());
        std::array::from_fn(|k| (k..4).map(|i| here[i] * across[i - k]).sum())
    }

    /// Depth at a pixel's centre, in 2^-bits of a step.
    pub fn numerator(&self, column: i64, row: i64) -> i128 {
        self.at_pixel(column, row)[0]
    }

    pub fn over(&self) -> i128 {
        1 << self.bits
    }

    /// Depths from a pixel on, to the right.
    pub fn walk(&self, column: i64, row: i64) -> Walk {
        Walk { differences: self.at_pixel(column, row), unit: exp2(-f64::from(self.bits)) }
    }
}

impl Walk {
    #[inline(always)]
    pub fn get(&self) -> f64 {
        self.differences[0] as f64 * self.unit
    }

    #[inline(always)]
    pub fn advance(&mut self) {
        for k in 0..3 {
            self.differences[k] += self.differences[k + 1];
        }
    }

    /// Returns the depth here, and goes on to the next pixel.
    #[inline(always)]
    pub fn step(&mut self) -> f64 {
        let depth = self.get();
        self.advance();
        depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    fn grid(high: f64) -> DepthGrid {
        let camera = Camera {
            matrix: [[0.0; 4]; 4],
            width: 1,
            height: 1,
            front: f64::NEG_INFINITY,
            back: f64::INFINITY,
            near: f64::NEG_INFINITY,
            image_space: true,
        };
        DepthGrid::new(&camera, &[[0.0, 0.0, 0.0], [0.0, 0.0, high]])
    }

    #[test]
    fn whole_coefficients_are_exact_everywhere() {
        // z = 3 + 2 x - y + x^2 y / 4 + x^3 y^3 / 64, at centres: whole multiples of 2^-12.
        let mut coefficients = [[0.0; 4]; 4];
        (coefficients[0][0], coefficients[1][0], coefficients[0][1]) = (3.0, 2.0, -1.0);
        (coefficients[2][1], coefficients[3][3]) = (0.25, 1.0 / 64.0);
        let curve = Cubic { coefficients, origin: [10.0, -4.0], range: [0.0, 1.0] };
        let depths = grid(1024.0);
        let patch = Patch::new(&curve, 1.0, [5, 40], [2, 30], &depths);
        for row in 2..30 {
            let mut walk = patch.walk(5, row);
            for column in 5..40 {
                let (x, y) = (column as f64 + 0.5 - 10.0, row as f64 + 0.5 + 4.0);
                let z = 3.0 + 2.0 * x - y + 0.25 * x * x * y + x * x * x * y * y * y / 64.0;
                assert_eq!(depths.depth(patch.numerator(column, row) as f64 / patch.over() as f64), z);
                assert_eq!(depths.depth(walk.step()), z);
            }
        }
    }

    #[test]
    fn no_depth_is_off_by_more_than_a_step() {
        // A cubic over 4000 pixels, about one unit deep.
        let third = |s: f64| [0.1, 0.7 * s, -0.9 * s * s, 0.3 * s * s * s];
        let (p, q) = (third(1.0 / 4000.0), third(1.0 / 3000.0));
        let coefficients = std::array::from_fn(|i| std::array::from_fn(|j| p[i] * q[j]));
        let curve = Cubic { coefficients, origin: [0.5, 0.5], range: [0.0, 1.0] };
        let depths = grid(1.0);
        let patch = Patch::new(&curve, -1.0, [0, 4000], [0, 3000], &depths);
        assert!(patch.bits > 50);
        let at = |c: &[f64; 4], x: f64| c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        for (column, row) in [(0, 0), (3999, 0), (0, 2999), (3999, 2999), (1234, 2345), (2000, 10)] {
            let expected = -at(&p, column as f64) * at(&q, row as f64);
            let off = depths.depth(patch.walk(column, row).get()) - expected;
            assert!(off.abs() < 4e-15, "{off}");
        }
    }
}
