//! A mesh with its edges, and the groups of its triangles: checked once, used by several calls.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::arrays::{check_incidence, expect_slice_below, flat, rows};
use super::guard::caught;

/// Triangles and edges, and the triangles at each edge. The arrays remain the caller's.
#[pyclass(frozen)]
pub struct Mesh {
    points: Py<PyArray2<f64>>,
    triangles: Py<PyArray2<i32>>,
    edges: Py<PyArray2<i32>>,
    offsets: Py<PyArray1<i32>>,
    incident: Py<PyArray1<i32>>,
}

/// Borrows of a mesh's arrays while they are read.
pub struct Reading<'py> {
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    edges: PyReadonlyArray2<'py, i32>,
    offsets: PyReadonlyArray1<'py, i32>,
    incident: PyReadonlyArray1<'py, i32>,
}

/// The same arrays as slices.
pub struct Slices<'a> {
    pub points: &'a [[f64; 3]],
    pub triangles: &'a [[i32; 3]],
    pub edges: &'a [[i32; 2]],
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
}

#[pymethods]
impl Mesh {
    #[new]
    fn new(
        py: Python<'_>,
        points: Py<PyArray2<f64>>,
        triangles: Py<PyArray2<i32>>,
        edges: Py<PyArray2<i32>>,
        offsets: Py<PyArray1<i32>>,
        incident: Py<PyArray1<i32>>,
    ) -> PyResult<Mesh> {
        caught(py, || {
            let mesh = Mesh { points, triangles, edges, offsets, incident };
            let reading = mesh.reading(py)?;
            let all = reading.slices()?;
            expect_slice_below("triangles", all.triangles.as_flattened(), all.points.len())?;
            expect_slice_below("edges", all.edges.as_flattened(), all.points.len())?;
            check_incidence(all.edges.len(), all.offsets, all.incident, all.triangles.len())?;
            Ok(mesh)
        })
    }
}

impl Mesh {
    pub fn reading<'py>(&self, py: Python<'py>) -> PyResult<Reading<'py>> {
        Ok(Reading {
            points: self.points.bind(py).try_readonly()?,
            triangles: self.triangles.bind(py).try_readonly()?,
            edges: self.edges.bind(py).try_readonly()?,
            offsets: self.offsets.bind(py).try_readonly()?,
            incident: self.incident.bind(py).try_readonly()?,
        })
    }
}

impl Reading<'_> {
    pub fn slices(&self) -> PyResult<Slices<'_>> {
        Ok(Slices {
            points: rows(&self.points, "points")?,
            triangles: rows(&self.triangles, "triangles")?,
            edges: rows(&self.edges, "edges")?,
            offsets: flat(&self.offsets, "offsets")?,
            incident: flat(&self.incident, "incident")?,
        })
    }
}
