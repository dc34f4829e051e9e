//! What a dump holds, however it is written.

use super::locations::Locations;
use super::shapes::{On, Shape, Sub};
use super::surfaces::SurfaceRecord;
use super::triangles::Triangulation;
use crate::geometry::curve::Curve;

/// The content of a dump. Underlying shapes come before the shapes that contain them.
pub struct Dump {
    pub locations: Locations,
    /// Curves in (u, v), as curves in space with z = 0; None for a kind that is not supported.
    pub curves2: Vec<Option<Curve>>,
    pub curves: Vec<Option<Curve>>,
    /// Polygons in space.
    pub polygons: Vec<Vec<[f64; 3]>>,
    pub surfaces: Vec<Option<SurfaceRecord>>,
    pub triangulations: Vec<Triangulation>,
    pub shapes: Vec<Shape>,
    /// The geometry of all edges, one edge after another.
    pub on: Vec<On>,
    pub root: Sub,
}

impl Dump {
    /// The geometry of an edge.
    pub fn on(&self, [first, end]: [u32; 2]) -> &[On] {
        &self.on[first as usize..end as usize]
    }
}
