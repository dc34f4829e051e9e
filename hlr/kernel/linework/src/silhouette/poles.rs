//! Poles of the parameters and apexes of cones: the normal turns there with a parameter that has no length.

use rustc_hash::FxHashSet;

use super::Model;
use super::contour::{Crossing, Fold, Node};
use super::face::Face;
use super::link::Link;
use super::refine::{outward, rise};
use hlr_brep::geometry::vector::{dot, length, sub};

/// Cosine of the turn up to which two curves are one.
const ON: f64 = 0.95;

/// Of the three crossings of a triangle at a pole, two are close to it: the silhouette from the third runs into them. Over
/// the pole, f changes its sign with a parameter that has hardly any length there.
pub fn into_pole(crossings: &[Crossing], three: [u32; 3], gap: f64) -> Option<[[u32; 2]; 2]> {
    let apart = |a: usize, b: usize| {
        let [p, q] = [a, b].map(|k| crossings[three[k] as usize].place.point);
        length(&sub(&p, &q))
    };
    let between_others = |k: usize| apart((k + 1) % 3, (k + 2) % 3);
    let far = (0..3).min_by(|&a, &b| between_others(a).total_cmp(&between_others(b)))?;
    let (mut near, mut beyond) = ((far + 1) % 3, (far + 2) % 3);
    if apart(far, beyond) < apart(far, near) {
        (near, beyond) = (beyond, near);
    }
    (between_others(far) <= gap).then(|| [[three[far], three[near]], [three[near], three[beyond]]])
}

/// At an apex the normal turns with a parameter that has no length: along both sides of a triangle there, f keeps its
/// sign, and the silhouette that enters over the third runs into the apex.
pub fn into_apex(model: &Model, values: &[f64], t: i32, c: u32, crossing: &Crossing) -> Option<Fold> {
    let nodes = &model.corner[t as usize];
    let k = nodes.iter().position(|&n| values[n as usize].is_nan())?;
    let vertex = model.triangles[t as usize][k];
    let number = model.triangle_face[t as usize];
    let face = Face::new(model, number)?;
    let concave = face.radial(crossing.place.uv) * model.chord < -1e-9;
    let away = outward(&crossing.place.normal, concave);
    Some(Fold {
        ends: [Node::Crossing(c), Node::Apex(vertex as u32, c)],
        points: [crossing.place.point, model.points[vertex as usize]],
        normal: crossing.place.normal,
        face: number,
        source: -1,
        concave,
        rise: [crossing.place.point, model.points[vertex as usize]].map(|p| rise(model, &[t], &p, &away)),
    })
}

/// Joins two curves that run into one apex and continue each other there: it is only a pole of the parameters.
pub fn through_poles(links: &mut [Link]) {
    let poles: FxHashSet<u32> = links
        .iter()
        .flat_map(|link| link.ends)
        .filter_map(|end| if let Node::Apex(vertex, _) = end { Some(vertex) } else { None })
        .collect();
    let mut ends: Vec<(u32, usize, usize)> = Vec::new();
    for (i, link) in links.iter().enumerate() {
        for k in 0..2 {
            match link.ends[k] {
                Node::Apex(vertex, _) => ends.push((vertex, i, k)),
                Node::Vertex(vertex) if poles.contains(&vertex) => ends.push((vertex, i, k)),
                _ => {}
            }
        }
    }
    ends.sort_unstable();
    for pair in ends.chunk_by(|a, b| a.0 == b.0) {
        let [(vertex, i, k), (_, j, l)] = *pair else { continue };
        let away = |link: &Link, k: usize| {
            let s = &link.stretches[if k == 0 { 0 } else { link.stretches.len() - 1 }];
            if k == 0 { sub(&s.to, &s.from) } else { sub(&s.from, &s.to) }
        };
        let (a, b) = (away(&links[i], k), away(&links[j], l));
        if i != j && links[i].face == links[j].face && dot(&a, &b) < -ON * length(&a) * length(&b) {
            links[i].ends[k] = Node::Vertex(vertex);
            links[j].ends[l] = Node::Vertex(vertex);
        }
    }
}
