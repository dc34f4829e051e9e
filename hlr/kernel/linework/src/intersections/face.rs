//! The surface of a face in its place.

use hlr_brep::faces::near;
use hlr_brep::format::{inverted, moved, turned};
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, unit};

type Matrix = [[f64; 4]; 3];

#[derive(Clone, Copy)]
pub struct Face<'a> {
    pub surface: &'a Surface,
    place: &'a Matrix,
    back: Matrix,
}

/// The point of a face nearest to another, and the unit normal there.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    pub uv: [f64; 2],
    pub point: Vector,
    pub normal: Vector,
}

impl<'a> Face<'a> {
    pub fn new(surface: &'a Surface, place: &'a Matrix) -> Face<'a> {
        Face { surface, place, back: inverted(place) }
    }

    /// The point nearest to `p`, searched from parameters nearby.
    pub fn foot(&self, p: &Vector, guess: [f64; 2]) -> Option<Foot> {
        let uv = near(self.surface, &moved(&self.back, p), guess)?;
        let (point, normal) = self.surface.placed(uv);
        Some(Foot { uv, point: moved(self.place, &point), normal: unit(&turned(self.place, &normal?))? })
    }

    /// A point of the surface's frame, in the model.
    pub fn moved(&self, p: &Vector) -> Vector {
        moved(self.place, p)
    }

    /// A direction of the surface's frame, in the model.
    pub fn turned(&self, way: &Vector) -> Vector {
        turned(self.place, way)
    }
}
