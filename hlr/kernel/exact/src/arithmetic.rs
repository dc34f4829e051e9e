//! The number types of the predicates: exact integers for drawings; floating point for `hlr study`, for comparison.
//!
//! The points are the same snapped ones in all three. `f64` holds their coordinates and differences without error and
//! rounds products; `f32` rounds coordinates as well, to 24 bits. With either a sign may be wrong, and the sides of one
//! line as two polygons compute them may contradict each other. These are the plain predicates of the literature; the
//! study measures what they cost and what they get wrong. (L. Kettner et al., "Classroom examples of robustness
//! problems in geometric computations", 2008.)

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

use super::parameter::{Parameter, Place, Rounded};
use super::wide::cmp_products;

/// Numbers that are added, multiplied and compared with zero.
pub trait Ring:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
{
    const ZERO: Self;

    #[inline(always)]
    fn sign(self) -> i32 {
        i32::from(self > Self::ZERO) - i32::from(self < Self::ZERO)
    }
}

impl Ring for i64 {
    const ZERO: i64 = 0;

    #[inline(always)]
    fn sign(self) -> i32 {
        self.signum() as i32
    }
}

impl Ring for i128 {
    const ZERO: i128 = 0;

    #[inline(always)]
    fn sign(self) -> i32 {
        self.signum() as i32
    }
}

impl Ring for f64 {
    const ZERO: f64 = 0.0;
}

impl Ring for f32 {
    const ZERO: f32 = 0.0;
}

/// A kind of numbers, by the degree of the polynomials that they hold.
pub trait Arithmetic: Copy + Debug + Send + Sync + 'static {
    /// Degree up to two in the coordinates.
    type Area: Ring;
    /// Degree three.
    type Volume: Ring;
    /// A place on an edge.
    type Parameter: Place;

    fn coordinate(c: i32) -> Self::Area;
    /// A depth, or a tolerance in depth.
    fn depth(c: i64) -> Self::Volume;
    fn raise(a: Self::Area) -> Self::Volume;
    /// Compare a * b with c * d.
    fn compare_products(a: Self::Area, b: Self::Volume, c: Self::Area, d: Self::Volume) -> Ordering;
    /// The place n / d, d > 0.
    fn crossing(n: Self::Area, d: Self::Area) -> Self::Parameter;
    /// The place n / d; d may have either sign.
    fn piercing(n: Self::Volume, d: Self::Volume) -> Self::Parameter;
}

/// Integers without any error: what drawings are made with.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

impl Arithmetic for Exact {
    type Area = i64;
    type Volume = i128;
    type Parameter = Parameter;

    #[inline(always)]
    fn coordinate(c: i32) -> i64 {
        i64::from(c)
    }

    #[inline(always)]
    fn depth(c: i64) -> i128 {
        i128::from(c)
    }

    #[inline(always)]
    fn raise(a: i64) -> i128 {
        i128::from(a)
    }

    #[inline(always)]
    fn compare_products(a: i64, b: i128, c: i64, d: i128) -> Ordering {
        cmp_products(i128::from(a), b, i128::from(c), d)
    }

    #[inline(always)]
    fn crossing(n: i64, d: i64) -> Parameter {
        Parameter::crossing(n, d)
    }

    #[inline(always)]
    fn piercing(n: i128, d: i128) -> Parameter {
        Parameter::piercing(n, d)
    }
}

/// Double precision, each operation rounded.
#[derive(Clone, Copy, Debug)]
pub struct Double;

/// Single precision, coordinates and each operation rounded.
#[derive(Clone, Copy, Debug)]
pub struct Single;

/// Keeps polynomials of degree five, of coordinates up to 2^31, within the exponents of single precision: a power of
/// two changes no rounding.
const UNIT: f32 = 1.0 / 32768.0;

macro_rules! rounded {
    ($kind:ty, $number:ty, $unit:expr) => {
        impl Arithmetic for $kind {
            type Area = $number;
            type Volume = $number;
            type Parameter = Rounded;

            #[inline(always)]
            fn coordinate(c: i32) -> $number {
                c as $number * $unit
            }

            #[inline(always)]
            fn depth(c: i64) -> $number {
                c as $number * $unit
            }

            #[inline(always)]
            fn raise(a: $number) -> $number {
                a
            }

            #[inline(always)]
            fn compare_products(a: $number, b: $number, c: $number, d: $number) -> Ordering {
                (a * b).partial_cmp(&(c * d)).unwrap_or(Ordering::Equal)
            }

            #[inline(always)]
            fn crossing(n: $number, d: $number) -> Rounded {
                Rounded::new(f64::from(n / d))
            }

            #[inline(always)]
            fn piercing(n: $number, d: $number) -> Rounded {
                Rounded::new(f64::from(n / d))
            }
        }
    };
}

