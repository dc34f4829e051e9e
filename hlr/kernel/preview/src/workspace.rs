//! What a picture needs on its way and the next one needs again: memory, had once. A turning model is drawn many times,
//! and fresh memory costs as much as filling it.

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
