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

    /// Another way to the product: digits of 16 bits, one after another.
    fn by_digits(a: u128, b: u128) -> (u128, u128) {
        let digit = |v: u128, k: usize| if k < 8 { v >> (16 * k) & 0xffff } else { 0 };
        let (mut low, mut high, mut carry) = (0u128, 0u128, 0u128);
        for k in 0..16 {
            carry += (0..=k).map(|i| digit(a, i) * digit(b, k - i)).sum::<u128>();
            let half = if k < 8 { &mut low } else { &mut high };
            *half |= (carry & 0xffff) << (16 * (k % 8));
            carry >>= 16;
        }
        (high, low)
    }

    #[test]
    fn all_256_bits_are_right() {
        let mut numbers = vec![0, 1, 2, 3, u128::MAX, u128::MAX - 1, 1 << 127, (1 << 127) - 1, u128::MAX / 3];
        for k in [1, 16, 31, 32, 33, 62, 63, 64, 65, 66, 95, 96, 97, 126] {
            numbers.extend([1 << k, (1 << k) - 1, (1 << k) + 1]);
        }
        let mut state = 7u128;
        for _ in 0..40 {
            state = state.wrapping_mul(0xda94_2042_e4dd_58b5_c17f_5a3b_91d2_ed35).wrapping_add(1);
            numbers.extend([state, state >> 29, state >> 71]);
        }
        for &a in &numbers {
            for &b in &numbers {
                assert_eq!(mul_u128(a, b), by_digits(a, b), "{a} * {b}");
            }
        }
    }

    #[test]
    fn signs_decide_and_the_least_number_has_no_opposite() {
        let (least, most) = (i128::MIN, i128::MAX);
        for a in [least, -1, 0, 1, most] {
            for b in [least, -1, 0, 1, most] {
                assert_eq!(cmp_products(a, b, 0, most), (a.signum() * b.signum()).cmp(&0));
                assert_eq!(cmp_products(a, b, b, a), Ordering::Equal);
            }
        }
        // 2^254 > (2^127 - 1) 2^127
        assert_eq!(cmp_products(least, least, most, -least.wrapping_add(1)), Ordering::Greater);
        assert_eq!(cmp_products(least, most, most, -most), Ordering::Less);
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
