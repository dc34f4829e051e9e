//! The visible-surface methods as Python sees them: a scene of polygons that can be rendered by any of them.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use super::painters::{counted, sorted_list, tree_list};
use super::running::run;
use super::scan::{expect_below, expect_len, flat, rows};
use crate::raster::active_edges::ActiveEdges;
use crate::raster::bsp::{self, Tree};
use crate::raster::canvas::{Canvas, Write};
use crate::raster::edge_table::EdgeTable;
use crate::raster::polygon_table::PolygonTable;
use crate::raster::ray_casting::Acceleration;
use crate::raster::scan_line::Coherence;
use crate::raster::scan_line_z_buffer::Lists;
use crate::raster::scene::{Camera, Rule, Scene};
use crate::raster::screen::{Bent, NONE, Screen, screen};
use crate::raster::statistics::Statistics;
use crate::raster::stopwatch::Stopwatch;
use crate::raster::warped::planar;
use crate::raster::watch::Watch;
use crate::raster::z_buffer::Nearer;
use crate::raster::{depth_sort, ray_casting, scan_line, scan_line_z_buffer, shading, span_list, warnock, z_buffer};

/// Matrix, size in pixels, (front, back, near), whether to clip in image space.
type CameraTuple = ([[f64; 4]; 4], (u32, u32), (f64, f64, f64), bool);

fn camera_of((matrix, (width, height), (front, back, near), image_space): CameraTuple) -> Camera {
    Camera { matrix, width, height, front, back, near, image_space }
}

#[derive(Clone, Copy)]
enum Method {
    ZBuffer(Nearer),
    ScanLineZBuffer(Lists),
    ScanLine(Coherence),
    SpanList,
    Warnock,
    DepthSort,
    Bsp,
    RayCasting(Acceleration),
}

fn method_of(name: &str, variant: &str) -> PyResult<Method> {
    Ok(match (name, variant) {
        ("z-buffer", "" | "smaller") => Method::ZBuffer(Nearer::Smaller),
        ("z-buffer", "larger") => Method::ZBuffer(Nearer::Larger),
        ("scan-line z-buffer", "" | "merged") => Method::ScanLineZBuffer(Lists::Merged),
        ("scan-line z-buffer", "per polygon") => Method::ScanLineZBuffer(Lists::PerPolygon),
        ("scan line", "" | "both ends") => Method::ScanLine(Coherence::BothEnds),
        ("scan line", "naive") => Method::ScanLine(Coherence::Naive),
        ("scan line", "leaving") => Method::ScanLine(Coherence::Leaving),
        ("scan line", "visible") => Method::ScanLine(Coherence::Visible),
        ("span list", "") => Method::SpanList,
        ("warnock", "") => Method::Warnock,
        ("depth sort", "") => Method::DepthSort,
        ("bsp", "") => Method::Bsp,
        ("ray casting", "" | "hierarchy") => Method::RayCasting(Acceleration::Hierarchy),
        ("ray casting", "flat") => Method::RayCasting(Acceleration::Flat),
        ("ray casting", "grid") => Method::RayCasting(Acceleration::Grid),
        ("ray casting", "partition") => Method::RayCasting(Acceleration::Partition),
        _ => return Err(PyValueError::new_err(format!("no method '{name}' with the variant '{variant}'"))),
    })
}

/// Active edges and spans.
type Row<'py> = (Bound<'py, PyList>, Bound<'py, PyList>);
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
    /// The polygon as given, of each planar one; empty where they are the same.
    owner: Vec<u32>,
    tree: Mutex<Option<Tree>>,
}

struct Picture {
    finished: bool,
    ids: Vec<i32>,
    depth: Vec<f64>,
    values: Vec<[f64; 3]>,
    trace: Vec<Write>,
    statistics: Statistics,
    prepared: f64,
    seconds: f64,
}

