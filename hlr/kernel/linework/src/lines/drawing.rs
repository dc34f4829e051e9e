//! The lines of a finished drawing: class, visibility, source, points on paper and in space, and the curve of each.

use crate::curves::arcs::Arc;
use crate::fit::arc::{arc_bounds, grow};
use crate::fit::bezier::Chain;
use crate::fit::plane::Vec2;

/// Why a line is drawn: the number of a line class (`hlr/tables/line_classes.py`). The kernel treats all classes alike
/// except those named here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind(pub u8);

impl Kind {
    pub const SHARP: Kind = Kind(0);
    pub const BOUNDARY: Kind = Kind(3);
    pub const OUTLINE: Kind = Kind(4);
    pub const INTERSECTION: Kind = Kind(5);
}

/// The curve of a line on paper, where its points are only samples of it; millimetres, y up.
#[derive(Clone, Debug)]
pub enum Curve {
    Arc(Arc),
    Chain(Chain),
}

#[derive(Clone, Debug)]
pub struct Line {
    pub kind: Kind,
    pub visible: bool,
    pub part: i32,
    /// -1 for none, as for `face` and `other` (the second part of an intersection line).
    pub edge: i32,
    pub face: i32,
    pub other: i32,
    pub flat: Vec<Vec2>,
    pub space: Vec<[f64; 3]>,
    pub curve: Option<Curve>,
}

impl Line {
    /// Extends a bounding box by this line: by its curve if it has one, otherwise by its points.
    fn grow(&self, bounds: &mut [Vec2; 2]) {
        let corners = match &self.curve {
            None => return self.flat.iter().for_each(|p| grow(bounds, p)),
            Some(Curve::Arc(arc)) => arc_bounds(&|t| arc.at(t), &arc.axes, arc.angles),
            Some(Curve::Chain(chain)) => chain.bounds(),
        };
        corners.iter().for_each(|p| grow(bounds, p));
    }

    pub fn finite(&self) -> bool {
        let curve = match &self.curve {
            None => true,
            Some(Curve::Arc(a)) => a.centre.iter().chain(a.axes.as_flattened()).chain(&a.angles).all(|x| x.is_finite()),
            Some(Curve::Chain(chain)) => chain.points.iter().flatten().all(|x| x.is_finite()),
        };
        curve && self.flat.iter().flatten().all(|x| x.is_finite())
    }
}

#[derive(Clone, Debug, Default)]
pub struct Lines(pub Vec<Line>);

impl Lines {
    /// Lower and upper corner of the bounding box of all lines; None if there are none.
    pub fn bounds(&self) -> Option<[Vec2; 2]> {
        let mut out = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        self.0.iter().for_each(|line| line.grow(&mut out));
        (!self.0.is_empty()).then_some(out)
    }
}
