//! Turns every panic of the kernel into a Python error: `hlr.common.faults.guarded` wraps all that the kernel exports.
//!
//! At the end of the module's registration every function and every method of every class is wrapped, so that no
//! binding can be forgotten. Constructors cannot be replaced from outside; they call `caught`.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

/// The first panic since `take_fault` was last called: where, and why.
static FAULT: Mutex<Option<String>> = Mutex::new(None);

fn fault() -> std::sync::MutexGuard<'static, Option<String>> {
    FAULT.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// The text of the first panic since the last call; None if there was none.
#[pyfunction]
pub fn take_fault() -> Option<String> {
    fault().take()
}

/// Panics, on the caller's thread or on a worker: for tests of the guard.
#[pyfunction]
pub fn provoke_fault(py: Python<'_>, on_worker: bool) -> PyResult<usize> {
    let nothing: &[usize] = &[];
    let index = nothing.len() + 1;
    if on_worker { super::threads::run(py, usize::MAX, |_| nothing[index]) } else { Ok(nothing[index]) }
}

/// For constructors: turns a panic into the exception that `hlr.common.faults` makes of it.
pub fn caught<T>(py: Python<'_>, work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(done) => done,
        Err(_) => {
            let error = py
                .import("hlr.common.faults")?
                .getattr("fault")?
                .call1((take_fault().unwrap_or("a place that it could not name".into()),))?;
            Err(PyErr::from_value(error))
        }
    }
}

/// Wraps everything in the module, and keeps panics from being printed on standard error.
pub fn guard(m: &Bound<'_, PyModule>) -> PyResult<()> {
    std::panic::set_hook(Box::new(|info| {
        let place = info.location().map_or("an unknown place".into(), |l| format!("{}:{}", l.file(), l.line()));
        let payload = info.payload();
        let words = payload.downcast_ref::<&str>().copied().or(payload.downcast_ref::<String>().map(String::as_str));
        let words = words.unwrap_or("no reason given");
        fault().get_or_insert(format!("{place}: {words}"));
    }));
    let guarded = m.py().import("hlr.common.faults")?.getattr("guarded")?;
    let take = m.getattr("take_fault")?;
    for (name, exported) in m.dict().iter() {
        if let Ok(class) = exported.cast::<PyType>() {
            let own = class.getattr("__dict__")?.call_method0("copy")?.cast_into::<PyDict>().map_err(PyErr::from)?;
            for (name, method) in own.iter() {
                if method.is_callable() && !name.extract::<String>()?.starts_with("__") {
                    class.setattr(name.cast::<pyo3::types::PyString>()?, guarded.call1((method, &take))?)?;
                }
            }
        } else if exported.is_callable() && !exported.is(&take) {
            m.setattr(name.cast::<pyo3::types::PyString>()?, guarded.call1((exported, &take))?)?;
        }
    }
    Ok(())
}
