//! Faces of a model: their borders from their edges' polylines.

mod border;
mod chain;
mod invert;
mod uses;

pub use border::{Border, Node, border};
pub use invert::near;

#[cfg(test)]
mod tests;
