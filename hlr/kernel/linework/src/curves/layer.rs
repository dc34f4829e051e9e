//! Layers of pen strokes: the lines of one class and visibility, joined where one ends and the next begins.

use rayon::prelude::*;

use super::arcs::Rows;
use super::rows::add_rows;
use super::strokes::{ARC, LINE, START, Shape, Strokes, WHOLE};
use crate::lines::drawing::{Kind, Line, Lines};

/// All strokes of one line class and visibility, in grid steps of 10^-places millimetres, y up.
#[derive(Clone, Debug)]
pub struct Layer {
    pub kind: Kind,
    pub visible: bool,
    pub places: usize,
    /// The rows of all strokes. No straight row repeats a point; the last point of a closed polyline is left out.
    pub rows: Rows,
    /// (strokes + 1) offsets into the rows. Each stroke has at least two rows, a whole circle or ellipse one.
    pub starts: Vec<i64>,
    pub closed: Vec<bool>,
    /// Per stroke.
    pub ties: Vec<Tie>,
}

/// Part, edge and second part of a stroke; -1 for none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tie {
    pub part: i32,
    pub edge: i32,
    pub other: i32,
}

/// Lines whose rows one thread makes together.
const TOGETHER: usize = 64;

/// The rows of one line.
#[derive(Clone, Copy)]
struct RowsOf<'a> {
    points: &'a [[i64; 2]],
    op: &'a [u8],
    arc: &'a [i32],
    shapes: &'a [Shape],
}

/// The rows of some lines, one after another, and where those of each end.
struct Chunk {
    rows: Rows,
    ends: Vec<usize>,
}

impl Chunk {
    fn of(lines: &[Line], places: usize, accuracy: f64, cubic: bool) -> Chunk {
        let (mut rows, mut ends) = (Rows::default(), Vec::with_capacity(lines.len()));
        for line in lines {
            add_rows(line, places, accuracy, cubic, &mut rows);
            ends.push(rows.op.len());
        }
        Chunk { rows, ends }
    }

    /// The rows of each line.
    fn lines(&self) -> impl Iterator<Item = RowsOf<'_>> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(from, &to)| RowsOf {
            points: &self.rows.points[from..to],
            op: &self.rows.op[from..to],
            arc: &self.rows.arc[from..to],
            shapes: &self.rows.shapes,
        })
    }
}

/// The layers of a drawing: hidden ones first, so that visible lines lie on top; within each, the kinds in this order.
/// Empty layers are left out.
pub fn layers(lines: &Lines, order: &[Kind], places: usize, accuracy: f64, cubic: bool) -> Vec<Layer> {
    let chunks: Vec<Chunk> =
        lines.0.par_chunks(TOGETHER).map(|some| Chunk::of(some, places, accuracy, cubic)).collect();
    let rows: Vec<RowsOf> = chunks.iter().flat_map(Chunk::lines).collect();
    let each: Vec<(bool, Kind)> =
        [false, true].iter().flat_map(|&v| order.iter().map(move |&kind| (v, kind))).collect();
    let layer = |&(visible, kind): &(bool, Kind)| {
        let of = |line: &Line| line.visible == visible && line.kind == kind;
        let some = lines.0.iter().zip(&rows).filter(|(line, _)| of(line));
        let (rows, starts, closed, ties) = (Rows::default(), vec![0], Vec::new(), Vec::new());
        let mut layer = Layer { kind, visible, places, rows, starts, closed, ties };
        layer.draw(some);
        layer
    };
    let mut found: Vec<Layer> = each.par_iter().map(layer).collect();
    found.retain(|layer| !layer.closed.is_empty());
    found
}

impl Layer {
    pub fn strokes(&self) -> Strokes<'_> {
        Strokes {
            points: &self.rows.points,
            op: &self.rows.op,
            arc: &self.rows.arc,
            arcs: &self.rows.shapes,
            starts: &self.starts,
            closed: &self.closed,
            places: self.places,
        }
    }

    /// Drop points that coincide on the grid, join lines that follow one another, find closed strokes.
    fn draw<'a>(&mut self, lines: impl Iterator<Item = (&'a Line, &'a RowsOf<'a>)>) {
        let mut tie = Tie { part: -1, edge: -1, other: -1 };
        let mut before: Option<(Tie, [i64; 2], bool)> = None;
        for (line, rows) in lines {
            let (Some(first), Some(last)) = (rows.points.first(), rows.points.last()) else { continue };
            let own = Tie { part: line.part, edge: line.edge, other: line.other };
            // A line joins the one before it where it starts on its end, on the same edge of the same part.
            let (begin, end, loops) = (*first, *last, first == last);
            let joins = before.is_some_and(|(tie, end, looped)| tie == own && end == begin && !looped && !loops);
            before = Some((own, end, loops));
            if !joins {
                self.close(tie);
                tie = own;
            }
            // The first point of a line that joins is the last point of the line before.
            let mut last = joins.then_some(begin);
            for ((&p, &op), &arc) in rows.points.iter().zip(rows.op).zip(rows.arc) {
                let op = if op == START && joins { LINE } else { op };
                let still = matches!(op, LINE | ARC) && last == Some(p);
                if !still {
                    self.rows.push(p, op, usize::try_from(arc).ok().map(|k| rows.shapes[k]));
                }
                last = Some(p);
            }
        }
        self.close(tie);
    }

    /// Ends the stroke of the last rows. One that rounding has shrunk to a single point is not drawn.
    fn close(&mut self, tie: Tie) {
        let begin = self.starts.last().map_or(0, |&start| start as usize);
        let (points, op) = (&self.rows.points[begin..], &self.rows.op[begin..]);
        let n = op.len();
        if n == 0 || (n == 1 && op[0] != WHOLE) {
            self.rows.truncate(begin);
            return;
        }
        // Two rows form a loop only if one of them is a curve; two straight ones run there and back.
        let curved = op.iter().any(|&op| op > LINE);
        let closed = points[0] == points[n - 1] && (n > 3 || (curved && n > 1));
        if closed && op[n - 1] == LINE {
            self.rows.truncate(begin + n - 1);
        }
        self.starts.push(self.rows.op.len() as i64);
        self.closed.push(closed);
        self.ties.push(tie);
    }

    /// The same layer, moved by so many grid steps.
    pub fn moved(&self, by: [i64; 2]) -> Layer {
        let mut out = self.clone();
        out.rows.points.iter_mut().for_each(|p| *p = [p[0] + by[0], p[1] + by[1]]);
        out
    }

    /// The same layer with y reversed; arcs then turn the other way.
    pub fn mirrored(&self) -> Layer {
        let mut out = self.clone();
        out.rows.points.iter_mut().for_each(|p| p[1] = -p[1]);
        let turned = |s: &Shape| Shape { rotation: -s.rotation, rising: !s.rising, ..*s };
        out.rows.shapes.iter_mut().for_each(|s| *s = turned(s));
        out
    }
}
