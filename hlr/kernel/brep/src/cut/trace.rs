//! Where a plane passes through a face: lines across the triangles of its mesh, each of whose points lies on the surface
//! and on the plane.
//!
//! ```text
//!      +-----+-----+        beyond the plane
//!     / \   / \   / \
//!    x---x-x---x-x---x      a line from border to border, the kept side on its left
//!   /     \ /     \ / \
//!  +-------+-------+---+    kept
//! ```

use rustc_hash::FxHashMap;

use super::border::{Border, Chord, corner_node, poles};
use super::edge_pieces::bracketed;
use super::plane::Plane;
use super::regions::Regions;
use crate::faces::{Node, near};
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, length, sub};
use crate::shapes::Face;
use crate::tessellate::MeshedFace;

/// Distances from the plane within which a line that returns to its start encloses nothing, in `Plane::near`.
const TINY: f64 = 10.0;
/// Gaps between a vertex and its chord within which points of the mesh are left out.
const APART: f64 = 3.0;

/// A point of a line. `node`: the point of the border that it is, on the plane; `vertex`: where it is one; `gap`: how far
/// the vertex of an edge is from where the line passes the edge's chord; `region`: that to its left, in or
/// beside the triangle which it enters there.
#[derive(Clone, Copy, Debug)]
struct Passing {
    uv: [f64; 2],
    point: Vector,
    node: Option<Node>,
    vertex: Option<u32>,
    gap: f64,
    region: Option<u32>,
}

/// A piece of a line from vertex to vertex, with its points in (u, v) and in space, and the region to its left.
#[derive(Clone, Debug)]
pub struct Run {
    pub region: u32,
    pub ends: [u32; 2],
    pub points: Vec<([f64; 2], Vector)>,
}

/// What the plane leaves at a face's section: new edges, and edges of the face which lie on the plane, each with whether
/// the line runs along it in its sense.
#[derive(Debug, Default)]
pub struct Section {
    pub runs: Vec<Run>,
    pub follows: Vec<(u32, bool)>,
}

/// Follows the plane through a face.
///
/// # Errors
/// Why it cannot be followed.
pub fn section(
    face: &Face,
    found: &MeshedFace,
    border: &Border,
    regions: &Regions,
    plane: &Plane,
    vertices: &mut Vec<Vector>,
) -> Result<Section, &'static str> {
    let surface = face.surface.as_ref().ok_or("a face has no surface")?;
    let mut out = Section::default();
    let lines = Tracer::new(face, found, border, regions, plane, surface, vertices).lines()?;
    for (line, closed) in lines {
        divide(line, closed, face, border, plane, vertices, &mut out)?;
    }
    Ok(out)
}

/// A side of a triangle, from its kept end to that beyond, at which a line enters it; and the corner opposite.
type Entry = [u32; 3];

struct Tracer<'a> {
    regions: &'a Regions,
    face: &'a Face,
    found: &'a MeshedFace,
    border: &'a Border<'a>,
    plane: &'a Plane,
    surface: &'a Surface,
    vertices: &'a [Vector],
    beyond: Vec<bool>,
    /// Where lines enter, in the order of the triangles.
    entries: Vec<Entry>,
    /// Numbers of entries by their sides.
    entered: FxHashMap<(u32, u32), usize>,
    /// For each point of the mesh the first one in the same place, where that is a pole.
    first_at_pole: FxHashMap<u32, u32>,
}

