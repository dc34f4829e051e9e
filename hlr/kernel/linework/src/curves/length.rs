//! Arc length and end directions of written strokes: lines, Bezier curves, arcs.

use smallvec::SmallVec;

use super::arcs::{Drawn, EXTRA};
use super::strokes::{ARC, CONTROL, CUBIC, QUADRATIC, START, Strokes, WHOLE};
use crate::fit::bezier;
use crate::fit::plane::{Vec2, length, minus};

/// Chords by which one curve is measured. With Richardson's extrapolation the error is 1e-6 of a quarter circle.
const CHORDS: usize = 16;

/// One row of a stroke as a curve with parameter 0..1, in millimetres, y up.
enum Piece {
    Bezier(usize, [Vec2; 4]),
    Arc(Drawn),
}

/// One drawn row: its length in millimetres, and the directions (unit vectors, or zero) in which it begins and ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    pub length: f64,
    pub begins: Vec2,
    pub ends: Vec2,
}

impl Piece {
    fn at(&self, t: f64) -> Vec2 {
        match self {
            Piece::Bezier(n, p) => bezier::at(&p[..*n], t),
            Piece::Arc(arc) => arc.at(t),
        }
    }

    fn measured(&self) -> Measured {
        let chords = |n: usize| -> f64 {
            let place = |i: usize| self.at(i as f64 / n as f64);
            (0..n).map(|i| length(&minus(&place(i + 1), &place(i)))).sum()
        };
        let straight = matches!(self, Piece::Bezier(2, _));
        let fine = chords(if straight { 1 } else { CHORDS });
        let length = if straight { fine } else { fine + (fine - chords(CHORDS / 2)) / 3.0 };
        let toward = |a: f64, b: f64| unit(&minus(&self.at(b), &self.at(a)));
        let step = if straight { 1.0 } else { 1e-4 };
        Measured { length, begins: toward(0.0, step), ends: toward(1.0 - step, 1.0) }
    }
}

fn unit(v: &Vec2) -> Vec2 {
    let size = length(v);
    if size > 0.0 { v.map(|c| c / size) } else { *v }
}

/// The curves of stroke `s` in order, with the closing line of a closed polyline.
fn pieces(strokes: &Strokes, s: usize) -> SmallVec<[Piece; 4]> {
    let unit = 10f64.powi(-(strokes.places as i32));
    let at = |i: usize| strokes.points[i].map(|c| c as f64 * unit);
    let (first, last) = (strokes.starts[s] as usize, strokes.starts[s + 1] as usize);
    let mut out = SmallVec::with_capacity(last - first);
    for i in first..last {
        let shape = || &strokes.arcs[strokes.arc[i] as usize];
        match strokes.op[i] {
            START | CONTROL => {}
            QUADRATIC => out.push(Piece::Bezier(3, [at(i - 2), at(i - 1), at(i), at(i)])),
            CUBIC => out.push(Piece::Bezier(4, [at(i - 3), at(i - 2), at(i - 1), at(i)])),
            ARC => out.extend(Drawn::between(shape(), &at(i - 1), &at(i), unit).map(Piece::Arc)),
            WHOLE => {
                let radii = shape().radii.map(|r| r as f64 * unit * 10f64.powi(-(EXTRA as i32)));
                // Four quarters, so that a flat ellipse is measured accurately.
                out.extend((0..4).map(|quarter| Piece::Arc(Drawn::quarter(at(i), radii, quarter))));
            }
            _ => out.push(Piece::Bezier(2, [at(i - 1), at(i), at(i), at(i)])),
        }
    }
    if strokes.closed[s] && strokes.points[first] != strokes.points[last - 1] {
        out.push(Piece::Bezier(2, [at(last - 1), at(first), at(first), at(first)]));
    }
    out
}

/// The drawn rows of stroke `s` in order, with the closing line of a closed polyline.
pub fn rows(strokes: &Strokes, s: usize) -> Vec<Measured> {
    pieces(strokes, s).iter().map(Piece::measured).filter(|m| m.length > 0.0).collect()
}

/// An end point of a stroke (grid steps), and the direction in which it would go on there.
pub type End = ([i64; 2], Vec2);

/// Both ends of stroke `s`. None if it is closed.
pub fn ends(strokes: &Strokes, s: usize) -> Option<[End; 2]> {
    if !open(strokes, s) {
        return None;
    }
    // The first and the last that have a length: those between need no measuring.
    let pieces = pieces(strokes, s);
    let drawn = |piece: &Piece| Some(piece.measured()).filter(|m| m.length > 0.0);
    let begin = pieces.iter().find_map(drawn)?;
    let end = if pieces.len() == 1 { begin } else { pieces.iter().rev().find_map(drawn)? };
    between(strokes, s, &begin, &end)
}

/// Both ends of stroke `s`, given its first row and its last one. None if it is closed.
pub fn between(strokes: &Strokes, s: usize, begin: &Measured, end: &Measured) -> Option<[End; 2]> {
    let (first, last) = (strokes.starts[s] as usize, strokes.starts[s + 1] as usize);
    let ends = || [(strokes.points[first], begin.begins.map(|c| -c)), (strokes.points[last - 1], end.ends)];
    open(strokes, s).then(ends)
}

/// Whether a stroke has ends.
fn open(strokes: &Strokes, s: usize) -> bool {
    !strokes.closed[s] && strokes.op[strokes.starts[s] as usize] != WHOLE
}
