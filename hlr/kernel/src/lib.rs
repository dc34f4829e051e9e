//! Exact object-space hidden-line removal: module registration only.

pub mod bind;
pub mod clash;
pub mod exact;
pub mod fill;
pub mod ink;
pub mod lines;
pub mod measure;
pub mod memory;
pub mod mesh;
pub mod meshfile;
pub mod paper;
pub mod preview;
pub mod raster;
pub mod scan;
pub mod silhouette;
pub mod stitch;

use pyo3::prelude::*;

#[pymodule]
fn _kernel(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(bind::scan::stitched, m)?)?;
    m.add_function(wrap_pyfunction!(bind::scan::components, m)?)?;
    m.add_function(wrap_pyfunction!(bind::scan::edge_table, m)?)?;
    m.add_function(wrap_pyfunction!(bind::mesh::clean_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(bind::mesh::needles, m)?)?;
    m.add_function(wrap_pyfunction!(bind::mesh::edge_kinds, m)?)?;
    m.add_function(wrap_pyfunction!(bind::scan::edge_components, m)?)?;
    m.add_function(wrap_pyfunction!(bind::scan::visibility, m)?)?;
    m.add_function(wrap_pyfunction!(bind::clash::clashes, m)?)?;
    m.add_function(wrap_pyfunction!(bind::clash::reach, m)?)?;
    m.add_function(wrap_pyfunction!(bind::clash::boxes_meet, m)?)?;
    m.add_function(wrap_pyfunction!(bind::geometry::curve_points, m)?)?;
    m.add_function(wrap_pyfunction!(bind::geometry::surface_points, m)?)?;
    m.add_class::<bind::drawn::Lines>()?;
    m.add_class::<bind::drawn::Layer>()?;
    m.add_function(wrap_pyfunction!(bind::chains::chain, m)?)?;
    m.add_class::<bind::lines::Camera>()?;
    m.add_class::<bind::chains::Chains>()?;
    m.add_class::<bind::lines::Cut>()?;
    m.add_class::<bind::brep::BrepModel>()?;
    m.add_class::<bind::brep::BrepMesh>()?;
    m.add_class::<bind::parts::PartTables>()?;
    m.add_class::<bind::parts::MeshFacts>()?;
    m.add_class::<bind::parts::MeshScene>()?;
    m.add_class::<bind::preview::ShadedModel>()?;
    m.add_function(wrap_pyfunction!(bind::preview::stroke_picture, m)?)?;
    m.add_function(wrap_pyfunction!(bind::fill::filled_areas, m)?)?;
    m.add_function(wrap_pyfunction!(bind::preview::surface_normals, m)?)?;
    m.add_function(wrap_pyfunction!(bind::painters::quadric_row, m)?)?;
    m.add_class::<bind::raster::RasterScene>()?;
    m.add_function(wrap_pyfunction!(bind::silhouette::silhouettes, m)?)?;
    m.add_function(wrap_pyfunction!(bind::meshfile::read_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(bind::measure::nearest, m)?)?;
    m.add_function(wrap_pyfunction!(bind::measure::blocked, m)?)?;
    m.add_function(wrap_pyfunction!(bind::guard::take_fault, m)?)?;
    m.add_function(wrap_pyfunction!(bind::guard::provoke_fault, m)?)?;
    // Last: what is registered after it is not guarded.
    bind::guard::guard(m)
}
