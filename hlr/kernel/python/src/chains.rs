//! Binding of `chain`, and of the chains of mesh edges that become lines.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, expect_slice_below, flat, rows};
use super::guard::caught;
use super::mesh_input::Mesh;
use super::visibility::Visibility;
use super::visibility_input::VisibilityInput;
use hlr_linework::lines::candidates::{About, Chains as Found, Surface, add_outlines};
use hlr_linework::lines::chain::{Straight, chain as chain_edges};
use hlr_linework::lines::drawing::Kind;

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

/// Walks over mesh edges, some of which become lines.
#[pyclass(frozen)]
pub struct Walks {
    offsets: Vec<i32>,
    edges: Vec<i32>,
    reversed: Vec<bool>,
    about: Vec<About>,
}

#[pymethods]
impl Walks {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        offsets: PyReadonlyArray1<'_, i32>,
        edges: PyReadonlyArray1<'_, i32>,
        reversed: PyReadonlyArray1<'_, bool>,
        kind: PyReadonlyArray1<'_, u8>,
        part: PyReadonlyArray1<'_, i32>,
        index: PyReadonlyArray1<'_, i32>,
        face: PyReadonlyArray1<'_, i32>,
        other: PyReadonlyArray1<'_, i32>,
        straight: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<Walks> {
        caught(py, || {
            let (offsets, edges) = (flat(&offsets, "offsets")?, flat(&edges, "edges")?);
            let reversed = flat(&reversed, "reversed")?;
            let kind = flat(&kind, "kind")?;
            let (part, index) = (flat(&part, "part")?, flat(&index, "index")?);
            let (face, other) = (flat(&face, "face")?, flat(&other, "other")?);
            let straight = flat(&straight, "straight")?;
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
            expect_len("reversed", reversed.len(), edges.len())?;
            expect_below("offsets", offsets.iter().copied(), edges.len() + 1)?;
            if offsets.windows(2).any(|w| w[0] >= w[1]) {
                return Err(PyValueError::new_err("offsets must ascend"));
            }
            let about = |i: usize| About {
                kind: Kind(kind[i]),
                part: part[i],
                edge: index[i],
                face: face[i],
                other: other[i],
                noisy: false,
                straight: straight[i],
            };
            Ok(Walks {
                offsets: offsets.to_vec(),
                edges: edges.to_vec(),
                reversed: reversed.to_vec(),
                about: (0..kind.len()).map(about).collect(),
            })
        })
    }
}

impl Walks {
    /// The chains whose class is drawn.
    fn chosen(&self, drawn: &[bool]) -> Found {
        let mut out = Found::new();
        for (about, w) in self.about.iter().zip(self.offsets.windows(2)) {
            // Chains of a class that is not drawn may still hold contours: those are drawn as outlines instead.
            if drawn[about.kind.0 as usize] {
                let run = w[0] as usize..w[1] as usize;
                out.push(&self.edges[run.clone()], &self.reversed[run], *about);
            }
        }
        out
    }
}

/// The walks over mesh edges that become lines.
#[pyclass(frozen)]
pub struct Chains(pub(super) Arc<Found>);

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
            expect_below("edges of walks", walks.edges.iter().copied(), edges.len())?;
            expect_below("classes of walks", walks.about.iter().map(|a| i32::from(a.kind.0)), input.drawn.len())?;
            let mut out = walks.chosen(&input.drawn);
            add_outlines(&surface, &found.edge, &mut out);
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
}

impl Chains {
    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&About) -> T) -> Bound<'py, PyArray1<T>> {
        self.0.about.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}
