//! Binding of `hlr_brep`: a model from a dump, its meshes, and their parts as arrays.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
};
use pyo3::exceptions::{PyKeyboardInterrupt, PyMemoryError, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows as rows_of, table};
use super::guard::caught;
use super::parts::{PartTables, to_matrices};
use super::threads::{FEW, release_later, run, run_telling};
use hlr_brep::assemble::assemble;
use hlr_brep::bounds::boxes;
use hlr_brep::crossed::with_crossed_loops;
use hlr_brep::divided::{Piece, divided};
use hlr_brep::explore::Part;
use hlr_brep::foreign_mesh::{Border, ForeignMesh, with_foreign_mesh};
use hlr_brep::geometry::planar::is_flat;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::mesh::{Fault, Interrupted, OF_A_FACE, Progress, points_inside};
use hlr_brep::model::Model;
use hlr_brep::one_sphere::is_one_sphere;
use hlr_brep::reach::{Placed, reach};
use hlr_brep::shapes::Face;
use hlr_brep::tessellate::{ChordErrors, Ended, LIMITS, Limits, MeshedFace, Tessellation, Watch, tessellate};
use hlr_mesh::tables::Tables;

type Records<'py> = (Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<f64>>);
type Curves<'py> =
    (Bound<'py, PyArray1<u8>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<f64>>);

/// For each shape its pieces, each as its number among the parts, and whether it is a solid; and (n, 4, 4) where all the
/// pieces stand, one shape after another.
type Pieces<'py> = (Vec<Vec<(usize, bool)>>, Bound<'py, PyArray3<f64>>);

/// Parts, faces and edges of a dump, each underlying face and edge once.
#[pyclass(frozen)]
pub struct BrepModel(pub(super) Arc<Model>);

impl Drop for BrepModel {
    fn drop(&mut self) {
        release_later(self.0.clone(), self.0.faces.len());
    }
}

#[pymethods]
impl BrepModel {
    #[new]
    #[pyo3(signature = (dump, chosen = None))]
    fn new(py: Python<'_>, dump: &[u8], chosen: Option<Vec<u32>>) -> PyResult<BrepModel> {
        caught(py, || {
            // A kilobyte takes about ten microseconds.
            let read = run(py, dump.len() / 64, |_| Model::read(dump, chosen.as_deref()))?;
            let model = read.map_err(|damage| PyValueError::new_err(damage.to_string()))?;
            Ok(BrepModel(Arc::new(model)))
        })
    }

