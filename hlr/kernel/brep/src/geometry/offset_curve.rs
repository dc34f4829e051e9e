//! Offset curves: exact for lines and circles, close spline approximations for all others.

use super::curve::{Curve, Vec3};
use super::nurbs::Nurbs;
use super::vector::{add, along, cross, dot, length, scaled, sub, unit};

/// Tolerance of the fit, as a share of the curve's size.
const CLOSE: f64 = 1e-9;
const MOST_PIECES: usize = 4000;

/// The curve at a distance along tangent x `way`; None where it cannot be represented.
pub fn offset_curve(basis: &Curve, distance: f64, way: &Vec3) -> Option<Curve> {
    let way = unit(way)?;
    match basis {
        Curve::Line { p, a } => {
            let side = unit(&cross(a, &way))?;
            Some(Curve::Line { p: along(p, &side, distance), a: *a })
        }
        Curve::Ellipse { p, a, b } => {
            let (one, two) = (length(a), length(b));
            let upright = dot(&unit(&cross(a, b))?, &way);
            if (one - two).abs() <= 1e-12 * one && dot(a, b).abs() <= 1e-12 * one * two && upright.abs() > 1.0 - 1e-12 {
                // Outward if the curve turns counterclockwise about `way`.
                let radius = one + distance * upright.signum();
                return Some(Curve::Ellipse { p: *p, a: scaled(a, radius / one), b: scaled(b, radius / two) });
            }
            let turn = std::f64::consts::TAU;
            followed(basis, distance, &way, &[-turn, 0.0, turn, 2.0 * turn])
        }
        Curve::Spline(n) => {
            let (first, last) = n.domain();
            let mut breaks = vec![first];
            breaks.extend(n.knots.iter().copied().filter(|&k| k > first && k <= last));
            breaks.dedup();
            followed(basis, distance, &way, &breaks)
        }
        _ => None,
    }
}

/// A cubic spline that interpolates points and derivatives of the offset curve.
fn followed(basis: &Curve, distance: f64, way: &Vec3, breaks: &[f64]) -> Option<Curve> {
    let at = |t: f64| -> Option<(Vec3, Vec3)> {
        let [p, d, dd] = basis.derivatives(t);
        let n = cross(&d, way);
        let size = length(&n);
        if size <= 1e-12 * length(&d) || !size.is_finite() {
            return None;
        }
        let side = scaled(&n, 1.0 / size);
        let turned = cross(&dd, way);
        let turning = scaled(&sub(&turned, &scaled(&side, dot(&side, &turned))), 1.0 / size);
        Some((along(&p, &side, distance), along(&d, &turning, distance)))
    };
    let size = breaks.iter().map(|&t| length(&sub(&basis.point(t), &basis.point(breaks[0])))).fold(0.0, f64::max);
    let close = CLOSE * size.max(distance.abs());
    let mut places = vec![(breaks[0], at(breaks[0])?)];
    let mut ahead: Vec<f64> = breaks[1..].iter().rev().copied().collect();
    while let Some(&next) = ahead.last() {
        let (t, (p, d)) = places[places.len() - 1];
        let (q, e) = at(next)?;
        let h = next - t;
        // The middle of the cubic piece.
        let middle = add(&scaled(&add(&p, &q), 0.5), &scaled(&sub(&d, &e), h / 8.0));
        let half = f64::midpoint(t, next);
        if length(&sub(&middle, &at(half)?.0)) > close && half > t && half < next {
            if places.len() + ahead.len() > MOST_PIECES {
                return None;
            }
            ahead.push(half);
            continue;
        }
        ahead.pop();
        places.push((next, (q, e)));
    }
    let (mut knots, mut poles) = (vec![places[0].0; 4], vec![places[0].1.0]);
    for pair in places.windows(2) {
        let [(t, (p, d)), (u, (q, e))] = [pair[0], pair[1]];
        poles.extend([along(&p, &d, (u - t) / 3.0), along(&q, &e, (t - u) / 3.0)]);
        knots.extend([u, u]);
    }
    let (last, (end, _)) = places[places.len() - 1];
    poles.push(end);
    knots.extend([last, last]);
    let poles = poles.iter().map(|&[x, y, z]| [x, y, z, 1.0]).collect();
    Some(Curve::Spline(Nurbs { degree: 3, rational: false, sampled: true, knots, poles }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beside_a_circle_runs_a_circle() {
        let circle = Curve::Ellipse { p: [1.0, 0.0, 0.0], a: [2.0, 0.0, 0.0], b: [0.0, 2.0, 0.0] };
        let found = offset_curve(&circle, 0.5, &[0.0, 0.0, 1.0]).unwrap();
        assert_eq!(found.point(0.0), [3.5, 0.0, 0.0]);
    }

    #[test]
    fn beside_an_ellipse_every_place_has_the_distance() {
        let ellipse = Curve::Ellipse { p: [0.0; 3], a: [3.0, 0.0, 0.0], b: [0.0, 2.0, 0.0] };
        let found = offset_curve(&ellipse, 0.25, &[0.0, 0.0, 1.0]).unwrap();
        for i in 0..200 {
            let t = 0.0313 * f64::from(i);
            let apart = sub(&found.point(t), &ellipse.point(t));
            assert!((length(&apart) - 0.25).abs() < 1e-7, "{t}: {}", length(&apart));
            assert!(dot(&apart, &ellipse.point(t)) > 0.0);
        }
    }
}