impl<'a> Tracer<'a> {
    fn new(
        face: &'a Face,
        found: &'a MeshedFace,
        border: &'a Border<'a>,
        regions: &'a Regions,
        plane: &'a Plane,
        surface: &'a Surface,
        vertices: &'a [Vector],
    ) -> Tracer<'a> {
        let beyond: Vec<bool> = found.mesh.points.iter().map(|p| plane.is_beyond(p)).collect();
        let (first_at_pole, entered, entries) = (poles(face, found, border.edges), FxHashMap::default(), Vec::new());
        let mut out =
            Tracer { regions, face, found, border, plane, surface, vertices, beyond, entries, entered, first_at_pole };
        for t in &found.mesh.triangles {
            for k in 0..3 {
                let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
                if !out.beyond[a as usize] && out.beyond[b as usize] {
                    out.entered.insert(out.side([a, b]), out.entries.len());
                    out.entries.push([a, b, c]);
                }
            }
        }
        out
    }

    /// A side by the numbers of its ends, of which a pole has one.
    fn side(&self, ends: [u32; 2]) -> (u32, u32) {
        let [a, b] = ends.map(|i| self.first_at_pole.get(&i).copied().unwrap_or(i));
        (a, b)
    }

    /// The lines through the face, and whether they close within it: first those that begin at its border.
    fn lines(&self) -> Result<Vec<(Vec<Passing>, bool)>, &'static str> {
        let mut out = Vec::new();
        let mut used = vec![false; self.entries.len()];
        let mut is_next = vec![false; self.entries.len()];
        for entry in &self.entries {
            if let Some(&next) = self.entered.get(&self.side(self.leaving(entry))) {
                is_next[next] = true;
            }
        }
        let at_border = (0..self.entries.len()).filter(|&i| !is_next[i]);
        for first in at_border.chain(0..self.entries.len()) {
            if used[first] {
                continue;
            }
            let [a, b, _] = self.entries[first];
            let open = !is_next[first];
            let region = |entry: usize| self.regions.beside(&self.entries[entry]);
            let begin = if open { self.border_passing([a, b])? } else { self.passing([a, b]) };
            let mut line = vec![Passing { region: region(first), ..begin }];
            let mut at = first;
            loop {
                used[at] = true;
                let side = self.leaving(&self.entries[at]);
                match self.entered.get(&self.side(side)) {
                    None => {
                        line.push(self.border_passing(side)?);
                        break;
                    }
                    Some(&next) if next == first => break,
                    Some(&next) if used[next] => return Err("its mesh cannot be followed"),
                    Some(&next) => {
                        line.push(Passing { region: region(next), ..self.passing(side) });
                        at = next;
                    }
                }
            }
            out.push((line, !open));
        }
        Ok(out)
    }

    /// The side at which a line leaves the triangle that it has entered, from its kept end to that beyond.
    fn leaving(&self, &[a, b, corner]: &Entry) -> [u32; 2] {
        if self.beyond[corner as usize] { [a, corner] } else { [corner, b] }
    }

    fn node(&self, point: u32) -> Option<Node> {
        corner_node(self.found, self.border, point)
    }

    /// Where a line passes a side within the face.
    fn passing(&self, [a, b]: [u32; 2]) -> Passing {
        let mesh = &self.found.mesh;
        let [from, to] = [a, b].map(|i| mesh.uv[i as usize]);
        if self.plane.holds(&mesh.points[a as usize]) {
            let node = self.node(a);
            let vertex = if let Some(Node::Vertex((vertex, _))) = node { Some(vertex) } else { None };
            return Passing { uv: from, point: mesh.points[a as usize], node, vertex, gap: 0.0, region: None };
        }
        let at = |t: f64| [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
        let uv = at(bracketed(|t| self.plane.height(&self.surface.point(at(t))), 0.0, 1.0));
        Passing { uv, point: self.surface.point(uv), node: None, vertex: None, gap: 0.0, region: None }
    }

    /// The same at the border, where an edge has a vertex.
    fn border_passing(&self, side: [u32; 2]) -> Result<Passing, &'static str> {
        let unknown = "its border cannot be followed";
        let (from, to) = (self.node(side[0]).ok_or(unknown)?, self.node(side[1]).ok_or(unknown)?);
        let chord = self.border.chord(self.face, from, to).ok_or(unknown)?;
        let vertex = self.border.vertex(chord).ok_or(unknown)?;
        let passing = self.passing(side);
        let point = self.vertices[vertex as usize];
        let uv = near(self.surface, &point, passing.uv).unwrap_or(passing.uv);
        Ok(Passing { uv, point, vertex: Some(vertex), gap: length(&sub(&point, &passing.point)), ..passing })
    }
}

