//! Binding of `hlr_visibility::scan`: the visibility pass.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::{expect_ascending, expect_below, expect_len, flat as slice, rows};
use super::guard::caught;
use super::mesh_input::Mesh;
use super::stretches::Stretches;
use super::threads::run;
use super::view::{Flat, arrays, flat};
use super::visibility_input::VisibilityInput;
use hlr_linework::lines::geometry::Piece;
use hlr_visibility::scan::drawn::as_drawn;
use hlr_visibility::scan::invisibility::State;
use hlr_visibility::scan::own_faces::OwnFaces;
use hlr_visibility::scan::scene::{Numbers, Refusal, Scene, solve};
use hlr_visibility::scan::sweep::{Counters, Seconds, Steps};

/// Visible and hidden pieces of the edges, as they are drawn.
#[pyclass(frozen)]
pub struct Visibility {
    /// The edge of each piece; they ascend.
    pub edge: Vec<i32>,
    pub pieces: Vec<Piece>,
    /// Of each triangle.
    pub facing: Vec<i8>,
    /// Of each edge, whether its own body hides it; empty: of none.
    pub hidden: Vec<bool>,
    contacts: u64,
    counters: Counters,
    seconds: Seconds,
}

arrays! { Visibility {
    edge: flat Flat<'py, i32> = |v| &v.edge;
    facing: flat Flat<'py, i8> = |v| &v.facing;
}

    /// Pieces that are known already.
    #[new]
    fn new(
        py: Python<'_>,
        edge: PyReadonlyArray1<'_, i32>,
        t0: PyReadonlyArray1<'_, f64>,
        t1: PyReadonlyArray1<'_, f64>,
        state: PyReadonlyArray1<'_, u8>,
        facing: PyReadonlyArray1<'_, i8>,
    ) -> PyResult<Visibility> {
        caught(py, || {
            let (edge, facing) = (slice(&edge, "edge")?.to_vec(), slice(&facing, "facing")?.to_vec());
            let (start, end, states) = (slice(&t0, "t0")?, slice(&t1, "t1")?, slice(&state, "state")?);
            for (name, found) in [("t0", start.len()), ("t1", end.len()), ("state", states.len())] {
                expect_len(name, found, edge.len())?;
            }
            expect_ascending("edge", &edge)?;
            let piece = |i: usize| Piece { start: start[i], end: end[i], state: state_of(states[i]) };
            let pieces = (0..edge.len()).map(piece).collect();
            let (counters, seconds) = (Counters::default(), Seconds::default());
            Ok(Visibility { edge, pieces, facing, hidden: Vec::new(), contacts: 0, counters, seconds })
        })
    }

    #[getter]
    fn t0<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |piece| piece.start)
    }

    #[getter]
    fn t1<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |piece| piece.end)
    }

    #[getter]
    fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        self.column(py, |piece| piece.state as u8)
    }

    #[getter]
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let out = counters(py, &self.counters)?;
        out.set_item("contacts", self.contacts)?;
        Ok(out)
    }

    #[getter]
    fn seconds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        seconds(py, &self.seconds)
    }
}

impl Visibility {
    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&Piece) -> T) -> Bound<'py, PyArray1<T>> {
        self.pieces.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}

fn state_of(number: u8) -> State {
    match number {
        0 => State::Visible,
        1 => State::Hidden,
        2 => State::Within,
        _ => State::Diving,
    }
}

/// Visible and hidden pieces of the edges that have a role, and of those that are `hidden`.
#[pyfunction]
#[pyo3(signature = (mesh, projected, input, own = None, hidden = None, *, contact = true, crossings = true,
    piercings = true, pyramid = false, arithmetic = "exact"))]
#[allow(clippy::too_many_arguments)] // half of them are options
pub fn visibility<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    projected: PyReadonlyArray2<'py, f64>,
    input: &VisibilityInput,
    own: Option<(PyRef<'py, Stretches>, PyReadonlyArray1<'py, i32>)>,
    hidden: Option<PyReadonlyArray1<'py, bool>>,
    contact: bool,
    crossings: bool,
    piercings: bool,
    pyramid: bool,
    arithmetic: &str,
) -> PyResult<Visibility> {
    let numbers = match arithmetic {
        "exact" => Numbers::Exact,
        "f64" => Numbers::Double,
        "f32" => Numbers::Single,
        _ => return Err(PyValueError::new_err(format!("no arithmetic is called {arithmetic}: exact, f64 or f32"))),
    };
    let reading = mesh.reading(py)?;
    let all = reading.slices()?;
    let of = input.reading(py)?;
    let told = input.groups(contact);
    let scene = Scene {
        points: rows::<f64, 3>(&projected, "projected")?,
        triangles: all.triangles,
        triangle_group: slice(&of.0, "triangle")?,
        edges: all.edges,
        offsets: all.offsets,
        incident: all.incident,
        edge_group: slice(&of.1, "edge")?,
        role: &input.role,
        groups: &told,
        crossing: input.crossing(),
    };
    expect_len("projected", scene.points.len(), all.points.len())?;
    expect_len("groups of triangles", scene.triangle_group.len(), all.triangles.len())?;
    expect_len("groups of edges", scene.edge_group.len(), all.edges.len())?;
    expect_len("role", scene.role.len(), all.edges.len())?;
    let own_faces = match &own {
        None => OwnFaces::NONE,
        Some((stretches, triangle_face)) => {
            let triangle_face = slice(triangle_face, "triangle_face")?;
            expect_len("triangle_face", triangle_face.len(), all.triangles.len())?;
            expect_below("triangle_face", triangle_face.iter().copied(), stretches.0.sheet.len())?;
            stretches.expect_edges(all.edges.len())?;
            OwnFaces { stretches: &stretches.0, triangle_face, depth_scale: 1.0 }
        }
    };
    let hidden = hidden.as_ref().map_or(Ok(&[][..]), |hidden| slice(hidden, "hidden"))?;
    if !hidden.is_empty() {
        expect_len("hidden", hidden.len(), all.edges.len())?;
    }
    let steps = Steps { crossings, piercings, pyramid };
    let outcome = run(py, scene.triangles.len(), |stopped| solve(&scene, own_faces, steps, numbers, stopped))?
        .map_err(|why| match why {
            Refusal::NotFinite => PyValueError::new_err("points hold coordinates that are not finite"),
            Refusal::Stopped => PyKeyboardInterrupt::new_err("stopped"),
        })?;
    let on_surface = |edge: u32| scene.groups[scene.edge_group[edge as usize] as usize].tight;
    let (drawn, contacts) = as_drawn(&outcome.pieces, on_surface, hidden);
    let piece = |p: &hlr_visibility::scan::invisibility::Piece| Piece {
        start: p.segment.start,
        end: p.segment.end,
        state: p.segment.state,
    };
    Ok(Visibility {
        edge: drawn.iter().map(|p| p.edge as i32).collect(),
        pieces: drawn.iter().map(piece).collect(),
        facing: outcome.facing,
        hidden: hidden.to_vec(),
        contacts,
        counters: outcome.counters,
        seconds: outcome.seconds,
    })
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
        ("slanted_contacts", c.slanted_contacts),
    ] {
        out.set_item(name, value)?;
    }
    Ok(out)
}
