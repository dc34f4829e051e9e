//! Divides a curve into the fewest chords that keep the chord error and the turning angle, each with an equal share of
//! both.

use hlr_exact::elementary::{acos, atan2};
use std::f64::consts::{FRAC_PI_3, TAU};

use super::chord_error::chord_error;
use crate::geometry::curve::Curve;
use crate::geometry::vector::{cross, dot, length};
use hlr_accuracy::CHORD_AIM;

/// Number of points of a smooth stretch at which the curvature is evaluated.
const SAMPLES: usize = 12;
const SAMPLES_OF_SPAN: usize = 4;
const MOST_CHORDS: usize = 50_000;
const MOST_HALVINGS: u32 = 30;

/// Parameters from first to last, both included, whose chords keep the chord error and turn by at most `angle` radians.
pub fn chords(curve: &Curve, [first, last]: [f64; 2], deflection: f64, angle: f64) -> Vec<f64> {
    let mut out = vec![first];
    for (low, high) in smooth_stretches(curve, first, last) {
        stretch(curve, low, high, deflection, angle, &mut out);
    }
    out
}

/// Stretches between the corners of the curve.
fn smooth_stretches(curve: &Curve, first: f64, last: f64) -> Vec<(f64, f64)> {
    let mut bounds = vec![first];
    if let Curve::Spline(n) = curve {
        for run in n.knots.chunk_by(|a, b| a == b) {
            if run.len() >= n.degree && run[0] > first && run[0] < last {
                bounds.push(run[0]);
            }
        }
    }
    bounds.push(last);
    bounds.windows(2).map(|w| (w[0], w[1])).collect()
}

fn stretch(curve: &Curve, low: f64, high: f64, deflection: f64, angle: f64, out: &mut Vec<f64>) {
    if matches!(curve, Curve::Line { .. }) {
        out.push(high);
        return;
    }
    if let Curve::Ellipse { a, b, .. } = curve
        && (length(a) - length(b)).abs() <= 1e-9 * length(a)
        && dot(a, b).abs() <= 1e-9 * dot(a, a)
    {
        // The sagitta of an arc of the angle h is 1 - cos(h / 2), in radii.
        let step = 2.0 * acos(1.0 - (deflection / length(a)).min(0.5));
        let mut count = ((high - low) / step.min(angle).min(FRAC_PI_3) - 1e-9).ceil().clamp(1.0, MOST_CHORDS as f64);
        if high - low > TAU - 1e-9 {
            // A whole circle gets a multiple of four chords, so that it is as wide as it is high.
            count = 4.0 * (count / 4.0).ceil();
        }
        out.extend((1..count as usize).map(|i| low + (high - low) * i as f64 / count));
        out.push(high);
        return;
    }
    // Number of chords needed from the start up to each sample.
    let samples = places(curve, low, high);
    let rate = |t: f64| {
        let [_, d, dd] = curve.derivatives(t);
        let speed = length(&d);
        if speed == 0.0 {
            return 0.0;
        }
        let bend = length(&cross(&d, &dd)) / (speed * speed);
        let by_error = (bend * speed / (8.0 * CHORD_AIM * deflection)).sqrt();
        let rate = by_error.max(bend / angle.min(FRAC_PI_3));
        if rate.is_finite() { rate } else { 0.0 }
    };
    let mut sums = vec![0.0];
    let rates: Vec<f64> = samples.iter().map(|&t| rate(t)).collect();
    for i in 1..samples.len() {
        sums.push(sums[i - 1] + 0.5 * (rates[i - 1] + rates[i]) * (samples[i] - samples[i - 1]));
    }
    let total = sums[sums.len() - 1];
    let count = (total - 1e-6).ceil().clamp(1.0, MOST_CHORDS as f64) as usize;
    let mut from = low;
    for k in 1..=count {
        let to = if k == count {
            high
        } else {
            let wanted = total * k as f64 / count as f64;
            let i = sums.partition_point(|&s| s < wanted).clamp(1, sums.len() - 1);
            let width = sums[i] - sums[i - 1];
            let share = if width > 0.0 { (wanted - sums[i - 1]) / width } else { 0.0 };
            samples[i - 1] + share * (samples[i] - samples[i - 1])
        };
        halve(curve, from, to, deflection, angle, 0, out);
        from = to;
    }
}

/// Parameters at which the curvature is evaluated; ends and knots are among them.
fn places(curve: &Curve, low: f64, high: f64) -> Vec<f64> {
    let mut bounds = vec![low];
    if let Curve::Spline(n) = curve {
        bounds.extend(n.knots.iter().copied().filter(|&k| k > low && k < high));
        bounds.dedup();
    }
    bounds.push(high);
    let parts = (SAMPLES / (bounds.len() - 1)).max(SAMPLES_OF_SPAN);
    let mut out = vec![low];
    for w in bounds.windows(2) {
        out.extend((1..=parts).map(|i| w[0] + (w[1] - w[0]) * i as f64 / parts as f64));
    }
    out
}

fn halve(curve: &Curve, from: f64, to: f64, deflection: f64, angle: f64, depth: u32, out: &mut Vec<f64>) {
    let middle = 0.5 * (from + to);
    let fine = depth == MOST_HALVINGS || out.len() > MOST_CHORDS || middle <= from || middle >= to;
    if fine || (chord_error(curve, from, to) <= deflection && turning(curve, from, to) <= angle.min(FRAC_PI_3) * 1.2) {
        out.push(to);
        return;
    }
    halve(curve, from, middle, deflection, angle, depth + 1, out);
    halve(curve, middle, to, deflection, angle, depth + 1, out);
}

/// Angle in radians between the tangents at both ends.
fn turning(curve: &Curve, from: f64, to: f64) -> f64 {
    let width = to - from;
    // Evaluated slightly inside: the ends may be corners.
    let [a, b] = [from + 1e-6 * width, to - 1e-6 * width].map(|t| curve.derivatives(t)[1]);
    atan2(length(&cross(&a, &b)), dot(&a, &b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::nurbs::Nurbs;

    #[test]
    fn a_circle_is_divided_evenly_and_no_more_than_needed() {
        let circle = Curve::Ellipse { p: [0.0; 3], a: [10.0, 0.0, 0.0], b: [0.0, 10.0, 0.0] };
        let found = chords(&circle, [0.0, TAU], 0.05, 1.0);
        assert_eq!(found.len() - 1, 32);
        assert!(chord_error(&circle, found[0], found[1]) <= 0.05);
        assert_eq!(chords(&circle, [0.0, TAU], 1e3, 9.0).len() - 1, 8);
    }

    #[test]
    fn a_spline_keeps_its_error_and_its_corners() {
        let curve = Curve::Spline(Nurbs {
            degree: 2,
            rational: false,
            sampled: false,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0],
            poles: vec![
                [0.0, 0.0, 0.0, 1.0],
                [1.0, 0.0, 0.0, 1.0],
                [2.0, 0.0, 0.0, 1.0],
                [2.0, 3.0, 0.0, 1.0],
                [9.0, 9.0, 0.0, 1.0],
            ],
        });
        let found = chords(&curve, [0.0, 2.0], 0.01, 0.5);
        assert!(found[1] == 1.0, "the straight half is one chord, and ends in the corner");
        assert!(found.windows(2).all(|w| chord_error(&curve, w[0], w[1]) <= 0.01));
    }
}
