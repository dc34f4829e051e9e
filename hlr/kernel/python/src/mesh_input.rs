//! A mesh with its edges, and the groups of its triangles: checked once, used by several calls.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::arrays::{check_incidence, expect_len, expect_slice_below, flat, rows};
use super::guard::caught;
use hlr_visibility::scan::scene::Group;

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

/// The group of each triangle and of each edge, and what may be assumed of each group.
#[pyclass(frozen)]
pub struct Groups {
    triangle: Py<PyArray1<i32>>,
    edge: Py<PyArray1<i32>>,
    pub groups: Vec<Group>,
}

#[pymethods]
impl Groups {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        triangle: Py<PyArray1<i32>>,
        edge: Py<PyArray1<i32>>,
        cull: PyReadonlyArray1<'_, bool>,
        sound: PyReadonlyArray1<'_, bool>,
        delta: PyReadonlyArray1<'_, f64>,
        cap: PyReadonlyArray1<'_, f64>,
        tight: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<Groups> {
        caught(py, || {
            let (cull, sound, tight) = (flat(&cull, "cull")?, flat(&sound, "sound")?, flat(&tight, "tight")?);
            let (delta, cap) = (flat(&delta, "delta")?, flat(&cap, "cap")?);
            for (name, found) in
                [("sound", sound.len()), ("delta", delta.len()), ("cap", cap.len()), ("tight", tight.len())]
            {
                expect_len(name, found, cull.len())?;
            }
            let group =
                |g: usize| Group { cull: cull[g], sound: sound[g], delta: delta[g], cap: cap[g], tight: tight[g] };
            let groups = Groups { triangle, edge, groups: (0..cull.len()).map(group).collect() };
            let (triangle, edge) = groups.reading(py)?;
            expect_slice_below("group of triangles", flat(&triangle, "triangle")?, cull.len())?;
            expect_slice_below("group of edges", flat(&edge, "edge")?, cull.len())?;
            Ok(groups)
        })
    }
}

impl Groups {
    /// Groups of triangles, and of edges.
    pub fn reading<'py>(&self, py: Python<'py>) -> PyResult<(PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, i32>)> {
        Ok((self.triangle.bind(py).try_readonly()?, self.edge.bind(py).try_readonly()?))
    }
}
