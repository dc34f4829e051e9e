//! The parameters of a curve: its period if it is closed, start values for a search, the nearest point to a given one.

use std::f64::consts::TAU;

use hlr_brep::geometry::curve::{Curve, Vec3};
use hlr_exact::elementary::{asinh, atan2};

/// Samples per span of a B-spline from which Newton's method may begin.
const PLACES: usize = 8;
/// Cosine of the angle by which the way from sample to sample may turn: one turn of a helix has twelve samples, nearer to
/// one another than to the next turn.
const TURN: f64 = 0.86;
/// Rounds in which samples are added.
const ROUNDS: usize = 6;
const STEPS: usize = 20;
/// Samples in a row that share a box.
const RUN: usize = 16;

/// The period of a curve, if it is closed, and points to begin a search from.
pub struct Track {
    pub period: Option<f64>,
    /// A closed B-spline has parameters only inside its range.
    bounded: Option<[f64; 2]>,
    /// The range of an arc that is no whole circle or ellipse: its curve goes on beyond it.
    arc: Option<[f64; 2]>,
    places: Places,
}

impl Track {
    /// model: the distance in model units below which the two ends are one point.
    pub fn new(curve: &Curve, range: [f64; 2], model: f64) -> Track {
        match curve {
            Curve::Ellipse { .. } => {
                let arc = (range[1] - range[0] < (1.0 - 1e-9) * TAU).then_some(range);
                Track { period: Some(TAU), bounded: None, arc, places: Places::default() }
            }
            Curve::Spline(n) => {
                let (low, high) = n.domain();
                let range = [range[0].max(low), range[1].min(high)];
                let gap = distance(&curve.point(range[0]), &curve.point(range[1]));
                let period = (gap <= model).then_some(range[1] - range[0]);
                let mut places = Vec::new();
                let mut stops = vec![range[0]];
                stops.extend(n.knots.iter().copied().filter(|&u| u > range[0] && u < range[1]));
                stops.push(range[1]);
                stops.dedup();
                // Short cubic pieces need no samples between their ends.
                let count = if n.sampled { 1 } else { PLACES };
                for w in stops.windows(2) {
                    places.extend((0..count).map(|i| w[0] + (w[1] - w[0]) * (i as f64 / count as f64)));
                }
                places.push(range[1]);
                let places: Vec<(f64, Vec3)> = places.into_iter().map(|t| (t, curve.point(t))).collect();
                let places = if n.sampled { places } else { dense(places, curve) };
                Track { period, bounded: Some(range), arc: None, places: Places::new(places) }
            }
            _ => Track { period: None, bounded: None, arc: None, places: Places::default() },
        }
    }

    /// t moved into the curve's range: by whole periods on a closed curve, to the nearer end of an open one.
    pub fn wrapped(&self, t: f64) -> f64 {
        match (self.bounded, self.period) {
            (Some([low, high]), Some(period)) if t > high || t < low => low + (t - low).rem_euclid(period),
            (Some([low, high]), None) => t.clamp(low, high),
            _ => t,
        }
    }

    /// The parameter `to` for an end at `from`: limited to the range of an open curve; None if it is more than half a
    /// turn away on a closed one.
    pub fn ending(&self, from: f64, to: f64) -> Option<f64> {
        match (self.period, self.bounded) {
            (Some(period), _) => ((to - from).abs() <= 0.5 * period).then_some(to),
            (None, Some([low, high])) => Some(to.clamp(low, high)),
            _ => Some(to),
        }
    }

    /// The parameter `to` for an end at `from`, both of an edge: not beyond the end of its arc, where the circle is that of
    /// the next edge.
    pub fn within_arc(&self, from: f64, to: f64) -> f64 {
        let Some([low, high]) = self.arc else { return to };
        let turns = ((from - 0.5 * (low + high)) / TAU).round() * TAU;
        to.clamp((low + turns).min(from), (high + turns).max(from))
    }

    /// Whether an interval is all of a closed curve.
    pub fn closes(&self, range: [f64; 2]) -> bool {
        self.period.is_some_and(|p| (range[1] - range[0]).abs() >= (1.0 - 1e-12) * p)
    }

    /// An interval as pieces that do not cross the seam, each inside the range.
    pub fn unbroken(&self, from: f64, to: f64) -> Vec<[f64; 2]> {
        let (Some([low, high]), Some(period)) = (self.bounded, self.period) else { return vec![[from, to]] };
        let mut out = Vec::new();
        let turn = ((from - low) / period).floor();
        let mut start = from - turn * period;
        let mut left = to - from;
        while left > 0.0 && out.len() < 3 {
            let end = (start + left).min(high);
            if end > start {
                out.push([start, end]);
            }
            left -= end - start;
            if end < high {
                break;
            }
            start = low;
        }
        out
    }

