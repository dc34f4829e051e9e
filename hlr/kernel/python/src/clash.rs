//! Binding of `hlr_visibility::clash`: crossings of surfaces.

use numpy::{IntoPyArray, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::table;
use super::arrays::{expect_below, expect_len, flat, rows};
use super::groups::Groups;
use super::threads::run;
use super::view::{Flat, Rows};
use super::visibility_input::depths;
use hlr_mesh::facts::Facts;
use hlr_mesh::scene::Scene;
use hlr_mesh::tables::Tables;
use hlr_visibility::clash::crossings;
use hlr_visibility::clash::planar_faces::{NO_PLANE, PlanarFaces};

/// Result of a search: the outer None for points that are not finite, the inner None for a search that was stopped.
type Told<T> = Option<Option<T>>;

fn told<T>(result: Told<T>) -> PyResult<T> {
    let Some(result) = result else {
        return Err(PyValueError::new_err("points hold coordinates that are not finite"));
    };
    result.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))
}

/// Every pair of triangles that cross, however little.
#[pyfunction]
pub fn clashes<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    triangle_group: PyReadonlyArray1<'py, i32>,
    itself: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyDict>> {
    let points = rows::<f64, 3>(&points, "points")?;
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    let (group, itself) = (flat(&triangle_group, "triangle_group")?, flat(&itself, "itself")?);
    expect_len("triangle_group", group.len(), triangles.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    expect_below("triangle_group", group.iter().copied(), itself.len())?;
    let found = told(run(py, triangles.len(), |stopped| {
        let planar = PlanarFaces::without_neighbours(vec![NO_PLANE; triangles.len()]);
        let found = crossings::met(points, (triangles, group, &planar), itself, stopped)?;
        Some((!stopped()).then_some(found))
    })?)?;
    let out = PyDict::new(py);
    let all = &found.clashes.found;
    out.set_item("points", table(py, found.points)?)?;
    out.set_item("edges", table(py, found.ends)?)?;
    out.set_item("triangles", table(py, all.iter().map(|c| c.triangles.map(|t| t as i32)).collect())?)?;
    let depth: Vec<f64> = all.iter().map(|c| c.meeting.depth / found.grid.scale_xy).collect();
    out.set_item("depth", depth.into_pyarray(py))?;
    out.set_item("sine", all.iter().map(|c| c.meeting.sine).collect::<Vec<f64>>().into_pyarray(py))?;
    out.set_item("tests", found.clashes.tests)?;
    Ok(out)
}

/// Intersection lines of a scene: points (n, 3), segments (m, 2) between them, the two groups (m, 2) of each segment,
/// a triangle of each group (m, 2), and whether its line is shallow; for every group whether it passes through itself; and
/// the number of triangle pairs examined.
pub type Crossings<'py> =
    (Rows<'py, f64>, Rows<'py, i32>, Rows<'py, i32>, Rows<'py, i32>, Flat<'py, bool>, Flat<'py, bool>, u64);

/// groups: of the scene; contact: depths within which they touch.
pub fn crossings<'py>(
    py: Python<'py>,
    (tables, facts, scene): (&Tables, &Facts, &Scene),
    groups: &Groups,
    contact: [f64; 3],
    deflection: f64,
) -> PyResult<Crossings<'py>> {
    let touch = depths(contact).of_groups(&groups.0);
    expect_len("groups", touch.len(), scene.folded.len())?;
    let found = told(run(py, tables.triangles.len(), |stopped| {
        let found = crossings::crossings((tables, facts, scene), &touch, deflection, stopped)?;
        Some((!stopped()).then_some(found))
    })?)?;
    Ok((
        table(py, found.points)?,
        table(py, found.segments)?,
        table(py, found.groups)?,
        table(py, found.triangles)?,
        found.shallow.into_pyarray(py),
        found.through.into_pyarray(py),
        found.tests,
    ))
}
