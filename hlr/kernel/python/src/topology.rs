//! Binding of mesh topology: edges, connected components, joined borders.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;

use super::arrays::{expect_below, rows};
use super::threads::run;
use hlr_mesh::stitch;
use hlr_mesh::topology;

type StitchArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>, usize);
type EdgeArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>);

#[pyfunction]
pub fn edge_table<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<EdgeArrays<'py>> {
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), n_points)?;
    let t = run(py, triangles.len(), |_| topology::topology(triangles, n_points))?;
    let n = t.edges.len();
    let edges = t.edges.into_flattened().into_pyarray(py).reshape([n, 2])?;
    Ok((edges, t.offsets.into_pyarray(py), t.incident.into_pyarray(py)))
}

#[pyfunction]
pub fn stitched<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    reach: f64,
) -> PyResult<StitchArrays<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
    let found = py.detach(|| stitch::stitch(points, triangles, reach));
    let n = found.triangles.len();
    let triangles = found.triangles.into_flattened().into_pyarray(py).reshape([n, 3])?;
    Ok((triangles, found.origin.into_pyarray(py), found.seams))
}

#[pyfunction]
pub fn components<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), n_points)?;
    Ok(topology::components(triangles, n_points).into_pyarray(py))
}

#[pyfunction]
pub fn edge_components<'py>(
    py: Python<'py>,
    edges: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let edges = rows::<i32, 2>(&edges, "edges")?;
    expect_below("edges", edges.as_flattened().iter().copied(), n_points)?;
    Ok(topology::components(edges, n_points).into_pyarray(py))
}
