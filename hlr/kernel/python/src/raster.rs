//! Binding of `hlr_methods`: a scene of polygons that any of the visible-surface methods renders.

use std::sync::Mutex;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use super::arrays::{expect_below, expect_len, flat, rows};
use super::guard::caught;
use super::methods::{CameraTuple, LimitsTuple, Method, camera_of, method_of, with_tree, within};
use super::painters::{counted, sorted_list, tree_list};
use hlr_methods::active_edges::ActiveEdges;
use hlr_methods::bsp::Tree;
use hlr_methods::canvas::{Canvas, Visit, Write};
use hlr_methods::edge_record::{Active, Colour, Depth};
use hlr_methods::edge_table::EdgeTable;
use hlr_methods::limits::Watch;
use hlr_methods::non_planar::planar;
use hlr_methods::polygon_table::PolygonTable;
use hlr_methods::prepare::{Bent, screen};
use hlr_methods::scene::{Camera, Cubic, Rule, Scene};
use hlr_methods::screen::NONE;
use hlr_methods::statistics::Statistics;
use hlr_methods::stopwatch::Stopwatch;
use hlr_methods::{scan_line_z_buffer, shading};

/// An active edge where it crosses the row: polygon, edge; x and dx, z and dz, values and their steps.
type Record = (i32, u32, [f64; 2], [f64; 2], Option<[[f64; 3]; 2]>);
/// Active edges of a row, and its spans: from, to, polygons that are in.
type RowParts = (Vec<Record>, Vec<(i64, i64, Vec<i32>)>);
/// The same for Python.
type Row<'py> = (Bound<'py, PyList>, Bound<'py, PyList>);
/// A curved patch: its polygon, coefficients, origin, least and greatest depth.
type PatchTuple = (u32, [[f64; 4]; 4], [f64; 2], [f64; 2]);
/// Polygons in the plane, the node behind and the one in front.
type TreeNode = (Vec<i32>, Option<u32>, Option<u32>);

#[pyclass(frozen)]
pub struct RasterScene {
    points: Vec<[f64; 3]>,
    corners: Vec<i32>,
    loops: Vec<i32>,
    polygons: Vec<i32>,
    cull: Vec<bool>,
    values: Vec<[f64; 3]>,
    rule: Rule,
    patches: Vec<(u32, Cubic)>,
    /// Per planar polygon: the given polygon that it comes from; empty where they are the same.
    owner: Vec<u32>,
    tree: Mutex<Option<Tree>>,
}

struct Picture {
    ids: Vec<i32>,
    depth: Vec<f64>,
    values: Vec<[f64; 3]>,
    trace: Vec<Write>,
    visits: Vec<Visit>,
    statistics: Statistics,
    prepared: f64,
    seconds: f64,
}

/// The error of unfinished work within its limits: the caller interrupted, and `run` has raised that already.
fn unfinished() -> PyErr {
    pyo3::exceptions::PyRuntimeError::new_err("the kernel stopped unexpectedly")
}

