//! Exact object-space hidden-line removal: module registration only.

use pyo3::prelude::*;

#[pymodule]
fn _kernel(_m: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}
