//! Wrinkles: strips and spots of a face that turn over and back without rising above the tolerance.
//!
//! Spline surfaces have them at their knots, where one patch dips slightly below the next. Wherever a node of the mesh
//! happens to lie in one, N . v changes its sign and changes back, and the drawing would show a row of meaningless
//! dashes. A set of connected nodes with one sign is a wrinkle if, from each of them, the surface turns back within the
//! tolerance. Over a way w along the line of sight it rises by at most the largest |N . v| times w. Next to the rim of
//! the set the mesh tells this; from inner nodes the line of sight is followed on the surface, so that a finer mesh
//! gives the same result.
//!
//! Blends are tangent to their walls only nearly. Where such a wall is seen edge-on, the strip of the blend next to it
//! may face the viewer, and turn away again: a wrinkle, too, for the wall counts as turned away.
//!
//! ```text
//!     +     +     +
//!     x  -  x  -  x        x: the changes of sign next to the nodes in the wrinkle (-)
//!     +     +     +
//! ```

use rayon::prelude::*;

use super::face::{Face, root};
use super::side::side;
use super::{Model, TIE};
use hlr_accuracy::OUTLINE_WRINKLE;
use hlr_brep::geometry::vector::{length, sub};
use hlr_brep::sets::Sets;

/// Two nodes that an edge inside of a face joins.
struct Tie {
    nodes: [u32; 2],
    face: i32,
    /// Whether the face ends there.
    border: bool,
}

/// Replaces the values at nodes in wrinkles by one from around them. Wrinkles that reach the border of their face stay,
/// unless a wall seen edge-on begins there, and those at a pole: how far it rises there the nodes do not tell.
pub fn flatten(model: &Model, values: &mut [f64]) {
    let ties = ties(model, values);
    let away = |n: u32| values[n as usize] >= -TIE;
    let mut patches = Sets::new(values.len());
    for tie in &ties {
        let [a, b] = tie.nodes;
        if away(a) == away(b) {
            patches.unite(a as usize, b as usize);
        }
    }
    let patch: Vec<usize> = (0..values.len()).map(|n| patches.first(n)).collect();
    // A patch that rises above the tolerance anywhere is no wrinkle. Zeros are decided by the rule for ties.
    let walls = beside_walls(model, values);
    let ends = |tie: &Tie, n: usize| tie.border && (away(n as u32) || walls.binary_search(&tie.nodes).is_err());
    let mut wide = vec![false; values.len()];
    let mut rim = vec![false; values.len()];
    for tie in &ties {
        let apart = patch[tie.nodes[0] as usize] != patch[tie.nodes[1] as usize];
        for n in tie.nodes.map(|n| n as usize) {
            wide[patch[n]] |= ends(tie, n) || values[n].abs() <= TIE;
            rim[n] |= apart;
        }
    }
    for n in beside_poles(model, values) {
        wide[patch[n as usize]] = true;
    }
    let mut around = vec![f64::NEG_INFINITY; values.len()];
    for tie in &ties {
        let [a, b] = tie.nodes.map(|n| patch[n as usize]);
        if a == b || (wide[a] && wide[b]) {
            continue;
        }
        let Some(face) = Face::new(model, tie.face) else { continue };
        let uv = tie.nodes.map(|n| model.uv[n as usize]);
        let f = tie.nodes.map(|n| values[n as usize]);
        let t = root(&face, uv[0], uv[1], f[0], f[1]);
        let at = |t: f64| face.point([0, 1].map(|k| uv[0][k] + (uv[1][k] - uv[0][k]) * t));
        let change = at(t);
        for (k, own) in [a, b].into_iter().enumerate() {
            wide[own] |= f[k].abs() * length(&sub(&at(k as f64), &change)) > OUTLINE_WRINKLE * model.chord;
            around[own] = around[own].max(f[1 - k]);
        }
    }
    // A patch without surroundings is no wrinkle. A part without any change of sign needs no test.
    for tie in &ties {
        for n in tie.nodes.map(|n| n as usize) {
            let own = patch[n];
            if rim[n] || wide[own] || !around[own].is_finite() {
                continue;
            }
            rim[n] = true; // asked once
            let turned = Face::new(model, tie.face).is_some_and(|face| turns_back(&face, model, n, values[n]));
            wide[own] = !turned;
        }
    }
    for (n, &p) in patch.iter().enumerate() {
        if !wide[p] && around[p].is_finite() {
            values[n] = around[p];
        }
    }
}

