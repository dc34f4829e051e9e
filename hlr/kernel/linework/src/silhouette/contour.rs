//! Finds where the sign of f = N . v changes along the edges of the mesh.
//!
//! ```text
//!        +                       +   crossing of face A      if the two faces at an edge are only nearly tangent,
//!       / \                    - A -+=====+--                they change sign at different places: in between, the
//!      x---x  two crossings        B      crossing of B      edge itself is the fold (=====)
//!     /     \  per triangle
//!    -       -
//! ```

use rayon::prelude::*;
use smallvec::SmallVec;

use super::crossed::grazed_crossing;
use super::face::{Face, Place, mean};
use super::grazing::{Dents, Grazing, dents, grazed};
use super::refine::{outward, rise};
use super::side::{Side, side};
use super::{Model, TIE};
use hlr_brep::geometry::vector::{Vector, cross, dot, length, sub, unit};

/// A change of sign on an edge: on one of its faces, or on both where they are one surface.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    pub triangles: [i32; 2],
    pub place: Place,
}

/// An end of a fold: a crossing (its number), or a vertex of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    Crossing(u32),
    Vertex(u32),
    /// A vertex at which every curve ends: an apex.
    Apex(u32, u32),
    /// Within an edge, at a parameter (its bits).
    Cut(u32, u64),
}

/// A stretch of an edge between a face turned toward the viewer and one turned away.
#[derive(Clone, Copy, Debug)]
pub struct Fold {
    pub ends: [Node; 2],
    pub points: [Vector; 2],
    pub normal: Vector,
    /// The face turned toward the viewer.
    pub face: i32,
    /// The edge of the B-rep, -1 for none.
    pub source: i32,
    pub concave: bool,
    /// As in a `Stretch`.
    pub rise: [f64; 2],
}

/// Edges that one thread looks at in one go: those along borders take much longer, and stand together.
const EDGES_AT_ONCE: usize = 128;

pub struct Contour {
    pub crossings: Vec<Crossing>,
    pub folds: Vec<Fold>,
    pub grazing: Vec<Grazing>,
}

/// f per node of the surfaces; NaN where there is no normal, and on faces that are not traced.
pub fn values(model: &Model) -> Vec<f64> {
    let mut face_of = vec![-1i32; model.uv.len()];
    for (corners, &face) in model.corner.iter().zip(model.triangle_face) {
        let record = &model.faces[face as usize];
        if record.curved && record.surface.is_some() {
            for &c in corners {
                face_of[c as usize] = face;
            }
        }
    }
    (0..model.uv.len())
        .into_par_iter()
        .map(|n| {
            if face_of[n] < 0 {
                return f64::NAN;
            }
            Face::new(model, face_of[n]).and_then(|face| face.f(model.uv[n])).unwrap_or(f64::NAN)
        })
        .collect()
}

