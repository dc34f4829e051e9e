//! Adds points on the surface between two crossings of one triangle, and finds cusps.

use super::Model;
use super::face::{Face, Place, middle};
use hlr_accuracy::OUTLINE_VALLEY;
use hlr_brep::geometry::vector::{Vector, dot, from_line, length, sub};

/// A stretch of a silhouette over one face between two points of it.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    pub from: Vector,
    pub to: Vector,
    pub normals: [Vector; 2],
    /// Parameters of both ends on the face's surface; None where they are not known.
    pub uv: [Option<[f64; 2]>; 2],
    /// The edge of the B-rep along which it runs, -1 for none.
    pub source: i32,
    /// The surface bends toward its normal along the line of sight: a body hides this by itself.
    pub concave: bool,
    /// How far triangles here stand out beyond the surface's tangent plane at both ends.
    pub rise: [f64; 2],
    /// Of a concave stretch that nothing before it hides within the tolerance: the rise as if it were not concave.
    pub shallow: Option<[f64; 2]>,
}

impl Stretch {
    pub fn turn_round(&mut self) {
        (self.from, self.to) = (self.to, self.from);
        self.normals.reverse();
        self.uv.reverse();
        self.rise.reverse();
        self.shallow = self.shallow.map(|[a, b]| [b, a]);
    }
}

/// The direction away from the facets at a silhouette: the normal, or its opposite where the surface is concave.
pub fn outward(normal: &Vector, concave: bool) -> Vector {
    if concave { normal.map(|x| -x) } else { *normal }
}

/// How far (model units) the corners of triangles stand out beyond the plane through a point with a given unit normal.
/// Corners lie on the surface, so this is 0 where it is convex, and at most a chord's bulge where it is a saddle.
pub fn rise(model: &Model, triangles: &[i32], point: &Vector, normal: &Vector) -> f64 {
    let corners = triangles.iter().filter(|&&t| t >= 0).flat_map(|&t| model.triangles[t as usize]);
    corners.map(|v| dot(&sub(&model.points[v as usize], point), normal)).fold(0.0, f64::max)
}

const DEEPEST: u32 = 6;
/// Curvature along the line of sight times the chord tolerance: a surface with less is straight.
pub const STRAIGHT: f64 = 1e-9;

/// |N . v| in the middle of a stretch: with more, the stretch can only be a short cut from one curve to another.
const ASTRAY: f64 = 0.3;

/// The stretches between two crossings of one triangle. Empty if the triangle is so large that two different curves,
/// which both leave the face, cross it.
pub fn stretches(model: &Model, triangle: i32, face: &Face, from: Place, to: Place) -> Vec<Stretch> {
    let chord = model.chord;
    let mut places = vec![from];
    divide(face, &from, &to, chord, 0, &mut places);
    places.push(to);
    if places.len() == 2 && astray(face, &from, &to, chord) {
        return Vec::new();
    }
    let bend = bends(face, &places, chord);
    let piece = |a: &Place, b: &Place, concave: bool| {
        let rise = |concave| [a, b].map(|at| rise(model, &[triangle], &at.point, &outward(&at.normal, concave)));
        let deeper = || if face.radial(a.uv) < face.radial(b.uv) { a } else { b };
        let ridge = if concave && face.has_wrinkles() { ridge(face, deeper(), chord) } else { None };
        Stretch {
            from: a.point,
            to: b.point,
            normals: [a.normal, b.normal],
            uv: [a, b].map(|at| Some(at.uv)),
            source: -1,
            concave,
            rise: rise(concave),
            shallow: ridge.map(|ridge| rise(false).map(|corners| corners.max(ridge))),
        }
    };
    let mut out = Vec::with_capacity(places.len());
    for k in 1..places.len() {
        let (a, b) = (&places[k - 1], &places[k]);
        let (x, y) = (bend[k - 1], bend[k]);
        let clear = x.abs() > STRAIGHT && y.abs() > STRAIGHT;
        if clear && (x < 0.0) != (y < 0.0) {
            let c = cusp(face, a, b, x < 0.0);
            out.push(piece(a, &c, x < 0.0));
            out.push(piece(&c, b, y < 0.0));
        } else {
            out.push(piece(a, b, x.min(y) < -STRAIGHT));
        }
    }
    out
}

/// At each place the curvature along the sight, times the chord tolerance.
fn bends(face: &Face, places: &[Place], chord: f64) -> Vec<f64> {
    let bend = |p: &Place| face.radial(p.uv) * chord;
    if !face.is_sphere() {
        return places.iter().map(bend).collect();
    }
    // All over a sphere it is the same, but a pole does not tell.
    let [a, b] = [&places[0], &places[places.len() - 1]].map(bend);
    vec![if a.abs() > b.abs() { a } else { b }; places.len()]
}

/// Steps in which a valley is crossed.
const ACROSS: u32 = 16;

/// How far the surface rises beyond a place at which it bends toward its normal, before it as seen by the viewer; None
/// where that is more than the tolerance. A surface seen edge-on over a long way has valleys and ridges that nobody sees:
/// there all is outline.
///
/// ```text
///      viewer >- - - - - - - -.-.- - -     the ridge . hides the bottom of the valley v only if it is high
///                        ___.'   `.v__
/// ```
fn ridge(face: &Face, place: &Place, chord: f64) -> Option<f64> {
    let most = OUTLINE_VALLEY * chord;
    let bend = face.radial(place.uv).abs();
    if bend <= 0.0 {
        return None;
    }
    let step = (2.0 * most / bend).sqrt() * 2.0 / f64::from(ACROSS);
    let (mut uv, mut high) = (place.uv, 0.0f64);
    for _ in 0..ACROSS {
        let way = face.along_sight(uv)?;
        uv = [0, 1].map(|k| uv[k] - step * way[k]);
        let (f, point) = (face.f(uv)?, face.point(uv));
        high = high.max(dot(&sub(&point, &place.point), &place.normal));
        if high > most || !f.is_finite() {
            return None;
        }
        if f < 0.0 {
            return Some(high);
        }
    }
    None
}

fn divide(face: &Face, a: &Place, b: &Place, chord: f64, depth: u32, out: &mut Vec<Place>) {
    if depth == DEEPEST || length(&sub(&b.point, &a.point)) < chord {
        return;
    }
    if face.sagitta(a, b).is_some_and(|rise| rise <= chord) {
        return;
    }
    let Some(middle) = middle(face, a, b) else { return };
    // The sagitta alone may be 0 by chance where the curve bends back and forth, so the normals are compared, too.
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
        let Some(middle) = middle(face, &low, &high) else { break };
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
