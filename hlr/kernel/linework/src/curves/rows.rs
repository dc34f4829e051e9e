//! The rows of each line, its points on the decimal grid, before lines that continue one another are joined.

use super::arcs::{Rows, cubic_rows, rows};
use super::strokes::{CONTROL, CUBIC, LINE, QUADRATIC, START};
use crate::fit::plane::{Vec2, dot, length, minus};
use crate::lines::drawing::{Curve, Line};
use hlr_accuracy::LINE_ROUNDED;

/// Adds the rows of one line. cubic: arcs and quadratic curves become cubic ones, for formats that have no others.
pub fn add_rows(line: &Line, places: usize, accuracy: f64, cubic: bool, out: &mut Rows) {
    match &line.curve {
        None if straight(&line.flat, LINE_ROUNDED * accuracy) => {
            chain(&[line.flat[0], line.flat[line.flat.len() - 1]], 1, LINE, places, out);
        }
        None => chain(&line.flat, 1, LINE, places, out),
        Some(Curve::Arc(arc)) => {
            let (Some(a), Some(b)) = (line.flat.first(), line.flat.last()) else { return };
            (if cubic { cubic_rows } else { rows })(arc, &[*a, *b], places, accuracy, out);
        }
        Some(Curve::Chain(c)) if c.degree == 2 && cubic => chain(&raised(&c.points), 3, CUBIC, places, out),
        Some(Curve::Chain(c)) if c.degree == 2 => chain(&c.points, 2, QUADRATIC, places, out),
        Some(Curve::Chain(c)) => chain(&c.points, 3, CUBIC, places, out),
    }
}

/// Whether the points lie in order on the line from the first to the last, as those of a circle seen edge-on do.
fn straight(points: &[Vec2], most: f64) -> bool {
    let [first, inner @ .., last] = points else { return false };
    let way = minus(last, first);
    let size = length(&way);
    let mut before = 0.0;
    size > 0.0
        && inner.iter().all(|p| {
            let arm = minus(p, first);
            let (along, aside) = (dot(&arm, &way) / size, (arm[0] * way[1] - arm[1] * way[0]) / size);
            let onward = along >= before && along <= size;
            before = along;
            onward && aside.abs() <= most
        })
}

fn chain(points: &[Vec2], degree: usize, op: u8, places: usize, out: &mut Rows) {
    let scale = 10f64.powi(places as i32);
    for (i, p) in points.iter().enumerate() {
        let op = match i {
            0 => START,
            _ if i % degree == 0 => op,
            _ => CONTROL,
        };
        out.push(p.map(|c| (c * scale).round_ties_even() as i64), op, None);
    }
}

/// A quadratic chain as a cubic one, the same curve.
fn raised(points: &[Vec2]) -> Vec<Vec2> {
    let toward = |from: &Vec2, to: &Vec2| [0, 1].map(|k| from[k] + (to[k] - from[k]) * (2.0 / 3.0));
    let mut out = vec![points[0]];
    for p in points.windows(3).step_by(2) {
        out.extend([toward(&p[0], &p[1]), toward(&p[2], &p[1]), p[2]]);
    }
    out
}
