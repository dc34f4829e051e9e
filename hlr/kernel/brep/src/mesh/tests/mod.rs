//! Faces made by hand. Their meshes are compared with dense samples of the surface.

mod curved;
mod flat;
pub mod shapes;