    /// The parameter of the point of the curve nearest to p.
    pub fn nearest(&self, curve: &Curve, p: &Vec3) -> f64 {
        let start = match curve {
            Curve::Ellipse { p: centre, a, b }
            | Curve::Hyperbola { p: centre, a, b }
            | Curve::Parabola { p: centre, a, b } => {
                // Coordinates of the foot point in the plane of the curve.
                let d = [0, 1, 2].map(|k| p[k] - centre[k]);
                let (aa, ab, bb) = (dot3(a, a), dot3(a, b), dot3(b, b));
                let (ad, bd) = (dot3(a, &d), dot3(b, &d));
                let det = aa * bb - ab * ab;
                let (x, y) = ((ad * bb - bd * ab) / det, (bd * aa - ad * ab) / det);
                match curve {
                    Curve::Ellipse { .. } => atan2(y, x),
                    Curve::Hyperbola { .. } => asinh(y),
                    _ => y,
                }
            }
            Curve::Line { p: origin, a } => {
                return dot3(&[0, 1, 2].map(|k| p[k] - origin[k]), a) / dot3(a, a);
            }
            Curve::Spline(_) => self.places.nearest(p),
        };
        self.descend(curve, p, start)
    }

    /// Newton's method for the foot point, never farther away than it began.
    fn descend(&self, curve: &Curve, p: &Vec3, start: f64) -> f64 {
        let mut best = (f64::INFINITY, start);
        let mut t = start;
        for _ in 0..STEPS {
            // The search may cross the seam.
            let [q, d1, d2] = curve.derivatives(self.wrapped(t));
            let away = [0, 1, 2].map(|k| q[k] - p[k]);
            let far = dot3(&away, &away);
            if far < best.0 {
                best = (far, t);
            } else {
                // Halfway back to the best.
                if (t - best.1).abs() <= 1e-12 * (1.0 + t.abs()) {
                    break;
                }
                t = 0.5 * (t + best.1);
                continue;
            }
            let speed = dot3(&d1, &d1);
            let slope = speed + dot3(&away, &d2);
            let step = dot3(&away, &d1) / if slope > 0.1 * speed { slope } else { speed.max(f64::MIN_POSITIVE) };
            let mut next = t - step;
            if let (Some([low, high]), None) = (self.bounded, self.period) {
                next = next.clamp(low, high);
            }
            if (next - t).abs() <= 1e-14 * (1.0 + t.abs()) {
                break;
            }
            t = next;
        }
        self.wrapped(best.1)
    }
}

/// Points of a curve, ascending, and a box around each RUN of them.
#[derive(Default)]
struct Places {
    at: Vec<(f64, Vec3)>,
    boxes: Vec<[Vec3; 2]>,
}

impl Places {
    fn new(at: Vec<(f64, Vec3)>) -> Places {
        let bound = |run: &[(f64, Vec3)], most: fn(f64, f64) -> f64| {
            run[1..].iter().fold(run[0].1, |all, (_, p)| [0, 1, 2].map(|k| most(all[k], p[k])))
        };
        let boxes = at.chunks(RUN).map(|run| [bound(run, f64::min), bound(run, f64::max)]).collect();
        Places { at, boxes }
    }

    /// The parameter of the point nearest to p, the first of several.
    fn nearest(&self, p: &Vec3) -> f64 {
        let runs = self.at.chunks(RUN);
        let near = runs.clone().map(|run| distance(&run[0].1, p)).fold(f64::INFINITY, f64::min);
        let mut best = (f64::INFINITY, 0.0);
        for (run, [low, high]) in runs.zip(&self.boxes) {
            let inside = [0, 1, 2].map(|k| p[k].max(low[k]).min(high[k]));
            // Rounding keeps order: no point in a box is found nearer than this.
            if distance(&inside, p) > near.min(best.0) {
                continue;
            }
            for (t, place) in run {
                let d = distance(place, p);
                if d < best.0 {
                    best = (d, *t);
                }
            }
        }
        best.1
    }
}

