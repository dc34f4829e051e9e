//! Boundary representations: curves, surfaces, edges as polylines, and meshes of faces.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod assemble;
pub mod body;
pub mod bounds;
pub mod certificate;
mod classes;
mod continued;
mod copied_points;
mod copies;
pub mod crossed;
pub mod cut;
pub mod divided;
mod each_face;
pub mod edges;
pub mod explore;
pub mod face_boxes;
pub mod faces;
mod folded;
pub mod foreign_mesh;
pub mod format;
pub mod geometry;
pub mod mesh;
pub mod model;
pub mod one_sphere;
mod outward;
mod part_topology;
pub mod reach;
pub mod sets;
pub mod shapes;
mod tangency;
pub mod tessellate;
mod turned_faces;
