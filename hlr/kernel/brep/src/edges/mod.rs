//! Edges as polylines: each underlying edge once, for all of its faces.

mod chords;
mod hull;
mod of_model;

pub use of_model::{Polyline, polyline};
