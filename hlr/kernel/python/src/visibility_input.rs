//! Binding of `hlr_visibility::plan`: what the visibility pass is told of edges and groups.

use std::borrow::Cow;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_len, expect_slice_below, flat as slice};
use super::camera::Camera;
use super::groups::{Groups, not_finite};
use super::guard::caught;
use super::threads::run;
use super::view::{Flat, arrays, flat};
use hlr_linework::lines::camera::Camera as PaperCamera;
use hlr_mesh::groups::Groups as Columns;
use hlr_visibility::plan::contact::{Contact, Depths, coming_near};
use hlr_visibility::plan::roles::{Counts, counts, edge_roles, roles, told};
use hlr_visibility::scan::scene::Group;

/// Contact depths: of curved and of planar groups, in model units; of meshes without B-rep, as a share of the scene.
pub(super) fn depths([curved, planar, share]: [f64; 3]) -> Depths {
    Depths { curved, planar, share }
}

/// What an input was decided for.
struct View {
    groups: Arc<Columns>,
    camera: PaperCamera,
}

/// What the visibility pass is told of edges and groups.
#[pyclass(frozen)]
pub struct VisibilityInput {
    triangle: Py<PyArray1<i32>>,
    edge: Py<PyArray1<i32>>,
    pub(super) role: Vec<u8>,
    pub(super) drawn: Vec<bool>,
    groups: Vec<Group>,
    /// None where the input was given.
    view: Option<View>,
}

arrays! { VisibilityInput {
    role: flat Flat<'py, u8> = |i| &i.role;
}

    /// Decides for a view of a scene.
    #[new]
    #[allow(clippy::too_many_arguments)] // groups, columns of edges, their classes, and the view
    fn new(
        py: Python<'_>,
        groups: &Groups,
        triangle: Py<PyArray1<i32>>,
        edge: Py<PyArray1<i32>>,
        curved: PyReadonlyArray1<'_, bool>,
        kind: PyReadonlyArray1<'_, u8>,
        hidden: Option<PyReadonlyArray1<'_, bool>>,
        goes_on: PyReadonlyArray1<'_, bool>,
        drawn: Vec<bool>,
        camera: &Camera,
        contact: [f64; 3],
        rounding: f64,
    ) -> PyResult<VisibilityInput> {
        caught(py, || {
            let (curved, kind) = (slice(&curved, "curved")?, slice(&kind, "kind")?);
            let hidden = hidden.as_ref().map_or(Ok(&[][..]), |hidden| slice(hidden, "hidden"))?;
            expect_len("kind", kind.len(), curved.len())?;
            if !hidden.is_empty() {
                expect_len("hidden", hidden.len(), curved.len())?;
            }
            let of_classes = roles(&drawn, slice(&goes_on, "goes_on")?);
            let role = run(py, kind.len() / 64, |_| edge_roles(curved, kind, &of_classes, hidden))?;
            let contact = Contact::of(&groups.0, &camera.0, depths(contact), rounding);
            let told = told(&groups.0, &contact);
            let view = View { groups: groups.0.clone(), camera: camera.0 };
            VisibilityInput { triangle, edge, role, drawn, groups: told, view: Some(view) }.checked(py)
        })
    }

    /// An input that is decided already.
    #[staticmethod]
    #[pyo3(signature = (triangle, edge, role, *, cull, sound, delta, cap, tight, drawn))]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn of(
        py: Python<'_>,
        triangle: Py<PyArray1<i32>>,
        edge: Py<PyArray1<i32>>,
        role: PyReadonlyArray1<'_, u8>,
        cull: PyReadonlyArray1<'_, bool>,
        sound: PyReadonlyArray1<'_, bool>,
        delta: PyReadonlyArray1<'_, f64>,
        cap: PyReadonlyArray1<'_, f64>,
        tight: PyReadonlyArray1<'_, bool>,
        drawn: Vec<bool>,
    ) -> PyResult<VisibilityInput> {
        caught(py, || {
            let (cull, sound, tight) = (slice(&cull, "cull")?, slice(&sound, "sound")?, slice(&tight, "tight")?);
            let (delta, cap) = (slice(&delta, "delta")?, slice(&cap, "cap")?);
            for (name, found) in
                [("sound", sound.len()), ("delta", delta.len()), ("cap", cap.len()), ("tight", tight.len())]
            {
                expect_len(name, found, cull.len())?;
            }
            let group =
                |g: usize| Group { cull: cull[g], sound: sound[g], delta: delta[g], cap: cap[g], tight: tight[g] };
            let (groups, role) = ((0..cull.len()).map(group).collect(), slice(&role, "role")?.to_vec());
            VisibilityInput { triangle, edge, role, drawn, groups, view: None }.checked(py)
        })
    }

    /// Per group: its contact tolerance, in depth units of the view.
    #[getter]
    fn delta<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |group| group.delta)
    }

    /// Per group: the upper limit of the tolerance, in depth units of the view.
    #[getter]
    fn cap<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |group| group.cap)
    }

    /// How many groups come within the contact tolerance of another.
    fn coming_near(&self, lift: f64, spare: f64) -> PyResult<usize> {
        let view = self.of_view()?;
        let delta: Vec<f64> = self.groups.iter().map(|group| group.delta).collect();
        coming_near(&view.groups, &view.camera, &delta, spare, lift).ok_or_else(not_finite)
    }

    /// Numbers that decide which steps the pass takes.
    fn counts(&self, py: Python<'_>) -> PyResult<VisibilityCounts> {
        let triangle = self.reading(py)?.0;
        Ok(VisibilityCounts::from(counts(&self.of_view()?.groups, slice(&triangle, "triangle")?, &self.role)))
    }
}