rounded!(Double, f64, 1.0);
rounded!(Single, f32, UNIT);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::orient2d;

    #[test]
    fn small_areas_are_the_same_in_all_three() {
        let (p, q, r) = ([3, 4, 0], [-7, 9, 0], [12, -5, 0]);
        let exact = orient2d::<Exact>(&p, &q, &r);
        assert_eq!(orient2d::<Double>(&p, &q, &r), exact as f64);
        assert_eq!(orient2d::<Single>(&p, &q, &r), exact as f32 * UNIT * UNIT);
    }

    #[test]
    fn signs_of_all_kinds_of_numbers() {
        assert_eq!([-7i64, 0, i64::MAX].map(Ring::sign), [-1, 0, 1]);
        // Whose last 32 bits are none, and whose sign they would turn round.
        assert_eq!([1i128 << 40, -(1i128 << 40), 0, (1 << 40) + (1 << 31)].map(Ring::sign), [1, -1, 0, 1]);
        assert_eq!([-0.5f64, -0.0, 1e-300].map(Ring::sign), [-1, 0, 1]);
        assert_eq!([-0.5f32, 0.0, 1e-30].map(Ring::sign), [-1, 0, 1]);
    }

    /// Checks that all number types agree where nothing needs to be rounded.
    fn agree<A: Arithmetic>() {
        let (area, volume) = (A::coordinate, A::depth);
        for (a, b, c, d) in [(2, 3, 5, 7), (5, 7, 2, 3), (-2, 3, 2, 3), (6, 4, 3, 8), (-5, 3, -2, 4), (1, 4, 2, 1)] {
            let found = A::compare_products(area(a), volume(b), area(c), volume(d));
            assert_eq!(found, (i64::from(a) * b).cmp(&(i64::from(c) * d)), "{a} {b} {c} {d}");
        }
        for c in [0, 1, -3, 1 << 20] {
            assert_eq!(A::raise(area(c)).sign(), c.signum());
            assert!(A::raise(area(c)) == volume(c.into()));
        }
        assert!(area(3) * area(2) == area(6) * area(1));
        assert_eq!(A::crossing(area(3), area(4)).value(), 0.75);
        assert_eq!(A::piercing(volume(-3), volume(-8)).value(), 0.375);
    }

    #[test]
    fn small_numbers_are_the_same_in_all_three() {
        agree::<Exact>();
        agree::<Double>();
        agree::<Single>();
        // A power of two: no rounding but that to 24 bits.
        assert_eq!(Single::coordinate(5) * 32768.0, 5.0);
        assert_eq!(Single::depth(-(1 << 40)) * 32768.0, -(2f32.powi(40)));
        assert_eq!(Double::coordinate(i32::MIN), -(2f64.powi(31)));
    }

    #[test]
    fn what_is_no_number_is_equal_to_everything() {
        let (huge, none) = (f64::INFINITY, 0.0);
        assert_eq!(Double::compare_products(huge, none, 1.0, 1.0), Ordering::Equal);
        assert_eq!(Single::compare_products(f32::NAN, 1.0, 1.0, 1.0), Ordering::Equal);
    }

    #[test]
    fn rounding_sees_a_line_where_there_is_a_turn() {
        // Slope 1 and a hair: the products differ by one part in 2^60.
        let m = (1 << 30) - 1;
        let (p, q, r) = ([-m, -m, 0], [m, m, 0], [m - 1, m - 2, 0]);
        assert!(orient2d::<Exact>(&p, &q, &r) < 0);
        assert_eq!(orient2d::<Single>(&p, &q, &r).sign(), 0);
        let (p, q, r) = ([0, 0, 0], [m, m - 1, 0], [m - 1, m - 2, 0]);
        assert_eq!(orient2d::<Exact>(&p, &q, &r), -1);
        assert_eq!(orient2d::<Double>(&p, &q, &r).sign(), 0);
    }

    #[test]
    fn products_of_degree_five_stay_finite() {
        let m = Single::coordinate(i32::MAX);
        assert!((m * m * m * m * m).is_finite());
        assert!(Single::coordinate(1) * Single::coordinate(1) * Single::depth(1) > 0.0);
    }
}
