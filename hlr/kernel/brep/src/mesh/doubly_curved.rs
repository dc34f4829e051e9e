//! The mesh of a face that curves in both directions.
//!
//! 1. Place a lattice of inner points in a chart of (u, v).
//! 2. Compute constrained Delaunay triangles in the chart.
//! 3. Insert more points until every triangle keeps the chord error.

use super::border_grid::BorderGrid;
use super::coarse::{Coarse, Fall};
use super::delaunay::Delaunay;
use super::draft::Draft;
use super::face::{FaceLoops, Fault};
use super::gap::{Bend, Corner, Gap, corner, gap, off_plane};
use super::lattice;
use super::outline::Outline;
use super::plane::distance2;
use super::progress::Progress;
use super::spacing::Field;
use super::strips::{Strips, strips};
use super::sweep;
use super::triangulation::Triangulation;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{dot, sub};
use hlr_accuracy::MESH_BESIDE_BORDER;
use hlr_exact::elementary::hypot;

/// Limit on the rounds in which points are inserted.
const ROUNDS: usize = 16;
/// The same while no more than a few triangles are too coarse: along a narrow fold each needs the point of another.
const ROUNDS_OF_FEW: usize = 1024;
const FEW: usize = 256;
/// Rounds after which the largest error has to be smaller, by this factor, where it is that of one triangle which gets no
/// point, or a point of the border that is off the surface may be its reason.
const ROUNDS_STALLED: usize = 32;
const FALLEN: f64 = 0.99;
/// Limit on the points inside one face.
const MOST: usize = 8_000_000;
/// Distance in the chart that new points keep from a chord, as a share of the chord's length. The smaller one is used
/// only where the larger one leaves no place.
const OFF: [f64; 2] = [0.2, 0.02];
/// Triangles whose error is measured where no more points are inserted.
const MEASURED: usize = 10_000;
/// Share of the face's extent in (u, v) below which corners of a triangle never face apart on a sound surface.
const TORN: f64 = 1e-3;

/// The mesh before its proof. If the loops cannot be filled, their outline, from which the caller can find out why.
///
/// `straight`: with a chart that is not bent. It is slower to fill, but chords cross in it only where they cross in
/// (u, v).
pub fn triangulate(
    surface: &Surface,
    loops: &FaceLoops,
    deflection: f64,
    angle: f64,
    straight: bool,
    steps: &Progress,
) -> Result<Result<Draft, Box<Outline>>, Fault> {
    let bounds = Outline::new(loops, |_, _, _| ())?.bounds();
    if !(0..2).all(|k| bounds[0][k] < bounds[1][k]) {
        return Err(Fault::Open);
    }
    let field = Field::new(surface, bounds, deflection, angle, straight, steps).ok_or(Fault::Degenerate)?;
    let outline = Outline::new(loops, |from, to, shares| {
        let (a, b) = (field.to_chart(from), field.to_chart(to));
        let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        let count = (hypot(b[0] - a[0], b[1] - a[1]) / field.at(middle)).ceil().min(1000.0) as usize;
        shares.extend((1..count).map(|k| k as f64 / count as f64));
    })?;
    let chart = outline.mapped(|uv| field.to_chart(uv));
    let Some(Filled { inner, net, stand_in }) = filled(&field, &chart, steps)? else {
        return Ok(Err(Box::new(outline)));
    };
    let mut work = Work::new(surface, &field, &chart, deflection, net, steps);
    steps.reached(DONE[1]);
    work.evaluate(&outline, &inner);
    let (error, torn, coarse) = work.refine();
    let Work { corners, net, places, stalled, .. } = work;
    let (triangles, bent_chart) = (net.into_triangles(), (!straight).then_some(places));
    Ok(Ok(Draft {
        outline,
        corners,
        triangles,
        stand_in,
        error,
        torn,
        stalled,
        coarse,
        bent_chart,
        turned: Vec::new(),
    }))
}

