//! `clashes` and `reach` as Python sees them.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_below, expect_len, flat, rows};
use hlr_exact::snap::Grid;
use hlr_visibility::clash::reach::Sheet;
use hlr_visibility::clash::search::Surfaces;
use hlr_visibility::clash::weld::weld;
use hlr_visibility::scan::box_tree::{Aabb, BoxTree};

#[pyfunction]
pub fn clashes<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    triangle_part: PyReadonlyArray1<'py, i32>,
    itself: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyDict>> {
    let points = rows::<f64, 3>(&points, "points")?;
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    let (group, itself) = (flat(&triangle_part, "triangle_part")?, flat(&itself, "itself")?);
    expect_len("triangle_part", group.len(), triangles.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    expect_below("triangle_part", group.iter().copied(), itself.len())?;
    let result = run(py, 0, triangles.len(), |stopped| {
        let grid = Grid::around(points)?.uniform();
        let snapped: Vec<_> = points.par_iter().with_min_len(1 << 13).map(|p| grid.snap(p)).collect();
        let found = Surfaces { points: &snapped, triangles, group, itself }.clashes(stopped);
        let (points, edges) = weld(&found.found);
        let points: Vec<[f64; 3]> = points.iter().map(|p| grid.unsnap(p)).collect();
        Some((!stopped()).then_some((grid, found, points, edges)))
    })?;
    let Some(result) = result else {
        return Err(PyValueError::new_err("points hold coordinates that are not finite"));
    };
    let (grid, found, points, edges) = result.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    let (n, m) = (points.len(), edges.len());
    let out = PyDict::new(py);
    let all = &found.found;
    out.set_item("points", points.into_flattened().into_pyarray(py).reshape([n, 3])?)?;
    out.set_item("edges", edges.into_flattened().into_pyarray(py).reshape([m, 2])?)?;
    let triangles: Vec<i32> = all.iter().flat_map(|c| c.triangles.map(|t| t as i32)).collect();
    out.set_item("triangles", triangles.into_pyarray(py).reshape([m, 2])?)?;
    let depth: Vec<f64> = all.iter().map(|c| c.meeting.depth / grid.scale_xy).collect();
    out.set_item("depth", depth.into_pyarray(py))?;
    out.set_item("sine", all.iter().map(|c| c.meeting.sine).collect::<Vec<f64>>().into_pyarray(py))?;
    out.set_item("searched", found.searched)?;
    out.set_item("tests", found.tests)?;
    Ok(out)
}

/// (m, 2): how far the surface of the other triangle of a pair goes beyond the plane of each, near the place where they
/// cross, on its shallower side: no more is told than `most`, and infinity where it cannot be told.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn reach<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    edges: PyReadonlyArray2<'py, i32>,
    offsets: PyReadonlyArray1<'py, i32>,
    incident: PyReadonlyArray1<'py, i32>,
    normals: PyReadonlyArray2<'py, f64>,
    pairs: PyReadonlyArray2<'py, i32>,
    at: PyReadonlyArray2<'py, f64>,
    most: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let (edges, offsets) = (rows::<i32, 2>(&edges, "edges")?, flat(&offsets, "offsets")?);
    let (incident, normals) = (flat(&incident, "incident")?, rows::<f64, 3>(&normals, "normals")?);
    let (pairs, at, most) = (rows::<i32, 2>(&pairs, "pairs")?, rows::<f64, 3>(&at, "at")?, flat(&most, "most")?);
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    expect_below("incident", incident.iter().copied(), triangles.len())?;
    expect_below("offsets", offsets.iter().copied(), incident.len() + 1)?;
    expect_below("pairs", pairs.iter().flatten().copied(), triangles.len())?;
    expect_len("offsets", offsets.len(), edges.len() + 1)?;
    expect_len("normals", normals.len(), triangles.len())?;
    expect_len("at", at.len(), pairs.len())?;
    expect_len("most", most.len(), pairs.len())?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    let found: Vec<[f64; 2]> = run(py, 0, pairs.len(), |stopped| {
        let sheet = Sheet { points, triangles, edges, offsets, incident, normals };
        (0..pairs.len())
            .into_par_iter()
            .map(|i| {
                let [a, b] = pairs[i].map(|t| t as u32);
                if stopped() {
                    return [0.0; 2];
                }
                [sheet.reach(a, b, &at[i], most[i]), sheet.reach(b, a, &at[i], most[i])]
            })
            .collect()
    })?;
    let m = found.len();
    found.into_flattened().into_pyarray(py).reshape([m, 2])
}

/// Whether each box (low, high) comes near another one: never no where it does, rarely yes where it does not.
#[pyfunction]
pub fn boxes_meet<'py>(
    py: Python<'py>,
    low: PyReadonlyArray2<'py, f64>,
    high: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let (low, high) = (rows::<f64, 3>(&low, "low")?, rows::<f64, 3>(&high, "high")?);
    expect_len("high", high.len(), low.len())?;
    let whole = |i: &usize| low[*i].iter().chain(&high[*i]).all(|c| c.is_finite());
    let used: Vec<usize> = (0..low.len()).filter(whole).collect();
    let corners: Vec<[f64; 3]> = used.iter().flat_map(|&i| [low[i], high[i]]).collect();
    let Some(grid) = Grid::around(&corners) else {
        return Err(PyValueError::new_err("boxes hold coordinates that are not finite"));
    };
    let grid = grid.uniform();
    // A step more on each side than what was rounded.
    let boxes: Vec<Aabb> = used
        .iter()
        .map(|&i| Aabb { low: grid.snap(&low[i]).map(|c| c - 1), high: grid.snap(&high[i]).map(|c| c + 1) })
        .collect();
    let tree = BoxTree::new(boxes.iter().enumerate().map(|(k, b)| (*b, k as u32)).collect());
    let mut meets = vec![false; low.len()];
    for (k, &i) in used.iter().enumerate() {
        tree.query(&boxes[k], |other| meets[i] |= other as usize != k);
    }
    Ok(meets.into_pyarray(py))
}
