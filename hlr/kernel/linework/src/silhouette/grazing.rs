//! Borders of faces that are seen nearly edge-on: divided where a face turns over, each stretch visible or hidden by
//! its own faces.
//!
//! At an edge of a closed body its two faces decide whether they hide it: a convex edge is visible where one face is
//! turned toward the viewer, a concave edge only where both are.
//!
//! ```text
//!        \   /  sight                  sight \    /
//!      ___\ v                                 v  |
//!     front|  back: seen                 front ___|  back: hidden
//! ```

use rustc_hash::FxHashSet;
use smallvec::{SmallVec, smallvec};

use super::face::{Face, root};
use super::refine::rise;
use super::side::Side;
use super::{Model, TIE};
use hlr_accuracy::OUTLINE_FLAT;
use hlr_brep::geometry::vector::{Vector, along, cross, dot, length, sub, unit};
use hlr_visibility::scan::stretches::Beside;

/// A stretch of the border of a face that is seen nearly edge-on there: the part of an edge between two parameters at
/// which a face of this edge turns over.
#[derive(Clone, Copy, Debug)]
pub struct Grazing {
    pub edge: u32,
    pub range: [f64; 2],
    pub face: i32,
    /// The face's outward unit normals at both ends, and whether its outer side is seen.
    pub normals: [Vector; 2],
    pub front: bool,
    pub beside: Beside,
    /// The face is turned toward the viewer, but its triangle here is not, because the chord cuts off a bend.
    pub dented: bool,
    /// The rise at both ends, as in a `Stretch`, for the first face that turns over along this edge; None for others.
    pub rise: Option<[f64; 2]>,
    /// Of an intersection line, the two triangles that cross there.
    pub crossed: Option<[i32; 2]>,
}

/// |N . v|: triangles of a face seen at more than this do not hide its own border through their deflection.
const GRAZE: f64 = 0.3;

/// Change of N . v over half of a chord beyond which the face is also asked between the ends and the middle.
const SWING: f64 = 0.1;

/// |N . v|: a face or triangle seen at less is parallel to the line of sight; rounding would decide what it hides.
pub(super) const WALL: f64 = 1e-6;

/// Area as a share of the square of the longer side: the normal of a triangle with less is not reliable.
const NEEDLE: f64 = 1e-9;

/// Sine of the angle between two faces that lie on one another; rounding would decide which is above the other.
const CUSP: f64 = 1e-5;

/// Samples along an edge at which the direction of its faces is evaluated. A straight border of a twisted face is a
/// single chord, however often the face turns over along it.
const ASKED: usize = 8;

/// A little less than half a turn of a cylinder, radians.
const HALF_TURN: f64 = 3.0;

/// Faces and vertices of their borders at which a triangle beside the border folds over (`dented`). It may lie in front
/// of the next chord of the border as well.
pub type Dents = FxHashSet<(i32, i32)>;

/// The ends of the edge at those faces whose triangle beside it folds over.
pub fn dents<'a>(model: &'a Model, sides: &'a [Side]) -> impl Iterator<Item = (i32, i32)> + 'a {
    let folded = sides.iter().filter(|side| side.face.is_some() && dented(model, side));
    folded.flat_map(|side| side.corners.map(|vertex| (side.number, vertex)))
}

pub fn grazed(model: &Model, e: usize, around: &[i32], sides: &[Side], dents: &Dents, out: &mut Vec<Grazing>) {
    let dented =
        |side: &Side| dented(model, side) || side.corners.iter().any(|&vertex| dents.contains(&(side.number, vertex)));
    let grazes = |side: &&Side| side.face.is_some() && (seen_edge_on(model, side) || dented(side));
    let found: SmallVec<[(&Side, Turns); 2]> = sides.iter().filter(grazes).map(|side| (side, turns(side))).collect();
    let off_border = |side: &Side| beyond(model, e, side.triangle);
    let turning = found.iter().position(|(_, turns)| turns.len() > 1);
    for (at, side, stretch) in divided(e, &found, |t| beside(model, e, around, sides, t), off_border) {
        let rise = (turning == Some(at)).then(|| {
            [0, 1].map(|k| rise(model, &[side.triangle], &on_edge(model, e, stretch.range[k]), &stretch.normals[k]))
        });
        out.push(Grazing { rise, dented: dented(side), ..stretch });
    }
}

