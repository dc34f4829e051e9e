//! Curves and surfaces of a B-rep, as their records say: evaluated with derivatives, without OpenCASCADE.

mod basis;
pub mod curve;
pub mod flat;
pub mod jet;
pub mod moved_surface;
pub mod nurbs;
pub mod offset_curve;
mod spans;
pub mod spline_surface;
pub mod surface;
pub mod turning;
pub mod unrolled;
pub mod vector;
