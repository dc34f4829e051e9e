//! The borders of faces, made from the polylines of their edges.

mod border;
mod cap;
mod chain;
mod invert;
mod node;
mod uses;

pub use border::{Border, border};
pub use invert::near;
pub use node::Node;

#[cfg(test)]
mod tests;
