//! Writes numbers of a decimal grid as the shortest text: ".5", "-12.25", "0".

/// Appends steps * 10^-places; says whether a decimal point was printed.
pub fn put(out: &mut Vec<u8>, steps: i64, places: usize) -> bool {
    if steps < 0 {
        out.push(b'-');
    }
    let mut digits = [b'0'; 40];
    let mut rest = steps.unsigned_abs();
    let mut first = digits.len();
    while rest > 0 || digits.len() - first < places {
        first -= 1;
        digits[first] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    let (whole, decimals) = digits[first..].split_at(digits.len() - first - places);
    let kept = decimals.iter().rposition(|&d| d != b'0').map_or(0, |i| i + 1);
    if whole.is_empty() && kept == 0 {
        out.push(b'0');
    }
    out.extend(whole);
    if kept > 0 {
        out.push(b'.');
        out.extend(&decimals[..kept]);
    }
    kept > 0
}

#[cfg(test)]
mod tests {
    use super::put;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        for (steps, places, text) in [
            (0, 0, "0"),
            (0, 3, "0"),
            (5, 0, "5"),
            (500, 3, ".5"),
            (-500, 3, "-.5"),
            (-12250, 3, "-12.25"),
            (100_000, 3, "100"),
            (7, 12, ".000000000007"),
            (i64::MIN, 0, "-9223372036854775808"),
        ] {
            let mut out = Vec::new();
            put(&mut out, steps, places);
            assert_eq!(String::from_utf8_lossy(&out), text);
        }
    }
}
