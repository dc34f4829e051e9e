//! Boxes around triangles, edges and groups, and a hierarchy that finds those that overlap.
//!
//! `aabb`    a box
//! `morton`  boxes sorted along a curve that keeps neighbours together
//! `tree`    the hierarchy: which boxes overlap a given one
//! `pairs`   the hierarchy against itself or another: which pairs of boxes overlap
//! `meeting` which boxes of a few overlap others

pub mod aabb;
pub mod meeting;
mod morton;
pub(crate) mod pairs;
pub mod tree;
