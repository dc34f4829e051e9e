//! Writes strokes as elements of SVG: an absolute M, then relative commands. Letters and separators are left out where
//! the grammar allows it. y points down.

use rayon::prelude::*;

use super::arcs::{EXTRA, ROTATION};
use super::dashes::Fitted;
use super::digits::put;
use super::layer::Layer;
use super::strokes::{ARC, CONTROL, CUBIC, LINE, QUADRATIC, START, Strokes, WHOLE};

struct Pen {
    out: Vec<u8>,
    command: u8,
    /// The last number had a decimal point, so a number that begins with a point may follow without a separator.
    fraction: bool,
    fresh: bool,
}

impl Pen {
    fn letter(&mut self, command: u8) {
        if self.command != command {
            self.out.push(command);
            self.fresh = true;
        }
        self.command = command;
    }

    fn number(&mut self, steps: i64, places: usize) {
        let starts_with_point = steps != 0 && steps.unsigned_abs() < 10u64.pow(places as u32);
        if !self.fresh && steps >= 0 && !(starts_with_point && self.fraction) {
            self.out.push(b' ');
        }
        self.fraction = put(&mut self.out, steps, places);
        self.fresh = false;
    }
}

/// Strokes that are written by one thread at a time.
const CHUNK: usize = 512;

/// One element per stroke; consecutive strokes of one part form one group. dashes: one per stroke, or empty.
pub fn elements(layer: &Layer, dashes: &[Fitted]) -> Vec<u8> {
    let count = layer.ties.len();
    let chunks = (0..count.div_ceil(CHUNK)).into_par_iter().map(|k| k * CHUNK..((k + 1) * CHUNK).min(count));
    let mut texts: Vec<Vec<u8>> = chunks.map(|strokes| some_elements(layer, dashes, strokes)).collect();
    if count > 0 {
        texts.push(b"</g>\n".to_vec());
    }
    texts.concat()
}

/// The elements of some of the strokes, with the tags between groups that stand before them.
fn some_elements(layer: &Layer, dashes: &[Fitted], of: std::ops::Range<usize>) -> Vec<u8> {
    let strokes = layer.strokes();
    let mut pen = Pen { out: Vec::new(), command: 0, fraction: false, fresh: true };
    for s in of {
        let tie = &layer.ties[s];
        if s == 0 || layer.ties[s - 1].part != tie.part {
            if s > 0 {
                pen.out.extend(b"</g>\n");
            }
            attribute(&mut pen.out, b"<g data-part", tie.part);
            pen.out.extend(b">\n");
        }
        let (first, last) = (strokes.starts[s] as usize, strokes.starts[s + 1] as usize);
        if strokes.op[first] == WHOLE {
            whole(&strokes, first, &mut pen.out);
        } else {
            // The path data comes first, as other programs write it, so that a search for `path d="M` finds it.
            pen.out.extend(b"<path d=\"");
            stroke(&strokes, first, last, &mut pen);
            if strokes.closed[s] {
                pen.out.push(b'z');
            }
            pen.out.push(b'"');
        }
        for (name, number) in [(&b" data-edge"[..], tie.edge), (b" data-other", tie.other)] {
            if number >= 0 {
                attribute(&mut pen.out, name, number);
            }
        }
        if let Some(dashes) = dashes.get(s) {
            dashed(dashes, &mut pen.out);
        }
        pen.out.extend(b"/>\n");
    }
    pen.out
}

fn attribute(out: &mut Vec<u8>, name: &[u8], number: i32) {
    out.extend(name);
    out.extend(b"=\"");
    put(out, number.into(), 0);
    out.push(b'"');
}

fn dashed(dashes: &Fitted, out: &mut Vec<u8>) {
    if dashes.lengths.is_empty() {
        return;
    }
    out.extend(b" stroke-dasharray=\"");
    for (i, length) in dashes.lengths.iter().enumerate() {
        if i > 0 {
            out.push(b' ');
        }
        put(out, *length, dashes.places);
    }
    out.push(b'"');
    if dashes.offset != 0 {
        out.extend(b" stroke-dashoffset=\"");
        put(out, dashes.offset, dashes.places);
        out.push(b'"');
    }
}

