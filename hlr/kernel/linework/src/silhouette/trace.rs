//! Joins crossings and folds into silhouettes.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::Model;
use super::behind::behind;
use super::contour::{Contour, Crossing, Fold, Node, contour, values};
use super::curve::{Whole, circle, corner, tangent, through, whole_circle};
use super::face::Face;
use super::grazing::Grazing;
use super::link::Link;
use super::narrow::with_narrows;
use super::poles::{into_apex, into_pole, through_poles};
use super::refine::{Stretch, stretches};
use super::split::{canonical, in_order, turns_back, unwound};
use super::wrinkle::flatten;
use hlr_accuracy::OUTLINE_GAP;
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::vector::{Vector, length, sub};

/// A curve over one face along which the surface curves in one way.
#[derive(Clone, Debug)]
pub struct Silhouette {
    pub face: i32,
    pub concave: bool,
    pub points: Vec<Vector>,
    pub normals: Vec<Vector>,
    /// The rise at every point, as in a `Stretch`.
    pub rise: Vec<f64>,
    /// None where it is straight, or runs along an edge of the B-rep: `source`, else -1.
    pub curve: Option<Curve>,
    pub source: i32,
}

/// The result: the curves, and the edges whose faces are seen nearly edge-on.
pub struct Traced {
    pub silhouettes: Vec<Silhouette>,
    pub grazing: Vec<Grazing>,
}

pub fn trace(model: &Model, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Traced> {
    let mut values = values(model);
    let Some(divided) = with_narrows(model, &mut values) else { return traced(model, values, stopped) };
    let mut found = traced(&divided.model(model), values, stopped)?;
    divided.restore(&mut found.grazing);
    Some(found)
}

fn traced(model: &Model, mut values: Vec<f64>, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Traced> {
    flatten(model, &mut values);
    if stopped() {
        return None;
    }
    let Contour { crossings, mut folds, grazing } = contour(model, &values, stopped);
    folds.extend(behind(model, &values, stopped));
    let same = Same::new(&crossings, &folds, OUTLINE_GAP * model.chord);
    let (across, lone) = over_triangles(&crossings, OUTLINE_GAP * model.chord);
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
            let stretches = stretches(model, t, &face, from, to);
            (!stretches.is_empty()).then_some(Link { ends, face: number, stretches })
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
            uv: [None; 2],
            source: fold.source,
            concave: fold.concave,
            rise: fold.rise,
            shallow: None,
        }],
    }));
    for link in &mut links {
        link.ends = link.ends.map(|end| same.root(end));
    }
    through_poles(&mut links);
    let mut out: Vec<Silhouette> =
        walks(&links).par_iter().flat_map_iter(|walk| parted(&links, walk, &same, model)).collect();
    // The result must not depend on the order of triangles.
    out.sort_by(|a, b| a.face.cmp(&b.face).then_with(|| in_order(&a.points, &b.points)));
    Some(Traced { silhouettes: out, grazing })
}

/// A triangle and its two crossings.
type Crossed = (i32, [u32; 2]);

/// Triangles with their two crossings, and those with one. Crossings no farther apart than the gap are one place.
fn over_triangles(crossings: &[Crossing], gap: f64) -> (Vec<Crossed>, Vec<(i32, u32)>) {
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
            [one, two, three] => {
                let found = into_pole(crossings, [one.1, two.1, three.1], gap);
                pairs.extend(found.into_iter().flatten().map(|ends| (one.0, ends)));
            }
            _ => {}
        }
    }
    (pairs, lone)
}

/// Nodes that are one place: the ends of folds too short to be drawn.
struct Same {
    parent: FxHashMap<Node, Node>,
    place: FxHashMap<Node, Vector>,
}

impl Same {
    fn new(crossings: &[Crossing], folds: &[Fold], gap: f64) -> Same {
        let mut same = Same { parent: FxHashMap::default(), place: FxHashMap::default() };
        for fold in folds {
            if length(&sub(&fold.points[0], &fold.points[1])) > gap {
                continue;
            }
            let [a, b] = [0, 1].map(|k| same.root(fold.ends[k]));
            if a != b {
                // The place of a crossing is on the surface: it stands for a vertex, too. Of several the lowest does,
                // for their numbers follow the order of triangles.
                let lowest = [a, b]
                    .into_iter()
                    .filter_map(|node| same.on_surface(node, crossings))
                    .min_by(|p, q| in_order(&[*p], &[*q]));
                let (low, high) = if a < b { (a, b) } else { (b, a) };
                same.parent.insert(high, low);
                if let Some(place) = lowest {
                    same.place.insert(low, place);
                }
            }
        }
        same
    }

