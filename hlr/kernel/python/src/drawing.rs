//! Binding of the lines of a drawing and of their pen strokes.

use std::sync::{Arc as Shared, OnceLock};

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;

use super::arrays::{expect_len, flat, rows};
use super::guard::caught;
use super::threads::{release_later, run};
use hlr_linework::curves::arcs::{Arc, Rows};
use hlr_linework::curves::dashes::{Ends, Fitted, Pattern, dashes};
use hlr_linework::curves::layer::{Layer as Inked, layers};
use hlr_linework::curves::rows::add_rows;
use hlr_linework::curves::{pdf, svg};
use hlr_linework::fit::bezier::Chain;
use hlr_linework::lines::drawing::{Curve, Kind, Line, Lines as Drawn};

const ARC: u8 = 2;
const QUADRATIC: u8 = 3;
const CUBIC: u8 = 4;

/// Lines, and the box around them once it was asked for.
#[pyclass(frozen)]
pub struct Lines(pub Shared<Drawn>, OnceLock<Option<[f64; 4]>>);

impl Lines {
    pub fn of(lines: Drawn) -> Lines {
        Lines(Shared::new(lines), OnceLock::new())
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        release_later(self.0.clone(), self.0.0.len());
    }
}

#[pymethods]
impl Lines {
    #[new]
    #[allow(clippy::too_many_arguments)] // one argument per column: the stub names them
    fn new(
        py: Python<'_>,
        kind: PyReadonlyArray1<'_, u8>,
        visible: PyReadonlyArray1<'_, bool>,
        ties: PyReadonlyArray2<'_, i32>,
        offsets: PyReadonlyArray1<'_, i32>,
        points: PyReadonlyArray2<'_, f64>,
        points3: PyReadonlyArray2<'_, f64>,
        form: PyReadonlyArray1<'_, u8>,
        data_offsets: PyReadonlyArray1<'_, i32>,
        data: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Lines> {
        caught(py, || {
            let (kind, visible) = (flat(&kind, "kind")?, flat(&visible, "visible")?);
            let ties = rows::<i32, 4>(&ties, "ties")?;
            let (form, data) = (flat(&form, "form")?, flat(&data, "data")?);
            let (points, points3) = (rows::<f64, 2>(&points, "points")?, rows::<f64, 3>(&points3, "points3")?);
            for (name, found) in [("visible", visible.len()), ("ties", ties.len()), ("form", form.len())] {
                expect_len(name, found, kind.len())?;
            }
            expect_len("points3", points3.len(), points.len())?;
            let of_points = spans("offsets", flat(&offsets, "offsets")?, kind.len(), points.len())?;
            let of_data = spans("data_offsets", flat(&data_offsets, "data_offsets")?, kind.len(), data.len())?;
            let line = |i: usize| {
                let wrong = |what: &str| PyValueError::new_err(format!("line {i} {what}"));
                let [part, edge, face, other] = ties[i];
                Ok(Line {
                    kind: Kind(kind[i]),
                    visible: visible[i],
                    part,
                    edge,
                    face,
                    other,
                    flat: points[of_points[i].clone()].to_vec(),
                    space: points3[of_points[i].clone()].to_vec(),
                    curve: curve(form[i], &data[of_data[i].clone()]).map_err(wrong)?,
                })
            };
            Ok(Lines::of(Drawn((0..kind.len()).map(line).collect::<PyResult<_>>()?)))
        })
    }

    fn __len__(&self) -> usize {
        self.0.0.len()
    }

    /// x0, y0, x1, y1 around all lines; None where there are none.
    fn bounds(&self) -> Option<[f64; 4]> {
        *self.1.get_or_init(|| self.0.bounds().map(|[[x0, y0], [x1, y1]]| [x0, y0, x1, y1]))
    }

    /// The columns that the constructor takes.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let lines = &self.0.0;
        let total = lines.iter().map(|l| l.flat.len()).sum();
        let (mut points, mut points3) = (Vec::<f64>::with_capacity(2 * total), Vec::<f64>::with_capacity(3 * total));
        let (mut offsets, mut form, mut data_offsets, mut data) =
            (vec![0i32], Vec::new(), vec![0i32], Vec::<f64>::new());
        let mut ties = Vec::with_capacity(4 * lines.len());
        for line in lines {
            points.extend(line.flat.as_flattened());
            points3.extend(line.space.as_flattened());
            offsets.push((points.len() / 2) as i32);
            ties.extend([line.part, line.edge, line.face, line.other]);
            form.push(match &line.curve {
                None => 0,
                Some(Curve::Arc(arc)) => {
                    data.extend(arc.centre);
                    data.extend(arc.axes.as_flattened());
                    data.extend(arc.angles);
                    ARC
                }
                Some(Curve::Chain(chain)) => {
                    data.extend(chain.points.as_flattened());
                    if chain.degree == 2 { QUADRATIC } else { CUBIC }
                }
            });
            data_offsets.push(data.len() as i32);
        }
        let out = PyDict::new(py);
        out.set_item("kind", self.kinds(py))?;
        out.set_item("visible", self.visible(py))?;
        out.set_item("ties", ties.into_pyarray(py).reshape([lines.len(), 4])?)?;
        out.set_item("offsets", offsets.into_pyarray(py))?;
        out.set_item("points", points.into_pyarray(py).reshape([total, 2])?)?;
        out.set_item("points3", points3.into_pyarray(py).reshape([total, 3])?)?;
        out.set_item("form", form.into_pyarray(py))?;
        out.set_item("data_offsets", data_offsets.into_pyarray(py))?;
        out.set_item("data", data.into_pyarray(py))?;
        Ok(out)
    }

