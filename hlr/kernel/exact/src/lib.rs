//! One rounding to a grid, then integer predicates without any error.

pub mod arithmetic;
pub mod elementary;
pub mod parameter;
pub mod predicates;
pub mod snap;
pub mod wide;

/// A snapped point in view space: x right, y up, z away from the viewer.
pub type Point = [i32; 3];
