//! `edge_table` and `visibility` as Python sees them.

use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use super::running::run;
use hlr_exact::arithmetic::{Double, Exact, Single};
use hlr_exact::snap::Grid;
use hlr_mesh::stitch;
use hlr_mesh::topology;
use hlr_visibility::scan::mesh::{Mesh, Part};
use hlr_visibility::scan::own_faces::OwnFaces;
use hlr_visibility::scan::sweep::{self, Counters, Outcome, Seconds, Steps};

/// Rows of a C-contiguous (n, N) array.
pub fn rows<'a, T: numpy::Element, const N: usize>(
    array: &'a PyReadonlyArray2<'_, T>,
    name: &str,
) -> PyResult<&'a [[T; N]]> {
    let wrong = || PyValueError::new_err(format!("{name} must be a C-contiguous (n, {N}) array"));
    let slice = array.as_slice().map_err(|_| wrong())?;
    // An array in Fortran's order is contiguous as well, but its slice runs down the columns.
    if array.as_array().shape()[1] != N || !array.is_c_contiguous() {
        return Err(wrong());
    }
    let (rows, _) = slice.as_chunks::<N>();
    Ok(rows)
}

pub fn flat<'a, T: numpy::Element>(array: &'a PyReadonlyArray1<'_, T>, name: &str) -> PyResult<&'a [T]> {
    array.as_slice().map_err(|_| PyValueError::new_err(format!("{name} must be contiguous")))
}

pub fn expect_len(name: &str, found: usize, wanted: usize) -> PyResult<()> {
    if found == wanted {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("{name} has {found} entries, {wanted} are needed")))
}

pub fn expect_below(name: &str, values: impl Iterator<Item = i32> + Clone, limit: usize) -> PyResult<()> {
    // Without a sign negative ones are the largest: one number tells of all, without a branch for each.
    let largest = values.clone().fold(0u32, |most, v| most.max(v as u32));
    if (largest as usize) < limit {
        return Ok(());
    }
    match values.into_iter().find(|&v| v < 0 || v as usize >= limit) {
        Some(v) => Err(PyValueError::new_err(format!("{name} holds {v}, allowed are 0..{limit}"))),
        None => Ok(()),
    }
}

type StitchArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>, usize);
type EdgeArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>);

#[pyfunction]
pub fn edge_table<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<EdgeArrays<'py>> {
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), n_points)?;
    let t = run(py, 0, triangles.len(), |_| topology::topology(triangles, n_points))?;
    let n = t.edges.len();
    let edges = t.edges.into_flattened().into_pyarray(py).reshape([n, 2])?;
    Ok((edges, t.offsets.into_pyarray(py), t.incident.into_pyarray(py)))
}

#[pyfunction]
pub fn stitched<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    reach: f64,
) -> PyResult<StitchArrays<'py>> {
    let (points, triangles) = (rows::<f64, 3>(&points, "points")?, rows::<i32, 3>(&triangles, "triangles")?);
    expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
    let found = py.detach(|| stitch::stitch(points, triangles, reach));
    let n = found.triangles.len();
    let triangles = found.triangles.into_flattened().into_pyarray(py).reshape([n, 3])?;
    Ok((triangles, found.origin.into_pyarray(py), found.seams))
}

#[pyfunction]
pub fn components<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), n_points)?;
    Ok(topology::components(triangles, n_points).into_pyarray(py))
}

#[pyfunction]
pub fn edge_components<'py>(
    py: Python<'py>,
    edges: PyReadonlyArray2<'py, i32>,
    n_points: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let edges = rows::<i32, 2>(&edges, "edges")?;
    expect_below("edges", edges.as_flattened().iter().copied(), n_points)?;
    Ok(topology::components(edges, n_points).into_pyarray(py))
}

