//! Arcs of circles and ellipses as SVG writes them: two end points, two radii and a rotation, all of them rounded.
//!
//! A renderer computes the centre from these. The nearer an arc is to half a turn, the more rounded radii move the
//! centre; and a renderer enlarges radii that are too small for the ends. So each arc is drawn as the standard says
//! (SVG 2, appendix B.2.4) and its error is measured. An arc with too large an error gets more digits or is divided.
//! Where that does not help, as in circles seen nearly edge-on, it becomes cubic curves.

use hlr_exact::elementary::{atan2, log10, power, sin_cos, tan};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::strokes::{ARC, CONTROL, CUBIC, START, Shape, WHOLE};
use crate::fit::plane::{Vec2, length, minus};
use hlr_accuracy::{ARC_CUBIC, ARC_FIT, ARC_ROUND};

/// Decimals that radii may have in addition to those of points.
pub const EXTRA: usize = 2;
/// Decimals of a rotation in degrees.
pub const ROTATION: usize = 6;

const MOST_PIECES: usize = 12;
/// Points at which a drawn arc is measured, and points of the true arc that it is compared with.
const MEASURED: usize = 7;
const TRUE_PLACES: usize = 64;
/// Minor by major radius of an arc that is much longer than wide.
const FLAT: f64 = 0.3;
/// Share of a full turn from which an arc counts as a whole ellipse.
const WHOLE_TURN: f64 = 1.0 - 1e-9;

/// The points centre + cos t axes[0] + sin t axes[1], for t between the two angles (radians), y up.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub centre: Vec2,
    pub axes: [Vec2; 2],
    pub angles: [f64; 2],
}

/// Rows of strokes.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    pub points: Vec<[i64; 2]>,
    pub op: Vec<u8>,
    pub arc: Vec<i32>,
    pub shapes: Vec<Shape>,
}

impl Rows {
    pub fn push(&mut self, point: [i64; 2], op: u8, shape: Option<Shape>) {
        self.points.push(point);
        self.op.push(op);
        self.arc.push(shape.map_or(-1, |_| self.shapes.len() as i32));
        self.shapes.extend(shape);
    }

    /// Keeps the first `count` rows. Those behind are no arcs, so all shapes stay.
    pub fn truncate(&mut self, count: usize) {
        self.points.truncate(count);
        self.op.truncate(count);
        self.arc.truncate(count);
    }
}

impl Arc {
    pub fn at(&self, t: f64) -> Vec2 {
        let (s, c) = sin_cos(t);
        [0, 1].map(|k| self.centre[k] + c * self.axes[0][k] + s * self.axes[1][k])
    }

    fn radii(&self) -> [f64; 2] {
        self.axes.map(|a| length(&a))
    }

    fn whole(&self) -> bool {
        (self.angles[1] - self.angles[0]).abs() >= WHOLE_TURN * TAU
    }

    /// Rotation of the first axis in degrees, between -90 and 90.
    fn rotation(&self) -> f64 {
        let degrees = atan2(self.axes[0][1], self.axes[0][0]).to_degrees();
        degrees - (degrees / 180.0).round() * 180.0
    }

    /// Whether rising angles run counter-clockwise.
    fn upright(&self) -> bool {
        self.axes[0][0] * self.axes[1][1] > self.axes[0][1] * self.axes[1][0]
    }

    /// A whole ellipse as renderers draw the `<circle>` or `<ellipse>` of `rows`: it begins at the right end of its
    /// first axis and runs clockwise. So its dashes fall on the same places.
    fn as_element(&self, scale: f64, accuracy: f64) -> Self {
        let [major, minor] = self.radii();
        let turned = shape(self, scale, EXTRA, accuracy).rotation as f64 * 10f64.powi(-(ROTATION as i32));
        let (s, c) = sin_cos(turned.to_radians());
        Self { centre: self.centre, axes: [[major * c, major * s], [-minor * s, minor * c]], angles: [0.0, -TAU] }
    }

    /// Distance of a point near this arc.
    fn distance(&self, p: &Vec2) -> f64 {
        let [major, minor] = self.radii();
        let d = minus(p, &self.centre);
        if !self.flat() {
            let along = |k: usize, r: f64| (d[0] * self.axes[k][0] + d[1] * self.axes[k][1]) / (r * r);
            let t = atan2(along(1, minor), along(0, major));
            return length(&minus(p, &self.at(t)));
        }
        // On a flat arc the angle of a nearby point is not accurate enough.
        from_chords(&|share| self.at(self.angles[0] + (self.angles[1] - self.angles[0]) * share), p)
    }

    /// Much longer than wide.
    fn flat(&self) -> bool {
        let [major, minor] = self.radii();
        minor <= FLAT * major
    }
}

