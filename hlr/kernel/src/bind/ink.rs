//! Strokes as text, as Python sees them.

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_len, flat, rows};
use crate::ink::arcs::{Arc, Rows, Shape, cubic_rows, rows as arc_rows_of};
use crate::ink::dashes::{Ends, Fitted, Pattern, dashes as fitted_dashes};
use crate::ink::{ARC, CONTROL, CUBIC, QUADRATIC, START, Strokes, WHOLE, pdf, svg};

/// Rows of arcs (n, 8: centre, axes, angles) between their ends (n, 4), and how many each has.
#[pyfunction]
pub fn arc_rows<'py>(
    py: Python<'py>,
    arcs: PyReadonlyArray2<'py, f64>,
    ends: PyReadonlyArray2<'py, f64>,
    places: usize,
    accuracy: f64,
    cubic: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let (arcs, ends) = (rows::<f64, 8>(&arcs, "arcs")?, rows::<f64, 4>(&ends, "ends")?);
    expect_len("ends", ends.len(), arcs.len())?;
    let found = run(py, 0, arcs.len(), |_| {
        let one = |(a, e): (&[f64; 8], &[f64; 4])| {
            let arc = Arc { centre: [a[0], a[1]], axes: [[a[2], a[3]], [a[4], a[5]]], angles: [a[6], a[7]] };
            let (ends, mut out) = ([[e[0], e[1]], [e[2], e[3]]], Rows::default());
            (if cubic { cubic_rows } else { arc_rows_of })(&arc, &ends, places, accuracy, &mut out);
            out
        };
        arcs.par_iter().zip(ends).map(one).collect::<Vec<Rows>>()
    })?;
    let (mut counts, mut points, mut op) = (Vec::new(), Vec::<i64>::new(), Vec::<u8>::new());
    let (mut arc, mut shapes) = (Vec::new(), Vec::<i64>::new());
    for rows in &found {
        let before = (shapes.len() / 5) as i32;
        counts.push(rows.op.len() as i64);
        points.extend(rows.points.as_flattened());
        op.extend(&rows.op);
        arc.extend(rows.arc.iter().map(|&i| if i < 0 { -1 } else { i + before }));
        for s in &rows.shapes {
            shapes.extend([s.radii[0], s.radii[1], s.rotation, i64::from(s.large), i64::from(s.rising)]);
        }
    }
    let (n, k) = (op.len(), shapes.len() / 5);
    let out = PyDict::new(py);
    out.set_item("counts", counts.into_pyarray(py))?;
    out.set_item("points", points.into_pyarray(py).reshape([n, 2])?)?;
    out.set_item("op", op.into_pyarray(py))?;
    out.set_item("arc", arc.into_pyarray(py))?;
    out.set_item("shapes", shapes.into_pyarray(py).reshape([k, 5])?)?;
    Ok(out)
}

type PathData<'py> = (Bound<'py, PyBytes>, Bound<'py, PyArray1<i64>>);

/// The arrays of one layer, as `hlr.writers.strokes.Layer` holds them: points, op, arc, shapes, starts, closed.
type Layer<'py> = (
    PyReadonlyArray2<'py, i64>,
    PyReadonlyArray1<'py, u8>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray2<'py, i64>,
    PyReadonlyArray1<'py, i64>,
    PyReadonlyArray1<'py, bool>,
);

fn shapes_of(layer: &Layer) -> PyResult<Vec<Shape>> {
    let shape = |s: &[i64; 5]| Shape { radii: [s[0], s[1]], rotation: s[2], large: s[3] != 0, rising: s[4] != 0 };
    Ok(rows::<i64, 5>(&layer.3, "shapes")?.iter().map(shape).collect())
}

/// The strokes of a layer, once its arrays fit together.
fn strokes_of<'a>(layer: &'a Layer<'_>, arcs: &'a [Shape], places: usize) -> PyResult<Strokes<'a>> {
    let points = rows::<i64, 2>(&layer.0, "points")?;
    let (op, arc) = (flat(&layer.1, "op")?, flat(&layer.2, "arc")?);
    let (starts, closed) = (flat(&layer.4, "starts")?, flat(&layer.5, "closed")?);
    expect_len("op", op.len(), points.len())?;
    expect_len("arc", arc.len(), points.len())?;
    expect_len("starts", starts.len(), closed.len() + 1)?;
    if places > 12 {
        return Err(PyValueError::new_err("places must be at most 12"));
    }
    if starts.windows(2).any(|w| w[0] >= w[1]) || starts[0] < 0 || starts[starts.len() - 1] > points.len() as i64 {
        return Err(PyValueError::new_err("starts must ascend within the rows"));
    }
    let shaped = |i: usize| matches!(op[i], ARC | WHOLE);
    if (0..op.len()).any(|i| shaped(i) && !(0..arcs.len() as i32).contains(&arc[i])) {
        return Err(PyValueError::new_err("arc holds numbers that are not in shapes"));
    }
    // Rows before it in its stroke that each kind of row needs.
    let needed = |op: u8| match op {
        START | CONTROL | WHOLE => 0,
        QUADRATIC => 2,
        CUBIC => 3,
        _ => 1,
    };
    if starts.windows(2).any(|w| (w[0]..w[1]).any(|i| i - w[0] < needed(op[i as usize]))) {
        return Err(PyValueError::new_err("a line or a curve needs a start and its control points before it"));
    }
    Ok(Strokes { points, op, arc, arcs, starts, closed, places })
}

/// Path data of the strokes of a layer as SVG, or, in `pdf`, as painted paths; and where each stroke begins.
#[pyfunction]
pub fn path_data<'py>(py: Python<'py>, layer: Layer<'py>, places: usize, as_pdf: bool) -> PyResult<PathData<'py>> {
    let shapes = shapes_of(&layer)?;
    let strokes = strokes_of(&layer, &shapes, places)?;
    let (text, offsets) = py.detach(|| if as_pdf { pdf::paths(&strokes) } else { svg::paths(&strokes) });
    Ok((PyBytes::new(py, &text), offsets.into_pyarray(py)))
}

/// Dashes of each stroke of a hidden layer: lengths of dash, gap, dash, ... and where in them it begins, as text; both
/// empty for a continuous line. visible: the layers that hidden lines may go on from.
#[pyfunction]
pub fn dashes<'py>(
    py: Python<'py>,
    layer: Layer<'py>,
    visible: Vec<Layer<'py>>,
    places: usize,
    dash: f64,
    gap: f64,
) -> PyResult<Vec<(String, String)>> {
    if !(dash > 0.0 && gap > 0.0 && dash.is_finite() && gap.is_finite()) {
        return Err(PyValueError::new_err("dash and gap must be positive lengths"));
    }
    let shapes = shapes_of(&layer)?;
    let strokes = strokes_of(&layer, &shapes, places)?;
    let mut ends = Ends::default();
    for layer in &visible {
        let shapes = shapes_of(layer)?;
        ends.add(&strokes_of(layer, &shapes, places)?);
    }
    let found = run(py, 0, strokes.points.len(), |_| fitted_dashes(&strokes, &Pattern { dash, gap }, &ends))?;
    Ok(found.iter().map(Fitted::text).collect())
}
