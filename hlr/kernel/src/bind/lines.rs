//! `chain`, and the way from pieces of mesh edges to the lines of a drawing, as Python sees them.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::drawn::{Lines, kind_of};
use super::geometry::curves;
use super::guard::caught;
use super::running::run;
use super::scan::{check_incidence, expect_below, expect_len, flat, rows};
use crate::lines::camera::Camera as Seen;
use crate::lines::chain::{Straight, chain as chain_edges};
use crate::lines::cover::Widths;
use crate::lines::cut::{Cut as Found, Tolerances, Trait, cut};
use crate::lines::finish::finish;
use crate::lines::outlines::{About, Chains as Walks, Surface, add_outlines};
use crate::lines::runs::{Geometry, Piece};
use crate::paper::junction::Border;
use crate::paper::routes::{Curves, Fit, Guide};
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

type Vec3 = [f64; 3];

#[pyclass(frozen)]
pub struct Camera(Seen);

#[pymethods]
impl Camera {
    #[new]
    fn new(direction: Vec3, right: Vec3, up: Vec3, eye: Option<(Vec3, f64)>, scale: f64) -> Camera {
        Camera(Seen { direction, right, up, eye, scale })
    }
}

/// The walks over mesh edges that become lines.
#[pyclass(frozen)]
pub struct Chains(Arc<Walks>);

/// Offsets, edges, reversed, kind, part, index, face, other: the chains of a scene.
type SceneChains<'py> = (
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, bool>,
    PyReadonlyArray1<'py, u8>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

/// Edges, their triangles (offsets, incident), their groups, and part and face of each triangle.
type SceneMesh<'py> = (
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

#[pymethods]
impl Chains {
    /// Chains of the source whose class is drawn, then the contours among the edges `found`, which ascend.
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
    fn new(
        py: Python<'_>,
        chains: SceneChains<'_>,
        straight: PyReadonlyArray1<'_, bool>,
        drawn: [bool; 6],
        points: usize,
        mesh: SceneMesh<'_>,
        has_faces: PyReadonlyArray1<'_, bool>,
        groups: usize,
        facing: PyReadonlyArray1<'_, i8>,
        role: PyReadonlyArray1<'_, u8>,
        found: PyReadonlyArray1<'_, i32>,
    ) -> PyResult<Chains> {
        caught(py, || {
            let edges = rows::<i32, 2>(&mesh.0, "edges")?;
            let surface = Surface {
                points,
                edges,
                offsets: flat(&mesh.1, "offsets")?,
                incident: flat(&mesh.2, "incident")?,
                edge_group: flat(&mesh.3, "edge_group")?,
                triangle_part: flat(&mesh.4, "triangle_part")?,
                triangle_face: flat(&mesh.5, "triangle_face")?,
                has_faces: flat(&has_faces, "has_faces")?,
                facing: flat(&facing, "facing")?,
                role: flat(&role, "role")?,
                groups,
            };
            let triangles = surface.triangle_part.len();
            expect_len("triangle_face", surface.triangle_face.len(), triangles)?;
            expect_len("facing", surface.facing.len(), triangles)?;
            expect_len("role", surface.role.len(), edges.len())?;
            expect_len("edge_group", surface.edge_group.len(), edges.len())?;
            expect_below("edges", edges.iter().flatten().copied(), points)?;
            expect_below("edge_group", surface.edge_group.iter().copied(), groups)?;
            expect_below("triangle_part", surface.triangle_part.iter().copied(), surface.has_faces.len())?;
            check_incidence(edges.len(), surface.offsets, surface.incident, triangles)?;
            let found = flat(&found, "found")?;
            expect_below("found", found.iter().copied(), edges.len())?;
            let mut out = of_source(&chains, flat(&straight, "straight")?, &drawn, edges.len())?;
            add_outlines(&surface, found, &mut out);
            Ok(Chains(Arc::new(out)))
        })
    }

    #[getter]
    fn offsets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.0.offsets.clone().into_pyarray(py)
    }

    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.0.edges.clone().into_pyarray(py)
    }

    #[getter]
    fn reversed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.0.reversed.clone().into_pyarray(py)
    }

    /// The first mesh edge of each chain.
    #[getter]
    fn first<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        let starts = &self.0.offsets[..self.0.about.len()];
        starts.iter().map(|&i| self.0.edges[i as usize]).collect::<Vec<_>>().into_pyarray(py)
    }

    #[getter]
    fn kind<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        self.column(py, |a| a.kind as u8)
    }

    #[getter]
    fn part<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.column(py, |a| a.part)
    }

    #[getter]
    fn edge<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.column(py, |a| a.edge)
    }

    #[getter]
    fn noisy<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, |a| a.noisy)
    }

    #[getter]
    fn straight<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, |a| a.straight)
    }
}

impl Chains {
    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&About) -> T) -> Bound<'py, PyArray1<T>> {
        self.0.about.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}

