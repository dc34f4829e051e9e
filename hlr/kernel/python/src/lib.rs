//! NumPy <-> Rust: shapes and ranges are checked here, no geometry. This file registers the module.

mod brep;
mod chains;
mod clash;
mod drawn;
mod fill;
mod geometry;
mod guard;
mod lines;
mod measure;
mod mesh;
mod meshfile;
mod methods;
mod painters;
mod parts;
mod place;
mod preview;
mod raster;
mod running;
mod scan;
mod silhouette;
mod view;

use pyo3::prelude::*;

#[pymodule]
fn _kernel(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(scan::stitched, m)?)?;
    m.add_function(wrap_pyfunction!(scan::components, m)?)?;
    m.add_function(wrap_pyfunction!(scan::edge_table, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::clean_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::needles, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::edge_kinds, m)?)?;
    m.add_function(wrap_pyfunction!(scan::edge_components, m)?)?;
    m.add_function(wrap_pyfunction!(scan::visibility, m)?)?;
    m.add_function(wrap_pyfunction!(clash::clashes, m)?)?;
    m.add_function(wrap_pyfunction!(clash::boxes_meet, m)?)?;
    m.add_function(wrap_pyfunction!(place::projected, m)?)?;
    m.add_function(wrap_pyfunction!(place::placed_boxes, m)?)?;
    m.add_function(wrap_pyfunction!(geometry::curve_points, m)?)?;
    m.add_function(wrap_pyfunction!(geometry::surface_points, m)?)?;
    m.add_class::<drawn::Lines>()?;
    m.add_class::<drawn::Layer>()?;
    m.add_function(wrap_pyfunction!(chains::chain, m)?)?;
    m.add_class::<lines::Camera>()?;
    m.add_class::<chains::Chains>()?;
    m.add_class::<lines::Cut>()?;
    m.add_class::<brep::BrepModel>()?;
    m.add_class::<brep::BrepMesh>()?;
    m.add_class::<parts::PartTables>()?;
    m.add_class::<parts::MeshFacts>()?;
    m.add_class::<parts::MeshScene>()?;
    m.add_class::<preview::ShadedModel>()?;
    m.add_function(wrap_pyfunction!(preview::stroke_picture, m)?)?;
    m.add_function(wrap_pyfunction!(fill::filled_areas, m)?)?;
    m.add_function(wrap_pyfunction!(preview::surface_normals, m)?)?;
    m.add_function(wrap_pyfunction!(painters::quadric_row, m)?)?;
    m.add_class::<raster::RasterScene>()?;
    m.add_function(wrap_pyfunction!(silhouette::silhouettes, m)?)?;
    m.add_function(wrap_pyfunction!(meshfile::read_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(measure::nearest, m)?)?;
    m.add_function(wrap_pyfunction!(measure::blocked, m)?)?;
    m.add_function(wrap_pyfunction!(guard::take_fault, m)?)?;
    m.add_function(wrap_pyfunction!(guard::provoke_fault, m)?)?;
    // Last: what is registered after it is not guarded.
    guard::guard(m)
}
