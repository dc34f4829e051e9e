//! `chain`, and the chains of mesh edges that become lines, as Python sees them.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::drawn::kind_of;
use super::guard::caught;
use super::scan::{check_incidence, expect_below, expect_len, flat, rows};
use hlr_linework::lines::chain::{Straight, chain as chain_edges};
use hlr_linework::lines::outlines::{About, Chains as Walks, Surface, add_outlines};

type ChainArrays<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<bool>>);

#[pyfunction]
#[pyo3(signature = (edges, key, points = None, turn = 0.0))]
pub fn chain<'py>(
    py: Python<'py>,
    edges: PyReadonlyArray2<'py, i32>,
    key: PyReadonlyArray1<'py, i32>,
    points: Option<PyReadonlyArray2<'py, f64>>,
    turn: f64,
) -> PyResult<ChainArrays<'py>> {
    let (edges, key) = (rows::<i32, 2>(&edges, "edges")?, flat(&key, "key")?);
    expect_len("key", key.len(), edges.len())?;
    let points = points.as_ref().map(|p| rows::<f64, 3>(p, "points")).transpose()?;
    if let Some(points) = points {
        expect_below("edges", edges.as_flattened().iter().copied(), points.len())?;
    }
    let straight = points.map(|points| Straight { points, turn: turn.to_radians() });
    let c = chain_edges(edges, key, straight.as_ref());
    Ok((c.offsets.into_pyarray(py), c.order.into_pyarray(py), c.reversed.into_pyarray(py)))
}

/// The walks over mesh edges that become lines.
#[pyclass(frozen)]
pub struct Chains(pub(super) Arc<Walks>);

/// Offsets, edges, reversed, kind, part, index, face, other: the chains of a scene.
type SceneChains<'py> = (
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, bool>,
    PyReadonlyArray1<'py, u8>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

/// Edges, their triangles (offsets, incident), their groups, and part and face of each triangle.
type SceneMesh<'py> = (
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

#[pymethods]
impl Chains {
    /// Chains of the source whose class is drawn, then the contours among the edges `found`, which ascend.
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
    fn new(
        py: Python<'_>,
        chains: SceneChains<'_>,
        straight: PyReadonlyArray1<'_, bool>,
        drawn: [bool; 6],
        points: usize,
        mesh: SceneMesh<'_>,
        has_faces: PyReadonlyArray1<'_, bool>,
        groups: usize,
        facing: PyReadonlyArray1<'_, i8>,
        role: PyReadonlyArray1<'_, u8>,
        found: PyReadonlyArray1<'_, i32>,
    ) -> PyResult<Chains> {
        caught(py, || {
            let edges = rows::<i32, 2>(&mesh.0, "edges")?;
            let surface = Surface {
                points,
                edges,
                offsets: flat(&mesh.1, "offsets")?,
                incident: flat(&mesh.2, "incident")?,
                edge_group: flat(&mesh.3, "edge_group")?,
                triangle_part: flat(&mesh.4, "triangle_part")?,
                triangle_face: flat(&mesh.5, "triangle_face")?,
                has_faces: flat(&has_faces, "has_faces")?,
                facing: flat(&facing, "facing")?,
                role: flat(&role, "role")?,
                groups,
            };
            let triangles = surface.triangle_part.len();
            expect_len("triangle_face", surface.triangle_face.len(), triangles)?;
            expect_len("facing", surface.facing.len(), triangles)?;
            expect_len("role", surface.role.len(), edges.len())?;
            expect_len("edge_group", surface.edge_group.len(), edges.len())?;
            expect_below("edges", edges.as_flattened().iter().copied(), points)?;
            expect_below("edge_group", surface.edge_group.iter().copied(), groups)?;
            expect_below("triangle_part", surface.triangle_part.iter().copied(), surface.has_faces.len())?;
            check_incidence(edges.len(), surface.offsets, surface.incident, triangles)?;
            let found = flat(&found, "found")?;
            expect_below("found", found.iter().copied(), edges.len())?;
            let mut out = of_source(&chains, flat(&straight, "straight")?, &drawn, edges.len())?;
            add_outlines(&surface, found, &mut out);
            Ok(Chains(Arc::new(out)))
        })
    }

    #[getter]
    fn offsets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.0.offsets.clone().into_pyarray(py)
    }

    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.0.edges.clone().into_pyarray(py)
    }

    #[getter]
    fn reversed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.0.reversed.clone().into_pyarray(py)
    }

    /// The first mesh edge of each chain.
    #[getter]
    fn first<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        let starts = &self.0.offsets[..self.0.about.len()];
        starts.iter().map(|&i| self.0.edges[i as usize]).collect::<Vec<_>>().into_pyarray(py)
    }

    #[getter]
    fn kind<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        self.column(py, |a| a.kind as u8)
    }

    #[getter]
    fn part<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.column(py, |a| a.part)
    }

    #[getter]
    fn edge<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.column(py, |a| a.edge)
    }

    #[getter]
    fn noisy<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, |a| a.noisy)
    }

    #[getter]
    fn straight<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, |a| a.straight)
    }
}

impl Chains {
    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&About) -> T) -> Bound<'py, PyArray1<T>> {
        self.0.about.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}

fn of_source(c: &SceneChains, straight: &[bool], drawn: &[bool; 6], edges: usize) -> PyResult<Walks> {
    let (offsets, members, reversed) = (flat(&c.0, "offsets")?, flat(&c.1, "edges")?, flat(&c.2, "reversed")?);
    let kind = flat(&c.3, "kind")?;
    let (part, index) = (flat(&c.4, "part")?, flat(&c.5, "index")?);
    let (face, other) = (flat(&c.6, "face")?, flat(&c.7, "other")?);
    for (name, found) in [
        ("part", part.len()),
        ("index", index.len()),
        ("face", face.len()),
        ("other", other.len()),
        ("straight", straight.len()),
    ] {
        expect_len(name, found, kind.len())?;
    }
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_len("reversed", reversed.len(), members.len())?;
    expect_below("edges", members.iter().copied(), edges)?;
    expect_below("offsets", offsets.iter().copied(), members.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] >= w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    let mut out = Walks::new();
    for i in 0..kind.len() {
        // Chains of a kind that was not asked for may still hold contours: those are drawn as outlines instead.
        let kind = kind_of(kind[i])?;
        if drawn[kind as usize] {
            let run = offsets[i] as usize..offsets[i + 1] as usize;
            let about = About {
                kind,
                part: part[i],
                edge: index[i],
                face: face[i],
                other: other[i],
                noisy: false,
                straight: straight[i],
            };
            out.push(&members[run.clone()], &reversed[run], about);
        }
    }
    Ok(out)
}
