//! Binding of `hlr_linework::legible`: what a pen can show of the lines of a drawing.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::drawing::{Lines, width};
use super::threads::run;
use hlr_linework::legible::ink::Ink as Laid;
use hlr_linework::legible::left_out::left_out;
use hlr_linework::legible::spacing::spacings;
use hlr_linework::lines::drawing::{Kind, Lines as Drawn};

/// Ink by its distance to the nearest line alongside, all ink, and the size of the smallest line.
type Spacing<'py> = (Bound<'py, PyArray1<f64>>, f64, f64);

/// The lines of a drawing, and their ink.
#[pyclass(frozen)]
pub struct Ink {
    lines: Arc<Drawn>,
    ink: Laid,
    reaches: [f64; 3],
}

impl Ink {
    /// Of a few long lines as many places are looked at as of many short ones: 250 lines take a millisecond.
    fn size(&self) -> usize {
        4 * self.lines.0.len()
    }
}

#[pymethods]
impl Ink {
    #[new]
    fn new(py: Python<'_>, lines: PyRef<'_, Lines>, reaches: [f64; 3]) -> PyResult<Ink> {
        for reach in reaches {
            width("reach", reach)?;
        }
        let lines = lines.0.clone();
        let [hidden, visible, _] = reaches;
        let ink = run(py, lines.0.len(), |_| Laid::of(&lines, [hidden, visible]))?;
        Ok(Ink { lines, ink, reaches })
    }

    /// Of hidden lines, of visible lines, and of hidden lines beside visible ones: ink by its distance to the nearest line
    /// alongside, all ink, and the size of the smallest line; None where there is too much ink.
    fn spacings<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Option<Spacing<'py>>, Option<Spacing<'py>>, Option<Spacing<'py>>)> {
        let found = run(py, self.size(), |_| spacings(&self.ink, self.reaches))?;
        Ok(found.map(|s| s.map(|s| (s.shares().into_pyarray(py), s.smallest, s.ink))).into())
    }

    /// (n,) the fate of each line: 0 drawn, 1 smaller than the pen, 2 between others.
    fn left_out<'py>(
        &self,
        py: Python<'py>,
        pens: [f64; 2],
        accuracy: f64,
        order: Vec<u8>,
    ) -> PyResult<Bound<'py, PyArray1<u8>>> {
        for pen in pens {
            width("pen", pen)?;
        }
        if !(accuracy.is_finite() && accuracy > 0.0) {
            return Err(PyValueError::new_err("accuracy must be above zero"));
        }
        let order: Vec<Kind> = order.into_iter().map(Kind).collect();
        let fates = run(py, self.size(), |_| left_out(&self.lines, &self.ink, pens, accuracy, &order))?;
        Ok(fates.into_iter().map(|fate| fate as u8).collect::<Vec<_>>().into_pyarray(py))
    }
}
