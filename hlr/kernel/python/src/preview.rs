//! Binding of `hlr_preview`: the shaded picture.

use std::sync::Mutex;

use numpy::{IntoPyArray, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use numpy::{PyReadwriteArray3, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};
use super::guard::caught;
use super::mesh_input::Mesh;
use super::threads::run;
use super::true_surfaces::TrueSurfaces;
use hlr_preview::depth_map::depth_map;
use hlr_preview::grid::MOST_PIXELS;
use hlr_preview::lens::Lens;
use hlr_preview::normals::{OnSurfaces, normals};
use hlr_preview::occlusion::Occlusion;
use hlr_preview::picture::picture;
use hlr_preview::sampling::Sampling;
use hlr_preview::shade::{Light, Scene};
use hlr_preview::shadow::Shadow;
use hlr_preview::stroke::{Piece, stroke};
use hlr_preview::workspace::Workspace;
use hlr_preview::{Model, NOTHING};

/// A view of the model as a picture in pixels. The fields are those of `hlr_preview::lens::Lens`; distance is 0 for
/// parallel views.
#[pyclass(frozen, name = "Lens")]
pub struct PictureLens(pub Lens);

#[pymethods]
impl PictureLens {
    #[new]
    #[pyo3(signature = (*, right, up, ahead, origin, scale, centre, distance, range, size))]
    #[allow(clippy::too_many_arguments)] // one argument per field: the stub names them
    fn new(
        right: [f64; 3],
        up: [f64; 3],
        ahead: [f64; 3],
        origin: [f64; 3],
        scale: f64,
        centre: [f64; 2],
        distance: f64,
        range: [f64; 2],
        size: [usize; 2],
    ) -> PyResult<PictureLens> {
        if size.iter().any(|&s| s == 0 || s > MOST_PIXELS) {
            return Err(PyValueError::new_err(format!("a picture has 1 to {MOST_PIXELS} pixels a side")));
        }
        let sound = scale > 0.0 && scale.is_finite() && range[0] < range[1] && range[1].is_finite() && distance >= 0.0;
        if !sound || (distance > 0.0 && range[0] <= 0.0) {
            return Err(PyValueError::new_err("scale and range must be positive, and finite"));
        }
        let distance = (distance > 0.0).then_some(distance);
        Ok(PictureLens(Lens { right, up, ahead, origin, scale, centre, distance, range, size }))
    }

    #[getter]
    fn ahead(&self) -> (f64, f64, f64) {
        self.0.ahead.into()
    }

    #[getter]
    fn origin(&self) -> (f64, f64, f64) {
        self.0.origin.into()
    }

    #[getter]
    fn scale(&self) -> f64 {
        self.0.scale
    }

    #[getter]
    fn centre(&self) -> (f64, f64) {
        self.0.centre.into()
    }

    #[getter]
    fn distance(&self) -> f64 {
        self.0.distance.unwrap_or(0.0)
    }

    #[getter]
    fn range(&self) -> (f64, f64) {
        self.0.range.into()
    }
}

/// The light on a picture, and how much of it a surface reflects.
#[pyclass(frozen, name = "Light")]
pub struct PictureLight(pub Light);

#[pymethods]
impl PictureLight {
    #[new]
    #[pyo3(signature = (*, toward, ambient, diffuse, specular = 0.0))]
    fn new(toward: [f64; 3], ambient: f32, diffuse: f32, specular: f32) -> PictureLight {
        PictureLight(Light { toward, ambient, diffuse, specular })
    }
}

pub fn stopped_error() -> PyErr {
    PyKeyboardInterrupt::new_err("stopped")
}

/// A checked model, for any number of pictures.
#[pyclass(frozen)]
pub struct ShadedModel {
    points: Vec<[f64; 3]>,
    triangles: Vec<[i32; 3]>,
    corner: Vec<[i32; 3]>,
    normals: Vec<[f32; 3]>,
    paint: Vec<[i32; 3]>,
    colours: Vec<[f32; 4]>,
    cull: Vec<bool>,
    transparent: Vec<bool>,
    space: Mutex<Workspace>,
}

impl ShadedModel {
    /// Works in the memory of the last picture, or in fresh memory while another thread is using that.
    pub fn with_space<T>(&self, work: impl FnOnce(&mut Workspace) -> T) -> T {
        match self.space.try_lock() {
            Ok(mut space) => work(&mut space),
            Err(_) => work(&mut Workspace::default()),
        }
    }

    pub fn model(&self) -> Model<'_> {
        Model {
            points: &self.points,
            triangles: &self.triangles,
            corner: &self.corner,
            normals: &self.normals,
            paint: &self.paint,
            colours: &self.colours,
            cull: &self.cull,
            transparent: &self.transparent,
        }
    }
}