impl RasterScene {
    fn scene(&self) -> Scene<'_> {
        Scene {
            points: &self.points,
            corners: &self.corners,
            loops: &self.loops,
            polygons: &self.polygons,
            cull: &self.cull,
            values: &self.values,
            rule: self.rule,
            patches: &self.patches,
        }
    }

    fn id(&self, polygon: u32) -> i32 {
        if self.owner.is_empty() { polygon as i32 } else { self.owner[polygon as usize] as i32 }
    }

    /// The picture; None where a limit was exceeded.
    fn picture(&self, camera: &Camera, method: Method, shaded: &str, traced: bool, watch: &Watch) -> Option<Picture> {
        let mut statistics = Statistics::default();
        let each = size_of::<(u32, i32, f64)>() + if shaded.is_empty() { 0 } else { size_of::<[f64; 3]>() };
        let pixels = camera.width as usize * camera.height as usize;
        if !watch.has_room(pixels * (each + method.bytes_per_pixel())) {
            return None;
        }
        let started = Stopwatch::start();
        let on = screen(&self.scene(), camera, Bent::Triangulated, watch, &mut statistics)?;
        let prepared = started.seconds();
        let started = Stopwatch::start();
        let mut canvas = Canvas::new(camera.width.into(), camera.height.into(), traced);
        method.fill(&self.scene(), &self.tree, &on, camera, &mut canvas, watch, &mut statistics)?;
        let seconds = started.seconds();
        let values = match shaded {
            "" => Vec::new(),
            _ => shading::shade(&on, &canvas.pixels, shaded == "correct", watch)?,
        };
        let id = |f: u32| self.id(on.facets[f as usize].id);
        let at = |(k, &f): (usize, &u32)| match f {
            NONE => f64::INFINITY,
            _ => on.true_depth(f, (k % canvas.width) as i64, (k / canvas.width) as i64),
        };
        // Empty unless a trace was requested.
        let mut trace: Vec<Write> = canvas.trace.take().into_iter().flatten().collect();
        trace.iter_mut().for_each(|w| w.facet = id(w.facet) as u32);
        let mut visits = std::mem::take(&mut canvas.visits);
        visits.iter_mut().filter(|v| v.facet != NONE).for_each(|v| v.facet = id(v.facet) as u32);
        Some(Picture {
            ids: canvas.pixels.iter().map(|&f| if f == NONE { -1 } else { id(f) }).collect(),
            depth: canvas.pixels.iter().enumerate().map(at).collect(),
            values,
            trace,
            visits,
            statistics,
            prepared,
            seconds,
        })
    }

    fn row(&self, camera: &Camera, row: i64, watch: &Watch) -> Option<RowParts> {
        let mut statistics = Statistics::default();
        let on = screen(&self.scene(), camera, Bent::Triangulated, watch, &mut statistics)?;
        let (mut edges, mut spans) = (Vec::new(), Vec::new());
        let table = EdgeTable::new(&on, watch)?;
        let mut active = ActiveEdges::<Depth>::new(&on, &table);
        let mut coloured = (!on.values.is_empty()).then(|| ActiveEdges::<Colour<false>>::new(&on, &table));
        let id = |f: u32| self.id(on.facets[f as usize].id);
        let here = loop {
            let next = active.next_row(&mut statistics);
            if let Some(coloured) = &mut coloured {
                coloured.next_row(&mut statistics);
            }
            match next {
                Some(here) if here < row && !watch.over() => {}
                Some(here) if here < row => return None,
                other => break other,
            }
        };
        if here == Some(row) {
            let mut polygons = PolygonTable::new(on.rule, on.facets.len());
            for (k, Active { edge: e, carried }) in active.edges.iter().enumerate() {
                let [z, dz] = on.crossing_depth(e, carried);
                let colour = coloured
                    .as_ref()
                    .map(|c| [c.edges[k].carried.value, c.edges[k].carried.down].map(|v| [v[0], v[1], v[2]]));
                edges.push((id(e.facet), e.number, [e.crossing(), e.slope()], [z, dz], colour));
                polygons.cross(e.facet, e.winding);
                if let Some(next) = active.edges.get(k + 1).map(|n| n.edge.column).filter(|&n| n > e.column) {
                    let mut inside: Vec<i32> = polygons.inside.iter().map(|&f| id(f)).collect();
                    inside.sort_unstable();
                    spans.push((e.column, next, inside));
                }
            }
        }
        Some((edges, spans))
    }
}