    /// (n,) numbers of the lines' classes.
    fn kinds<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        self.0.0.iter().map(|l| l.kind.0).collect::<Vec<_>>().into_pyarray(py)
    }

    /// (n,) whether each is visible.
    fn visible<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.0.0.iter().map(|l| l.visible).collect::<Vec<_>>().into_pyarray(py)
    }

    /// How many lines are visible, and how many there are of each of the first `classes` classes.
    fn counts(&self, classes: usize) -> (usize, Vec<usize>) {
        let (mut visible, mut of_class) = (0, vec![0; classes]);
        for line in &self.0.0 {
            visible += usize::from(line.visible);
            if let Some(count) = of_class.get_mut(usize::from(line.kind.0)) {
                *count += 1;
            }
        }
        (visible, of_class)
    }

    /// How many creases and borders without an edge lie on a curve: those of meshes, on circles.
    fn circles(&self) -> usize {
        let bare = |l: &&Line| l.edge < 0 && matches!(l.kind, Kind::SHARP | Kind::BOUNDARY);
        self.0.0.iter().filter(bare).filter(|l| l.curve.is_some()).count()
    }

    /// Those lines that are `chosen`.
    fn chosen(&self, py: Python<'_>, chosen: PyReadonlyArray1<'_, bool>) -> PyResult<Lines> {
        let chosen = flat(&chosen, "chosen")?;
        let lines = &self.0.0;
        expect_len("chosen", chosen.len(), lines.len())?;
        let kept = || lines.par_iter().zip(chosen).filter(|(_, c)| **c).map(|(line, _)| line.clone());
        Ok(Lines::of(Drawn(run(py, lines.len(), |_| kept().collect())?)))
    }

    /// The layers of pen strokes, in grid steps of 10^-places millimetres; order: the classes from the first drawn on.
    fn layers(
        &self,
        py: Python<'_>,
        order: Vec<u8>,
        places: usize,
        accuracy: f64,
        cubic: bool,
    ) -> PyResult<Vec<Layer>> {
        self.check(places)?;
        let order: Vec<Kind> = order.into_iter().map(Kind).collect();
        let found = run(py, 4 * self.0.0.len(), |_| layers(&self.0, &order, places, accuracy, cubic))?;
        Ok(found.into_iter().map(Layer).collect())
    }

    /// Rows of each line, one after another, and how many each has.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        places: usize,
        accuracy: f64,
        cubic: bool,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyArray1<i64>>)> {
        self.check(places)?;
        let (mut out, mut counts) = (Rows::default(), Vec::new());
        for line in &self.0.0 {
            let before = out.op.len();
            add_rows(line, places, accuracy, cubic, &mut out);
            counts.push((out.op.len() - before) as i64);
        }
        Ok((row_arrays(py, &out)?, counts.into_pyarray(py)))
    }
}

impl Lines {
    fn check(&self, places: usize) -> PyResult<()> {
        if places > 12 {
            return Err(PyValueError::new_err("places must be at most 12"));
        }
        if !self.0.0.iter().all(Line::finite) {
            return Err(PyValueError::new_err("a point is not finite"));
        }
        Ok(())
    }
}

/// Ranges of `count` rows, in an array that ascends from 0 to `limit`.
fn spans(name: &str, offsets: &[i32], count: usize, limit: usize) -> PyResult<Vec<std::ops::Range<usize>>> {
    expect_len(name, offsets.len(), count + 1)?;
    if offsets[0] != 0 || offsets.windows(2).any(|w| w[0] > w[1]) || offsets[count] as usize != limit {
        return Err(PyValueError::new_err(format!("{name} must ascend from 0 to {limit}")));
    }
    Ok(offsets.windows(2).map(|w| w[0] as usize..w[1] as usize).collect())
}

