//! Triangle meshes before any view: reading, cleaning, topology, groups and their properties, edge classes. Arrays hold
//! millions of triangles.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod bodies;
pub mod boxes;
pub mod clean;
mod convexity;
pub mod edge_flips;
pub mod facts;
pub mod groups;
pub mod kinds;
pub mod layers;
mod listed_twice;
pub mod measure;
pub mod meshfile;
pub mod needles;
pub mod placed;
mod ray_count;
pub mod repeats;
mod same_place;
pub mod scene;
mod sizes;
pub mod stitch;
pub mod tables;
pub mod topology;
pub mod walks;

/// Vectors in space, for crates that are built on meshes and know no surfaces.
pub use hlr_brep::geometry::vector;