pub fn contour(model: &Model, values: &[f64], stopped: &(dyn Fn() -> bool + Sync)) -> Contour {
    let traced = |t: i32| {
        let record = &model.faces[model.triangle_face[t as usize] as usize];
        record.surface.is_some()
    };
    let curved = |t: i32| model.faces[model.triangle_face[t as usize] as usize].curved;
    let around = |e: usize| &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize];
    let sides_of = |e: usize| -> SmallVec<[Side; 2]> {
        let asked = around(e).iter().filter(|&&t| traced(t) && (curved(t) || model.smooth[e]));
        asked.filter_map(|&t| side(model, values, e, t)).collect()
    };
    let bounds = |e: usize| {
        let around = around(e);
        around.iter().any(|&t| traced(t) && curved(t)) && !(around.len() == 2 && same_nodes(model, values, e, around))
    };
    let none = Dents::default();
    let found: Vec<(Contour, Vec<(i32, i32)>)> = (0..model.offsets.len() - 1)
        .into_par_iter()
        .chunks(EDGES_AT_ONCE)
        .map(|edges| {
            let (mut crossings, mut folds, mut grazing) = (Vec::new(), Vec::new(), Vec::new());
            let mut dented = Vec::new();
            if stopped() {
                return (Contour { crossings, folds, grazing }, dented);
            }
            for e in edges {
                let around = around(e);
                if !around.iter().any(|&t| traced(t) && curved(t)) {
                    continue;
                }
                if around.len() == 2 && same_nodes(model, values, e, around) {
                    if keeps_sign(model, values, e, around[0]) {
                        continue;
                    }
                    let Some(side) = side(model, values, e, around[0]) else { continue };
                    if side.changes()
                        && let Some(place) = side.at(side.change())
                    {
                        crossings.push(Crossing { triangles: [around[0], around[1]], place });
                    }
                    continue;
                }
                let sides = sides_of(e);
                dented.extend(dents(model, &sides));
                grazed(model, e, around, &sides, &none, &mut grazing);
                let mut at = [None; 2];
                for (k, side) in sides.iter().enumerate() {
                    if side.changes() && side.face.is_some() {
                        let t = side.change();
                        let Some(place) = side.at(t) else { continue };
                        if k < 2 {
                            at[k] = Some((t, crossings.len() as u32, place));
                        }
                        crossings.push(Crossing { triangles: [side.triangle, -1], place });
                    }
                }
                if model.smooth[e] && around.len() == 2 && sides.len() == 2 {
                    folded(model, e, &sides, at, &mut folds);
                }
            }
            (Contour { crossings, folds, grazing }, dented)
        })
        .collect();
    let mut out = Contour { crossings: Vec::new(), folds: Vec::new(), grazing: Vec::new() };
    let mut dented = Dents::default();
    for (part, dents) in found {
        dented.extend(dents);
        let first = out.crossings.len() as u32;
        out.grazing.extend(part.grazing);
        out.crossings.extend(part.crossings);
        out.folds.extend(part.folds.into_iter().map(|mut fold| {
            for end in &mut fold.ends {
                if let Node::Crossing(c) | Node::Apex(_, c) = end {
                    *c += first;
                }
            }
            fold
        }));
    }
    if !dented.is_empty() {
        // Anew, the chords that end where a triangle beside the border folds over.
        let mut there = vec![false; model.points.len()];
        dented.iter().for_each(|&(_, vertex)| there[vertex as usize] = true);
        let again = |e: &usize| model.edges[*e].iter().any(|&vertex| there[vertex as usize]) && bounds(*e);
        let again: Vec<usize> = (0..model.offsets.len() - 1).filter(again).collect();
        out.grazing.retain(|grazing| again.binary_search(&(grazing.edge as usize)).is_err());
        let anew = again.par_iter().flat_map_iter(|&e| {
            let mut found = Vec::new();
            if !stopped() {
                grazed(model, e, around(e), &sides_of(e), &dented, &mut found);
            }
            found
        });
        out.grazing.par_extend(anew);
        out.grazing.sort_by_key(|grazing| grazing.edge);
    }
    // Intersection lines come last among the edges.
    out.grazing.par_extend(crossings(model, stopped));
    out
}

/// The stretches of intersection lines, by edge.
fn crossings<'a>(
    model: &'a Model,
    stopped: &'a (dyn Fn() -> bool + Sync),
) -> impl ParallelIterator<Item = Grazing> + use<'a> {
    let first = model.edges.len() - model.crossed.len();
    model.crossed.par_iter().enumerate().flat_map_iter(move |(k, &triangles)| {
        let mut found = Vec::new();
        if !stopped() {
            grazed_crossing(model, first + k, triangles, &mut found);
        }
        found
    })
}

/// Whether two triangles of one face share both nodes of an edge, so that they have one crossing. All nodes of a pole
/// count as one: their parameter around the pole has no meaning.
pub(super) fn same_nodes(model: &Model, values: &[f64], e: usize, around: &[i32]) -> bool {
    let (s, t) = (around[0] as usize, around[1] as usize);
    if model.triangle_face[s] != model.triangle_face[t] {
        return false;
    }
    let node = |t: usize, v: i32| {
        let k = model.triangles[t].iter().position(|&c| c == v);
        k.map(|k| model.corner[t][k])
    };
    model.edges[e].iter().all(|&v| match (node(s, v), node(t, v)) {
        (Some(x), Some(y)) => x == y || (values[x as usize].is_nan() && values[y as usize].is_nan()),
        _ => false,
    })
}

