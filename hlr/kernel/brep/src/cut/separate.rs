//! Divides what is left of a body into pieces that hang together. A cavity stays with the piece around it.

use rustc_hash::FxHashMap;

use super::divided_body::{DividedBody, Left};
use super::enclosed::Enclosed;
use crate::body::Body;
use crate::bounds::{Box3, EMPTY};
use crate::geometry::vector::{dot, sub};
use crate::sets::Sets;

/// The pieces of a body, in the order of their first faces.
///
/// # Errors
/// A cavity has no piece around it.
pub fn separate(body: Body, divided: &DividedBody) -> Result<Vec<Body>, &'static str> {
    let piece_of = pieces(&body);
    let count = piece_of.iter().max().map_or(0, |last| last + 1);
    if count == 1 {
        return Ok(vec![with_faces(&body, &vec![0; body.faces.len()], 0)]);
    }
    let volumes: Vec<f64> = (0..count).map(|piece| whole_volume(&body, &piece_of, piece, divided)).collect();
    let boxes: Vec<Box3> = (0..count).map(|piece| around(&body, &piece_of, piece)).collect();
    let mut home: Vec<usize> = (0..count).collect();
    for piece in 0..count {
        if volumes[piece] < 0.0 {
            let around = (0..count).filter(|&k| volumes[k] >= 0.0 && holds(&boxes[k], &boxes[piece]));
            let least = around.min_by(|&a, &b| diagonal(&boxes[a]).total_cmp(&diagonal(&boxes[b])));
            home[piece] = least.ok_or("it is turned inside out")?;
        }
    }
    let of: Vec<usize> = piece_of.iter().map(|&piece| home[piece]).collect();
    Ok((0..count).filter(|&k| home[k] == k).map(|k| with_faces(&body, &of, k)).collect())
}

/// For each face the number of the piece that it belongs to: faces that share an edge belong together.
fn pieces(body: &Body) -> Vec<usize> {
    let mut sets = Sets::new(body.faces.len());
    let mut first: Vec<Option<usize>> = vec![None; body.edges.len()];
    for (i, own) in body.faces.iter().enumerate() {
        for used in own.face.wires.iter().flatten() {
            let other = *first[used.edge as usize].get_or_insert(i);
            sets.unite(i, other);
        }
    }
    let mut numbers: FxHashMap<usize, usize> = FxHashMap::default();
    (0..body.faces.len())
        .map(|i| {
            let next = numbers.len();
            *numbers.entry(sets.first(i)).or_insert(next)
        })
        .collect()
}

/// Six times the volume of a piece whose faces were not cut; 0 for one with faces that were.
fn whole_volume(body: &Body, piece_of: &[usize], piece: usize, divided: &DividedBody) -> f64 {
    let mut sum = Enclosed::seen_from(divided.vertices.first().copied().unwrap_or_default());
    for (own, _) in body.faces.iter().zip(piece_of).filter(|(_, of)| **of == piece) {
        let whole = own.of.filter(|&of| matches!(divided.left[of as usize], Left::Whole));
        let Some(of) = whole else { return 0.0 };
        sum.add(&divided.coarse.faces[of as usize], own.reversed);
    }
    sum.volume
}

fn around(body: &Body, piece_of: &[usize], piece: usize) -> Box3 {
    let [mut low, mut high] = EMPTY;
    for (own, _) in body.faces.iter().zip(piece_of).filter(|(_, of)| **of == piece) {
        for used in own.face.wires.iter().flatten() {
            let edge = &body.edges[used.edge as usize];
            let middle = edge.curve.as_ref().map(|curve| curve.point(0.5 * (edge.range[0] + edge.range[1])));
            for p in edge.end_points.iter().flatten().chain(&middle) {
                for k in 0..3 {
                    (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
                }
            }
        }
    }
    [low, high]
}

fn holds(outer: &Box3, inner: &Box3) -> bool {
    (0..3).all(|k| outer[0][k] <= inner[0][k] && inner[1][k] <= outer[1][k])
}

fn diagonal(of: &Box3) -> f64 {
    let d = sub(&of[1], &of[0]);
    dot(&d, &d)
}

/// The faces of one piece, with their edges and curves.
fn with_faces(body: &Body, of: &[usize], piece: usize) -> Body {
    let mut out = Body { solids: 1, ..Body::default() };
    let mut edges: FxHashMap<u32, u32> = FxHashMap::default();
    let mut curves: FxHashMap<usize, usize> = FxHashMap::default();
    for (own, _) in body.faces.iter().zip(of).filter(|(_, of)| **of == piece) {
        let mut face = own.clone();
        for used in face.face.wires.iter_mut().flatten() {
            let next = out.edges.len() as u32;
            let number = *edges.entry(used.edge).or_insert(next);
            if number == next {
                out.edges.push(body.edges[used.edge as usize].clone());
            }
            used.edge = number;
            used.curve2 = used.curve2.map(|(curve, range)| {
                let next = out.curves2.len();
                let number = *curves.entry(curve).or_insert(next);
                if number == next {
                    out.curves2.push(body.curves2[curve].clone());
                }
                (number, range)
            });
        }
        out.faces.push(face);
    }
    // An edge without a curve in space has one in (u, v), which no use may have named.
    for edge in &mut out.edges {
        if let Some((curve, _)) = edge.only_on.as_deref_mut() {
            out.curves2.push(body.curves2[*curve].clone());
            *curve = out.curves2.len() - 1;
        }
    }
    out
}