    /// The model of the distinct pieces of shapes in memory, from the stream of their compound, or of one shape alone.
    #[staticmethod]
    #[pyo3(signature = (stream, alone = false))]
    fn divided<'py>(py: Python<'py>, stream: &[u8], alone: bool) -> PyResult<(BrepModel, Pieces<'py>)> {
        caught(py, || {
            let read = run(py, stream.len() / 64, |_| divided(stream, alone))?;
            let (model, pieces) = read.map_err(|damage| PyValueError::new_err(damage.to_string()))?;
            let all = || pieces.iter().flatten();
            let mut places = Vec::with_capacity(16 * all().count());
            for piece in all() {
                // Minus zeros become zeros.
                places.extend(piece.place.as_flattened().iter().map(|number| number + 0.0));
                places.extend([0.0, 0.0, 0.0, 1.0]);
            }
            let places = places.into_pyarray(py).reshape([all().count(), 4, 4])?;
            let of = |shape: &Vec<Piece>| shape.iter().map(|p| (p.part, p.solid)).collect();
            Ok((BrepModel(Arc::new(model)), (pieces.iter().map(of).collect(), places)))
        })
    }

    /// Number of underlying faces; their numbers follow the order in which an explorer meets them.
    #[getter]
    fn n_faces(&self) -> usize {
        self.0.faces.len()
    }

    /// Faces of each part; a face that is placed several times counts each time.
    #[getter]
    fn faces_of_parts(&self) -> Vec<usize> {
        self.0.parts.iter().map(|part| part.faces.len()).collect()
    }

    /// (parts, 3) faces, edges and solids in the index maps of each part.
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let of = |part: &Part| [part.faces.len(), part.edges.len(), part.solids].map(|count| count as i32);
        table(py, self.0.parts.iter().map(of).collect())
    }

    /// (parts, 2, 3) lower and upper corner of the box around each part; the lower is beyond the upper where it has no
    /// extent.
    fn boxes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let found = run(py, 10 * self.0.faces.len(), |_| boxes(&self.0))?;
        let count = found.len();
        found.into_flattened().into_flattened().into_pyarray(py).reshape([count, 2, 3])
    }

    /// (2, 2) how far placed parts reach along two directions, of length 1: lower and upper end along each; the lower is
    /// beyond the upper where there is nothing. parts (n,): numbers; places (n, 3, 4): where they stand.
    fn reach<'py>(
        &self,
        py: Python<'py>,
        parts: PyReadonlyArray1<'py, i32>,
        places: PyReadonlyArray3<'py, f64>,
        right: [f64; 3],
        up: [f64; 3],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let parts = flat(&parts, "parts")?;
        expect_below("parts", parts.iter().copied(), self.0.parts.len())?;
        let places = to_matrices(&places, "places", parts.len())?;
        let placed: Vec<Placed> = parts.iter().map(|part| *part as usize).zip(places).collect();
        let size = placed.iter().map(|(part, _)| self.0.parts[*part].edges.len()).sum();
        let found = run(py, size, |_| reach(&self.0, &placed, [right, up]))?;
        table(py, found.to_vec())
    }

    /// (faces,) whether each departs from a plane by no more than the tolerance.
    fn planar<'py>(&self, py: Python<'py>, tolerance: f64) -> Bound<'py, PyArray1<bool>> {
        let planar = |r: &hlr_brep::format::SurfaceRecord| is_flat(r.kind, &r.data, tolerance);
        let all: Vec<bool> = self.0.faces.iter().map(|f| f.record.as_ref().is_some_and(planar)).collect();
        all.into_pyarray(py)
    }

    /// Surfaces of faces as packed records: kind, offsets, data.
    fn surface_records<'py>(&self, py: Python<'py>, numbers: PyReadonlyArray1<'py, i32>) -> PyResult<Records<'py>> {
        let numbers = flat(&numbers, "numbers")?;
        expect_below("numbers", numbers.iter().copied(), self.0.faces.len())?;
        let (mut kind, mut offsets, mut data) = (Vec::new(), vec![0i32], Vec::new());
        for &i in numbers {
            let record = self.0.faces[i as usize].record.as_ref();
            kind.push(record.map_or(0, |r| r.kind));
            data.extend(record.into_iter().flat_map(|r| &r.data));
            offsets.push(data.len() as i32);
        }
        Ok((kind.into_pyarray(py), offsets.into_pyarray(py), data.into_pyarray(py)))
    }

    /// Faces on tori whose tube reaches beyond their axis: number, major and minor radius.
    fn spindles(&self) -> Vec<(i32, f64, f64)> {
        let radii = |(i, face): (i32, &Face)| match face.surface {
            Some(Surface::Torus(_, major, minor)) if minor > major => Some((i, major, minor)),
            _ => None,
        };
        (0..).zip(&self.0.faces).filter_map(radii).collect()
    }

    /// Numbers of the faces that lie on another face beside a common edge.
    fn folded(&self) -> Vec<u32> {
        self.0.folded.clone()
    }

    /// Curves of edges as packed records: kind, range, offsets, values. Edges are given as parts and numbers in their
    /// edge maps; curves are in the frames of their parts.
    fn edge_curves<'py>(
        &self,
        py: Python<'py>,
        part: PyReadonlyArray1<'py, i32>,
        edge: PyReadonlyArray1<'py, i32>,
    ) -> PyResult<Curves<'py>> {
        let (part, edge) = (flat(&part, "part")?, flat(&edge, "edge")?);
        expect_len("edge", edge.len(), part.len())?;
        expect_below("part", part.iter().copied(), self.0.topology.len())?;
        let (mut kind, mut range, mut offsets, mut values) = (Vec::new(), Vec::new(), vec![0i32], Vec::new());
        for (&p, &e) in part.iter().zip(edge) {
            let placed = &self.0.topology[p as usize].edges;
            expect_below("edge", [e].into_iter(), placed.len())?;
            let placed = &placed[e as usize];
            let edge = &self.0.edges[placed.edge as usize];
            kind.push(match (&edge.curve, &placed.place) {
                (None, _) => 0,
                (Some(curve), None) => curve.record(&mut values),
                (Some(curve), Some(place)) => curve.moved(place).record(&mut values),
            });
            range.extend(edge.range);
            offsets.push(values.len() as i32);
        }
        let range = range.into_pyarray(py).reshape([part.len(), 2])?;
        Ok((kind.into_pyarray(py), range, offsets.into_pyarray(py), values.into_pyarray(py)))
    }

    /// Whether the model is one part, and that one whole sphere.
    fn is_one_sphere(&self) -> bool {
        is_one_sphere(&self.0)
    }

    /// Meshes all faces. `progress`: called with the share of faces that are done; `shares` (faces,): of the deflection,
    /// how much of it each face may use, in (0, 1]; `most_steps`: of one face, other than `LIMITS` has for tests alone. A
    /// MemoryError: there would be more points than the limit.
    #[pyo3(signature = (deflection, angle, progress = None, shares = None, most_steps = LIMITS.steps))]
    fn mesh(
        &self,
        py: Python<'_>,
        deflection: f64,
        angle: f64,
        progress: Option<Py<PyAny>>,
        shares: Option<PyReadonlyArray1<'_, f64>>,
        most_steps: u64,
    ) -> PyResult<BrepMesh> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !positive(deflection) || !positive(angle) {
            return Err(PyValueError::new_err("deflection and angle must be positive"));
        }
        let (model, done) = (&self.0, AtomicUsize::new(0));
        let errors = match &shares {
            None => ChordErrors::same(model, deflection),
            Some(shares) => {
                let shares = flat(shares, "shares")?;
                expect_len("shares", shares.len(), model.faces.len())?;
                if shares.iter().any(|&share| !(share > 0.0 && share <= 1.0)) {
                    return Err(PyValueError::new_err("shares must be above 0 and at most 1"));
                }
                ChordErrors::of_faces(model, deflection, shares)
            }
        };
        let tell = |py: Python<'_>| {
            let share = done.load(Ordering::Relaxed) as f64 / (OF_A_FACE * model.faces.len().max(1)) as f64;
            progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, (share,)).map(|_| ()))
        };
        let limits = Limits { steps: most_steps, ..LIMITS };
        let work = |stopped: &(dyn Fn() -> bool + Sync)| {
            tessellate(model, &errors, angle, limits, &Watch { stopped, done: &done })
        };
        // A face costs as much as many points.
        let inside = |face: &Face| face.surface.as_ref().map_or(Some(0), |s| points_inside(s, deflection, angle));
        let size = model.faces.iter().map(|face| 100 + inside(face).unwrap_or(FEW).min(FEW)).sum();
        let meshed = run_telling(py, size, tell, work)?;
        let meshed = meshed.map_err(|ended| match ended {
            Ended::Stopped => PyKeyboardInterrupt::new_err("stopped"),
            Ended::TooFine => PyMemoryError::new_err("the mesh would have too many points"),
        })?;
        Ok(BrepMesh { model: model.clone(), meshed: Mutex::new(meshed) })
    }
}

