//! Bounds on spline surfaces and their derivatives over a rectangle of parameters, from their control nets.
//!
//! A spline lies in the convex hull of its control points. The smaller the rectangle, the closer the control points of
//! its piece lie to the surface.

use crate::geometry::curve::Curve;
use crate::geometry::nurbs::Nurbs;
use crate::geometry::spline_surface::SplineSurface;
use crate::geometry::vector::{Vector, dot};

/// Least and greatest value.
pub type Range = [f64; 2];

/// A tensor-product spline of (x w, y w, z w, w), v fastest.
#[derive(Clone)]
pub struct ControlNet {
    degree: [usize; 2],
    count: [usize; 2],
    knots: [Vec<f64>; 2],
    poles: Vec<[f64; 4]>,
    period: [f64; 2],
}

impl ControlNet {
    pub fn of_spline(surface: &SplineSurface) -> ControlNet {
        let (degree, count, poles) = surface.net();
        let knots = [0, 1].map(|side| surface.knots(side).0.to_vec());
        ControlNet { degree, count, knots, poles: poles.to_vec(), period: surface.period() }
    }

    /// The control net of a spline extruded along `way`; None for other curves.
    pub fn of_extrusion(way: &Vector, curve: &Curve) -> Option<ControlNet> {
        let Curve::Spline(n) = curve else { return None };
        let both = |p: &[f64; 4]| [*p, [p[0] + way[0] * p[3], p[1] + way[1] * p[3], p[2] + way[2] * p[3], p[3]]];
        Some(ControlNet {
            degree: [n.degree, 1],
            count: [n.poles.len(), 2],
            knots: [n.knots.clone(), vec![0.0, 0.0, 1.0, 1.0]],
            poles: n.poles.iter().flat_map(both).collect(),
            period: [0.0; 2],
        })
    }

    /// The control net of the derivative by u (0) or v (1).
    pub fn derived(&self, side: usize) -> ControlNet {
        let (p, knots) = (self.degree[side], &self.knots[side]);
        let mut count = self.count;
        if p == 0 {
            return ControlNet { poles: vec![[0.0; 4]; self.poles.len()], ..self.clone() };
        }
        count[side] -= 1;
        let mut poles = Vec::with_capacity(count[0] * count[1]);
        for i in 0..count[0] {
            for j in 0..count[1] {
                let k = [i, j][side];
                let next = if side == 0 { (i + 1, j) } else { (i, j + 1) };
                let (a, b) = (self.poles[i * self.count[1] + j], self.poles[next.0 * self.count[1] + next.1]);
                let width = knots[k + p + 1] - knots[k + 1];
                let share = if width > 0.0 { p as f64 / width } else { 0.0 };
                poles.push([0, 1, 2, 3].map(|c| share * (b[c] - a[c])));
            }
        }
        let (mut degree, mut all) = (self.degree, self.knots.clone());
        degree[side] -= 1;
        all[side] = knots[1..knots.len() - 1].to_vec();
        ControlNet { degree, count, knots: all, poles, period: self.period }
    }

    /// The control net of a curve, which runs along v.
    pub fn of_curve(n: &Nurbs) -> ControlNet {
        ControlNet {
            degree: [0, n.degree],
            count: [1, n.poles.len()],
            knots: [vec![0.0, 1.0], n.knots.clone()],
            poles: n.poles.clone(),
            period: [0.0; 2],
        }
    }

    /// Whether a rectangle crosses the ends of a period, where nothing is known of the slopes.
    pub fn comes_round(&self, side: usize, [low, high]: Range) -> bool {
        let turn = self.period[side];
        let ends = [self.knots[side][self.degree[side]], self.knots[side][self.count[side]]];
        turn > 0.0 && ends.iter().any(|k| [-turn, 0.0, turn].iter().any(|t| low < k + t && k + t < high))
    }

