//! Faces made by hand, their meshes held against the surface by dense samples.

mod curved;
mod flat;
pub mod shapes;