fn deadline(seconds: f64) -> Option<Instant> {
    Duration::try_from_secs_f64(seconds).ok().and_then(|d| Instant::now().checked_add(d))
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
        }
    }

    fn id(&self, polygon: u32) -> i32 {
        if self.owner.is_empty() { polygon as i32 } else { self.owner[polygon as usize] as i32 }
    }

    fn picture(&self, camera: &Camera, method: Method, shaded: &str, traced: bool, watch: &Watch) -> Picture {
        let mut statistics = Statistics::default();
        let started = Stopwatch::start();
        let on = screen(&self.scene(), camera, Bent::Triangulated, watch, &mut statistics);
        let prepared = started.seconds();
        let started = Stopwatch::start();
        let mut canvas = Canvas::new(camera.width.into(), camera.height.into(), traced);
        let done = on.as_ref().and_then(|on| self.fill(on, camera, method, &mut canvas, watch, &mut statistics));
        let seconds = started.seconds();
        let mut out = Picture {
            finished: done.is_some(),
            ids: Vec::new(),
            depth: Vec::new(),
            values: Vec::new(),
            trace: canvas.trace.take().unwrap_or_default(),
            statistics,
            prepared,
            seconds,
        };
        let (Some(on), Some(())) = (on, done) else { return out };
        let id = |f: u32| self.id(on.facets[f as usize].id);
        out.ids = canvas.pixels.iter().map(|&f| if f == NONE { -1 } else { id(f) }).collect();
        let at = |(k, &f): (usize, &u32)| match f {
            NONE => f64::INFINITY,
            _ => on.true_depth(f, (k % canvas.width) as i64, (k / canvas.width) as i64),
        };
        out.depth = canvas.pixels.iter().enumerate().map(at).collect();
        out.trace.iter_mut().for_each(|w| w.facet = id(w.facet) as u32);
        if !shaded.is_empty() {
            match shading::shade(&on, &canvas.pixels, shaded == "correct", watch) {
                Some(values) => out.values = values,
                None => out.finished = false,
            }
        }
        out
    }

    fn fill(
        &self,
        on: &Screen,
        camera: &Camera,
        method: Method,
        canvas: &mut Canvas,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        match method {
            Method::ZBuffer(nearer) => z_buffer::render(on, canvas, nearer, watch, statistics),
            Method::ScanLineZBuffer(lists) => scan_line_z_buffer::render(on, canvas, lists, watch, statistics),
            Method::ScanLine(coherence) => scan_line::render(on, canvas, coherence, watch, statistics),
            Method::SpanList => span_list::render(on, canvas, watch, statistics),
            Method::Warnock => warnock::render(on, canvas, watch, statistics),
            Method::DepthSort => depth_sort::render(on, canvas, watch, statistics),
            Method::RayCasting(how) => ray_casting::render(on, canvas, how, watch, statistics),
            Method::Bsp => self.with_tree(watch, statistics, |tree, statistics| {
                bsp::render(tree, on, camera, canvas, watch, statistics)
            }),
        }
    }

    /// The tree that is there, or a new one; its making is the setup.
    fn with_tree<T>(
        &self,
        watch: &Watch,
        statistics: &mut Statistics,
        work: impl FnOnce(&Tree, &mut Statistics) -> Option<T>,
    ) -> Option<T> {
        let mut slot = self.tree.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if slot.is_none() {
            let started = Stopwatch::start();
            *slot = Some(Tree::new(&self.scene(), watch, statistics)?);
            statistics.setup = started.seconds();
        }
        slot.as_ref().and_then(|tree| work(tree, statistics))
    }
}