/// Divides a line at vertices, and where it follows an edge on the plane.
fn divide(
    mut line: Vec<Passing>,
    closed: bool,
    face: &Face,
    border: &Border,
    plane: &Plane,
    vertices: &mut Vec<Vector>,
    out: &mut Section,
) -> Result<(), &'static str> {
    // A corner on the plane is passed once for each side that ends in it.
    line.dedup_by(|b, a| {
        let same = a.node.is_some() && a.node == b.node;
        if same {
            a.vertex = a.vertex.or(b.vertex);
            a.region = b.region.or(a.region);
        }
        same
    });
    if closed {
        if line.len() > 1 && line[0].node.is_some() && line[0].node == line[line.len() - 1].node {
            line.pop();
        }
        let first = line.iter().position(|passing| passing.vertex.is_some());
        line.rotate_left(first.unwrap_or(0));
        let size = line.iter().map(|passing| length(&sub(&passing.point, &line[0].point))).fold(0.0, f64::max);
        if size <= TINY * plane.near || line.len() < 3 {
            return Ok(());
        }
        if first.is_none() {
            vertices.push(line[0].point);
            line[0].vertex = Some(vertices.len() as u32 - 1);
        }
        line.push(line[0]);
    }
    let along = |a: &Passing, b: &Passing| -> Option<Chord> {
        let chord = border.chord(face, a.node?, b.node?)?;
        let edge = &border.edges[chord.0 as usize];
        (border.pieces[chord.0 as usize].on && edge.curve.is_some()).then_some(chord)
    };
    let mut begin = 0;
    while begin + 1 < line.len() {
        let chord = along(&line[begin], &line[begin + 1]);
        let edge = chord.map(|(edge, _, ahead)| (edge, ahead));
        let mut end = begin + 1;
        while end + 1 < line.len()
            && line[end].vertex.is_none()
            && along(&line[end], &line[end + 1]).map(|(edge, _, ahead)| (edge, ahead)) == edge
        {
            end += 1;
        }
        let [first, last] = [&line[begin], &line[end]].map(|passing| passing.vertex);
        let (Some(first), Some(last)) = (first, last) else {
            return Err("an edge lies partly in the plane");
        };
        if let Some((edge, ahead)) = edge {
            let chords = border.lines[edge as usize].as_ref().map_or(0, |line| line.points.len() - 1);
            if end - begin != chords {
                return Err("an edge lies partly in the plane");
            }
            out.follows.push((edge, ahead));
        } else {
            let points = apart_from_ends(&line[begin..=end]);
            let away = |p: &Vector| length(&sub(p, &points[0].1));
            let size = line[begin..=end].iter().map(|passing| away(&passing.point)).fold(0.0, f64::max);
            if first != last || size > TINY * plane.near {
                let region = line[begin..end].iter().find_map(|passing| passing.region);
                let region = region.ok_or("what is left of a face is too narrow")?;
                out.runs.push(Run { region, ends: [first, last], points });
            }
        }
        begin = end;
    }
    Ok(())
}

/// The points of a line but those beside its ends: the mesh passes the vertex of an edge on the edge's chord, and its
/// points closer by may lie behind the vertex.
fn apart_from_ends(line: &[Passing]) -> Vec<([f64; 2], Vector)> {
    let last = line.len() - 1;
    let far = |passing: &Passing| {
        [&line[0], &line[last]].iter().all(|end| length(&sub(&passing.point, &end.point)) > APART * end.gap)
    };
    let kept = line.iter().enumerate().filter(|&(k, passing)| k == 0 || k == last || far(passing));
    kept.map(|(_, passing)| (passing.uv, passing.point)).collect()
}
