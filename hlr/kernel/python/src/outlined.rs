//! Binding of `hlr_linework::silhouette::outlined`: outlines as edges of the image.

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat as slice};
use super::camera::Camera;
use super::groups::Groups;
use super::mesh_input::Mesh;
use super::silhouette::Outlines;
use super::stretches::Stretches;
use super::threads::{CHEAP, run};
use super::true_surfaces::TrueSurfaces;
use super::view::{Flat, Rows, arrays, flat, rows};
use super::walks::Walks;
use hlr_linework::silhouette::image::{Classes, Image, Outlined as Found};
use hlr_linework::silhouette::outlined::{Lengths, outlined as add};

/// Per edge its class, part and group, and whether a curved surface may show its outline there; per triangle its group.
type Columns<'py> = (
    PyReadonlyArray1<'py, u8>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, bool>,
    PyReadonlyArray1<'py, i32>,
);

/// By the class of an edge: it bounds faces, and the surface goes on there; the classes of outlines and of other edges.
type Kinds<'py> = (PyReadonlyArray1<'py, bool>, PyReadonlyArray1<'py, bool>, u8, u8);

/// Numbers of classes: they are bytes.
const KINDS: usize = 256;

/// An image with its outlines.
#[pyclass(frozen)]
pub struct Outlined(Found);

arrays! { Outlined {
    points: rows Rows<'py, f64> = |o| &o.0.points;
    lift: rows Rows<'py, f64> = |o| &o.0.lift;
    edges: rows Rows<'py, i32> = |o| &o.0.edges;
    offsets: flat Flat<'py, i32> = |o| &o.0.offsets;
    part: flat Flat<'py, i32> = |o| &o.0.part;
    group: flat Flat<'py, i32> = |o| &o.0.group;
    kind: flat Flat<'py, u8> = |o| &o.0.kind;
    curved: flat Flat<'py, bool> = |o| &o.0.curved;
    hidden: flat Flat<'py, bool> = |o| &o.0.hidden;
    number: flat Flat<'py, i32> = |o| &o.0.number;
}

    /// Edges whose own faces are seen nearly edge-on.
    fn own(&self) -> Stretches {
        Stretches(self.0.own.clone())
    }

    /// The outlines as walks of this class; first: how many edges the image had before.
    fn walks(&self, kind: u8, first: i32) -> Walks {
        Walks(self.0.walks(kind, first))
    }
}

/// The image with its outlines.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // the image, and what it is about
pub fn outlined<'py>(
    py: Python<'py>,
    outlines: &Outlines,
    mesh: &Mesh,
    on: &TrueSurfaces,
    columns: Columns<'py>,
    first: PyReadonlyArray1<'py, i32>,
    groups: &Groups,
    convex: bool,
    kinds: Kinds<'py>,
    camera: &Camera,
    lengths: [f64; 3],
) -> PyResult<Outlined> {
    let (reading, places) = (mesh.reading(py)?, on.reading(py)?);
    let (all, (triangle_face, ..)) = (reading.slices()?, places.slices()?);
    let (kind, part, group) = (slice(&columns.0, "kind")?, slice(&columns.1, "part")?, slice(&columns.2, "group")?);
    let (curved, triangle_group) = (slice(&columns.3, "curved")?, slice(&columns.4, "triangle_group")?);
    let first = slice(&first, "first")?;
    // Outlines, moved off their bodies, may lie within another that comes so near.
    let (closed, near) = (&groups.0.cull[..], &groups.within(lengths[1])?[..]);
    let (border, tangent) = (slice(&kinds.0, "border")?, slice(&kinds.1, "tangent")?);
    for (name, found) in [("kind", kind.len()), ("part", part.len()), ("group", group.len()), ("curved", curved.len())]
    {
        expect_len(name, found, all.edges.len())?;
    }
    expect_len("triangle_group", triangle_group.len(), all.triangles.len())?;
    expect_len("triangle_face", triangle_face.len(), all.triangles.len())?;
    expect_len("border", border.len(), KINDS)?;
    expect_len("tangent", tangent.len(), KINDS)?;
    expect_below("group", group.iter().chain(triangle_group).copied(), closed.len())?;
    // They were found on a mesh, which may have been another one.
    expect_len("faces", on.number.len(), outlines.traced.len())?;
    expect_below("edge of a border", outlines.grazing.iter().map(|g| g.edge as i32), all.edges.len())?;
    let crossed = outlines.grazing.iter().filter_map(|g| g.crossed).flatten();
    expect_below("triangles that cross", crossed, all.triangles.len())?;
    if first.first().is_none_or(|&face| face != 0) {
        return Err(PyValueError::new_err("first must begin with 0"));
    }
    let traced: Vec<bool> = outlines.traced.iter().zip(&on.curved).map(|(traced, curved)| *traced && *curved).collect();
    let image = Image {
        points: all.points,
        edges: all.edges,
        offsets: all.offsets,
        incident: all.incident,
        kind,
        part,
        group,
        curved,
        triangle_face,
        triangle_group,
        first,
        traced: &traced,
        closed,
        near,
        convex,
        view: camera.0.view(),
    };
    let classes = Classes { border, tangent, outline: kinds.2, interior: kinds.3 };
    let [spare, most, own] = lengths;
    let lengths = Lengths { spare, most, own };
    let found =
        run(py, all.triangles.len() / CHEAP, |_| add(&image, &classes, &outlines.lines, &outlines.grazing, &lengths))?;
    Ok(Outlined(found))
}