/// The stretches of edge e at faces that turn over along it, in ascending order: each with the index of its face in
/// `found`. beside: what the faces hide at one parameter. off_border: f of a face beside the edge, asked where the face
/// is parallel to the line of sight along it.
pub(super) fn divided<'s>(
    e: usize,
    found: &[(&'s Side<'s>, Turns)],
    beside: impl Fn(f64) -> Beside,
    off_border: impl Fn(&Side) -> Option<f64>,
) -> SmallVec<[(usize, &'s Side<'s>, Grazing); 4]> {
    let mut out = SmallVec::new();
    let mut stops: SmallVec<[f64; 6]> = found.iter().flat_map(|(_, turns)| turns.iter().map(|turn| turn.0)).collect();
    if stops.is_empty() {
        return out;
    }
    stops.extend([0.0, 1.0]);
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    for range in stops.windows(2) {
        let range = [range[0], range[1]];
        let beside = beside(0.5 * (range[0] + range[1]));
        for (at, (side, turns)) in found.iter().enumerate() {
            let Some(f) = turns.iter().rev().find(|turn| turn.0 <= range[0]).map(|turn| turn.1) else { continue };
            let f = if f == 0.0 { off_border(side).unwrap_or(f) } else { f };
            if f.abs() <= TIE {
                continue;
            }
            let normals = range.map(|t| side.normal_at(t));
            let (edge, face, front) = (e as u32, side.number, f < 0.0);
            let stretch =
                Grazing { edge, range, face, normals, front, beside, dented: false, rise: None, crossed: None };
            out.push((at, *side, stretch));
        }
    }
    out
}

/// Whether the face is seen nearly edge-on, or turns over, anywhere along its border. The ends alone do not tell: along
/// a straight border of a twisted face, a single chord, it may turn over from end to end.
pub(super) fn seen_edge_on(model: &Model, side: &Side) -> bool {
    let edge_on = |f: &[f64]| f.iter().any(|f| f.abs() < GRAZE) || f.iter().any(|g| g.signum() != f[0].signum());
    let [a, b] = side.corners.map(|v| model.points[v as usize]);
    let middle = dot(&side.normal, &model.sight(&along(&a, &sub(&b, &a), 0.5)));
    let f = [side.f[0], middle, side.f[1]];
    let swings = f.windows(2).any(|w| (w[0] - w[1]).abs() > SWING);
    edge_on(&f) || (swings && !follows_cosine(side) && edge_on(&asked(side).map(|(_, f)| f)))
}

/// Whether the ends alone tell that a face turns over nowhere between them, and how nearly it is seen edge-on.
fn follows_cosine(side: &Side) -> bool {
    side.face.as_ref().is_some_and(Face::is_cosine) && (side.uv[1][0] - side.uv[0][0]).abs() < HALF_TURN
}

fn dented(model: &Model, side: &Side) -> bool {
    // A face parallel to the line of sight is not turned toward the viewer.
    if side.f.iter().any(|&f| f > TIE) || side.f.iter().all(|&f| f >= -TIE) {
        return false;
    }
    let [p, q, r] = model.triangles[side.triangle as usize].map(|v| model.points[v as usize]);
    let normal = cross(&sub(&q, &p), &sub(&r, &p));
    let longest = [sub(&q, &p), sub(&r, &p), sub(&r, &q)].iter().map(length).fold(0.0, f64::max);
    // What is hardly high may be turned over by rounding.
    length(&normal) <= OUTLINE_FLAT * model.chord * longest || dot(&normal, &model.sight(&p)) >= -WALL * length(&normal)
}

fn on_edge(model: &Model, e: usize, t: f64) -> Vector {
    let [a, b] = model.edges[e].map(|v| model.points[v as usize]);
    along(&a, &sub(&b, &a), t)
}

/// Outward unit normal of the planar face of a triangle; None where its plane is not known and the triangle is a
/// needle.
pub(super) fn plane_normal(model: &Model, triangle: i32) -> Option<Vector> {
    let t = triangle as usize;
    let of_face = |face: Face| face.normal(model.uv[model.corner[t][0] as usize]);
    Face::new(model, model.triangle_face[t]).and_then(of_face).or_else(|| {
        let [p, q, r] = model.triangles[t].map(|v| model.points[v as usize]);
        let (a, b) = (sub(&q, &p), sub(&r, &p));
        let normal = cross(&a, &b);
        let size = dot(&a, &a).max(dot(&b, &b));
        if length(&normal) > NEEDLE * size { unit(&normal) } else { None }
    })
}