pub fn check_incidence(edges: usize, offsets: &[i32], incident: &[i32], triangles: usize) -> PyResult<()> {
    expect_len("offsets", offsets.len(), edges + 1)?;
    expect_below("incident", incident.iter().copied(), triangles)?;
    expect_below("offsets", offsets.iter().copied(), incident.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    Ok(())
}

type Pass = fn(&Mesh, Steps, &OwnFaces, &(dyn Fn() -> bool + Sync)) -> Option<Outcome>;

/// `own` of `visibility`: edge, range, line, beside, dented, offsets, face, off, triangle_face, sheet.
type Own<'py> = (
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, u8>,
    PyReadonlyArray1<'py, bool>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

fn own_faces<'a>(own: &'a Own<'_>, edges: usize, triangles: usize) -> PyResult<OwnFaces<'a>> {
    let (edge, range, line) =
        (flat(&own.0, "own edge")?, rows::<f64, 2>(&own.1, "own range")?, flat(&own.2, "own line")?);
    let (beside, dented) = (flat(&own.3, "own beside")?, flat(&own.4, "own dented")?);
    let (offsets, face, off) = (flat(&own.5, "own offsets")?, flat(&own.6, "own face")?, flat(&own.7, "own off")?);
    let (triangle_face, sheet) = (flat(&own.8, "triangle_face")?, flat(&own.9, "sheet")?);
    expect_len("own range", range.len(), edge.len())?;
    expect_len("own line", line.len(), edge.len())?;
    expect_len("own offsets", offsets.len(), edge.len() + 1)?;
    expect_len("own off", off.len(), face.len())?;
    expect_len("own beside", beside.len(), edge.len())?;
    expect_len("own dented", dented.len(), edge.len())?;
    expect_len("triangle_face", triangle_face.len(), triangles)?;
    expect_below("own edge", edge.iter().chain(line).chain(off).copied(), edges)?;
    expect_below("own offsets", offsets.iter().copied(), face.len() + 1)?;
    expect_below("triangle_face", triangle_face.iter().chain(face).copied(), sheet.len())?;
    if edge.windows(2).any(|w| w[0] > w[1]) || offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("own edge and own offsets must ascend"));
    }
    Ok(OwnFaces { edge, range, line, beside, dented, offsets, face, off, triangle_face, sheet, depth_scale: 1.0 })
}