fn of_source(c: &SceneChains, straight: &[bool], drawn: &[bool; 6], edges: usize) -> PyResult<Walks> {
    let (offsets, members, reversed) = (flat(&c.0, "offsets")?, flat(&c.1, "edges")?, flat(&c.2, "reversed")?);
    let kind = flat(&c.3, "kind")?;
    let (part, index) = (flat(&c.4, "part")?, flat(&c.5, "index")?);
    let (face, other) = (flat(&c.6, "face")?, flat(&c.7, "other")?);
    for (name, found) in [
        ("part", part.len()),
        ("index", index.len()),
        ("face", face.len()),
        ("other", other.len()),
        ("straight", straight.len()),
    ] {
        expect_len(name, found, kind.len())?;
    }
    expect_len("offsets", offsets.len(), kind.len() + 1)?;
    expect_len("reversed", reversed.len(), members.len())?;
    expect_below("edges", members.iter().copied(), edges)?;
    expect_below("offsets", offsets.iter().copied(), members.len() + 1)?;
    if offsets.windows(2).any(|w| w[0] >= w[1]) {
        return Err(PyValueError::new_err("offsets must ascend"));
    }
    let mut out = Walks::new();
    for i in 0..kind.len() {
        // Chains of a kind that was not asked for may still hold contours: those are drawn as outlines instead.
        let kind = kind_of(kind[i])?;
        if drawn[kind as usize] {
            let run = offsets[i] as usize..offsets[i + 1] as usize;
            let about = About {
                kind,
                part: part[i],
                edge: index[i],
                face: face[i],
                other: other[i],
                noisy: false,
                straight: straight[i],
            };
            out.push(&members[run.clone()], &reversed[run], about);
        }
    }
    Ok(out)
}

/// Edge, start, end and state of each piece.
type Pieces<'py> =
    (PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, u8>);

/// accuracy, short, flip, stub, same, under, flat, space.
type Lengths = [f64; 8];

fn tolerances([accuracy, short, flip, stub, same, under, flat, space]: Lengths) -> Tolerances {
    Tolerances { accuracy, short, flip, stub, widths: Widths { same, under }, flat, space }
}

/// Lines on paper, chained, merged and thinned out, on their way to their curves.
#[pyclass(frozen)]
pub struct Cut {
    chains: Arc<Walks>,
    traits: Vec<Trait>,
    camera: Seen,
    hidden: bool,
    /// Of each line.
    chain: Vec<i32>,
    drawn: usize,
    found: Mutex<Option<Found>>,
}

#[pymethods]
impl Cut {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
    fn new(
        py: Python<'_>,
        camera: &Camera,
        projected: PyReadonlyArray2<'_, f64>,
        points: PyReadonlyArray2<'_, f64>,
        edges: PyReadonlyArray2<'_, i32>,
        pieces: Pieces<'_>,
        chains: &Chains,
        rank: PyReadonlyArray1<'_, u8>,
        bare: PyReadonlyArray1<'_, bool>,
        lengths: Lengths,
        hidden: bool,
        threads: usize,
    ) -> PyResult<Cut> {
        caught(py, || {
            let (camera, chains) = (camera.0, &chains.0);
            let (projected, space) = (rows::<f64, 3>(&projected, "projected")?, rows::<f64, 3>(&points, "points")?);
            let edges = rows::<i32, 2>(&edges, "edges")?;
            let (rank, bare) = (flat(&rank, "rank")?, flat(&bare, "bare")?);
            expect_len("points", space.len(), projected.len())?;
            expect_below("edges", edges.iter().flatten().copied(), projected.len())?;
            expect_below("chains", chains.edges.iter().copied(), edges.len())?;
            expect_len("rank", rank.len(), chains.about.len())?;
            expect_len("bare", bare.len(), chains.about.len())?;
            let (pieces, piece_offsets) = pieces_of(&pieces, edges.len())?;
            let traits: Vec<Trait> =
                (0..rank.len()).map(|c| Trait { rank: rank[c], bare: bare[c], noisy: chains.about[c].noisy }).collect();
            let found = run(py, threads, projected.len(), |stopped| {
                let flat: Vec<[f64; 2]> =
                    projected.iter().map(|p| [p[0] * camera.scale, p[1] * camera.scale]).collect();
                let view = camera.view();
                let (pieces, piece_offsets) = (&pieces[..], &piece_offsets[..]);
                let geometry = Geometry { flat: &flat, space, view: &view, edges, pieces, piece_offsets };
                let mut found = cut(&geometry, chains, &traits, &tolerances(lengths), stopped)?;
                if !hidden {
                    found.keep_sighted(traits.len());
                }
                Some(found)
            })?
            .ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
            Ok(Cut {
                chains: chains.clone(),
                traits,
                camera,
                hidden,
                chain: found.lines.iter().map(|line| line.chain as i32).collect(),
                drawn: found.lines.iter().filter(|line| line.visible || hidden).count(),
                found: Mutex::new(Some(found)),
            })
        })
    }

    /// How many lines will be drawn.
    fn __len__(&self) -> usize {
        self.drawn
    }

