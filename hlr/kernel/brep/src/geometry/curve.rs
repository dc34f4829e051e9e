//! Curves in space, written as affine combinations of vectors: any affine placement transforms the vectors alone.
//!
//! ```text
//!   line        p + t a
//!   ellipse     p + cos t a + sin t b        circles as well
//!   parabola    p + t^2 a + t b
//!   hyperbola   p + cosh t a + sinh t b
//!   B-spline    poles, weights, knots
//! ```

use super::nurbs::{MOST_DEGREE, Nurbs, dehomogenized};
use hlr_exact::elementary::{cosh, sin_cos, sinh};

pub type Vec3 = [f64; 3];

#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    Line { p: Vec3, a: Vec3 },
    Ellipse { p: Vec3, a: Vec3, b: Vec3 },
    Parabola { p: Vec3, a: Vec3, b: Vec3 },
    Hyperbola { p: Vec3, a: Vec3, b: Vec3 },
    Spline(Nurbs),
}

/// Kinds of records, as `hlr.source.curve_records` writes them; 0 is an unsupported curve.
pub const LINE: u8 = 1;
pub const ELLIPSE: u8 = 2;
pub const PARABOLA: u8 = 3;
pub const HYPERBOLA: u8 = 4;
pub const SPLINE: u8 = 5;

impl Curve {
    /// Reads the numbers of a record: three vectors, or (degree, poles, rational, knots, poles of x y z w). `rational`
    /// is 2 for a sampled curve. None if the numbers make no curve.
    pub fn from_record(kind: u8, values: &[f64]) -> Option<Curve> {
        if kind == SPLINE {
            let [degree, count, rational, rest @ ..] = values else { return None };
            let (degree, count) = (*degree as usize, *count as usize);
            if degree == 0 || degree > MOST_DEGREE || count <= degree || rest.len() != count + degree + 1 + 4 * count {
                return None;
            }
            let (knots, poles) = rest.split_at(count + degree + 1);
            if knots.windows(2).any(|w| w[0] > w[1]) || knots[degree] >= knots[count] {
                return None;
            }
            let poles = poles.as_chunks::<4>().0.iter().map(|&[x, y, z, w]| [x * w, y * w, z * w, w]).collect();
            return Some(Curve::Spline(Nurbs {
                degree,
                rational: *rational == 1.0,
                sampled: *rational == 2.0,
                knots: knots.to_vec(),
                poles,
            }));
        }
        let [p, a, b] = values.as_chunks::<3>().0 else { return None };
        let (p, a, b) = (*p, *a, *b);
        match kind {
            LINE => Some(Curve::Line { p, a }),
            ELLIPSE => Some(Curve::Ellipse { p, a, b }),
            PARABOLA => Some(Curve::Parabola { p, a, b }),
            HYPERBOLA => Some(Curve::Hyperbola { p, a, b }),
            _ => None,
        }
    }

    /// Appends the numbers of the curve's record to `values`, and returns its kind.
    pub fn record(&self, values: &mut Vec<f64>) -> u8 {
        let (kind, three) = match self {
            Curve::Line { p, a } => (LINE, [*p, *a, [0.0; 3]]),
            Curve::Ellipse { p, a, b } => (ELLIPSE, [*p, *a, *b]),
            Curve::Parabola { p, a, b } => (PARABOLA, [*p, *a, *b]),
            Curve::Hyperbola { p, a, b } => (HYPERBOLA, [*p, *a, *b]),
            Curve::Spline(n) => {
                let form = if n.sampled { 2.0 } else { f64::from(u8::from(n.rational)) };
                values.extend([n.degree as f64, n.poles.len() as f64, form]);
                values.extend(&n.knots);
                values.extend(n.poles.iter().flat_map(|[x, y, z, w]| [x / w, y / w, z / w, *w]));
                return SPLINE;
            }
        };
        values.extend(three.as_flattened());
        kind
    }

