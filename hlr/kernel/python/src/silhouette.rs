//! Binding of `hlr_linework::silhouette`: outlines of true surfaces.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, expect_slice_below, flat as slice, rows as table};
use super::camera::Camera;
use super::curve_columns::CurveColumns;
use super::mesh_input::Mesh;
use super::threads::run;
use super::true_surfaces::TrueSurfaces;
use super::view::{Flat, Rows, arrays, flat, rows};
use super::walks::Walks;
use hlr_linework::silhouette::grazing::Grazing;
use hlr_linework::silhouette::sought::traced_faces as sought;
use hlr_linework::silhouette::trace::{Silhouette, Traced, trace};
use hlr_linework::silhouette::{FaceRecord, Model};

/// (f,) faces on which outlines are sought.
#[pyfunction]
pub fn traced_faces<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    face: PyReadonlyArray1<'py, i32>,
    kind: PyReadonlyArray1<'py, u8>,
    tangent: PyReadonlyArray1<'py, bool>,
    curved: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let reading = mesh.reading(py)?;
    let all = reading.slices()?;
    let (face, curved) = (slice(&face, "face")?, slice(&curved, "curved")?);
    let (kind, tangent) = (slice(&kind, "kind")?, slice(&tangent, "tangent")?);
    expect_len("face", face.len(), all.triangles.len())?;
    expect_slice_below("face", face, curved.len())?;
    expect_len("kind", kind.len(), all.edges.len())?;
    let of_edge = |edge: usize| tangent.get(usize::from(kind[edge])) == Some(&true);
    Ok(sought(curved, face, all.offsets, all.incident, of_edge).into_pyarray(py))
}

/// Outlines: the curves on true surfaces along which they are seen edge-on. And borders of faces that are nearly
/// edge-on.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // classes of edges, walks, and what they are about
pub fn silhouettes<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    on: &TrueSurfaces,
    kind: PyReadonlyArray1<'py, u8>,
    goes_on: PyReadonlyArray1<'py, bool>,
    crossed: PyReadonlyArray2<'py, i32>,
    walks: &Walks,
    camera: &Camera,
    chord: f64,
) -> PyResult<Outlines> {
    let (reading, places) = (mesh.reading(py)?, on.reading(py)?);
    let all = reading.slices()?;
    let (triangle_face, corner, uv) = places.slices()?;
    let (kind, goes_on) = (slice(&kind, "kind")?, slice(&goes_on, "goes_on")?);
    expect_len("triangle_face", triangle_face.len(), all.triangles.len())?;
    expect_len("kind", kind.len(), all.edges.len())?;
    let smooth: Vec<bool> = kind.iter().map(|&kind| goes_on.get(usize::from(kind)) == Some(&true)).collect();
    let crossed = table::<i32, 2>(&crossed, "crossed")?;
    if crossed.len() > all.edges.len() {
        return Err(PyValueError::new_err("crossed has more entries than there are edges"));
    }
    expect_below("crossed", crossed.iter().flatten().copied(), all.triangles.len())?;
    walks.expect_edges(all.edges.len())?;
    let source = walks.0.along_source(all.edges.len());
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
        crossed,
        smooth: &smooth,
        source: &source,
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
