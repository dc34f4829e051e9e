//! The mesh of a model, and what watches over its making.

use std::sync::atomic::AtomicUsize;

use crate::edges::Polyline;
use crate::faces::Node;
use crate::mesh::{FaceMesh, Fault};

pub struct Tessellation {
    /// Polylines by edge; None for an edge without any curve.
    pub lines: Vec<Option<Polyline>>,
    /// Meshes by face.
    pub faces: Vec<MeshedFace>,
}

#[derive(Clone, Debug, Default)]
pub struct MeshedFace {
    pub mesh: FaceMesh,
    /// The vertex or corner for each node number of the mesh.
    pub nodes: Vec<Node>,
    /// The reason if there is no mesh.
    pub fault: Option<Fault>,
    /// How far the edges of the face are off its surface, at most.
    pub off: f64,
}

/// Progress of the work, and the request to stop it.
pub struct Watch<'a> {
    pub stopped: &'a (dyn Fn() -> bool + Sync),
    /// Units done so far: `OF_A_FACE` for each face.
    pub done: &'a AtomicUsize,
}
