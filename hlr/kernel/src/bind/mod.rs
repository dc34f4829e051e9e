//! NumPy <-> Rust: shapes and ranges are checked here, no geometry.

pub mod brep;
pub mod chains;
pub mod clash;
pub mod drawn;
pub mod fill;
pub mod geometry;
pub mod guard;
pub mod lines;
pub mod measure;
pub mod mesh;
pub mod meshfile;
pub mod methods;
pub mod painters;
pub mod parts;
pub mod preview;
pub mod raster;
pub mod running;
pub mod scan;
pub mod silhouette;
pub mod view;
