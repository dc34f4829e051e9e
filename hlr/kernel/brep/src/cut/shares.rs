//! What a plane keeps of each face of a body, and of each edge.

use super::edge_pieces::Pieces;
use super::regions::Regions;
use super::trace::Section;
use crate::body::Body;
use crate::format::Orientation;
use crate::geometry::vector::Vector;
use crate::tessellate::Tessellation;

/// What is kept of a face.
pub enum Share {
    Whole,
    Gone,
    Part(Box<(Section, Regions)>),
}

pub struct Shares<'a> {
    pub body: &'a Body,
    pub guided: &'a Tessellation,
    /// By edge and by face of the body.
    pub pieces: &'a [Pieces],
    pub shares: &'a [Share],
    /// Places of all vertices.
    pub vertices: &'a [Vector],
}

/// 1 where a face with this orientation uses an edge in its sense, -1 where against it, 0 where it does not bound it.
pub fn sense(orientation: Orientation, reversed: bool) -> i32 {
    let along = match orientation {
        Orientation::Forward => 1,
        Orientation::Reversed => -1,
        _ => 0,
    };
    if reversed { -along } else { along }
}
