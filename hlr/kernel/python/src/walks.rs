//! Binding of `hlr_mesh::walks`: walks over mesh edges.

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, expect_slice_below, flat as slice};
use super::guard::caught;
use super::view::{Flat, arrays, flat};
use hlr_mesh::walks::Walks as Columns;

/// Walks over mesh edges, some of which become lines.
#[pyclass(frozen)]
pub struct Walks(pub Columns);

arrays! { Walks {
    offsets: flat Flat<'py, i32> = |w| &w.0.offsets;
    edges: flat Flat<'py, i32> = |w| &w.0.edges;
    reversed: flat Flat<'py, bool> = |w| &w.0.reversed;
    kind: flat Flat<'py, u8> = |w| &w.0.kind;
    part: flat Flat<'py, i32> = |w| &w.0.part;
    index: flat Flat<'py, i32> = |w| &w.0.index;
    other: flat Flat<'py, i32> = |w| &w.0.other;
    face: flat Flat<'py, i32> = |w| &w.0.face;
    straight: flat Flat<'py, bool> = |w| &w.0.straight;
    curve: flat Flat<'py, i32> = |w| &w.0.curve;
    shallow: flat Flat<'py, bool> = |w| &w.0.shallow;
}

    #[new]
    #[pyo3(signature = (
        offsets, edges, reversed, kind, part, *, index = None, other = None, face = None, straight = None, curve = None,
        shallow = None
    ))]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        offsets: PyReadonlyArray1<'_, i32>,
        edges: PyReadonlyArray1<'_, i32>,
        reversed: PyReadonlyArray1<'_, bool>,
        kind: PyReadonlyArray1<'_, u8>,
        part: PyReadonlyArray1<'_, i32>,
        index: Option<PyReadonlyArray1<'_, i32>>,
        other: Option<PyReadonlyArray1<'_, i32>>,
        face: Option<PyReadonlyArray1<'_, i32>>,
        straight: Option<PyReadonlyArray1<'_, bool>>,
        curve: Option<PyReadonlyArray1<'_, i32>>,
        shallow: Option<PyReadonlyArray1<'_, bool>>,
    ) -> PyResult<Walks> {
        caught(py, || {
            let (offsets, edges) = (slice(&offsets, "offsets")?, slice(&edges, "edges")?);
            let count = slice(&kind, "kind")?.len();
            expect_len("offsets", offsets.len(), count + 1)?;
            expect_below("offsets", offsets.iter().copied(), edges.len() + 1)?;
            if offsets.windows(2).any(|w| w[0] >= w[1]) {
                return Err(PyValueError::new_err("offsets must ascend"));
            }
            Ok(Walks(Columns {
                offsets: offsets.to_vec(),
                edges: edges.to_vec(),
                reversed: column(Some(reversed), "reversed", edges.len(), false)?,
                kind: column(Some(kind), "kind", count, 0)?,
                part: column(Some(part), "part", count, 0)?,
                index: column(index, "index", count, -1)?,
                other: column(other, "other", count, -1)?,
                face: column(face, "face", count, -1)?,
                straight: column(straight, "straight", count, false)?,
                curve: column(curve, "curve", count, -1)?,
                shallow: column(shallow, "shallow", count, false)?,
            }))
        })
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// These walks and those of another, sorted by part; within a part these come first.
    fn merged(&self, other: &Walks) -> Walks {
        Walks(self.0.merged(&other.0))
    }

    /// The walks after edges got other numbers.
    fn moved(&self, target: PyReadonlyArray1<'_, i32>, swapped: PyReadonlyArray1<'_, bool>) -> PyResult<Walks> {
        let (target, swapped) = (slice(&target, "target")?, slice(&swapped, "swapped")?);
        expect_len("swapped", swapped.len(), target.len())?;
        self.expect_edges(target.len())?;
        Ok(Walks(self.0.moved(target, swapped)))
    }

    /// How many run along edges of the source that are not known to be straight.
    fn bent(&self) -> usize {
        self.0.index.iter().zip(&self.0.straight).filter(|&(&index, &straight)| index >= 0 && !straight).count()
    }
}

impl Walks {
    /// ValueError where a walk takes an edge that is none of so many.
    pub fn expect_edges(&self, count: usize) -> PyResult<()> {
        expect_slice_below("edges of walks", &self.0.edges, count)
    }
}

/// A column of so many rows; none: all are `none`.
fn column<T: numpy::Element + Copy>(
    given: Option<PyReadonlyArray1<'_, T>>,
    name: &str,
    rows: usize,
    none: T,
) -> PyResult<Vec<T>> {
    let Some(given) = given else {
        return Ok(vec![none; rows]);
    };
    let given = slice(&given, name)?;
    expect_len(name, given.len(), rows)?;
    Ok(given.to_vec())
}
