//! Basis functions of a B-spline that is evaluated often, stored as polynomial coefficients for each knot span.

use super::basis::Basis;

/// Powers of higher degrees lose digits: up to 7 the error stays within a few hundred roundings.
pub const MOST_DEGREE: usize = 7;

#[derive(Clone, Debug)]
pub struct Spans {
    degree: usize,
    /// Number of coefficients stored per power: one for each function, and spare ones.
    stride: usize,
    spans: Vec<Span>,
    /// Coefficients by span, then from the highest power down, then by function.
    powers: Vec<f64>,
    low: f64,
    /// Number of equal cells per unit of the parameter, and the number of the span at the beginning of each cell.
    per: f64,
    begins: Vec<u32>,
}

/// The number of the first nonzero function; values and first derivatives.
pub type Slopes<const N: usize> = (usize, [[f64; N]; 2]);

#[derive(Clone, Copy, Debug)]
struct Span {
    start: f64,
    middle: f64,
    /// The reciprocal of half the span's length.
    scale: f64,
    /// The number of the first nonzero function.
    first: u32,
}

impl Spans {
    /// None if the degree is too high, or no span has a length.
    pub fn new(knots: &[f64], degree: usize, count: usize, stride: usize) -> Option<Spans> {
        if degree > MOST_DEGREE || degree >= stride {
            return None;
        }
        let (mut spans, mut powers) = (Vec::new(), Vec::new());
        for span in degree..count {
            let (start, end) = (knots[span], knots[span + 1]);
            if start < end {
                let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
                spans.push(Span { start, middle, scale: 1.0 / half, first: (span - degree) as u32 });
                let functions = polynomials(knots, degree, span, middle, half);
                for power in (0..=degree).rev() {
                    powers.extend((0..stride).map(|r| if r <= degree { functions[r][power] } else { 0.0 }));
                }
            }
        }
        let (low, high) = (spans.first()?.start, knots[count]);
        let shares = 2 * spans.len();
        let per = shares as f64 / (high - low);
        let begins = (0..shares).map(|k| {
            let x = low + k as f64 / per;
            spans.partition_point(|s| s.start <= x).max(1) as u32 - 1
        });
        let begins = begins.collect();
        Some(Spans { degree, stride, spans, powers, low, per, begins })
    }

    fn find(&self, x: f64) -> usize {
        let share = ((x - self.low) * self.per).max(0.0) as usize;
        let mut k = self.begins[share.min(self.begins.len() - 1)] as usize;
        while k > 0 && self.spans[k].start > x {
            k -= 1;
        }
        while k + 1 < self.spans.len() && self.spans[k + 1].start <= x {
            k += 1;
        }
        k
    }

    /// The span of a parameter, its coefficients, and the parameter within the span: -1 to 1.
    fn at<const N: usize>(&self, x: f64) -> (&Span, &[[f64; N]], f64) {
        let k = self.find(x);
        let span = &self.spans[k];
        let size = (self.degree + 1) * self.stride;
        (span, self.powers[k * size..(k + 1) * size].as_chunks().0, (x - span.middle) * span.scale)
    }

    /// Values, first and second derivatives at a parameter. N: the stride.
    pub fn basis<const N: usize>(&self, x: f64) -> Basis<N> {
        let (span, powers, t) = self.at::<N>(x);
        let (mut value, mut slope, mut bend) = ([0.0; N], [0.0; N], [0.0; N]);
        for row in powers {
            for r in 0..N {
                bend[r] = bend[r] * t + slope[r];
                slope[r] = slope[r] * t + value[r];
                value[r] = value[r] * t + row[r];
            }
        }
        let twice = 2.0 * span.scale * span.scale;
        for r in 0..N {
            slope[r] *= span.scale;
            bend[r] *= twice;
        }
        Basis { first: span.first as usize, rows: [value, slope, bend] }
    }

    /// Values and first derivatives at a parameter. N: the stride.
    pub fn slopes<const N: usize>(&self, x: f64) -> Slopes<N> {
        let (span, powers, t) = self.at::<N>(x);
        let (mut value, mut slope) = ([0.0; N], [0.0; N]);
        for row in powers {
            for r in 0..N {
                slope[r] = slope[r] * t + value[r];
                value[r] = value[r] * t + row[r];
            }
        }
        for slope in &mut slope {
            *slope *= span.scale;
        }
        (span.first as usize, [value, slope])
    }

    /// The number of the first nonzero function, and the values.
    pub fn values<const N: usize>(&self, x: f64) -> (usize, [f64; N]) {
        let (span, powers, t) = self.at::<N>(x);
        let mut value = [0.0; N];
        for row in powers {
            for r in 0..N {
                value[r] = value[r] * t + row[r];
            }
        }
        (span.first as usize, value)
    }
}

/// The nonzero functions on a span, as coefficients of the powers of (x - middle) / half.
fn polynomials(
    knots: &[f64],
    degree: usize,
    span: usize,
    middle: f64,
    half: f64,
) -> [[f64; MOST_DEGREE + 1]; MOST_DEGREE + 1] {
    const N: usize = MOST_DEGREE + 1;
    let mut functions = [[0.0; N]; N];
    functions[0][0] = 1.0;
    // Multiplies by (constant + slope t).
    let times = |f: &[f64; N], constant: f64, slope: f64| {
        let mut out = [0.0; N];
        for k in 0..N {
            out[k] = constant * f[k] + if k > 0 { slope * f[k - 1] } else { 0.0 };
        }
        out
    };
    for q in 1..=degree {
        let mut saved = [0.0; N];
        for r in 0..q {
            let (left, right) = (knots[span + 1 + r - q], knots[span + r + 1]);
            let share = functions[r].map(|c| c / (right - left));
            let falling = times(&share, right - middle, -half);
            for (k, c) in functions[r].iter_mut().enumerate() {
                *c = saved[k] + falling[k];
            }
            saved = times(&share, middle - left, half);
        }
        functions[q] = saved;
    }
    functions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_give_what_the_knots_give() {
        for degree in 1..=MOST_DEGREE {
            let inner = [0.3, 0.3, 1.0, 1.001, 2.5, 4.0];
            let knots: Vec<f64> = std::iter::repeat_n(-1.0, degree + 1)
                .chain(inner.into_iter().skip(usize::from(degree == 1)))
                .chain(std::iter::repeat_n(7.0, degree + 1))
                .collect();
            let count = knots.len() - degree - 1;
            let spans = Spans::new(&knots, degree, count, 8).unwrap();
            for i in -5..=85 {
                let x = -1.0 + 0.1 * f64::from(i);
                let (got, want) = (spans.basis::<8>(x), Basis::<8>::at(&knots, degree, count, x));
                assert_eq!(got.first, want.first, "{degree} {x}");
                assert_eq!(got.rows[0], spans.values::<8>(x).1);
                assert_eq!((got.first, [got.rows[0], got.rows[1]]), spans.slopes::<8>(x));
                for (k, (a, b)) in got.rows.iter().zip(&want.rows).enumerate() {
                    let size = b.iter().fold(1.0f64, |m, c| m.max(c.abs()));
                    for r in 0..=degree {
                        assert!((a[r] - b[r]).abs() <= 1e-11 * size, "{degree} {x} {k} {r}: {} {}", a[r], b[r]);
                    }
                }
            }
        }
    }

    #[test]
    fn a_spline_without_any_length_has_no_spans() {
        assert!(Spans::new(&[1.0; 4], 1, 2, 4).is_none());
    }
}
