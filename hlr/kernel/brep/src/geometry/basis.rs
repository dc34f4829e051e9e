//! Basis functions of B-splines, with first and second derivatives.
//!
//! L. Piegl, W. Tiller, "The NURBS Book", 2nd ed. 1997: A2.1 (span), A2.2 (basis functions), (2.7) (derivatives from
//! those of lower degree).

/// The nonzero basis functions at a parameter: values, first and second derivatives, and the number of the first
/// function. N: at least one more than the degree. Short arrays are much faster, and most splines have a low degree.
pub struct Basis<const N: usize> {
    pub first: usize,
    pub rows: [[f64; N]; 3],
}

impl<const N: usize> Basis<N> {
    /// The basis of `count` poles at x. Beyond the ends of the domain the outermost polynomial continues.
    pub fn at(knots: &[f64], p: usize, count: usize, x: f64) -> Basis<N> {
        let span = span_of(knots, p, count, x);
        // The knots involved, and the reciprocal lengths of the functions' supports, for degrees p and p - 1.
        let near = &knots[span + 1 - p..=span + p];
        let mut over = [[0.0; N]; 2];
        // Functions of degree p, p - 1 and p - 2.
        let mut by_degree = [[0.0; N]; 3];
        let mut value = [0.0; N];
        value[0] = 1.0;
        for q in 0..=p {
            if q > 0 {
                let mut saved = 0.0;
                for r in 0..q {
                    let (left, right) = (near[p + r - q], near[p + r]);
                    let inverse = 1.0 / (right - left);
                    if p - q < 2 {
                        over[p - q][r] = inverse;
                    }
                    let share = value[r] * inverse;
                    value[r] = saved + (right - x) * share;
                    saved = (x - left) * share;
                }
                value[q] = saved;
            }
            if p - q < 3 {
                by_degree[p - q] = value;
            }
        }
        let derived = |lower: &[f64; N], q: usize| {
            let mut out = [0.0; N];
            let mut before = 0.0;
            for r in 0..q {
                let share = q as f64 * lower[r] * over[p - q][r];
                out[r] = before - share;
                before = share;
            }
            out[q] = before;
            out
        };
        let [values, lower, lowest] = by_degree;
        let slopes = if p > 0 { derived(&lower, p) } else { [0.0; N] };
        let bends = if p > 1 { derived(&derived(&lowest, p - 1), p) } else { [0.0; N] };
        Basis { first: span - p, rows: [values, slopes, bends] }
    }
}

/// The span of nonzero length that contains x, or is nearest to it.
fn span_of(knots: &[f64], p: usize, count: usize, x: f64) -> usize {
    let mut span = knots.partition_point(|&k| k <= x).clamp(p + 1, count) - 1;
    while span > p && knots[span + 1] <= knots[span] {
        span -= 1;
    }
    while span + 1 < count && knots[span + 1] <= knots[span] {
        span += 1;
    }
    span
}

/// The number of the first nonzero function at a parameter, and the values alone, bit for bit those of `Basis::at`.
pub fn values<const N: usize>(knots: &[f64], p: usize, count: usize, x: f64) -> (usize, [f64; N]) {
    let span = span_of(knots, p, count, x);
    let near = &knots[span + 1 - p..=span + p];
    let mut value = [0.0; N];
    value[0] = 1.0;
    for q in 1..=p {
        let mut saved = 0.0;
        for r in 0..q {
            let (left, right) = (near[p + r - q], near[p + r]);
            let share = value[r] * (1.0 / (right - left));
            value[r] = saved + (right - x) * share;
            saved = (x - left) * share;
        }
        value[q] = saved;
    }
    (span - p, value)
}