    /// (lines,) the chain of each line, also of those that are there only for others to end on.
    #[getter]
    fn chain<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.chain.clone().into_pyarray(py)
    }

    /// The lines on their curves, and their lower left corner; once.
    #[allow(clippy::too_many_arguments)] // one argument per array: the stub names them
    fn finished(
        &self,
        py: Python<'_>,
        known: bool,
        records: Records<'_>,
        places: PyReadonlyArray3<'_, f64>,
        curve: PyReadonlyArray1<'_, i32>,
        place: PyReadonlyArray1<'_, i32>,
        bulge: PyReadonlyArray1<'_, f64>,
        lengths: [f64; 4],
        threads: usize,
    ) -> PyResult<(Lines, (f64, f64))> {
        let (kind, ranges, offsets, values) = &records;
        let curves = Curves {
            known,
            curves: curves(flat(kind, "kind")?, flat(offsets, "offsets")?, flat(values, "values")?)?,
            ranges: rows::<f64, 2>(ranges, "ranges")?.to_vec(),
            places: matrices(&places)?.to_vec(),
        };
        expect_len("ranges", curves.ranges.len(), curves.curves.len())?;
        let (curve, place, bulge) = (flat(&curve, "curve")?, flat(&place, "place")?, flat(&bulge, "bulge")?);
        for (name, found) in [("curve", curve.len()), ("place", place.len()), ("bulge", bulge.len())] {
            expect_len(name, found, self.traits.len())?;
        }
        expect_below("curve", curve.iter().copied().filter(|&c| c >= 0), curves.curves.len())?;
        let used = |c: &usize| curve[*c] >= 0;
        expect_below("place", (0..place.len()).filter(used).map(|c| place[c]), curves.places.len())?;
        let about = &self.chains.about;
        let guides: Vec<Guide> = (0..curve.len())
            .map(|c| Guide {
                curve: u32::try_from(curve[c]).ok(),
                place: place[c] as u32,
                border: border(&about[c], self.traits[c].bare),
                bulge: bulge[c],
                smoothed: self.traits[c].noisy && self.traits[c].bare,
            })
            .collect();
        let [accuracy, chord, closed, contact] = lengths;
        let fit = Fit { accuracy, chord, closed, contact };
        let held = self.found.lock().unwrap_or_else(PoisonError::into_inner).take();
        let found = held.ok_or_else(|| PyValueError::new_err("these lines were finished before"))?;
        let size = found.lines.iter().map(|line| line.flat.len()).sum();
        let (lines, [x, y]) =
            run(py, threads, size, |_| finish(found, about, &guides, &curves, &self.camera, &fit, self.hidden))?;
        Ok((Lines(Arc::new(lines)), (x, y)))
    }
}

/// Kind, ranges, offsets and values of curves.
type Records<'py> =
    (PyReadonlyArray1<'py, u8>, PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, f64>);

fn matrices<'a>(places: &'a PyReadonlyArray3<'_, f64>) -> PyResult<&'a [[[f64; 4]; 3]]> {
    let wrong = || PyValueError::new_err("places must be a C-contiguous (n, 3, 4) array");
    if places.as_array().shape()[1..] != [3, 4] {
        return Err(wrong());
    }
    Ok(places.as_slice().map_err(|_| wrong())?.as_chunks::<4>().0.as_chunks::<3>().0)
}

/// Where a surface may end in the image. The outline of a mesh is an edge of it.
fn border(about: &About, bare: bool) -> Border {
    use crate::lines::drawn::Kind::{Boundary, Outline, Sharp};
    match about.kind {
        Sharp | Boundary => Border::Edge,
        Outline if bare => Border::Edge,
        Outline => Border::Outline,
        _ => Border::None,
    }
}

/// Pieces, and where those of each edge begin.
fn pieces_of(pieces: &Pieces, edges: usize) -> PyResult<(Vec<Piece>, Vec<u32>)> {
    let (edge, start, end, state) =
        (flat(&pieces.0, "edge")?, flat(&pieces.1, "t0")?, flat(&pieces.2, "t1")?, flat(&pieces.3, "state")?);
    for (name, found) in [("t0", start.len()), ("t1", end.len()), ("state", state.len())] {
        expect_len(name, found, edge.len())?;
    }
    expect_below("edge", edge.iter().copied(), edges)?;
    if edge.windows(2).any(|w| w[0] > w[1]) {
        return Err(PyValueError::new_err("the edges of pieces must ascend"));
    }
    let state = |i: usize| match state[i] {
        0 => State::Visible,
        1 => State::Hidden,
        2 => State::Within,
        _ => State::Diving,
    };
    let mut offsets = vec![0u32; edges + 1];
    edge.iter().for_each(|&e| offsets[e as usize + 1] += 1);
    for e in 0..edges {
        offsets[e + 1] += offsets[e];
    }
    Ok(((0..edge.len()).map(|i| Piece { start: start[i], end: end[i], state: state(i) }).collect(), offsets))
}
