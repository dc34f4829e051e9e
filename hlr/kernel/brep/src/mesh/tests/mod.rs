//! Faces made by hand, their meshes held against the surface by dense samples.

mod flat;
mod shapes;