/// The mesh of a model at one chord error.
#[pyclass(frozen)]
pub struct BrepMesh {
    model: Arc<Model>,
    meshed: Mutex<Tessellation>,
}

impl Drop for BrepMesh {
    fn drop(&mut self) {
        let meshed = self.meshed.get_mut().unwrap_or_else(PoisonError::into_inner);
        let held = std::mem::replace(meshed, Tessellation { lines: Vec::new(), faces: Vec::new() });
        let size = held.faces.len();
        release_later((self.model.clone(), held), size);
    }
}

#[pymethods]
impl BrepMesh {
    /// Whether each face has a mesh with which nothing is wrong: none is named by `faults`, `turned`, `torn` and
    /// `unfinished`.
    fn is_sound(&self) -> bool {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let sound = |face: &MeshedFace| {
            let mesh = &face.mesh;
            let off = [mesh.torn, mesh.unfinished].iter().any(|&far| far > 0.0);
            face.fault.is_none() && mesh.turned.is_empty() && !off
        };
        meshed.faces.iter().all(sound)
    }

    /// Numbers of the faces without a mesh, each with the reason.
    fn faults(&self) -> Vec<(usize, String)> {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let of = |(i, face): (usize, &MeshedFace)| Some((i, face.fault.as_ref()?.to_string()));
        meshed.faces.iter().enumerate().filter_map(of).collect()
    }

    /// Numbers of the faces with loops that run the wrong way, each with how many.
    fn turned(&self) -> Vec<(usize, usize)> {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let count = meshed.faces.iter().map(|face| face.mesh.turned.len());
        count.enumerate().filter(|&(_, loops)| loops > 0).collect()
    }

