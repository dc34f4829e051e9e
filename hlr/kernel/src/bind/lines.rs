//! `chain` and `linework` as Python sees them.

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use super::running::run;
use super::scan::{expect_below, expect_len, flat, rows};
use crate::lines::chain::{Straight, chain as chain_edges};
use crate::lines::cover::{Widths, uncovered};
use crate::lines::ends::Ends;
use crate::lines::runs::{Geometry, Limits, Piece, cut};
use crate::lines::simplify::simplify;
use crate::lines::specks::drop_specks;
use crate::lines::{Polyline, View, distance};
use crate::paper::bezier::Chain;
use crate::paper::smooth::smooth;
use crate::scan::invisibility::State;

type ChainArrays<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<bool>>);

#[pyfunction]
#[pyo3(signature = (edges, key, points = None, turn = 0.0))]
pub fn chain<'py>(
    py: Python<'py>,
    edges: PyReadonlyArray2<'py, i32>,
    key: PyReadonlyArray1<'py, i32>,
    points: Option<PyReadonlyArray2<'py, f64>>,
    turn: f64,
) -> PyResult<ChainArrays<'py>> {
    let (edges, key) = (rows::<i32, 2>(&edges, "edges")?, flat(&key, "key")?);
    expect_len("key", key.len(), edges.len())?;
    let points = points.as_ref().map(|p| rows::<f64, 3>(p, "points")).transpose()?;
    if let Some(points) = points {
        expect_below("edges", edges.iter().flatten().copied(), points.len())?;
    }
    let straight = points.map(|points| Straight { points, turn: turn.to_radians() });
    let c = chain_edges(edges, key, straight.as_ref());
    Ok((c.offsets.into_pyarray(py), c.order.into_pyarray(py), c.reversed.into_pyarray(py)))
}

#[pyfunction]
#[pyo3(signature = (flat_points, space_points, perspective, eye, away, edges, piece_edge, piece_t0, piece_t1, piece_state,
    chain_offsets, chain_edges, chain_reversed, chain_rank, chain_noisy, chain_bare, accuracy, short, flip, stub, width, under, flat_tolerance, space_tolerance,
    threads = 0))]
#[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
pub fn linework<'py>(
    py: Python<'py>,
    flat_points: PyReadonlyArray2<'py, f64>,
    space_points: PyReadonlyArray2<'py, f64>,
    perspective: bool,
    eye: [f64; 3],
    away: [f64; 3],
    edges: PyReadonlyArray2<'py, i32>,
    piece_edge: PyReadonlyArray1<'py, i32>,
    piece_t0: PyReadonlyArray1<'py, f64>,
    piece_t1: PyReadonlyArray1<'py, f64>,
    piece_state: PyReadonlyArray1<'py, u8>,
    chain_offsets: PyReadonlyArray1<'py, i32>,
    chain_edges: PyReadonlyArray1<'py, i32>,
    chain_reversed: PyReadonlyArray1<'py, bool>,
    chain_rank: PyReadonlyArray1<'py, u8>,
    chain_noisy: PyReadonlyArray1<'py, bool>,
    chain_bare: PyReadonlyArray1<'py, bool>,
    accuracy: f64,
    short: f64,
    flip: f64,
    stub: f64,
    width: f64,
    under: f64,
    flat_tolerance: f64,
    space_tolerance: f64,
    threads: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let flat_points = rows::<f64, 2>(&flat_points, "flat_points")?;
    let space_points = rows::<f64, 3>(&space_points, "space_points")?;
    let edges = rows::<i32, 2>(&edges, "edges")?;
    let piece_edge = flat(&piece_edge, "piece_edge")?;
    let (piece_t0, piece_t1, piece_state) =
        (flat(&piece_t0, "piece_t0")?, flat(&piece_t1, "piece_t1")?, flat(&piece_state, "piece_state")?);
    let (offsets, members) = (flat(&chain_offsets, "chain_offsets")?, flat(&chain_edges, "chain_edges")?);
    let (reversed, rank) = (flat(&chain_reversed, "chain_reversed")?, flat(&chain_rank, "chain_rank")?);
    expect_len("space_points", space_points.len(), flat_points.len())?;
    for (name, found) in
        [("piece_t0", piece_t0.len()), ("piece_t1", piece_t1.len()), ("piece_state", piece_state.len())]
    {
        expect_len(name, found, piece_edge.len())?;
    }
    let noisy = flat(&chain_noisy, "chain_noisy")?;
    let bare = flat(&chain_bare, "chain_bare")?;
    expect_len("chain_noisy", noisy.len(), rank.len())?;
    expect_len("chain_bare", bare.len(), rank.len())?;
    expect_len("chain_reversed", reversed.len(), members.len())?;
    expect_len("chain_offsets", offsets.len(), rank.len() + 1)?;
    expect_below("edges", edges.iter().flatten().copied(), flat_points.len())?;
    expect_below("piece_edge", piece_edge.iter().copied(), edges.len())?;
    expect_below("chain_edges", members.iter().copied(), edges.len())?;
    expect_below("chain_offsets", offsets.iter().copied(), members.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] > w[1]) || piece_edge.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("chain_offsets and piece_edge must ascend"));
    }
    let pieces: Vec<Piece> = (0..piece_edge.len())
        .map(|i| Piece {
            start: piece_t0[i],
            end: piece_t1[i],
            state: match piece_state[i] {
                0 => State::Visible,
                1 => State::Hidden,
                2 => State::Within,
                _ => State::Diving,
            },
        })
        .collect();
    let mut piece_offsets = vec![0u32; edges.len() + 1];
    for &e in piece_edge {
        piece_offsets[e as usize + 1] += 1;
    }
    for e in 0..edges.len() {
        piece_offsets[e + 1] += piece_offsets[e];
    }
    let lines = run(py, threads, flat_points.len(), |stopped| {
        let view = View { origin: eye, away, perspective };
        let geometry = Geometry {
            flat: flat_points,
            space: space_points,
            view: &view,
            edges,
            pieces: &pieces,
            piece_offsets: &piece_offsets,
        };

        let limits = Limits { short: flip, stub, noise: flip };
        let lines: Vec<Polyline> = (0..rank.len())
            .into_par_iter()
            .flat_map_iter(|c| {
                let run = offsets[c] as usize..offsets[c + 1] as usize;
                let mut limits = limits;
                if noisy[c] {
                    limits.noise = geometry.noise(&members[run.clone()], short);
                }
                cut(&geometry, &members[run.clone()], &reversed[run], c as u32, &limits)
            })
            .collect();
        if stopped() {
            return None;
        }
        // Rounding is not to decide which of two lines at one depth is the nearer.
        let grain = 1e-6 * space_tolerance.max(f64::MIN_POSITIVE / 1e-6);
        let nearest: Vec<f64> = lines
            .par_iter()
            .map(|line| line.space.iter().map(|p| view.depth(p)).fold(f64::INFINITY, f64::min))
            .map(|depth| (depth / grain).round() + 0.0)
            .collect();
        let ranks = ranked(&lines, rank, &nearest);
        let mut lines = uncovered(lines, &ranks, Widths { same: width, under }, &view);
        drop_specks(&mut lines, short);
        let ends = Ends::of(&lines);
        let chains = lines
            .par_iter_mut()
            .map(|line| {
                let c = line.chain as usize;
                if noisy[c] && bare[c] {
                    let (found, chain) = smooth(line, &|p| ends.meet(line, p), accuracy, space_tolerance, &view);
                    *line = found;
                    return chain;
                }
                // Where other lines end on a crease of a mesh, it keeps its vertex.
                let kept: Vec<bool> = line.flat.iter().map(|p| bare[c] && ends.meet(line, p)).collect();
                simplify(line, &kept, flat_tolerance, space_tolerance);
                None
            })
            .collect();
        Some((lines, chains))
    })?;
    let (lines, chains): (Vec<Polyline>, Vec<Option<Chain>>) =
        lines.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
    export(py, &lines, &chains)
}