fn stroke(strokes: &Strokes, first: usize, last: usize, pen: &mut Pen) {
    let places = strokes.places;
    let at = |i: usize| [strokes.points[i][0], -strokes.points[i][1]];
    let mut here = [0, 0];
    // The last control point, and the command it belonged to.
    let mut control: Option<([i64; 2], u8)> = None;
    pen.command = 0;
    for i in first..last {
        let p = at(i);
        let mut smooth = None;
        match strokes.op[i] {
            START => {
                pen.letter(b'M');
                pen.number(p[0], places);
                pen.number(p[1], places);
            }
            LINE => match [p[0] - here[0], p[1] - here[1]] {
                [dx, 0] => {
                    pen.letter(b'h');
                    pen.number(dx, places);
                }
                [0, dy] => {
                    pen.letter(b'v');
                    pen.number(dy, places);
                }
                [dx, dy] => {
                    pen.letter(b'l');
                    pen.number(dx, places);
                    pen.number(dy, places);
                }
            },
            CONTROL => continue,
            op @ (QUADRATIC | CUBIC) => {
                let controls = if op == CUBIC { 2 } else { 1 };
                let begin = i - controls;
                // A control point that mirrors the one before it need not be written.
                let mirrored =
                    control.is_some_and(|(c, of)| of == op && at(begin) == [2 * here[0] - c[0], 2 * here[1] - c[1]]);
                pen.letter(match (op, mirrored) {
                    (CUBIC, false) => b'c',
                    (CUBIC, true) => b's',
                    (_, false) => b'q',
                    (_, true) => b't',
                });
                for k in begin + usize::from(mirrored)..=i {
                    let q = at(k);
                    pen.number(q[0] - here[0], places);
                    pen.number(q[1] - here[1], places);
                }
                smooth = Some((at(i - 1), op));
            }
            ARC => {
                let shape = &strokes.arcs[strokes.arc[i] as usize];
                pen.letter(b'a');
                pen.number(shape.radii[0], places + EXTRA);
                pen.number(shape.radii[1], places + EXTRA);
                pen.number(-shape.rotation, ROTATION);
                pen.number(i64::from(shape.large), 0);
                pen.number(i64::from(!shape.rising), 0);
                pen.number(p[0] - here[0], places);
                pen.number(p[1] - here[1], places);
            }
            WHOLE => whole(strokes, i, &mut pen.out),
            _ => {}
        }
        control = smooth;
        here = p;
    }
    pen.fresh = true;
}

/// `<circle cx="1" cy="2" r="3"`, or `<ellipse` with `rx="4" ry="3" transform="rotate(30 1 2)"` in place of r.
fn whole(strokes: &Strokes, i: usize, out: &mut Vec<u8>) {
    let (places, shape) = (strokes.places, &strokes.arcs[strokes.arc[i] as usize]);
    out.extend(if shape.radii[0] == shape.radii[1] { &b"<circle "[..] } else { b"<ellipse " });
    let [x, y] = [strokes.points[i][0], -strokes.points[i][1]];
    let mut attribute = |name: &[u8], steps: i64, places: usize| {
        out.extend(name);
        put(out, steps, places);
        out.push(b'"');
    };
    attribute(b"cx=\"", x, places);
    attribute(b" cy=\"", y, places);
    if shape.radii[0] == shape.radii[1] {
        attribute(b" r=\"", shape.radii[0], places + EXTRA);
        return;
    }
    attribute(b" rx=\"", shape.radii[0], places + EXTRA);
    attribute(b" ry=\"", shape.radii[1], places + EXTRA);
    if shape.rotation != 0 {
        out.extend(b" transform=\"rotate(");
        put(out, -shape.rotation, ROTATION);
        for steps in [x, y] {
            out.push(b' ');
            put(out, steps, places);
        }
        out.extend(b")\"");
    }
}
