//! A curve in its place in space and on paper, and the interval of it that a line draws.

use super::arc::Ellipse;
use super::bezier::Chain;
use super::plane::Vec2;
use super::project::{Paper, Projection};
use super::track::Track;
use hlr_brep::geometry::curve::{Curve, Vec3};

#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    Straight,
    Arc(Ellipse, [f64; 2]),
    Chain(Chain),
}

/// A line as it is drawn: the interval of its curve, the end points of the interval, and its form.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub form: Form,
    pub range: [f64; 2],
    pub flat: [Vec2; 2],
    pub space: [Vec3; 2],
    pub bounds: [Vec2; 2],
}

/// A curve in its place in space and on paper.
pub struct Placed {
    pub curve: Curve,
    pub paper: Paper,
    pub range: [f64; 2],
    pub track: Track,
    pub ellipse: Option<Ellipse>,
}

impl Placed {
    pub fn new(curve: Curve, range: [f64; 2], projection: &Projection, model: f64) -> Placed {
        let paper = Paper::of(&curve, projection);
        let ellipse = match &paper {
            Paper::Ellipse { p, a, b } => Ellipse::image(p, a, b),
            _ => None,
        };
        let track = Track::new(&curve, range, model);
        Placed { curve, paper, range, track, ellipse }
    }

    /// Point and derivative on paper at a parameter.
    pub fn on_paper(&self, t: f64) -> [Vec2; 2] {
        self.paper.at(self.track.wrapped(t))
    }
}
