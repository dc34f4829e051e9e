//! The polyline of an edge of a model.

use super::chord_error::from_chord;
use super::chords::chords;
use crate::geometry::curve::{Curve, Vec3};
use crate::geometry::vector::{length, sub};
use crate::model::Model;
use crate::shapes::Edge;
use hlr_accuracy::{CHORD_SAMPLED, EDGE_CERTAIN};

/// Corners of an edge's polyline, in the edge's frame, by ascending parameters. The ends are the vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    pub parameters: Vec<f64>,
    pub points: Vec<Vec3>,
}

impl Polyline {
    /// Halves the chords with these numbers (ascending) that are longer than the edge's tolerance; true if any was.
    pub fn divide(&mut self, model: &Model, edge: &Edge, chords: &[usize], deflection: f64) -> bool {
        let shortest = 2.0 * NEAR_END * edge.tolerance.min(EDGE_CERTAIN * deflection).max(SAME);
        let at = |t: f64| match (&edge.curve, edge.only_on.as_deref()) {
            (Some(curve), _) => Some(curve.point(t)),
            (None, Some((curve, surface))) => {
                let [u, v, _] = model.curves2[*curve].as_ref()?.point(t);
                Some(surface.point([u, v]))
            }
            (None, None) => None,
        };
        let before = self.points.len();
        for &chord in chords.iter().rev() {
            let Some(&[from, to]) = self.parameters.get(chord..chord + 2).and_then(<[f64]>::first_chunk) else {
                continue;
            };
            let middle = 0.5 * (from + to);
            if length(&sub(&self.points[chord + 1], &self.points[chord])) <= shortest {
                continue;
            }
            if let Some(point) = at(middle)
                && from < middle
                && middle < to
                && point.iter().all(|c| c.is_finite())
            {
                self.parameters.insert(chord + 1, middle);
                self.points.insert(chord + 1, point);
            }
        }
        self.points.len() > before
    }
}

/// Number of parts per full turn into which the line of a pole in (u, v) is divided.
const POLE_PARTS: f64 = 16.0;
/// Distance from the vertex at which a polyline leaves its curve, in multiples of the gap between vertex and curve.
const LEAVES: f64 = 3.0;
/// Share of the first chord: no corner is added beyond that.
const MOST_SHARE: f64 = 0.4;
/// No inner corner is closer to an end than this many tolerances; OpenCASCADE treats such points as equal.
const NEAR_END: f64 = 2.0;
const SAME: f64 = 1e-7;
const MOST_HALVINGS: u32 = 14;

/// The polyline of an edge for a chord error and a turning angle in radians; None for an edge without any curve.
pub fn polyline(model: &Model, edge: &Edge, deflection: f64, angle: f64) -> Option<Polyline> {
    let on = edge.only_on.as_deref().and_then(|(curve, surface)| Some((model.curves2[*curve].as_ref()?, surface)));
    let [first, last] = edge.range;
    if !(deflection > 0.0 && angle > 0.0) {
        return None;
    }
    if edge.degenerate {
        let point = edge.end_points[0].or(edge.end_points[1])?;
        if first.partial_cmp(&last) != Some(std::cmp::Ordering::Less) {
            return None;
        }
        let count = ((last - first) / std::f64::consts::TAU * POLE_PARTS).ceil().clamp(1.0, POLE_PARTS) as usize;
        let parameters: Vec<f64> = (0..=count).map(|i| first + (last - first) * i as f64 / count as f64).collect();
        return Some(Polyline { points: vec![point; parameters.len()], parameters });
    }
    let (mut parameters, mut points) = match (&edge.curve, on) {
        (Some(curve @ Curve::Line { .. }), _) if edge.joints.is_empty() => {
            (vec![first, last], vec![curve.point(first), curve.point(last)])
        }
        (Some(curve), _) => {
            let mut parameters = vec![first];
            let inner = edge.joints.iter().copied().filter(|t| *t > first && *t < last);
            for to in inner.chain([last]) {
                let from = parameters[parameters.len() - 1];
                parameters.extend(&chords(curve, [from, to], deflection, angle)[1..]);
            }
            let points = parameters.iter().map(|&t| curve.point(t)).collect::<Vec<_>>();
            (parameters, points)
        }
        (None, Some((curve, surface))) if first < last => {
            let at = |t: f64| {
                let [u, v, _] = curve.point(t);
                surface.point([u, v])
            };
            let mut rows = vec![(first, at(first))];
            const PARTS: u32 = 4;
            for i in 0..PARTS {
                let t = first + (last - first) * f64::from(i + 1) / f64::from(PARTS);
                sampled(&at, t, at(t), deflection * CHORD_SAMPLED, 0, &mut rows);
            }
            rows.into_iter().unzip()
        }
        _ => return None,
    };
    if let Some(curve) = &edge.curve {
        beside_ends(curve, edge.end_points, deflection, &mut parameters, &mut points);
    }
    let end = points.len() - 1;
    for (place, vertex) in [(0, edge.end_points[0]), (end, edge.end_points[1])] {
        if let Some(vertex) = vertex {
            points[place] = vertex;
        }
    }
    if edge.end_points == [None, None] && length(&sub(&points[0], &points[end])) <= edge.tolerance {
        points[end] = points[0];
    }
    let (parameters, points) = apart(parameters, points, edge.tolerance.min(EDGE_CERTAIN * deflection));
    let end = points.len() - 1;
    let finite = points.iter().flatten().all(|c| c.is_finite());
    // A closed edge of a single chord would have no length: it gets inner corners.
    if finite && end == 1 && points[0] == points[end] {
        let middle = 0.5 * (first + last);
        let curve = edge.curve.as_ref()?;
        let inner = [0.5 * (first + middle), middle, 0.5 * (middle + last)];
        let points = [points[0], curve.point(inner[0]), curve.point(inner[1]), curve.point(inner[2]), points[end]];
        return Some(Polyline { parameters: vec![first, inner[0], inner[1], inner[2], last], points: points.to_vec() });
    }
    finite.then_some(Polyline { parameters, points })
}

