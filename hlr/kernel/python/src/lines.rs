//! Binding of `hlr_linework::lines`: from pieces of mesh edges to the lines of a drawing.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};
use super::camera::Camera;
use super::chains::Chains;
use super::drawing::Lines;
use super::geometry::Curves as Records;
use super::guard::caught;
use super::mesh_input::Mesh;
use super::threads::run;
use super::visibility::Visibility;
use hlr_linework::fit::routes::{Curves, Fit, Guide};
use hlr_linework::lines::camera::Camera as PaperCamera;
use hlr_linework::lines::candidates::{About, Chains as Walks};
use hlr_linework::lines::coincident::Widths;
use hlr_linework::lines::cut::{Cut as Found, Tolerances, Trait, cut};
use hlr_linework::lines::finish::{finish, guide};
use hlr_linework::lines::geometry::Geometry;

/// How far lines may be off, and which lines are too short to be drawn.
#[pyclass(frozen)]
pub struct LineTolerances {
    cut: Tolerances,
    fit: Fit,
}

#[pymethods]
impl LineTolerances {
    #[new]
    #[pyo3(signature = (*, accuracy, short, flip, stub, width, under, thin_paper, thin_model, chord, closed, contact))]
    #[allow(clippy::too_many_arguments)] // one argument per length: the stub names them
    fn new(
        accuracy: f64,
        short: f64,
        flip: f64,
        stub: f64,
        width: f64,
        under: f64,
        thin_paper: f64,
        thin_model: f64,
        chord: f64,
        closed: f64,
        contact: f64,
    ) -> LineTolerances {
        let widths = Widths { same: width, under };
        LineTolerances {
            cut: Tolerances { accuracy, short, flip, stub, widths, flat: thin_paper, space: thin_model },
            fit: Fit { accuracy, chord, closed, contact },
        }
    }
}

/// Curves, their places, and per chain its curve, -1 for none, its place, and how far the curve rises above its chords.
type Along<'py> = (
    PyRef<'py, Records>,
    PyReadonlyArray3<'py, f64>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, f64>,
);

/// What is added to the rank of a shallow intersection line: edges and outlines that run beside it are drawn instead.
const SHALLOW_RANK: u8 = 8;

/// Lines on paper, chained, merged and thinned out, before curves are fitted to them.
#[pyclass(frozen)]
pub struct Cut {
    chains: Arc<Walks>,
    traits: Vec<Trait>,
    camera: PaperCamera,
    fit: Fit,
    hidden: bool,
    /// Per line: its chain.
    chain: Vec<i32>,
    drawn: usize,
    found: Mutex<Option<Found>>,
}

#[pymethods]
impl Cut {
    #[new]
    #[pyo3(signature = (camera, mesh, found, chains, ranks, tolerances, hidden, true_points = None))]
    #[allow(clippy::too_many_arguments)] // four objects, a table and what is asked for
    fn new(
        py: Python<'_>,
        camera: &Camera,
        mesh: &Mesh,
        found: &Visibility,
        chains: &Chains,
        ranks: PyReadonlyArray1<'_, u8>,
        tolerances: &LineTolerances,
        hidden: bool,
        true_points: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Cut> {
        caught(py, || {
            let (camera, has_faces, chains) = (camera.0, &chains.has_faces, &chains.found);
            let reading = mesh.reading(py)?;
            let all = reading.slices()?;
            let (meshed, edges) = (all.points, all.edges);
            let space = true_points.as_ref().map(|p| rows(p, "true_points")).transpose()?.unwrap_or(meshed);
            expect_len("true_points", space.len(), meshed.len())?;
            let ranks = flat(&ranks, "ranks")?;
            let (cutting, fit) = (tolerances.cut, tolerances.fit);
            expect_below("chains", chains.edges.iter().copied(), edges.len())?;
            expect_below("found", found.edge.iter().copied(), edges.len())?;
            expect_below("classes of chains", chains.about.iter().map(|a| i32::from(a.kind.0)), ranks.len())?;
            expect_below("parts of chains", chains.about.iter().map(|a| a.part), has_faces.len())?;
            if !found.hidden.is_empty() {
                expect_len("edges of found", found.hidden.len(), edges.len())?;
            }
            // Where a shaft's outline lies on that of its bore, the shaft's is drawn.
            let behind = |c: usize| found.hidden.get(chains.edges[chains.offsets[c] as usize] as usize) == Some(&true);
            let trait_of = |(c, about): (usize, &About)| Trait {
                rank: ranks[about.kind.0 as usize] + u8::from(behind(c)) + if about.shallow { SHALLOW_RANK } else { 0 },
                // The contours of meshes are smoothed; those of a B-rep's mesh have no accuracy left for it.
                without_brep: !has_faces[about.part as usize],
                noisy: about.noisy,
            };
            let traits: Vec<Trait> = chains.about.iter().enumerate().map(trait_of).collect();
            let lines = run(py, chains.edges.len(), |stopped| {
                let (pieces, piece_edge) = (&found.pieces[..], &found.edge[..]);
                let geometry = Geometry { camera: &camera, space, meshed, edges, pieces, piece_edge };
                let mut lines = cut(&geometry, chains, &traits, &cutting, stopped)?;
                if !hidden {
                    lines.keep_sighted(traits.len());
                }
                Some(lines)
            })?
            .ok_or_else(|| PyKeyboardInterrupt::new_err("stopped"))?;
            Ok(Cut {
                chains: chains.clone(),
                traits,
                camera,
                fit,
                hidden,
                chain: lines.lines.iter().map(|line| line.chain as i32).collect(),
                drawn: lines.lines.iter().filter(|line| line.visible || hidden).count(),
                found: Mutex::new(Some(lines)),
            })
        })
    }

    /// Number of lines that will be drawn.
    fn __len__(&self) -> usize {
        self.drawn
    }

    /// (lines,) the chain of each line, also of lines that are not drawn but on which others end.
    #[getter]
    fn chain<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        self.chain.clone().into_pyarray(py)
    }

