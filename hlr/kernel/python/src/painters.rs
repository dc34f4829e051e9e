//! Binding of the painters' lists, the counters and the quadrics of the visible-surface methods.

use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use hlr_methods::bsp::Tree;
use hlr_methods::clip::{Corner, clip_loop, walls};
use hlr_methods::limits::Watch;
use hlr_methods::plane::STEPS;
use hlr_methods::scene::Camera;
use hlr_methods::screen::Screen;
use hlr_methods::statistics::Statistics;
use hlr_methods::view::View;
use hlr_methods::{depth_sort, quadric};

/// Polygons in the order of drawing, each with its loops in pixels.
pub type Listed = Vec<(u32, Vec<Vec<[f64; 2]>>)>;

pub fn sorted_list(on: &Screen, watch: &Watch, statistics: &mut Statistics) -> Option<Listed> {
    let pixels = |p: &[f64; 3]| [p[0] / STEPS as f64, p[1] / STEPS as f64];
    let ordered = depth_sort::order(on, watch, statistics)?;
    let listed = ordered.pieces.iter().map(|piece| {
        let loops = piece.loops.iter().map(|l| l.iter().map(pixels).collect()).collect();
        (on.facets[piece.facet as usize].id, loops)
    });
    Some(listed.collect())
}

/// The fragments of the tree, each clipped by the view volume, in the plane of the picture.
pub fn tree_list(tree: &Tree, camera: &Camera, watch: &Watch) -> Option<Listed> {
    let view = View::new(&tree.origin, camera)?;
    let walls = walls(camera, 1e6);
    let mut out = Vec::new();
    tree.order(&view, watch, |f| {
        let fragment = &tree.fragments[f as usize];
        let (mut loops, mut next) = (Vec::new(), Vec::new());
        for l in &fragment.loops {
            let mut corners: Vec<Corner> =
                l.iter().map(|p| Corner { at: camera.project(&tree.in_model(p)), value: [0.0; 3] }).collect();
            for wall in &walls {
                clip_loop(&corners, wall, &mut next);
                std::mem::swap(&mut corners, &mut next);
            }
            if corners.len() > 2 {
                loops.push(corners.iter().map(|c| [c.at[0] / c.at[3], c.at[1] / c.at[3]]).collect());
            }
        }
        if !loops.is_empty() {
            out.push((fragment.polygon, loops));
        }
    })?;
    Some(out)
}

pub fn counted<'py>(py: Python<'py>, s: &Statistics, prepared: f64, seconds: f64) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for (name, count) in [
        ("polygons", s.polygons),
        ("culled", s.culled),
        ("clipped", s.clipped),
        ("triangulated", s.triangulated),
        ("edge_on", s.edge_on),
        ("facets", s.facets),
        ("comparisons", s.comparisons),
        ("exact", s.exact),
        ("spans", s.spans),
        ("written", s.written),
        ("splits", s.splits),
        ("recursion", s.recursion),
        ("deepest", s.deepest),
        ("early_stops", s.early_stops),
        ("passed_over", s.passed_over),
        ("rays", s.rays),
        ("box_tests", s.box_tests),
        ("polygon_tests", s.polygon_tests),
        ("swaps", s.swaps),
        ("edge_starts", s.edge_starts),
        ("edge_ends", s.edge_ends),
        ("span_starts", s.span_starts),
        ("span_ends", s.span_ends),
        ("settled", s.settled),
        ("memory", s.memory),
    ] {
        out.set_item(name, count)?;
    }
    out.set_item("prepared", prepared)?;
    out.set_item("setup", s.setup)?;
    out.set_item("seconds", seconds)?;
    Ok(out)
}

/// Floors of a quadric's nearer depths in a row, i64::MIN where it is missed; and the number of corrections.
#[pyfunction]
pub fn quadric_row<'py>(
    py: Python<'py>,
    coefficients: [i64; 10],
    x0: i64,
    y: i64,
    count: usize,
) -> PyResult<(Bound<'py, PyArray1<i64>>, u64)> {
    const MOST: i64 = 1 << 20;
    if coefficients[2] <= 0 || coefficients.iter().any(|c| c.abs() > MOST * MOST) || x0.abs().max(y.abs()) > MOST {
        return Err(PyValueError::new_err("a quadric needs c > 0, coefficients up to 2^40 and coordinates up to 2^20"));
    }
    if count as i64 > 2 * MOST || x0 + count as i64 > MOST {
        return Err(PyValueError::new_err("a row of a quadric ends at column 2^20"));
    }
    let (depths, corrections) = py.detach(|| quadric::row(&coefficients, x0, y, count));
    let depths: Vec<i64> = depths.into_iter().map(|z| z.unwrap_or(i64::MIN)).collect();
    Ok((depths.into_pyarray(py), corrections))
}
