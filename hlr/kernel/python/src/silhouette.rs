//! `silhouettes` as Python sees it.

use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::running::run;
use super::scan::{check_incidence, expect_below, expect_len, flat, rows};
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;
use hlr_linework::lines::View;
use hlr_linework::silhouette::trace::{Traced, trace};
use hlr_linework::silhouette::{FaceRecord, Model};

const TURN: [f64; 2] = [0.0, std::f64::consts::TAU];

#[pyfunction]
#[pyo3(signature = (points, triangles, triangle_face, edges, offsets, incident, smooth, source, corner, uv, face_surface,
    face_place, face_inward, face_curved, surface_kind, surface_offsets, surface_data, perspective, eye, away, chord,
    threads = 0))]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn silhouettes<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    triangle_face: PyReadonlyArray1<'py, i32>,
    edges: PyReadonlyArray2<'py, i32>,
    offsets: PyReadonlyArray1<'py, i32>,
    incident: PyReadonlyArray1<'py, i32>,
    smooth: PyReadonlyArray1<'py, bool>,
    source: PyReadonlyArray1<'py, i32>,
    corner: PyReadonlyArray2<'py, i32>,
    uv: PyReadonlyArray2<'py, f64>,
    face_surface: PyReadonlyArray1<'py, i32>,
    face_place: PyReadonlyArray2<'py, f64>,
    face_inward: PyReadonlyArray1<'py, bool>,
    face_curved: PyReadonlyArray1<'py, bool>,
    surface_kind: PyReadonlyArray1<'py, u8>,
    surface_offsets: PyReadonlyArray1<'py, i32>,
    surface_data: PyReadonlyArray1<'py, f64>,
    perspective: bool,
    eye: [f64; 3],
    away: [f64; 3],
    chord: f64,
    threads: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let points = rows::<f64, 3>(&points, "points")?;
    let triangles = rows::<i32, 3>(&triangles, "triangles")?;
    let triangle_face = flat(&triangle_face, "triangle_face")?;
    let edges = rows::<i32, 2>(&edges, "edges")?;
    let (offsets, incident) = (flat(&offsets, "offsets")?, flat(&incident, "incident")?);
    let (smooth, source) = (flat(&smooth, "smooth")?, flat(&source, "source")?);
    let corner = rows::<i32, 3>(&corner, "corner")?;
    let uv = rows::<f64, 2>(&uv, "uv")?;
    let (face_surface, face_place) =
        (flat(&face_surface, "face_surface")?, rows::<f64, 12>(&face_place, "face_place")?);
    let (inward, curved) = (flat(&face_inward, "face_inward")?, flat(&face_curved, "face_curved")?);
    let (kind, at) = (flat(&surface_kind, "surface_kind")?, flat(&surface_offsets, "surface_offsets")?);
    let data = flat(&surface_data, "surface_data")?;
    expect_len("triangle_face", triangle_face.len(), triangles.len())?;
    expect_len("corner", corner.len(), triangles.len())?;
    expect_len("smooth", smooth.len(), edges.len())?;
    expect_len("source", source.len(), edges.len())?;
    for (name, found) in
        [("face_place", face_place.len()), ("face_inward", inward.len()), ("face_curved", curved.len())]
    {
        expect_len(name, found, face_surface.len())?;
    }
    expect_len("surface_offsets", at.len(), kind.len() + 1)?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
    expect_below("edges", edges.as_flattened().iter().copied(), points.len())?;
    expect_below("triangle_face", triangle_face.iter().copied(), face_surface.len())?;
    expect_below("surface_offsets", at.iter().copied(), data.len() + 1)?;
    check_incidence(edges.len(), offsets, incident, triangles.len())?;
    if at.windows(2).any(|w| w[0] > w[1]) || chord.is_nan() || chord <= 0.0 {
        return Err(PyValueError::new_err("surface_offsets must ascend, chord must be positive"));
    }
    let surfaces: Vec<Option<Surface>> =
        (0..kind.len()).map(|i| Surface::read(kind[i], &data[at[i] as usize..at[i + 1] as usize])).collect();
    let faces: Vec<FaceRecord> = (0..face_surface.len())
        .map(|i| {
            let m = &face_place[i];
            let row = |k: usize| [m[4 * k], m[4 * k + 1], m[4 * k + 2], m[4 * k + 3]];
            let surface =
                u32::try_from(face_surface[i]).ok().filter(|&s| surfaces.get(s as usize).is_some_and(Option::is_some));
            FaceRecord {
                surface,
                place: [row(0), row(1), row(2)],
                sign: if inward[i] { -1.0 } else { 1.0 },
                curved: curved[i],
            }
        })
        .collect();
    let traced: Vec<bool> = faces.iter().map(|f| f.surface.is_some()).collect();
    for (corners, &face) in corner.iter().zip(triangle_face) {
        if traced[face as usize] {
            expect_below("corner", corners.iter().copied(), uv.len())?;
        }
    }
    let view = View { origin: eye, away, perspective };
    let model = Model {
        points,
        triangles,
        triangle_face,
        edges,
        offsets,
        incident,
        smooth,
        source,
        corner,
        uv,
        faces,
        surfaces,
        view,
        chord,
    };
    let Traced { silhouettes: found, grazing } =
        run(py, threads, model.triangles.len(), |stopped| trace(&model, stopped))?
            .ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    let mut starts = vec![0i32];
    let (mut flat_points, mut normals, mut rise) = (Vec::<f64>::new(), Vec::<f64>::new(), Vec::<f64>::new());
    for s in &found {
        flat_points.extend(s.points.iter().flatten());
        normals.extend(s.normals.iter().flatten());
        rise.extend(&s.rise);
        starts.push((flat_points.len() / 3) as i32);
    }
    let (mut curve_kind, mut curve_range, mut curve_starts, mut curve_values) = (vec![], vec![], vec![0i32], vec![]);
    for s in &found {
        let range =
            s.curve.as_ref().map_or([0.0; 2], |c| if let Curve::Spline(n) = c { n.domain().into() } else { TURN });
        curve_kind.push(s.curve.as_ref().map_or(0, |c| c.record(&mut curve_values)));
        curve_range.extend(range);
        curve_starts.push(curve_values.len() as i32);
    }
    let n = flat_points.len() / 3;
    let out = PyDict::new(py);
    out.set_item("offsets", starts.into_pyarray(py))?;
    out.set_item("points", flat_points.into_pyarray(py).reshape([n, 3])?)?;
    out.set_item("normals", normals.into_pyarray(py).reshape([n, 3])?)?;
    out.set_item("face", found.iter().map(|s| s.face).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("source", found.iter().map(|s| s.source).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("curve_kind", curve_kind.into_pyarray(py))?;
    out.set_item("curve_range", curve_range.into_pyarray(py).reshape([found.len(), 2])?)?;
    out.set_item("curve_offsets", curve_starts.into_pyarray(py))?;
    out.set_item("curve_values", curve_values.into_pyarray(py))?;
    out.set_item("concave", found.iter().map(|s| s.concave).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("rise", rise.into_pyarray(py))?;
    let k = grazing.len();
    let range: Vec<f64> = grazing.iter().flat_map(|g| g.range).collect();
    let normals_there: Vec<f64> = grazing.iter().flat_map(|g| g.normals).flatten().collect();
    out.set_item("grazing_edge", grazing.iter().map(|g| g.edge as i32).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("grazing_range", range.into_pyarray(py).reshape([k, 2])?)?;
    out.set_item("grazing_face", grazing.iter().map(|g| g.face).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("grazing_normals", normals_there.into_pyarray(py).reshape([k, 2, 3])?)?;
    out.set_item("grazing_dented", grazing.iter().map(|g| g.dented).collect::<Vec<_>>().into_pyarray(py))?;
    let rises: Vec<f64> = grazing.iter().flat_map(|g| g.rise.unwrap_or([-1.0; 2])).collect();
    out.set_item("grazing_rise", rises.into_pyarray(py).reshape([k, 2])?)?;
    out.set_item("grazing_beside", grazing.iter().map(|g| g.beside as u8).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("grazing_front", grazing.iter().map(|g| g.front).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("traced", traced.into_pyarray(py))?;
    Ok(out)
}
