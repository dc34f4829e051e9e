//! Boundary representations: curves, surfaces, and the mesh of a face. No Python here.

pub mod geometry;
pub mod mesh;