/// The samples, with further ones between them where the way turns sharply.
fn dense(mut places: Vec<(f64, Vec3)>, curve: &Curve) -> Vec<(f64, Vec3)> {
    for _ in 0..ROUNDS {
        let ways: Vec<Vec3> = places.windows(2).map(|w| [0, 1, 2].map(|k| w[1].1[k] - w[0].1[k])).collect();
        let turns = |i: usize, j: usize| {
            let (a, b) = (&ways[i], &ways[j]);
            dot3(a, b) < TURN * (dot3(a, a) * dot3(b, b)).sqrt()
        };
        let bent = |i: usize| (i > 0 && turns(i - 1, i)) || (i + 1 < ways.len() && turns(i, i + 1));
        if !(0..ways.len()).any(bent) {
            break;
        }
        let mut next = Vec::with_capacity(2 * places.len());
        for (i, &place) in places.iter().enumerate() {
            next.push(place);
            if i < ways.len() && bent(i) {
                let t = 0.5 * (place.0 + places[i + 1].0);
                next.push((t, curve.point(t)));
            }
        }
        places = next;
    }
    places
}

fn dot3(a: &Vec3, b: &Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn distance(a: &Vec3, b: &Vec3) -> f64 {
    let d = [0, 1, 2].map(|k| a[k] - b[k]);
    dot3(&d, &d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hlr_brep::geometry::nurbs::Nurbs;

    /// Nine turns of a helix of radius 3 and pitch 1: cubic pieces of a quarter turn each.
    fn helix() -> Curve {
        let at = |t: f64| [3.0 * t.cos(), 3.0 * t.sin(), t / std::f64::consts::TAU];
        let quarter = std::f64::consts::FRAC_PI_2;
        let arm = 4.0 / 3.0 * (0.25 * quarter).tan();
        let (mut poles, mut knots) = (vec![at(0.0)], vec![0.0; 4]);
        for k in 0..36 {
            let (a, b) = (f64::from(k) * quarter, f64::from(k + 1) * quarter);
            let way = |t: f64| [-3.0 * t.sin() * arm, 3.0 * t.cos() * arm, 0.25 / 3.0];
            let (p, q, u, v) = (at(a), at(b), way(a), way(b));
            poles.extend([[0, 1, 2].map(|i| p[i] + u[i]), [0, 1, 2].map(|i| q[i] - v[i]), q]);
            knots.extend([f64::from(k + 1); 3]);
        }
        knots.push(36.0);
        let poles = poles.into_iter().map(|[x, y, z]| [x, y, z, 1.0]).collect();
        Curve::Spline(Nurbs { degree: 3, rational: false, sampled: false, knots, poles })
    }

    #[test]
    fn an_end_stays_on_the_arc_of_its_edge() {
        let circle = Curve::Ellipse { p: [0.0; 3], a: [1.0, 0.0, 0.0], b: [0.0, 1.0, 0.0] };
        let half = Track::new(&circle, [1.0, 4.0], 1e-9);
        for turn in [0.0, TAU, -3.0 * TAU] {
            for (from, to, wanted) in
                [(3.9, 4.5, 4.0), (1.1, 0.2, 1.0), (2.0, 3.0, 3.0), (4.1, 4.5, 4.1), (0.9, 0.5, 0.9)]
            {
                assert!((half.within_arc(from + turn, to + turn) - wanted - turn).abs() < 1e-12, "{turn} {from} {to}");
            }
        }
        assert_eq!(Track::new(&circle, [1.0, 1.0 + TAU], 1e-9).within_arc(3.0, 9.0), 9.0);
    }

    #[test]
    fn samples_turn_by_little_from_one_to_the_next() {
        let curve = helix();
        // Four a turn: nearer to the next turn than to one another.
        let few: Vec<(f64, Vec3)> = (0..=36).map(|k| (f64::from(k), curve.point(f64::from(k)))).collect();
        let many = dense(few, &curve);
        assert!((9 * 12..9 * 26).contains(&many.len()), "{}", many.len());
        assert!(many.windows(2).all(|w| w[0].0 < w[1].0));
        let track = Track { period: None, bounded: Some([0.0, 36.0]), arc: None, places: Places::new(many) };
        for k in 0..500 {
            let t = 36.0 * f64::from(k) / 500.0;
            assert!((track.nearest(&curve, &curve.point(t)) - t).abs() < 1e-6, "{t}");
            let p = [5.0 * t.sin(), 0.3 * t, t / 9.0];
            let found = track.places.at.iter().map(|(_, place)| distance(place, &p)).fold(f64::INFINITY, f64::min);
            assert_eq!(distance(&curve.point(track.places.nearest(&p)), &p), found, "{t}");
        }
    }
}
