//! The plane of a polygon in integers, and depths compared without error.
//!
//! The plane goes through three of its corners: those that span the largest triangle in the image (`widest`). Then no
//! corner is farther from a line through two of them than the third, so the error of the plane at any other corner is
//! at most the sum of the rounding errors of the three. A sum over all corners (Newell's) has no such bound: where a
//! loop crosses itself so that its lobes cancel, it is nothing but rounding. It only decides which side the polygon
//! turns to the viewer.
//!
//! Bounds: |x|, |y| <= 2^22, |z| < 2^49. Then |A|, |B| < 2^74, |C| < 2^48 and |A x + B y + D| < 2^98, however often a
//! polygon winds; two depths are compared by products of 256 bits.

use hlr_exact::wide::cmp_products;
use std::cmp::Ordering;

/// x right, y down, z away from the viewer; in 256ths of a pixel and in steps of depth.
pub type Point = [i64; 3];

/// Steps per pixel.
pub const STEPS: i64 = 256;
/// Limit of |x| and |y| of any point, in 256ths of a pixel.
pub const LIMIT: f64 = (1i64 << 22) as f64;
/// Steps from the nearest to the farthest depth.
pub const DEPTH_LIMIT: f64 = (1i64 << 48) as f64;

/// The centre of a pixel along one axis.
#[inline(always)]
pub fn centre(pixel: i64) -> i64 {
    pixel * STEPS + STEPS / 2
}

/// A x + B y + C z + D = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    pub a: i128,
    pub b: i128,
    pub c: i64,
    pub d: i128,
}

/// Twice the area of a triangle in the image, with its sign.
#[inline(always)]
pub fn turn(p: &Point, q: &Point, r: &Point) -> i64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// The three corners that span the largest triangle in the image, found by changing one of them at a time; None where
/// all lie on one line.
pub fn widest(corners: &[Point]) -> Option<[usize; 3]> {
    let first = corners.first()?;
    if let [p, q, r] = corners {
        return (turn(p, q, r) != 0).then_some([0, 1, 2]);
    }
    let square = |p: &Point| (p[0] - first[0]).pow(2) + (p[1] - first[1]).pow(2);
    let far = (1..corners.len()).max_by_key(|&k| square(&corners[k]))?;
    let area = |t: &[usize; 3]| turn(&corners[t[0]], &corners[t[1]], &corners[t[2]]).abs();
    let mut best = [0, far, 0];
    let (mut largest, mut idle) = (0, 0);
    // Each change makes the triangle larger: in practice two or three rounds.
    for k in (0..3).rev().cycle().take(3 * 16) {
        let changed = |i: usize| {
            let mut t = best;
            t[k] = i;
            t
        };
        let next = changed((0..corners.len()).max_by_key(|&i| area(&changed(i)))?);
        if area(&next) > largest {
            (largest, best, idle) = (area(&next), next, 0);
        } else {
            idle += 1;
        }
        if idle == 3 {
            break;
        }
    }
    (largest > 0).then_some(best)
}

impl Plane {
    /// The plane through three points, its normal outward where they run counter-clockwise seen from outside.
    pub fn through([p, q, r]: [&Point; 3]) -> Plane {
        let difference = |a: &Point, b: &Point| [0, 1, 2].map(|k| i128::from(b[k]) - i128::from(a[k]));
        let (u, v) = (difference(p, q), difference(p, r));
        let [a, b] = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]];
        let c = turn(p, q, r);
        let d = -(a * i128::from(p[0]) + b * i128::from(p[1]) + i128::from(c) * i128::from(p[2]));
        Plane { a, b, c, d }
    }

    /// A x + B y + C z + D.
    #[inline(always)]
    pub fn at(&self, p: &Point) -> i128 {
        self.across(p[0], p[1]) + i128::from(self.c) * i128::from(p[2])
    }

    /// A x + B y + D.
    #[inline(always)]
    pub fn across(&self, x: i64, y: i64) -> i128 {
        self.a * i128::from(x) + self.b * i128::from(y) + self.d
    }

    /// The same plane with C > 0, so that depth is a fraction over a positive number; C = 0 has no depth.
    pub fn facing(self) -> Plane {
        if self.c < 0 { Plane { a: -self.a, b: -self.b, c: -self.c, d: -self.d } } else { self }
    }

    /// Depth at (x, y) as a fraction: numerator; the denominator is `c`.
    #[inline(always)]
    pub fn depth(&self, x: i64, y: i64) -> i128 {
        -self.across(x, y)
    }

    /// Which of two planes with C > 0 is nearer at (x, y).
    pub fn compare(&self, other: &Plane, x: i64, y: i64) -> Ordering {
        cmp_products(self.depth(x, y), other.c.into(), other.depth(x, y), self.c.into())
    }

    /// Whether this plane falls behind another as x grows; both with C > 0.
    pub fn falls_behind(&self, other: &Plane) -> bool {
        cmp_products(other.a, self.c.into(), self.a, other.c.into()) == Ordering::Greater
    }
}

