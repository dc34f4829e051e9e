//! How far drawn lines are from others, and what rays meet: the yardsticks of `hlr/measure`.
//!
//! Floating point, and nothing of the visibility pass: what judges the drawing is not to share its faults.

pub mod boxes;
pub mod nearest;
pub mod rays;