    /// The lines with their curves, and their lower left corner. Can be called only once.
    #[pyo3(signature = (along = None))]
    fn finished(&self, py: Python<'_>, along: Option<Along<'_>>) -> PyResult<(Lines, (f64, f64))> {
        let Some((curves, places, curve, place, bulge)) = along else {
            return self.made(py, &Curves::default(), |_| (None, 0, 0.0));
        };
        let curves = Curves {
            known: true,
            curves: curves.curves.clone(),
            ranges: curves.ranges.clone(),
            places: matrices(&places)?.to_vec(),
        };
        let (curve, place, bulge) = (flat(&curve, "curve")?, flat(&place, "place")?, flat(&bulge, "bulge")?);
        for (name, found) in [("curve", curve.len()), ("place", place.len()), ("bulge", bulge.len())] {
            expect_len(name, found, self.traits.len())?;
        }
        expect_below("curve", curve.iter().copied().filter(|&c| c >= 0), curves.curves.len())?;
        let used = |c: &usize| curve[*c] >= 0;
        expect_below("place", (0..place.len()).filter(used).map(|c| place[c]), curves.places.len())?;
        self.made(py, &curves, |c| (u32::try_from(curve[c]).ok(), place[c] as u32, bulge[c]))
    }
}

impl Cut {
    /// along: the curve, the place and the bulge of a chain.
    fn made(
        &self,
        py: Python<'_>,
        curves: &Curves,
        along: impl Fn(usize) -> (Option<u32>, u32, f64),
    ) -> PyResult<(Lines, (f64, f64))> {
        let about = &self.chains.about;
        let of = |(c, (about, of)): (usize, (&About, &Trait))| {
            let (curve, place, bulge) = along(c);
            guide(about, of, curve, place, bulge)
        };
        let guides: Vec<Guide> = about.iter().zip(&self.traits).enumerate().map(of).collect();
        let held = self.found.lock().unwrap_or_else(PoisonError::into_inner).take();
        let found = held.ok_or_else(|| PyValueError::new_err("these lines were finished before"))?;
        let size = found.lines.iter().map(|line| line.flat.len()).sum();
        let (lines, [x, y]) =
            run(py, size, |_| finish(found, about, &guides, curves, &self.camera, &self.fit, self.hidden))?;
        Ok((Lines::of(lines), (x, y)))
    }
}

fn matrices<'a>(places: &'a PyReadonlyArray3<'_, f64>) -> PyResult<&'a [[[f64; 4]; 3]]> {
    let wrong = || PyValueError::new_err("places must be a C-contiguous (n, 3, 4) array");
    if places.as_array().shape()[1..] != [3, 4] {
        return Err(wrong());
    }
    Ok(places.as_slice().map_err(|_| wrong())?.as_chunks::<4>().0.as_chunks::<3>().0)
}
