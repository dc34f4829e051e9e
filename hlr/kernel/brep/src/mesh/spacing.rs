//! The spacing of points on a doubly curved face, and a chart of (u, v) in which it is the same in all directions.
//!
//! With the second fundamental form L du^2 + 2 M du dv + N dv^2 of the surface, a chord along u has the error
//! L du^2 / 8. Spacings are chosen so that the errors along u and v are equal. The chart stretches u and v each by a
//! function of its own. On a sphere this is the Mercator projection, which makes the spacing uniform in all directions.

use hlr_exact::elementary::{exp, exp2, hypot, ln, log2};
use std::f64::consts::LN_2;

use super::progress::Progress;
use crate::geometry::jet::Jet;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, along, cross, dot, length, unit};
use hlr_accuracy::{MESH_AIM, MESH_SHORTEST};

/// Number of cells along u and v: at the start, and at most.
const FEWEST: usize = 4;
const MOST: usize = 256;
/// Largest ratio of spacings within a cell; beyond it finer cells are used.
const STEADY: f64 = 1.4;
/// The same along the meridians of a surface of revolution, which need few cells.
const STEADY_ROUND: f64 = 1.1;
/// Largest ratio of length to width of triangles where the surface bends in one direction only.
const LONGEST: f64 = 12.0;
/// Angle between the normals at the ends of an edge inside the face, as a share of the angle asked for. Neighbouring
/// triangles, whose centroids are closer together, differ by less than the angle.
const TURN: f64 = 1.03;
/// Largest angle in radians between the directions of coordinate lines at the ends of an edge. It limits edges near a
/// pole.
const FAN: f64 = 0.8;
/// How far a step along a coordinate line may stray from the line within the surface, as a share of the step across it.
const STRAY: f64 = 0.25;

/// Rounds of fitting the chart to the spacings.
const FITS: usize = 4;
/// Range of the logarithm of the chart's slopes, below which the chart is left straight.
const STRAIGHT: f64 = 0.4;

pub struct Field {
    /// Lines between cells: values of u, and of v.
    lines: [Vec<f64>; 2],
    /// The same lines in the chart.
    pub chart: [Vec<f64>; 2],
    /// Spacing in the chart per cell, v fastest.
    spacing: Vec<f64>,
    /// Factors on u and v if the chart only scales: powers of two, so that nothing is rounded.
    scale: Option<[f64; 2]>,
    /// Knots of the surface within the face, along u and v.
    knots: [Vec<f64>; 2],
}

impl Field {
    /// `straight`: the chart only scales and rounds nothing, so chords cross in it exactly where they cross in (u, v).
    pub fn new(
        surface: &Surface,
        [low, high]: [[f64; 2]; 2],
        deflection: f64,
        angle: f64,
        straight: bool,
        steps: &Progress,
    ) -> Option<Field> {
        let knots = [0, 1].map(|k| surface.knots(k, low[k], high[k]));
        // A surface of revolution is the same for all u.
        let round = matches!(surface, Surface::Sphere(..) | Surface::Torus(..) | Surface::Revolution(..));
        let mut parts = [0, 1].map(|k| if round && k == 0 { 1 } else { FEWEST.div_ceil(knots[k].len() + 1) });
        loop {
            let lines = [0, 1].map(|k| subdivided(&knots[k], low[k], high[k], parts[k]));
            let needs = sampled(surface, &lines, round, deflection, angle, steps)?;
            let counts = lines.each_ref().map(|l| l.len() - 1);
            let points: f64 = needs.iter().map(Need::points).sum();
            let rough = [0, 1].map(|k| needs.iter().fold(1.0f64, |m, n| m.max(n.rough[k])));
            let mut finer = false;
            let steady = if round { STEADY_ROUND } else { STEADY };
            for k in 0..2 {
                let fits = 2 * counts[k] <= MOST && (4 * counts[0] * counts[1]) as f64 <= points.max(64.0);
                if rough[k] > steady && fits && !(round && k == 0) {
                    parts[k] *= 2;
                    finer = true;
                }
            }
            if !finer {
                return Some(Field { knots, ..charted(lines, &needs, straight) });
            }
        }
    }

    pub fn to_chart(&self, uv: [f64; 2]) -> [f64; 2] {
        match self.scale {
            Some(scale) => [uv[0] * scale[0], uv[1] * scale[1]],
            None => [0, 1].map(|k| mapped(&self.lines[k], &self.chart[k], uv[k])),
        }
    }

