//! Chains of Bezier curves: exact for pieces of parabolas and of B-splines of degree 2 and 3.

use super::arc::grow;
use super::plane::Vec2;
use super::project::Paper;
use hlr_brep::geometry::nurbs::find_span;

/// A chain of k Bezier curves of degree 2 or 3: degree k + 1 points.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    pub degree: usize,
    pub points: Vec<Vec2>,
}

impl Chain {
    pub fn pieces(&self) -> impl Iterator<Item = &[Vec2]> {
        (0..self.points.len() / self.degree).map(|i| &self.points[i * self.degree..=(i + 1) * self.degree])
    }

    /// Exact bounding box, from the ends and the places where a derivative vanishes.
    pub fn bounds(&self) -> [Vec2; 2] {
        let mut out = [self.points[0], self.points[0]];
        for piece in self.pieces() {
            grow(&mut out, &piece[self.degree]);
            for k in 0..2 {
                let x: Vec<f64> = piece.iter().map(|p| p[k]).collect();
                for t in stationary(&x) {
                    grow(&mut out, &at(piece, t));
                }
            }
        }
        out
    }
}

/// Parameters in (0, 1) where the derivative of a Bezier polynomial of degree 2 or 3 vanishes.
fn stationary(x: &[f64]) -> Vec<f64> {
    let d: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let roots = match d[..] {
        [a, b] => vec![a / (a - b)],
        [a, b, c] => {
            let (p, q, r) = (a - 2.0 * b + c, b - a, a);
            let root = (q * q - p * r).max(0.0).sqrt();
            let far = -(q + if q < 0.0 { -root } else { root });
            vec![far / p, r / far]
        }
        _ => Vec::new(),
    };
    roots.into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect()
}

/// A point of one Bezier curve (de Casteljau).
pub fn at(piece: &[Vec2], t: f64) -> Vec2 {
    let mut p = [[0.0; 2]; 4];
    p[..piece.len()].copy_from_slice(piece);
    for n in (1..piece.len()).rev() {
        for i in 0..n {
            p[i] = [0, 1].map(|k| p[i][k] + (p[i + 1][k] - p[i][k]) * t);
        }
    }
    p[0]
}

/// The piece of a curve between two parameters as Bezier curves, if that is exact: for a parabola or a B-spline of
/// degree 2 or 3 that is not rational on paper. None for others.
pub fn exact(curve: &Paper, from: f64, to: f64) -> Option<Chain> {
    match curve {
        Paper::Parabola { p, a, b } if a[2] == 0.0 && b[2] == 0.0 => {
            // The blossom of t^2 is s t.
            let blossom = |s: f64, t: f64| [0, 1].map(|k| (p[k] + s * t * a[k] + 0.5 * (s + t) * b[k]) / p[2]);
            Some(Chain { degree: 2, points: vec![blossom(from, from), blossom(from, to), blossom(to, to)] })
        }
        Paper::Spline { degree: degree @ (2 | 3), rational: false, knots, poles } => {
            let mut stops = vec![from];
            stops.extend(knots.iter().copied().filter(|&u| u > from && u < to));
            stops.push(to);
            stops.dedup();
            let mut points = Vec::with_capacity(degree * stops.len());
            for w in stops.windows(2) {
                let span = find_span(knots, *degree, poles.len(), 0.5 * (w[0] + w[1]));
                let skip = usize::from(!points.is_empty());
                points.extend((skip..=*degree).map(|j| blossom(knots, poles, *degree, span, w, j)));
            }
            Some(Chain { degree: *degree, points })
        }
        _ => None,
    }
}

/// The blossom of a span's polynomial at w[0] (degree - j times) and w[1] (j times): its j-th Bezier point on w.
fn blossom(knots: &[f64], poles: &[[f64; 3]], degree: usize, span: usize, w: &[f64], j: usize) -> Vec2 {
    let mut d = [[0.0; 2]; 4];
    for (i, p) in poles[span - degree..=span].iter().enumerate() {
        d[i] = [p[0] / p[2], p[1] / p[2]];
    }
    for r in 1..=degree {
        let u = if r <= j { w[1] } else { w[0] };
        for i in (r..=degree).rev() {
            let (low, high) = (knots[span - degree + i], knots[span + i + 1 - r]);
            let s = (u - low) / (high - low);
            d[i] = [0, 1].map(|k| d[i - 1][k] + (d[i][k] - d[i - 1][k]) * s);
        }
    }
    d[degree]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_a_spline_are_exact() {
        let curve = Paper::Spline {
            degree: 3,
            rational: false,
            knots: vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 3.0, 3.0, 3.0, 3.0],
            poles: (0..7u8).map(|i| [f64::from(i), f64::from(i * i % 5), 1.0]).collect(),
        };
        let Some(chain) = exact(&curve, 0.4, 2.9) else { panic!() };
        let stops = [0.4, 1.0, 2.5, 2.9];
        assert_eq!(chain.points.len(), 10);
        for (piece, w) in chain.pieces().zip(stops.windows(2)) {
            for i in 0..=4 {
                let s = f64::from(i) * 0.25;
                let (a, b) = (at(piece, s), curve.at(w[0] + (w[1] - w[0]) * s)[0]);
                assert!((a[0] - b[0]).abs() < 1e-13 && (a[1] - b[1]).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn a_box_holds_what_bulges() {
        let chain = Chain { degree: 3, points: vec![[0.0, 0.0], [0.0, 4.0], [1.0, 4.0], [1.0, 0.0]] };
        assert_eq!(chain.bounds(), [[0.0, 0.0], [1.0, 3.0]]);
        let chain = Chain { degree: 2, points: vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]] };
        assert_eq!(chain.bounds(), [[0.0, 0.0], [2.0, 1.0]]);
    }
}
