//! Boundary representations: curves, surfaces, and the mesh of a face. No Python here.

pub mod assemble;
pub mod certificate;
pub mod classes;
pub mod edges;
pub mod explore;
pub mod faces;
pub mod format;
pub mod geometry;
pub mod laid;
pub mod mesh;
pub mod model;
pub mod patch;
pub mod tangency;
pub mod tessellate;
