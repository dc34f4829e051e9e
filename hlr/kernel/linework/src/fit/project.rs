//! Projects curves to paper: their formulas stay the same, with homogeneous plane vectors in place of vectors in space.
//! Parallel and central projection differ only in the third coordinate, which is constant for parallel projection.

use super::arc::grow;
use super::plane::Vec2;
use hlr_brep::geometry::curve::{Curve, Vec3};
use hlr_brep::geometry::nurbs::{MOST_DEGREE, basis, find_span};
use hlr_exact::elementary::{cosh, sin_cos, sinh};

/// The matrix that maps (x, y, z, 1) in the model to (x w, y w, w) on paper.
#[derive(Clone, Copy, Debug)]
pub struct Projection(pub [[f64; 4]; 3]);

impl Projection {
    fn homogeneous(&self, v: &Vec3, w: f64) -> Vec3 {
        self.0.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * w)
    }

    /// Whether the projection is parallel: w does not depend on the point.
    pub fn parallel(&self) -> bool {
        self.0[2] == [0.0, 0.0, 0.0, 1.0]
    }
}

/// A curve on paper. Vectors are (x w, y w, w).
#[derive(Clone, Debug)]
pub enum Paper {
    Line,
    Ellipse { p: Vec3, a: Vec3, b: Vec3 },
    Parabola { p: Vec3, a: Vec3, b: Vec3 },
    Hyperbola { p: Vec3, a: Vec3, b: Vec3 },
    Spline { degree: usize, rational: bool, knots: Vec<f64>, poles: Vec<Vec3> },
}

impl Paper {
    pub fn of(curve: &Curve, projection: &Projection) -> Paper {
        let three = |p: &Vec3, a: &Vec3, b: &Vec3| {
            (projection.homogeneous(p, 1.0), projection.homogeneous(a, 0.0), projection.homogeneous(b, 0.0))
        };
        match curve {
            Curve::Line { .. } => Paper::Line,
            Curve::Ellipse { p, a, b } => {
                let (p, a, b) = three(p, a, b);
                Paper::Ellipse { p, a, b }
            }
            Curve::Parabola { p, a, b } => {
                let (p, a, b) = three(p, a, b);
                Paper::Parabola { p, a, b }
            }
            Curve::Hyperbola { p, a, b } => {
                let (p, a, b) = three(p, a, b);
                Paper::Hyperbola { p, a, b }
            }
            Curve::Spline(n) => Paper::Spline {
                degree: n.degree,
                rational: n.rational || n.sampled || !projection.parallel(),
                knots: n.knots.clone(),
                poles: n.poles.iter().map(|q| projection.homogeneous(&[q[0], q[1], q[2]], q[3])).collect(),
            },
        }
    }

    /// Point and first derivative at a parameter.
    pub fn at(&self, t: f64) -> [Vec2; 2] {
        let form = |p: &Vec3, a: &Vec3, b: &Vec3, f: [[f64; 2]; 2]| {
            let sum = |k: usize| [0, 1, 2].map(|i| f[k][0] * a[i] + f[k][1] * b[i]);
            let q = sum(0);
            plain(&[p[0] + q[0], p[1] + q[1], p[2] + q[2]], &sum(1))
        };
        match self {
            Paper::Line => [[f64::NAN; 2]; 2],
            Paper::Ellipse { p, a, b } => {
                let (s, c) = sin_cos(t);
                form(p, a, b, [[c, s], [-s, c]])
            }
            Paper::Parabola { p, a, b } => form(p, a, b, [[t * t, t], [2.0 * t, 1.0]]),
            Paper::Hyperbola { p, a, b } => {
                let (s, c) = (sinh(t), cosh(t));
                form(p, a, b, [[c, s], [s, c]])
            }
            Paper::Spline { degree: degree @ 0..=3, knots, poles, .. } => on_spline::<4>(*degree, knots, poles, t),
            Paper::Spline { degree: degree @ 4..=7, knots, poles, .. } => on_spline::<8>(*degree, knots, poles, t),
            Paper::Spline { degree: degree @ 8..=11, knots, poles, .. } => on_spline::<12>(*degree, knots, poles, t),
            Paper::Spline { degree, knots, poles, .. } => on_spline::<{ MOST_DEGREE + 1 }>(*degree, knots, poles, t),
        }
    }

