//! Places on a drawn edge, 0 at its first end and 1 at its second, and their order.

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

/// A parameter n / d in 0..1 on a drawn edge, d > 0: 63 bits where a contour is crossed, 127 where a polygon is pierced.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    n: i128,
    d: i128,
    near: f64,
}

/// Two parameters whose roundings differ by more are in that order: each rounding is off by less than 4e-16.
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

/// A parameter that is only as good as its rounding.
#[derive(Clone, Copy, Debug)]
pub struct Rounded(f64);

impl Rounded {
    /// Rounding may lead beyond the ends.
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
}
