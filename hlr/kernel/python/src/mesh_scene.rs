//! Binding of the mesh of all parts and of the scene that it makes.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray3, PyReadonlyArray1};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use super::arrays::{expect_len, expect_slice_below, flat as values};
use super::clash::{Crossings, crossings};
use super::groups::Groups;
use super::threads::{AT_ONCE, CHEAP, release_later, run};
use super::view::{Flat, Rows, arrays, flat, matrices, rows};
use super::walks::Walks;
use hlr_mesh::facts::Facts;
use hlr_mesh::kinds::{Limits, kinds};
use hlr_mesh::layers::is_layered;
use hlr_mesh::scene::{DEFECTS, Report, Scene, scene};
use hlr_mesh::tables::Tables;

/// Edges of the mesh of all parts.
#[pyclass(frozen)]
pub struct MeshFacts {
    tables: Arc<Tables>,
    facts: Arc<Facts>,
}

impl MeshFacts {
    pub(super) fn of(tables: Arc<Tables>, facts: Arc<Facts>) -> MeshFacts {
        MeshFacts { tables, facts }
    }
}

impl Drop for MeshFacts {
    fn drop(&mut self) {
        release_later((self.tables.clone(), self.facts.clone()), self.tables.triangles.len() / AT_ONCE);
    }
}

arrays! { MeshFacts {
    edges: rows Rows<'py, i32> = |m| &m.facts.edges;
    offsets: flat Flat<'py, i32> = |m| &m.facts.offsets;
    incident: flat Flat<'py, i32> = |m| &m.facts.incident;
    balance: flat Flat<'py, i32> = |m| &m.facts.balance;
    fold: flat Flat<'py, f64> = |m| &m.facts.fold;
    normals: rows Rows<'py, f64> = |m| &m.facts.normals;
    flat: flat Flat<'py, i64> = |m| &m.facts.flat;
}

    /// (p,) whether each part has a triangle with the corners of another one.
    fn triangles_repeated(&self) -> Vec<bool> {
        let mut found = vec![false; self.tables.len()];
        for &t in &self.facts.repeated {
            found[self.tables.triangle_start.partition_point(|&start| start <= t) - 1] = true;
        }
        found
    }

    /// (p,) how many borders each part without B-rep has.
    fn borders_without_brep(&self) -> Vec<i64> {
        let mut count = vec![0; self.tables.len()];
        if self.tables.brep.contains(&false) {
            for (e, _) in self.facts.offsets.windows(2).enumerate().filter(|(_, w)| w[1] - w[0] == 1) {
                let owner = self.tables.part_of_triangle(self.facts.around(e)[0]);
                count[owner] += i64::from(!self.tables.brep[owner]);
            }
        }
        count
    }

    /// Classes of the edges of parts without B-rep, 255 for all others; and which of those are nearly creases. sharp,
    /// near: cosines of folds.
    fn edge_kinds<'py>(
        &self,
        py: Python<'py>,
        fold: PyReadonlyArray1<'py, f64>,
        edge_part: PyReadonlyArray1<'py, i32>,
        without_brep: PyReadonlyArray1<'py, bool>,
        sharp: f64,
        near: f64,
    ) -> PyResult<(Flat<'py, u8>, Flat<'py, i64>)> {
        let (tables, facts, fold) = (&self.tables, &self.facts, values(&fold, "fold")?);
        let (edge_part, without_brep) = (values(&edge_part, "edge_part")?, values(&without_brep, "without_brep")?);
        expect_len("fold", fold.len(), facts.edges.len())?;
        expect_len("edge_part", edge_part.len(), fold.len())?;
        expect_slice_below("edge_part", edge_part, without_brep.len())?;
        let found = run(py, fold.len(), |_| {
            let of_mesh = |e: usize| without_brep[edge_part[e] as usize];
            let layered = |e: usize| is_layered(e, facts, &tables.points, &tables.triangles, sharp);
            kinds(&facts.offsets, fold, &of_mesh, &layered, Limits { sharp, near })
        })?;
        Ok((found.0.into_pyarray(py), found.1.into_pyarray(py)))
    }

    /// All parts as one scene.
    fn scene(&self, py: Python<'_>) -> PyResult<MeshScene> {
        let (tables, facts) = (&self.tables, &self.facts);
        let mut found = run(py, tables.triangles.len() / CHEAP, |_| scene(tables, facts))?;
        let mesh = match &mut found.turned {
            Some(turned) => Arc::new(std::mem::take(&mut turned.facts)),
            None => facts.clone(),
        };
        Ok(MeshScene { tables: tables.clone(), facts: mesh, scene: found })
    }
}