/// Whether f has one sign at both ends of an edge within a face; false if an end is at a pole.
fn keeps_sign(model: &Model, values: &[f64], e: usize, t: i32) -> bool {
    let away = |v: i32| {
        let k = model.triangles[t as usize].iter().position(|&c| c == v)?;
        let f = values[model.corner[t as usize][k] as usize];
        (!f.is_nan()).then_some(f >= -TIE)
    };
    let [a, b] = model.edges[e].map(away);
    a.is_some() && a == b
}

/// The stretches of a smooth edge over which its two faces are turned differently.
fn folded(model: &Model, e: usize, sides: &[Side], at: [Option<(f64, u32, Place)>; 2], out: &mut Vec<Fold>) {
    let differ = [0, 1].map(|end| sides[0].away(end) != sides[1].away(end));
    let ends = sides[0].corners.map(|v| (Node::Vertex(v as u32), model.points[v as usize]));
    let mut stops: Vec<(f64, Node, Vector)> =
        at.iter().flatten().map(|(t, c, place)| (*t, Node::Crossing(*c), place.point)).collect();
    stops.sort_by(|x, y| x.0.total_cmp(&y.0));
    if differ[0] {
        stops.insert(0, (0.0, ends[0].0, ends[0].1));
    }
    if differ[1] {
        stops.push((1.0, ends[1].0, ends[1].1));
    }
    for pair in stops.chunks_exact(2) {
        let t = 0.5 * (pair[0].0 + pair[1].0);
        // The front side over this stretch.
        let f = [0, 1].map(|k| sides[k].f[0] + (sides[k].f[1] - sides[k].f[0]) * t);
        let front = usize::from(f[1] < f[0]);
        let triangles = [sides[0].triangle, sides[1].triangle];
        let (normal, concave) = match turned_over(model, sides) {
            Some(k) => (sides[1 - k].normal, false),
            None => (mean(&sides[0].normal, &sides[1].normal), concave(model, e, sides, t)),
        };
        out.push(Fold {
            ends: [pair[0].1, pair[1].1],
            points: [pair[0].2, pair[1].2],
            normal,
            rise: [pair[0].2, pair[1].2].map(|p| rise(model, &triangles, &p, &outward(&normal, concave))),
            face: sides[front].number,
            // A seam is no edge of the surface: the outline continues beside it.
            source: if sides[0].number == sides[1].number { -1 } else { model.source[e] },
            concave,
        });
    }
}

/// Which of two sides with opposite normals is the one whose surface turns over in its last bit before the edge, as some
/// files have it: the one whose normal is less that of its triangle. How it bends there has no meaning.
fn turned_over(model: &Model, sides: &[Side]) -> Option<usize> {
    if dot(&sides[0].normal, &sides[1].normal) > 0.0 {
        return None;
    }
    let agrees = |side: &Side| {
        let [p, q, r] = model.triangles[side.triangle as usize].map(|v| model.points[v as usize]);
        let normal = cross(&sub(&q, &p), &sub(&r, &p));
        dot(&normal, &side.normal) / length(&normal)
    };
    Some(usize::from(agrees(&sides[1]) < agrees(&sides[0])))
}

/// Whether the surfaces beside a fold bend toward their normals along the line of sight: judged on a curved side, or,
/// if both are flat, between the two.
fn concave(model: &Model, e: usize, sides: &[Side], t: f64) -> bool {
    let bend: f64 = sides
        .iter()
        .filter_map(|side| {
            let uv = [0, 1].map(|k| side.uv[0][k] + (side.uv[1][k] - side.uv[0][k]) * t);
            side.face.as_ref().map(|face| face.radial(uv) * model.chord)
        })
        .sum();
    if bend.abs() > 1e-9 {
        return bend < 0.0;
    }
    // Across the edge, from one triangle to the other.
    let [a, b] = model.edges[e].map(|v| model.points[v as usize]);
    let apex = |k: usize| {
        let corners = model.triangles[sides[k].triangle as usize];
        let third = corners.iter().find(|c| !sides[k].corners.contains(c));
        third.map_or(a, |&c| model.points[c as usize])
    };
    let Some(line) = unit(&sub(&b, &a)) else { return false };
    let out = cross(&line, &cross(&sub(&apex(1), &a), &line));
    let size = length(&out);
    size > 0.0 && dot(&sides[0].normal, &out) > 1e-9 * size
}