    pub fn on_surface(&self, xy: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.parameter(k, xy[k]))
    }

    /// The parameter u (k = 0) or v (k = 1) at the coordinate x or y of the chart.
    pub fn parameter(&self, k: usize, x: f64) -> f64 {
        match self.scale {
            Some(scale) => x / scale[k],
            None => mapped(&self.chart[k], &self.lines[k], x),
        }
    }

    /// Values of u (k = 0) or v (k = 1) between cells, ascending, with both ends.
    pub fn lines(&self, k: usize) -> &[f64] {
        &self.lines[k]
    }

    pub fn counts(&self) -> [usize; 2] {
        [0, 1].map(|k| self.lines[k].len() - 1)
    }

    /// Numbers of the spans between knots, along u and v, that hold a point.
    pub fn span(&self, uv: [f64; 2]) -> [u32; 2] {
        [0, 1].map(|k| self.knots[k].partition_point(|&knot| knot <= uv[k]) as u32)
    }

    /// Spacing in the chart within a cell.
    pub fn in_cell(&self, i: usize, j: usize) -> f64 {
        self.spacing[i * self.counts()[1] + j]
    }

    /// The smallest spacing in the chart.
    pub fn least(&self) -> f64 {
        self.spacing.iter().fold(f64::INFINITY, |m, h| m.min(*h))
    }

    /// Spacing at a place in the chart.
    pub fn at(&self, xy: [f64; 2]) -> f64 {
        let [i, j] = [0, 1].map(|k| cell_of(&self.chart[k], xy[k]));
        self.in_cell(i, j)
    }
}

/// The spacing that one cell asks for.
struct Need {
    /// Width and height of the cell.
    cell: [f64; 2],
    /// Spacing along u and v.
    size: [f64; 2],
    /// Ratio of the largest to the smallest spacing, along u and along v.
    rough: [f64; 2],
}

impl Need {
    /// Number of points in the cell.
    fn points(&self) -> f64 {
        (self.cell[0] / self.size[0]) * (self.cell[1] / self.size[1])
    }
}

/// Ascending lines from low to high that include the knots. Each span is divided into equal parts.
fn subdivided(knots: &[f64], low: f64, high: f64, parts: usize) -> Vec<f64> {
    let mut out = vec![low];
    for &end in knots.iter().chain([&high]) {
        let start = out[out.len() - 1];
        out.extend((1..parts).map(|i| start + (end - start) * i as f64 / parts as f64));
        out.push(end);
    }
    out
}

