//! Binding of `hlr_visibility::clash`: crossings of surfaces.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use super::arrays::table;
use super::arrays::{expect_below, expect_len, flat, rows};
use super::threads::run;
use super::view::{Flat, Rows};
use hlr_exact::snap::Grid;
use hlr_mesh::facts::Facts;
use hlr_mesh::scene::Scene;
use hlr_mesh::tables::Tables;
use hlr_visibility::clash::contacts::real;
use hlr_visibility::clash::depth::{Bodies, Depth};
use hlr_visibility::clash::planar_faces::{Edges, NO_PLANE, PlanarFaces};
use hlr_visibility::clash::planes::planes;
use hlr_visibility::clash::reach::Sheet;
use hlr_visibility::clash::search::{Clash, Clashes};
use hlr_visibility::clash::surfaces::Surfaces;
use hlr_visibility::clash::weld::weld;
use hlr_visibility::scan::box_tree::{Aabb, BoxTree};

/// Crossings whose depth one thread measures before it is worth waking another.
const FEW_CLASHES: usize = 256;

/// Result of a search: the outer None for points that are not finite, the inner None for a search that was stopped.
type Told<T> = Option<Option<T>>;

fn told<T>(result: Told<T>) -> PyResult<T> {
    let Some(result) = result else {
        return Err(PyValueError::new_err("points hold coordinates that are not finite"));
    };
    result.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))
}

/// All pairs of triangles that cross, and the grid that their ends were rounded to.
fn search(
    points: &[[f64; 3]],
    (triangles, group, planar): (&[[i32; 3]], &[i32], &PlanarFaces),
    itself: &[bool],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<(Grid, Clashes)> {
    let grid = Grid::around(points)?.uniform();
    let points: Vec<_> = points.par_iter().with_min_len(1 << 13).map(|p| grid.snap(p)).collect();
    let found = Surfaces { points: &points, triangles, group, itself, planar }.clashes(stopped);
    Some((grid, found))
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
    let (grid, found, points, edges) = told(run(py, triangles.len(), |stopped| {
        let planar = PlanarFaces::without_neighbours(vec![NO_PLANE; triangles.len()]);
        let (grid, found) = search(points, (triangles, group, &planar), itself, stopped)?;
        let (points, edges) = weld(&found.found);
        let points: Vec<[f64; 3]> = points.iter().map(|p| grid.unsnap(p)).collect();
        Some((!stopped()).then_some((grid, found, points, edges)))
    })?)?;
    let out = PyDict::new(py);
    let all = &found.found;
    out.set_item("points", table(py, points)?)?;
    out.set_item("edges", table(py, edges)?)?;
    out.set_item("triangles", table(py, all.iter().map(|c| c.triangles.map(|t| t as i32)).collect())?)?;
    let depth: Vec<f64> = all.iter().map(|c| c.meeting.depth / grid.scale_xy).collect();
    out.set_item("depth", depth.into_pyarray(py))?;
    out.set_item("sine", all.iter().map(|c| c.meeting.sine).collect::<Vec<f64>>().into_pyarray(py))?;
    out.set_item("searched", found.searched)?;
    out.set_item("tests", found.tests)?;
    Ok(out)
}

/// Intersection lines of a scene: points (n, 3), segments (m, 2) between them, the two groups (m, 2) of each segment;
/// for every group whether it passes through itself; and the number of triangle pairs examined.
pub type Crossings<'py> = (Rows<'py, f64>, Rows<'py, i32>, Rows<'py, i32>, Flat<'py, bool>, u64);

fn widest(low: &[f64; 3], high: &[f64; 3]) -> f64 {
    (0..3).map(|k| high[k] - low[k]).fold(f64::NEG_INFINITY, f64::max)
}

/// touch: contact tolerance of every group of the scene, in model units.
pub fn crossings<'py>(
    py: Python<'py>,
    (tables, facts, scene): (&Tables, &Facts, &Scene),
    touch: &[f64],
    deflection: f64,
) -> PyResult<Crossings<'py>> {
    let group = &scene.bodies.group_of[..];
    let triangles = &scene.turned.as_ref().map_or(&tables.triangles, |turned| &turned.triangles)[..];
    expect_len("touch", touch.len(), scene.folded.len())?;
    let (points, real, through, tests) = told(run(py, triangles.len(), |stopped| {
        let plane: Vec<i32> = scene.planar_face(tables).map(|face| face.unwrap_or(NO_PLANE)).collect();
        let (edges, offsets, incident) = (&facts.edges[..], &facts.offsets[..], &facts.incident[..]);
        let planar = PlanarFaces::new(plane, triangles, tables.points.len(), &Edges { edges, offsets, incident });
        let (grid, found) = search(&tables.points, (triangles, group, &planar), &scene.folded, stopped)?;
        let (points, ends) = weld(&found.found);
        let points: Vec<[f64; 3]> = points.iter().map(|p| grid.unsnap(p)).collect();
        let without_brep: Vec<bool> = scene.bodies.part_of.iter().map(|&p| !tables.brep[p as usize]).collect();
        let sheet = Sheet { points: &tables.points, triangles, edges, offsets, incident, normals: &facts.normals };
        let planes = planes(&sheet, &planar.of, &found.found);
        let (face, planes) = (&planar.of[..], &planes);
        let bodies = Bodies { sheet, group, face, planes, without_brep: &without_brep, touch, deflection };
        let depth = |(clash, [a, b]): (&Clash, &[i32; 2])| {
            let ends = [a, b].map(|&end| &points[end as usize]);
            bodies.depth(clash, &[0, 1, 2].map(|k| (ends[0][k] + ends[1][k]) / 2.0))
        };
        let depth: Vec<Depth> = found.found.par_iter().zip(&ends).with_min_len(FEW_CLASHES).map(depth).collect();
        let width: Vec<f64> =
            scene.bodies.low.iter().zip(&scene.bodies.high).map(|(low, high)| widest(low, high)).collect();
        let (real, through) = real(&bodies, &found.found, &ends, &depth, &points, &width);
        Some((!stopped()).then_some((points, real, through, found.tests)))
    })?)?;
    let mut used: Vec<i32> = real.iter().flat_map(|segment| segment.ends).collect();
    used.sort_unstable();
    used.dedup();
    let number = |end: i32| used.partition_point(|&e| e < end) as i32;
    Ok((
        table(py, used.iter().map(|&end| points[end as usize]).collect())?,
        table(py, real.iter().map(|segment| segment.ends.map(number)).collect())?,
        table(py, real.iter().map(|segment| segment.groups.map(|g| g as i32)).collect())?,
        through.into_pyarray(py),
        tests,
    ))
}

/// Whether each box (low, high) comes near another one. Always true where it does; rarely true where it does not.
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
    // One step wider on each side, to cover the rounding.
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
