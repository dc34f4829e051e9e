//! An upper bound on the distance between a curve and its chord.

use crate::geometry::curve::{Curve, Vec3};
use crate::geometry::nurbs::{MOST_DEGREE, Nurbs, find_span};
use crate::geometry::vector::{add, along, dot, length, scaled, sub};
use hlr_exact::elementary::{self, sin_cos};

/// A bound on the distance between the curve from `a` to `b` and its chord.
pub fn chord_error(curve: &Curve, a: f64, b: f64) -> f64 {
    let h = 0.5 * (b - a);
    let middle = 0.5 * (a + b);
    let sum = |p: &Vec3, x: f64, q: &Vec3, y: f64| add(&scaled(p, x), &scaled(q, y));
    // Length of the part of a vector that is perpendicular to a chord.
    let upright = |v: &Vec3, chord: &Vec3| {
        let square = dot(chord, chord);
        if square > 0.0 { length(&along(v, chord, -dot(v, chord) / square)) } else { length(v) }
    };
    match curve {
        Curve::Line { .. } => 0.0,
        Curve::Ellipse { a: x, b: y, .. } => {
            // Beyond half a turn the chord gives no bound on the arc.
            let (sin, cos) = sin_cos(middle);
            if h >= std::f64::consts::FRAC_PI_2 {
                return length(x) + length(y);
            }
            (1.0 - elementary::cos(h)) * upright(&sum(x, cos, y, sin), &sum(x, -sin, y, cos))
        }
        Curve::Parabola { a: x, b: y, .. } => h * h * upright(x, &sum(x, 2.0 * middle, y, 1.0)),
        Curve::Hyperbola { a: x, b: y, .. } => {
            let (sinh, cosh) = (elementary::sinh(middle), elementary::cosh(middle));
            (elementary::cosh(h) - 1.0) * upright(&sum(x, cosh, y, sinh), &sum(x, sinh, y, cosh))
        }
        Curve::Spline(n) => spline_error(n, a, b),
    }
}

/// Every piece lies within the convex hull of its control points, and the distance to a chord is a convex function.
fn spline_error(n: &Nurbs, a: f64, b: f64) -> f64 {
    let (from, to) = (n.point(a), n.point(b));
    let p = n.degree;
    let mut worst = 0.0f64;
    for [low, high] in pieces(n, a, b) {
        let (mut outer, mut inner) = (0.0f64, 0.0f64);
        let (mut heaviest, mut lightest) = (0.0f64, f64::INFINITY);
        let span = find_span(&n.knots, p, n.poles.len(), 0.5 * (low + high));
        for j in 0..=p {
            let [x, y, z, w] = blossom(n, span, low, high, j);
            let off = from_chord(&[x / w, y / w, z / w], &from, &to);
            if j == 0 || j == p {
                (outer, lightest) = (outer.max(off), lightest.min(w));
            } else {
                (inner, heaviest) = (inner.max(off), heaviest.max(w));
            }
        }
        // The inner control points together never have the full weight.
        let ends = 0.5f64.powi(p as i32 - 1);
        let inner_share = (1.0 - ends) * heaviest / ((1.0 - ends) * heaviest + ends * lightest);
        worst = worst.max(outer).max(inner_share * inner + (1.0 - inner_share) * outer);
    }
    worst
}

/// The parts of a..b between knots of the spline.
fn pieces(n: &Nurbs, a: f64, b: f64) -> impl Iterator<Item = [f64; 2]> + '_ {
    let inner = &n.knots[n.degree..=n.poles.len()];
    let first = inner.partition_point(|&k| k <= a);
    let last = inner.partition_point(|&k| k < b);
    let mut low = a;
    let knots = if first < last { &inner[first..last] } else { &[] };
    knots.iter().copied().chain([b]).filter_map(move |high| {
        let piece = [low, high];
        low = high;
        (piece[1] > piece[0]).then_some(piece)
    })
}

/// Control point j of the piece low..high of a span: the polar form with `high` j times, `low` otherwise (de Boor).
fn blossom(n: &Nurbs, span: usize, low: f64, high: f64, j: usize) -> [f64; 4] {
    // Short arrays are much faster; most curves are of low degree.
    match n.degree {
        0..=3 => polar::<4>(n, span, low, high, j),
        4..=7 => polar::<8>(n, span, low, high, j),
        8..=11 => polar::<12>(n, span, low, high, j),
        _ => polar::<{ MOST_DEGREE + 1 }>(n, span, low, high, j),
    }
}

fn polar<const N: usize>(n: &Nurbs, span: usize, low: f64, high: f64, j: usize) -> [f64; 4] {
    let p = n.degree;
    let mut d = [[0.0; 4]; N];
    d[..=p].copy_from_slice(&n.poles[span - p..=span]);
    for r in 1..=p {
        let t = if r <= j { high } else { low };
        for i in (r..=p).rev() {
            let (left, right) = (n.knots[span - p + i], n.knots[span + 1 + i - r]);
            let share = (t - left) / (right - left);
            d[i] = [0, 1, 2, 3].map(|k| (1.0 - share) * d[i - 1][k] + share * d[i][k]);
        }
    }
    d[p]
}

/// Distance from a point to a chord, which ends at a and b.
pub fn from_chord(p: &Vec3, a: &Vec3, b: &Vec3) -> f64 {
    let (d, q) = (sub(b, a), sub(p, a));
    let square = dot(&d, &d);
    let share = if square > 0.0 { (dot(&q, &d) / square).clamp(0.0, 1.0) } else { 0.0 };
    length(&along(&q, &d, -share))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(curve: &Curve, a: f64, b: f64) -> f64 {
        let (from, to) = (curve.point(a), curve.point(b));
        (0..=100).map(|i| from_chord(&curve.point(a + 0.01 * f64::from(i) * (b - a)), &from, &to)).fold(0.0, f64::max)
    }

    #[test]
    fn a_bound_is_never_too_small_and_hardly_too_large() {
        let (p, a, b) = ([1.0, 2.0, 3.0], [2.0, 0.0, 0.5], [0.0, 1.0, 0.0]);
        let wavy: Vec<[f64; 4]> = (0..9u8)
            .map(|i| {
                let (x, y) = (f64::from(i), f64::from(i * i % 7));
                let w = 1.0 + 0.2 * f64::from(i % 3);
                [x * w, y * w, 0.0, w]
            })
            .collect();
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.5, 6.0, 6.0, 6.0, 6.0];
        let plain = wavy.iter().map(|[x, y, z, w]| [x / w, y / w, z / w, 1.0]).collect();
        let spline =
            |rational, poles| Curve::Spline(Nurbs { degree: 3, rational, sampled: false, knots: knots.clone(), poles });
        for curve in [
            Curve::Ellipse { p, a, b },
            Curve::Parabola { p, a, b },
            Curve::Hyperbola { p, a, b },
            spline(true, wavy.clone()),
            spline(false, plain),
        ] {
            for i in 0..40 {
                let from = 0.1 * f64::from(i);
                let to = from + 0.2 + 0.01 * f64::from(i);
                let (bound, real) = (chord_error(&curve, from, to), measured(&curve, from, to));
                assert!(bound >= real - 1e-12, "{curve:?} {from} {to}: {bound} {real}");
                assert!(bound <= 5.0 * real + 1e-12, "{curve:?} {from} {to}: {bound} {real}");
            }
        }
    }
}
