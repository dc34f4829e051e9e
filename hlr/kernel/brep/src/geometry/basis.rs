//! Basis functions of B-splines, with first and second derivatives.
//!
//! L. Piegl, W. Tiller, "The NURBS Book", 2nd ed. 1997: A2.1 (span), A2.2 (basis functions), (2.7) (derivatives from those of
//! lower degree).

/// Values, first and second derivatives of the basis functions that are not zero at a parameter, and the first one's number.
/// N: at least one more than the degree. Short arrays are much faster, and most splines are of low degree.
pub struct Basis<const N: usize> {
    pub first: usize,
    pub rows: [[f64; N]; 3],
}

impl<const N: usize> Basis<N> {
    /// Of so many poles. Beyond the ends of the domain the outermost polynomial goes on.
    pub fn at(knots: &[f64], p: usize, count: usize, x: f64) -> Basis<N> {
        // The span of non-zero length that holds x.
        let mut span = knots.partition_point(|&k| k <= x).clamp(p + 1, count) - 1;
        while span > p && knots[span + 1] <= knots[span] {
            span -= 1;
        }
        while span + 1 < count && knots[span + 1] <= knots[span] {
            span += 1;
        }
        let width = |q: usize, r: usize| knots[span + r + 1] - knots[span + 1 + r - q];
        // Of degree p, p - 1 and p - 2.
        let mut by_degree = [[0.0; N]; 3];
        let mut value = [0.0; N];
        value[0] = 1.0;
        for q in 0..=p {
            if q > 0 {
                let mut saved = 0.0;
                for r in 0..q {
                    let share = value[r] / width(q, r);
                    value[r] = saved + (knots[span + r + 1] - x) * share;
                    saved = (x - knots[span + 1 + r - q]) * share;
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
                let share = q as f64 * lower[r] / width(q, r);
                out[r] = before - share;
                before = share;
            }
            out[q] = before;
            out
        };
        let [values, lower, lowest] = by_degree;
        let slopes = derived(&lower, p);
        let bends = if p > 1 { derived(&derived(&lowest, p - 1), p) } else { [0.0; N] };
        Basis { first: span - p, rows: [values, slopes, bends] }
    }
}
