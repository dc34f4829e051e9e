//! Lines with their curves, and the places where they end.

use super::Placed;
use super::plane::{Vec2, minus};
use crate::lines::View;
use hlr_brep::geometry::curve::Vec3;

/// Whether a surface may end at a line in the image and hide lines that pass behind it. No surface ends at an
/// intersection line or a smooth edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Border {
    None,
    Edge,
    Outline,
}

/// A line with its curve, if it has one, and the curve's parameters at its points.
pub struct Route<'a> {
    pub chain: i32,
    pub visible: bool,
    /// As of its `Polyline`.
    pub left_out: [bool; 2],
    pub border: Border,
    pub flat: &'a [Vec2],
    pub space: &'a [Vec3],
    pub curve: Option<(&'a Placed, Vec<f64>)>,
    /// How far its curve rises above the chords on which the change was found, in millimetres on paper.
    pub bulge: f64,
}

impl Route<'_> {
    pub fn parameter(&self, i: usize, s: f64) -> f64 {
        match &self.curve {
            Some((_, t)) => t[i] + (t[i + 1] - t[i]) * s,
            None => i as f64 + s,
        }
    }

    fn segment(&self, t: f64) -> (usize, f64) {
        let i = t.floor().clamp(0.0, (self.flat.len() - 2) as f64) as usize;
        (i, t - i as f64)
    }

    /// Point and derivative at t. A polyline is extended straight beyond its ends.
    pub fn at(&self, t: f64) -> [Vec2; 2] {
        if let Some((placed, _)) = &self.curve {
            return placed.on_paper(t);
        }
        let (i, s) = self.segment(t);
        let way = minus(&self.flat[i + 1], &self.flat[i]);
        [[self.flat[i][0] + way[0] * s, self.flat[i][1] + way[1] * s], way]
    }

    /// The new end parameter t of a line that ended at `start`, limited to the ends of its curve, and of its edge; None if
    /// it is more than half a turn of a closed curve away.
    pub fn ending(&self, t: f64, start: f64) -> Option<f64> {
        let Some((placed, _)) = &self.curve else { return Some(t) };
        let t = placed.track.ending(start, t)?;
        Some(if self.border == Border::Outline { t } else { placed.track.within_arc(start, t) })
    }

    /// The point in space that `at` is the image of.
    pub fn in_space(&self, t: f64, view: &View) -> Vec3 {
        if let Some((placed, _)) = &self.curve {
            return placed.curve.point(placed.track.wrapped(t));
        }
        let (i, s) = self.segment(t);
        let (a, b) = (&self.space[i], &self.space[i + 1]);
        let s = view.in_space(s, view.depth(a), view.depth(b));
        [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
    }
}

/// An end that moves.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    pub line: usize,
    /// 0 for the line's start, 1 for its end.
    pub end: usize,
    pub to: Goal,
}

#[derive(Clone, Copy, Debug)]
pub enum Goal {
    /// A parameter of the line's curve.
    Parameter(f64),
    /// For polylines: the one point, on paper and in space, to which all ends that meet there move.
    Point(Vec2, Vec3),
    /// The same, where that point lies on the other line: this one goes on there, and its old end is a corner of it.
    Around(Vec2, Vec3),
}

/// A place where lines of one chain end: a visible and a hidden one, or an outline alone.
pub struct Change {
    pub at: Vec2,
    /// Pairs (line, end).
    pub ends: Vec<(usize, usize)>,
}
