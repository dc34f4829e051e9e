//! Binding of `hlr_mesh::measure`: nearest segments, blocked rays and what rays meet first.

use std::collections::HashMap;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};
use super::threads::run;
use hlr_mesh::measure::nearest::{Segment, Segments};
use hlr_mesh::measure::rays::Caster;

#[pyfunction]
#[allow(clippy::type_complexity)] // what it gives is two arrays
pub fn nearest<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    point_key: PyReadonlyArray1<'py, i32>,
    segments: PyReadonlyArray2<'py, f64>,
    segment_key: PyReadonlyArray1<'py, i32>,
    most: f64,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i32>>)> {
    let points = rows::<f64, 2>(&points, "points")?;
    let keys = flat(&point_key, "point_key")?;
    expect_len("point_key", keys.len(), points.len())?;
    let ends = rows::<f64, 4>(&segments, "segments")?;
    let owner = flat(&segment_key, "segment_key")?;
    expect_len("segment_key", owner.len(), ends.len())?;
    let (distance, number) = run(py, usize::MAX, |stopped| {
        let mut order: Vec<u32> = (0..ends.len() as u32).collect();
        order.sort_by_key(|&i| (owner[i as usize], i));
        let sorted: Vec<Segment> =
            order.iter().map(|&i| ends[i as usize]).map(|[a, b, c, d]| [[a, b], [c, d]]).collect();
        let mut first = 0;
        let mut ranges = Vec::new();
        for group in order.chunk_by(|&a, &b| owner[a as usize] == owner[b as usize]) {
            ranges.push((owner[group[0] as usize], first));
            first += group.len();
        }
        let trees: HashMap<i32, (usize, Segments)> = ranges
            .par_iter()
            .enumerate()
            .map(|(k, &(key, first))| {
                let end = ranges.get(k + 1).map_or(sorted.len(), |r| r.1);
                (key, (first, Segments::new(&sorted[first..end])))
            })
            .collect();
        let found: Vec<(f64, i32)> = points
            .par_iter()
            .zip(keys)
            .map(|(p, key)| {
                let Some((first, tree)) = trees.get(key).filter(|_| !stopped()) else { return (f64::INFINITY, -1) };
                let (d, i) = tree.nearest(p, most);
                (d, if i == u32::MAX { -1 } else { order[first + i as usize] as i32 })
            })
            .collect();
        found.into_iter().unzip::<f64, i32, Vec<_>, Vec<_>>()
    })?;
    Ok((distance.into_pyarray(py), number.into_pyarray(py)))
}

#[pyfunction]
pub fn blocked<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    origins: PyReadonlyArray2<'py, f64>,
    ways: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let found = cast(py, [&points, &origins, &ways], &triangles, |caster, o, w| caster.is_blocked(o, w))?;
    Ok(found.into_pyarray(py))
}

#[pyfunction]
#[allow(clippy::type_complexity)] // what it gives is two arrays
pub fn first_hits<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    origins: PyReadonlyArray2<'py, f64>,
    ways: PyReadonlyArray2<'py, f64>,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i32>>)> {
    let found = cast(py, [&points, &origins, &ways], &triangles, |caster, o, w| {
        caster.first(o, w).map_or((f64::INFINITY, -1), |(t, i)| (t, i as i32))
    })?;
    let (share, triangle): (Vec<f64>, Vec<i32>) = found.into_iter().unzip();
    Ok((share.into_pyarray(py), triangle.into_pyarray(py)))
}

/// What `of` says of each ray; the arrays are points of the mesh, origins and ways of the rays.
fn cast<T: Send + Default>(
    py: Python<'_>,
    [points, origins, ways]: [&PyReadonlyArray2<'_, f64>; 3],
    triangles: &PyReadonlyArray2<'_, i32>,
    of: impl Fn(&Caster, &[f64; 3], &[f64; 3]) -> T + Sync,
) -> PyResult<Vec<T>> {
    let points = rows::<f64, 3>(points, "points")?;
    let triangles = rows::<i32, 3>(triangles, "triangles")?;
    expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
    let (origins, ways) = (rows::<f64, 3>(origins, "origins")?, rows::<f64, 3>(ways, "ways")?);
    expect_len("ways", ways.len(), origins.len())?;
    run(py, usize::MAX, |stopped| {
        let caster = Caster::new(points, triangles);
        let one = |(o, w)| if stopped() { T::default() } else { of(&caster, o, w) };
        origins.par_iter().zip(ways).map(one).collect()
    })
}
