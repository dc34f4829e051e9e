//! What can be said of triangles whatever the view, in one pass over arrays of millions.

pub mod bodies;
pub mod boxes;
pub mod clean;
pub mod facts;
pub mod groups;
pub mod kinds;
pub mod measure;
pub mod meshfile;
pub mod needles;
pub mod passes;
pub mod scene;
pub mod stitch;
pub mod tables;
pub mod topology;
pub mod turned;
pub mod walks;
