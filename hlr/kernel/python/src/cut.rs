//! Binding of `hlr_brep::cut`: parts of a model cut by planes.

use std::sync::Arc;

use pyo3::exceptions::{PyKeyboardInterrupt, PyNotImplementedError, PyValueError};
use pyo3::prelude::*;

use super::arrays::expect_below;
use super::brep::BrepModel;
use super::guard::caught;
use super::threads::{FEW, run};
use hlr_brep::body::{Body, model_of};
use hlr_brep::cut::{Cut, Plane, cut_all};

/// A piece: its number among the parts of the new model, and for each of its faces the face of the part that it was; -1
/// for faces that the cut has made.
type PieceFacts = (usize, Vec<i32>);
/// Whether the part was cut; whether it stays whole because its faces are triangles alone; and its pieces.
type CutFacts = (bool, bool, Vec<PieceFacts>);

/// Cuts parts of a model by planes, each given as part, normal of length 1, level along it, and what counts as on it. The
/// new model has the parts `kept`, then the pieces. A NotImplementedError: a part cannot be cut here, with the reason.
#[pyfunction]
pub fn cut_parts(
    py: Python<'_>,
    model: &BrepModel,
    cuts: Vec<(usize, [f64; 3], f64, f64)>,
    kept: Vec<usize>,
) -> PyResult<(BrepModel, Vec<CutFacts>)> {
    let model = &model.0;
    expect_below("cuts", cuts.iter().map(|cut| cut.0 as i32), model.parts.len())?;
    expect_below("kept", kept.iter().map(|part| *part as i32), model.parts.len())?;
    let finite = |(_, normal, level, near): &(usize, [f64; 3], f64, f64)| {
        normal.iter().chain([level, near]).all(|c| c.is_finite()) && *near > 0.0
    };
    if !cuts.iter().all(finite) {
        return Err(PyValueError::new_err("planes must be finite"));
    }
    caught(py, || {
        let planes: Vec<(usize, Plane)> =
            cuts.iter().map(|&(part, normal, level, near)| (part, Plane { normal, level, near })).collect();
        let size = FEW + cuts.iter().map(|cut| model.parts[cut.0].faces.len()).sum::<usize>();
        let work = |stopped: &(dyn Fn() -> bool + Sync)| {
            let mut bodies = Vec::with_capacity(kept.len() + cuts.len());
            for &part in &kept {
                bodies.push(Body::of_part(model, part).map_err(str::to_owned)?);
            }
            let mut found = Vec::with_capacity(cuts.len());
            for ((part, _), cut) in planes.iter().zip(cut_all(model, &planes, stopped)) {
                let is_bare = matches!(cut, Cut::Bare);
                let (is_cut, pieces) = match cut {
                    Cut::Whole | Cut::Bare => (false, vec![Body::of_part(model, *part).map_err(str::to_owned)?]),
                    Cut::Gone => (true, Vec::new()),
                    Cut::Pieces(pieces) => (true, pieces),
                    Cut::Failed(why) => return Err(format!("part {part}: {why}")),
                    Cut::Stopped => return Ok(None),
                };
                let mut facts = Vec::with_capacity(pieces.len());
                for piece in pieces {
                    let faces = piece.faces.iter().map(|face| face.of.map_or(-1, |of| of as i32)).collect();
                    facts.push((bodies.len(), faces));
                    bodies.push(piece);
                }
                found.push((is_cut, is_bare, facts));
            }
            Ok(Some((BrepModel(Arc::new(model_of(bodies, true))), found)))
        };
        match run(py, size, work)? {
            Ok(Some(found)) => Ok(found),
            Ok(None) => Err(PyKeyboardInterrupt::new_err("stopped")),
            Err(why) => Err(PyNotImplementedError::new_err(why)),
        }
    })
}
