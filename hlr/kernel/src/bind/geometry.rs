//! Curves of B-rep edges as Python sees them.

use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_below, expect_len, flat};
use crate::geometry::curve::Curve;

/// Curves from packed records; None where a record makes none.
pub fn curves(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<Vec<Option<Curve>>> {
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_below("offsets", offsets.iter().copied(), values.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    let record = |i: usize| Curve::from_record(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
    Ok((0..kind.len()).map(record).collect())
}

#[pyfunction]
pub fn curve_points<'py>(
    py: Python<'py>,
    kind: PyReadonlyArray1<'py, u8>,
    offsets: PyReadonlyArray1<'py, i32>,
    values: PyReadonlyArray1<'py, f64>,
    which: PyReadonlyArray1<'py, i32>,
    parameters: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let curves = curves(flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?)?;
    let (which, parameters) = (flat(&which, "which")?, flat(&parameters, "parameters")?);
    expect_len("parameters", parameters.len(), which.len())?;
    expect_below("which", which.iter().copied(), curves.len())?;
    let found = run(py, 0, |_| {
        let at = |(&i, &t): (&i32, &f64)| curves[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |c| c.derivatives(t));
        which.par_iter().zip(parameters).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}
