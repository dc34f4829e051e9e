//! Runs a visible-surface method by name, with a camera, within limits of time and memory.

use std::sync::Mutex;

use pyo3::exceptions::{PyMemoryError, PyTimeoutError, PyValueError};
use pyo3::prelude::*;

use super::threads::run_on_one;
use hlr_methods::bsp::{self, Tree};
use hlr_methods::canvas::Canvas;
use hlr_methods::limits::{Limits, Watch, Why};
use hlr_methods::ray_casting::Acceleration;
use hlr_methods::scan_line::Coherence;
use hlr_methods::scan_line_z_buffer::Lists;
use hlr_methods::scene::{Camera, Scene};
use hlr_methods::screen::Screen;
use hlr_methods::statistics::Statistics;
use hlr_methods::stopwatch::Stopwatch;
use hlr_methods::z_buffer::Nearer;
use hlr_methods::{depth_sort, ray_casting, scan_line, scan_line_z_buffer, span_list, warnock, z_buffer};

/// Matrix, size in pixels, (front, back, near), whether to clip in image space.
pub type CameraTuple = ([[f64; 4]; 4], (u32, u32), (f64, f64, f64), bool);

pub fn camera_of((matrix, (width, height), (front, back, near), image_space): CameraTuple) -> Camera {
    Camera { matrix, width, height, front, back, near, image_space }
}

#[derive(Clone, Copy)]
pub enum Method {
    ZBuffer(Nearer),
    ScanLineZBuffer(Lists),
    ScanLine(Coherence),
    SpanList,
    Warnock,
    DepthSort,
    Bsp,
    RayCasting(Acceleration),
}

pub fn method_of(name: &str, variant: &str) -> PyResult<Method> {
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

/// Seconds, whether these are processor time of the thread, and bytes.
pub type LimitsTuple = (f64, bool, f64);

/// Runs work on one thread within limits: TimeoutError or MemoryError where they were exceeded.
pub fn within<T: Send>(
    py: Python<'_>,
    (seconds, worked, bytes): LimitsTuple,
    work: impl FnOnce(&Watch) -> Option<T> + Send,
) -> PyResult<Option<T>> {
    let (done, why) = run_on_one(py, |stopped| {
        let watch = Watch::new(stopped, Limits { seconds, worked, bytes });
        (work(&watch), watch.why())
    })?;
    match (done, why) {
        (Some(done), _) => Ok(Some(done)),
        (None, Some(Why::Time)) => Err(PyTimeoutError::new_err("out of time")),
        (None, Some(Why::Memory)) => Err(PyMemoryError::new_err("out of memory")),
        (None, _) => Ok(None),
    }
}

impl Method {
    /// Bytes for each pixel, beside the frame.
    pub fn bytes_per_pixel(self) -> usize {
        if matches!(self, Method::ZBuffer(_)) { size_of::<f64>() } else { 0 }
    }

    /// Fills the frame; `tree` caches the scene's BSP tree.
    #[allow(clippy::too_many_arguments)] // everything that some method needs
    pub fn fill(
        self,
        scene: &Scene,
        tree: &Mutex<Option<Tree>>,
        on: &Screen,
        camera: &Camera,
        canvas: &mut Canvas,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        match self {
            Method::ZBuffer(nearer) => z_buffer::render(on, canvas, nearer, watch, statistics),
            Method::ScanLineZBuffer(lists) => scan_line_z_buffer::render(on, canvas, lists, watch, statistics),
            Method::ScanLine(coherence) => scan_line::render(on, canvas, coherence, watch, statistics),
            Method::SpanList => span_list::render(on, canvas, watch, statistics),
            Method::Warnock => warnock::render(on, canvas, watch, statistics),
            Method::DepthSort => depth_sort::render(on, canvas, watch, statistics),
            Method::RayCasting(how) => ray_casting::render(on, canvas, how, watch, statistics),
            Method::Bsp => with_tree(scene, tree, watch, statistics, |tree, statistics| {
                bsp::render(tree, on, camera, canvas, watch, statistics)
            }),
        }
    }
}

/// The tree that was kept, or a new one, which counts as setup.
pub fn with_tree<T>(
    scene: &Scene,
    tree: &Mutex<Option<Tree>>,
    watch: &Watch,
    statistics: &mut Statistics,
    work: impl FnOnce(&Tree, &mut Statistics) -> Option<T>,
) -> Option<T> {
    let mut slot = tree.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if slot.is_none() {
        let started = Stopwatch::start();
        *slot = Some(Tree::new(scene, watch, statistics)?);
        statistics.setup = started.seconds();
    }
    slot.as_ref().and_then(|tree| work(tree, statistics))
}
