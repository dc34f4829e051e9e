//! Binding of `hlr_mesh::boxes`: bounding boxes of placed parts.

use numpy::{IntoPyArray, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, table};
use hlr_mesh::boxes::placed;

/// Corners (p, 8, 3) and the box (2, 3) around them.
type PlacedBoxes<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>);

/// The corners of boxes (r, 2, 3): for each part the box of its root, moved by the part's matrix (p, 4, 4). And the box
/// around them all. A box whose lower corner lies beyond the upper one is void: its corners are 0, and do not count.
#[pyfunction]
pub fn placed_boxes<'py>(
    py: Python<'py>,
    boxes: PyReadonlyArray3<'py, f64>,
    root: PyReadonlyArray1<'py, i32>,
    place: PyReadonlyArray3<'py, f64>,
) -> PyResult<PlacedBoxes<'py>> {
    let wrong = |_| PyValueError::new_err("boxes and matrices must be C-contiguous (r, 2, 3) and (p, 4, 4) arrays");
    let (root, (boxes, odd)) = (flat(&root, "root")?, boxes.as_slice().map_err(wrong)?.as_chunks::<6>());
    let (place, rest) = place.as_slice().map_err(wrong)?.as_chunks::<16>();
    if !odd.is_empty() || !rest.is_empty() {
        return Err(PyValueError::new_err("boxes have six numbers, matrices sixteen"));
    }
    expect_len("matrices", place.len(), root.len())?;
    expect_below("root", root.iter().copied(), boxes.len())?;
    let (corners, around) = placed(boxes, root, place);
    let corners = corners.into_flattened().into_pyarray(py).reshape([root.len(), 8, 3])?;
    Ok((corners, table(py, around.to_vec())?))
}
