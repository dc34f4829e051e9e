//! The pieces of silhouettes before they are joined.

use super::contour::Node;
use super::refine::Stretch;

/// A piece between two nodes: over one triangle, or along an edge.
pub struct Link {
    pub ends: [Node; 2],
    pub face: i32,
    pub stretches: Vec<Stretch>,
}
