//! Binding of the meshes of parts.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::arrays::{expect_below, expect_len, flat as slice, rows as table};
use super::guard::caught;
use super::mesh_scene::MeshFacts;
use super::threads::{AT_ONCE, CHEAP, release_later, run};
use super::view::{Flat, Rows, arrays, flat, matrices, rows};
use hlr_brep::format::Matrix;
use hlr_mesh::facts::Facts;
use hlr_mesh::placed::Placed;
use hlr_mesh::repeats::Repeat;
use hlr_mesh::tables::{Tables, TooMany};

fn too_many(_: TooMany) -> PyErr {
    PyValueError::new_err("more than 2^31 items in one mesh")
}

/// Parts (m,), the parts that they repeat (m,), and how far they are apart (m,).
type Repeats<'py> = (Flat<'py, i32>, Flat<'py, i32>, Flat<'py, f64>);

/// The meshes of all parts, one after another.
#[pyclass(frozen)]
pub struct PartTables(pub Arc<Tables>);

impl Drop for PartTables {
    fn drop(&mut self) {
        release_later(self.0.clone(), self.0.triangles.len() / AT_ONCE);
    }
}

arrays! { PartTables {
    point_start: flat Flat<'py, i32> = |t| &t.0.point_start;
    points: rows Rows<'py, f64> = |t| &t.0.points;
    triangle_start: flat Flat<'py, i32> = |t| &t.0.triangle_start;
    triangles: rows Rows<'py, i32> = |t| &t.0.triangles;
    triangle_face: flat Flat<'py, i32> = |t| &t.0.triangle_face;
    origin: flat Flat<'py, i32> = |t| &t.0.origin;
    face_start: flat Flat<'py, i32> = |t| &t.0.face_start;
    face_planar: flat Flat<'py, bool> = |t| &t.0.face_planar;
    edge_start: flat Flat<'py, i32> = |t| &t.0.edge_start;
    edge_offsets: flat Flat<'py, i32> = |t| &t.0.edge_offsets;
    edge_nodes: flat Flat<'py, i32> = |t| &t.0.edge_nodes;
    edge_index: flat Flat<'py, i32> = |t| &t.0.edge_index;
    edge_class: flat Flat<'py, u8> = |t| &t.0.edge_class;
    brep: flat Flat<'py, bool> = |t| &t.0.brep;
    joined: flat Flat<'py, bool> = |t| &t.0.joined;
    transform: matrices Bound<'py, PyArray3<f64>> = |t| &t.0.transform;
    precision: flat Flat<'py, f64> = |t| &t.0.precision;
    node_start: flat Flat<'py, i32> = |t| &t.0.node_start;
    corner: rows Rows<'py, i32> = |t| &t.0.corner;
    uv: rows Rows<'py, f64> = |t| &t.0.uv;
    face_shape: flat Flat<'py, i32> = |t| &t.0.face_shape;
    face_place: matrices Bound<'py, PyArray3<f64>> = |t| &t.0.face_place;
    face_reversed: flat Flat<'py, bool> = |t| &t.0.face_reversed;
}

    #[new]
    #[pyo3(signature = (*, point_start, points, triangle_start, triangles, triangle_face, origin, face_start, face_planar, edge_start, edge_offsets, edge_nodes, edge_index, edge_class, brep, joined, transform, precision, node_start, corner, uv, face_shape, face_place, face_reversed))]
    #[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
    fn new(
        py: Python<'_>,
        point_start: PyReadonlyArray1<'_, i32>,
        points: PyReadonlyArray2<'_, f64>,
        triangle_start: PyReadonlyArray1<'_, i32>,
        triangles: PyReadonlyArray2<'_, i32>,
        triangle_face: PyReadonlyArray1<'_, i32>,
        origin: Option<PyReadonlyArray1<'_, i32>>,
        face_start: PyReadonlyArray1<'_, i32>,
        face_planar: PyReadonlyArray1<'_, bool>,
        edge_start: PyReadonlyArray1<'_, i32>,
        edge_offsets: PyReadonlyArray1<'_, i32>,
        edge_nodes: PyReadonlyArray1<'_, i32>,
        edge_index: PyReadonlyArray1<'_, i32>,
        edge_class: PyReadonlyArray1<'_, u8>,
        brep: PyReadonlyArray1<'_, bool>,
        joined: PyReadonlyArray1<'_, bool>,
        transform: PyReadonlyArray3<'_, f64>,
        precision: PyReadonlyArray1<'_, f64>,
        node_start: PyReadonlyArray1<'_, i32>,
        corner: PyReadonlyArray2<'_, i32>,
        uv: PyReadonlyArray2<'_, f64>,
        face_shape: PyReadonlyArray1<'_, i32>,
        face_place: PyReadonlyArray3<'_, f64>,
        face_reversed: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<PartTables> {
        caught(py, || {
            let brep = slice(&brep, "brep")?.to_vec();
            let (points, triangles) = (table::<f64, 3>(&points, "points")?, table::<i32, 3>(&triangles, "triangles")?);
            let planar = slice(&face_planar, "face_planar")?.to_vec();
            let index = slice(&edge_index, "edge_index")?;
            let (corner, uv) = (table::<i32, 3>(&corner, "corner")?, table::<f64, 2>(&uv, "uv")?);
            let nodes = slice(&edge_nodes, "edge_nodes")?;
            let triangle_face = slice(&triangle_face, "triangle_face")?;
            let origin = origin.as_ref().map(|origin| slice(origin, "origin")).transpose()?;
            let (n, t, f) = (brep.len(), triangles.len(), planar.len());
            let triangle_start = starts(&triangle_start, "triangle_start", n, t)?;
            let large = run(py, (t + points.len()) / CHEAP, |_| Large {
                points: copied(points),
                triangles: copied(triangles),
                triangle_face: copied(triangle_face),
                origin: origin.map_or_else(|| counted(&triangle_start), copied),
            })?;
            let tables = Tables {
                point_start: starts(&point_start, "point_start", n, points.len())?,
                triangle_start,
                face_start: starts(&face_start, "face_start", n, f)?,
                edge_start: starts(&edge_start, "edge_start", n, index.len())?,
                node_start: starts(&node_start, "node_start", n, uv.len())?,
                edge_offsets: starts(&edge_offsets, "edge_offsets", index.len(), nodes.len())?,
                points: large.points,
                triangles: large.triangles,
                triangle_face: large.triangle_face,
                origin: large.origin,
                edge_nodes: nodes.to_vec(),
                edge_index: index.to_vec(),
                edge_class: slice(&edge_class, "edge_class")?.to_vec(),
                joined: slice(&joined, "joined")?.to_vec(),
                transform: to_matrices(&transform, "transform", n)?,
                precision: slice(&precision, "precision")?.to_vec(),
                corner: corner.to_vec(),
                uv: uv.to_vec(),
                face_shape: slice(&face_shape, "face_shape")?.to_vec(),
                face_place: to_matrices(&face_place, "face_place", f)?,
                face_reversed: slice(&face_reversed, "face_reversed")?.to_vec(),
                face_planar: planar,
                brep,
            };
            if t > (i32::MAX / 3) as usize {
                return Err(too_many(TooMany));
            }
            expect_len("triangle_face", tables.triangle_face.len(), t)?;
            expect_len("origin", tables.origin.len(), t)?;
            if !(corner.is_empty() && uv.is_empty()) {
                expect_len("corner", corner.len(), t)?;
            }
            expect_len("edge_class", tables.edge_class.len(), index.len())?;
            expect_len("joined", tables.joined.len(), n)?;
            expect_len("precision", tables.precision.len(), n)?;
            expect_len("face_shape", tables.face_shape.len(), f)?;
            expect_len("face_reversed", tables.face_reversed.len(), f)?;
            expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
            expect_below("edge_nodes", nodes.iter().copied(), points.len())?;
            expect_below("corner + 1", corner.iter().flatten().map(|c| c.saturating_add(1)), uv.len() + 1)?;
            for p in 0..n {
                let own = tables.triangle_start[p] as usize..tables.triangle_start[p + 1] as usize;
                let faces = (tables.face_start[p + 1] - tables.face_start[p]) as usize;
                expect_below("triangle_face", tables.triangle_face[own].iter().copied(), faces)?;
            }
            Ok(PartTables(Arc::new(tables)))
        })
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// These parts, each at its placement.
    fn placed(
        &self,
        py: Python<'_>,
        part: PyReadonlyArray1<'_, i32>,
        transform: PyReadonlyArray3<'_, f64>,
        precision: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<PartTables> {
        let (part, precision) = (slice(&part, "part")?, slice(&precision, "precision")?);
        expect_below("part", part.iter().copied(), self.0.len())?;
        expect_len("precision", precision.len(), part.len())?;
        let transform = to_matrices(&transform, "transform", part.len())?;
        let placed: Vec<Placed> = part
            .iter()
            .zip(transform)
            .zip(precision)
            .map(|((&part, transform), &precision)| Placed { part: part as usize, transform, precision })
            .collect();
        if self.0.are_all(&placed) {
            return Ok(PartTables(self.0.clone()));
        }
        let start = &self.0.triangle_start;
        let triangles: usize = part.iter().map(|&p| (start[p as usize + 1] - start[p as usize]) as usize).sum();
        let found = run(py, triangles / CHEAP, |_| self.0.placed(&placed))?.map_err(too_many)?;
        Ok(PartTables(Arc::new(found)))
    }

    /// These parts with the chosen triangles alone, and with other points as nodes of the edges.
    fn with_triangles(
        &self,
        py: Python<'_>,
        chosen: PyReadonlyArray1<'_, bool>,
        edge_nodes: PyReadonlyArray1<'_, i32>,
    ) -> PyResult<PartTables> {
        let (chosen, nodes) = (slice(&chosen, "chosen")?, slice(&edge_nodes, "edge_nodes")?);
        expect_len("chosen", chosen.len(), self.0.triangles.len())?;
        expect_len("edge_nodes", nodes.len(), self.0.edge_nodes.len())?;
        expect_below("edge_nodes", nodes.iter().copied(), self.0.points.len())?;
        Ok(PartTables(Arc::new(py.detach(|| self.0.with_triangles(chosen, nodes)))))
    }

    /// The parts that repeat an earlier one, with no point farther away than `near`; which they repeat, and how far they
    /// are apart.
    fn repeats<'py>(&self, py: Python<'py>, near: f64) -> PyResult<Repeats<'py>> {
        let found = run(py, self.0.points.len() / CHEAP, |_| self.0.repeats(near))?;
        let column = |of: fn(&Repeat) -> i32| found.iter().map(of).collect::<Vec<i32>>().into_pyarray(py);
        let apart: Vec<f64> = found.iter().map(|repeat| repeat.apart).collect();
        Ok((column(|repeat| repeat.part), column(|repeat| repeat.of), apart.into_pyarray(py)))
    }

    /// These parts without the triangles and edges of the chosen ones.
    fn without_meshes(&self, py: Python<'_>, chosen: PyReadonlyArray1<'_, bool>) -> PyResult<PartTables> {
        let chosen = slice(&chosen, "chosen")?;
        expect_len("chosen", chosen.len(), self.0.len())?;
        Ok(PartTables(Arc::new(py.detach(|| self.0.without_meshes(chosen)))))
    }

    /// How many parts have a B-rep.
    #[getter]
    fn brep_parts(&self) -> usize {
        self.0.brep.iter().filter(|&&brep| brep).count()
    }

    /// How many faces are planar.
    #[getter]
    fn planar_faces(&self) -> usize {
        self.0.face_planar.iter().filter(|&&planar| planar).count()
    }

    /// The fewest triangles that one of these parts has, and how many all have together; without parts 0.
    fn triangle_counts(&self, part: PyReadonlyArray1<'_, i32>) -> PyResult<(usize, usize)> {
        let part = slice(&part, "part")?;
        expect_below("part", part.iter().copied(), self.0.len())?;
        let start = &self.0.triangle_start;
        let counts = || part.iter().map(|&p| (start[p as usize + 1] - start[p as usize]) as usize);
        Ok((counts().min().unwrap_or(0), counts().sum()))
    }

    /// Whether all coordinates are finite and nearer to the origin than this.
    fn within(&self, largest: f64) -> bool {
        self.0.within(largest)
    }

    /// (p,) whether each part's points are not joined and two of its triangles, turned the same way, may lie in one
    /// place; always true where they do.
    fn triangles_in_one_place(&self, py: Python<'_>) -> PyResult<Vec<bool>> {
        run(py, self.0.points.len() / CHEAP, |_| self.0.triangles_in_one_place())
    }

    /// Edges, and the properties of the mesh that need no part or class of edge.
    fn facts(&self, py: Python<'_>) -> PyResult<MeshFacts> {
        let tables = &self.0;
        let facts = run(py, tables.triangles.len() / CHEAP, |_| Facts::of(&tables.points, &tables.triangles))?;
        Ok(MeshFacts::of(tables.clone(), Arc::new(facts)))
    }
}

pub(super) fn to_matrices(array: &PyReadonlyArray3<'_, f64>, name: &str, count: usize) -> PyResult<Vec<Matrix>> {
    let wrong = || PyValueError::new_err(format!("{name} must be a C-contiguous ({count}, 3, 4) array"));
    let flat = array.as_slice().map_err(|_| wrong())?;
    if array.as_array().shape() != [count, 3, 4] || !array.as_array().is_standard_layout() {
        return Err(wrong());
    }
    Ok(flat.as_chunks::<4>().0.as_chunks::<3>().0.to_vec())
}

/// The columns that are copied on all cores.
struct Large {
    points: Vec<[f64; 3]>,
    triangles: Vec<[i32; 3]>,
    triangle_face: Vec<i32>,
    origin: Vec<i32>,
}

/// Items that one thread copies at a time.
const COPIED: usize = 1 << 16;

fn copied<T: Copy + Send + Sync>(items: &[T]) -> Vec<T> {
    items.par_iter().with_min_len(COPIED).copied().collect()
}

/// The numbers of the items of each owner, from 0; `start`: the first item of each, then the number of items.
fn counted(start: &[i32]) -> Vec<i32> {
    let mut out = Vec::with_capacity(start.last().map_or(0, |&n| n as usize));
    for w in start.windows(2) {
        out.par_extend((0..w[1] - w[0]).into_par_iter().with_min_len(COPIED));
    }
    out
}

/// Starts of the parts, checked: ascending, up to `count` items.
fn starts(array: &PyReadonlyArray1<'_, i32>, name: &str, parts: usize, count: usize) -> PyResult<Vec<i32>> {
    let start = slice(array, name)?;
    expect_len(name, start.len(), parts + 1)?;
    if start[0] != 0 || start[parts] as usize != count || start.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err(format!("{name} must ascend from 0 to {count}")));
    }
    Ok(start.to_vec())
}
