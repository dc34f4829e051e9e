//! Crossings and folds joined into silhouettes.

use std::collections::HashMap;

use rayon::prelude::*;

use super::Model;
use super::contour::{Contour, Crossing, Fold, Node, contour, values};
use super::face::Face;
use super::refine::{Stretch, stretches};
use crate::geometry::vector::{Vector, dot, length, sub};

/// A curve over one face along which the surface curves in one way.
#[derive(Clone, Debug)]
pub struct Silhouette {
    pub face: i32,
    pub concave: bool,
    pub points: Vec<Vector>,
    pub normals: Vec<Vector>,
}

/// All that is found: the curves, and where they meet edges of the model.
pub struct Traced {
    pub silhouettes: Vec<Silhouette>,
    /// (edge, parameter from its first to its second vertex)
    pub meetings: Vec<(i32, f64)>,
    /// As `Contour` says.
    pub dents: Vec<u32>,
}

/// Of the chord tolerance: a fold shorter than this closes a gap that is none.
const GAP: f64 = 0.5;

/// A piece between two nodes: over one triangle, or along an edge.
struct Link {
    ends: [Node; 2],
    face: i32,
    stretches: Vec<Stretch>,
}

pub fn trace(model: &Model, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Traced> {
    let values = values(model);
    if stopped() {
        return None;
    }
    let Contour { crossings, mut folds, dents } = contour(model, &values, stopped);
    let same = Same::new(&crossings, &folds, GAP * model.chord);
    let (across, lone) = over_triangles(&crossings);
    folds.extend(lone.into_iter().filter_map(|(t, c)| into_apex(model, &values, t, c, &crossings[c as usize])));
    let mut links: Vec<Link> = across
        .par_iter()
        .filter_map(|&(t, ends)| {
            if stopped() {
                return None;
            }
            let number = model.triangle_face[t as usize];
            let face = Face::new(model, number)?;
            let [from, to] = ends.map(|c| crossings[c as usize].place);
            let ends = ends.map(Node::Crossing);
            Some(Link { ends, face: number, stretches: stretches(&face, from, to, model.chord) })
        })
        .collect();
    if stopped() {
        return None;
    }
    links.extend(folds.iter().filter(|fold| same.root(fold.ends[0]) != same.root(fold.ends[1])).map(|fold| Link {
        ends: fold.ends,
        face: fold.face,
        stretches: vec![Stretch {
            from: fold.points[0],
            to: fold.points[1],
            normals: [fold.normal; 2],
            concave: fold.concave,
        }],
    }));
    for link in &mut links {
        link.ends = link.ends.map(|end| same.root(end));
    }
    let mut out = Vec::new();
    for walk in walks(&links) {
        parted(&links, &walk, &same, model.chord, &mut out);
    }
    Some(Traced { silhouettes: out, meetings: meetings(model, &crossings), dents })
}

fn meetings(model: &Model, crossings: &[Crossing]) -> Vec<(i32, f64)> {
    crossings
        .iter()
        .filter_map(|c| {
            let e = c.border?;
            let [a, b] = model.edges[e as usize].map(|v| model.points[v as usize]);
            let (way, to) = (sub(&b, &a), sub(&c.place.point, &a));
            let square = dot(&way, &way);
            (square > 0.0).then(|| (e as i32, (dot(&way, &to) / square).clamp(0.0, 1.0)))
        })
        .collect()
}

/// A triangle and its two crossings.
type Crossed = (i32, [u32; 2]);

/// Triangles with their two crossings, and those with one.
fn over_triangles(crossings: &[Crossing]) -> (Vec<Crossed>, Vec<(i32, u32)>) {
    let mut uses: Vec<(i32, u32)> = crossings
        .iter()
        .enumerate()
        .flat_map(|(c, crossing)| crossing.triangles.map(|t| (t, c as u32)))
        .filter(|&(t, _)| t >= 0)
        .collect();
    uses.sort_unstable();
    let (mut pairs, mut lone) = (Vec::new(), Vec::new());
    for run in uses.chunk_by(|a, b| a.0 == b.0) {
        match run {
            [one] => lone.push(*one),
            [one, two] => pairs.push((one.0, [one.1, two.1])),
            _ => {}
        }
    }
    (pairs, lone)
}

/// At an apex the normal turns with a parameter that has no length: along both sides of a triangle there, f keeps its
/// sign, and the silhouette that enters over the third runs into the apex.
fn into_apex(model: &Model, values: &[f64], t: i32, c: u32, crossing: &Crossing) -> Option<Fold> {
    let nodes = &model.corner[t as usize];
    let k = nodes.iter().position(|&n| values[n as usize].is_nan())?;
    let vertex = model.triangles[t as usize][k];
    let number = model.triangle_face[t as usize];
    let face = Face::new(model, number)?;
    Some(Fold {
        ends: [Node::Crossing(c), Node::Apex(vertex as u32, c)],
        points: [crossing.place.point, model.points[vertex as usize]],
        normal: crossing.place.normal,
        face: number,
        concave: face.radial(crossing.place.uv) * model.chord < -1e-9,
    })
}

/// Nodes that are one place: the ends of folds too short to be drawn.
struct Same {
    parent: HashMap<Node, Node>,
    place: HashMap<Node, Vector>,
}

impl Same {
    fn new(crossings: &[Crossing], folds: &[Fold], gap: f64) -> Same {
        let mut same = Same { parent: HashMap::new(), place: HashMap::new() };
        for fold in folds {
            if length(&sub(&fold.points[0], &fold.points[1])) > gap {
                continue;
            }
            // The place of a crossing is on the surface: it stands for a vertex, too.
            let [a, b] = [0, 1].map(|k| same.root(fold.ends[k]));
            if a != b {
                let (low, high) = if a < b { (a, b) } else { (b, a) };
                same.parent.insert(high, low);
                if let Node::Crossing(c) = low {
                    same.place.insert(low, crossings[c as usize].place.point);
                }
            }
        }
        same
    }

    fn root(&self, mut node: Node) -> Node {
        while let Some(&up) = self.parent.get(&node) {
            node = up;
        }
        node
    }
}

/// Links in the order they are walked, with whether backward; closed walks last.
fn walks(links: &[Link]) -> Vec<Vec<(usize, bool)>> {
    let mut at: HashMap<Node, Vec<usize>> = HashMap::new();
    for (i, link) in links.iter().enumerate() {
        if link.ends[0] != link.ends[1] {
            for end in link.ends {
                at.entry(end).or_default().push(i);
            }
        }
    }
    let mut used: Vec<bool> = links.iter().map(|link| link.ends[0] == link.ends[1]).collect();
    let free = |node: &Node| at[node].len() != 2;
    let mut out = Vec::new();
    for closed in [false, true] {
        for first in 0..links.len() {
            if used[first] {
                continue;
            }
            let ends = &links[first].ends;
            let backward = !closed && !free(&ends[0]);
            if backward && !free(&ends[1]) {
                continue;
            }
            let mut walk = Vec::new();
            let (mut current, mut backward) = (first, backward);
            loop {
                used[current] = true;
                walk.push((current, backward));
                let end = links[current].ends[usize::from(!backward)];
                if free(&end) {
                    break;
                }
                let Some(&next) = at[&end].iter().find(|&&i| !used[i]) else { break };
                backward = links[next].ends[0] != end;
                current = next;
            }
            out.push(walk);
        }
    }
    out
}

/// One walk cut where the face or the way of curving changes.
fn parted(links: &[Link], walk: &[(usize, bool)], same: &Same, chord: f64, out: &mut Vec<Silhouette>) {
    let mut pieces: Vec<(i32, Stretch)> = Vec::new();
    for &(i, backward) in walk {
        let link = &links[i];
        let mut own = link.stretches.clone();
        // Both faces at a joint end in the very same point.
        let (first, last) = (0, own.len() - 1);
        if let Some(p) = same.place.get(&link.ends[0]) {
            own[first].from = *p;
        }
        if let Some(p) = same.place.get(&link.ends[1]) {
            own[last].to = *p;
        }
        if backward {
            own.reverse();
            for s in &mut own {
                *s = Stretch { from: s.to, to: s.from, normals: [s.normals[1], s.normals[0]], concave: s.concave };
            }
        }
        pieces.extend(own.into_iter().map(|s| (link.face, s)));
    }
    let closed = pieces.len() > 1 && pieces[0].1.from == pieces[pieces.len() - 1].1.to;
    pieces.retain(|(_, s)| length(&sub(&s.to, &s.from)) > 1e-6 * chord);
    if pieces.is_empty() {
        return;
    }
    let key = |p: &(i32, Stretch)| (p.0, p.1.concave);
    if closed && let Some(k) = (1..pieces.len()).find(|&k| key(&pieces[k]) != key(&pieces[k - 1])) {
        pieces.rotate_left(k);
    }
    for run in pieces.chunk_by(|a, b| key(a) == key(b)) {
        let mut points = vec![run[0].1.from];
        let mut normals = vec![run[0].1.normals[0]];
        for (_, s) in run {
            points.push(s.to);
            normals.push(s.normals[1]);
        }
        out.push(Silhouette { face: run[0].0, concave: run[0].1.concave, points, normals });
    }
}