/// Distance of a point from the chords of a curve, given for 0..1.
fn from_chords(at: &dyn Fn(f64) -> Vec2, p: &Vec2) -> f64 {
    let place = |i: usize| at(i as f64 / TRUE_PLACES as f64);
    (0..TRUE_PLACES)
        .map(|i| {
            let (a, b) = (place(i), place(i + 1));
            let (way, d) = (minus(&b, &a), minus(p, &a));
            let size = way[0] * way[0] + way[1] * way[1];
            let s = if size > 0.0 { ((d[0] * way[0] + d[1] * way[1]) / size).clamp(0.0, 1.0) } else { 0.0 };
            length(&minus(&d, &way.map(|c| c * s)))
        })
        .fold(f64::INFINITY, f64::min)
}

/// The shares, from 0 to 1, at which an arc from one angle over a turn passes an end of an axis.
fn tips(start: f64, turn: f64) -> impl Iterator<Item = f64> {
    let (low, high) = (start.min(start + turn), start.max(start + turn));
    let quarters = (low / FRAC_PI_2).ceil() as i64..=(high / FRAC_PI_2).floor() as i64;
    quarters.map(move |k| (k as f64 * FRAC_PI_2 - start) / turn)
}

/// An arc as rows for SVG. `ends`: its end points on paper, shared with the lines that continue it.
pub fn rows(arc: &Arc, ends: &[Vec2; 2], places: usize, accuracy: f64, out: &mut Rows) {
    let scale = 10f64.powi(places as i32);
    let grid = |p: &Vec2| p.map(|c| (c * scale).round() as i64);
    if arc.whole() {
        out.push(grid(&arc.centre), WHOLE, Some(shape(arc, scale, EXTRA, accuracy)));
        return;
    }
    let turned = arc.angles[1] - arc.angles[0];
    let fewest = (turned.abs() / (0.999 * TAU)).ceil().max(1.0) as usize;
    for pieces in fewest..=MOST_PIECES {
        for extra in 0..=EXTRA {
            let mut shape = shape(arc, scale, extra, accuracy);
            shape.large = turned.abs() / pieces as f64 > PI;
            shape.rising = (turned > 0.0) == arc.upright();
            let angle = |i: usize| arc.angles[0] + turned * (i as f64 / pieces as f64);
            let mut stops: Vec<[i64; 2]> = (0..=pieces).map(|i| grid(&arc.at(angle(i)))).collect();
            (stops[0], stops[pieces]) = (grid(&ends[0]), grid(&ends[1]));
            let fits = (0..pieces).all(|i| {
                let part = Arc { angles: [angle(i), angle(i + 1)], ..*arc };
                let [a, b] = [stops[i], stops[i + 1]].map(|p| p.map(|c| c as f64 / scale));
                strays(&shape, &a, &b, scale, &part) <= ARC_FIT * accuracy
            });
            if fits {
                out.push(stops[0], START, None);
                stops[1..].iter().for_each(|p| out.push(*p, ARC, Some(shape)));
                return;
            }
        }
    }
    cubics(arc, ends, scale, accuracy, out);
}

fn shape(arc: &Arc, scale: f64, extra: usize, accuracy: f64) -> Shape {
    let coarse = 10i64.pow((EXTRA - extra) as u32);
    let fine = scale * 10f64.powi(EXTRA as i32);
    let [major, minor] = arc.radii();
    let mut radii = [major, minor].map(|r| ((r * fine / coarse as f64).round() as i64).max(1) * coarse);
    // A difference too small to see would only cost digits: an ellipse that is nearly a circle is written as one.
    if major - minor < ARC_ROUND * accuracy {
        radii[1] = radii[0];
        return Shape { radii, ..Shape::default() };
    }
    let off = ARC_ROUND * accuracy / (major - minor);
    let digits = (-log10(off.to_degrees())).ceil().clamp(0.0, ROTATION as f64) as i32;
    let unit = 10f64.powi(ROTATION as i32 - digits);
    Shape { radii, rotation: ((arc.rotation() * 10f64.powi(digits)).round() * unit) as i64, ..Shape::default() }
}

/// An arc as a renderer draws it: millimetres, y up.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    centre: Vec2,
    radii: [f64; 2],
    /// Cosine and sine of the rotation of the first radius.
    turned: [f64; 2],
    start: f64,
    turn: f64,
}

impl Drawn {
    /// From two end points and a shape (SVG 2, appendix B.2.4); None where nothing is drawn. unit: of the grid, mm.
    pub fn between(shape: &Shape, a: &Vec2, b: &Vec2, unit: f64) -> Option<Self> {
        let [mut rx, mut ry] = shape.radii.map(|r| r as f64 * unit / 10f64.powi(EXTRA as i32));
        let (sin, cos) = sin_cos((shape.rotation as f64 * 10f64.powi(-(ROTATION as i32))).to_radians());
        let (dx, dy) = (0.5 * (a[0] - b[0]), 0.5 * (a[1] - b[1]));
        let (x, y) = (cos * dx + sin * dy, cos * dy - sin * dx);
        let lambda = x * x / (rx * rx) + y * y / (ry * ry);
        if lambda == 0.0 {
            return None; // too short to be drawn
        }
        if lambda > 1.0 {
            rx *= lambda.sqrt();
            ry *= lambda.sqrt();
        }
        let root = (1.0 / lambda.min(1.0) - 1.0).max(0.0).sqrt() * if shape.large == shape.rising { -1.0 } else { 1.0 };
        let (cx, cy) = (root * rx * y / ry, -root * ry * x / rx);
        let centre = [cos * cx - sin * cy + 0.5 * (a[0] + b[0]), sin * cx + cos * cy + 0.5 * (a[1] + b[1])];
        let start = atan2((y - cy) / ry, (x - cx) / rx);
        let mut turn = atan2((-y - cy) / ry, (-x - cx) / rx) - start;
        if shape.rising && turn < 0.0 {
            turn += TAU;
        } else if !shape.rising && turn > 0.0 {
            turn -= TAU;
        }
        Some(Self { centre, radii: [rx, ry], turned: [cos, sin], start, turn })
    }

