//! Between two crossings of one triangle: more points on the surface, and cusps.

use super::exact::tangent;
use super::face::{Face, Place, between};
use crate::geometry::vector::{Vector, from_line, length, sub};

/// A stretch of a silhouette over one face between two points of it.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    pub from: Vector,
    pub to: Vector,
    pub normals: [Vector; 2],
    /// Either way; None where it is not known.
    pub tangents: [Option<Vector>; 2],
    /// The edge of the B-rep along which it runs, -1 for none.
    pub source: i32,
    /// The surface bends toward its normal along the line of sight: a body hides this by itself.
    pub concave: bool,
}

impl Stretch {
    pub fn turn_round(&mut self) {
        (self.from, self.to) = (self.to, self.from);
        self.normals.reverse();
        self.tangents.reverse();
    }
}

const DEEPEST: u32 = 6;
/// Curvature along the sight times the chord tolerance: less is straight.
const STRAIGHT: f64 = 1e-9;

/// |N . v| in the middle of what can only be a short cut from one curve to another.
const ASTRAY: f64 = 0.3;

/// The stretch between two crossings; none where a triangle is so large that two curves which leave the face cross it.
pub fn stretches(face: &Face, from: Place, to: Place, chord: f64) -> Vec<Stretch> {
    let mut places = vec![from];
    divide(face, &from, &to, chord, 0, &mut places);
    places.push(to);
    if places.len() == 2 && astray(face, &from, &to, chord) {
        return Vec::new();
    }
    let bend: Vec<f64> = places.iter().map(|p| face.radial(p.uv) * chord).collect();
    let mut out = Vec::with_capacity(places.len());
    for k in 1..places.len() {
        let (a, b) = (&places[k - 1], &places[k]);
        let (x, y) = (bend[k - 1], bend[k]);
        let clear = x.abs() > STRAIGHT && y.abs() > STRAIGHT;
        if clear && (x < 0.0) != (y < 0.0) {
            let c = cusp(face, a, b, x < 0.0);
            out.push(piece(face, a, &c, chord, x < 0.0));
            out.push(piece(face, &c, b, chord, y < 0.0));
        } else {
            out.push(piece(face, a, b, chord, x.min(y) < -STRAIGHT));
        }
    }
    out
}

fn piece(face: &Face, a: &Place, b: &Place, chord: f64, concave: bool) -> Stretch {
    let tangents = [a, b].map(|place| tangent(face, place, chord));
    Stretch { from: a.point, to: b.point, normals: [a.normal, b.normal], tangents, source: -1, concave }
}

fn divide(face: &Face, a: &Place, b: &Place, chord: f64, depth: u32, out: &mut Vec<Place>) {
    if depth == DEEPEST || length(&sub(&b.point, &a.point)) < chord {
        return;
    }
    let Some(middle) = between(face, a, b, 0.5) else { return };
    // The sagitta alone may be nothing by chance where the curve turns back and forth: normals tell more.
    if from_line(&middle.point, &a.point, &b.point) <= chord {
        return;
    }
    divide(face, a, &middle, chord, depth + 1, out);
    out.push(middle);
    divide(face, &middle, b, chord, depth + 1, out);
}

/// Where the curvature along the sight changes its sign, by bisection.
fn cusp(face: &Face, a: &Place, b: &Place, concave_at_a: bool) -> Place {
    let (mut low, mut high) = (*a, *b);
    for _ in 0..40 {
        let Some(middle) = between(face, &low, &high, 0.5) else { break };
        if (face.radial(middle.uv) < 0.0) == concave_at_a {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn astray(face: &Face, a: &Place, b: &Place, chord: f64) -> bool {
    let middle = [0, 1].map(|k| 0.5 * (a.uv[k] + b.uv[k]));
    length(&sub(&b.point, &a.point)) > chord && face.f(middle).is_some_and(|f| f.abs() > ASTRAY)
}