#[pymethods]
impl RasterScene {
    #[new]
    #[pyo3(signature = (points, corners, loops, polygons, cull, values, non_zero, limits, patches = vec![]))]
    #[allow(clippy::too_many_arguments)] // one per array: the stub names them
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        corners: PyReadonlyArray1<'_, i32>,
        loops: PyReadonlyArray1<'_, i32>,
        polygons: PyReadonlyArray1<'_, i32>,
        cull: PyReadonlyArray1<'_, bool>,
        values: PyReadonlyArray2<'_, f64>,
        non_zero: bool,
        limits: LimitsTuple,
        patches: Vec<PatchTuple>,
    ) -> PyResult<RasterScene> {
        caught(py, || {
            let points = rows::<f64, 3>(&points, "points")?;
            let (corners, loops) = (flat(&corners, "corners")?, flat(&loops, "loops")?);
            let (polygons, cull) = (flat(&polygons, "polygons")?, flat(&cull, "cull")?);
            let values = rows::<f64, 3>(&values, "values")?;
            expect_below("corners", corners.iter().copied(), points.len())?;
            for (name, offsets, end) in
                [("loops", loops, corners.len()), ("polygons", polygons, loops.len().max(1) - 1)]
            {
                let rising = offsets.windows(2).all(|w| w[0] < w[1]);
                if !rising || offsets.first() != Some(&0) || offsets.last().map(|&l| l as usize) != Some(end) {
                    return Err(PyValueError::new_err(format!("{name} must rise from 0 to {end}")));
                }
            }
            expect_len("cull", cull.len(), polygons.len() - 1)?;
            if !values.is_empty() {
                expect_len("values", values.len(), points.len())?;
            }
            for (name, numbers) in [("points", points), ("values", values)] {
                if !numbers.iter().flatten().all(|c| c.is_finite()) {
                    return Err(PyValueError::new_err(format!("{name} hold numbers that are not finite")));
                }
            }
            let mut scene = RasterScene {
                points: points.to_vec(),
                corners: corners.to_vec(),
                loops: loops.to_vec(),
                polygons: polygons.to_vec(),
                cull: cull.to_vec(),
                values: values.to_vec(),
                rule: if non_zero { Rule::NonZero } else { Rule::EvenOdd },
                patches: patches
                    .into_iter()
                    .map(|(p, c, o, r)| (p, Cubic { coefficients: c, origin: o, range: r }))
                    .collect(),
                owner: Vec::new(),
                tree: Mutex::new(None),
            };
            if let Some(Some(p)) = within(py, limits, |watch| planar(&scene.scene(), watch))? {
                (scene.corners, scene.loops, scene.polygons) = (p.corners, p.loops, p.polygons);
                (scene.cull, scene.owner) = (p.cull, p.owner);
                // The outline of a patch is planar, and stays in one piece.
                for (polygon, _) in &mut scene.patches {
                    *polygon = scene.owner.partition_point(|owner| owner < polygon) as u32;
                }
            }
            Ok(scene)
        })
    }

    /// method: its name and its variant, "" for the default.
    #[pyo3(signature = (camera, method, limits, shaded, traced))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        camera: CameraTuple,
        method: (String, String),
        limits: LimitsTuple,
        shaded: &str,
        traced: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (camera, method) = (camera_of(camera), method_of(&method.0, &method.1)?);
        let (height, width) = (camera.height as usize, camera.width as usize);
        let found = within(py, limits, |watch| self.picture(&camera, method, shaded, traced, watch))?;
        let found = found.ok_or_else(unfinished)?;
        let out = PyDict::new(py);
        out.set_item("ids", found.ids.into_pyarray(py).reshape([height, width])?)?;
        out.set_item("depth", found.depth.into_pyarray(py).reshape([height, width])?)?;
        if !found.values.is_empty() {
            out.set_item("values", found.values.into_flattened().into_pyarray(py).reshape([height, width, 3])?)?;
        }
        let count = found.trace.len();
        let trace: Vec<i32> =
            found.trace.iter().flat_map(|w| [w.row as i32, w.from as i32, w.to as i32, w.facet as i32]).collect();
        out.set_item("trace", trace.into_pyarray(py).reshape([count, 4])?)?;
        let areas: Vec<[i32; 9]> = found
            .visits
            .iter()
            .map(|v| {
                let [[left, right], [top, bottom]] = [v.columns, v.rows];
                let (level, polygons, passed) = (v.level as i32, v.polygons as i32, v.passed as i32);
                [left, right, top, bottom, level, polygons, passed, v.ending as i32, v.facet as i32]
            })
            .collect();
        let count = areas.len();
        out.set_item("areas", areas.into_flattened().into_pyarray(py).reshape([count, 9])?)?;
        out.set_item("statistics", counted(py, &found.statistics, found.prepared, found.seconds)?)?;
        Ok(out)
    }

    /// The painter's list of depth sort or of the BSP tree: ids, where each one's loops and points begin, points in
    /// pixels.
    #[pyo3(signature = (camera, method, limits))]
    fn painters_list<'py>(
        &self,
        py: Python<'py>,
        camera: CameraTuple,
        method: &str,
        limits: LimitsTuple,
    ) -> PyResult<Bound<'py, PyDict>> {
        let camera = camera_of(camera);
        let by_tree = matches!(method_of(method, "")?, Method::Bsp);
        let found = within(py, limits, |watch| {
            let mut statistics = Statistics::default();
            let listed = if by_tree {
                with_tree(&self.scene(), &self.tree, watch, &mut statistics, |tree, _| tree_list(tree, &camera, watch))
            } else {
                screen(&self.scene(), &camera, Bent::Whole, watch, &mut statistics)
                    .and_then(|on| sorted_list(&on, watch, &mut statistics))
            };
            listed.map(|l| (l, statistics))
        })?;
        let (list, statistics) = found.ok_or_else(unfinished)?;
        let out = PyDict::new(py);
        let (mut ids, mut polygons, mut loops, mut points) = (vec![], vec![0i32], vec![0i32], Vec::<[f64; 2]>::new());
        for (polygon, pieces) in list {
            ids.push(self.id(polygon));
            for l in pieces {
                points.extend(l);
                loops.push(points.len() as i32);
            }
            polygons.push(loops.len() as i32 - 1);
        }
        let count = points.len();
        out.set_item("ids", ids.into_pyarray(py))?;
        out.set_item("polygons", polygons.into_pyarray(py))?;
        out.set_item("loops", loops.into_pyarray(py))?;
        out.set_item("points", points.into_flattened().into_pyarray(py).reshape([count, 2])?)?;
        out.set_item("statistics", counted(py, &statistics, 0.0, 0.0)?)?;
        Ok(out)
    }

    /// One row as the scan line sees it: records of active edges (polygon, edge, (x, dx), (z, dz), values and their
    /// steps) and spans (from, to, polygons that are in).
    fn scan_row<'py>(&self, py: Python<'py>, camera: CameraTuple, row: i64, limits: LimitsTuple) -> PyResult<Row<'py>> {
        let camera = camera_of(camera);
        let found = within(py, limits, |watch| self.row(&camera, row, watch))?;
        let (edges, spans) = found.ok_or_else(unfinished)?;
        Ok((PyList::new(py, edges)?, PyList::new(py, spans)?))
    }

    /// Pairs of crossings (row, from, to, polygon) in the order in which the merged list completes them.
    fn pairs<'py>(
        &self,
        py: Python<'py>,
        camera: CameraTuple,
        limits: LimitsTuple,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let camera = camera_of(camera);
        let found = within(py, limits, |watch| {
            let mut statistics = Statistics::default();
            let mut canvas = Canvas::new(camera.width.into(), camera.height.into(), false);
            let mut out = Vec::new();
            let on = screen(&self.scene(), &camera, Bent::Triangulated, watch, &mut statistics)?;
            let mut paired = |w: Write| {
                let id = self.id(on.facets[w.facet as usize].id);
                out.extend([w.row as i32, w.from as i32, w.to as i32, id]);
            };
            scan_line_z_buffer::merged(&on, &mut canvas, watch, &mut statistics, &mut paired)?;
            Some(out)
        })?;
        Ok(found.ok_or_else(unfinished)?.into_pyarray(py))
    }

    /// The BSP tree's nodes, the root first: (polygons in the plane, node behind, node in front).
    fn tree(&self, py: Python<'_>, limits: LimitsTuple) -> PyResult<Vec<TreeNode>> {
        let drawn = within(py, limits, |watch| {
            with_tree(&self.scene(), &self.tree, watch, &mut Statistics::default(), |tree, _| Some(tree.drawn()))
        })?;
        let ids = |polygons: Vec<u32>| polygons.into_iter().map(|p| self.id(p)).collect();
        Ok(drawn.ok_or_else(unfinished)?.into_iter().map(|(p, behind, front)| (ids(p), behind, front)).collect())
    }

    /// The scene with some of its points moved. Its tree is kept: the polygons at those points are inserted again.
    fn moved(&self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>, limits: LimitsTuple) -> PyResult<RasterScene> {
        let points = rows::<f64, 3>(&points, "points")?;
        expect_len("points", points.len(), self.points.len())?;
        let tree = self.tree.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
        let mut out = RasterScene {
            points: points.to_vec(),
            corners: self.corners.clone(),
            loops: self.loops.clone(),
            polygons: self.polygons.clone(),
            cull: self.cull.clone(),
            values: self.values.clone(),
            rule: self.rule,
            patches: self.patches.clone(),
            owner: self.owner.clone(),
            tree: Mutex::new(None),
        };
        if let Some(mut tree) = tree {
            let scene = out.scene();
            let elsewhere = |&i: &i32| points[i as usize] != self.points[i as usize];
            let moved: Vec<u32> =
                (0..scene.len() as u32).filter(|&p| scene.loops_of(p as usize).flatten().any(elsewhere)).collect();
            tree.remove(&moved);
            let done = within(py, limits, |watch| {
                tree.insert(&scene, &moved, watch, &mut Statistics::default()).map(|()| tree)
            })?;
            out.tree = Mutex::new(done);
        }
        Ok(out)
    }
}