/// Numbers that decide which steps the pass takes, as `Counts` has them.
#[pyclass(frozen, get_all)]
pub struct VisibilityCounts {
    faced: usize,
    culled: usize,
    unsound: usize,
    unsound_not_culled: usize,
    edges: usize,
}

impl From<Counts> for VisibilityCounts {
    fn from(Counts { faced, culled, unsound, unsound_not_culled, edges }: Counts) -> VisibilityCounts {
        VisibilityCounts { faced, culled, unsound, unsound_not_culled, edges }
    }
}

impl VisibilityInput {
    fn checked(self, py: Python<'_>) -> PyResult<VisibilityInput> {
        let of = self.reading(py)?;
        let edges = slice(&of.1, "edge")?;
        expect_slice_below("group of triangles", slice(&of.0, "triangle")?, self.groups.len())?;
        expect_slice_below("group of edges", edges, self.groups.len())?;
        expect_len("role", self.role.len(), edges.len())?;
        drop(of);
        Ok(self)
    }

    /// Groups of triangles, and of edges.
    pub fn reading<'py>(&self, py: Python<'py>) -> PyResult<(PyReadonlyArray1<'py, i32>, PyReadonlyArray1<'py, i32>)> {
        Ok((self.triangle.bind(py).try_readonly()?, self.edge.bind(py).try_readonly()?))
    }

    /// contact: whether surfaces touch within a tolerance. A cap of zero switches it off and keeps the grid.
    pub(super) fn groups(&self, contact: bool) -> Cow<'_, [Group]> {
        if contact {
            return Cow::Borrowed(&self.groups);
        }
        self.groups.iter().map(|group| Group { cap: 0.0, ..*group }).collect()
    }

    /// Pairs of groups that have an intersection line; of an input that was given, none.
    pub(super) fn crossing(&self) -> &[[i32; 2]] {
        self.view.as_ref().map_or(&[], |view| &view.groups.crossing)
    }

    fn of_view(&self) -> PyResult<&View> {
        self.view.as_ref().ok_or_else(|| PyValueError::new_err("this input was not decided for a view"))
    }

    fn column<'py, T: numpy::Element>(&self, py: Python<'py>, of: impl Fn(&Group) -> T) -> Bound<'py, PyArray1<T>> {
        self.groups.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}
