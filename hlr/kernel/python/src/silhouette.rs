//! Binding of `hlr_linework::silhouette`: outlines of true surfaces.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat as slice};
use super::camera::Camera;
use super::curve_columns::CurveColumns;
use super::mesh_input::Mesh;
use super::threads::run;
use super::true_surfaces::TrueSurfaces;
use super::view::{Flat, Rows, arrays, flat, rows};
use hlr_linework::silhouette::grazing::Grazing;
use hlr_linework::silhouette::trace::{Silhouette, Traced, trace};
use hlr_linework::silhouette::{FaceRecord, Model};

/// Outlines: the curves on true surfaces along which they are seen edge-on. And borders of faces that are nearly
/// edge-on.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // two arrays, and what they are about
pub fn silhouettes<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    on: &TrueSurfaces,
    smooth: PyReadonlyArray1<'py, bool>,
    source: PyReadonlyArray1<'py, i32>,
    camera: &Camera,
    chord: f64,
) -> PyResult<Outlines> {
    let (reading, places) = (mesh.reading(py)?, on.reading(py)?);
    let all = reading.slices()?;
    let (triangle_face, corner, uv) = places.slices()?;
    let (smooth, source) = (slice(&smooth, "smooth")?, slice(&source, "source")?);
    expect_len("triangle_face", triangle_face.len(), all.triangles.len())?;
    expect_len("smooth", smooth.len(), all.edges.len())?;
    expect_len("source", source.len(), all.edges.len())?;
    if chord.is_nan() || chord <= 0.0 {
        return Err(PyValueError::new_err("chord must be positive"));
    }
    let faces: Vec<FaceRecord> = (0..on.number.len()).map(|i| record(on, i)).collect();
    let traced: Vec<bool> = faces.iter().map(|f| f.surface.is_some()).collect();
    let known = (0..corner.len()).filter(|&t| traced[triangle_face[t] as usize]);
    expect_below("corner", known.flat_map(|t| corner[t]), uv.len())?;
    let model = Model {
        points: all.points,
        triangles: all.triangles,
        triangle_face,
        edges: all.edges,
        offsets: all.offsets,
        incident: all.incident,
        smooth,
        source,
        corner,
        uv,
        faces,
        surfaces: on.surfaces(),
        view: camera.0.view(),
        chord,
    };
    let Traced { silhouettes, grazing } = run(py, model.triangles.len(), |stopped| trace(&model, stopped))?
        .ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    Ok(Outlines {
        columns: CurveColumns::of(silhouettes.iter().map(|s| s.curve.as_ref())),
        lines: silhouettes,
        grazing,
        traced,
    })
}

/// A face as the kernel takes it.
pub(super) fn record(on: &TrueSurfaces, face: usize) -> FaceRecord {
    let m = &on.place[face];
    let row = |k: usize| [m[4 * k], m[4 * k + 1], m[4 * k + 2], m[4 * k + 3]];
    FaceRecord {
        surface: on.surface(face as i32),
        place: [row(0), row(1), row(2)],
        sign: if on.inward[face] { -1.0 } else { 1.0 },
        curved: on.curved[face],
    }
}

/// Outlines one after another.
#[pyclass(frozen)]
pub struct Outlines {
    pub(super) lines: Vec<Silhouette>,
    columns: CurveColumns,
    pub(super) grazing: Vec<Grazing>,
    pub(super) traced: Vec<bool>,
}

arrays! { Outlines {
    curve_kind: flat Flat<'py, u8> = |o| &o.columns.kind;
    curve_range: rows Rows<'py, f64> = |o| &o.columns.range;
    curve_offsets: flat Flat<'py, i32> = |o| &o.columns.offsets;
    curve_values: flat Flat<'py, f64> = |o| &o.columns.values;
}

    fn __len__(&self) -> usize {
        self.lines.len()
    }

    #[getter]
    fn source<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.lines.iter().map(|s| s.source).collect::<Vec<_>>().into_pyarray(py)
    }
}
