//! From pieces of edges and from surfaces to the lines of a drawing, and to the bytes of a file.

pub mod ink;
pub mod lines;
pub mod paper;
pub mod silhouette;
