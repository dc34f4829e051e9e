//! Curves and surfaces of a B-rep, evaluated with their derivatives from the records of the file, without OpenCASCADE.

mod basis;
pub mod curve;
pub mod jet;
pub mod moved_surface;
pub mod nurbs;
pub mod offset_curve;
mod offset_surface;
pub mod periodic;
pub mod planar;
mod spans;
pub mod spline_surface;
pub mod surface;
pub mod surface_jet;
pub mod turning;
pub mod vector;
pub mod waves;
