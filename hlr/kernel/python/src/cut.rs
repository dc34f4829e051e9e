//! Binding of `hlr_brep::cut`: parts of a model cut by planes, and the model of what is left.

use std::sync::Arc;

use pyo3::exceptions::{PyKeyboardInterrupt, PyNotImplementedError, PyValueError};
use pyo3::prelude::*;

use super::arrays::expect_below;
use super::brep::BrepModel;
use super::guard::caught;
use super::threads::{FEW, run};
use hlr_brep::body::{Body, model_of};
use hlr_brep::cut::{Cut, Plane, cut_all};

/// Why a part cannot be cut here; whether it was cut; and for each of its pieces, for each of their faces, the face of the
/// part that it was; -1 for faces that the cut has made.
type CutFacts = (Option<&'static str>, bool, Vec<Vec<i32>>);

/// What planes have left of parts.
#[pyclass(frozen)]
pub struct CutParts {
    pieces: Vec<Body>,
    /// For each cut, in their order.
    #[pyo3(get)]
    found: Vec<CutFacts>,
}

#[pymethods]
impl CutParts {
    /// Cuts parts of a model by planes, each given as part, normal of length 1, level along it, and what counts as on it.
    #[new]
    fn new(py: Python<'_>, model: &BrepModel, cuts: Vec<(usize, [f64; 3], f64, f64)>) -> PyResult<CutParts> {
        let model = &model.0;
        expect_below("cuts", cuts.iter().map(|cut| cut.0 as i32), model.parts.len())?;
        let finite = |(_, normal, level, near): &(usize, [f64; 3], f64, f64)| {
            normal.iter().chain([level, near]).all(|c| c.is_finite()) && *near > 0.0
        };
        if !cuts.iter().all(finite) {
            return Err(PyValueError::new_err("planes must be finite"));
        }
        let planes: Vec<(usize, Plane)> =
            cuts.iter().map(|&(part, normal, level, near)| (part, Plane { normal, level, near })).collect();
        let size = 100 * planes.iter().map(|(part, _)| model.parts[*part].faces.len()).sum::<usize>();
        caught(py, || {
            let mut out = CutParts { pieces: Vec::new(), found: Vec::with_capacity(planes.len()) };
            for cut in run(py, size.max(FEW), |stopped| cut_all(model, &planes, stopped))? {
                let of = |piece: &Body| piece.faces.iter().map(|face| face.of.map_or(-1, |of| of as i32)).collect();
                out.found.push(match cut {
                    Cut::Whole => (None, false, Vec::new()),
                    Cut::Gone => (None, true, Vec::new()),
                    Cut::Failed(why) => (Some(why), false, Vec::new()),
                    Cut::Stopped => return Err(PyKeyboardInterrupt::new_err("stopped")),
                    Cut::Pieces(pieces) => {
                        let faces = pieces.iter().map(of).collect();
                        out.pieces.extend(pieces);
                        (None, true, faces)
                    }
                });
            }
            Ok(out)
        })
    }

    /// The model of whole parts, each given as its model and its number there, and of all pieces behind them. A
    /// NotImplementedError: a part cannot be written in its own frame.
    fn with_parts(&self, py: Python<'_>, parts: Vec<(PyRef<'_, BrepModel>, usize)>) -> PyResult<BrepModel> {
        let mut bodies = Vec::with_capacity(parts.len() + self.pieces.len());
        for (model, part) in &parts {
            expect_below("parts", [*part as i32].into_iter(), model.0.parts.len())?;
            bodies.push(Body::of_part(&model.0, *part).map_err(PyNotImplementedError::new_err)?);
        }
        bodies.extend(self.pieces.iter().cloned());
        let size = 10 * bodies.iter().map(|body| body.faces.len()).sum::<usize>();
        let model = run(py, size, |_| model_of(bodies, true))?;
        Ok(BrepModel(Arc::new(model)))
    }
}
