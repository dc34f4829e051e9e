//! Checks the shapes and ranges of arrays from Python, with the argument's name in the error, and makes arrays for
//! Python.

use numpy::{IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::threads::together;

/// With fewer numbers to check a second thread gains nothing.
const MANY: usize = 1 << 20;

/// Rows of a C-contiguous (n, N) array.
pub fn rows<'a, T: numpy::Element, const N: usize>(
    array: &'a PyReadonlyArray2<'_, T>,
    name: &str,
) -> PyResult<&'a [[T; N]]> {
    let wrong = || PyValueError::new_err(format!("{name} must be a C-contiguous (n, {N}) array"));
    let slice = array.as_slice().map_err(|_| wrong())?;
    // An array in Fortran order is contiguous as well, but its slice runs down the columns.
    if array.as_array().shape()[1] != N || !array.is_c_contiguous() {
        return Err(wrong());
    }
    let (rows, _) = slice.as_chunks::<N>();
    Ok(rows)
}

pub fn flat<'a, T: numpy::Element>(array: &'a PyReadonlyArray1<'_, T>, name: &str) -> PyResult<&'a [T]> {
    array.as_slice().map_err(|_| PyValueError::new_err(format!("{name} must be contiguous")))
}

pub fn expect_len(name: &str, found: usize, wanted: usize) -> PyResult<()> {
    if found == wanted {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("{name} has {found} entries, {wanted} are needed")))
}

pub fn expect_below(name: &str, values: impl Iterator<Item = i32> + Clone, limit: usize) -> PyResult<()> {
    if (largest(values.clone()) as usize) < limit {
        return Ok(());
    }
    refuse(name, values, limit)
}

/// The same of a slice, on all threads where it is long.
pub fn expect_slice_below(name: &str, values: &[i32], limit: usize) -> PyResult<()> {
    let parts = || values.par_chunks(MANY).map(|part| largest(part.iter().copied())).max();
    let most = if values.len() > MANY { together(parts)? } else { Some(largest(values.iter().copied())) };
    if (most.unwrap_or(0) as usize) < limit {
        return Ok(());
    }
    refuse(name, values.iter().copied(), limit)
}

/// As unsigned numbers negative ones are the largest: one maximum checks them all, without a branch for each.
fn largest(values: impl Iterator<Item = i32>) -> u32 {
    values.fold(0, |most, v| most.max(v as u32))
}

fn refuse(name: &str, mut values: impl Iterator<Item = i32>, limit: usize) -> PyResult<()> {
    match values.find(|&v| v < 0 || v as usize >= limit) {
        Some(v) => Err(PyValueError::new_err(format!("{name} holds {v}, allowed are 0..{limit}"))),
        None => Ok(()),
    }
}

pub fn check_incidence(edges: usize, offsets: &[i32], incident: &[i32], triangles: usize) -> PyResult<()> {
    expect_len("offsets", offsets.len(), edges + 1)?;
    expect_slice_below("incident", incident, triangles)?;
    expect_slice_below("offsets", offsets, incident.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    Ok(())
}

pub fn expect_ascending(name: &str, values: &[i32]) -> PyResult<()> {
    if values.is_sorted() {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("{name} must ascend")))
}

/// Rows as an array (n, N).
pub fn table<T: numpy::Element, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Bound<'_, PyArray2<T>>> {
    let n = rows.len();
    rows.into_flattened().into_pyarray(py).reshape([n, N])
}
