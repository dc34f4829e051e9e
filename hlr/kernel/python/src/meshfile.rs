//! Mesh files as Python sees them: bytes in, arrays out.

use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyEOFError, PyKeyboardInterrupt, PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::running::run;
use hlr_mesh::meshfile::{Fault, MeshFile, Paint, Stop, obj, off, ply, stl};

const ROOM: usize = 4;

type Array<'py, T> = Bound<'py, PyArray2<T>>;
type Read<'py> = (Array<'py, f64>, Vec<(String, Array<'py, i32>)>, Option<Array<'py, u8>>, Option<Array<'py, u8>>);

/// Points, pieces (name, triangles), and colours of points or of triangles. EOFError: it ends too early; ValueError: it is
/// broken; both say how.
#[pyfunction]
pub fn read_mesh<'py>(py: Python<'py>, data: &Bound<'py, PyBytes>, kind: &str) -> PyResult<Read<'py>> {
    let reader: fn(&[u8], Stop) -> Result<MeshFile, Fault> = match kind {
        "stl" => stl::read,
        "obj" => obj::read,
        "ply" => ply::read,
        "off" => off::read,
        _ => return Err(PyValueError::new_err(format!("there is no reader of {kind}"))),
    };
    let bytes = data.as_bytes();
    // A text takes up to so many times its length as numbers; where there is no room, Rust could only abort.
    if Vec::<u8>::new().try_reserve_exact(bytes.len().saturating_mul(ROOM)).is_err() {
        return Err(PyMemoryError::new_err("too little memory"));
    }
    let found = run(py, 1, bytes.len() / 16, |stop| reader(bytes, stop))?.map_err(|fault| match fault {
        Fault::Cut(what) => PyEOFError::new_err(what),
        Fault::Broken(what) => PyValueError::new_err(what),
        Fault::Stopped => PyKeyboardInterrupt::new_err(()),
    })?;
    let pieces: PyResult<Vec<_>> =
        found.pieces.into_iter().map(|piece| Ok((piece.name, rows(py, piece.triangles)?))).collect();
    let (points, triangles) = match found.paint {
        Paint::None => (None, None),
        Paint::Points(colors) => (Some(rows(py, colors)?), None),
        Paint::Triangles(colors) => (None, Some(rows(py, colors)?)),
    };
    Ok((rows(py, found.points)?, pieces?, points, triangles))
}

fn rows<T: numpy::Element, const N: usize>(py: Python<'_>, table: Vec<[T; N]>) -> PyResult<Array<'_, T>> {
    let n = table.len();
    table.into_flattened().into_pyarray(py).reshape([n, N])
}
