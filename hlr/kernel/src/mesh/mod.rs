//! What can be said of triangles whatever the view, in one pass over arrays of millions.

pub mod clean;
pub mod groups;
pub mod kinds;
pub mod needles;
pub mod passes;