/// The first pixel whose centre is at x or beyond.
pub fn first_centre(x: i64) -> i32 {
    ((x - STEPS / 2).div_euclid(STEPS) + i64::from((x - STEPS / 2).rem_euclid(STEPS) != 0)) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(corners: &[Point]) -> Plane {
        Plane::through(widest(corners).unwrap().map(|k| &corners[k]))
    }

    #[test]
    fn a_collinear_first_corner_does_no_harm() {
        let p = plane(&[[0, 0, 0], [5, 0, 5], [10, 0, 10], [10, 10, 10], [0, 10, 0]]).facing();
        assert_eq!((p.a.signum(), p.b, p.c.signum()), (-1, 0, 1));
        for q in [[0, 0, 0], [5, 0, 5], [10, 10, 10], [3, 7, 3]] {
            assert_eq!(p.at(&q), 0);
        }
    }

    #[test]
    fn the_widest_triangle_holds_every_corner_within_its_own_size() {
        let mut state = 1u64;
        let mut next = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) % n) as i64
        };
        for _ in 0..200 {
            let corners: Vec<Point> = (0..9).map(|_| [next(900), next(7), 0]).collect();
            let Some(t) = widest(&corners) else { continue };
            let [p, q, r] = t.map(|k| &corners[k]);
            let whole = turn(p, q, r).abs();
            for v in &corners {
                for part in [turn(v, q, r), turn(p, v, r), turn(p, q, v)] {
                    assert!(part.abs() <= whole);
                }
            }
        }
    }

    #[test]
    fn lobes_that_cancel_have_a_plane() {
        // A bow tie, whose signed area is zero.
        let p = plane(&[[0, 0, 0], [400, 400, 8], [400, 0, 4], [0, 400, 4]]).facing();
        assert_eq!(p.at(&[200, 200, 4]), 0);
        assert!(widest(&[[0, 0, 0], [4, 4, 1], [8, 8, 7]]).is_none());
    }

    #[test]
    fn one_plane_falls_behind_another() {
        let p = plane(&[[0, 0, 0], [1000, 0, 700], [0, 1000, 50]]).facing();
        let q = plane(&[[0, 0, 900], [1000, 0, 100], [0, 1000, 400]]).facing();
        assert!(p.falls_behind(&q) && !q.falls_behind(&p) && !p.falls_behind(&p));
        let first = (0..9).find(|&k| p.compare(&q, centre(k), centre(0)) == Ordering::Greater);
        // 0.7 x = 900 - 0.8 x - ..., at 588 of 256ths: the third centre.
        assert_eq!(first, Some(2));
    }

    #[test]
    fn the_largest_coordinates_fit() {
        let m = 1 << 22;
        let z = (1 << 49) - 1;
        let p = plane(&[[-m, -m, -z], [m, -m, z], [m, m, -z], [-m, m, z - 1]]).facing();
        let q = plane(&[[-m, -m, z], [m, m, -z], [-m, m, z]]).facing();
        let _ = p.compare(&q, m, -m);
        let _ = q.compare(&plane(&[[-m, -m, -z], [m, -m, z], [m, -m + 1, -z]]).facing(), m, m);
    }
}