#[pyfunction]
#[pyo3(signature = (points, triangles, triangle_part, edges, offsets, incident, edge_part, role, cull, sound, delta, cap, tight, threads = 0, arithmetic = "exact", crossings = true, piercings = true, pyramid = false, own = None))]
#[allow(clippy::too_many_arguments)] // one argument per array of the scene: the stub names them
pub fn visibility<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    triangle_part: PyReadonlyArray1<'py, i32>,
    edges: PyReadonlyArray2<'py, i32>,
    offsets: PyReadonlyArray1<'py, i32>,
    incident: PyReadonlyArray1<'py, i32>,
    edge_part: PyReadonlyArray1<'py, i32>,
    role: PyReadonlyArray1<'py, u8>,
    cull: PyReadonlyArray1<'py, bool>,
    sound: PyReadonlyArray1<'py, bool>,
    delta: PyReadonlyArray1<'py, f64>,
    cap: PyReadonlyArray1<'py, f64>,
    tight: PyReadonlyArray1<'py, bool>,
    threads: usize,
    arithmetic: &str,
    crossings: bool,
    piercings: bool,
    pyramid: bool,
    own: Option<Own<'py>>,
) -> PyResult<Bound<'py, PyDict>> {
    let pass: Pass = match arithmetic {
        "exact" => sweep::visibility_by::<Exact>,
        "f64" => sweep::visibility_by::<Double>,
        "f32" => sweep::visibility_by::<Single>,
        _ => return Err(PyValueError::new_err(format!("no arithmetic is called {arithmetic}: exact, f64 or f32"))),
    };
    let points = rows::<f64, 3>(&points, "points")?;
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    let edges = rows::<i32, 2>(&edges, "edges")?;
    let (triangle_part, edge_part) = (flat(&triangle_part, "triangle_part")?, flat(&edge_part, "edge_part")?);
    let (offsets, incident) = (flat(&offsets, "offsets")?, flat(&incident, "incident")?);
    let (role, cull, sound, delta) =
        (flat(&role, "role")?, flat(&cull, "cull")?, flat(&sound, "sound")?, flat(&delta, "delta")?);
    let (cap, tight) = (flat(&cap, "cap")?, flat(&tight, "tight")?);
    expect_len("cap", cap.len(), cull.len())?;
    expect_len("tight", tight.len(), cull.len())?;
    expect_len("triangle_part", triangle_part.len(), triangles.len())?;
    expect_len("edge_part", edge_part.len(), edges.len())?;
    expect_len("role", role.len(), edges.len())?;
    expect_len("sound", sound.len(), cull.len())?;
    expect_len("delta", delta.len(), cull.len())?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
    expect_below("edges", edges.as_flattened().iter().copied(), points.len())?;
    expect_below("triangle_part", triangle_part.iter().copied(), cull.len())?;
    expect_below("edge_part", edge_part.iter().copied(), cull.len())?;
    check_incidence(edges.len(), offsets, incident, triangles.len())?;
    let own = own.as_ref().map(|own| own_faces(own, edges.len(), triangles.len())).transpose()?;
    let outcome = run(py, threads, triangles.len(), |stopped| {
        let grid = Grid::around(points)?.with_room(delta.iter().copied().fold(0.0, f64::max));
        let mesh = Mesh {
            points: points.par_iter().with_min_len(1 << 13).map(|p| grid.snap(p)).collect(),
            triangles,
            triangle_part,
            edges,
            offsets,
            incident,
            edge_part,
            role,
            parts: (0..cull.len())
                .map(|p| Part {
                    cull: cull[p],
                    sound: sound[p],
                    delta: grid.delta(delta[p]),
                    cap: grid.delta(cap[p]),
                    tight: tight[p],
                })
                .collect(),
        };
        let own = own.map_or(OwnFaces::NONE, |own| OwnFaces { depth_scale: grid.scale_z / grid.scale_xy, ..own });
        Some(pass(&mesh, Steps { crossings, piercings, pyramid }, &own, stopped))
    })?;
    let Some(outcome) = outcome else {
        return Err(PyValueError::new_err("points hold coordinates that are not finite"));
    };
    let outcome = outcome.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    let out = PyDict::new(py);
    let pieces = &outcome.pieces;
    out.set_item("edge", pieces.iter().map(|p| p.edge as i32).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("t0", pieces.iter().map(|p| p.segment.start).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("t1", pieces.iter().map(|p| p.segment.end).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("state", pieces.iter().map(|p| p.segment.state as u8).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("facing", outcome.facing.into_pyarray(py))?;
    out.set_item("counters", counters(py, &outcome.counters)?)?;
    out.set_item("seconds", seconds(py, &outcome.seconds)?)?;
    Ok(out)
}

fn seconds<'py>(py: Python<'py>, s: &Seconds) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for (name, value) in [
        ("tables", s.tables),
        ("pyramid", s.pyramid),
        ("seeds", s.seeds),
        ("crossings", s.crossings),
        ("piercings", s.piercings),
        ("counting", s.counting),
        ("own_faces", s.own_faces),
    ] {
        out.set_item(name, value)?;
    }
    Ok(out)
}

fn counters<'py>(py: Python<'py>, c: &Counters) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for (name, value) in [
        ("triangles", c.triangles),
        ("culled", c.culled),
        ("contours", c.contours),
        ("drawn", c.drawn),
        ("hidden_by_culling", c.hidden_by_culling),
        ("projecting", c.projecting),
        ("bands", c.bands),
        ("seeds", c.seeds),
        ("crossing_tests", c.crossing_tests),
        ("crossings", c.crossings),
        ("piercing_parts", c.piercing_parts),
        ("piercing_tests", c.piercing_tests),
        ("piercings", c.piercings),
        ("failed_checks", c.failed_checks),
        ("contradictions", c.contradictions),
        ("by_culling_alone", c.by_culling_alone),
        ("pyramid_parts", c.pyramid_parts),
        ("hidden_by_pyramid", c.hidden_by_pyramid),
        ("freed_of_own_faces", c.freed_of_own_faces),
    ] {
        out.set_item(name, value)?;
    }
    Ok(out)
}
