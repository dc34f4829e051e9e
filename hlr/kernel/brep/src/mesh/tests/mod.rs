//! Faces made by hand. Their meshes are compared with dense samples of the surface.

mod crossed;
mod curved;
mod flat;
pub mod shapes;
