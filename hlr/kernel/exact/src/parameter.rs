//! Parameters on a drawn edge, 0 at its first end and 1 at its second, and their order.

use std::cmp::Ordering;
use std::fmt::Debug;

use super::wide::cmp_products;

/// A place on an edge.
pub trait Place: Copy + Debug + Send + Sync {
    const START: Self;
    const END: Self;

    fn value(&self) -> f64;
    fn compare(&self, other: &Self) -> Ordering;
}

/// A parameter n / d in 0..1 on a drawn edge, d > 0: 63 bits where a contour is crossed, 127 where a polygon is
/// pierced.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    n: i128,
    d: i128,
    near: f64,
}

/// Two parameters whose roundings differ by more than this are in the order of their roundings: each rounding is off by
/// less than 4e-16.
const ROUNDING: f64 = 2e-15;

impl Parameter {
    #[inline]
    pub fn crossing(n: i64, d: i64) -> Parameter {
        Parameter { n: i128::from(n), d: i128::from(d), near: n as f64 / d as f64 }
    }

    /// d may have either sign.
    pub fn piercing(n: i128, d: i128) -> Parameter {
        let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
        Parameter { n, d, near: n as f64 / d as f64 }
    }
}

impl Place for Parameter {
    const START: Parameter = Parameter { n: 0, d: 1, near: 0.0 };
    const END: Parameter = Parameter { n: 1, d: 1, near: 1.0 };

    #[inline]
    fn value(&self) -> f64 {
        self.near
    }

    #[inline]
    fn compare(&self, other: &Parameter) -> Ordering {
        let gap = self.near - other.near;
        if gap.abs() > ROUNDING {
            return if gap < 0.0 { Ordering::Less } else { Ordering::Greater };
        }
        cmp_products(self.n, other.d, other.n, self.d)
    }
}

/// A parameter in floating point, with its rounding error.
#[derive(Clone, Copy, Debug)]
pub struct Rounded(f64);

impl Rounded {
    /// Rounding may lead beyond 0 and 1.
    #[inline]
    pub fn new(value: f64) -> Rounded {
        Rounded(value.clamp(0.0, 1.0))
    }
}

impl Place for Rounded {
    const START: Rounded = Rounded(0.0);
    const END: Rounded = Rounded(1.0);

    #[inline]
    fn value(&self) -> f64 {
        self.0
    }

    #[inline]
    fn compare(&self, other: &Rounded) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_equal_parameters_are_told_apart() {
        let big = 1i64 << 61;
        let (a, b) = (Parameter::crossing(big, 2 * big - 1), Parameter::crossing(big - 1, 2 * big - 3));
        assert_eq!(a.compare(&b), Ordering::Less);
        assert_eq!(b.compare(&a), Ordering::Greater);
    }

    /// Numbers that look random, below 2^bits.
    fn numbers(bits: u32) -> impl FnMut() -> i64 {
        let mut state = 1u64;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> (64 - bits)) as i64
        }
    }

    #[test]
    fn where_rounding_is_mistaken_the_integers_decide() {
        let mut next = numbers(62);
        let mut mistaken = 0;
        for _ in 0..20_000 {
            let d = next() | 1 << 61;
            let (n, off) = (next() % d, next() % 4096);
            let a = Parameter::crossing(n, d);
            // Nearly the same place: n / d = (n - m) / (d - m d / n), but for what whole numbers leave.
            let other = d - off;
            let b =
                Parameter::crossing((i128::from(n) * i128::from(other) / i128::from(d)) as i64 + off % 3 - 1, other);
            let exact = (a.n * b.d).cmp(&(b.n * a.d));
            assert_eq!(a.compare(&b), exact);
            assert_eq!(b.compare(&a), exact.reverse());
            let rounded = a.value().total_cmp(&b.value());
            mistaken += i32::from(rounded == exact.reverse() && exact != Ordering::Equal);
        }
        assert!(mistaken > 20, "rounding was mistaken {mistaken} times only");
    }

    #[test]
    fn places_far_apart_are_in_order() {
        let mut next = numbers(20);
        for _ in 0..5_000 {
            let [n, m] = [0; 2].map(|_| next());
            let [d, e] = [n, m].map(|k| k + next() + 1);
            let (a, b) = (Parameter::crossing(n, d), Parameter::crossing(m, e));
            assert_eq!(a.compare(&b), (n * e).cmp(&(m * d)));
            assert_eq!(a.value(), n as f64 / d as f64);
        }
    }

    #[test]
    fn a_piercing_may_be_given_by_two_negative_numbers() {
        let n = (1i128 << 100) + 7;
        for (over, under) in [(n, 2 * n), (-n, -2 * n)] {
            let found = Parameter::piercing(over, under);
            assert_eq!((found.n, found.d, found.value()), (n, 2 * n, 0.5));
            assert_eq!(found.compare(&Parameter::crossing(1, 2)), Ordering::Equal);
        }
        assert_eq!(Parameter::piercing(-n, -2 * n - 1).compare(&Parameter::crossing(1, 2)), Ordering::Less);
        assert_eq!(Parameter::piercing(n + 1, 2 * n).compare(&Parameter::crossing(1, 2)), Ordering::Greater);
        assert_eq!(Parameter::piercing(0, -5).value(), 0.0);
    }

    #[test]
    fn the_ends_are_where_they_are_said_to_be() {
        fn check<P: Place>(inside: &[P]) {
            assert_eq!((P::START.value(), P::END.value()), (0.0, 1.0));
            assert_eq!(P::START.compare(&P::END), Ordering::Less);
            for p in inside {
                assert_eq!((P::START.compare(p), P::END.compare(p)), (Ordering::Less, Ordering::Greater));
                assert_eq!((p.compare(&P::START), p.compare(&P::END)), (Ordering::Greater, Ordering::Less));
            }
        }
        // So near that only integers tell them from the ends.
        let far = i64::MAX;
        check(&[Parameter::crossing(1, far), Parameter::crossing(far - 1, far), Parameter::crossing(1, 3)]);
        for (end, n) in [(Parameter::START, 0), (Parameter::END, 9)] {
            assert_eq!(end.compare(&Parameter::crossing(n, 9)), Ordering::Equal);
        }
        check(&[Rounded::new(1e-300), Rounded::new(0.5), Rounded::new(1.0 - f64::EPSILON)]);
    }

    #[test]
    fn rounding_does_not_lead_beyond_the_ends() {
        let values = [-1e9, -1e-300, 0.0, 0.05, 0.95, 1.0, 1.0 + 1e-9, 7.0].map(|v| Rounded::new(v).value());
        assert_eq!(values, [0.0, 0.0, 0.0, 0.05, 0.95, 1.0, 1.0, 1.0]);
        assert_eq!(Rounded::new(0.25).compare(&Rounded::new(0.75)), Ordering::Less);
        assert_eq!(Rounded::new(0.75).compare(&Rounded::new(0.25)), Ordering::Greater);
    }
}