/// The largest error of some triangles of a mesh, leaving out those of which the border allows no better.
pub fn largest_error(
    surface: &Surface,
    outline: &Outline,
    corners: &[Corner],
    triangles: impl Iterator<Item = [u32; 3]>,
    deflection: f64,
) -> f64 {
    let error = |t: [u32; 3]| {
        let at = t.map(|i| &corners[i as usize]);
        let bends = at.map(|c| corner(surface, c.uv, None).1);
        // Measured as well, as if knots lay between the corners: knots are not looked up here.
        let gap = gap(surface, at, bends.each_ref(), true, deflection);
        if is_due_to_border(outline, t, &gap, deflection) { 0.0 } else { gap.whole }
    };
    triangles.map(error).fold(0.0, f64::max)
}

/// Whether a triangle exceeds the deflection because the chords of the border beside it allow no better.
fn is_due_to_border(outline: &Outline, t: [u32; 3], gap: &Gap, deflection: f64) -> bool {
    let beside = (0..3).filter(|&k| is_chord(outline, t[k], t[(k + 1) % 3])).map(|k| gap.edges[k]);
    gap.whole > deflection && gap.whole <= MESH_BESIDE_BORDER * beside.fold(0.0, f64::max)
}

fn is_chord(outline: &Outline, a: u32, b: u32) -> bool {
    let count = outline.len() as u32;
    a < count && b < count && (outline.after(a) == b || outline.after(b) == a)
}

/// Approximate share of the work on a face that is done when its inner points are known, when they are triangulated,
/// and when all triangles have been judged once.
const DONE: [f64; 3] = [0.2, 0.6, 0.8];

struct Filled {
    inner: Vec<[f64; 2]>,
    net: Triangulation,
    stand_in: Vec<u32>,
}

/// The points inside the loops, and the triangles; None where the loops cannot be filled.
fn filled(field: &Field, chart: &Outline, steps: &Progress) -> Result<Option<Filled>, Fault> {
    let own = || (0..chart.len() as u32).collect();
    if let Some(Strips { inner, triangles, loose }) = strips(field, chart, MOST, steps) {
        let mut net = Triangulation::new(chart.len() + inner.len(), triangles, |_, _| false);
        let places: Vec<_> = chart.uv.iter().chain(&inner).copied().collect();
        if net.settle(&places, loose, 0, steps) {
            return Ok(Some(Filled { inner, net, stand_in: own() }));
        }
    }
    let swept = sweep::triangulate(chart, steps);
    // Chords that cross are found without inner points, of which there may be millions.
    if swept.is_none() && Delaunay::new(chart, &[], steps).is_none() {
        return Ok(None);
    }
    let mut inner = lattice::points(field, &BorderGrid::new(chart), MOST, steps).ok_or(Fault::TooFine)?;
    steps.reached(DONE[0]);
    if let Some(triangles) = swept {
        let mut net = Triangulation::new(chart.len(), triangles, |_, _| false);
        let mut places = chart.uv.clone();
        places.reserve(inner.len());
        if net.settle(&places, net.triangles().len(), inner.len(), steps) {
            inner.retain(|&p| {
                steps.step();
                places.push(p);
                let new = net.insert(&places, net.triangle_at(places.len() as u32 - 2), steps);
                if !new {
                    places.pop();
                }
                new
            });
            return Ok(Some(Filled { inner, net, stand_in: own() }));
        }
    }
    let Some(Delaunay { triangles, stand_in }) = Delaunay::new(chart, &inner, steps) else { return Ok(None) };
    let mut chords: Vec<_> =
        chart.chords().map(|c| ordered(stand_in[c as usize], stand_in[chart.after(c) as usize])).collect();
    chords.sort_unstable();
    let net =
        Triangulation::new(chart.len() + inner.len(), triangles, |a, b| chords.binary_search(&ordered(a, b)).is_ok());
    Ok(Some(Filled { inner, net, stand_in }))
}

fn ordered(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

struct Work<'a> {
    surface: &'a Surface,
    field: &'a Field,
    chart: &'a Outline,
    corners: Vec<Corner>,
    bends: Vec<Bend>,
    /// Spans between knots that hold the corners.
    spans: Vec<[u32; 2]>,
    /// Places of the corners in the chart.
    places: Vec<[f64; 2]>,
    deflection: f64,
    net: Triangulation,
    /// Whether the largest error has not become smaller for many rounds, as the border is off the surface there.
    stalled: bool,
    steps: &'a Progress<'a>,
}

