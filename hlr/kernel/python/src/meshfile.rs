//! Binding of `hlr_mesh::meshfile`: bytes of a mesh file in, arrays out.

use pyo3::exceptions::{PyEOFError, PyKeyboardInterrupt, PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::arrays::table;
use super::threads::run;
use super::view::Rows;
use hlr_mesh::meshfile::{Fault, MeshFile, Paint, Stop, obj, off, ply, stl};

const ROOM: usize = 4;

type Read<'py> = (Rows<'py, f64>, Vec<(String, Rows<'py, i32>)>, Option<Rows<'py, u8>>, Option<Rows<'py, u8>>);

/// Points, pieces (name, triangles), and colours of points or of triangles. Raises EOFError where the file ends too
/// early and ValueError where it is broken; both say how.
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
    // Numbers take up to ROOM times as many bytes as their text. Without that memory Rust could only abort.
    if Vec::<u8>::new().try_reserve_exact(bytes.len().saturating_mul(ROOM)).is_err() {
        return Err(PyMemoryError::new_err("too little memory"));
    }
    let found = run(py, bytes.len() / 16, |stop| reader(bytes, stop))?.map_err(|fault| match fault {
        Fault::Cut(what) => PyEOFError::new_err(what),
        Fault::Broken(what) => PyValueError::new_err(what),
        Fault::Stopped => PyKeyboardInterrupt::new_err(()),
    })?;
    let pieces: PyResult<Vec<_>> =
        found.pieces.into_iter().map(|piece| Ok((piece.name, table(py, piece.triangles)?))).collect();
    let (points, triangles) = match found.paint {
        Paint::None => (None, None),
        Paint::Points(colors) => (Some(table(py, colors)?), None),
        Paint::Triangles(colors) => (None, Some(table(py, colors)?)),
    };
    Ok((table(py, found.points)?, pieces?, points, triangles))
}
