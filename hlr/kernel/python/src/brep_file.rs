//! Binding of `hlr_brep::format`: shapes of BREP files, and the dump of a model made of them.

use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::{PyNotImplementedError, PyValueError};
use pyo3::prelude::*;

use super::guard::caught;
use super::threads::run;
use hlr_brep::format::{
    Matrix, Piece, Root, Source, Sub, faces, merged, pieces, read_file, square_placement as square,
};

/// Whether it is a solid; shape and orientation, None where several shapes are one piece; row by row its placement.
type PieceFacts = (bool, Option<(u32, u8)>, Vec<f64>);

/// The shape of a BREP file. Its pieces are its solids, and what lies outside solids together.
#[pyclass(frozen)]
pub struct BrepFile(Mutex<Kept>);

struct Kept {
    source: Source,
    pieces: Vec<Piece>,
}

#[pymethods]
impl BrepFile {
    #[new]
    fn new(py: Python<'_>, data: &[u8]) -> PyResult<BrepFile> {
        caught(py, || {
            let read = run(py, data.len() / 64, |stopped| {
                let mut source = read_file(data, stopped)?;
                let pieces = pieces(&mut source.dump)?;
                Ok(Kept { source, pieces })
            })?;
            Ok(BrepFile(Mutex::new(read.map_err(damaged)?)))
        })
    }

    /// Number and orientation of the root shape.
    #[getter]
    fn root(&self) -> (u32, u8) {
        let root = self.kept().source.dump.root;
        (root.shape, root.orientation as u8)
    }

    /// The placement of the root shape: twelve numbers, row by row.
    #[getter]
    fn place(&self) -> Vec<f64> {
        let locations = &mut self.kept().source.dump;
        let number = locations.locations.written(locations.root.location);
        rows(&locations.locations.matrix(number))
    }

    /// The pieces, without the placement of the root.
    #[getter]
    fn pieces(&self) -> Vec<PieceFacts> {
        let of = |piece: &Piece| {
            let one = piece.subs.first().filter(|_| !piece.loose).map(|sub| (sub.shape, sub.orientation as u8));
            (piece.solid, one, rows(&piece.place))
        };
        self.kept().pieces.iter().map(of).collect()
    }

    /// Numbers of the underlying faces of a piece, of the root where it is None, as an explorer meets them.
    #[pyo3(signature = (piece = None))]
    fn faces(&self, piece: Option<usize>) -> PyResult<Vec<u32>> {
        let mut kept = self.kept();
        let subs = match piece {
            Some(piece) => kept.piece(piece)?.subs.clone(),
            None => vec![Sub { location: 0, ..kept.source.dump.root }],
        };
        faces(&mut kept.source.dump, &subs).map_err(damaged)
    }
}

impl BrepFile {
    fn kept(&self) -> std::sync::MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    fn piece(&self, number: usize) -> PyResult<&Piece> {
        self.pieces.get(number).ok_or_else(|| PyValueError::new_err("a piece that there is not"))
    }
}

/// A placement (twelve numbers, row by row) whose turn was rounded, with a turn that is none.
#[pyfunction]
pub fn square_placement(rows: [f64; 12]) -> PyResult<Vec<f64>> {
    let matrix = [0, 4, 8].map(|k| [rows[k], rows[k + 1], rows[k + 2], rows[k + 3]]);
    match square(&matrix) {
        Some(found) => Ok(self::rows(&found)),
        None => Err(PyValueError::new_err("a placement without volume")),
    }
}

fn damaged(damage: hlr_brep::format::Damaged) -> PyErr {
    let text = damage.to_string();
    if damage.unsupported { PyNotImplementedError::new_err(text) } else { PyValueError::new_err(text) }
}

fn rows(matrix: &Matrix) -> Vec<f64> {
    matrix.as_flattened().to_vec()
}

/// OpenCASCADE's binary dump of a compound of pieces: for each its file, and its number there. A file is given once.
#[pyfunction]
pub fn dump_of_pieces(py: Python<'_>, files: Vec<Py<BrepFile>>, roots: Vec<(usize, usize)>) -> PyResult<Vec<u8>> {
    caught(py, || {
        // Each is locked below, and can be locked once.
        let mut known: Vec<_> = files.iter().map(Py::as_ptr).collect();
        known.sort_unstable();
        if known.windows(2).any(|two| two[0] == two[1]) {
            return Err(PyValueError::new_err("a file is given twice"));
        }
        let kept: Vec<_> = files.iter().map(|file| file.get().kept()).collect();
        let sources: Vec<&Source> = kept.iter().map(|kept| &kept.source).collect();
        let of = |&(file, piece): &(usize, usize)| {
            let kept = kept.get(file).ok_or_else(|| PyValueError::new_err("a file that there is not"))?;
            Ok(Root { source: file, piece: kept.piece(piece)? })
        };
        let roots = roots.iter().map(of).collect::<PyResult<Vec<_>>>()?;
        merged(&sources, &roots).ok_or_else(|| PyValueError::new_err("too many shapes"))
    })
}
