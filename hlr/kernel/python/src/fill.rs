//! Binding of `hlr_preview::fill`: the areas of a filled drawing.

use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::{expect_len, flat};
use super::preview::{PictureLens, PictureLight, ShadedModel, stopped_error};
use super::threads::run;
use hlr_preview::fill::areas;
use hlr_preview::shade::Scene;

/// Areas of what `ShadedModel.picture` shows, in the order of painting; `label` (t,): equal for triangles of one face;
/// `fine`: least width of a band of light in pixels.
///
/// points (n, 2) pixels, y down; loops (l + 1,) into points; areas (a + 1,) into loops; colours (a, 4) sRGB and
/// opacity; triangle (a,): one of the face; gradient (a,): -1 for none; lines (g, 4): from x, y to x, y; stops (g + 1,)
/// into shares (s,) and shades (s, 4).
#[pyfunction]
pub fn filled_areas<'py>(
    py: Python<'py>,
    model: &ShadedModel,
    lens: &PictureLens,
    light: &PictureLight,
    label: PyReadonlyArray1<'_, i32>,
    fine: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let (lens, light) = (&lens.0, light.0);
    let label = flat(&label, "label")?;
    expect_len("label", label.len(), model.model().triangles.len())?;
    if label.iter().any(|&l| l < 0) || fine.is_nan() || fine < 1.0 {
        return Err(PyValueError::new_err("labels are not negative, and a band is a pixel wide at least"));
    }
    let found = run(py, usize::MAX, |stopped| {
        model.with_space(|space| {
            let scene = Scene { model: &model.model(), lens, light, shadow: None, occlusion: None };
            areas(&scene, label, fine, space, stopped)
        })
    })?
    .ok_or_else(stopped_error)?;

    let starts = |lengths: &mut dyn Iterator<Item = usize>| -> Vec<i32> {
        let mut out = vec![0i32];
        let mut sum = 0;
        out.extend(lengths.map(|n| {
            sum += n as i32;
            sum
        }));
        out
    };
    let out = PyDict::new(py);
    let points: Vec<f64> = found.loops.iter().flatten().flatten().copied().collect();
    let colours: Vec<u8> = found.colours.iter().flatten().copied().collect();
    let (points_count, colours_count) = (points.len() / 2, found.colours.len());
    out.set_item("points", points.into_pyarray(py).reshape([points_count, 2])?)?;
    out.set_item("loops", starts(&mut found.loops.iter().map(Vec::len)).into_pyarray(py))?;
    out.set_item("areas", found.starts.iter().map(|&s| s as i32).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("colours", colours.into_pyarray(py).reshape([colours_count, 4])?)?;
    out.set_item("triangle", found.triangle.iter().map(|&t| t as i32).collect::<Vec<_>>().into_pyarray(py))?;
    let mut next = -1;
    let numbers = found.gradients.iter().map(|g| {
        next += i32::from(g.is_some());
        if g.is_some() { next } else { -1 }
    });
    out.set_item("gradient", numbers.collect::<Vec<_>>().into_pyarray(py))?;
    let gradients: Vec<_> = found.gradients.iter().flatten().collect();
    let lines: Vec<f64> = gradients.iter().flat_map(|g| [g.from[0], g.from[1], g.to[0], g.to[1]]).collect();
    out.set_item("lines", lines.into_pyarray(py).reshape([gradients.len(), 4])?)?;
    out.set_item("stops", starts(&mut gradients.iter().map(|g| g.stops.len())).into_pyarray(py))?;
    let stops: Vec<_> = gradients.iter().flat_map(|g| &g.stops).collect();
    out.set_item("shares", stops.iter().map(|s| s.0).collect::<Vec<f64>>().into_pyarray(py))?;
    let shades: Vec<u8> = stops.iter().flat_map(|s| s.1).collect();
    out.set_item("shades", shades.into_pyarray(py).reshape([stops.len(), 4])?)?;
    Ok(out)
}
