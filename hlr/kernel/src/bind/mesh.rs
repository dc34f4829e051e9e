//! Facts of meshes as Python sees them.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use super::running::run;
use super::scan::{check_incidence, expect_below, expect_len, flat, rows};
use crate::mesh::clean::clean;
use crate::mesh::groups as of_groups;
use crate::mesh::groups::{Edges, bent, groups};
use crate::mesh::kinds::{Limits, kinds};
use crate::mesh::needles::needles as low_ones;
use crate::mesh::passes::passes;
use crate::scan::topology;

type Flat<'py, T> = Bound<'py, PyArray1<T>>;
type Rows<'py, T> = Bound<'py, PyArray2<T>>;

fn table<T: numpy::Element, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Rows<'_, T>> {
    let n = rows.len();
    rows.into_flattened().into_pyarray(py).reshape([n, N])
}

type Cleaned<'py> = (Rows<'py, f64>, Rows<'py, i32>, Option<Flat<'py, u32>>, (usize, usize, usize));

/// Points joined where they are equal, triangles without impossible ones, which of them were kept, and how many were left
/// out: not finite, out of range, degenerate.
#[pyfunction]
pub fn clean_mesh<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
) -> PyResult<Cleaned<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    if points.len() > i32::MAX as usize - 2 {
        return Err(PyValueError::new_err("there are too many points"));
    }
    let found = run(py, 0, triangles.len(), |_| clean(points, triangles))?;
    let left_out = (found.not_finite, found.out_of_range, found.degenerate);
    let kept = found.kept.map(|kept| kept.into_pyarray(py));
    Ok((table(py, found.points)?, table(py, found.triangles)?, kept, left_out))
}

type Facts<'py> = (
    Rows<'py, i32>,
    Flat<'py, i32>,
    Flat<'py, i32>,
    Flat<'py, i32>,
    Flat<'py, f64>,
    Rows<'py, f64>,
    Flat<'py, i64>,
    bool,
);

/// Edges, offsets, incident triangles, balance, folds, normals, which triangles have no area, and whether a triangle is there twice.
#[pyfunction]
pub fn mesh_facts<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
) -> PyResult<Facts<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    let (t, balance, folds, normals, flat, repeated) = run(py, 0, triangles.len(), |_| {
        let t = topology::topology(triangles, points.len());
        let balance = topology::balance(triangles, &t.edges, &t.offsets, &t.incident);
        let normals = topology::normals(points, triangles);
        let folds = topology::folds(&normals, &t.offsets, &t.incident, &balance);
        let repeated = topology::repeated(triangles, &t);
        let flat = (0..normals.len()).into_par_iter().filter(|&t| normals[t] == [0.0; 3]).map(|t| t as i64).collect();
        (t, balance, folds, normals, flat, repeated)
    })?;
    Ok((
        table(py, t.edges)?,
        t.offsets.into_pyarray(py),
        t.incident.into_pyarray(py),
        balance.into_pyarray(py),
        folds.into_pyarray(py),
        table(py, normals)?,
        Vec::into_pyarray(flat, py),
        repeated,
    ))
}

type Measured<'py> = (Rows<'py, f64>, Rows<'py, f64>, Flat<'py, u32>, Flat<'py, f64>, Flat<'py, f64>);

/// Of each of `count` groups the box (low, high), the number of triangles, six times the volume and twice the area.
#[pyfunction]
pub fn group_facts<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    group: PyReadonlyArray1<'py, i32>,
    count: usize,
) -> PyResult<Measured<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let group = flat(&group, "group")?;
    expect_len("group", group.len(), triangles.len())?;
    expect_below("group", group.iter().copied(), count)?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    let found = run(py, 0, triangles.len(), |_| groups(points, triangles, group, count))?;
    Ok((
        table(py, found.low)?,
        table(py, found.high)?,
        found.count.into_pyarray(py),
        found.volume.into_pyarray(py),
        found.area.into_pyarray(py),
    ))
}

