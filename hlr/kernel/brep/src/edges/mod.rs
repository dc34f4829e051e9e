//! Edges as polylines: each underlying edge once, for all of its faces.

mod chords;
mod hull;
mod of_model;

pub use hull::from_chord;
pub use of_model::{Polyline, polyline};
