//! Binding of `hlr_linework::lines::camera`: one encoding of the camera for all stages.

use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use super::arrays::{rows, table};
use super::threads::run;
use hlr_linework::lines::camera::Camera as PaperCamera;

type Vec3 = [f64; 3];

#[pyclass(frozen)]
pub struct Camera(pub(super) PaperCamera);

#[pymethods]
impl Camera {
    #[new]
    fn new(direction: Vec3, right: Vec3, up: Vec3, eye: Option<(Vec3, f64)>, scale: f64) -> Camera {
        Camera(PaperCamera { direction, right, up, eye, scale })
    }

    /// Image coordinates (n, 3) of points: to the right, up, and away from the viewer, in model units.
    fn image<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = rows(&points, "points")?;
        let image = run(py, points.len() / 8, |_| points.par_iter().map(|p| self.0.image(p)).collect())?;
        table(py, image)
    }

    /// (2, 2) from where to where points (n, 3) reach in the image, to the right and up, in model units; the lower end is
    /// beyond the upper one where there are none.
    fn reach<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = rows(&points, "points")?;
        table(py, run(py, points.len() / 8, |_| self.0.reach(points))?.to_vec())
    }
}
