//! Boxes around triangles, edges and groups, and a hierarchy that finds those that overlap.
//!
//! `aabb`    a box
//! `morton`  boxes sorted along a curve that keeps neighbours together
//! `tree`    the hierarchy: which boxes overlap a given one
//! `pairs`   the hierarchy against itself or another: which pairs of boxes overlap

pub mod aabb;
mod morton;
pub mod pairs;
pub mod tree;