    /// A quarter of a whole ellipse whose first axis is level.
    pub fn quarter(centre: Vec2, radii: [f64; 2], which: usize) -> Self {
        Self { centre, radii, turned: [1.0, 0.0], start: which as f64 * FRAC_PI_2, turn: FRAC_PI_2 }
    }

    /// A point for s in 0..1.
    pub fn at(&self, s: f64) -> Vec2 {
        let (sin, cos) = sin_cos(self.start + s * self.turn);
        let (u, v) = (cos * self.radii[0], sin * self.radii[1]);
        let [c, d] = self.turned;
        [self.centre[0] + c * u - d * v, self.centre[1] + d * u + c * v]
    }
}

/// How far from the true arc a renderer draws a shape between two points.
fn strays(shape: &Shape, a: &Vec2, b: &Vec2, scale: f64, truth: &Arc) -> f64 {
    let Some(drawn) = Drawn::between(shape, a, b, 1.0 / scale) else { return 0.0 };
    // The distance from the true curve; at the middle also the distance from the true curve's middle.
    let places = (1..=MEASURED).map(|i| i as f64 / (MEASURED + 1) as f64);
    let mut worst = places.map(|share| truth.distance(&drawn.at(share))).fold(0.0, f64::max);
    if truth.flat() {
        // Seen nearly edge-on, a rounded end shifts the centre, and one of the two turns farther out than the other.
        let [first, last] = truth.angles;
        let beyond = tips(drawn.start, drawn.turn).map(|share| truth.distance(&drawn.at(share)));
        let short = tips(first, last - first).map(|share| truth.at(first + (last - first) * share));
        let short = short.map(|tip| from_chords(&|share| drawn.at(share), &tip));
        worst = beyond.chain(short).fold(worst, f64::max);
    }
    let middle = truth.at(0.5 * (truth.angles[0] + truth.angles[1]));
    let astray = length(&minus(&middle, &drawn.at(0.5)));
    if astray > truth.radii()[0] { astray } else { worst }
}

/// An arc as rows of cubic Bezier curves, for PDF.
pub fn cubic_rows(arc: &Arc, ends: &[Vec2; 2], places: usize, accuracy: f64, out: &mut Rows) {
    let scale = 10f64.powi(places as i32);
    let begun = arc.whole().then(|| arc.as_element(scale, accuracy));
    match &begun {
        Some(whole) => cubics(whole, &[whole.at(0.0); 2], scale, accuracy, out),
        None => cubics(arc, ends, scale, accuracy, out),
    }
}

/// The same of an arc as it is. scale: steps of the grid per millimetre.
fn cubics(arc: &Arc, ends: &[Vec2; 2], scale: f64, accuracy: f64, out: &mut Rows) {
    let grid = |p: &Vec2| p.map(|c| (c * scale).round() as i64);
    let turned = arc.angles[1] - arc.angles[0];
    // A cubic for a quarter circle is off by 2.8e-4 of the radius; the error falls with the sixth power of the angle.
    let share = power((2.8e-4 * arc.radii()[0] / (ARC_CUBIC * accuracy)).max(1e-12), 1.0 / 6.0);
    let pieces = ((turned.abs() / FRAC_PI_2 * share.max(1.0)).ceil()).max(1.0);
    let step = turned / pieces;
    let arm = 4.0 / 3.0 * tan(0.25 * step);
    let along = |t: f64, by: f64| {
        let (s, c) = sin_cos(t);
        [0, 1].map(|k| arc.centre[k] + (c - by * s) * arc.axes[0][k] + (s + by * c) * arc.axes[1][k])
    };
    out.push(grid(&ends[0]), START, None);
    for i in 0..pieces as usize {
        let (a, b) = (arc.angles[0] + step * i as f64, arc.angles[0] + step * (i + 1) as f64);
        let end = if i + 1 == pieces as usize { ends[1] } else { arc.at(b) };
        out.push(grid(&along(a, arm)), CONTROL, None);
        out.push(grid(&along(b, -arm)), CONTROL, None);
        out.push(grid(&end), CUBIC, None);
    }
}

#[cfg(test)]
mod tests;