impl<'a> Work<'a> {
    fn new(
        surface: &'a Surface,
        field: &'a Field,
        chart: &'a Outline,
        deflection: f64,
        net: Triangulation,
        steps: &'a Progress,
    ) -> Work<'a> {
        let (corners, bends, spans) = (Vec::new(), Vec::new(), Vec::new());
        let places = chart.uv.clone();
        Work { surface, field, chart, corners, bends, spans, places, deflection, net, stalled: false, steps }
    }

    /// Evaluates the surface at the points of the outline, then at the inner points.
    fn evaluate(&mut self, outline: &Outline, inner: &[[f64; 2]]) {
        let count = outline.len() + inner.len();
        self.corners.reserve(count);
        self.bends.reserve(count);
        self.spans.reserve(count);
        for (&uv, &point) in outline.uv.iter().zip(&outline.points) {
            self.add(uv, Some(point));
        }
        // All points of a row have the same v.
        let mut row = [f64::NAN; 2];
        for &[x, y] in inner {
            if y != row[0] {
                row = [y, self.field.parameter(1, y)];
            }
            self.add([self.field.parameter(0, x), row[1]], None);
        }
        self.places.extend(inner);
    }

    fn add(&mut self, uv: [f64; 2], point: Option<[f64; 3]>) {
        self.steps.step();
        let (corner, bend) = corner(self.surface, uv, point);
        self.corners.push(corner);
        self.bends.push(bend);
        self.spans.push(self.field.span(uv));
    }

    /// Inserts points where triangles are too coarse, until half of the steps are taken or it stalls. Returns the largest
    /// error that remains, whether it remains because the surface is torn, and the chords that meet triangles which are
    /// still too coarse, ascending.
    fn refine(&mut self) -> (f64, bool, Vec<u32>) {
        let (mut worst, mut coarse) = (0.0f64, Vec::new());
        (0..self.net.triangles().len()).for_each(|number| self.judge(number, &mut worst, &mut coarse));
        self.steps.reached(DONE[2]);
        let mut fall = Fall { least: f64::INFINITY, corners: [0; 3], round: 0 };
        for round in 0..ROUNDS_OF_FEW {
            let Some(largest) = coarse.iter().max_by(|a, b| Coarse::order(a, b)) else { break };
            if largest.gap.whole <= FALLEN * fall.least {
                fall = Fall { least: largest.gap.whole, corners: largest.corners, round };
            } else if round - fall.round >= ROUNDS_STALLED {
                self.stalled = self.is_off(largest.corners);
                if self.stalled || largest.corners == fall.corners {
                    break;
                }
            }
            let known = self.corners.len();
            let late = round >= ROUNDS && coarse.len() > FEW;
            let spent = self.steps.is_half_spent();
            if late || known > MOST || spent || !self.divide(&mut coarse) {
                break;
            }
            coarse.retain(|c| self.net.triangles()[c.number] == c.corners);
            // Every new triangle has a new point as a corner.
            for point in known as u32..self.corners.len() as u32 {
                for number in self.net.around(point) {
                    if self.net.triangles()[number].iter().all(|&i| i >= point || i < known as u32) {
                        self.judge(number, &mut worst, &mut coarse);
                    }
                }
            }
        }
        let border = coarse.iter().flat_map(|c| c.corners).filter(|&i| (i as usize) < self.chart.len());
        let mut chords: Vec<u32> = border.flat_map(|i| self.chart.chords_at(i)).collect();
        chords.sort_unstable();
        chords.dedup();
        let error = coarse.iter().fold(worst, |w, c| w.max(c.gap.whole));
        let unfinished = !coarse.is_empty() && (self.stalled || self.steps.is_half_spent());
        let error = if unfinished { error.max(self.off_planes()) } else { error };
        (error, coarse.iter().any(|c| self.is_torn(c.corners)), chords)
    }

    /// Whether the surface is torn within a triangle: its corners are close together in (u, v), but face apart. Spline
    /// surfaces are torn where both derivatives have one direction, and surfaces at a distance from such ones.
    fn is_torn(&self, t: [u32; 3]) -> bool {
        let at = t.map(|i| &self.corners[i as usize]);
        let close = (0..2).all(|k| {
            let lines = self.field.lines(k);
            let range = |all: &mut dyn Iterator<Item = f64>| {
                all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
            };
            let [low, high] = range(&mut at.iter().map(|corner| corner.uv[k]));
            high - low < TORN * (lines[lines.len() - 1] - lines[0])
        });
        close && (0..3).any(|i| dot(&at[i].normal, &at[(i + 1) % 3].normal) < 0.0)
    }

    /// Whether a corner of a triangle is a point of the border off the surface, by more than the deflection.
    fn is_off(&self, t: [u32; 3]) -> bool {
        let off = |i: usize| {
            let d = sub(&self.corners[i].point, &self.bends[i][3]);
            dot(&d, &d) > self.deflection * self.deflection
        };
        t.iter().any(|&i| off(i as usize))
    }

    /// How far the surface is off the planes of the triangles that seem to be the farthest off, measured: where points
    /// are missing, estimates from second derivatives may be too small.
    fn off_planes(&self) -> f64 {
        let seems = |t: &[u32; 3]| {
            self.steps.step();
            self.gap(*t).whole
        };
        let mut found: Vec<(f64, [u32; 3])> = self.net.triangles().iter().map(|t| (seems(t), *t)).collect();
        found.retain(|(off, _)| *off > self.deflection);
        found.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let off = |(_, t): &(f64, [u32; 3])| off_plane(self.surface, t.map(|i| &self.corners[i as usize]));
        found.iter().take(MEASURED).map(off).fold(0.0, f64::max)
    }

    /// Judges a triangle. It is coarse if it exceeds the deflection, unless the chords of the border beside it allow no
    /// better.
    fn judge(&self, number: usize, worst: &mut f64, coarse: &mut Vec<Coarse>) {
        self.steps.step();
        let t = self.net.triangles()[number];
        let gap = self.gap(t);
        if gap.whole <= self.deflection {
            *worst = worst.max(gap.whole);
        } else if !is_due_to_border(self.chart, t, &gap, self.deflection) {
            coarse.push(Coarse { gap, corners: t, number });
        }
    }

    fn gap(&self, t: [u32; 3]) -> Gap {
        let at = t.map(|i| i as usize);
        let (corners, bends) = (at.map(|i| &self.corners[i]), at.map(|i| &self.bends[i]));
        let spans = at.map(|i| self.spans[i]);
        let kinked = spans[0] != spans[1] || spans[1] != spans[2];
        gap(self.surface, corners, bends, kinked, self.deflection)
    }

    /// Inserts a point for each coarse triangle, unless a neighbour already got one in this round. Returns whether any
    /// was inserted.
    fn divide(&mut self, coarse: &mut [Coarse]) -> bool {
        coarse.sort_by(|a, b| b.order(a));
        let mut touched = vec![false; self.corners.len()];
        let mut any = false;
        for Coarse { gap, corners: t, number } in coarse {
            if self.steps.is_half_spent() {
                break;
            }
            if t.iter().filter(|&&i| touched[i as usize]).count() >= 2 {
                continue;
            }
            let Some(place) = self.place(gap, *t) else { continue };
            self.places.push(place);
            if self.net.insert(&self.places, *number, self.steps) {
                t.iter().for_each(|&i| touched[i as usize] = true);
                self.add(self.field.on_surface(place), None);
                any = true;
            } else {
                self.places.pop();
            }
        }
        any
    }

    /// The place of a new point: the middle of the edge with the greatest error, or the centroid where that is too near
    /// the border.
    fn place(&self, gap: &Gap, t: [u32; 3]) -> Option<[f64; 2]> {
        let [a, b, c] = t.map(|i| self.places[i as usize]);
        let ends = [(a, b), (b, c), (c, a)];
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| gap.edges[j].total_cmp(&gap.edges[i]));
        let clear = |p: &[f64; 2], off: f64| {
            (0..3).all(|k| {
                let (from, to) = ends[k];
                let length = (to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2);
                !is_chord(self.chart, t[k], t[(k + 1) % 3]) || distance2(p, &from, &to) > off * off * length
            })
        };
        let middle = |k: usize| [0, 1].map(|i| 0.5 * (ends[k].0[i] + ends[k].1[i]));
        OFF.iter().find_map(|&off| {
            let inner = order.iter().filter(|&&k| !is_chord(self.chart, t[k], t[(k + 1) % 3]));
            let split = inner.map(|&k| middle(k)).find(|p| clear(p, off));
            split.or_else(|| Some([0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0)).filter(|p| clear(p, off)))
        })
    }
}