    /// The curve moved by a (3, 4) matrix.
    pub fn moved(&self, m: &[[f64; 4]; 3]) -> Curve {
        let turn = |v: &Vec3, w: f64| m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * w);
        let (point, vector) = (|v: &Vec3| turn(v, 1.0), |v: &Vec3| turn(v, 0.0));
        match self {
            Curve::Line { p, a } => Curve::Line { p: point(p), a: vector(a) },
            Curve::Ellipse { p, a, b } => Curve::Ellipse { p: point(p), a: vector(a), b: vector(b) },
            Curve::Parabola { p, a, b } => Curve::Parabola { p: point(p), a: vector(a), b: vector(b) },
            Curve::Hyperbola { p, a, b } => Curve::Hyperbola { p: point(p), a: vector(a), b: vector(b) },
            Curve::Spline(n) => {
                let move_pole = |&[x, y, z, w]: &[f64; 4]| {
                    let [x, y, z] = turn(&[x, y, z], w);
                    [x, y, z, w]
                };
                Curve::Spline(Nurbs { poles: n.poles.iter().map(move_pole).collect(), ..n.clone() })
            }
        }
    }

    /// Point, first and second derivative.
    pub fn derivatives(&self, t: f64) -> [Vec3; 3] {
        let form = |p: &Vec3, a: &Vec3, b: &Vec3, f: [[f64; 2]; 3]| {
            let sum = |k: usize| [0, 1, 2].map(|i| f[k][0] * a[i] + f[k][1] * b[i]);
            let q = sum(0);
            [[p[0] + q[0], p[1] + q[1], p[2] + q[2]], sum(1), sum(2)]
        };
        match self {
            Curve::Line { p, a } => form(p, a, &[0.0; 3], [[t, 0.0], [1.0, 0.0], [0.0, 0.0]]),
            Curve::Ellipse { p, a, b } => {
                let (s, c) = sin_cos(t);
                form(p, a, b, [[c, s], [-s, c], [-c, -s]])
            }
            Curve::Parabola { p, a, b } => form(p, a, b, [[t * t, t], [2.0 * t, 1.0], [2.0, 0.0]]),
            Curve::Hyperbola { p, a, b } => {
                let (s, c) = (sinh(t), cosh(t));
                form(p, a, b, [[c, s], [s, c], [c, s]])
            }
            Curve::Spline(n) => dehomogenized(&n.homogeneous(t)),
        }
    }

    pub fn point(&self, t: f64) -> Vec3 {
        match self {
            Curve::Line { p, a } => [p[0] + t * a[0], p[1] + t * a[1], p[2] + t * a[2]],
            Curve::Ellipse { p, a, b } => {
                let (s, c) = sin_cos(t);
                [0, 1, 2].map(|i| p[i] + (c * a[i] + s * b[i]))
            }
            Curve::Spline(n) => n.point(t),
            _ => self.derivatives(t)[0],
        }
    }

    /// Range of t; `size` replaces an infinite end.
    pub fn domain(&self, size: f64) -> [f64; 2] {
        match self {
            Curve::Ellipse { .. } => [0.0, std::f64::consts::TAU],
            Curve::Spline(n) => n.domain().into(),
            _ => [-size, size],
        }
    }

    /// The period of the curve in t; 0 where it is not periodic, or not known to be.
    pub fn period(&self) -> f64 {
        if matches!(self, Curve::Ellipse { .. }) { std::f64::consts::TAU } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_that_makes_no_curve_is_refused() {
        assert_eq!(Curve::from_record(LINE, &[0.0; 8]), None);
        assert_eq!(Curve::from_record(9, &[0.0; 9]), None);
        assert_eq!(Curve::from_record(SPLINE, &[1.0, 2.0, 0.0, 0.0, 0.0, 1.0, 1.0]), None);
        let falling = [1.0, 2.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0];
        assert_eq!(Curve::from_record(SPLINE, &falling), None);
    }

    #[test]
    fn a_moved_curve_is_the_curve_of_moved_points() {
        let m = [[0.0, -2.0, 0.5, 1.0], [1.0, 0.0, 0.0, -3.0], [0.0, 1.0, 1.0, 0.0]];
        let apply = |v: Vec3| m.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3]);
        let nine = [1.0, 2.0, 3.0, 0.5, 0.0, 1.0, 0.0, 2.0, 0.0];
        for kind in [LINE, ELLIPSE, PARABOLA, HYPERBOLA] {
            let Some(curve) = Curve::from_record(kind, &nine) else { panic!() };
            let mut values = Vec::new();
            assert_eq!(curve.record(&mut values), kind);
            assert_eq!(Curve::from_record(kind, &values), Some(curve.clone()));
            let (a, b) = (curve.moved(&m).point(0.7), apply(curve.point(0.7)));
            assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-12));
        }
    }
}
