//! Fits cubic Bezier curves to any curve: least squares with the true tangents at both ends, divided until close
//! enough.
//!
//! P. Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990. It departs from the
//! paper in that the curve is known: tangents are exact, and any number of points can be evaluated.

use super::bezier::{Chain, at};
use super::plane::{Vec2, dot, length, minus};
use hlr_exact::elementary::power;

/// Least number of points evaluated on a piece, besides its ends.
const PLACES: usize = 12;
/// Iterations in which parameters move to the foot points.
const ROUNDS: usize = 4;
/// Most levels of division.
const DEEPEST: u32 = 16;

/// Cubic curves within `tolerance` of a curve between two parameters. `curve` gives point and derivative; `corners` are
/// the parameters where its tangent may jump; `spans` says how many different formulas it is made of.
pub fn fit(
    curve: &dyn Fn(f64) -> [Vec2; 2],
    from: f64,
    to: f64,
    corners: &[f64],
    spans: usize,
    tolerance: f64,
) -> Chain {
    let mut stops = vec![from];
    stops.extend(corners);
    stops.push(to);
    let mut points = vec![curve(from)[0]];
    let places = PLACES.max(4 * spans / (stops.len() - 1));
    for w in stops.windows(2) {
        fit_smooth(curve, w[0], w[1], places, tolerance, DEEPEST, &mut points);
    }
    Chain { degree: 3, points }
}

fn fit_smooth(
    curve: &dyn Fn(f64) -> [Vec2; 2],
    from: f64,
    to: f64,
    places: usize,
    tolerance: f64,
    depth: u32,
    out: &mut Vec<Vec2>,
) {
    // Evaluated just inside the ends: at a corner that gives the tangent of this side.
    let inside = 1e-9 * (to - from);
    let mut samples: Vec<[Vec2; 2]> =
        (0..=places + 1).map(|i| curve(from + (to - from) * (i as f64 / (places + 1) as f64))).collect();
    samples[0][1] = curve(from + inside)[1];
    samples[places + 1][1] = curve(to - inside)[1];
    let (piece, mut error) = cubic(&samples);
    if error <= tolerance {
        error = error.max(between(curve, from, to, places, &piece));
    }
    if error <= tolerance || depth == 0 {
        out.extend(&piece[1..]);
        return;
    }
    // The error of a cubic fit falls with the sixth power of its length.
    let parts = (power(error / tolerance, 1.0 / 6.0).ceil() as usize).clamp(2, 16);
    let mut travelled = vec![0.0];
    for w in samples.windows(2) {
        travelled.push(travelled[travelled.len() - 1] + length(&minus(&w[1][0], &w[0][0])));
    }
    let total = travelled[places + 1];
    let mut start = from;
    let (mut at, fewer) = (0, (places / 2).max(PLACES));
    for k in 1..=parts {
        let mut end = to;
        if k < parts {
            let goal = total * (k as f64 / parts as f64);
            while at + 2 < travelled.len() && travelled[at + 1] < goal {
                at += 1;
            }
            let step = travelled[at + 1] - travelled[at];
            let share = if step > 0.0 { ((goal - travelled[at]) / step).clamp(0.0, 1.0) } else { 0.5 };
            end = from + (to - from) * ((at as f64 + share) / (places + 1) as f64);
        }
        if end > start {
            fit_smooth(curve, start, end, fewer, tolerance, depth - 1, out);
            start = end;
        }
    }
}

/// The largest distance of the curve from a piece, measured midway between the places that it was fitted to.
fn between(curve: &dyn Fn(f64) -> [Vec2; 2], from: f64, to: f64, places: usize, piece: &[Vec2; 4]) -> f64 {
    let mut u = 0.0;
    (0..=places)
        .map(|i| {
            let s = (i as f64 + 0.5) / (places + 1) as f64;
            let p = curve(from + (to - from) * s)[0];
            u = if i == 0 { s } else { u + 1.0 / (places + 1) as f64 };
            (0..ROUNDS).for_each(|_| u = foot(piece, &p, u));
            length(&minus(&at(piece, u), &p))
        })
        .fold(0.0, f64::max)
}

/// The best cubic curve found through the first and last sample (point, derivative) with their tangents, and the
/// largest distance of a sample from it.
pub(super) fn cubic(samples: &[[Vec2; 2]]) -> ([Vec2; 4], f64) {
    let last = samples.len() - 1;
    let (first, end) = (samples[0][0], samples[last][0]);
    let mut u = vec![0.0];
    for w in samples.windows(2) {
        u.push(u[u.len() - 1] + length(&minus(&w[1][0], &w[0][0])));
    }
    let total = u[last];
    if total == 0.0 {
        return ([first, first, end, end], 0.0);
    }
    u.iter_mut().for_each(|v| *v /= total);
    // Where the derivative vanishes (a cusp), the chord to the next sample gives the direction.
    let way = |d: &Vec2, chord: Vec2| {
        let (n, m) = (length(d), length(&chord));
        if n > 0.0 { d.map(|c| c / n) } else { chord.map(|c| c / m.max(f64::MIN_POSITIVE)) }
    };
    let start = way(&samples[0][1], minus(&samples[1][0], &first));
    let stop = way(&samples[last][1], minus(&end, &samples[last - 1][0])).map(|c| -c);
    let mut best = ([first, first, end, end], f64::INFINITY);
    for _ in 0..ROUNDS {
        let arms = arms(samples, &u, &start, &stop, total);
        let b = [first, along(&first, &start, arms[0]), along(&end, &stop, arms[1]), end];
        let mut error: f64 = 0.0;
        for (i, sample) in samples.iter().enumerate().take(last).skip(1) {
            u[i] = foot(&b, &sample[0], u[i]);
            error = error.max(length(&minus(&at(&b, u[i]), &sample[0])));
        }
        if error < best.1 {
            best = (b, error);
        }
    }
    best
}

