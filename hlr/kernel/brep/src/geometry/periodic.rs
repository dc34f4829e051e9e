//! Converts periodic B-splines to non-periodic ones.

/// Knots and numbers of poles over one period, and over `more` periods on either side.
///
/// `ring`: the knots of one period, repeated by multiplicity, one for each pole. `begin`: number of copies of the first
/// knot, after the last of which the span of poles 0..=degree begins.
pub fn unrolled(ring: &[f64], begin: usize, period: f64, degree: usize, more: usize) -> (Vec<f64>, Vec<usize>) {
    let n = ring.len() as i64;
    let (p, begin, more) = (degree as i64, begin as i64, more as i64);
    let first = begin - 1 - p - more * n;
    let poles = n - (begin - 1) + p + 2 * more * n;
    let knot = |i: i64| ring[i.rem_euclid(n) as usize] + i.div_euclid(n) as f64 * period;
    let knots = (first..=first + poles + p).map(knot).collect();
    let order = (first..first + poles).map(|i| (i + p + 1 - begin).rem_euclid(n) as usize).collect();
    (knots, order)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::nurbs::{Nurbs, dehomogenized};

    #[test]
    fn a_closed_curve_comes_round() {
        for (ring, begin, degree) in [(vec![0.0, 1.0, 2.0, 3.5], 1, 3), (vec![0.0, 0.0, 1.0, 2.0, 2.0, 3.0], 2, 2)] {
            let poles: Vec<[f64; 4]> =
                (0..ring.len()).map(|i| [f64::from(i as u8 * i as u8 % 5), f64::from(i as u8), 0.5, 1.0]).collect();
            let (knots, order) = unrolled(&ring, begin, 4.0, degree, 1);
            let curve = Nurbs {
                degree,
                rational: false,
                sampled: false,
                knots,
                poles: order.iter().map(|&i| poles[i]).collect(),
            };
            assert_eq!(curve.domain(), (-4.0, 8.0));
            for t in [-3.7, -2.0, -0.4] {
                let at = |t: f64| dehomogenized(&curve.homogeneous(t))[0];
                for k in 0..3 {
                    assert!((at(t)[k] - at(t + 4.0)[k]).abs() < 1e-12);
                    assert!((at(t)[k] - at(t + 8.0)[k]).abs() < 1e-12);
                }
            }
        }
    }
}
