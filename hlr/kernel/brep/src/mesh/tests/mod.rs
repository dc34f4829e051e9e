//! Faces made by hand. Their meshes are compared with dense samples of the surface.

mod crossed;
pub mod curved;
mod flat;
pub mod shapes;
mod unfinished;