/// Whether the two faces of an edge hide it at one parameter, if the body is closed.
fn beside(model: &Model, e: usize, around: &[i32], sides: &[Side], t: f64) -> Beside {
    let &[s, u] = around else { return Beside::Unknown };
    let sight = model.sight(&on_edge(model, e, t));
    let normal = |triangle: i32| match sides.iter().find(|side| side.triangle == triangle) {
        Some(side) => Some(side.normal_at(t)),
        None if model.faces[model.triangle_face[triangle as usize] as usize].curved => None,
        // The normal of the plane itself: a triangle whose corners are nearly in one line may have any normal.
        None => plane_normal(model, triangle),
    };
    let (Some(m), Some(n)) = (normal(s), normal(u)) else { return Beside::Unknown };
    let corners = model.triangles[s as usize];
    let forward = (0..3).any(|k| [corners[k], corners[(k + 1) % 3]] == model.edges[e]);
    let [a, b] = model.edges[e].map(|v| model.points[v as usize]);
    let way = if forward { sub(&b, &a) } else { sub(&a, &b) };
    let concave = !model.smooth[e] && is_concave(model, e, [s, u], [&m, &n], &way);
    let f = [(s, dot(&m, &sight)), (u, dot(&n, &sight))];
    let f = f.map(|(triangle, f)| if f.abs() > WALL { f } else { beyond(model, e, triangle).unwrap_or(f) });
    let (front, back) = (f.iter().filter(|f| **f < -WALL).count(), f.iter().filter(|f| **f > WALL).count());
    match concave {
        false if front > 0 => Beside::Visible,
        false if back == 2 => Beside::Hidden,
        true if back > 0 => Beside::Hidden,
        true if front == 2 => Beside::Visible,
        _ => Beside::Unknown,
    }
}

/// Whether the material at an edge takes up more than half of a turn. way: the edge in the sense of the first triangle.
fn is_concave(model: &Model, e: usize, triangles: [i32; 2], [m, n]: [&Vector; 2], way: &Vector) -> bool {
    let turn = cross(m, n);
    if length(&turn) > CUSP || dot(m, n) > 0.0 {
        return dot(&turn, way) < 0.0;
    }
    // The faces lie on one another where they meet, and one bends away from the other. The outer normal of the first
    // points up: a second face above it leaves a slot between them, one below it the thin end of a body.
    let a = model.points[model.edges[e][0] as usize];
    let height = triangles.map(|triangle| {
        let corner = model.triangles[triangle as usize].into_iter().find(|v| !model.edges[e].contains(v));
        let off = corner.map_or([0.0; 3], |v| sub(&model.points[v as usize], &a));
        let across = cross(&off, way);
        // A surface bends away by the square of the distance from the edge.
        dot(&off, m) / dot(&across, &across)
    });
    height[0] < height[1]
}

/// f of a face off its border: at the corner of its triangle that is not on the edge. A face that is edge-on along its
/// border may be turned toward the viewer beside it, as half a ball is from above.
fn beyond(model: &Model, e: usize, triangle: i32) -> Option<f64> {
    let t = triangle as usize;
    let k = model.triangles[t].iter().position(|corner| !model.edges[e].contains(corner))?;
    Face::new(model, model.triangle_face[t])?.f(model.uv[model.corner[t][k] as usize])
}

/// f along an edge, at parameters from 0 to 1; 0 where there is no normal.
fn asked(side: &Side) -> [(f64, f64); ASKED + 1] {
    std::array::from_fn(|k| {
        let t = k as f64 / ASKED as f64;
        match k {
            0 => (t, side.f[0]),
            ASKED => (t, side.f[1]),
            _ => (t, side.face.as_ref().and_then(|face| face.f(uv_at(side, t))).unwrap_or(0.0)),
        }
    })
}

fn uv_at(side: &Side, t: f64) -> [f64; 2] {
    [0, 1].map(|k| side.uv[0][k] + (side.uv[1][k] - side.uv[0][k]) * t)
}

/// Parameters (from 0) at which a face turns over along its edge, each with the sign of f from there on. The sign is 0
/// where the face is parallel to the line of sight.
pub(super) type Turns = SmallVec<[(f64, f64); 2]>;

/// Where a face turns over along its edge.
pub(super) fn turns(side: &Side) -> Turns {
    let Some(face) = &side.face else { return Turns::new() };
    let [first, last] = side.f.map(sign);
    if first == last && first != 0.0 && follows_cosine(side) { smallvec![(0.0, first)] } else { searched(side, face) }
}

