//! Binding of `hlr_linework::intersections`: the true curves of intersection lines.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat as slice, rows as table};
use super::curve_columns::CurveColumns;
use super::silhouette::record;
use super::threads::run;
use super::true_surfaces::TrueSurfaces;
use super::view::{Flat, Rows, arrays, flat, rows};
use hlr_linework::intersections::{Crossed, Sheets, curves};

/// Points, segments between them, and the two triangles of each segment.
type Segments<'py> = (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, i32>, PyReadonlyArray2<'py, i32>);

/// Lines over segments: where each begins in `order`, the segments, and which of them are walked backward.
type Lines<'py> = (PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, bool>);

/// The curves of some lines.
#[pyclass(frozen)]
pub struct IntersectionCurves {
    points: Vec<[f64; 3]>,
    number: Vec<i32>,
    rise: Vec<f64>,
    columns: CurveColumns,
}

arrays! { IntersectionCurves {
    points: rows Rows<'py, f64> = |c| &c.points;
    number: flat Flat<'py, i32> = |c| &c.number;
    rise: flat Flat<'py, f64> = |c| &c.rise;
    curve_kind: flat Flat<'py, u8> = |c| &c.columns.kind;
    curve_range: rows Rows<'py, f64> = |c| &c.columns.range;
    curve_offsets: flat Flat<'py, i32> = |c| &c.columns.offsets;
    curve_values: flat Flat<'py, f64> = |c| &c.columns.values;
}
}

/// The true curves of intersection lines.
#[pyfunction]
pub fn intersection_curves<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    on: &TrueSurfaces,
    segments: Segments<'py>,
    lines: Lines<'py>,
    deflection: f64,
) -> PyResult<IntersectionCurves> {
    let places = on.reading(py)?;
    let (triangle_face, corner, uv) = places.slices()?;
    let (points, triangles) = (table::<f64, 3>(&points, "points")?, table::<i32, 3>(&triangles, "triangles")?);
    expect_len("triangle_face", triangle_face.len(), triangles.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    let crossed = Crossed {
        points: table(&segments.0, "points of segments")?,
        segments: table(&segments.1, "segments")?,
        triangles: table(&segments.2, "triangles of segments")?,
        offsets: slice(&lines.0, "offsets")?,
        order: slice(&lines.1, "order")?,
        reversed: slice(&lines.2, "reversed")?,
    };
    expect_len("triangles of segments", crossed.triangles.len(), crossed.segments.len())?;
    expect_below("segments", crossed.segments.iter().flatten().copied(), crossed.points.len())?;
    expect_below("triangles of segments", crossed.triangles.iter().flatten().copied(), triangles.len())?;
    expect_below("order", crossed.order.iter().copied(), crossed.segments.len())?;
    expect_len("reversed", crossed.reversed.len(), crossed.order.len())?;
    expect_below("offsets", crossed.offsets.iter().copied(), crossed.order.len() + 1)?;
    if crossed.offsets.is_empty() || crossed.offsets.windows(2).any(|w| w[0] >= w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    if deflection.is_nan() || deflection <= 0.0 {
        return Err(PyValueError::new_err("deflection must be positive"));
    }
    let faces: Vec<_> = (0..on.number.len()).map(|i| record(on, i)).collect();
    let known = |&t: &usize| faces[triangle_face[t] as usize].surface.is_some();
    expect_below("corner", (0..corner.len()).filter(known).flat_map(|t| corner[t]), uv.len())?;
    let sheets = Sheets { points, triangles, triangle_face, corner, uv, faces, surfaces: on.surfaces(), deflection };
    let (points, found) = run(py, crossed.segments.len(), |stopped| {
        let found = curves(&sheets, &crossed, stopped);
        (!stopped()).then_some(found)
    })?
    .ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    let mut next = 0..;
    let number = found.iter().map(|f| f.as_ref().and_then(|_| next.next()).unwrap_or(-1)).collect();
    let known = || found.iter().flatten();
    Ok(IntersectionCurves {
        points,
        number,
        rise: known().map(|f| f.rise).collect(),
        columns: CurveColumns::of(known().map(|f| Some(&f.curve))),
    })
}
