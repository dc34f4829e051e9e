//! The border of a face, by the edges of its body.

use rustc_hash::FxHashMap;

use super::edge_pieces::Pieces;
use crate::edges::Polyline;
use crate::faces::Node;
use crate::shapes::{Edge, Face};
use crate::tessellate::MeshedFace;

/// The edges of a body in a face's view.
pub struct Border<'a> {
    pub edges: &'a [Edge],
    pub lines: &'a [Option<Polyline>],
    pub pieces: &'a [Pieces],
}

/// A chord of an edge's polyline, and whether it is passed in the edge's sense.
pub type Chord = (u32, usize, bool);

impl Border<'_> {
    /// The chord between two neighbours on a face's border.
    pub fn chord(&self, face: &Face, from: Node, to: Node) -> Option<Chord> {
        let last = |edge: u32| self.lines[edge as usize].as_ref().map_or(0, |line| line.points.len() - 1);
        match (from, to) {
            (Node::Edge(edge, _, a), Node::Edge(other, _, b)) => {
                (edge == other && a.abs_diff(b) == 1).then_some((edge, a.min(b) as usize, b > a))
            }
            (Node::Edge(edge, _, a), Node::Vertex((vertex, _))) => {
                let (a, last) = (a as usize, last(edge));
                let ends = self.ends(edge);
                let [at_first, at_last] = [a == 1 && ends[0] == vertex, a + 1 == last && ends[1] == vertex];
                (at_first != at_last).then_some((edge, if at_first { 0 } else { a }, at_last))
            }
            (Node::Vertex(_), Node::Edge(..)) => self.chord(face, to, from).map(|(edge, k, ahead)| (edge, k, !ahead)),
            (Node::Vertex((a, _)), Node::Vertex((b, _))) => {
                let mut found = face.wires.iter().flatten().filter_map(|used| {
                    let ends = self.ends(used.edge);
                    let single = last(used.edge) == 1 && !self.edges[used.edge as usize].degenerate;
                    (single && (ends == [a, b] || ends == [b, a])).then_some((used.edge, 0, ends == [a, b]))
                });
                let first = found.next()?;
                found.all(|other| other == first).then_some(first)
            }
            (Node::Inside(_), _) | (_, Node::Inside(_)) => None,
        }
    }

    fn ends(&self, edge: u32) -> [u32; 2] {
        self.edges[edge as usize].ends.map(|end| end.map_or(u32::MAX, |(vertex, _)| vertex))
    }

    /// The vertex at which a chord passes through the plane.
    pub fn vertex(&self, chord: Chord) -> Option<u32> {
        self.pieces[chord.0 as usize].breaks.iter().find(|b| b.chord == chord.1).map(|b| b.vertex)
    }
}

/// The point of a face's border that a corner of its mesh is. All corners of a pole are its vertex.
pub fn corner_node(found: &MeshedFace, border: &Border, point: u32) -> Option<Node> {
    let number = *found.mesh.nodes.get(point as usize)?;
    let node = *found.nodes.get(number as usize)?;
    match node {
        Node::Edge(edge, ..) if border.edges[edge as usize].degenerate => {
            border.edges[edge as usize].ends[0].map(Node::Vertex)
        }
        _ => Some(node),
    }
}

/// The points of a face's mesh that lie at one pole, each with the first of them.
pub fn poles(face: &Face, found: &MeshedFace, edges: &[Edge]) -> FxHashMap<u32, u32> {
    let degenerate = face.wires.iter().flatten().map(|used| &edges[used.edge as usize]).filter(|edge| edge.degenerate);
    let vertices: Vec<Node> = degenerate.filter_map(|edge| edge.ends[0]).map(Node::Vertex).collect();
    let nodes = &found.mesh.nodes;
    let at_pole = |node: u32| match found.nodes.get(node as usize) {
        Some(Node::Edge(edge, ..)) => edges[*edge as usize].degenerate,
        Some(vertex) => vertices.contains(vertex),
        None => false,
    };
    let (mut first, mut out) = (FxHashMap::default(), FxHashMap::default());
    for (point, _) in (0..).zip(nodes).filter(|(_, node)| at_pole(**node)) {
        let place = found.mesh.points[point as usize].map(f64::to_bits);
        out.insert(point, *first.entry(place).or_insert(point));
    }
    out
}
