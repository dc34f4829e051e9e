//! A body while it is put together.

use crate::body::{Body, BodyFace};
use crate::shapes::Edge;

/// What is made so far. `on_plane` and `sums`: by edge, whether it lies on the plane, and how often faces use it in its
/// sense, those against it subtracted.
pub struct BodyBuilder {
    pub body: Body,
    pub on_plane: Vec<bool>,
    pub sums: Vec<i32>,
}

impl BodyBuilder {
    pub fn add_edge(&mut self, edge: Edge, on_plane: bool) -> u32 {
        self.body.edges.push(edge);
        self.on_plane.push(on_plane);
        self.sums.push(0);
        self.body.edges.len() as u32 - 1
    }

    pub fn add_face(&mut self, face: BodyFace) {
        for used in face.face.wires.iter().flatten() {
            self.sums[used.edge as usize] += used.orientation.sense(face.reversed);
        }
        self.body.faces.push(face);
    }
}
