//! Binding of `hlr_mesh::groups`: properties of the groups of a scene.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat as slice, rows as table};
use super::view::{Flat, Rows, arrays, flat, rows};
use hlr_mesh::groups::Groups as Columns;
use hlr_visibility::plan::contact::meeting;

/// Properties of the groups of a scene.
#[pyclass(frozen)]
pub struct Groups(pub(super) Arc<Columns>);

/// Groups with edges that have no triangles, and the group of each of these edges.
type WithWires<'py> = (Groups, Bound<'py, PyArray1<i32>>);

arrays! { Groups {
    closed: flat Flat<'py, bool> = |g| &g.0.closed;
    cull: flat Flat<'py, bool> = |g| &g.0.cull;
    inward: flat Flat<'py, bool> = |g| &g.0.inward;
    sound: flat Flat<'py, bool> = |g| &g.0.sound;
    without_brep: flat Flat<'py, bool> = |g| &g.0.without_brep;
    tight: flat Flat<'py, bool> = |g| &g.0.tight;
    planar: flat Flat<'py, bool> = |g| &g.0.planar;
    extent: flat Flat<'py, f64> = |g| &g.0.extent;
    low: rows Rows<'py, f64> = |g| &g.0.low;
    high: rows Rows<'py, f64> = |g| &g.0.high;
}

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// These groups, and an open one per distinct owner of edges without triangles.
    fn with_wires<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        wires: PyReadonlyArray2<'py, i32>,
        owner: PyReadonlyArray1<'py, i64>,
        tight: bool,
    ) -> PyResult<WithWires<'py>> {
        let (points, wires) = (table::<f64, 3>(&points, "points")?, table::<i32, 2>(&wires, "wires")?);
        let owner = slice(&owner, "owner")?;
        expect_len("owner", owner.len(), wires.len())?;
        expect_below("wires", wires.as_flattened().iter().copied(), points.len())?;
        let (groups, own) = self.0.with_wires(points, wires, owner, tight);
        Ok((Groups(Arc::new(groups)), own.into_pyarray(py)))
    }

    /// These groups after triangles of some were taken away.
    fn opened(&self, which: PyReadonlyArray1<'_, bool>) -> PyResult<Groups> {
        self.changed(&which, Columns::opened)
    }

    /// These groups where some pass through themselves.
    fn unsound(&self, which: PyReadonlyArray1<'_, bool>) -> PyResult<Groups> {
        self.changed(&which, Columns::unsound)
    }

    /// These groups, of which these pairs have intersection lines.
    fn with_crossing(&self, pairs: PyReadonlyArray2<'_, i32>) -> PyResult<Groups> {
        let pairs = table::<i32, 2>(&pairs, "pairs")?;
        expect_below("pairs", pairs.as_flattened().iter().copied(), self.0.len())?;
        Ok(Groups(Arc::new(self.0.with_crossing(pairs))))
    }

    /// How many groups have a box that comes near that of another.
    fn meeting(&self) -> PyResult<usize> {
        Ok(self.within(0.0)?.into_iter().filter(|&meets| meets).count())
    }
}

impl Groups {
    fn changed(
        &self,
        which: &PyReadonlyArray1<'_, bool>,
        change: impl Fn(&Columns, &[bool]) -> Columns,
    ) -> PyResult<Groups> {
        let which = slice(which, "which")?;
        expect_len("which", which.len(), self.0.len())?;
        Ok(Groups(if which.contains(&true) { Arc::new(change(&self.0, which)) } else { self.0.clone() }))
    }

    /// Whether the box of each group, `reach` wider on all sides, comes near that of another.
    pub(super) fn within(&self, reach: f64) -> PyResult<Vec<bool>> {
        meeting(&self.0, reach).ok_or_else(not_finite)
    }
}

/// Why boxes cannot be compared.
pub(super) fn not_finite() -> PyErr {
    PyValueError::new_err("boxes hold coordinates that are not finite")
}
