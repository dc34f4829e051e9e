//! From visible and hidden pieces of edges to the lines of a drawing, on their true curves, and to the bytes of a file.

pub mod curves;
pub mod fit;
pub mod lines;
pub mod silhouette;