#[pymethods]
impl RasterScene {
    #[new]
    #[pyo3(signature = (points, corners, loops, polygons, cull, values, non_zero))]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        corners: PyReadonlyArray1<'_, i32>,
        loops: PyReadonlyArray1<'_, i32>,
        polygons: PyReadonlyArray1<'_, i32>,
        cull: PyReadonlyArray1<'_, bool>,
        values: PyReadonlyArray2<'_, f64>,
        non_zero: bool,
    ) -> PyResult<RasterScene> {
        let points = rows::<f64, 3>(&points, "points")?;
        let (corners, loops) = (flat(&corners, "corners")?, flat(&loops, "loops")?);
        let (polygons, cull) = (flat(&polygons, "polygons")?, flat(&cull, "cull")?);
        let values = rows::<f64, 3>(&values, "values")?;
        expect_below("corners", corners.iter().copied(), points.len())?;
        for (name, offsets, end) in [("loops", loops, corners.len()), ("polygons", polygons, loops.len().max(1) - 1)] {
            let rising = offsets.windows(2).all(|w| w[0] < w[1]);
            if !rising || offsets.first() != Some(&0) || offsets.last().map(|&l| l as usize) != Some(end) {
                return Err(PyValueError::new_err(format!("{name} must rise from 0 to {end}")));
            }
        }
        expect_len("cull", cull.len(), polygons.len() - 1)?;
        if !values.is_empty() {
            expect_len("values", values.len(), points.len())?;
        }
        if !points.iter().flatten().all(|c| c.is_finite()) {
            return Err(PyValueError::new_err("points hold coordinates that are not finite"));
        }
        let mut scene = RasterScene {
            points: points.to_vec(),
            corners: corners.to_vec(),
            loops: loops.to_vec(),
            polygons: polygons.to_vec(),
            cull: cull.to_vec(),
            values: values.to_vec(),
            rule: if non_zero { Rule::NonZero } else { Rule::EvenOdd },
            owner: Vec::new(),
            tree: Mutex::new(None),
        };
        if let Some(p) = planar(&scene.scene()) {
            (scene.corners, scene.loops, scene.polygons) = (p.corners, p.loops, p.polygons);
            (scene.cull, scene.owner) = (p.cull, p.owner);
        }
        Ok(scene)
    }

    /// method: its name and its variant, "" for the default.
    #[pyo3(signature = (camera, method, seconds, shaded, traced))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        camera: CameraTuple,
        method: (String, String),
        seconds: f64,
        shaded: &str,
        traced: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (camera, method) = (camera_of(camera), method_of(&method.0, &method.1)?);
        let (height, width) = (camera.height as usize, camera.width as usize);
        let found = run(py, 1, |stopped| {
            let watch = Watch::new(stopped, deadline(seconds));
            self.picture(&camera, method, shaded, traced, &watch)
        })?;
        let out = PyDict::new(py);
        out.set_item("finished", found.finished)?;
        if !found.ids.is_empty() {
            out.set_item("ids", found.ids.into_pyarray(py).reshape([height, width])?)?;
            out.set_item("depth", found.depth.into_pyarray(py).reshape([height, width])?)?;
        }
        if !found.values.is_empty() {
            out.set_item("values", found.values.into_flattened().into_pyarray(py).reshape([height, width, 3])?)?;
        }
        let count = found.trace.len();
        let trace: Vec<i32> =
            found.trace.iter().flat_map(|w| [w.row as i32, w.from as i32, w.to as i32, w.facet as i32]).collect();
        out.set_item("trace", trace.into_pyarray(py).reshape([count, 4])?)?;
        out.set_item("statistics", counted(py, &found.statistics, found.prepared, found.seconds)?)?;
        Ok(out)
    }

    /// The painter's list of depth sort or of the BSP tree: ids, where each one's loops and points begin, points in pixels.
    /// None where it takes longer than so many seconds, or depth sort more than `most` comparisons.
    #[pyo3(signature = (camera, method, seconds, most))]
    fn painters_list<'py>(
        &self,
        py: Python<'py>,
        camera: CameraTuple,
        method: &str,
        seconds: f64,
        most: u64,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let camera = camera_of(camera);
        let by_tree = matches!(method_of(method, "")?, Method::Bsp);
        let found = run(py, 1, |stopped| {
            let watch = Watch::new(stopped, deadline(seconds));
            let mut statistics = Statistics::default();
            let listed = if by_tree {
                self.with_tree(&watch, &mut statistics, |tree, _| tree_list(tree, &camera, &watch))
            } else {
                screen(&self.scene(), &camera, Bent::Whole, &watch, &mut statistics)
                    .and_then(|on| sorted_list(&on, most, &watch, &mut statistics))
            };
            listed.map(|l| (l, statistics))
        })?;
        let Some((list, statistics)) = found else { return Ok(None) };
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
        Ok(Some(out))
    }

    /// One row as the scan line sees it: active edges (polygon, edge, x) and spans (from, to, polygons that are in).
    fn scan_row<'py>(&self, py: Python<'py>, camera: CameraTuple, row: i64) -> PyResult<Row<'py>> {
        let camera = camera_of(camera);
        let never = || false;
        let watch = Watch::new(&never, None);
        let mut statistics = Statistics::default();
        let (edges, spans) = (PyList::empty(py), PyList::empty(py));
        let Some(on) = screen(&self.scene(), &camera, Bent::Triangulated, &watch, &mut statistics) else {
            return Ok((edges, spans));
        };
        let table = EdgeTable::new(&on);
        let mut active = ActiveEdges::new(&table);
        let id = |f: u32| self.id(on.facets[f as usize].id);
        while let Some(here) = active.next_row(&mut statistics) {
            if here < row {
                continue;
            }
            if here > row {
                break;
            }
            let mut polygons = PolygonTable::new(on.rule, on.facets.len());
            for (k, e) in active.edges.iter().enumerate() {
                edges.append((id(e.facet), e.number, e.crossing()))?;
                polygons.cross(e.facet, e.winding);
                if let Some(next) = active.edges.get(k + 1).filter(|n| n.column > e.column) {
                    let mut inside: Vec<i32> = polygons.inside.iter().map(|&f| id(f)).collect();
                    inside.sort_unstable();
                    spans.append((e.column, next.column, inside))?;
                }
            }
            break;
        }
        Ok((edges, spans))
    }

    /// Pairs of crossings (row, from, to, polygon) in the order in which the merged list completes them.
    fn pairs<'py>(&self, py: Python<'py>, camera: CameraTuple) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let camera = camera_of(camera);
        let found = run(py, 1, |stopped| {
            let watch = Watch::new(stopped, None);
            let mut statistics = Statistics::default();
            let mut canvas = Canvas::new(camera.width.into(), camera.height.into(), false);
            let mut out = Vec::new();
            if let Some(on) = screen(&self.scene(), &camera, Bent::Triangulated, &watch, &mut statistics) {
                let mut paired = |w: Write| {
                    let id = self.id(on.facets[w.facet as usize].id);
                    out.extend([w.row as i32, w.from as i32, w.to as i32, id]);
                };
                let _ = scan_line_z_buffer::merged(&on, &mut canvas, &watch, &mut statistics, &mut paired);
            }
            out
        })?;
        Ok(found.into_pyarray(py))
    }

    /// The BSP tree's nodes, the root first: (polygons in the plane, node behind, node in front).
    fn tree(&self, py: Python<'_>) -> PyResult<Vec<TreeNode>> {
        let drawn = run(py, 1, |stopped| {
            let watch = Watch::new(stopped, None);
            self.with_tree(&watch, &mut Statistics::default(), |tree, _| Some(tree.drawn()))
        })?;
        let ids = |polygons: Vec<u32>| polygons.into_iter().map(|p| self.id(p)).collect();
        Ok(drawn.unwrap_or_default().into_iter().map(|(p, behind, front)| (ids(p), behind, front)).collect())
    }

    /// The scene with some of its points moved. The tree goes with it: the polygons at those points are let in again.
    fn moved(&self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<RasterScene> {
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
            owner: self.owner.clone(),
            tree: Mutex::new(None),
        };
        if let Some(mut tree) = tree {
            let scene = out.scene();
            let elsewhere = |&i: &i32| points[i as usize] != self.points[i as usize];
            let moved: Vec<u32> =
                (0..scene.len() as u32).filter(|&p| scene.loops_of(p as usize).flatten().any(elsewhere)).collect();
            tree.remove(&moved);
            let done = run(py, 1, |stopped| {
                tree.insert(&scene, &moved, &Watch::new(stopped, None), &mut Statistics::default()).map(|()| tree)
            })?;
            out.tree = Mutex::new(done);
        }
        Ok(out)
    }
}
