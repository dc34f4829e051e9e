//! Polylines of edges: each underlying edge once, shared by all of its faces.

mod chord_error;
mod chords;
mod polyline;

pub use chord_error::from_chord;
pub use polyline::{Polyline, polyline};
