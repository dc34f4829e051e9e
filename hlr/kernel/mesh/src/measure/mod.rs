//! Nearest segments and ray casting for the measurements of `hlr/lab/measure`.
//!
//! All of it is in floating point and shares no code with the visibility pass: what judges a drawing must not share its
//! faults.

pub(crate) mod boxes;
pub mod nearest;
pub mod rays;
