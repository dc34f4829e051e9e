//! Turns visible and hidden pieces of edges into the lines of a drawing, on their true curves, and those into bytes.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod curves;
pub mod fit;
pub mod intersections;
pub mod legible;
pub mod lines;
pub mod silhouette;
