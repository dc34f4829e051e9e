//! Joins borders of a mesh that run along one another: faces that were meshed one by one meet only approximately.
//!
//! ```text
//!     one face:    a ---------------- b        the border of one face has corners where the other has none,
//!     another:     a' ---- t ---- u -- b'      and a and a' are two roundings of one point
//! ```
//!
//! Corners of borders that lie together within the reach become one node, corners within the reach of another border's
//! edge are put into it, and the pieces between nodes that two borders have in common are joined. What no piece ends at
//! stays where it is. So a border keeps its place and its line unless another one runs along it.

mod border;
mod near;
mod seams;
mod split;

use border::{Vec3, borders};

#[derive(Debug, PartialEq)]
pub struct Stitched {
    /// Corners of all triangles, among the points that were given.
    pub triangles: Vec<[i32; 3]>,
    /// Which triangle that was given each one is, or is a piece of.
    pub origin: Vec<i32>,
    /// Pieces of borders that were joined.
    pub seams: usize,
}

/// Joins borders that run together within `reach` (model units). No corner moves farther than that, and only corners of
/// borders move.
pub fn stitch(points: &[Vec3], triangles: &[[i32; 3]], reach: f64) -> Stitched {
    let borders = borders(triangles, points.len());
    let near = near::Near::find(points, triangles, &borders, reach);
    let seams = seams::Seams::find(&borders, &near);
    let (triangles, origin) = split::split(triangles, &borders, &seams);
    Stitched { triangles, origin, seams: seams.count }
}

#[cfg(test)]
mod tests;
