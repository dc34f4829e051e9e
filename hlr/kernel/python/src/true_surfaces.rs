//! The surfaces of faces, and the parameters (u, v) of their triangles' corners.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use super::arrays::{expect_below, expect_len, flat, rows};
use super::geometry::expect_records;
use super::guard::caught;
use super::threads::run;
use hlr_brep::geometry::surface::Surface;

/// Surfaces from packed records; None where a record makes none.
#[pyclass(frozen)]
pub struct Surfaces(Vec<Option<Surface>>);

#[pymethods]
impl Surfaces {
    #[new]
    fn new(
        py: Python<'_>,
        kind: PyReadonlyArray1<'_, u8>,
        offsets: PyReadonlyArray1<'_, i32>,
        data: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Surfaces> {
        caught(py, || {
            let (kind, offsets, data) = (flat(&kind, "kind")?, flat(&offsets, "offsets")?, flat(&data, "data")?);
            expect_records(kind, offsets, data)?;
            let read = |i: usize| Surface::read(kind[i], &data[offsets[i] as usize..offsets[i + 1] as usize]);
            Ok(Surfaces((0..kind.len()).map(read).collect()))
        })
    }

    /// Point, du and dv (n, 3, 3) of the surfaces `which` at (u, v); NaN where a record makes no surface.
    fn points<'py>(
        &self,
        py: Python<'py>,
        which: PyReadonlyArray1<'py, i32>,
        uv: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (which, uv) = (flat(&which, "which")?, rows::<f64, 2>(&uv, "uv")?);
        expect_len("uv", uv.len(), which.len())?;
        expect_below("which", which.iter().copied(), self.0.len())?;
        let at = |(&i, &place): (&i32, &[f64; 2])| {
            self.0[i as usize].as_ref().map_or([[f64::NAN; 3]; 3], |s| {
                let (point, du, dv) = s.d1(place);
                [point, du, dv]
            })
        };
        let found: Vec<_> = run(py, which.len(), |_| which.par_iter().zip(uv).map(at).collect())?;
        let n = found.len();
        found.into_flattened().into_flattened().into_pyarray(py).reshape([n, 3, 3])
    }
}

/// Triangles on surfaces. The arrays of triangles remain the caller's.
#[pyclass(frozen)]
pub struct TrueSurfaces {
    triangle_face: Py<PyArray1<i32>>,
    corner: Py<PyArray2<i32>>,
    uv: Py<PyArray2<f64>>,
    surfaces: Py<Surfaces>,
    /// Per face: the number of its surface, the placement, whether the normal points inward, whether the face is curved.
    pub number: Vec<i32>,
    pub place: Vec<[f64; 12]>,
    pub inward: Vec<bool>,
    pub curved: Vec<bool>,
}

#[pymethods]
impl TrueSurfaces {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        triangle_face: Py<PyArray1<i32>>,
        corner: Py<PyArray2<i32>>,
        uv: Py<PyArray2<f64>>,
        surfaces: Py<Surfaces>,
        number: PyReadonlyArray1<'_, i32>,
        place: PyReadonlyArray2<'_, f64>,
        inward: PyReadonlyArray1<'_, bool>,
        curved: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<TrueSurfaces> {
        caught(py, || {
            let on = TrueSurfaces {
                triangle_face,
                corner,
                uv,
                surfaces,
                number: flat(&number, "number")?.to_vec(),
                place: rows::<f64, 12>(&place, "place")?.to_vec(),
                inward: flat(&inward, "inward")?.to_vec(),
                curved: flat(&curved, "curved")?.to_vec(),
            };
            let faces = on.number.len();
            for (name, found) in [("place", on.place.len()), ("inward", on.inward.len()), ("curved", on.curved.len())] {
                expect_len(name, found, faces)?;
            }
            let known = on.surfaces.get().0.len();
            expect_below("number", on.number.iter().copied().filter(|&s| s >= 0), known)?;
            let reading = on.reading(py)?;
            let (face, corner, uv) = reading.slices()?;
            expect_len("triangle_face", face.len(), corner.len())?;
            expect_below("triangle_face", face.iter().copied(), faces)?;
            expect_below("corner", corner.iter().filter(|c| c[0] >= 0).flatten().copied(), uv.len())?;
            Ok(on)
        })
    }
}

/// Borrows of the arrays while they are read.
pub struct Reading<'py> {
    triangle_face: PyReadonlyArray1<'py, i32>,
    corner: PyReadonlyArray2<'py, i32>,
    uv: PyReadonlyArray2<'py, f64>,
}

/// Face of each triangle, its corners as indices of places, and the (u, v) of these places.
pub type Slices<'a> = (&'a [i32], &'a [[i32; 3]], &'a [[f64; 2]]);

impl Reading<'_> {
    pub fn slices(&self) -> PyResult<Slices<'_>> {
        Ok((flat(&self.triangle_face, "triangle_face")?, rows(&self.corner, "corner")?, rows(&self.uv, "uv")?))
    }
}

impl TrueSurfaces {
    pub fn reading<'py>(&self, py: Python<'py>) -> PyResult<Reading<'py>> {
        Ok(Reading {
            triangle_face: self.triangle_face.bind(py).try_readonly()?,
            corner: self.corner.bind(py).try_readonly()?,
            uv: self.uv.bind(py).try_readonly()?,
        })
    }

    pub fn surfaces(&self) -> &[Option<Surface>] {
        &self.surfaces.get().0
    }

    /// The number of a face's surface, where that is known.
    pub fn surface(&self, face: i32) -> Option<u32> {
        let number = u32::try_from(self.number[face as usize]).ok()?;
        self.surfaces()[number as usize].is_some().then_some(number)
    }
}
