//! Binding of `chain`, and of the chains of mesh edges that become lines.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, expect_slice_below, flat, rows};
use super::guard::caught;
use super::mesh_input::Mesh;
use super::visibility::Visibility;
use super::visibility_input::VisibilityInput;
use super::walks::Walks;
use hlr_linework::lines::candidates::{About, Chains as Found, Surface, add_outlines};
use hlr_linework::lines::chain::{Straight, chain as chain_edges};
use hlr_linework::lines::drawing::Kind;
use hlr_mesh::walks::Walks as Columns;

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

/// The walks whose class is drawn.
fn chosen(walks: &Columns, drawn: &[bool]) -> Found {
    let mut out = Found::new();
    for walk in 0..walks.len() {
        let run = walks.run(walk);
        // Walks of a class that is not drawn may still hold contours: those are drawn as outlines instead.
        if drawn[usize::from(walks.kind[walk])] && !run.is_empty() {
            let about = About {
                kind: Kind(walks.kind[walk]),
                part: walks.part[walk],
                edge: walks.index[walk],
                face: walks.face[walk],
                other: walks.other[walk],
                noisy: false,
                straight: walks.straight[walk],
                shallow: walks.shallow[walk],
            };
            out.push(&walks.edges[run.clone()], &walks.reversed[run], about);
        }
    }
    out
}

/// The walks over mesh edges that become lines.
#[pyclass(frozen)]
pub struct Chains {
    pub(super) found: Arc<Found>,
    /// Per part: it has faces of a B-rep.
    pub(super) has_faces: Vec<bool>,
}

#[pymethods]
impl Chains {
    /// Walks of the source whose class is drawn, then the contours among the edges that have pieces.
    #[new]
    #[allow(clippy::too_many_arguments)] // four objects, and columns of triangles and parts
    fn new(
        py: Python<'_>,
        walks: &Walks,
        input: &VisibilityInput,
        mesh: &Mesh,
        triangle_part: PyReadonlyArray1<'_, i32>,
        triangle_face: PyReadonlyArray1<'_, i32>,
        has_faces: PyReadonlyArray1<'_, bool>,
        found: &Visibility,
    ) -> PyResult<Chains> {
        caught(py, || {
            let (reading, of) = (mesh.reading(py)?, input.reading(py)?);
            let all = reading.slices()?;
            let (edges, triangles) = (all.edges, all.triangles.len());
            let surface = Surface {
                points: all.points.len(),
                edges,
                offsets: all.offsets,
                incident: all.incident,
                edge_group: flat(&of.1, "edge")?,
                triangle_part: flat(&triangle_part, "triangle_part")?,
                triangle_face: flat(&triangle_face, "triangle_face")?,
                has_faces: flat(&has_faces, "has_faces")?,
                facing: &found.facing,
                role: &input.role,
                groups: input.groups(true).len(),
            };
            expect_len("triangle_part", surface.triangle_part.len(), triangles)?;
            expect_len("triangle_face", surface.triangle_face.len(), triangles)?;
            expect_len("facing", surface.facing.len(), triangles)?;
            expect_len("role", surface.role.len(), edges.len())?;
            expect_len("groups of edges", surface.edge_group.len(), edges.len())?;
            expect_slice_below("triangle_part", surface.triangle_part, surface.has_faces.len())?;
            expect_below("found", found.edge.iter().copied(), edges.len())?;
            walks.expect_edges(edges.len())?;
            expect_below("classes of walks", walks.0.kind.iter().map(|&kind| i32::from(kind)), input.drawn.len())?;
            let mut out = chosen(&walks.0, &input.drawn);
            add_outlines(&surface, &found.edge, &mut out);
            Ok(Chains { found: Arc::new(out), has_faces: surface.has_faces.to_vec() })
        })
    }

    #[getter]
    fn offsets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.found.offsets.clone().into_pyarray(py)
    }

    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.found.edges.clone().into_pyarray(py)
    }

    #[getter]
    fn reversed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.found.reversed.clone().into_pyarray(py)
    }

    /// The first mesh edge of each chain.
    #[getter]
    fn first<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        let starts = &self.found.offsets[..self.found.about.len()];
        starts.iter().map(|&i| self.found.edges[i as usize]).collect::<Vec<_>>().into_pyarray(py)
    }

    #[getter]
    fn kind<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        self.column(py, |a| a.kind.0)
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
    fn straight<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, |a| a.straight)
    }

    /// Whether all chains along edges of the source are straight.
    #[getter]
    fn all_straight(&self) -> bool {
        self.found.about.iter().all(|a| a.straight || a.edge < 0)
    }
}

impl Chains {
    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&About) -> T) -> Bound<'py, PyArray1<T>> {
        self.found.about.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}
