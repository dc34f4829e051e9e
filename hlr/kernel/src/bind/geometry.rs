//! Curves of B-rep edges and surfaces of faces as Python sees them.

use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_below, expect_len, flat, rows};
use crate::lines::View;
use crate::paper::arc::grow;
use crate::paper::junction::{Border, Goal, Move, Route, junctions};
use crate::paper::project::{Projection, Vec2};
use crate::paper::shared_end::share_ends;
use crate::paper::{Drawn, Form, Placed, located, piece};
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::curve::Vec3;
use hlr_brep::geometry::surface::Surface;

/// Curves from packed records; None where a record makes none.
pub fn curves(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<Vec<Option<Curve>>> {
    expect_records(kind, offsets, values)?;
    let record = |i: usize| Curve::from_record(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
    Ok((0..kind.len()).map(record).collect())
}

fn expect_records(kind: &[u8], offsets: &[i32], values: &[f64]) -> PyResult<()> {
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_below("offsets", offsets.iter().copied(), values.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    Ok(())
}

#[pyfunction]
pub fn curve_points<'py>(
    py: Python<'py>,
    kind: PyReadonlyArray1<'py, u8>,
    offsets: PyReadonlyArray1<'py, i32>,
    values: PyReadonlyArray1<'py, f64>,
    which: PyReadonlyArray1<'py, i32>,
    parameters: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let curves = curves(flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?)?;
    let (which, parameters) = (flat(&which, "which")?, flat(&parameters, "parameters")?);
    expect_len("parameters", parameters.len(), which.len())?;
    expect_below("which", which.iter().copied(), curves.len())?;
    let found = run(py, 0, which.len(), |_| {
        let at = |(&i, &t): (&i32, &f64)| curves[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |c| c.derivatives(t));
        which.par_iter().zip(parameters).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}

/// (n, 3, 3): point, du and dv of surfaces `which` at (u, v); NaN where a record makes no surface.
#[pyfunction]
pub fn surface_points<'py>(
    py: Python<'py>,
    kind: PyReadonlyArray1<'py, u8>,
    offsets: PyReadonlyArray1<'py, i32>,
    values: PyReadonlyArray1<'py, f64>,
    which: PyReadonlyArray1<'py, i32>,
    uv: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let (kind, offsets, values) = (flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?);
    expect_records(kind, offsets, values)?;
    let (which, uv) = (flat(&which, "which")?, rows::<f64, 2>(&uv, "uv")?);
    expect_len("uv", uv.len(), which.len())?;
    expect_below("which", which.iter().copied(), kind.len())?;
    let found = run(py, 0, which.len(), |_| {
        let read = |i: usize| Surface::read(kind[i], &values[offsets[i] as usize..offsets[i + 1] as usize]);
        let surfaces: Vec<Option<Surface>> = (0..kind.len()).into_par_iter().map(read).collect();
        let at = |(&i, &place): (&i32, &[f64; 2])| {
            surfaces[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |s| {
                let (point, du, dv) = s.d1(place);
                [point, du, dv]
            })
        };
        which.par_iter().zip(uv).map(at).collect::<Vec<_>>()
    })?;
    let n = found.len();
    found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
}

type Vec4 = [f64; 4];

/// Forms of lines, as `hlr.curve` reads them.
const POLYLINE: u8 = 0;
const STRAIGHT: u8 = 1;
const ARC: u8 = 2;
const QUADRATIC: u8 = 3;
const CUBIC: u8 = 4;

#[pyfunction]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn true_lines<'py>(
    py: Python<'py>,
    kind: PyReadonlyArray1<'py, u8>,
    ranges: PyReadonlyArray2<'py, f64>,
    offsets: PyReadonlyArray1<'py, i32>,
    values: PyReadonlyArray1<'py, f64>,
    places: PyReadonlyArray3<'py, f64>,
    projection: [Vec4; 3],
    line_curve: PyReadonlyArray1<'py, i32>,
    line_place: PyReadonlyArray1<'py, i32>,
    line_offsets: PyReadonlyArray1<'py, i32>,
    flat_points: PyReadonlyArray2<'py, f64>,
    space_points: PyReadonlyArray2<'py, f64>,
    line_chain: PyReadonlyArray1<'py, i32>,
    line_visible: PyReadonlyArray1<'py, bool>,
    line_border: PyReadonlyArray1<'py, u8>,
    line_bulge: PyReadonlyArray1<'py, f64>,
    eye: [f64; 3],
    away: [f64; 3],
    accuracy: f64,
    model: f64,
    contact: f64,
    threads: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let curves = curves(flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&values, "values")?)?;
    let ranges = rows::<f64, 2>(&ranges, "ranges")?;
    expect_len("ranges", ranges.len(), curves.len())?;
    let wrong = || PyValueError::new_err("places must be a C-contiguous (n, 3, 4) array");
    if places.as_array().shape()[1..] != [3, 4] {
        return Err(wrong());
    }
    let places = places.as_slice().map_err(|_| wrong())?.as_chunks::<4>().0.as_chunks::<3>().0;
    let (line_curve, line_place) = (flat(&line_curve, "line_curve")?, flat(&line_place, "line_place")?);
    let line_offsets = flat(&line_offsets, "line_offsets")?;
    let flat_points = rows::<f64, 2>(&flat_points, "flat_points")?;
    let space_points = rows::<f64, 3>(&space_points, "space_points")?;
    let n = line_curve.len();
    let (line_chain, line_visible) = (flat(&line_chain, "line_chain")?, flat(&line_visible, "line_visible")?);
    let line_border = flat(&line_border, "line_border")?;
    let line_bulge = flat(&line_bulge, "line_bulge")?;
    expect_len("line_border", line_border.len(), n)?;
    expect_len("line_bulge", line_bulge.len(), n)?;
    expect_len("line_place", line_place.len(), n)?;
    expect_len("line_chain", line_chain.len(), n)?;
    expect_len("line_visible", line_visible.len(), n)?;
    expect_len("line_offsets", line_offsets.len(), n + 1)?;
    expect_len("space_points", space_points.len(), flat_points.len())?;
    expect_below("line_offsets", line_offsets.iter().copied(), flat_points.len() + 1)?;
    expect_below("line_curve", line_curve.iter().copied().filter(|&c| c >= 0), curves.len())?;
    expect_below("line_place", line_place.iter().copied(), places.len())?;
    if line_offsets.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("line_offsets must ascend"));
    }
    let points = |i: usize| line_offsets[i] as usize..line_offsets[i + 1] as usize;
    let found = run(py, threads, flat_points.len(), |_| {
        let projection = Projection(projection);
        // Lines of one curve in one place share its search table.
        let mut order: Vec<u32> = (0..n as u32).filter(|&i| line_curve[i as usize] >= 0).collect();
        order.sort_by_key(|&i| (line_curve[i as usize], line_place[i as usize], i));
        let same = |a: &u32, b: &u32| {
            let (a, b) = (*a as usize, *b as usize);
            line_curve[a] == line_curve[b] && line_place[a] == line_place[b]
        };
        let groups: Vec<&[u32]> = order.chunk_by(same).collect();
        let stand: Vec<Option<Placed>> = groups
            .par_iter()
            .map(|group| {
                let (c, p) = (line_curve[group[0] as usize] as usize, line_place[group[0] as usize] as usize);
                let curve = curves[c].as_ref()?.moved(&places[p]);
                Some(Placed::new(curve, ranges[c], &projection, model))
            })
            .collect();
        let mut placed: Vec<Option<&Placed>> = vec![None; n];
        for (group, stand) in groups.iter().zip(&stand) {
            group.iter().for_each(|&i| placed[i as usize] = stand.as_ref());
        }
        let mut routes: Vec<Route> = (0..n)
            .into_par_iter()
            .map(|i| {
                let (flat, space) = (&flat_points[points(i)], &space_points[points(i)]);
                let bulge = line_bulge[i];
                let curve = placed[i].and_then(|p| Some((p, located(p, flat, space, accuracy, bulge)?)));
                let bulge = if curve.is_some() { bulge } else { 0.0 };
                let border = match line_border[i] {
                    0 => Border::None,
                    1 => Border::Edge,
                    _ => Border::Outline,
                };
                let (chain, visible) = (line_chain[i], line_visible[i]);
                Route { chain, visible, border, flat, space, curve, bulge }
            })
            .collect();
        let view = View { origin: eye, away, perspective: !projection.parallel() };
        let moves = junctions(&routes, accuracy, contact, &view);
        // Ends of polylines that move; those of curves move with their interval.
        let mut moved: Vec<[Option<(Vec2, Vec3)>; 2]> = vec![[None; 2]; n];
        for Move { line, end, to } in moves {
            match (&mut routes[line].curve, to) {
                (Some((_, ts)), Goal::Parameter(t)) => {
                    let at = end * (ts.len() - 1);
                    let rest = ts[ts.len() - 1 - at];
                    // Never past the other end.
                    if (ts[at] - rest) * (t - rest) > 0.0 {
                        ts[at] = t;
                    }
                }
                (None, Goal::Point(flat, space)) => moved[line][end] = Some((flat, space)),
                _ => {}
            }
        }
        let mut drawn: Vec<Option<Drawn>> = routes
            .par_iter()
            .map(|route| {
                let (p, ts) = route.curve.as_ref()?;
                piece(p, [ts[0], ts[ts.len() - 1]], accuracy)
            })
            .collect();
        share_ends(&routes, &mut drawn, accuracy);
        let tracks = routes.into_iter().map(|route| route.curve.map_or(Vec::new(), |(_, ts)| ts));
        (drawn.into_iter().zip(tracks).collect::<Vec<_>>(), moved)
    })?;
    let (found, moved) = found;
    let (mut form, mut data_offsets, mut data) = (Vec::with_capacity(n), vec![0i32], Vec::<f64>::new());
    let (mut ends, mut space_ends, mut bounds) =
        (Vec::with_capacity(4 * n), Vec::with_capacity(6 * n), Vec::<f64>::with_capacity(4 * n));
    let mut intervals = Vec::with_capacity(2 * n);
    let mut inner = Vec::with_capacity(2 * n);
    for (i, (line, ts)) in found.iter().enumerate() {
        // A line that turns back over itself on paper is drawn between its extremes, without the points beyond them.
        let all = points(i).len() as i32;
        inner.extend(line.as_ref().map_or([0, all], |line| {
            let (low, high) = (line.range[0].min(line.range[1]), line.range[0].max(line.range[1]));
            let inside = |t: &f64| *t > low && *t < high;
            let first = ts.iter().position(inside).unwrap_or(0) as i32;
            [first, ts.iter().rposition(inside).map_or(first, |k| k as i32 + 1)]
        }));
        let Some(line) = line else {
            form.push(POLYLINE);
            data_offsets.push(data.len() as i32);
            let at = points(i);
            let mut low_high = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
            flat_points[at.clone()].iter().for_each(|p| grow(&mut low_high, p));
            let none = ([f64::NAN; 2], [f64::NAN; 3]);
            let end = |k: Option<usize>| k.map_or(none, |k| (flat_points[k], space_points[k]));
            for (k, (p, q)) in [end(at.clone().next()), end(at.last())].into_iter().enumerate() {
                let (p, q) = moved[i][k].unwrap_or((p, q));
                if p[0].is_finite() {
                    grow(&mut low_high, &p);
                }
                ends.extend(p);
                space_ends.extend(q);
            }
            bounds.extend(low_high.as_flattened());
            intervals.extend([f64::NAN; 2]);
            continue;
        };
        form.push(match &line.form {
            Form::Straight => STRAIGHT,
            Form::Arc(ellipse, angles) => {
                data.extend(ellipse.centre);
                data.extend(ellipse.axes.as_flattened());
                data.extend(angles);
                ARC
            }
            Form::Chain(chain) => {
                data.extend(chain.points.as_flattened());
                if chain.degree == 2 { QUADRATIC } else { CUBIC }
            }
        });
        data_offsets.push(data.len() as i32);
        ends.extend(line.flat.as_flattened());
        space_ends.extend(line.space.as_flattened());
        bounds.extend(line.bounds.as_flattened());
        intervals.extend(line.range);
    }
    let out = PyDict::new(py);
    out.set_item("form", form.into_pyarray(py))?;
    out.set_item("offsets", data_offsets.into_pyarray(py))?;
    out.set_item("data", data.into_pyarray(py))?;
    out.set_item("interval", intervals.into_pyarray(py).reshape([n, 2])?)?;
    out.set_item("inner", inner.into_pyarray(py).reshape([n, 2])?)?;
    out.set_item("flat", ends.into_pyarray(py).reshape([n, 2, 2])?)?;
    out.set_item("space", space_ends.into_pyarray(py).reshape([n, 2, 3])?)?;
    out.set_item("bounds", bounds.into_pyarray(py).reshape([n, 2, 2])?)?;
    Ok(out)
}
