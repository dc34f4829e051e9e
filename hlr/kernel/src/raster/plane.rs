//! The plane of a polygon in integers, and depths compared without error.
//!
//! From all corners by Newell's summation (Sutherland, Sproull, Schumacker 1974), not from three: a corner that lies on
//! the line between its neighbours does no harm.
//!
//! Bounds: |x|, |y| <= 2^22, 0 <= z <= 2^24. Then |A|, |B| < 2^49, |C| < 2^48 and |A x + B y + D| < 2^74 for polygons that
//! wind around once; two depths are compared by products below 2^123, which leaves four bits for those that wind more.

use std::cmp::Ordering;

/// Right, down, away from the viewer; in 256ths of a pixel and in steps of depth.
pub type Point = [i32; 3];

/// Steps per pixel.
pub const STEPS: i64 = 256;
/// |x| and |y| of any point.
pub const LIMIT: f64 = (1i64 << 22) as f64;
/// Bits of depth.
pub const DEPTH_LIMIT: f64 = (1i64 << 24) as f64;

/// The centre of a pixel along one axis.
#[inline(always)]
pub fn centre(pixel: i64) -> i64 {
    pixel * STEPS + STEPS / 2
}

/// A x + B y + C z + D = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    pub a: i64,
    pub b: i64,
    pub c: i64,
    pub d: i128,
}

impl Plane {
    /// Newell's plane; its normal is outward where the loops run counter-clockwise seen from outside.
    pub fn newell<'a>(loops: impl Iterator<Item = &'a [Point]> + Clone) -> Plane {
        let (mut a, mut b, mut c) = (0i64, 0i64, 0i64);
        let (mut count, mut sum) = (0i128, [0i128; 3]);
        for l in loops.clone() {
            let mut p = &l[l.len() - 1];
            for q in l {
                let ([px, py, pz], [qx, qy, qz]) = (p.map(i64::from), q.map(i64::from));
                a += (py - qy) * (pz + qz);
                b += (pz - qz) * (px + qx);
                c += (px - qx) * (py + qy);
                count += 1;
                for k in 0..3 {
                    sum[k] += i128::from(q[k]);
                }
                p = q;
            }
        }
        if (a, b, c) == (0, 0, 0) {
            return Plane::of_three(loops);
        }
        // Through the mean of the corners; where they are coplanar that is a whole number.
        let through = i128::from(a) * sum[0] + i128::from(b) * sum[1] + i128::from(c) * sum[2];
        Plane { a, b, c, d: -through.div_euclid(count.max(1)) }
    }

    /// A loop that crosses itself so that its halves cancel has no sum: the plane of the first corner and the two that
    /// span the largest triangle with it, one after another.
    fn of_three<'a>(loops: impl Iterator<Item = &'a [Point]> + Clone) -> Plane {
        let corners: Vec<Point> = loops.flatten().copied().collect();
        let normal = |q: &Point, r: &Point| {
            let [[px, py, pz], [qx, qy, qz], [rx, ry, rz]] = [corners[0], *q, *r].map(|p| p.map(i64::from));
            let (u, v) = ([qx - px, qy - py, qz - pz], [rx - px, ry - py, rz - pz]);
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        };
        let size = |n: &[i64; 3]| n.iter().map(|&c| i128::from(c) * i128::from(c)).sum::<i128>();
        let pairs = corners.iter().enumerate().flat_map(|(k, q)| corners[k..].iter().map(move |r| (q, r)));
        let [a, b, c] = pairs.map(|(q, r)| normal(q, r)).max_by_key(size).unwrap_or_default();
        let [x, y, z] = corners[0].map(i128::from);
        Plane { a, b, c, d: -(i128::from(a) * x + i128::from(b) * y + i128::from(c) * z) }
    }

    /// A x + B y + C z + D.
    #[inline(always)]
    pub fn at(&self, p: &Point) -> i128 {
        self.across(i64::from(p[0]), i64::from(p[1])) + i128::from(self.c) * i128::from(p[2])
    }

    /// A x + B y + D.
    #[inline(always)]
    pub fn across(&self, x: i64, y: i64) -> i128 {
        i128::from(self.a) * i128::from(x) + i128::from(self.b) * i128::from(y) + self.d
    }

    /// The same plane with C > 0, so that depth is a fraction over a positive number; C = 0 has no depth.
    pub fn facing(self) -> Plane {
        if self.c < 0 { Plane { a: -self.a, b: -self.b, c: -self.c, d: -self.d } } else { self }
    }

    /// Depth at (x, y) as a fraction: numerator over `c`.
    #[inline(always)]
    pub fn depth(&self, x: i64, y: i64) -> i128 {
        -self.across(x, y)
    }

    /// Which of two planes with C > 0 is nearer at (x, y).
    #[inline(always)]
    pub fn compare(&self, other: &Plane, x: i64, y: i64) -> Ordering {
        (self.depth(x, y) * i128::from(other.c)).cmp(&(other.depth(x, y) * i128::from(self.c)))
    }

    /// The difference of the depths of two planes with C > 0, times both C, at (x, y); and its growth per pixel along x.
    /// Both are integers, so the pixel from which on one is nearer is found without error.
    pub fn difference(&self, other: &Plane, x: i64, y: i64) -> (i128, i128) {
        let (own, its) = (i128::from(self.c), i128::from(other.c));
        let here = self.depth(x, y) * its - other.depth(x, y) * own;
        let step = i128::from(STEPS) * (i128::from(other.a) * own - i128::from(self.a) * its);
        (here, step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(corners: &[Point]) -> Plane {
        Plane::newell([corners].into_iter())
    }

    #[test]
    fn a_collinear_first_corner_does_no_harm() {
        let p = plane(&[[0, 0, 0], [5, 0, 5], [10, 0, 10], [10, 10, 10], [0, 10, 0]]);
        assert_eq!((p.a.signum(), p.b, p.c.signum()), (-1, 0, 1));
        for q in [[0, 0, 0], [5, 0, 5], [10, 10, 10], [3, 7, 3]] {
            assert_eq!(p.at(&q), 0);
        }
    }

    #[test]
    fn the_difference_of_two_depths_is_linear() {
        let p = plane(&[[0, 0, 0], [1000, 0, 700], [0, 1000, 50]]).facing();
        let q = plane(&[[0, 0, 900], [1000, 0, 100], [0, 1000, 400]]).facing();
        let (d0, step) = p.difference(&q, centre(0), centre(3));
        for k in 0..5 {
            let (d, _) = p.difference(&q, centre(k), centre(3));
            assert_eq!(d, d0 + i128::from(k) * step);
            assert_eq!(d.cmp(&0), p.compare(&q, centre(k), centre(3)));
        }
    }

    #[test]
    fn the_largest_coordinates_fit() {
        let m = 1 << 22;
        let z = 1 << 24;
        let p = plane(&[[-m, -m, 0], [m, -m, z], [m, m, 0], [-m, m, z - 1]]).facing();
        let q = plane(&[[-m, -m, z], [m, m, 0], [-m, m, z]]).facing();
        let _ = p.compare(&q, i64::from(m), -i64::from(m));
        let _ = q.compare(&plane(&[[-m, -m, 0], [m, -m, z], [m, -m + 1, 0]]).facing(), i64::from(m), i64::from(m));
    }
}
