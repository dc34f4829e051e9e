//! The borders of faces, made from the polylines of their edges.

mod border;
mod cap;
mod chain;
mod invert;
mod uses;

pub use border::{Border, Node, border};
pub use invert::near;

#[cfg(test)]
mod tests;
