//! Curves and surfaces of a B-rep, evaluated with their derivatives from the records of the file, without OpenCASCADE.

mod basis;
pub mod curve;
pub(crate) mod jet;
pub(crate) mod moved_surface;
pub mod nurbs;
pub(crate) mod offset_curve;
mod offset_surface;
pub(crate) mod periodic;
pub mod planar;
mod spans;
pub(crate) mod spline_surface;
pub mod surface;
mod surface_jet;
mod turning;
pub mod vector;
pub(crate) mod waves;