    /// An upper bound on the jumps of a form's slope by u (0) or v (1) at knots inside a rectangle, all jumps added up.
    pub fn jump(&self, side: usize, form: &[f64; 4], rectangle: [Range; 2]) -> f64 {
        let (p, knots, period) = (self.degree[side], &self.knots[side], self.period[side]);
        let [low, high] = rectangle[side];
        let cells = self.cells(1 - side, rectangle[1 - side]);
        let mut sum = 0.0;
        let mut at = 0;
        for run in knots.chunk_by(|a, b| a == b) {
            let (begin, end) = (at, at + run.len());
            at = end;
            let inside = [-period, 0.0, period].iter().any(|t| low < run[0] + t && run[0] + t < high);
            if run.len() < p || p == 0 || begin == 0 || end == knots.len() || !inside {
                continue;
            }
            // The pole that the spline passes through there, and p over the lengths of the spans beside it.
            let pole = begin - 1;
            let shares = [run[0] - knots[begin - 1], knots[end] - run[0]].map(|width| p as f64 / width);
            let value = |along: usize, across: usize| -> f64 {
                let number = if side == 0 { along * self.count[1] + across } else { across * self.count[1] + along };
                (0..4).map(|c| form[c] * self.poles[number][c]).sum()
            };
            let q = self.degree[1 - side];
            let mut most = 0.0f64;
            for &(span, part) in &cells {
                let jump = |k: usize| {
                    let [before, here, after] = [pole - 1, pole, pole + 1].map(|along| value(along, span - q + k));
                    shares[1] * (after - here) - shares[0] * (here - before)
                };
                let mut row: Vec<f64> = (0..=q).map(jump).collect();
                restricted(&mut row, &self.knots[1 - side], span, part);
                most = row.iter().fold(most, |m, x| m.max(x.abs()));
            }
            sum += most;
        }
        sum
    }

    /// The range of the form a x w + b y w + c z w + d w over a rectangle.
    pub fn range(&self, form: &[f64; 4], rectangle: [Range; 2]) -> Range {
        let [u, v] = [0, 1].map(|side| self.cells(side, rectangle[side]));
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        let mut rows = vec![0.0; (self.degree[0] + 1) * (self.degree[1] + 1)];
        let mut column = vec![0.0; self.degree[0] + 1];
        for &(i, along_u) in &u {
            for &(j, along_v) in &v {
                let [p, q] = self.degree;
                for a in 0..=p {
                    let row = &mut rows[a * (q + 1)..][..=q];
                    for (b, value) in row.iter_mut().enumerate() {
                        let pole = self.poles[(i - p + a) * self.count[1] + j - q + b];
                        *value = (0..4).map(|c| form[c] * pole[c]).sum();
                    }
                    restricted(row, &self.knots[1], j, along_v);
                }
                for b in 0..=q {
                    (0..=p).for_each(|a| column[a] = rows[a * (q + 1) + b]);
                    restricted(&mut column, &self.knots[0], i, along_u);
                    found = column.iter().fold(found, |[l, h], x| [l.min(*x), h.max(*x)]);
                }
            }
        }
        found
    }

    /// The spans between knots that a range touches, each with the part of the range inside it.
    fn cells(&self, side: usize, [low, high]: Range) -> Vec<(usize, Range)> {
        let (p, count, knots, period) = (self.degree[side], self.count[side], &self.knots[side], self.period[side]);
        let mut out = Vec::new();
        let (first, last) = (knots[p], knots[count]);
        let turns = if period > 0.0 {
            ((low - last) / period).floor() as i64..=((high - first) / period).ceil() as i64
        } else {
            0..=0
        };
        for turn in turns {
            let (low, high) = (low - turn as f64 * period, high - turn as f64 * period);
            for span in (p..count).filter(|&span| knots[span] < knots[span + 1]) {
                // Beyond the ends of the domain the outermost pieces continue.
                let begin = if period == 0.0 && knots[span] <= first { f64::NEG_INFINITY } else { knots[span] };
                let end = if period == 0.0 && knots[span + 1] >= last { f64::INFINITY } else { knots[span + 1] };
                if begin <= high && low <= end {
                    out.push((span, [low.max(begin), high.min(end)]));
                }
            }
        }
        out
    }
}

/// Replaces the control values of a span by those of its piece low..high. Control value j is the polar form with `high`
/// j times and `low` otherwise (de Boor).
fn restricted(values: &mut [f64], knots: &[f64], span: usize, [low, high]: Range) {
    let p = values.len() - 1;
    let given = values.to_vec();
    let mut d = given.clone();
    for (j, value) in values.iter_mut().enumerate() {
        d.copy_from_slice(&given);
        for r in 1..=p {
            let t = if r <= j { high } else { low };
            for i in (r..=p).rev() {
                let (left, right) = (knots[span - p + i], knots[span + 1 + i - r]);
                let share = (t - left) / (right - left);
                d[i] = (1.0 - share) * d[i - 1] + share * d[i];
            }
        }
        *value = d[p];
    }
}

/// The form n . (S - origin), times the weight.
pub fn height(n: &Vector, origin: &Vector) -> [f64; 4] {
    [n[0], n[1], n[2], -dot(n, origin)]
}
