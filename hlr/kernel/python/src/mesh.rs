//! Binding of mesh cleaning, needles and edge classes.

use numpy::{IntoPyArray, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_len, expect_slice_below, flat, rows, table};
use super::threads::run;
use super::view::{Flat, Rows};
use hlr_mesh::clean::clean;
use hlr_mesh::edge_flips::without_needles as turned;
use hlr_mesh::needles::needles as low_ones;

type Cleaned<'py> = (Rows<'py, f64>, Rows<'py, i32>, Option<Flat<'py, u32>>, (usize, usize, usize));

/// Points, equal ones joined; triangles without invalid ones; which triangles were kept; and how many were left out as
/// not finite, out of range, or degenerate.
#[pyfunction]
pub fn clean_mesh<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
) -> PyResult<Cleaned<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    if points.len() > i32::MAX as usize - 2 {
        return Err(PyValueError::new_err("there are too many points"));
    }
    let found = run(py, triangles.len(), |_| clean(points, triangles))?;
    let left_out = (found.not_finite, found.out_of_range, found.degenerate);
    let kept = found.kept.map(|kept| kept.into_pyarray(py));
    Ok((table(py, found.points)?, table(py, found.triangles)?, kept, left_out))
}

type Turned<'py> = (Flat<'py, u32>, Rows<'py, i32>, Flat<'py, u32>, Rows<'py, u32>);

/// Edge flips that remove needles: which triangles changed, their corners, the triangle whose face each has now, and
/// where each corner was before. None where there are no needles.
#[pyfunction]
pub fn without_needles<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    low: f64,
) -> PyResult<Option<Turned<'py>>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    expect_slice_below("triangles", triangles.as_flattened(), points.len())?;
    let found = run(py, triangles.len(), |_| turned(points, triangles, low))?;
    if found.triangle.is_empty() {
        return Ok(None);
    }
    let (triangle, like) = (found.triangle.into_pyarray(py), found.like.into_pyarray(py));
    Ok(Some((triangle, table(py, found.corners)?, like, table(py, found.stood)?)))
}

/// Which triangles are lower than their part's `least`, or have no area; and the numbers of their longest sides.
#[pyfunction]
pub fn needles<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    normals: PyReadonlyArray2<'py, f64>,
    part: PyReadonlyArray1<'py, i32>,
    least: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Flat<'py, i64>, Flat<'py, i64>)> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let (normals, part, least) = (rows::<f64, 3>(&normals, "normals")?, flat(&part, "part")?, flat(&least, "least")?);
    expect_len("normals", normals.len(), triangles.len())?;
    expect_len("part", part.len(), triangles.len())?;
    expect_slice_below("part", part, least.len())?;
    expect_slice_below("triangles", triangles.as_flattened(), points.len())?;
    let found = run(py, triangles.len(), |_| low_ones(points, triangles, normals, &|t| least[part[t] as usize]))?;
    Ok((found.0.into_pyarray(py), found.1.into_pyarray(py)))
}
