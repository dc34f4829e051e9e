//! Sine, arc tangent, powers and the like, with the same bits on every machine.
//!
//! The functions of the standard library are those of the platform: they differ in the last bit between systems, and
//! with one C library between processors with and without fused multiplication. A point that lies halfway between two
//! places of the grid is then rounded one way here and the other way there. These are written in Rust from sums,
//! products and square roots, which IEEE 754 lays down to the last bit. The linter forbids the others (`clippy.toml`).

pub use libm::{acos, asinh, atan2, cbrt, cos, cosh, exp, exp2, log as ln, log2, log10, pow as power, sin, sinh, tan};

/// Sine and cosine of an angle in radians.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// The length of (x, y), also where its square would overflow or vanish.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    const SMALL: f64 = f64::from_bits((1023 - 600) << 52);
    const LARGE: f64 = f64::from_bits((1023 + 600) << 52);
    let largest = x.abs().max(y.abs());
    if largest > 1e150 {
        return length(x * SMALL, y * SMALL) * LARGE;
    }
    if largest < 1e-140 {
        return length(x * LARGE, y * LARGE) * SMALL;
    }
    length(x, y)
}

#[inline]
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)]
mod tests {
    use super::*;

    /// Function, the standard library's, and where both are defined.
    type Row = (fn(f64) -> f64, fn(f64) -> f64, [f64; 2]);

    const ROWS: [Row; 15] = [
        (sin, f64::sin, [-20.0, 20.0]),
        (cos, f64::cos, [-20.0, 20.0]),
        (|x| sin_cos(x).0, f64::sin, [-1e6, 1e6]),
        (|x| sin_cos(x).1, f64::cos, [-1e6, 1e6]),
        (tan, f64::tan, [-1.5, 1.5]),
        (acos, f64::acos, [-1.0, 1.0]),
        (|x| atan2(x, 0.7), |x| x.atan2(0.7), [-5.0, 5.0]),
        (asinh, f64::asinh, [-9.0, 9.0]),
        (sinh, f64::sinh, [-5.0, 5.0]),
        (cosh, f64::cosh, [-5.0, 5.0]),
        (exp, f64::exp, [-30.0, 30.0]),
        (exp2, f64::exp2, [-30.0, 30.0]),
        (cbrt, f64::cbrt, [-50.0, 50.0]),
        (|x| power(x, 1.0 / 6.0), |x| x.powf(1.0 / 6.0), [1e-9, 9.0]),
        (|x| hypot(x, 0.3), |x| x.hypot(0.3), [-9.0, 9.0]),
    ];

    fn samples([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
        (0..=4000).map(move |k| low + (high - low) * f64::from(k) / 4000.0)
    }

    #[test]
    fn they_are_as_exact_as_those_of_the_platform() {
        for (i, (own, platform, range)) in ROWS.into_iter().enumerate() {
            for x in samples(range) {
                let (found, wanted) = (own(x), platform(x));
                let unit = wanted.abs().max(1e-10) * f64::EPSILON;
                assert!((found - wanted).abs() <= 3.0 * unit, "row {i}, {x}: {found} for {wanted}");
            }
        }
        for x in samples([1e-6, 50.0]) {
            let near = |found: f64, wanted: f64| (found - wanted).abs() <= 3.0 * f64::EPSILON * wanted.abs().max(1e-3);
            assert!(near(ln(x), x.ln()) && near(log2(x), x.log2()) && near(log10(x), x.log10()), "{x}");
        }
    }

    /// The last bits of all of them, summed up. On any machine, with any compiler, they are these.
    #[test]
    fn they_have_the_same_bits_everywhere() {
        let sum = |f: &dyn Fn(f64) -> f64, range| {
            samples(range).fold(0u64, |sum, x| sum.rotate_left(5).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ f(x).to_bits())
        };
        let mut found: Vec<u64> = ROWS.iter().map(|(own, _, range)| sum(own, *range)).collect();
        found.extend([ln, log2, log10].map(|f| sum(&f, [1e-6, 50.0])));
        assert_eq!(found.iter().fold(0u64, |all, one| all.rotate_left(7) ^ one), 0x1753_7ec4_35ad_e003, "{found:x?}");
    }

    #[test]
    fn lengths_neither_overflow_nor_vanish() {
        for size in [2f64.powi(700), 1.0, 2f64.powi(-700)] {
            assert_eq!(hypot(-3.0 * size, 4.0 * size), 5.0 * size);
        }
        assert_eq!((hypot(0.0, -0.0), hypot(5.0, 0.0), hypot(f64::INFINITY, 1.0)), (0.0, 5.0, f64::INFINITY));
        assert!(hypot(f64::NAN, 1.0).is_nan() && hypot(1.0, f64::NAN).is_nan());
    }
}
