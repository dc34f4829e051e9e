//! Boxes where their parts stand, and points before a camera: the arithmetic of `hlr.view.camera` and
//! `hlr.source.locations`, operation by operation.

use numpy::{IntoPyArray, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};

type Vec3 = [f64; 3];

fn dot(p: &Vec3, v: &Vec3) -> f64 {
    p[0] * v[0] + p[1] * v[1] + p[2] * v[2]
}

/// (n, 3) right, up, and away from the viewer; eye: of a perspective view, with the distance of the image plane from it.
#[pyfunction]
#[pyo3(signature = (points, direction, right, up, eye=None))]
pub fn projected<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    direction: Vec3,
    right: Vec3,
    up: Vec3,
    eye: Option<(Vec3, f64)>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let points = rows::<f64, 3>(&points, "points")?;
    let seen: Vec<Vec3> = match eye {
        None => points.iter().map(|p| [dot(p, &right), dot(p, &up), -dot(p, &direction)]).collect(),
        Some((eye, distance)) => points
            .iter()
            .map(|p| {
                let away = [p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]];
                let factor = distance / -dot(&away, &direction);
                [dot(&away, &right) * factor, dot(&away, &up) * factor, -distance * factor]
            })
            .collect(),
    };
    let n = seen.len();
    seen.into_flattened().into_pyarray(py).reshape([n, 3])
}

/// Corners (p, 8, 3) and the box (2, 3) around them.
type PlacedBoxes<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>);

/// The corners of boxes (r, 2, 3), of each part that of its root, moved by the part's matrix (p, 4, 4), and the box
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
    let mut corners = vec![[0.0; 3]; 8 * root.len()];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for ((own, &root), m) in corners.chunks_exact_mut(8).zip(root).zip(place) {
        let b = &boxes[root as usize];
        if b[0] > b[3] {
            continue;
        }
        for (k, corner) in own.iter_mut().enumerate() {
            let [x, y, z] = [b[3 * (k >> 2)], b[3 * (k >> 1 & 1) + 1], b[3 * (k & 1) + 2]];
            for i in 0..3 {
                let c = m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 2] * z + m[4 * i + 3];
                corner[i] = c;
                // What is no number stays: the caller refuses it.
                low[i] = if c < low[i] || c.is_nan() { c } else { low[i] };
                high[i] = if c > high[i] || c.is_nan() { c } else { high[i] };
            }
        }
    }
    let p = root.len();
    Ok((
        corners.into_flattened().into_pyarray(py).reshape([p, 8, 3])?,
        [low, high].concat().into_pyarray(py).reshape([2, 3])?,
    ))
}