/// Adds a corner close to a vertex that lies off the end of the curve. The polyline then leaves the curve only there,
/// and not along the whole first chord.
///
/// ```text
///  o                        vertex
///   '-x-----------x--       x: corners on the curve, the first one added
/// ```
fn beside_ends(
    curve: &Curve,
    vertices: [Option<Vec3>; 2],
    deflection: f64,
    parameters: &mut Vec<f64>,
    points: &mut Vec<Vec3>,
) {
    for (side, vertex) in vertices.into_iter().enumerate() {
        let last = points.len() - 1;
        let [end, beside] = if side == 0 { [0, 1] } else { [last, last - 1] };
        let Some(off) = vertex.map(|v| length(&sub(&points[end], &v))).filter(|off| *off > deflection) else {
            continue;
        };
        let way = parameters[beside] - parameters[end];
        let share = LEAVES * off / (length(&curve.derivatives(parameters[end])[1]) * way.abs());
        if share < MOST_SHARE {
            let t = parameters[end] + share * way;
            parameters.insert(end.max(beside), t);
            points.insert(end.max(beside), curve.point(t));
        }
    }
}

/// Removes inner corners that are within the edge's tolerance of an end: the direction of a chord from there is
/// arbitrary.
fn apart(parameters: Vec<f64>, points: Vec<Vec3>, tolerance: f64) -> (Vec<f64>, Vec<Vec3>) {
    let end = points.len() - 1;
    let far =
        |k: usize| [0, end].iter().all(|&e| length(&sub(&points[k], &points[e])) > NEAR_END * tolerance.max(SAME));
    if (1..end).all(far) {
        return (parameters, points);
    }
    let kept: Vec<usize> = (0..=end).filter(|&k| k == 0 || k == end || far(k)).collect();
    (kept.iter().map(|&k| parameters[k]).collect(), kept.iter().map(|&k| points[k]).collect())
}

fn sampled(at: &dyn Fn(f64) -> Vec3, to: f64, end: Vec3, most: f64, depth: u32, rows: &mut Vec<(f64, Vec3)>) {
    let (from, begin) = rows[rows.len() - 1];
    let off = |share: f64| from_chord(&at(from + share * (to - from)), &begin, &end);
    if depth < MOST_HALVINGS && [0.5, 0.25, 0.75].iter().any(|&share| off(share) > most) {
        let middle = 0.5 * (from + to);
        sampled(at, middle, at(middle), most, depth + 1, rows);
        sampled(at, to, end, most, depth + 1, rows);
    } else {
        rows.push((to, end));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_off_its_curve_leaves_the_rest_of_the_polyline_on_it() {
        let line = Curve::Line { p: [0.0; 3], a: [1.0, 0.0, 0.0] };
        let off = [Some([0.0, 0.1, 0.0]), Some([10.0, 0.0, 0.1])];
        let made = |deflection, length: f64| {
            let (mut parameters, mut points) = (vec![0.0, length], vec![[0.0; 3], [length, 0.0, 0.0]]);
            let ends = [off[0], off[1].map(|[_, y, z]| [length, y, z])];
            beside_ends(&line, ends, deflection, &mut parameters, &mut points);
            assert!(parameters.iter().zip(&points).all(|(t, p)| *p == [*t, 0.0, 0.0]));
            parameters
        };
        let found = made(0.01, 10.0);
        assert!(found.iter().zip([0.0, 0.3, 9.7, 10.0]).all(|(t, wanted)| (t - wanted).abs() < 1e-12));
        // Gaps within the deflection change nothing, nor do edges that are as short as their tolerance.
        assert_eq!(made(0.2, 10.0), [0.0, 10.0]);
        assert_eq!(made(0.01, 0.5), [0.0, 0.5]);
    }
}
