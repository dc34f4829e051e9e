//! Strokes as text, as Python sees them.

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_len, flat, rows};
use crate::ink::arcs::{Arc, Rows, Shape, cubic_rows, rows as arc_rows_of};
use crate::ink::{ARC, CUBIC, Strokes, WHOLE, pdf, svg};

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
    let found = run(py, 0, |_| {
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

/// Path data of strokes as SVG, or, in `pdf`, as painted paths; and where each stroke begins.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn path_data<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, i64>,
    op: PyReadonlyArray1<'py, u8>,
    arc: PyReadonlyArray1<'py, i32>,
    shapes: PyReadonlyArray2<'py, i64>,
    starts: PyReadonlyArray1<'py, i64>,
    closed: PyReadonlyArray1<'py, bool>,
    places: usize,
    as_pdf: bool,
) -> PyResult<PathData<'py>> {
    let points = rows::<i64, 2>(&points, "points")?;
    let (op, arc) = (flat(&op, "op")?, flat(&arc, "arc")?);
    let (starts, closed) = (flat(&starts, "starts")?, flat(&closed, "closed")?);
    let shapes: Vec<Shape> = rows::<i64, 5>(&shapes, "shapes")?
        .iter()
        .map(|s| Shape { radii: [s[0], s[1]], rotation: s[2], large: s[3] != 0, rising: s[4] != 0 })
        .collect();
    expect_len("op", op.len(), points.len())?;
    expect_len("arc", arc.len(), points.len())?;
    expect_len("starts", starts.len(), closed.len() + 1)?;
    if places > 12 {
        return Err(PyValueError::new_err("places must be at most 12"));
    }
    if starts.windows(2).any(|w| w[0] > w[1]) || starts[0] < 0 || starts[starts.len() - 1] > points.len() as i64 {
        return Err(PyValueError::new_err("starts must ascend within the rows"));
    }
    let shaped = |i: usize| matches!(op[i], ARC | WHOLE);
    if (0..op.len()).any(|i| shaped(i) && !(0..shapes.len() as i32).contains(&arc[i])) {
        return Err(PyValueError::new_err("arc holds numbers that are not in shapes"));
    }
    if starts.windows(2).any(|w| (w[0]..w[1]).any(|i| op[i as usize] == CUBIC && i - w[0] < 3)) {
        return Err(PyValueError::new_err("a cubic curve needs a start and two control points"));
    }
    let strokes = Strokes { points, op, arc, arcs: &shapes, starts, closed, places };
    let (text, offsets) = py.detach(|| if as_pdf { (pdf::paths(&strokes), Vec::new()) } else { svg::paths(&strokes) });
    Ok((PyBytes::new(py, &text), offsets.into_pyarray(py)))
}
