//! Boundary representations: curves, surfaces, and the mesh of a face. No Python here.

pub mod edges;
pub mod explore;
pub mod faces;
pub mod format;
pub mod geometry;
pub mod mesh;
pub mod model;
pub mod tessellate;
