//! Binding of the curves of B-rep edges.

use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};
use super::guard::caught;
use super::threads::run;
use hlr_brep::geometry::curve::Curve;

pub fn expect_records(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<()> {
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_below("offsets", offsets.iter().copied(), values.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    Ok(())
}

/// Curves from packed records; None where a record makes none.
#[pyclass(frozen)]
pub struct Curves {
    pub curves: Vec<Option<Curve>>,
    pub ranges: Vec<[f64; 2]>,
}

#[pymethods]
impl Curves {
    #[new]
    fn new(
        py: Python<'_>,
        kind: PyReadonlyArray1<'_, u8>,
        range: PyReadonlyArray2<'_, f64>,
        offsets: PyReadonlyArray1<'_, i32>,
        values: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Curves> {
        caught(py, || {
            let (kind, offsets, values) = (flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?);
            let ranges = rows::<f64, 2>(&range, "range")?.to_vec();
            expect_len("range", ranges.len(), kind.len())?;
            expect_records(kind, offsets, values)?;
            let record = |i: usize| Curve::from_record(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
            Ok(Curves { curves: (0..kind.len()).map(record).collect(), ranges })
        })
    }
}

/// (n, 3, 3): point, first and second derivative of curves `which` at parameters; NaN where a record makes no curve.
#[pyfunction]
pub fn curve_points<'py>(
    py: Python<'py>,
    curves: &Curves,
    which: PyReadonlyArray1<'py, i32>,
    parameters: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let curves = &curves.curves;
    let (which, parameters) = (flat(&which, "which")?, flat(&parameters, "parameters")?);
    expect_len("parameters", parameters.len(), which.len())?;
    expect_below("which", which.iter().copied(), curves.len())?;
    let found = run(py, which.len(), |_| {
        let at = |(&i, &t): (&i32, &f64)| curves[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |c| c.derivatives(t));
        which.par_iter().zip(parameters).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}