#[pymethods]
impl ShadedModel {
    #[new]
    #[allow(clippy::too_many_arguments)] // one per array: the stub names them
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        triangles: PyReadonlyArray2<'_, i32>,
        corner: PyReadonlyArray2<'_, i32>,
        normals: PyReadonlyArray2<'_, f32>,
        paint: PyReadonlyArray2<'_, i32>,
        colours: PyReadonlyArray2<'_, f32>,
        cull: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<ShadedModel> {
        caught(py, || {
            let points = rows::<f64, 3>(&points, "points")?;
            let triangles = rows::<i32, 3>(&triangles, "triangles")?;
            let corner = rows::<i32, 3>(&corner, "corner")?;
            let normals = rows::<f32, 3>(&normals, "normals")?;
            let paint = rows::<i32, 3>(&paint, "paint")?;
            let colours = rows::<f32, 4>(&colours, "colours")?;
            let cull = flat(&cull, "cull")?;
            for (name, found) in [("corner", corner.len()), ("paint", paint.len()), ("cull", cull.len())] {
                expect_len(name, found, triangles.len())?;
            }
            expect_below("triangles", triangles.as_flattened().iter().copied(), points.len())?;
            expect_below("paint", paint.as_flattened().iter().copied(), colours.len())?;
            let smooth = corner.iter().filter(|c| c[0] >= 0);
            expect_below("corner", smooth.flatten().copied(), normals.len())?;
            Ok(ShadedModel {
                points: points.to_vec(),
                triangles: triangles.to_vec(),
                corner: corner.to_vec(),
                normals: normals.to_vec(),
                paint: paint.to_vec(),
                colours: colours.to_vec(),
                cull: cull.to_vec(),
                transparent: paint.iter().map(|p| p.iter().any(|&i| colours[i as usize][3] < 1.0)).collect(),
                space: Mutex::default(),
            })
        })
    }

