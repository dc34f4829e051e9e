//! Depth of curved patches along a row by forward differences: of z^2, without computing a square root.
//!
//! For a sphere of radius r about the origin z^2 = r^2 - x^2 - y^2, and the step from x to x + 1 changes it by -(2 x +
//! 1): two additions. Any quadric (sphere, cylinder, cone) is, along a row,
//!
//! ```text
//!     A z^2 + B(x) z + C(x) = 0     z = (-B -+ s) / 2 A,   s^2 = B^2 - 4 A C =: D(x)
//! ```
//!
//! with D quadratic in x, so its second difference is constant. s comes from the s of the pixel before, corrected while
//! the residual D - s^2 is not within [0, 2 s]: that is s = floor(sqrt(D)), exactly, in a step or two per pixel.

/// a x^2 + b y^2 + c z^2 + d xy + e xz + f yz + g x + h y + i z + j = 0.
pub type Quadric = [i64; 10];

/// s and the residual at a pixel, followed from pixel to pixel.
pub struct Root {
    value: i128,
    first: i128,
    second: i128,
    root: i128,
    residual: i128,
    /// Corrections made so far.
    pub corrections: u64,
}

impl Root {
    /// D at x, x + 1 and x + 2.
    pub fn new(d: [i128; 3]) -> Root {
        let (first, second) = (d[1] - d[0], d[2] - 2 * d[1] + d[0]);
        let mut root = Root { value: d[0], first, second, root: 0, residual: 0, corrections: 0 };
        root.restart();
        root
    }

    /// floor(sqrt(D)), or None outside the patch.
    pub fn get(&self) -> Option<i128> {
        (self.value >= 0).then_some(self.root)
    }

    pub fn advance(&mut self) {
        let outside = self.value < 0;
        self.value += self.first;
        self.residual += self.first;
        self.first += self.second;
        if self.value < 0 {
            return;
        }
        if outside {
            self.restart();
            return;
        }
        while self.residual < 0 {
            self.root -= 1;
            self.residual += 2 * self.root + 1;
            self.corrections += 1;
        }
        while self.residual > 2 * self.root {
            self.residual -= 2 * self.root + 1;
            self.root += 1;
            self.corrections += 1;
        }
    }

    /// Finds s by bisection, once, where a row enters the patch.
    fn restart(&mut self) {
        if self.value < 0 {
            return;
        }
        let (mut low, mut high) = (0i128, 1i128);
        while high * high <= self.value {
            high *= 2;
        }
        while high - low > 1 {
            let middle = (low + high) / 2;
            if middle * middle <= self.value { low = middle } else { high = middle }
        }
        (self.root, self.residual) = (low, self.value - low * low);
    }
}

/// D at (x, y) of a quadric, and B.
pub fn discriminant(q: &Quadric, x: i64, y: i64) -> (i128, i128) {
    let [a, b, c, d, e, f, g, h, i, j] = q.map(i128::from);
    let (x, y) = (i128::from(x), i128::from(y));
    let linear = e * x + f * y + i;
    let rest = a * x * x + b * y * y + d * x * y + g * x + h * y + j;
    (linear * linear - 4 * c * rest, linear)
}

/// Floors of the nearer depths of a quadric with c > 0 in row y at x0, x0 + 1, ..., None where it is missed; and the
/// number of corrections.
pub fn row(q: &Quadric, x0: i64, y: i64, count: usize) -> (Vec<Option<i64>>, u64) {
    let at = |x: i64| discriminant(q, x, y).0;
    let mut root = Root::new([at(x0), at(x0 + 1), at(x0 + 2)]);
    let (_, mut linear) = discriminant(q, x0, y);
    let slope = i128::from(q[4]);
    let twice = 2 * i128::from(q[2]);
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        // z = (-B - s) / 2 A with s rounded down: z is too far by less than 1 / 2 A, so that floor needs s rounded up.
        out.push(root.get().map(|s| {
            let up = s + i128::from(root.residual > 0);
            (-linear - up).div_euclid(twice) as i64
        }));
        root.advance();
        linear += slope;
    }
    (out, root.corrections)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_steps_by_odd_numbers() {
        // x^2 + y^2 + z^2 - 25 = 0, row 0: D = 4 (25 - x^2), its first difference -4 (2 x + 1).
        let q = [1, 1, 1, 0, 0, 0, 0, 0, 0, -25];
        for x in -5..5 {
            assert_eq!(discriminant(&q, x + 1, 0).0 - discriminant(&q, x, 0).0, -4 * i128::from(2 * x + 1));
        }
        let (z, _) = row(&q, -6, 0, 13);
        let expected = [None, Some(0), Some(-3), Some(-4), Some(-5), Some(-5), Some(-5), Some(-5), Some(-5)];
        assert_eq!(z[..9], expected);
    }

    #[test]
    fn roots_are_exact() {
        let q = [3, 5, 2, 1, -1, 1, 40, -7, 9, -90_000];
        for y in -40..40 {
            let at = |x: i64| discriminant(&q, x, y).0;
            let mut root = Root::new([at(-300), at(-299), at(-298)]);
            for x in -300..300 {
                match root.get() {
                    None => assert!(at(x) < 0),
                    Some(s) => assert!(s * s <= at(x) && at(x) < (s + 1) * (s + 1)),
                }
                root.advance();
            }
        }
    }
}
