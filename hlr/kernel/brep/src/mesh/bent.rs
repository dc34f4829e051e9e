//! Faces that bend in both directions: a lattice of inner points, Delaunay's triangles in the chart, and more points until
//! every triangle keeps the chord error.

use super::border::Border;
use super::bound::{Bend, Corner, Gap, corner, gap};
use super::delaunay::Delaunay;
use super::outline::Outline;
use super::plane::distance2;
use super::size::Field;
use super::steps::Steps;
use super::{FaceLoops, Fault, Made, lattice};
use crate::geometry::surface::Surface;

/// Rounds of more points.
const ROUNDS: usize = 16;
/// Points inside one face.
const MOST: usize = 8_000_000;
/// A triangle on the border cannot be better than the chord there: of that one's error, it may be off by as much.
const BESIDE: f64 = 1.25;
/// Of the length of a chord: new points are kept so far off it in the chart; nearer only where there is no other way.
const OFF: [f64; 2] = [0.2, 0.02];

/// `straight`: with a chart that is slower to be filled and never wrong. Faults of the loops as None beside their outline: whoever asks finds out why.
pub fn triangulate(
    surface: &Surface,
    loops: &FaceLoops,
    deflection: f64,
    angle: f64,
    straight: bool,
    steps: &Steps,
) -> Result<Result<Made, Box<Outline>>, Fault> {
    let bounds = Outline::new(loops, |_, _, _| ())?.bounds();
    if !(0..2).all(|k| bounds[0][k] < bounds[1][k]) {
        return Err(Fault::Open);
    }
    let field = Field::new(surface, bounds, deflection, angle, straight, steps).ok_or(Fault::Degenerate)?;
    let outline = Outline::new(loops, |from, to, shares| {
        let (a, b) = (field.to_chart(from), field.to_chart(to));
        let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        let count = ((b[0] - a[0]).hypot(b[1] - a[1]) / field.at(middle)).ceil().min(1000.0) as usize;
        shares.extend((1..count).map(|k| k as f64 / count as f64));
    })?;
    let chart = outline.mapped(|uv| field.to_chart(uv));
    let inner = lattice::points(&field, &Border::new(&chart), MOST, steps).ok_or(Fault::TooFine)?;
    steps.reached(DONE[0]);
    let Some(mesh) = Delaunay::new(&chart, &inner, steps) else { return Ok(Err(Box::new(outline))) };
    steps.reached(DONE[1]);
    let (mut corners, mut bends): (Vec<Corner>, Vec<Bend>) =
        outline.uv.iter().zip(&outline.points).map(|(&uv, &p)| corner(surface, uv, Some(p))).unzip();
    for &xy in &inner {
        steps.step();
        let (corner, bend) = corner(surface, field.on_surface(xy), None);
        corners.push(corner);
        bends.push(bend);
    }
    let spans = corners.iter().map(|c| field.span(c.uv)).collect();
    let mut places = chart.uv.clone();
    places.extend(inner);
    let mut work =
        Work { surface, field: &field, chart: &chart, mesh, corners, bends, spans, places, deflection, steps };
    let (triangles, error) = work.refine();
    let Work { corners, mesh, .. } = work;
    Ok(Ok(Made { outline, corners, triangles, stand_in: mesh.stand_in, error, turned: Vec::new() }))
}

/// Of the work on a face, about: when its inner points are known, when they are joined, when they are judged once.
const DONE: [f64; 3] = [0.2, 0.6, 0.8];

struct Work<'a> {
    surface: &'a Surface,
    field: &'a Field,
    chart: &'a Outline,
    mesh: Delaunay<'a>,
    corners: Vec<Corner>,
    bends: Vec<Bend>,
    /// Between which knots the corners are.
    spans: Vec<[u32; 2]>,
    /// Of the corners, in the chart.
    places: Vec<[f64; 2]>,
    deflection: f64,
    steps: &'a Steps<'a>,
}