fn curve(form: u8, data: &[f64]) -> Result<Option<Curve>, &'static str> {
    let chain = |degree: usize| {
        let (points, rest) = data.as_chunks::<2>();
        if !rest.is_empty() || points.len() <= degree || points.len() % degree != 1 {
            return Err("has a chain of Bezier curves without all their points");
        }
        Ok(Some(Curve::Chain(Chain { degree, points: points.to_vec() })))
    };
    match (form, data) {
        (ARC, &[x, y, a, b, c, d, from, to]) => {
            Ok(Some(Curve::Arc(Arc { centre: [x, y], axes: [[a, b], [c, d]], angles: [from, to] })))
        }
        (ARC, _) => Err("has an arc that is not eight numbers"),
        (QUADRATIC, _) => chain(2),
        (CUBIC, _) => chain(3),
        (0 | 1, []) => Ok(None),
        _ => Err("has numbers of a curve and no form that needs them"),
    }
}

/// Checks a width or distance, millimetres.
pub fn width(name: &str, value: f64) -> PyResult<()> {
    if value.is_finite() && (1e-3..=1e3).contains(&value) {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("{name} must be a length between a thousandth and a thousand millimetres")))
}

fn row_arrays<'py>(py: Python<'py>, rows: &Rows) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    let shapes: Vec<i64> = rows
        .shapes
        .iter()
        .flat_map(|s| [s.radii[0], s.radii[1], s.rotation, i64::from(s.large), i64::from(s.rising)])
        .collect();
    out.set_item("points", rows.points.as_flattened().to_vec().into_pyarray(py).reshape([rows.op.len(), 2])?)?;
    out.set_item("op", rows.op.clone().into_pyarray(py))?;
    out.set_item("arc", rows.arc.clone().into_pyarray(py))?;
    out.set_item("shapes", shapes.into_pyarray(py).reshape([rows.shapes.len(), 5])?)?;
    Ok(out)
}

#[pyclass(frozen)]
pub struct Layer(Inked);

#[pymethods]
impl Layer {
    #[getter]
    fn kind(&self) -> u8 {
        self.0.kind.0
    }

    #[getter]
    fn visible(&self) -> bool {
        self.0.visible
    }

    /// What leads to each point, and where; see the stub.
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        row_arrays(py, &self.0.rows)
    }

    /// (s + 1,) where each stroke starts in the rows.
    #[getter]
    fn starts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.0.starts.clone().into_pyarray(py)
    }

    #[getter]
    fn closed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.0.closed.clone().into_pyarray(py)
    }

    /// (s, 3) part, edge and second part of each stroke, -1 for none.
    #[getter]
    fn ties<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let ties: Vec<i32> = self.0.ties.iter().flat_map(|t| [t.part, t.edge, t.other]).collect();
        ties.into_pyarray(py).reshape([self.0.ties.len(), 3])
    }

    /// One element per stroke; those of one part after another are one group.
    #[pyo3(signature = (pattern = None, visible = vec![]), text_signature = "($self, pattern=None, visible=())")]
    fn svg<'py>(
        &self,
        py: Python<'py>,
        pattern: Option<(f64, f64)>,
        visible: Vec<PyRef<'py, Layer>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        self.written(py, pattern, &visible, svg::elements)
    }

    /// Painted paths, one per stroke; the layer must be one of cubic rows.
    #[pyo3(signature = (pattern = None, visible = vec![]), text_signature = "($self, pattern=None, visible=())")]
    fn pdf<'py>(
        &self,
        py: Python<'py>,
        pattern: Option<(f64, f64)>,
        visible: Vec<PyRef<'py, Layer>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        self.written(py, pattern, &visible, pdf::painted)
    }

    fn moved(&self, x: i64, y: i64) -> Layer {
        Layer(self.0.moved([x, y]))
    }

    fn mirrored(&self) -> Layer {
        Layer(self.0.mirrored())
    }
}

impl Layer {
    fn written<'py>(
        &self,
        py: Python<'py>,
        pattern: Option<(f64, f64)>,
        visible: &[PyRef<'py, Layer>],
        format: fn(&Inked, &[Fitted]) -> Vec<u8>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let dashes = self.dashes(py, pattern, visible)?;
        Ok(PyBytes::new(py, &run(py, self.0.rows.op.len(), |_| format(&self.0, &dashes))?))
    }

    /// Dashes of each stroke; none where there is no pattern.
    fn dashes(
        &self,
        py: Python<'_>,
        pattern: Option<(f64, f64)>,
        visible: &[PyRef<'_, Layer>],
    ) -> PyResult<Vec<Fitted>> {
        let Some((dash, gap)) = pattern else { return Ok(Vec::new()) };
        if !(dash > 0.0 && gap > 0.0 && dash.is_finite() && gap.is_finite()) {
            return Err(PyValueError::new_err("dash and gap must be positive lengths"));
        }
        let seen: Vec<&Inked> = visible.iter().map(|layer| &layer.0).collect();
        run(py, 4 * self.0.rows.op.len(), |_| {
            let mut ends = Ends::default();
            seen.iter().for_each(|layer| ends.add(&layer.strokes()));
            dashes(&self.0.strokes(), &Pattern { dash, gap }, &ends)
        })
    }
}
