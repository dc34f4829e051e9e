//! Curves of B-rep edges and surfaces of faces as Python sees them.

use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_below, expect_len, flat, rows};
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;

/// Curves from packed records; None where a record makes none.
pub fn curves(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<Vec<Option<Curve>>> {
    expect_records(kind, offsets, values)?;
    let record = |i: usize| Curve::from_record(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
    Ok((0..kind.len()).map(record).collect())
}

fn expect_records(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<()> {
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_below("offsets", offsets.iter().copied(), values.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    Ok(())
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
    let found = run(py, 0, which.len(), |_| {
        let at = |(&i, &t): (&i32, &f64)| curves[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |c| c.derivatives(t));
        which.par_iter().zip(parameters).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}

/// (n, 3, 3): point, du and dv of surfaces `which` at (u, v); NaN where a record makes no surface.
#[pyfunction]
pub fn surface_points<'py>(
    py: Python<'py>,
    kind: PyReadonlyArray1<'py, u8>,
    offsets: PyReadonlyArray1<'py, i32>,
    values: PyReadonlyArray1<'py, f64>,
    which: PyReadonlyArray1<'py, i32>,
    uv: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let (kind, offsets, values) = (flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?);
    expect_records(kind, offsets, values)?;
    let (which, uv) = (flat(&which, "which")?, rows::<f64, 2>(&uv, "uv")?);
    expect_len("uv", uv.len(), which.len())?;
    expect_below("which", which.iter().copied(), kind.len())?;
    let found = run(py, 0, which.len(), |_| {
        let read = |i: usize| Surface::read(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
        let surfaces: Vec<Option<Surface>> = (0..kind.len()).into_par_iter().map(read).collect();
        let at = |(&i, &place): (&i32, &[f64; 2])| {
            surfaces[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |s| {
                let (point, du, dv) = s.d1(place);
                [point, du, dv]
            })
        };
        which.par_iter().zip(uv).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}
