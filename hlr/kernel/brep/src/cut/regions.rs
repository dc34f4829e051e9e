//! The regions of a face that a plane leaves, by the corners of its mesh below the plane, and what borders each of them.

use rustc_hash::{FxHashMap, FxHashSet};

use super::border::{Border, Chord, corner_node, poles};
use super::edge_pieces::Piece;
use super::plane::Plane;
use crate::edges::Polyline;
use crate::faces::Node;
use crate::format::Orientation;
use crate::sets::Sets;
use crate::shapes::{Face, Use};
use crate::tessellate::MeshedFace;

/// Regions are numbered from 0.
pub struct Regions {
    pub count: u32,
    /// By point of the mesh; None for those that are no corners below the plane.
    of_corner: Vec<Option<u32>>,
    /// By edge, number of the chord, and whether the border runs along it in its sense.
    of_chord: FxHashMap<Chord, u32>,
    /// By vertex, where a border has a pole.
    at_pole: FxHashMap<u32, u32>,
    /// By sides of triangles both of whose ends lie on the plane. All corners of a pole count as its first.
    of_side: FxHashMap<(u32, u32), u32>,
    first_at_pole: FxHashMap<u32, u32>,
    /// Edges that the face uses once.
    once: FxHashSet<u32>,
}

impl Regions {
    /// `seams`: whether what lies on both sides of a seam is one region; else it is as if other faces met there.
    pub fn new(face: &Face, found: &MeshedFace, border: &Border, plane: &Plane, seams: bool) -> Regions {
        let mesh = &found.mesh;
        // A point of the border where it touches itself may be the corner of no triangle, as another stands in for it.
        let mut below = vec![false; mesh.points.len()];
        for &i in mesh.triangles.iter().flatten() {
            below[i as usize] = plane.height(&mesh.points[i as usize]) < -plane.near;
        }
        let is_below = |i: u32| below[i as usize];
        let mut sets = Sets::new(below.len());
        let first_at_pole = poles(face, found, border.edges);
        for (&point, &first) in &first_at_pole {
            if is_below(point) {
                sets.unite(point as usize, first as usize);
            }
        }
        let mut sides: FxHashSet<(u32, u32)> = FxHashSet::default();
        for (a, b) in mesh.triangles.iter().flat_map(sides_of) {
            sides.insert((a, b));
            if is_below(a) && is_below(b) {
                sets.unite(a as usize, b as usize);
            }
        }
        // What borders the regions, by one of their corners.
        let (mut of_chord, mut of_side) = (FxHashMap::default(), FxHashMap::default());
        let mut at_pole = FxHashMap::default();
        for t in &mesh.triangles {
            let Some(&corner) = t.iter().find(|i| is_below(**i)) else { continue };
            for (a, b) in sides_of(t) {
                let nodes = [a, b].map(|i| corner_node(found, border, i));
                if let Some(Node::Vertex((vertex, _))) = nodes[0] {
                    at_pole.entry(vertex).or_insert(corner);
                }
                if let ([Some(from), Some(to)], false) = (nodes, sides.contains(&(b, a)))
                    && let Some(chord) = border.chord(face, from, to)
                {
                    of_chord.insert(chord, corner);
                }
                if plane.holds(&mesh.points[a as usize]) && plane.holds(&mesh.points[b as usize]) {
                    of_side.insert(ends((a, b), &first_at_pole), corner);
                }
            }
        }
        // A face goes on across its seam.
        for (&(edge, chord, ahead), &corner) in &of_chord {
            if let (true, Some(&other)) = (ahead && seams, of_chord.get(&(edge, chord, false))) {
                sets.unite(corner as usize, other as usize);
            }
        }
        let mut numbers: FxHashMap<usize, u32> = FxHashMap::default();
        let mut number = |corner: u32| {
            let next = numbers.len() as u32;
            *numbers.entry(sets.first(corner as usize)).or_insert(next)
        };
        let of_corner = (0..below.len() as u32).map(|i| is_below(i).then(|| number(i))).collect();
        let once = once(face);
        let mut out = Regions { count: 0, of_corner, of_chord, at_pole, of_side, first_at_pole, once };
        out.of_chord.values_mut().for_each(|corner| *corner = number(*corner));
        out.at_pole.values_mut().for_each(|corner| *corner = number(*corner));
        out.of_side.values_mut().for_each(|corner| *corner = number(*corner));
        out.count = numbers.len() as u32;
        out
    }

    /// The region of a triangle, or that beyond its side on the plane. None where there is none.
    pub fn beside(&self, t: &[u32; 3]) -> Option<u32> {
        let own = t.iter().find_map(|&i| self.of_corner[i as usize]);
        own.or_else(|| {
            sides_of(t).into_iter().find_map(|(a, b)| self.of_side.get(&ends((b, a), &self.first_at_pole)).copied())
        })
    }

    /// The region that a piece of an edge borders, as a face uses it; None: it has no region beside it.
    pub fn of_piece(&self, used: &Use, piece: &Piece, line: &Polyline, degenerate: bool) -> Option<u32> {
        if degenerate {
            return self.at_pole.get(&used.ends[0].0).copied();
        }
        let ahead = used.orientation == Orientation::Forward;
        let within = |k: &usize| line.parameters[*k] < piece.range[1] && line.parameters[k + 1] > piece.range[0];
        let of = |ahead: bool| {
            let mut chords = (0..line.parameters.len() - 1).filter(within);
            chords.find_map(|k| self.of_chord.get(&(used.edge, k, ahead)).copied())
        };
        // The border of a face that is written the wrong way round runs against its uses.
        of(ahead).or_else(|| if self.once.contains(&used.edge) { of(!ahead) } else { None })
    }
}

/// The edges that a face uses once.
fn once(face: &Face) -> FxHashSet<u32> {
    let mut seen = FxHashMap::default();
    face.wires.iter().flatten().for_each(|used| *seen.entry(used.edge).or_insert(0) += 1);
    seen.into_iter().filter_map(|(edge, uses)| (uses == 1).then_some(edge)).collect()
}

/// The ends of a side, all corners of a pole as its first.
fn ends((a, b): (u32, u32), first_at_pole: &FxHashMap<u32, u32>) -> (u32, u32) {
    let [a, b] = [a, b].map(|i| first_at_pole.get(&i).copied().unwrap_or(i));
    (a, b)
}

fn sides_of(t: &[u32; 3]) -> [(u32, u32); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}
