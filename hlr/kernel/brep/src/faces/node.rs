//! The points of a face's border.

use crate::shapes::Vertex;

/// A point that faces share, as one face sees it: a vertex, or a corner inside an edge's polyline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    Vertex(Vertex),
    /// Number of the edge, its location, number of the corner.
    Edge(u32, u32, u32),
    /// A point of this face alone, on a seam that has no edge.
    Inside(u32),
}