/// Steps of a walk on the surface.
const STEPS: u32 = 16;

/// Whether f changes its sign on the way along the sight, ahead or back, before the surface has risen above the
/// tolerance.
fn turns_back(face: &Face, model: &Model, node: usize, f: f64) -> bool {
    let step = OUTLINE_WRINKLE * model.chord / (f.abs() * f64::from(STEPS));
    [step, -step].into_iter().any(|step| {
        let mut uv = model.uv[node];
        (0..STEPS).any(|_| {
            let Some(way) = face.along_sight(uv) else { return false };
            uv = [0, 1].map(|k| uv[k] + step * way[k]);
            face.f(uv).is_some_and(|here| here.is_finite() && (here > 0.0) != (f > 0.0))
        })
    })
}

/// The pairs of nodes, ascending, between which a face goes on smoothly as a wall that is seen edge-on, and one of which
/// is turned toward the viewer.
fn beside_walls(model: &Model, values: &[f64]) -> Vec<[u32; 2]> {
    let wall_beyond = |e: usize, own: i32, other: i32| -> Option<[u32; 2]> {
        let corners = &model.triangles[own as usize];
        let node = |v: i32| {
            let k = corners.iter().position(|&c| c == v)?;
            let n = model.corner[own as usize][k];
            (n >= 0).then_some(n as u32)
        };
        let [a, b] = model.edges[e].map(node);
        let (a, b) = (a?, b?);
        [a, b].iter().find(|&&n| values[n as usize] < -TIE)?;
        let wall = side(model, values, e, other)?;
        wall.f.iter().all(|f| f.abs() <= TIE).then_some([a.min(b), a.max(b)])
    };
    let mut found: Vec<[u32; 2]> = (0..model.offsets.len() - 1)
        .into_par_iter()
        .filter(|&e| model.smooth[e])
        .flat_map_iter(|e| {
            let around = &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize];
            let ways = match *around {
                [s, t] if model.triangle_face[s as usize] != model.triangle_face[t as usize] => vec![(s, t), (t, s)],
                _ => Vec::new(),
            };
            ways.into_iter().filter_map(move |(own, other)| wall_beyond(e, own, other))
        })
        .collect();
    found.par_sort_unstable();
    found
}

/// Nodes with a value in triangles that have a pole; the values of other triangles say nothing of theirs.
fn beside_poles<'a>(model: &'a Model, values: &'a [f64]) -> impl Iterator<Item = i32> + 'a {
    let traced = |corners: &[i32; 3], face: i32| {
        let record = &model.faces[face as usize];
        record.curved && record.surface.is_some() && corners.iter().any(|&n| n >= 0 && values[n as usize].is_nan())
    };
    let there = model.corner.iter().zip(model.triangle_face).filter(move |&(corners, &face)| traced(corners, face));
    let nodes = there.flat_map(|(corners, _)| corners.iter().copied());
    nodes.filter(|&n| n >= 0 && values[n as usize].is_finite())
}

/// The ties between nodes with a value; NaN is the value of a pole, and of nodes of faces that are not traced.
fn ties(model: &Model, values: &[f64]) -> Vec<Tie> {
    let mut found: Vec<(i32, u32, u32)> = model
        .corner
        .par_iter()
        .zip(model.triangle_face)
        .filter(|&(c, &face)| {
            Face::new(model, face).is_some_and(|face| face.has_wrinkles()) && c.iter().all(|&n| n >= 0)
        })
        .flat_map_iter(|(c, &face)| {
            let sides = [[c[0], c[1]], [c[1], c[2]], [c[2], c[0]]];
            sides.map(|[a, b]| (face, a.min(b) as u32, a.max(b) as u32)).into_iter()
        })
        .filter(|&(_, a, b)| values[a as usize].is_finite() && values[b as usize].is_finite())
        .collect();
    found.par_sort_unstable();
    found
        .chunk_by(|x, y| x == y)
        .map(|same| Tie { nodes: [same[0].1, same[0].2], face: same[0].0, border: same.len() == 1 })
        .collect()
}