impl Work<'_> {
    /// The triangles, and the greatest error that remains.
    fn refine(&mut self) -> (Vec<[u32; 3]>, f64) {
        let mut worst = 0.0f64;
        let mut coarse = Vec::new();
        for t in self.mesh.inside() {
            self.judge(t, &mut worst, &mut coarse);
        }
        self.steps.reached(DONE[2]);
        for _ in 0..ROUNDS {
            let known = self.corners.len();
            if coarse.is_empty() || known > MOST || !self.divide(&mut coarse) {
                break;
            }
            coarse.retain(|(_, t)| self.mesh.has(*t));
            // All triangles that were not there have a new point.
            for point in known as u32..self.corners.len() as u32 {
                for t in self.mesh.around(point) {
                    if t.iter().all(|&i| i >= point || i < known as u32) {
                        self.judge(t, &mut worst, &mut coarse);
                    }
                }
            }
        }
        (self.mesh.inside(), coarse.iter().fold(worst, |w, (gap, _)| w.max(gap.whole)))
    }

    /// Whether a triangle keeps the deflection, or is as good as the border lets it be.
    fn judge(&self, t: [u32; 3], worst: &mut f64, coarse: &mut Vec<(Gap, [u32; 3])>) {
        self.steps.step();
        let at = t.map(|i| i as usize);
        let (corners, bends) = (at.map(|i| &self.corners[i]), at.map(|i| &self.bends[i]));
        let spans = at.map(|i| self.spans[i]);
        let kinked = spans[0] != spans[1] || spans[1] != spans[2];
        let gap = gap(self.surface, corners, bends, kinked, self.deflection);
        if gap.whole > self.deflection {
            let beside = (0..3).filter(|&k| self.is_chord(t[k], t[(k + 1) % 3])).map(|k| gap.edges[k]);
            if gap.whole > BESIDE * beside.fold(0.0, f64::max) {
                coarse.push((gap, t));
            }
        } else {
            *worst = worst.max(gap.whole);
        }
    }

    fn is_chord(&self, a: u32, b: u32) -> bool {
        let count = self.chart.len() as u32;
        a < count && b < count && (self.chart.after(a) == b || self.chart.after(b) == a)
    }

    /// One more point for each coarse triangle that has no neighbour with a new one. Whether there was any.
    fn divide(&mut self, coarse: &mut [(Gap, [u32; 3])]) -> bool {
        coarse.sort_by(|a, b| b.0.whole.total_cmp(&a.0.whole).then(a.1.cmp(&b.1)));
        let mut touched = vec![false; self.corners.len()];
        let mut any = false;
        for &mut (gap, t) in coarse {
            if t.iter().filter(|&&i| touched[i as usize]).count() >= 2 {
                continue;
            }
            let Some(place) = self.place(&gap, t) else { continue };
            if self.mesh.insert(place, t[0]) {
                t.iter().for_each(|&i| touched[i as usize] = true);
                let (corner, bend) = corner(self.surface, self.field.on_surface(place), None);
                self.spans.push(self.field.span(corner.uv));
                self.corners.push(corner);
                self.bends.push(bend);
                self.places.push(place);
                any = true;
            }
        }
        any
    }

    /// Amid the edge with the greatest error, or amid the triangle where that is too near the border.
    fn place(&self, gap: &Gap, t: [u32; 3]) -> Option<[f64; 2]> {
        let [a, b, c] = t.map(|i| self.places[i as usize]);
        let ends = [(a, b), (b, c), (c, a)];
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| gap.edges[j].total_cmp(&gap.edges[i]));
        let clear = |p: &[f64; 2], off: f64| {
            (0..3).all(|k| {
                let (from, to) = ends[k];
                let length = (to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2);
                !self.is_chord(t[k], t[(k + 1) % 3]) || distance2(p, &from, &to) > off * off * length
            })
        };
        let middle = |k: usize| [0, 1].map(|i| 0.5 * (ends[k].0[i] + ends[k].1[i]));
        OFF.iter().find_map(|&off| {
            let inner = order.iter().filter(|&&k| !self.is_chord(t[k], t[(k + 1) % 3]));
            let split = inner.map(|&k| middle(k)).find(|p| clear(p, off));
            split.or_else(|| Some([0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0)).filter(|p| clear(p, off)))
        })
    }
}
