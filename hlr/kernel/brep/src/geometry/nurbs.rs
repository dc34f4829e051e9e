//! B-splines, rational or not, in homogeneous coordinates. (L. Piegl, W. Tiller, "The NURBS Book", 2nd edition, 1997:
//! A2.1 find span, A2.3 basis functions and their first derivatives.)

use super::basis::{Basis, values};

/// Highest degree that is evaluated; OpenCASCADE's own limit is 25.
pub const MOST_DEGREE: usize = 25;

/// A curve of degree p over knots u[0..n + p + 1] with n poles (x w, y w, z w, w); its domain is u[p]..u[n].
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    pub degree: usize,
    pub rational: bool,
    /// The curve is a close fit to samples of another curve, so its poles have no meaning of their own.
    pub sampled: bool,
    pub knots: Vec<f64>,
    pub poles: Vec<[f64; 4]>,
}

/// A2.1: the span [u[i], u[i + 1]) that holds t, clamped to the domain; never an empty span.
pub fn find_span(knots: &[f64], degree: usize, poles: usize, t: f64) -> usize {
    let (mut low, mut high) = (degree, poles);
    if t >= knots[high] {
        while high > degree + 1 && knots[high - 1] >= knots[high] {
            high -= 1;
        }
        return high - 1;
    }
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        if t < knots[middle] { high = middle } else { low = middle }
    }
    // Before the domain the first nonempty span continues.
    while knots[low + 1] <= knots[low] && low + 1 < poles {
        low += 1;
    }
    low
}

/// The poles of a spline that have a say over a range of its parameter.
pub fn used_poles(knots: &[f64], degree: usize, poles: usize, [first, last]: [f64; 2]) -> std::ops::Range<usize> {
    let low = find_span(knots, degree, poles, first.max(knots[degree]));
    let mut high = find_span(knots, degree, poles, last.min(knots[poles])).max(low);
    // A span that begins where the range ends has no say.
    while high > low && knots[high] >= last {
        high -= 1;
    }
    low - degree..high + 1
}

/// The nonzero basis functions on a span, with their first derivatives: out[k][j] is the k-th derivative of
/// N(span - degree + j). N: at least one more than the degree; short arrays are much faster.
pub fn basis<const N: usize>(knots: &[f64], degree: usize, span: usize, t: f64) -> [[f64; N]; 2] {
    let p = degree;
    let mut ndu = [[0.0; N]; N];
    let (mut left, mut right) = ([0.0; N], [0.0; N]);
    ndu[0][0] = 1.0;
    for j in 1..=p {
        left[j] = t - knots[span + 1 - j];
        right[j] = knots[span + j] - t;
        let mut saved = 0.0;
        for r in 0..j {
            ndu[j][r] = right[r + 1] + left[j - r];
            let part = ndu[r][j - 1] / ndu[j][r];
            ndu[r][j] = saved + right[r + 1] * part;
            saved = left[j - r] * part;
        }
        ndu[j][j] = saved;
    }
    let mut out = [[0.0; N]; 2];
    for j in 0..=p {
        out[0][j] = ndu[j][p];
        if p > 0 {
            let before = if j > 0 { 1.0 / ndu[p][j - 1] * ndu[j - 1][p - 1] } else { 0.0 };
            let after = if j < p { 1.0 / ndu[p][j] * ndu[j][p - 1] } else { 0.0 };
            out[1][j] = p as f64 * (before - after);
        }
    }
    out
}