/// A strict order of lines: visible before hidden, then by rank in sixteens, then nearer, then by rank, then by
/// geometry; order in the input decides only between lines that are the same in every coordinate.
fn ranked(lines: &[Polyline], rank: &[u8], nearest: &[f64]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..lines.len() as u32).collect();
    order.par_sort_by(|&i, &j| {
        let (a, b) = (&lines[i as usize], &lines[j as usize]);
        b.visible
            .cmp(&a.visible)
            .then_with(|| (rank[a.chain as usize] >> 4).cmp(&(rank[b.chain as usize] >> 4)))
            .then_with(|| nearest[i as usize].total_cmp(&nearest[j as usize]))
            .then_with(|| rank[a.chain as usize].cmp(&rank[b.chain as usize]))
            .then_with(|| {
                let (x, y) = (a.space.iter().flatten(), b.space.iter().flatten());
                x.zip(y).map(|(p, q)| p.total_cmp(q)).find(|o| o.is_ne()).unwrap_or(a.space.len().cmp(&b.space.len()))
            })
    });
    let mut out = vec![0; lines.len()];
    for (r, &i) in order.iter().enumerate() {
        out[i as usize] = r as u32;
    }
    out
}

fn export<'py>(py: Python<'py>, lines: &[Polyline], chains: &[Option<Chain>]) -> PyResult<Bound<'py, PyDict>> {
    let total = lines.iter().map(|l| l.flat.len()).sum();
    let mut offsets = Vec::with_capacity(lines.len() + 1);
    let mut flat: Vec<f64> = Vec::with_capacity(2 * total);
    let mut space: Vec<f64> = Vec::with_capacity(3 * total);
    let mut length = Vec::with_capacity(lines.len());
    offsets.push(0i32);
    for line in lines {
        flat.extend(line.flat.iter().flatten());
        space.extend(line.space.iter().flatten());
        offsets.push((flat.len() / 2) as i32);
        length.push(line.flat.windows(2).map(|w| distance(&w[0], &w[1])).sum::<f64>());
    }
    let (mut curve_offsets, mut curve) = (vec![0i32], Vec::<f64>::new());
    for chain in chains {
        curve.extend(chain.iter().flat_map(|c| c.points.as_flattened()));
        curve_offsets.push((curve.len() / 2) as i32);
    }
    let out = PyDict::new(py);
    let poles = curve.len() / 2;
    let bounds: Vec<f64> = chains
        .iter()
        .flat_map(|c| {
            c.as_ref().map_or([f64::NAN; 4], |c| {
                let [[a, b], [c, d]] = c.bounds();
                [a, b, c, d]
            })
        })
        .collect();
    out.set_item("curve_bounds", bounds.into_pyarray(py).reshape([lines.len(), 2, 2])?)?;
    out.set_item("curve_offsets", curve_offsets.into_pyarray(py))?;
    out.set_item("curve", curve.into_pyarray(py).reshape([poles, 2])?)?;
    out.set_item("chain", lines.iter().map(|l| l.chain as i32).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("visible", lines.iter().map(|l| l.visible).collect::<Vec<_>>().into_pyarray(py))?;
    out.set_item("offsets", offsets.into_pyarray(py))?;
    out.set_item("length", length.into_pyarray(py))?;
    out.set_item("flat", flat.into_pyarray(py).reshape([total, 2])?)?;
    out.set_item("space", space.into_pyarray(py).reshape([total, 3])?)?;
    Ok(out)
}
