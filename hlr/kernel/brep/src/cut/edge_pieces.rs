//! Edges divided where they pass through a plane.

use super::plane::Plane;
use crate::edges::Polyline;
use crate::geometry::curve::Curve;
use crate::geometry::vector::{Vector, dot};
use crate::shapes::Edge;
use hlr_exact::elementary::atan2;

/// Where a chord of an edge's polyline passes through the plane.
#[derive(Clone, Copy, Debug)]
pub struct Break {
    pub chord: usize,
    pub vertex: u32,
}

/// A piece of an edge on the side that is kept. `ends`: vertices.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub range: [f64; 2],
    pub ends: [u32; 2],
}

/// An edge as a plane divides it. `on`: all of it lies on the plane.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    pub breaks: Vec<Break>,
    pub kept: Vec<Piece>,
    pub on: bool,
}

/// Steps of a search for a root.
const STEPS: usize = 200;

/// Parameters at which an edge lies farthest along the plane's normal, no farther than `reach` from the plane: its
/// polyline gets corners there, for no chord must pass by a plane that its arc reaches. Elsewhere corners would only make
/// borders of faces cross, where edges lie off their faces.
pub fn extremes(edge: &Edge, plane: &Plane, reach: f64) -> Vec<f64> {
    let Some(curve @ Curve::Ellipse { a, b, .. }) = &edge.curve else { return Vec::new() };
    let half = std::f64::consts::PI;
    let [first, last] = edge.range;
    let start = atan2(dot(b, &plane.normal), dot(a, &plane.normal));
    let before = ((first - start) / half).floor();
    let near = |t: &f64| *t > first && *t < last && plane.height(&curve.point(*t)).abs() <= reach;
    (0..4).map(|k| start + (before + f64::from(k)) * half).filter(near).collect()
}

/// Divides an edge. `ends`: its vertices; `points`: of all vertices, to which new ones are added.
pub fn divided(edge: &Edge, line: &Polyline, ends: [u32; 2], plane: &Plane, points: &mut Vec<Vector>) -> Pieces {
    let beyond: Vec<bool> = line.points.iter().map(|p| plane.is_beyond(p)).collect();
    let on = line.points.iter().all(|p| plane.holds(p));
    let last = line.points.len() - 1;
    let mut out = Pieces { on, ..Pieces::default() };
    // The vertex of an inner corner that lies on the plane, at which two chords may pass through it.
    let mut of_corner: Option<(usize, u32)> = None;
    let mut open = (!beyond[0]).then_some((line.parameters[0], ends[0]));
    for chord in 0..last {
        if beyond[chord] == beyond[chord + 1] {
            continue;
        }
        let below = if beyond[chord] { chord + 1 } else { chord };
        let here = plane.holds(&line.points[below]);
        let (vertex, parameter) = match below {
            0 if here => (ends[0], line.parameters[0]),
            _ if here && below == last => (ends[1], line.parameters[last]),
            _ => {
                let parameter =
                    if here { line.parameters[below] } else { root(edge, line, chord, beyond[chord], plane) };
                let known = of_corner.filter(|&(corner, _)| here && corner == below).map(|(_, vertex)| vertex);
                let vertex = known.unwrap_or_else(|| {
                    points.push(edge.curve.as_ref().map_or(line.points[below], |curve| curve.point(parameter)));
                    points.len() as u32 - 1
                });
                if here {
                    of_corner = Some((below, vertex));
                }
                (vertex, parameter)
            }
        };
        out.breaks.push(Break { chord, vertex });
        match open.take() {
            Some((begin, first)) => {
                if parameter > begin {
                    out.kept.push(Piece { range: [begin, parameter], ends: [first, vertex] });
                }
            }
            None => open = Some((parameter, vertex)),
        }
    }
    if let Some((begin, first)) = open
        && begin < line.parameters[last]
    {
        out.kept.push(Piece { range: [begin, line.parameters[last]], ends: [first, ends[1]] });
    }
    out
}

/// The parameter at which a chord's stretch of the edge passes through the plane; the end on the kept side where the
/// stretch does not, as the ends of an edge may lie off its curve.
fn root(edge: &Edge, line: &Polyline, chord: usize, falls: bool, plane: &Plane) -> f64 {
    let [from, to] = [line.parameters[chord], line.parameters[chord + 1]];
    let Some(curve) = &edge.curve else { return if falls { to } else { from } };
    let height = |t: f64| plane.height(&curve.point(t)) * if falls { -1.0 } else { 1.0 };
    bracketed(height, from, to)
}

/// Where a function that rises from below zero to above it is zero. The nearer end where it does not.
pub fn bracketed(height: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let (mut low, mut high) = ((from, height(from)), (to, height(to)));
    if low.1 >= 0.0 {
        return from;
    }
    if high.1 <= 0.0 {
        return to;
    }
    // Regula falsi, in which an end that stays counts half (Illinois).
    let mut stays = 0;
    for _ in 0..STEPS {
        let mut middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if !(middle > low.0 && middle < high.0) {
            middle = 0.5 * (low.0 + high.0);
        }
        if middle <= low.0 || middle >= high.0 {
            break;
        }
        let value = height(middle);
        if value == 0.0 {
            return middle;
        }
        if value < 0.0 {
            low = (middle, value);
            if stays == -1 {
                high.1 *= 0.5;
            }
            stays = -1;
        } else {
            high = (middle, value);
            if stays == 1 {
                low.1 *= 0.5;
            }
            stays = 1;
        }
    }
    0.5 * (low.0 + high.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Three quarters of a circle of radius 2 about (1, 0, 0), which begins at (3, 0, 0) and runs toward y.
    fn arc() -> Edge {
        let circle = Curve::Ellipse { p: [1.0, 0.0, 0.0], a: [2.0, 0.0, 0.0], b: [0.0, 2.0, 0.0] };
        Edge::on_curve(circle, [0.0, 0.75 * TAU], [(0, 0), (1, 0)], 0.0)
    }

    fn corners(normal: Vector, level: f64) -> Vec<f64> {
        extremes(&arc(), &Plane { normal, level, near: 1e-9 }, 0.125)
    }

    #[test]
    fn an_arc_has_corners_where_it_lies_farthest_and_near_the_plane() {
        // At x = -1 it lies farthest; its first point, farthest the other way, is its end.
        for (level, found) in [(-1.0, 1), (-1.1, 1), (-0.9, 1), (-1.2, 0), (-0.8, 0), (1.0, 0), (3.0, 0)] {
            let at = corners([1.0, 0.0, 0.0], level);
            assert_eq!(at.len(), found, "{level}");
            assert!(at.iter().all(|t| (t - PI).abs() < 1e-12));
        }
    }
}
