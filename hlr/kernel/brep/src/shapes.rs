//! Underlying edges and faces, and the uses of edges by the wires of faces.

use crate::format::{Matrix, Orientation, SurfaceRecord, Triangulation};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;

/// A vertex: its underlying shape, and its location within the shape that holds it.
pub type Vertex = (u32, u32);

/// Flag of a missing vertex at the end of an edge, combined with the edge's number.
pub const NO_VERTEX: u32 = 1 << 31;

/// An underlying edge, in its own frame.
#[derive(Clone)]
pub struct Edge {
    /// The curve in space; None if only the curves on surfaces are known.
    pub curve: Option<Curve>,
    pub range: [f64; 2],
    pub tolerance: f64,
    /// The edge is a single point in space: a pole.
    pub degenerate: bool,
    /// First and last vertex; `end_points` are their places in the edge's frame.
    pub ends: [Option<Vertex>; 2],
    pub end_points: [Option<[f64; 3]>; 2],
    /// A file or a modeller states that two faces are tangent along the edge.
    pub tangent: bool,
    pub on: Vec<OnSurface>,
    pub polygon: Option<Vec<[f64; 3]>>,
    /// For an edge without a curve in space: number of its curve in (u, v), and the surface in the edge's frame.
    pub only_on: Option<Box<(usize, Surface)>>,
    /// Parameters at which its polyline has a corner, ascending.
    pub joints: Vec<f64>,
    /// The edge of which it is a copy, and whether it runs the other way.
    pub original: Option<(u32, bool)>,
}

/// An edge's curves in (u, v) of a surface, one for each sense where the edge is a seam.
#[derive(Clone)]
pub struct OnSurface {
    pub surface: usize,
    pub location: u32,
    pub curves: [usize; 2],
    pub range: [f64; 2],
}

/// An underlying face in its own frame, with forward orientation.
#[derive(Clone)]
pub struct Face {
    pub record: Option<SurfaceRecord>,
    pub surface: Option<Surface>,
    pub tolerance: f64,
    pub wires: Vec<Vec<Use>>,
    /// The face's own triangles, for a face without a surface.
    pub own: Option<Triangulation>,
    /// It lies between an edge and a copy of it.
    pub no_area: bool,
}

/// A use of an edge by a wire of a face.
#[derive(Clone, Debug, PartialEq)]
pub struct Use {
    pub edge: u32,
    pub location: u32,
    /// The matrix of the location; None for the identity.
    pub place: Option<Box<Matrix>>,
    pub orientation: Orientation,
    /// First and last vertex of the edge, as the face sees them.
    pub ends: [Vertex; 2],
    /// Number of the curve in (u, v), and its range.
    pub curve2: Option<(usize, [f64; 2])>,
}

impl Edge {
    /// An edge on a curve in space, with its first and last vertex.
    pub fn on_curve(curve: Curve, range: [f64; 2], ends: [Vertex; 2], tolerance: f64) -> Edge {
        Edge {
            curve: Some(curve),
            range,
            tolerance,
            degenerate: false,
            ends: ends.map(Some),
            end_points: [None; 2],
            tangent: false,
            on: Vec::new(),
            polygon: None,
            only_on: None,
            joints: Vec::new(),
            original: None,
        }
    }

    /// First and last vertex; a missing vertex is replaced by one of the edge's own.
    pub fn ends(&self, number: u32) -> [Vertex; 2] {
        self.ends.map(|end| end.unwrap_or((NO_VERTEX | number, 0)))
    }
}

/// The edges, faces and curves in (u, v) to which a part's numbers refer, borrowed from a model.
#[derive(Clone, Copy)]
pub struct Shapes<'a> {
    pub edges: &'a [Edge],
    pub faces: &'a [Face],
    pub curves2: &'a [Option<Curve>],
}
