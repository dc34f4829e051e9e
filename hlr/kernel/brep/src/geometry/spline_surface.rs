//! Tensor-product B-splines, rational or not: points and first derivatives.
//!
//! L. Piegl, W. Tiller, "The NURBS Book", 2nd ed. 1997: A3.6 and A4.4 (surface points and derivatives).

use super::basis::{Basis, values};
use super::jet::Jet;
use super::nurbs::used_poles;
use super::spans::{Slopes, Spans};
use super::vector::{Vector, along, dot, length, scaled, sub};

/// Share of a surface's size: a pole within this distance of its expected place counts as being there.
const SAME: f64 = 1e-10;

pub const MAX_DEGREE: usize = 25;

#[derive(Clone, Debug)]
pub struct SplineSurface {
    degree: [usize; 2],
    count: [usize; 2],
    /// Periods of u and v; 0 where it is not periodic.
    period: [f64; 2],
    knots: [Vec<f64>; 2],
    /// (x w, y w, z w, w), v fastest.
    poles: Vec<[f64; 4]>,
    /// Polynomial spans along u and v; None if a degree is too high.
    spans: [Option<Spans>; 2],
}

impl SplineSurface {
    /// Reads the numbers of a record; None if they make no surface.
    pub fn read(data: &[f64]) -> Option<SplineSurface> {
        let (head, rest) = data.split_at_checked(6)?;
        let whole = |x: f64, most: f64| (x >= 1.0 && x <= most && x.fract() == 0.0).then_some(x as usize);
        let degree = [whole(head[0], MAX_DEGREE as f64)?, whole(head[1], MAX_DEGREE as f64)?];
        let count = [whole(head[2], 1e6)?, whole(head[3], 1e6)?];
        if count[0] <= degree[0] || count[1] <= degree[1] {
            return None;
        }
        let (u, rest) = rest.split_at_checked(count[0] + degree[0] + 1)?;
        let (v, rest) = rest.split_at_checked(count[1] + degree[1] + 1)?;
        let (poles, left) = rest.as_chunks::<4>();
        if poles.len() != count[0] * count[1] || !left.is_empty() || [u, v].iter().any(|k| !k.is_sorted()) {
            return None;
        }
        let poles = poles.iter().map(|&[x, y, z, w]| [x * w, y * w, z * w, w]).collect();
        let knots = [u.to_vec(), v.to_vec()];
        let stride = if degree[0].max(degree[1]) <= 3 { 4 } else { 8 };
        let spans = [0, 1].map(|k| Spans::new(&knots[k], degree[k], count[k], stride));
        // Either both or neither: the stride must fit both degrees.
        let spans = if spans.iter().all(Option::is_some) { spans } else { [None, None] };
        Some(SplineSurface { degree, count, period: [head[4], head[5]], knots, poles, spans })
    }

    /// Periods of u and v; 0 where it is not periodic.
    pub fn period(&self) -> [f64; 2] {
        self.period
    }

    /// Whether straight lines lead from side to side.
    pub fn is_ruled(&self) -> bool {
        (0..2).any(|k| self.degree[k] == 1 && self.count[k] == 2)
    }

