//! NumPy <-> Rust: shapes and ranges are checked here, no geometry. This file registers the module.

mod arrays;
mod boxes;
mod brep;
mod brep_file;
mod chains;
mod clash;
mod curve_columns;
mod drawing;
mod fill;
mod geometry;
mod guard;
mod intersections;
mod lines;
mod measure;
mod mesh;
mod mesh_input;
mod meshfile;
mod methods;
mod outlined;
mod painters;
mod parts;
mod preview;
mod raster;
mod silhouette;
mod spread;
mod threads;
mod topology;
mod true_surfaces;
mod view;
mod visibility;

use pyo3::prelude::*;

#[pymodule]
fn _kernel(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(topology::stitched, m)?)?;
    m.add_function(wrap_pyfunction!(topology::components, m)?)?;
    m.add_function(wrap_pyfunction!(topology::edge_table, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::clean_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::without_needles, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::needles, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::edge_kinds, m)?)?;
    m.add_function(wrap_pyfunction!(topology::edge_components, m)?)?;
    m.add_function(wrap_pyfunction!(visibility::visibility, m)?)?;
    m.add_function(wrap_pyfunction!(visibility::edge_roles, m)?)?;
    m.add_class::<mesh_input::Mesh>()?;
    m.add_class::<mesh_input::Groups>()?;
    m.add_class::<visibility::OwnFaces>()?;
    m.add_class::<visibility::Visibility>()?;
    m.add_function(wrap_pyfunction!(clash::clashes, m)?)?;
    m.add_function(wrap_pyfunction!(clash::boxes_meet, m)?)?;
    m.add_function(wrap_pyfunction!(boxes::placed_boxes, m)?)?;
    m.add_function(wrap_pyfunction!(threads::limit_threads, m)?)?;
    m.add_function(wrap_pyfunction!(geometry::curve_points, m)?)?;
    m.add_class::<drawing::Lines>()?;
    m.add_class::<drawing::Layer>()?;
    m.add_function(wrap_pyfunction!(chains::chain, m)?)?;
    m.add_class::<lines::Camera>()?;
    m.add_class::<lines::LineTolerances>()?;
    m.add_class::<geometry::Curves>()?;
    m.add_class::<chains::Walks>()?;
    m.add_class::<chains::Chains>()?;
    m.add_class::<lines::Cut>()?;
    m.add_class::<brep_file::BrepFile>()?;
    m.add_function(wrap_pyfunction!(brep_file::dump_of_pieces, m)?)?;
    m.add_function(wrap_pyfunction!(brep_file::square_placement, m)?)?;
    m.add_class::<brep::BrepModel>()?;
    m.add_class::<brep::BrepMesh>()?;
    m.add_class::<parts::PartTables>()?;
    m.add_class::<parts::MeshFacts>()?;
    m.add_class::<parts::MeshScene>()?;
    m.add_class::<preview::PictureLens>()?;
    m.add_class::<preview::PictureLight>()?;
    m.add_class::<preview::ShadedModel>()?;
    m.add_function(wrap_pyfunction!(preview::stroke_picture, m)?)?;
    m.add_function(wrap_pyfunction!(fill::filled_areas, m)?)?;
    m.add_function(wrap_pyfunction!(preview::surface_normals, m)?)?;
    m.add_function(wrap_pyfunction!(painters::quadric_row, m)?)?;
    m.add_class::<raster::RasterScene>()?;
    m.add_class::<true_surfaces::Surfaces>()?;
    m.add_class::<true_surfaces::TrueSurfaces>()?;
    m.add_class::<intersections::IntersectionCurves>()?;
    m.add_function(wrap_pyfunction!(intersections::intersection_curves, m)?)?;
    m.add_class::<silhouette::Outlines>()?;
    m.add_function(wrap_pyfunction!(silhouette::silhouettes, m)?)?;
    m.add_class::<outlined::Outlined>()?;
    m.add_function(wrap_pyfunction!(outlined::outlined, m)?)?;
    m.add_function(wrap_pyfunction!(meshfile::read_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(measure::nearest, m)?)?;
    m.add_function(wrap_pyfunction!(measure::blocked, m)?)?;
    m.add_function(wrap_pyfunction!(measure::first_hits, m)?)?;
    m.add_function(wrap_pyfunction!(guard::take_fault, m)?)?;
    m.add_function(wrap_pyfunction!(guard::provoke_fault, m)?)?;
    // Last: anything registered after this is not guarded.
    guard::guard(m)
}
