//! A mesh that is not yet proved to fill the loops of its face.

use super::gap::Corner;
use super::outline::Outline;

/// Triangles of a face before their proof (`check`).
pub struct Draft {
    pub outline: Outline,
    /// Points of the outline, then inner ones.
    pub corners: Vec<Corner>,
    pub triangles: Vec<[u32; 3]>,
    /// Of points of the outline at one place, the one that triangles have.
    pub stand_in: Vec<u32>,
    pub error: f64,
    /// Loops that run the wrong way, once that is known.
    pub turned: Vec<usize>,
}