    /// The place of a root on the surface; None for a vertex with which no crossing is one.
    fn on_surface(&self, root: Node, crossings: &[Crossing]) -> Option<Vector> {
        let own = || if let Node::Crossing(c) = root { Some(crossings[c as usize].place.point) } else { None };
        self.place.get(&root).copied().or_else(own)
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
    let mut at: FxHashMap<Node, Vec<usize>> = FxHashMap::default();
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

/// One walk cut where the face, the edge or the way of curving changes, and where its image turns back.
fn parted(links: &[Link], walk: &[(usize, bool)], same: &Same, model: &Model) -> Vec<Silhouette> {
    let mut pieces: Vec<(i32, Stretch)> = Vec::new();
    for &(i, backward) in walk {
        let link = &links[i];
        let mut own = link.stretches.clone();
        // The curves of both faces at a joint end in exactly the same point.
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
                s.turn_round();
            }
        }
        pieces.extend(own.into_iter().map(|s| (link.face, s)));
    }
    // Two curves that end in one apex are no closed one: the surface has no single normal there.
    let outer = [walk.first(), walk.last()].map(|at| at.map(|&(i, backward)| (&links[i].ends, backward)));
    let round =
        matches!(outer, [Some((a, back)), Some((b, turned))] if a[usize::from(back)] == b[usize::from(!turned)]);
    let closed = round && pieces.len() > 1 && pieces[0].1.from == pieces[pieces.len() - 1].1.to;
    pieces.retain(|(_, s)| length(&sub(&s.to, &s.from)) > 1e-6 * model.chord);
    if pieces.is_empty() {
        return Vec::new();
    }
    // Near a pole rounding decides the sign of the curvature: over less than the tolerance it is ignored.
    let n = pieces.len();
    for k in if closed { 0..n } else { 1..n.max(2) - 1 } {
        let (before, after) = (pieces[(k + n - 1) % n].1.concave, pieces[(k + 1) % n].1.concave);
        let s = &mut pieces[k].1;
        if before == after && length(&sub(&s.to, &s.from)) < model.chord {
            s.concave = before;
        }
    }
    fill_shallow(&mut pieces, closed);
    let key = |p: &(i32, Stretch)| (p.0, p.1.concave, p.1.source);
    let goes_on = |a: &(i32, Stretch), b: &(i32, Stretch)| key(a) == key(b) && !turns_back(model, &a.1, &b.1);
    if closed && let Some(k) = (1..pieces.len()).find(|&k| !goes_on(&pieces[k - 1], &pieces[k])) {
        pieces.rotate_left(k);
    }
    let whole = pieces.len();
    let mut out = Vec::new();
    for run in pieces.chunk_by(goes_on).flat_map(|run| unwound(model, run, closed && run.len() == whole)) {
        let run = canonical(run, closed && run.len() == whole);
        let mut points = vec![run[0].1.from];
        let mut normals = vec![run[0].1.normals[0]];
        let mut uv = vec![run[0].1.uv[0]];
        let mut rise = vec![run[0].1.rise[0]];
        for (_, s) in &run {
            if let Some(last) = rise.last_mut() {
                *last = last.max(s.rise[0]);
            }
            rise.push(s.rise[1]);
            points.push(s.to);
            normals.push(s.normals[1]);
            uv.push(s.uv[1]);
        }
        let (face, Stretch { concave, source, .. }) = (run[0].0, run[0].1);
        let whole = || whole_circle(&Face::new(model, face)?, &points, &normals[0], model.chord);
        out.push(if let Some(Whole { curve, points, normals }) = if source < 0 { whole() } else { None } {
            // Corners of a sphere's triangles lie on it, and none stands out beyond a plane that touches it.
            let rise = vec![0.0; points.len()];
            Silhouette { face, concave, points, normals, rise, curve: Some(curve), source }
        } else {
            let curve = if source >= 0 { None } else { along_points(model, face, &points, &uv) };
            Silhouette { face, concave, points, normals, rise, curve, source }
        });
    }
    out
}

/// Concave stretches count as others where no stretch from cusp to cusp lies behind anything within the tolerance: a
/// surface seen edge-on over a long way has valleys and ridges there that nobody sees.
pub(super) fn fill_shallow(pieces: &mut [(i32, Stretch)], closed: bool) {
    let n = pieces.len();
    // Of a closed curve first a stretch that is not concave, so that no run is cut in two.
    let first = if closed { pieces.iter().position(|(_, s)| !s.concave).unwrap_or(0) } else { 0 };
    let mut from = 0;
    while from < n {
        let concave = |k: usize| pieces[(first + k) % n].1.concave;
        let to = (from..n).find(|&k| concave(k) != concave(from)).unwrap_or(n);
        if concave(from) && (from..to).all(|k| pieces[(first + k) % n].1.shallow.is_some()) {
            for k in from..to {
                let stretch = &mut pieces[(first + k) % n].1;
                if let Some(rise) = stretch.shallow.take() {
                    (stretch.concave, stretch.rise) = (false, rise);
                }
            }
        }
        from = to;
    }
}

/// The curve through points of a face's silhouette; two points are a straight line.
fn along_points(model: &Model, face: i32, points: &[Vector], uv: &[Option<[f64; 2]>]) -> Option<Curve> {
    if points.len() < 3 {
        return None;
    }
    let face = Face::new(model, face);
    let round = face.as_ref().and_then(|face| circle(face, points, model.chord));
    round.or_else(|| {
        let along = |uv: &Option<[f64; 2]>| tangent(face.as_ref()?, (*uv)?, model.chord);
        let corner = |i: usize| corner(points, i, model.chord);
        through(points, &uv.iter().map(along).collect::<Vec<_>>(), &corner).map(Curve::Spline)
    })
}