/// 0 where a face is parallel to the line of sight.
fn sign(f: f64) -> f64 {
    if f.abs() <= TIE { 0.0 } else { f.signum() }
}

/// `turns`, found by asking at places along the edge.
fn searched(side: &Side, face: &Face) -> Turns {
    let uv = |t: f64| uv_at(side, t);
    let mut asked: SmallVec<[(f64, f64); ASKED + 1]> = asked(side).into();
    asked.retain(|(_, f)| sign(*f) != 0.0);
    let Some(&(_, first)) = asked.first() else { return smallvec![(0.0, 0.0)] };
    let mut out: Turns = smallvec![(0.0, sign(first))];
    for pair in asked.windows(2) {
        let [(s, f), (t, g)] = [pair[0], pair[1]];
        if sign(f) != sign(g) {
            let at = if side.changes() && asked.iter().filter(|a| sign(a.1) != sign(first)).all(|a| a.0 >= t) {
                // The outline's own end.
                side.change()
            } else {
                s + (t - s) * root(face, uv(s), uv(t), f, g)
            };
            out.push((at.clamp(s, t), sign(g)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::FaceRecord;
    use super::*;
    use crate::lines::View;
    use hlr_brep::geometry::surface::Surface;

    /// Along a cylinder the ends of a chord tell what asking in between does.
    #[test]
    fn a_cylinder_turns_over_where_the_ends_of_a_chord_say_so() {
        let surfaces = [Surface::read(2, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0])];
        let record = FaceRecord {
            surface: Some(0),
            place: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
            sign: 1.0,
            curved: true,
        };
        let mut model = nothing(&surfaces, record);
        model.view.away = [0.0, 0.8, 0.6];
        let face = || Face::new(&model, 0).expect("a face");
        let (mut kept, mut turned) = (0, 0);
        for k in 0..4000 {
            let from = f64::from(k) * 0.01;
            let uv = [[from, 0.0], [from + f64::from(k % 29) * 0.1, f64::from(k % 7)]];
            let f = uv.map(|uv| face().f(uv).expect("a normal"));
            let side =
                Side { triangle: 0, number: 0, corners: [0, 1], uv, f, face: Some(face()), normal: [0.0, 0.0, 1.0] };
            let (found, wanted) = (turns(&side), searched(&side, &face()));
            assert_eq!(found, wanted, "{uv:?} {f:?}");
            *(if found.len() > 1 { &mut turned } else { &mut kept }) += 1;
            let least = asked(&side).iter().fold(f64::INFINITY, |least, (_, f)| least.min(f.abs()));
            let ends = f[0].abs().min(f[1].abs());
            assert!(found.len() > 1 || least >= ends - 1e-12, "{uv:?} {least} {ends}");
        }
        assert!(kept > 1000 && turned > 1000, "{kept} {turned}");
    }

    /// No mesh, and one face.
    fn nothing(surfaces: &[Option<Surface>], face: FaceRecord) -> Model<'_> {
        Model {
            points: &[],
            triangles: &[],
            triangle_face: &[],
            edges: &[],
            offsets: &[0],
            incident: &[],
            crossed: &[],
            smooth: &[],
            source: &[],
            corner: &[],
            uv: &[],
            faces: vec![face],
            surfaces,
            view: View { origin: [0.0; 3], away: [0.0, 1.0, 0.0], perspective: false },
            chord: 0.01,
        }
    }

    /// Corners of a planar face on one border line, off it by rounding: the needle between them may have any normal.
    #[test]
    fn a_needle_has_the_normal_of_its_plane() {
        let points =
            [[-70.0, -0.100000000043331, 0.0], [-93.0, -0.1, 1e-13], [-87.0, -0.1, 1e-13], [-80.0, -0.1, -60.0]];
        let plane = Surface::read(1, &[0.0, -0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0]);
        let surfaces = [plane];
        let face = |surface| FaceRecord {
            surface,
            place: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
            sign: 1.0,
            curved: false,
        };
        let model = |surface| Model {
            points: &points,
            triangles: &[[0, 1, 2], [0, 1, 3]],
            triangle_face: &[0, 0],
            corner: &[[0, 1, 2], [0, 1, 3]],
            uv: &[[0.0; 2]; 4],
            ..nothing(&surfaces, face(surface))
        };
        assert_eq!(plane_normal(&model(Some(0)), 0), Some([0.0, 1.0, 0.0]));
        assert_eq!(plane_normal(&model(None), 0), None);
        assert!(plane_normal(&model(None), 1).is_some_and(|n| n[1].abs() > 0.999));
    }
}