/// Distances from the ends to their control points, by least squares; a third of `total` where that has no usable
/// solution.
fn arms(samples: &[[Vec2; 2]], u: &[f64], start: &Vec2, stop: &Vec2, total: f64) -> [f64; 2] {
    let (first, end) = (samples[0][0], samples[samples.len() - 1][0]);
    let (mut c, mut x) = ([[0.0; 2]; 2], [0.0; 2]);
    for (sample, &t) in samples.iter().zip(u) {
        let s = 1.0 - t;
        let (b0, b1, b2, b3) = (s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t);
        let a = [start.map(|v| v * b1), stop.map(|v| v * b2)];
        let rest = [0, 1].map(|k| sample[0][k] - first[k] * (b0 + b1) - end[k] * (b2 + b3));
        for i in 0..2 {
            for j in 0..2 {
                c[i][j] += dot(&a[i], &a[j]);
            }
            x[i] += dot(&a[i], &rest);
        }
    }
    let determinant = c[0][0] * c[1][1] - c[0][1] * c[1][0];
    let third = total / 3.0;
    if determinant.abs() <= 1e-12 * c[0][0] * c[1][1] {
        return [third; 2];
    }
    let found = [(x[0] * c[1][1] - x[1] * c[0][1]) / determinant, (c[0][0] * x[1] - c[1][0] * x[0]) / determinant];
    // Control points behind the ends, or far beyond them, would make loops.
    if found.iter().all(|&v| v > 1e-6 * total && v < 2.0 * total) { found } else { [third; 2] }
}

/// One Newton step toward the foot point of p.
fn foot(b: &[Vec2; 4], p: &Vec2, t: f64) -> f64 {
    let s = 1.0 - t;
    let d = minus(&at(b, t), p);
    let [e0, e1, e2] = [0, 1, 2].map(|i| minus(&b[i + 1], &b[i]));
    let first = [0, 1].map(|k| 3.0 * (s * s * e0[k] + 2.0 * s * t * e1[k] + t * t * e2[k]));
    let second = [0, 1].map(|k| 6.0 * (s * (e1[k] - e0[k]) + t * (e2[k] - e1[k])));
    let slope = dot(&first, &first) + dot(&d, &second);
    if slope <= 0.0 { t } else { (t - dot(&d, &first) / slope).clamp(0.0, 1.0) }
}

fn along(p: &Vec2, direction: &Vec2, by: f64) -> Vec2 {
    [p[0] + direction[0] * by, p[1] + direction[1] * by]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(p: &Vec2, a: &Vec2, b: &Vec2) -> f64 {
        let (d, way) = (minus(p, a), minus(b, a));
        let s = (dot(&d, &way) / dot(&way, &way).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        length(&minus(&d, &way.map(|c| c * s)))
    }

    fn worst(chain: &Chain, curve: &dyn Fn(f64) -> [Vec2; 2], from: f64, to: f64) -> f64 {
        let drawn: Vec<Vec2> =
            chain.pieces().flat_map(|p| (0..200).map(|i| at(p, f64::from(i) / 199.0)).collect::<Vec<_>>()).collect();
        (0..500)
            .map(|i| curve(from + (to - from) * f64::from(i) / 499.0)[0])
            .map(|p| drawn.windows(2).map(|w| apart(&p, &w[0], &w[1])).fold(f64::INFINITY, f64::min))
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_spiral_within_tolerance_with_few_pieces() {
        let spiral = |t: f64| [[t * t.cos(), t * t.sin()], [t.cos() - t * t.sin(), t.sin() + t * t.cos()]];
        let chain = fit(&spiral, 1.0, 12.0, &[], 1, 0.01);
        assert!(worst(&chain, &spiral, 1.0, 12.0) < 0.0101);
        assert!(chain.points.len() <= 1 + 3 * 12, "{}", chain.points.len());
    }

    #[test]
    fn a_cusp_and_a_corner() {
        let cusp = |t: f64| [[t * t, t * t * t], [2.0 * t, 3.0 * t * t]];
        let chain = fit(&cusp, -1.0, 1.0, &[], 1, 0.001);
        assert!(worst(&chain, &cusp, -1.0, 1.0) < 0.01);
        let corner = |t: f64| [[t, t.abs()], [1.0, if t < 0.0 { -1.0 } else { 1.0 }]];
        let chain = fit(&corner, -1.0, 2.0, &[0.0], 1, 1e-6);
        assert_eq!(chain.points.len(), 7);
        assert_eq!(chain.points[3], [0.0, 0.0]);
    }
}
