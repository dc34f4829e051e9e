//! Bindings of `hlr_mesh::boxes`, `hlr_brep::face_boxes` and `hlr_visibility::boxes`: bounding boxes of placed parts and of
//! their faces.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, table};
use super::brep::BrepModel;
use super::groups::not_finite;
use super::parts::to_matrices;
use super::threads::run;
use hlr_brep::face_boxes::placed_face_boxes;
use hlr_mesh::boxes::placed;
use hlr_visibility::boxes::meeting::{boxes_meet, boxes_of_others_meet};

/// Corners (p, 8, 3) and the box (2, 3) around them.
type PlacedBoxes<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>);

/// Underlying faces of a model, and counts of faces of placed parts.
type NearFaces<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<i32>>);

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

/// (p,) whether the box around the eight corners (p, 8, 3) of each part, `reach` wider on all sides, comes near that of
/// another part.
#[pyfunction]
pub fn boxes_near<'py>(
    py: Python<'py>,
    corners: PyReadonlyArray3<'py, f64>,
    reach: f64,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let wrong = |_| PyValueError::new_err("corners must be a C-contiguous (p, 8, 3) array");
    let (corners, odd) = corners.as_slice().map_err(wrong)?.as_chunks::<24>();
    if !odd.is_empty() {
        return Err(PyValueError::new_err("boxes have eight corners"));
    }
    let end = |least: f64, pick: fn(f64, f64) -> f64, beyond: f64| -> Vec<[f64; 3]> {
        let along =
            |own: &[f64; 24], k: usize| own.iter().skip(k).step_by(3).fold(least, |end, &c| pick(end, c)) + beyond;
        corners.iter().map(|own| [0, 1, 2].map(|k| along(own, k))).collect()
    };
    let (low, high) = (end(f64::INFINITY, f64::min, -reach), end(f64::NEG_INFINITY, f64::max, reach));
    Ok(boxes_meet(&low, &high).ok_or_else(not_finite)?.into_pyarray(py))
}

/// (faces,) which underlying faces of a model come near a face of another part, and (n,) how many faces of each placed
/// part do: their boxes, `reach` wider on all sides, meet. parts (n,): numbers; places (n, 3, 4): where they stand; whole
/// (n,): parts of which all faces count as near.
#[pyfunction]
pub fn faces_near<'py>(
    py: Python<'py>,
    model: &BrepModel,
    parts: PyReadonlyArray1<'py, i32>,
    places: PyReadonlyArray3<'py, f64>,
    whole: PyReadonlyArray1<'py, bool>,
    reach: f64,
) -> PyResult<NearFaces<'py>> {
    let (model, parts, whole) = (&model.0, flat(&parts, "parts")?, flat(&whole, "whole")?);
    expect_below("parts", parts.iter().copied(), model.parts.len())?;
    expect_len("whole", whole.len(), parts.len())?;
    let places = to_matrices(&places, "places", parts.len())?;
    let faces_of = |part: i32| &model.parts[part as usize].faces;
    let size = parts.iter().map(|&part| faces_of(part).len()).sum();
    let near = if whole.iter().all(|&whole| whole) {
        vec![true; size]
    } else {
        let near = run(py, size, |_| {
            let boxes = placed_face_boxes(model, parts, &places);
            let owner: Vec<u32> = (0..).zip(&boxes).flat_map(|(i, own)| vec![i; own.len()]).collect();
            let wide = |end: usize, by: f64| -> Vec<_> {
                boxes.iter().flatten().map(|own| own[end].map(|c| c + by)).collect()
            };
            boxes_of_others_meet(&wide(0, -reach), &wide(1, reach), &owner)
        })?;
        near.ok_or_else(not_finite)?
    };
    let (mut faces, mut counts, mut next) = (vec![false; model.faces.len()], vec![0; parts.len()], near.iter());
    for ((count, &part), &whole) in counts.iter_mut().zip(parts).zip(whole) {
        for (placed, &near) in faces_of(part).iter().zip(&mut next) {
            faces[placed.face as usize] |= near | whole;
            *count += i32::from(near | whole);
        }
    }
    Ok((faces.into_pyarray(py), counts.into_pyarray(py)))
}