    /// The poles that have a say over ranges of u and v; all of them beyond the domain.
    pub fn poles_over(&self, ranges: [[f64; 2]; 2]) -> impl Iterator<Item = Vector> {
        let [rows, columns] =
            [0, 1].map(|k| used_poles(&self.knots[k], self.degree[k], self.count[k], self.within(k, ranges[k])));
        let width = self.count[1];
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column)).map(|i| {
            let [x, y, z, w] = self.poles[i];
            [x / w, y / w, z / w]
        })
    }

    /// A range of u (0) or v (1); all of the domain where it reaches beyond that.
    pub fn within(&self, k: usize, [first, last]: [f64; 2]) -> [f64; 2] {
        let [low, high] = self.domain()[k];
        let slack = 1e-9 * (high - low);
        if first >= low - slack && last <= high + slack { [first, last] } else { [low, high] }
    }

    /// Degrees along u and v, counts of poles, and the poles (x w, y w, z w, w), v fastest.
    pub fn net(&self) -> ([usize; 2], [usize; 2], &[[f64; 4]]) {
        (self.degree, self.count, &self.poles)
    }

    /// Whether its weights differ from 1.
    pub fn is_rational(&self) -> bool {
        self.poles.iter().any(|p| p[3] != 1.0)
    }

    /// Lower and upper ends of u and v.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|k| [self.knots[k][self.degree[k]], self.knots[k][self.count[k]]])
    }

    pub fn point(&self, u: f64, v: f64) -> Vector {
        match self.degree[0].max(self.degree[1]) {
            0..=3 => self.sum::<4>(self.values(0, u), self.values(1, v)),
            4..=7 => self.sum::<8>(self.values(0, u), self.values(1, v)),
            8..=11 => self.sum::<12>(self.values(0, u), self.values(1, v)),
            _ => self.sum::<{ MAX_DEGREE + 1 }>(self.values(0, u), self.values(1, v)),
        }
    }

    fn sum<const N: usize>(&self, (i, a): (usize, [f64; N]), (j, b): (usize, [f64; N])) -> Vector {
        let mut sum = [0.0f64; 4];
        for (k, a) in a.iter().enumerate().take(self.degree[0] + 1) {
            let row = &self.poles[(i + k) * self.count[1] + j..][..=self.degree[1]];
            let mut inner = [0.0f64; 4];
            for (pole, b) in row.iter().zip(&b) {
                for c in 0..4 {
                    inner[c] += b * pole[c];
                }
            }
            for c in 0..4 {
                sum[c] += a * inner[c];
            }
        }
        scaled(&[sum[0], sum[1], sum[2]], 1.0 / sum[3])
    }

    /// The point, and the derivatives by u and v.
    pub fn d1(&self, u: f64, v: f64) -> (Vector, Vector, Vector) {
        // Short arrays are much faster; most surfaces are of low degree.
        match self.degree[0].max(self.degree[1]) {
            0..=3 => self.first_derivatives::<4>(u, v),
            4..=7 => self.first_derivatives::<8>(u, v),
            8..=11 => self.first_derivatives::<12>(u, v),
            _ => self.first_derivatives::<{ MAX_DEGREE + 1 }>(u, v),
        }
    }

    /// The point with first and second derivatives.
    pub fn jet(&self, u: f64, v: f64) -> Jet {
        match self.degree[0].max(self.degree[1]) {
            0..=3 => self.second_derivatives::<4>(u, v),
            4..=7 => self.second_derivatives::<8>(u, v),
            8..=11 => self.second_derivatives::<12>(u, v),
            _ => self.second_derivatives::<{ MAX_DEGREE + 1 }>(u, v),
        }
    }

    fn first_derivatives<const N: usize>(&self, u: f64, v: f64) -> (Vector, Vector, Vector) {
        let ((i, a), (j, b)) = (self.slopes::<N>(0, u), self.slopes::<N>(1, v));
        let mut sums = [[0.0f64; 4]; 3];
        for (row, (value_u, slope_u)) in (i..=i + self.degree[0]).zip(a[0].iter().zip(&a[1])) {
            let row = &self.poles[row * self.count[1] + j..][..=self.degree[1]];
            let mut inner = [[0.0f64; 4]; 2];
            for (pole, (value_v, slope_v)) in row.iter().zip(b[0].iter().zip(&b[1])) {
                for k in 0..4 {
                    inner[0][k] += value_v * pole[k];
                    inner[1][k] += slope_v * pole[k];
                }
            }
            for k in 0..4 {
                sums[0][k] += value_u * inner[0][k];
                sums[1][k] += slope_u * inner[0][k];
                sums[2][k] += value_u * inner[1][k];
            }
        }
        let [p, pu, pv] = sums;
        let point = scaled(&[p[0], p[1], p[2]], 1.0 / p[3]);
        let derived = |q: [f64; 4]| scaled(&sub(&[q[0], q[1], q[2]], &scaled(&point, q[3])), 1.0 / p[3]);
        (point, derived(pu), derived(pv))
    }

    fn second_derivatives<const N: usize>(&self, u: f64, v: f64) -> Jet {
        let (a, b) = (self.basis::<N>(0, u), self.basis::<N>(1, v));
        // Derivatives by u and v in the order 00, 10, 01, 20, 11, 02.
        let mut sums = [[0.0f64; 4]; 6];
        for i in 0..=self.degree[0] {
            let row = &self.poles[(a.first + i) * self.count[1] + b.first..][..=self.degree[1]];
            let mut inner = [[0.0f64; 4]; 3];
            for (j, pole) in row.iter().enumerate() {
                for (sum, values) in inner.iter_mut().zip(&b.rows) {
                    for k in 0..4 {
                        sum[k] += values[j] * pole[k];
                    }
                }
            }
            for (sum, (m, n)) in sums.iter_mut().zip([(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]) {
                for k in 0..4 {
                    sum[k] += a.rows[m][i] * inner[n][k];
                }
            }
        }
        let [p, pu, pv, puu, puv, pvv] = sums;
        let over = 1.0 / p[3];
        let point = scaled(&[p[0], p[1], p[2]], over);
        // (P - w_a S_b - ...) / w, for one derivative after another.
        let derived = |q: [f64; 4], less: &[(f64, Vector)]| {
            let start = along(&[q[0], q[1], q[2]], &point, -q[3]);
            scaled(&less.iter().fold(start, |sum, (w, s)| along(&sum, s, -w)), over)
        };
        let (du, dv) = (derived(pu, &[]), derived(pv, &[]));
        Jet {
            point,
            du,
            dv,
            duu: derived(puu, &[(2.0 * pu[3], du)]),
            duv: derived(puv, &[(pu[3], dv), (pv[3], du)]),
            dvv: derived(pvv, &[(2.0 * pv[3], dv)]),
        }
    }

    /// All knots of u (0) or v (1), the domain, and the period, 0 where there is none.
    pub fn knots(&self, side: usize) -> (&[f64], [f64; 2], f64) {
        let (p, knots) = (self.degree[side], &self.knots[side]);
        (knots, [knots[p], knots[self.count[side]]], self.period[side])
    }

    /// The parameter, u (0) or v (1), along which the surface is straight with a constant tangent plane, as on a
    /// cylinder or a cone over any curve; None where there is none.
    pub fn unrolls_along(&self) -> Option<usize> {
        [1, 0].into_iter().find(|&side| self.degree[side] == 1 && self.count[side] == 2 && self.is_scaled(side))
    }

    /// Whether one end curve is the other one, translated and scaled.
    fn is_scaled(&self, side: usize) -> bool {
        let pole = |i: usize, end: usize| {
            let [x, y, z, w] = self.poles[if side == 1 { i * self.count[1] + end } else { end * self.count[1] + i }];
            ([x / w, y / w, z / w], w)
        };
        let chords: Vec<[Vector; 2]> =
            (0..self.count[1 - side]).map(|i| [0, 1].map(|end| sub(&pole(i, end).0, &pole(0, end).0))).collect();
        let (mut up, mut squares, mut size) = (0.0, [0.0; 2], 0.0f64);
        for [a, b] in &chords {
            up += dot(a, b);
            squares = [squares[0] + dot(a, a), squares[1] + dot(b, b)];
            size = size.max(length(a)).max(length(b));
        }
        let far = (0..self.count[1 - side]).map(|i| length(&sub(&pole(i, 1).0, &pole(i, 0).0))).fold(size, f64::max);
        // Predicts the smaller end curve, which may be an apex, from the larger one.
        let large = usize::from(squares[1] > squares[0]);
        let scale = if squares[large] > 0.0 { up / squares[large] } else { return false };
        scale >= 0.0
            && chords.iter().all(|c| length(&along(&c[1 - large], &c[large], -scale)) <= SAME * far)
            && (0..chords.len()).all(|i| (pole(i, 0).1 / pole(i, 1).1 - 1.0).abs() <= SAME)
    }

    /// On a periodic side, the equivalent parameter within the domain.
    fn inside(&self, side: usize, x: f64) -> f64 {
        let (_, [low, high], period) = self.knots(side);
        if period > 0.0 && !(low..=high).contains(&x) { low + (x - low).rem_euclid(period) } else { x }
    }

    fn values<const N: usize>(&self, side: usize, x: f64) -> (usize, [f64; N]) {
        let x = self.inside(side, x);
        match &self.spans[side] {
            Some(spans) => spans.values(x),
            None => values(&self.knots[side], self.degree[side], self.count[side], x),
        }
    }

    fn slopes<const N: usize>(&self, side: usize, x: f64) -> Slopes<N> {
        let x = self.inside(side, x);
        match &self.spans[side] {
            Some(spans) => spans.slopes(x),
            None => {
                let Basis { first, rows: [values, slopes, _] } =
                    Basis::at(&self.knots[side], self.degree[side], self.count[side], x);
                (first, [values, slopes])
            }
        }
    }

    fn basis<const N: usize>(&self, side: usize, x: f64) -> Basis<N> {
        let x = self.inside(side, x);
        match &self.spans[side] {
            Some(spans) => spans.basis(x),
            None => Basis::at(&self.knots[side], self.degree[side], self.count[side], x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cylinder quarter x^2 + y^2 = 1 as a rational surface.
    fn quarter() -> SplineSurface {
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let mut data = vec![2.0, 1.0, 3.0, 2.0, 0.0, 0.0];
        data.extend([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0]);
        for (x, y, w) in [(1.0, 0.0, 1.0), (1.0, 1.0, w), (0.0, 1.0, 1.0)] {
            data.extend([x, y, 0.0, w, x, y, 3.0, w]);
        }
        SplineSurface::read(&data).unwrap()
    }

    #[test]
    fn a_rational_arc_is_a_circle() {
        for u in [0.0, 0.1, 0.5, 0.77, 1.0] {
            let (p, du, dv) = quarter().d1(u, 0.25);
            assert!((p[0] * p[0] + p[1] * p[1] - 1.0).abs() < 1e-14 && (p[2] - 0.75).abs() < 1e-14);
            assert!((p[0] * du[0] + p[1] * du[1]).abs() < 1e-14);
            assert!(dv[0].abs() < 1e-14 && (dv[2] - 3.0).abs() < 1e-14);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_points() {
        let (s, h) = (quarter(), 1e-6);
        let (a, b) = (s.d1(0.3 - h, 0.5).0, s.d1(0.3 + h, 0.5).0);
        let du = s.d1(0.3, 0.5).1;
        for k in 0..3 {
            assert!(((b[k] - a[k]) / (2.0 * h) - du[k]).abs() < 1e-8);
        }
    }

    #[test]
    fn records_of_the_wrong_length_are_refused() {
        assert!(SplineSurface::read(&[2.0, 1.0, 3.0]).is_none());
        assert!(
            SplineSurface::read(&[1.0, 1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 5.0]).is_none()
        );
    }
}
