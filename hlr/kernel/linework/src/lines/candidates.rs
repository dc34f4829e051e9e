//! The chains of mesh edges that may become lines: edges of the source, and the contours of the mesh, face by face.

use super::chain::chain;
use super::drawing::Kind;
use hlr_mesh::topology::components;
use hlr_visibility::scan::mesh::{DRAWN, OUTLINE};

/// A contour with fewer mesh edges that meets no other line is noise of the mesh: a closed curve of so few chords is
/// coarser than any tessellation whose chords turn by at most half a radian.
const NOISE_EDGES: usize = 6;

/// The part, edge and face to which a chain belongs; -1 for none.
#[derive(Clone, Copy, Debug)]
pub struct About {
    pub kind: Kind,
    pub part: i32,
    pub edge: i32,
    pub face: i32,
    pub other: i32,
    /// The chain is the contour of a mesh, which may zigzag by an edge.
    pub noisy: bool,
    /// Known to be straight, so that no curve is looked for.
    pub straight: bool,
    /// An intersection line along which one surface is nowhere deep in the other.
    pub shallow: bool,
}

#[derive(Clone, Debug, Default)]
pub struct Chains {
    /// (chains + 1) offsets into `edges` and `reversed`.
    pub offsets: Vec<i32>,
    pub edges: Vec<i32>,
    pub reversed: Vec<bool>,
    pub about: Vec<About>,
}

impl Chains {
    pub fn new() -> Chains {
        Chains { offsets: vec![0], ..Chains::default() }
    }

    pub fn push(&mut self, edges: &[i32], reversed: &[bool], about: About) {
        self.edges.extend(edges);
        self.reversed.extend(reversed);
        self.offsets.push(self.edges.len() as i32);
        self.about.push(about);
    }

    /// The mesh edges of a chain, and whether each is walked backward.
    pub fn of(&self, c: usize) -> (&[i32], &[bool]) {
        let run = self.offsets[c] as usize..self.offsets[c + 1] as usize;
        (&self.edges[run.clone()], &self.reversed[run])
    }
}

/// The arrays of the mesh that its contours need.
pub struct Surface<'a> {
    pub points: usize,
    pub edges: &'a [[i32; 2]],
    /// Triangles at edge e: incident[offsets[e]..offsets[e + 1]].
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    pub edge_group: &'a [i32],
    pub triangle_part: &'a [i32],
    pub triangle_face: &'a [i32],
    /// Per part, whether its faces are known.
    pub has_faces: &'a [bool],
    /// Per triangle: 1 toward the viewer, -1 away, 0 edge-on.
    pub facing: &'a [i8],
    pub role: &'a [u8],
    pub groups: usize,
}

/// Adds the chains of the contour edges among `found` (ascending).
pub fn add_outlines(s: &Surface, found: &[i32], out: &mut Chains) {
    let mut edges: Vec<i32> = found.to_vec();
    edges.dedup();
    edges.retain(|&e| s.offsets[e as usize + 1] > s.offsets[e as usize]);
    let noise = noise(s, &edges);
    let (mut contour, mut owner) = (Vec::new(), Vec::new());
    for (&e, noise) in edges.iter().zip(noise) {
        let role = s.role[e as usize];
        if noise || role & OUTLINE == 0 {
            continue;
        }
        let (toward, folds) = facing(s, e);
        // An edge drawn only as a contour is one. An edge that is always drawn is one where the surface folds.
        if role & DRAWN == 0 || folds {
            contour.push(e);
            owner.push(toward as usize);
        }
    }
    // The face toward the viewer owns the outline. Outlines are chained within that face; in a mesh, within the part.
    let face = |t: usize| if s.has_faces[s.triangle_part[t] as usize] { s.triangle_face[t] } else { -1 };
    let key: Vec<(i32, i32)> = owner.iter().map(|&t| (s.triangle_part[t], face(t))).collect();
    let mut distinct = key.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let key: Vec<i32> = key.iter().map(|k| distinct.binary_search(k).unwrap_or(0) as i32).collect();
    let ends: Vec<[i32; 2]> = contour.iter().map(|&e| s.edges[e as usize]).collect();
    let walks = chain(&ends, &key, None);
    for w in walks.offsets.windows(2) {
        let run = w[0] as usize..w[1] as usize;
        let head = owner[walks.order[run.start] as usize];
        let edges: Vec<i32> = walks.order[run.clone()].iter().map(|&k| contour[k as usize]).collect();
        let about = About {
            kind: Kind::OUTLINE,
            part: s.triangle_part[head],
            edge: -1,
            face: face(head),
            other: -1,
            noisy: true,
            straight: false,
            shallow: false,
        };
        out.push(&edges, &walks.reversed[run], about);
    }
}

/// The triangle at an edge that faces the viewer most, and whether another one faces away.
fn facing(s: &Surface, e: i32) -> (i32, bool) {
    let around = &s.incident[s.offsets[e as usize] as usize..s.offsets[e as usize + 1] as usize];
    let (mut owner, mut farthest) = (around[0], s.facing[around[0] as usize]);
    for &t in &around[1..] {
        if s.facing[t as usize] > s.facing[owner as usize] {
            owner = t;
        }
        farthest = farthest.min(s.facing[t as usize]);
    }
    (owner, s.facing[owner as usize] > 0 && farthest <= 0)
}

/// Whether each edge belongs to a figure of few edges that meets no other line of its surface.
fn noise(s: &Surface, edges: &[i32]) -> Vec<bool> {
    let ends: Vec<[i32; 2]> = edges.iter().map(|&e| s.edges[e as usize]).collect();
    let figure = components(&ends, s.points);
    let count = figure.iter().max().map_or(0, |&f| f as usize + 1);
    let (mut size, mut group) = (vec![0usize; count], vec![0usize; count]);
    for (&f, &e) in figure.iter().zip(edges) {
        size[f as usize] += 1;
        group[f as usize] = s.edge_group[e as usize] as usize;
    }
    let mut largest = vec![0; s.groups];
    for (&size, &group) in size.iter().zip(&group) {
        largest[group] = largest[group].max(size);
    }
    figure.iter().map(|&f| size[f as usize] < NOISE_EDGES && size[f as usize] < largest[group[f as usize]]).collect()
}