    /// How long the second derivative is at most, millimetres; None where that would take a search.
    pub fn most_bend(&self) -> Option<f64> {
        match self {
            Paper::Ellipse { p, a, b } if a[2] == 0.0 && b[2] == 0.0 => {
                Some((a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1]).sqrt() / p[2].abs())
            }
            _ => None,
        }
    }

    /// A box that holds all of the curve; None where that would take a search.
    pub fn bounds(&self) -> Option<[Vec2; 2]> {
        match self {
            Paper::Ellipse { p, a, b } if a[2] == 0.0 && b[2] == 0.0 => {
                let reach = [0, 1].map(|k| ((a[k] * a[k] + b[k] * b[k]).sqrt() / p[2]).abs());
                Some([-1.0, 1.0].map(|sign| [0, 1].map(|k| p[k] / p[2] + sign * reach[k])))
            }
            // Between poles, as long as no weight is negative.
            Paper::Spline { poles, .. } if poles.iter().all(|pole| pole[2] > 0.0) => {
                let mut out = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
                poles.iter().for_each(|pole| grow(&mut out, &[pole[0] / pole[2], pole[1] / pole[2]]));
                Some(out)
            }
            _ => None,
        }
    }

    /// Parameters inside (a, b) where the tangent may jump.
    pub fn corners(&self, a: f64, b: f64) -> Vec<f64> {
        let Paper::Spline { degree, knots, .. } = self else { return Vec::new() };
        let mut out: Vec<f64> = knots.windows(*degree).filter(|w| w[0] == w[degree - 1]).map(|w| w[0]).collect();
        out.retain(|&t| t > a && t < b);
        out.dedup();
        out
    }

    /// How many polynomial pieces lie between two parameters.
    pub fn spans(&self, a: f64, b: f64) -> usize {
        let Paper::Spline { knots, .. } = self else { return 4 };
        1 + knots.windows(2).filter(|w| w[0] < w[1] && w[1] > a && w[1] < b).count()
    }
}

fn on_spline<const N: usize>(degree: usize, knots: &[f64], poles: &[Vec3], t: f64) -> [Vec2; 2] {
    let span = find_span(knots, degree, poles.len(), t);
    let mut sums = [[0.0; 3]; 2];
    for (row, value) in sums.iter_mut().zip(&basis::<N>(knots, degree, span, t)) {
        for (pole, v) in poles[span - degree..=span].iter().zip(value) {
            for (sum, c) in row.iter_mut().zip(pole) {
                *sum += c * v;
            }
        }
    }
    plain(&sums[0], &sums[1])
}

fn plain(v: &Vec3, d: &Vec3) -> [Vec2; 2] {
    let (x, y) = (v[0] / v[2], v[1] / v[2]);
    [[x, y], [(d[0] - d[2] * x) / v[2], (d[1] - d[2] * y) / v[2]]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_stays_within_its_box_and_fills_that_of_an_ellipse() {
        let (p, a, b) = ([3.0, -2.0, 2.0], [8.0, 1.0, 0.0], [-1.0, 5.0, 0.0]);
        let poles = vec![[0.0, 0.0, 1.0], [2.0, 6.0, 2.0], [9.0, -3.0, 3.0], [4.0, 4.0, 1.0]];
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let spline = Paper::Spline { degree: 3, rational: true, knots, poles };
        for (paper, end) in [(Paper::Ellipse { p, a, b }, std::f64::consts::TAU), (spline, 1.0)] {
            let [low, high] = paper.bounds().expect("known without a search");
            let mut seen = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
            (0..=1000).for_each(|k| grow(&mut seen, &paper.at(end * f64::from(k) / 1000.0)[0]));
            for k in 0..2 {
                assert!(low[k] <= seen[0][k] + 1e-12 && seen[1][k] <= high[k] + 1e-12);
                assert!(end == 1.0 || (seen[0][k] - low[k] < 1e-4 && high[k] - seen[1][k] < 1e-4));
            }
        }
        assert!(Paper::Line.bounds().is_none());
    }
}