/// The smallest spacings at the corners and middle of each cell. `round`: spacings are the same for all u.
fn sampled(
    surface: &Surface,
    lines: &[Vec<f64>; 2],
    round: bool,
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Option<Vec<Need>> {
    let counts = [0, 1].map(|k| lines[k].len() - 1);
    let whole = [0, 1].map(|k| lines[k][counts[k]] - lines[k][0]);
    let at = |u: f64, v: f64| {
        steps.step();
        let jet = surface.jet([u, v]);
        let wanted = spacing(&jet, deflection, angle);
        within_strips(&jet, [0, 1].map(|k| wanted[k].min(whole[k])), deflection)
    };
    let row = |u: f64| lines[1].iter().map(|&v| at(u, v)).collect::<Vec<_>>();
    let mut out = Vec::with_capacity(counts[0] * counts[1]);
    let mut left = row(lines[0][0]);
    for u in lines[0].windows(2) {
        let right = if round { left.clone() } else { row(u[1]) };
        for (j, v) in lines[1].windows(2).enumerate() {
            let four = [left[j], left[j + 1], right[j], right[j + 1]];
            let middle = at(0.5 * (u[0] + u[1]), 0.5 * (v[0] + v[1]));
            let size = four.iter().fold(middle, |m, c| [m[0].min(c[0]), m[1].min(c[1])]);
            if !size.iter().all(|s| *s > 0.0) {
                return None;
            }
            let ratio = |a: usize, b: usize| {
                let (a, b) = (four[a], four[b]);
                (0..2).map(|k| (a[k] / b[k]).max(b[k] / a[k])).fold(1.0, f64::max)
            };
            let rough = [ratio(0, 2).max(ratio(1, 3)), ratio(0, 1).max(ratio(2, 3))];
            out.push(Need { cell: [u[1] - u[0], v[1] - v[0]], size, rough });
        }
        left = right;
    }
    Some(out)
}

/// Sides of triangles along u and v, which are equilateral once both sides are stretched to the same length.
fn spacing(jet: &Jet, deflection: f64, angle: f64) -> [f64; 2] {
    let free = [f64::INFINITY; 2];
    let Some(n) = unit(&cross(&jet.du, &jet.dv)) else { return free };
    let (e, g) = (dot(&jet.du, &jet.du), dot(&jet.dv, &jet.dv));
    let [l, m, k] = [&jet.duu, &jet.duv, &jet.dvv].map(|d| dot(d, &n));
    let bend = (l / e).abs().max((k / g).abs()).max(m.abs() / (e * g).sqrt());
    if bend * deflection < 1e-12 || bend.is_nan() {
        return free;
    }
    let least = bend / (LONGEST * LONGEST);
    let (a, b) = (l.abs().max(e * least), k.abs().max(g * least));
    let twist = m.abs() / (a * b).sqrt();
    // The error of a triangle of side s is s^2 / 6 where both curvatures have one sign, and s^2 / 8 on a saddle.
    let square = MESH_AIM * deflection * if l * k < 0.0 { 8.0 / hypot(1.0, twist) } else { 6.0 / (1.0 + twist) };
    let turn = [(l * l / e + m * m / g).sqrt(), (k * k / g + m * m / e).sqrt()];
    // How much the direction of lines along v turns along u, and the other way round.
    let across = |d: &[f64; 3], square: f64| length(&along(&jet.duv, d, -dot(&jet.duv, d) / square)) / square.sqrt();
    let fan = [across(&jet.dv, g), across(&jet.du, e)];
    let side = |k: usize, form: f64, metric: f64| {
        let shortest = MESH_SHORTEST * deflection / metric.sqrt();
        (square / form).sqrt().min(TURN * angle / turn[k]).min(FAN / fan[k]).max(shortest)
    };
    [side(0, a, e), side(1, b, g)]
}

/// The spacings, shortened where a coordinate line bends within the surface: a step along it strays from the line by no
/// more than a share of the step across it. Else a triangle could leave a thin strip that bends in its own plane.
fn within_strips(jet: &Jet, size: [f64; 2], deflection: f64) -> [f64; 2] {
    let (e, g) = (dot(&jet.du, &jet.du), dot(&jet.dv, &jet.dv));
    let Some(n) = unit(&cross(&jet.du, &jet.dv)) else { return size };
    let limit = |bend: &Vector, way: &Vector, square: f64, across: f64| {
        let aside = dot(bend, &cross(&n, way)).abs() / square.sqrt();
        (8.0 * (STRAY * across).max(deflection) / aside).sqrt()
    };
    let across = [size[0] * e.sqrt(), size[1] * g.sqrt()];
    [size[0].min(limit(&jet.duu, &jet.du, e, across[1])), size[1].min(limit(&jet.dvv, &jet.dv, g, across[0]))]
}

/// Slopes of the chart: g(v) / f(u) fits the ratio of spacings as closely as such a product can, by least squares of
/// logarithms, weighted by the number of points.
fn charted(lines: [Vec<f64>; 2], needs: &[Need], straight: bool) -> Field {
    let counts = lines.each_ref().map(|l| l.len() - 1);
    let mut logs = [vec![0.0f64; counts[0]], vec![0.0f64; counts[1]]];
    for _ in 0..FITS {
        for side in [1, 0] {
            let mut sums = vec![[0.0f64; 2]; counts[side]];
            for (number, need) in needs.iter().enumerate() {
                let (i, j) = (number / counts[1], number % counts[1]);
                let aspect = ln(need.size[0] / need.size[1]);
                let wanted = if side == 1 { aspect + logs[0][i] } else { logs[1][j] - aspect };
                let sum = &mut sums[if side == 1 { j } else { i }];
                sum[0] += need.points() * wanted;
                sum[1] += need.points();
            }
            logs[side] = even(&sums, if straight { f64::INFINITY } else { STRAIGHT });
        }
    }
    if straight {
        logs.iter_mut().flatten().for_each(|x| *x = (*x / LN_2).round() * LN_2);
    }
    let slopes = logs.map(|log| log.iter().map(|&x| exp(x)).collect::<Vec<_>>());
    let scale = straight.then(|| slopes.each_ref().map(|s| exp2(log2(s[0]).round())));
    let chart = [0, 1].map(|k| {
        if let Some(scale) = scale {
            return lines[k].iter().map(|x| x * scale[k]).collect();
        }
        let mut at = 0.0;
        let steps = lines[k].windows(2).zip(&slopes[k]).map(|(w, s)| {
            at += s * (w[1] - w[0]);
            at
        });
        std::iter::once(0.0).chain(steps).collect::<Vec<_>>()
    });
    let mut spacing = Vec::with_capacity(needs.len());
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let size = needs[i * counts[1] + j].size;
            let (x, y) = (size[0] * slopes[0][i], size[1] * slopes[1][j]);
            spacing.push((x * y).sqrt().min(1.6 * x.min(y)));
        }
    }
    Field { lines, chart, spacing, scale, knots: [Vec::new(), Vec::new()] }
}

/// Means from sums and weights. If they hardly differ they are made equal, so that the chart is not bent and straight
/// lines stay straight.
fn even(sums: &[[f64; 2]], least: f64) -> Vec<f64> {
    let total = sums.iter().fold([0.0; 2], |t, s| [t[0] + s[0], t[1] + s[1]]);
    let means: Vec<f64> = sums.iter().map(|s| s[0] / s[1]).collect();
    let (low, high) = means.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
    if high - low < least { vec![total[0] / total[1]; sums.len()] } else { means }
}

fn cell_of(lines: &[f64], x: f64) -> usize {
    lines.partition_point(|&l| l <= x).clamp(1, lines.len() - 1) - 1
}

fn mapped(from: &[f64], to: &[f64], x: f64) -> f64 {
    let k = cell_of(from, x);
    let width = from[k + 1] - from[k];
    // Ends of cells are reproduced to the last digit, so that the sides of a rectangle stay straight.
    if x == from[k] || width <= 0.0 {
        to[k]
    } else if x == from[k + 1] {
        to[k + 1]
    } else {
        to[k] + (x - from[k]) / width * (to[k + 1] - to[k])
    }
}
