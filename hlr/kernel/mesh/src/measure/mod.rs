//! Nearest segments and ray casting for the measurements of `hlr/lab/measure`.
//!
//! All in floating point, and without code of the visibility pass: what judges a drawing must not share its faults.

pub mod boxes;
pub mod nearest;
pub mod rays;
