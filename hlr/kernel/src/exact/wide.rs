//! Products of 128-bit integers, compared exactly in 256 bits.
//! Needed only where a piercing parameter (degree 3) meets another parameter.

use std::cmp::Ordering;

fn mul_u128(a: u128, b: u128) -> (u128, u128) {
    const LOW: u128 = u64::MAX as u128;
    let (a1, a0) = (a >> 64, a & LOW);
    let (b1, b0) = (b >> 64, b & LOW);
    let low = a0 * b0;
    let mid1 = a1 * b0 + (low >> 64);
    let mid2 = a0 * b1 + (mid1 & LOW);
    (a1 * b1 + (mid1 >> 64) + (mid2 >> 64), (mid2 << 64) | (low & LOW))
}

/// Compare a * b with c * d.
pub fn cmp_products(a: i128, b: i128, c: i128, d: i128) -> Ordering {
    let left_sign = a.signum() * b.signum();
    let right_sign = c.signum() * d.signum();
    if left_sign != right_sign {
        return left_sign.cmp(&right_sign);
    }
    let left = mul_u128(a.unsigned_abs(), b.unsigned_abs());
    let right = mul_u128(c.unsigned_abs(), d.unsigned_abs());
    if left_sign < 0 { right.cmp(&left) } else { left.cmp(&right) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_small_products() {
        for a in -4i128..5 {
            for b in -4i128..5 {
                for c in -4i128..5 {
                    for d in -4i128..5 {
                        assert_eq!(cmp_products(a, b, c, d), (a * b).cmp(&(c * d)));
                    }
                }
            }
        }
    }

    #[test]
    fn tells_apart_products_beyond_128_bits() {
        let big = i128::MAX;
        assert_eq!(cmp_products(big, big, big, big - 1), Ordering::Greater);
        assert_eq!(cmp_products(-big, big, big, big - 1), Ordering::Less);
        assert_eq!(cmp_products(-big, big, -big, big - 1), Ordering::Less);
        // (2^100 + 1)(2^100 - 1) = 2^200 - 1 < 2^200
        let p = 1i128 << 100;
        assert_eq!(cmp_products(p + 1, p - 1, p, p), Ordering::Less);
    }
}
