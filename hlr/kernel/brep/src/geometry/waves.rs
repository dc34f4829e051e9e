//! How far a wave reaches over a range of its angle.

use hlr_exact::elementary::{atan2, cos, hypot, sin};
use std::f64::consts::{PI, TAU};

/// The range of a cos t + b sin t.
pub fn waves(a: f64, b: f64, [first, last]: [f64; 2]) -> [f64; 2] {
    let (size, top) = (hypot(a, b), atan2(b, a));
    let ends = [first, last].map(|t| if t.is_finite() { a * cos(t) + b * sin(t) } else { 0.0 });
    let reaches = |at: f64| !(last - first).is_finite() || at + TAU * ((first - at) / TAU).ceil() <= last;
    let high = if reaches(top) { size } else { ends[0].max(ends[1]) };
    let low = if reaches(top + PI) { -size } else { ends[0].min(ends[1]) };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_reaches_its_crests_where_the_range_holds_them() {
        assert_eq!(waves(2.0, 0.0, [0.0, TAU]), [-2.0, 2.0]);
        let [low, high] = waves(2.0, 0.0, [0.5, 1.0]);
        assert!((low - 2.0 * 1f64.cos()).abs() < 1e-15 && (high - 2.0 * 0.5f64.cos()).abs() < 1e-15);
        let [low, high] = waves(0.0, 1.0, [TAU + 1.0, TAU + 2.0]);
        assert!(high == 1.0 && (low - 1f64.sin()).abs() < 1e-12);
        assert_eq!(waves(3.0, 4.0, [f64::NEG_INFINITY, f64::INFINITY]), [-5.0, 5.0]);
    }
}