impl Nurbs {
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.poles.len()])
    }

    /// Homogeneous point, first and second derivative.
    pub fn homogeneous(&self, t: f64) -> [[f64; 4]; 3] {
        match self.degree {
            0..=3 => self.by_basis::<4>(t),
            4..=7 => self.by_basis::<8>(t),
            8..=11 => self.by_basis::<12>(t),
            _ => self.by_basis::<{ MOST_DEGREE + 1 }>(t),
        }
    }

    /// The point alone, bit for bit that of the derivatives.
    pub fn point(&self, t: f64) -> [f64; 3] {
        match self.degree {
            0..=3 => self.by_values::<4>(t),
            4..=7 => self.by_values::<8>(t),
            8..=11 => self.by_values::<12>(t),
            _ => self.by_values::<{ MOST_DEGREE + 1 }>(t),
        }
    }

    fn by_values<const N: usize>(&self, t: f64) -> [f64; 3] {
        let (first, values) = values::<N>(&self.knots, self.degree, self.poles.len(), t);
        let mut sum = [0.0; 4];
        for (pole, value) in self.poles[first..=first + self.degree].iter().zip(&values) {
            for (sum, c) in sum.iter_mut().zip(pole) {
                *sum += c * value;
            }
        }
        let [x, y, z, w] = sum;
        [x / w, y / w, z / w]
    }

    fn by_basis<const N: usize>(&self, t: f64) -> [[f64; 4]; 3] {
        let basis = Basis::<N>::at(&self.knots, self.degree, self.poles.len(), t);
        let mut out = [[0.0; 4]; 3];
        for (row, values) in out.iter_mut().zip(&basis.rows) {
            for (pole, value) in self.poles[basis.first..=basis.first + self.degree].iter().zip(values) {
                for (sum, c) in row.iter_mut().zip(pole) {
                    *sum += c * value;
                }
            }
        }
        out
    }
}

/// From homogeneous to plain coordinates, with both derivatives (quotient rule; The NURBS Book, 4.8).
pub fn dehomogenized([a, b, c]: &[[f64; 4]; 3]) -> [[f64; 3]; 3] {
    let w = a[3];
    let p = [0, 1, 2].map(|k| a[k] / w);
    let d1 = [0, 1, 2].map(|k| (b[k] - b[3] * p[k]) / w);
    let d2 = [0, 1, 2].map(|k| (c[k] - 2.0 * b[3] * d1[k] - c[3] * p[k]) / w);
    [p, d1, d2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance, "{a} {b}");
    }

    #[test]
    fn a_rational_quarter_circle() {
        let s = 0.5f64.sqrt();
        let quarter = Nurbs {
            degree: 2,
            rational: true,
            sampled: false,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            poles: vec![[1.0, 0.0, 0.0, 1.0], [s, s, 0.0, s], [0.0, 1.0, 0.0, 1.0]],
        };
        for i in 0..=10 {
            let [p, d1, d2] = dehomogenized(&quarter.homogeneous(f64::from(i) * 0.1));
            close(p[0] * p[0] + p[1] * p[1], 1.0, 1e-14);
            close(p[0] * d1[0] + p[1] * d1[1], 0.0, 1e-13);
            // The second derivative of |p|^2 = 1.
            assert_eq!(p, quarter.point(f64::from(i) * 0.1));
            close(d1[0] * d1[0] + d1[1] * d1[1] + p[0] * d2[0] + p[1] * d2[1], 0.0, 1e-12);
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let curve = Nurbs {
            degree: 3,
            rational: true,
            sampled: false,
            knots: vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 3.0, 3.0, 3.0, 3.0],
            poles: (0..7u8)
                .map(|i| [f64::from(i), f64::from(i * i % 5), f64::from(i % 3), 1.0 + 0.1 * f64::from(i % 2)])
                .collect(),
        };
        let h = 1e-4;
        for t in [0.2, 0.9, 1.3, 2.2, 2.7] {
            let at = |t: f64| dehomogenized(&curve.homogeneous(t));
            let ([_, d1, d2], before, after) = (at(t), at(t - h), at(t + h));
            for k in 0..3 {
                close(d1[k], (after[0][k] - before[0][k]) / (2.0 * h), 1e-5);
                close(d2[k], (after[1][k] - before[1][k]) / (2.0 * h), 1e-5);
            }
        }
    }

    #[test]
    fn poles_are_used_where_their_spans_are() {
        let knots = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
        assert_eq!(used_poles(&knots, 2, 5, [0.0, 3.0]), 0..5);
        assert_eq!(used_poles(&knots, 2, 5, [0.0, 1.0]), 0..3);
        assert_eq!(used_poles(&knots, 2, 5, [1.2, 1.8]), 1..4);
        assert_eq!(used_poles(&knots, 2, 5, [f64::NEG_INFINITY, f64::INFINITY]), 0..5);
    }

    #[test]
    fn spans_at_the_ends_are_not_empty() {
        let knots = [0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
        assert_eq!(find_span(&knots, 1, 4, 0.0), 1);
        assert_eq!(find_span(&knots, 1, 4, 1.0), 3);
        assert_eq!(find_span(&knots, 1, 4, 2.0), 3);
        assert_eq!(find_span(&knots, 1, 4, -1.0), 1);
    }
}
