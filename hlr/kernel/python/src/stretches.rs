//! Binding of `hlr_visibility::scan::stretches`: edges whose own faces are seen nearly edge-on.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::arrays::{expect_ascending, expect_below, expect_len, flat as slice, rows};
use super::guard::caught;
use hlr_visibility::scan::stretches::Stretches as Columns;

/// Edges whose own faces are seen nearly edge-on, in stretches.
#[pyclass(frozen)]
pub struct Stretches(pub Columns);

#[pymethods]
impl Stretches {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        edge: PyReadonlyArray1<'_, i32>,
        range: PyReadonlyArray2<'_, f64>,
        line: PyReadonlyArray1<'_, i32>,
        beside: PyReadonlyArray1<'_, u8>,
        dented: PyReadonlyArray1<'_, bool>,
        offsets: PyReadonlyArray1<'_, i32>,
        face: PyReadonlyArray1<'_, i32>,
        off: PyReadonlyArray1<'_, i32>,
        sheet: PyReadonlyArray1<'_, i32>,
    ) -> PyResult<Stretches> {
        caught(py, || {
            let own = Columns {
                edge: slice(&edge, "edge")?.to_vec(),
                range: rows::<f64, 2>(&range, "range")?.to_vec(),
                line: slice(&line, "line")?.to_vec(),
                beside: slice(&beside, "beside")?.to_vec(),
                dented: slice(&dented, "dented")?.to_vec(),
                offsets: slice(&offsets, "offsets")?.to_vec(),
                face: slice(&face, "face")?.to_vec(),
                off: slice(&off, "off")?.to_vec(),
                sheet: slice(&sheet, "sheet")?.to_vec(),
            };
            let stretches = own.edge.len();
            for (name, found) in [
                ("range", own.range.len()),
                ("line", own.line.len()),
                ("beside", own.beside.len()),
                ("dented", own.dented.len()),
            ] {
                expect_len(name, found, stretches)?;
            }
            expect_len("offsets", own.offsets.len(), stretches + 1)?;
            expect_len("off", own.off.len(), own.face.len())?;
            expect_below("offsets", own.offsets.iter().copied(), own.face.len() + 1)?;
            expect_below("face", own.face.iter().copied(), own.sheet.len())?;
            expect_below("sheet", own.sheet.iter().copied(), own.sheet.len())?;
            expect_ascending("edge", &own.edge)?;
            expect_ascending("offsets", &own.offsets)?;
            Ok(Stretches(own))
        })
    }

    fn __len__(&self) -> usize {
        self.0.edge.len()
    }

    fn opened(&self, py: Python<'_>, open: PyReadonlyArray1<'_, bool>) -> PyResult<Stretches> {
        caught(py, || {
            let open = slice(&open, "open")?;
            self.expect_edges(open.len())?;
            Ok(Stretches(self.0.opened(open)))
        })
    }

    fn renumbered(&self, py: Python<'_>, target: PyReadonlyArray1<'_, i32>) -> PyResult<Stretches> {
        caught(py, || {
            let target = slice(&target, "target")?;
            self.expect_edges(target.len())?;
            Ok(Stretches(self.0.renumbered(target)))
        })
    }
}

impl Stretches {
    /// ValueError where an edge is not one of so many.
    pub(super) fn expect_edges(&self, edges: usize) -> PyResult<()> {
        expect_below("own edge", self.0.edge.iter().chain(&self.0.line).chain(&self.0.off).copied(), edges)
    }
}