/// Which groups bend inward at an edge by more than `least` (g,), or have an edge of not just two triangles.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn bent_groups<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    edges: PyReadonlyArray2<'py, i32>,
    offsets: PyReadonlyArray1<'py, i32>,
    incident: PyReadonlyArray1<'py, i32>,
    normals: PyReadonlyArray2<'py, f64>,
    group: PyReadonlyArray1<'py, i32>,
    least: PyReadonlyArray1<'py, f64>,
) -> PyResult<Flat<'py, bool>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let (edges, normals) = (rows::<i32, 2>(&edges, "edges")?, rows::<f64, 3>(&normals, "normals")?);
    let (offsets, incident) = (flat(&offsets, "offsets")?, flat(&incident, "incident")?);
    let (group, least) = (flat(&group, "group")?, flat(&least, "least")?);
    check_incidence(edges.len(), offsets, incident, triangles.len())?;
    expect_len("normals", normals.len(), triangles.len())?;
    expect_len("group", group.len(), triangles.len())?;
    expect_below("group", group.iter().copied(), least.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    expect_below("edges", edges.iter().flatten().copied(), points.len())?;
    let mesh = Edges { edges, offsets, incident, normals };
    Ok(run(py, 0, edges.len(), |_| bent(points, triangles, mesh, group, least))?.into_pyarray(py))
}

/// How many connected pieces each of `count` groups has; piece: of each triangle, as `components` numbers them.
#[pyfunction]
pub fn group_pieces<'py>(
    py: Python<'py>,
    group: PyReadonlyArray1<'py, i32>,
    piece: PyReadonlyArray1<'py, i32>,
    count: usize,
) -> PyResult<Flat<'py, u32>> {
    let (group, piece) = (flat(&group, "group")?, flat(&piece, "piece")?);
    expect_len("piece", piece.len(), group.len())?;
    expect_below("group", group.iter().copied(), count)?;
    Ok(of_groups::pieces(group, piece, count).into_pyarray(py))
}

/// How often a ray from the middle of each group that is asked for passes through its surface.
#[pyfunction]
pub fn group_passes<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    group: PyReadonlyArray1<'py, i32>,
    asked: PyReadonlyArray1<'py, bool>,
) -> PyResult<Flat<'py, i32>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let (group, asked) = (flat(&group, "group")?, flat(&asked, "asked")?);
    expect_len("group", group.len(), triangles.len())?;
    expect_below("group", group.iter().copied(), asked.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    Ok(run(py, 0, triangles.len(), |_| passes(points, triangles, group, asked))?.into_pyarray(py))
}

/// Which triangles are lower than `least` of their part, or have no area; and the numbers of their longest sides.
#[pyfunction]
pub fn needles<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    normals: PyReadonlyArray2<'py, f64>,
    part: PyReadonlyArray1<'py, i32>,
    least: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Flat<'py, i64>, Flat<'py, i64>)> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    let (normals, part, least) = (rows::<f64, 3>(&normals, "normals")?, flat(&part, "part")?, flat(&least, "least")?);
    expect_len("normals", normals.len(), triangles.len())?;
    expect_len("part", part.len(), triangles.len())?;
    expect_below("part", part.iter().copied(), least.len())?;
    expect_below("triangles", triangles.iter().flatten().copied(), points.len())?;
    let found = run(py, 0, triangles.len(), |_| low_ones(points, triangles, normals, &|t| least[part[t] as usize]))?;
    Ok((found.0.into_pyarray(py), found.1.into_pyarray(py)))
}

/// Kinds of the edges of bare parts, 255 for all others; and which of those are nearly creases. Cosines of folds: sharp,
/// near.
#[pyfunction]
pub fn edge_kinds<'py>(
    py: Python<'py>,
    offsets: PyReadonlyArray1<'py, i32>,
    fold: PyReadonlyArray1<'py, f64>,
    edge_part: PyReadonlyArray1<'py, i32>,
    bare: PyReadonlyArray1<'py, bool>,
    sharp: f64,
    near: f64,
) -> PyResult<(Flat<'py, u8>, Flat<'py, i64>)> {
    let (offsets, fold) = (flat(&offsets, "offsets")?, flat(&fold, "fold")?);
    let (edge_part, bare) = (flat(&edge_part, "edge_part")?, flat(&bare, "bare")?);
    expect_len("offsets", offsets.len(), fold.len() + 1)?;
    expect_len("edge_part", edge_part.len(), fold.len())?;
    expect_below("edge_part", edge_part.iter().copied(), bare.len())?;
    let found =
        run(py, 0, fold.len(), |_| kinds(offsets, fold, &|e| bare[edge_part[e] as usize], Limits { sharp, near }))?;
    Ok((found.0.into_pyarray(py), found.1.into_pyarray(py)))
}