/// All parts as one scene.
#[pyclass(frozen)]
pub struct MeshScene {
    tables: Arc<Tables>,
    facts: Arc<Facts>,
    scene: Scene,
}

impl Drop for MeshScene {
    fn drop(&mut self) {
        let held = (self.tables.clone(), self.facts.clone(), std::mem::take(&mut self.scene));
        release_later(held, self.tables.triangles.len() / AT_ONCE);
    }
}

arrays! { MeshScene {
    triangles: rows Rows<'py, i32> = |s| s.scene.turned.as_ref().map_or(&s.tables.triangles, |t| &t.triangles);
    triangle_part: flat Flat<'py, i32> = |s| &s.scene.triangle_part;
    triangle_group: flat Flat<'py, i32> = |s| &s.scene.bodies.group_of;
    curved: flat Flat<'py, bool> = |s| &s.scene.curved;
    loose: rows Rows<'py, i32> = |s| &s.scene.loose;
    edge_part: flat Flat<'py, i32> = |s| &s.scene.edge_part;
    edge_group: flat Flat<'py, i32> = |s| &s.scene.edge_group;
    edge_kind: flat Flat<'py, u8> = |s| &s.scene.kind;
    edge_curved: flat Flat<'py, bool> = |s| &s.scene.edge_curved;
    group_part: flat Flat<'py, i32> = |s| &s.scene.bodies.part_of;
    welded: flat Flat<'py, bool> = |s| &s.scene.bodies.welded;
    corner: rows Rows<'py, i32> = |s| s.scene.surfaces.corner.as_ref().unwrap_or(&s.tables.corner);
    face_place: matrices Bound<'py, PyArray3<f64>> = |s| &s.scene.surfaces.place;
    face_inward: flat Flat<'py, bool> = |s| &s.scene.surfaces.inward;
    face_curved: flat Flat<'py, bool> = |s| &s.scene.surfaces.curved;
}

    /// The mesh after closed surfaces that were inside out have been turned.
    #[getter]
    fn mesh(&self) -> MeshFacts {
        MeshFacts { tables: self.tables.clone(), facts: self.facts.clone() }
    }

    /// Along the edges of the source.
    fn walks(&self) -> Walks {
        Walks(self.scene.walks.clone())
    }

    /// (t,) which triangles were turned; None where none was.
    #[getter]
    fn turned<'py>(slf: &Bound<'py, Self>) -> Option<Flat<'py, bool>> {
        slf.get().scene.turned.as_ref()?;
        Some(flat(slf, |s| s.scene.turned.as_ref().map_or(&[], |t| &t.which[..])))
    }

    /// Where its surfaces pass through one another.
    fn crossings<'py>(
        &self,
        py: Python<'py>,
        groups: &Groups,
        contact: [f64; 3],
        deflection: f64,
    ) -> PyResult<Crossings<'py>> {
        crossings(py, (&self.tables, &self.facts, &self.scene), groups, contact, deflection)
    }

    /// How many groups are not surely one convex body.
    #[getter]
    fn folded(&self) -> usize {
        self.scene.folded.iter().filter(|&&folded| folded).count()
    }

    /// How many faces may show an outline.
    #[getter]
    fn curved_faces(&self) -> usize {
        self.scene.surfaces.curved.iter().filter(|&&curved| curved).count()
    }

    /// Properties of its groups.
    fn groups(&self) -> Groups {
        Groups(self.scene.bodies.groups.clone())
    }

    /// What was counted in each part.
    fn reports(&self) -> PartReports {
        let faces = self.tables.face_start.windows(2).map(|w| w[1] - w[0]);
        let of = |((&brep, faces), &counts): ((&bool, i32), &Report)| (brep, faces, counts);
        PartReports(self.tables.brep.iter().zip(faces).zip(&self.scene.reports).map(of).collect())
    }
}

/// Of each part whether it has a B-rep, its faces, and its counts.
#[pyclass(frozen)]
pub struct PartReports(Vec<(bool, i32, Report)>);

#[pymethods]
impl PartReports {
    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// Whether a part has a B-rep, its faces, and its counts.
    fn of(&self, part: usize) -> PyResult<(bool, i32, Report)> {
        self.0.get(part).copied().ok_or_else(|| PyIndexError::new_err("no such part"))
    }

    /// The numbers of parts of which anything was counted that may be a defect.
    fn suspects(&self) -> Vec<usize> {
        (0..self.0.len()).filter(|&part| self.0[part].2[..DEFECTS].iter().any(|&count| count != 0)).collect()
    }
}