    /// The picture (h, w, 4), uint8; `out`: a picture of that shape to draw into instead of a new one.
    #[pyo3(signature = (lens, light, background, antialias, shadow = None, occlusion = 0.0, out = None))]
    #[allow(clippy::too_many_arguments)] // one argument per effect: the stub names them
    fn picture<'py>(
        &self,
        py: Python<'py>,
        lens: &PictureLens,
        light: &PictureLight,
        background: [f32; 4],
        antialias: bool,
        shadow: Option<&PictureLens>,
        occlusion: f64,
        out: Option<Bound<'py, PyArray3<u8>>>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (lens, light, shadow) = (&lens.0, light.0, shadow.map(|lens| lens.0.clone()));
        let [width, height] = lens.size;
        let sampling = if antialias { Sampling::SIXTEEN } else { Sampling::CENTRES };
        let out = out.unwrap_or_else(|| PyArray3::zeros(py, [height, width, 4], false));
        let mut writable = out.try_readwrite().map_err(|_| PyValueError::new_err("out cannot be written"))?;
        let pixels = writable.as_slice_mut().map_err(|_| PyValueError::new_err("out must be C-contiguous"))?;
        if pixels.len() != width * height * 4 || out.shape()[1] != width {
            return Err(PyValueError::new_err("out must be (height, width, 4)"));
        }
        let (pixels, _) = pixels.as_chunks_mut::<4>();
        let done = run(py, usize::MAX, |stopped| {
            self.with_space(|space| {
                let model = self.model();
                let shadow = match shadow {
                    Some(lens) => Some(Shadow::new(&model, lens, space, stopped)?),
                    None => None,
                };
                let occlusion = if occlusion > 0.0 {
                    let map = depth_map(&model, lens, space, stopped)?;
                    Some(Occlusion::new(&model, lens, &map, occlusion, stopped)?)
                } else {
                    None
                };
                let scene = Scene { model: &model, lens, light, shadow, occlusion };
                picture(&scene, &sampling, background, space, pixels, stopped).then_some(())
            })
        })?;
        drop(writable);
        done.ok_or_else(stopped_error)?;
        Ok(out)
    }

    /// The depth map at the centres of pixels: distance ahead (h, w) float64 in model units, infinite where there is
    /// nothing; triangle (h, w) int32, -1 for none. Transparent triangles count as opaque.
    #[allow(clippy::type_complexity)]
    fn maps<'py>(
        &self,
        py: Python<'py>,
        lens: &PictureLens,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>)> {
        let lens = &lens.0;
        let [width, height] = lens.size;
        let found =
            run(py, usize::MAX, |stopped| self.with_space(|space| depth_map(&self.model(), lens, space, stopped)))?
                .ok_or_else(stopped_error)?;
        let ahead = |s: &hlr_preview::depth_map::MapSample| {
            if s.triangle == NOTHING { f64::INFINITY } else { lens.ahead_at(f64::from(s.depth)) }
        };
        let depth: Vec<f64> = found.iter().map(ahead).collect();
        let triangle: Vec<i32> = found.iter().map(|s| s.triangle as i32).collect();
        Ok((depth.into_pyarray(py).reshape([height, width])?, triangle.into_pyarray(py).reshape([height, width])?))
    }
}

/// Draws straight pieces (n, 4), x0 y0 x1 y1 in pixels, over an (h, w, 4) picture, in place.
#[pyfunction]
pub fn stroke_picture(
    py: Python<'_>,
    mut picture: PyReadwriteArray3<'_, u8>,
    pieces: PyReadonlyArray2<'_, f64>,
    width: f64,
    colour: [u8; 4],
) -> PyResult<()> {
    let shape = picture.shape().to_vec();
    let pixels = picture.as_slice_mut().map_err(|_| PyValueError::new_err("picture must be C-contiguous"))?;
    if shape[2] != 4 || shape[1] == 0 {
        return Err(PyValueError::new_err("picture must be (h, w, 4)"));
    }
    let (pixels, _) = pixels.as_chunks_mut::<4>();
    let pieces: Vec<Piece> = rows::<f64, 4>(&pieces, "pieces")?
        .iter()
        .filter(|p| p.iter().all(|c| c.is_finite()))
        .map(|p| Piece { from: [p[0], p[1]], to: [p[2], p[3]], half: 0.5 * width })
        .collect();
    let done = run(py, usize::MAX, |stopped| stroke(pixels, shape[1], &pieces, colour, stopped))?;
    if done { Ok(()) } else { Err(stopped_error()) }
}

/// Unit normals (k, 3) float32 of the true surfaces at uv (k, 2), on the outer side; zero where there is none.
#[pyfunction]
pub fn surface_normals<'py>(py: Python<'py>, mesh: &Mesh, on: &TrueSurfaces) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (reading, places) = (mesh.reading(py)?, on.reading(py)?);
    let all = reading.slices()?;
    let (face, corner, uv) = places.slices()?;
    expect_len("triangle_face", face.len(), all.triangles.len())?;
    let on = OnSurfaces {
        points: all.points,
        triangles: all.triangles,
        face,
        corner,
        uv,
        surface: &on.number,
        place: &on.place,
        surfaces: on.surfaces(),
    };
    let found = run(py, usize::MAX, |_| normals(&on))?;
    let n = found.len();
    found.into_flattened().into_pyarray(py).reshape([n, 3])
}
