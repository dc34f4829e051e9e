//! Memory that one picture needs and the next one reuses: an animation draws many pictures, and allocating costs as
//! much as filling.

use super::face::{Chunk, Vertex};
use super::tile_lists::List;

#[derive(Default)]
pub struct Workspace {
    pub(super) vertices: Vec<Vertex>,
    pub(super) chunks: Vec<Chunk>,
    pub(super) lists: Vec<List>,
}

impl Workspace {
    /// How many faces the last picture had.
    pub fn faces(&self) -> usize {
        self.chunks.iter().map(|c| c.faces.len()).sum()
    }
}