    /// Numbers of the faces whose surface is torn, each with the chord error there (model units).
    fn torn(&self) -> Vec<(usize, f64)> {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let torn = meshed.faces.iter().map(|face| face.mesh.torn);
        torn.enumerate().filter(|&(_, torn)| torn > 0.0).collect()
    }

    /// Numbers of the faces that took as many steps as a face may take, each with the chord error that its mesh has
    /// (model units): infinite where it has none.
    fn unfinished(&self) -> Vec<(usize, f64)> {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let far = |face: &MeshedFace| match face.fault {
            Some(Fault::TooMuchWork) => f64::INFINITY,
            _ => face.mesh.unfinished,
        };
        meshed.faces.iter().map(far).enumerate().filter(|&(_, far)| far > 0.0).collect()
    }

    /// Numbers of the faces whose edges are farther off their surface than `most` (model units), each with how far.
    fn off_their_edges(&self, most: f64) -> Vec<(usize, f64)> {
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let off = meshed.faces.iter().map(|face| face.off);
        off.enumerate().filter(|&(_, off)| off > most).collect()
    }

    /// Gives a face the triangles of another mesher: points (n, 3) in the face's frame, uv (n, 2), triangles (m, 3)
    /// counterclockwise in (u, v), and for each edge in each wire its nodes and their parameters, in the edge's sense.
    /// Returns whether they fit the face.
    fn replace(
        &self,
        face: usize,
        points: PyReadonlyArray2<'_, f64>,
        uv: PyReadonlyArray2<'_, f64>,
        triangles: PyReadonlyArray2<'_, i32>,
        borders: Vec<(Vec<u32>, Vec<f64>)>,
    ) -> PyResult<bool> {
        let (points, uv) = (rows_of::<f64, 3>(&points, "points")?, rows_of::<f64, 2>(&uv, "uv")?);
        let triangles = rows_of::<i32, 3>(&triangles, "triangles")?;
        expect_len("uv", uv.len(), points.len())?;
        expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
        expect_below("face", [face as i32].into_iter(), self.model.faces.len())?;
        if borders.iter().flat_map(|b| &b.0).any(|&i| i as usize >= points.len()) {
            return Err(PyValueError::new_err("borders must count points"));
        }
        let foreign = ForeignMesh {
            points: points.to_vec(),
            uv: uv.to_vec(),
            triangles: triangles.iter().map(|t| t.map(|i| i as u32)).collect(),
            borders: borders.into_iter().map(|(nodes, parameters)| Border { nodes, parameters }).collect(),
        };
        let mut meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let found = with_foreign_mesh(&self.model, &meshed, face, foreign);
        Ok(found.map(|found| meshed.faces[face] = found).is_some())
    }

    /// Meshes a face whose loops cross or lie upon one another, as far as they enclose it. Whether that succeeded.
    fn fill(&self, py: Python<'_>, face: usize, deflection: f64, angle: f64) -> PyResult<bool> {
        expect_below("face", [face as i32].into_iter(), self.model.faces.len())?;
        let mut meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let found = run(py, FEW + 1, |stopped| {
            let steps = Progress::new(stopped, None, LIMITS.steps);
            match steps.watched(|| with_crossed_loops(&self.model, &meshed, face, deflection, angle, &steps)) {
                Ok(found) => Some(found),
                Err(Interrupted::TooMuch) => Some(None),
                Err(Interrupted::Stopped) => None,
            }
        })?;
        let found = found.ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
        Ok(found.map(|found| meshed.faces[face] = found).is_some())
    }

    /// The meshes of all parts; planar: (faces,) as `BrepModel.planar` returns it.
    fn parts(&self, py: Python<'_>, planar: PyReadonlyArray1<'_, bool>) -> PyResult<PartTables> {
        let planar = flat(&planar, "planar")?;
        expect_len("planar", planar.len(), self.model.faces.len())?;
        let meshed = self.meshed.lock().unwrap_or_else(PoisonError::into_inner);
        let points = meshed.faces.iter().map(|face| face.mesh.points.len()).sum::<usize>();
        let parts = run(py, points / 8, |_| Tables::of_roots(assemble(&self.model, &meshed), planar))?;
        let parts = parts.map_err(|_| PyValueError::new_err("more than 2^31 items in one mesh"))?;
        Ok(PartTables(Arc::new(parts)))
    }
}
