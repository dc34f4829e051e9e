//! The image that outlines are added to, and what comes of it.

use rayon::prelude::*;

use crate::lines::View;
use hlr_brep::geometry::vector::Vector;
use hlr_mesh::walks::Walks;
use hlr_visibility::scan::stretches::Stretches;

/// The image without its outlines.
pub struct Image<'a> {
    pub points: &'a [Vector],
    pub edges: &'a [[i32; 2]],
    /// Triangles at edge e: incident[offsets[e]..offsets[e + 1]].
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    /// Per edge its class, part and group, and whether a curved surface may show its outline there.
    pub kind: &'a [u8],
    pub part: &'a [i32],
    pub group: &'a [i32],
    pub curved: &'a [bool],
    /// Per triangle its face, numbered through all parts, and its group.
    pub triangle_face: &'a [i32],
    pub triangle_group: &'a [i32],
    /// The first face of each part.
    pub first: &'a [i32],
    /// Faces that have their outlines.
    pub traced: &'a [bool],
    /// Groups that are closed bodies.
    pub closed: &'a [bool],
    /// Groups that others come near: their outlines may run where another body touches.
    pub near: &'a [bool],
    /// All is one convex body.
    pub convex: bool,
    pub view: View,
}

/// What is true of the classes of edges, by their numbers.
pub struct Classes<'a> {
    /// It bounds faces, and the surface goes on there without a fold.
    pub border: &'a [bool],
    pub tangent: &'a [bool],
    pub outline: u8,
    pub interior: u8,
}

/// The image with its outlines: the columns of its points and edges, then those of the outlines.
#[derive(Default)]
pub struct Outlined {
    pub points: Vec<Vector>,
    /// How far points are moved before visibility is decided.
    pub lift: Vec<Vector>,
    pub edges: Vec<[i32; 2]>,
    pub offsets: Vec<i32>,
    pub part: Vec<i32>,
    pub group: Vec<i32>,
    pub kind: Vec<u8>,
    pub curved: Vec<bool>,
    /// Hidden by the outline's own body.
    pub hidden: Vec<bool>,
    /// The outline to which an edge belongs, -1 for none.
    pub number: Vec<i32>,
    pub own: Stretches,
    /// Where each outline begins among the edges of all outlines; its part, and its face within the part.
    pub starts: Vec<i32>,
    pub part_of_outline: Vec<i32>,
    pub face_in_part: Vec<i32>,
}

/// An edge without triangles.
pub(super) struct Edge {
    pub ends: [i32; 2],
    pub part: i32,
    pub group: i32,
    pub kind: u8,
    pub hidden: bool,
    pub number: i32,
}

impl Outlined {
    /// The image as it is, without any outline, with room for so many more points and edges.
    pub(super) fn of(image: &Image, more_points: usize, more_edges: usize) -> Outlined {
        let (points, edges) = (image.points.len(), image.edges.len());
        let ((ends, offsets), (at, lift)) = rayon::join(
            || (roomy(image.edges.iter().copied(), more_edges), roomy(image.offsets.iter().copied(), more_edges)),
            || {
                let still = std::iter::repeat_n([0.0; 3], points);
                (roomy(image.points.iter().copied(), more_points), roomy(still, more_points))
            },
        );
        Outlined {
            points: at,
            lift,
            edges: ends,
            offsets,
            part: roomy(image.part.iter().copied(), more_edges),
            group: roomy(image.group.iter().copied(), more_edges),
            kind: roomy(image.kind.iter().copied(), more_edges),
            curved: roomy(untraced(image).into_iter(), more_edges),
            hidden: roomy(std::iter::repeat_n(false, edges), more_edges),
            number: roomy(std::iter::repeat_n(-1, edges), more_edges),
            starts: vec![0],
            ..Outlined::default()
        }
    }

    /// The outlines as walks of this class, in their order. first: how many edges the image had before.
    pub fn walks(&self, kind: u8, first: i32) -> Walks {
        let (count, total) = (self.part_of_outline.len(), self.starts[self.part_of_outline.len()]);
        Walks {
            offsets: self.starts.clone(),
            edges: (first..first + total).collect(),
            reversed: vec![false; total as usize],
            kind: vec![kind; count],
            part: self.part_of_outline.clone(),
            index: vec![-1; count],
            other: vec![-1; count],
            face: self.face_in_part.clone(),
            straight: vec![false; count],
            curve: vec![-1; count],
            shallow: vec![false; count],
        }
    }

    pub(super) fn push(&mut self, edge: Edge) {
        self.edges.push(edge.ends);
        self.offsets.push(self.offsets[self.offsets.len() - 1]);
        self.part.push(edge.part);
        self.group.push(edge.group);
        self.kind.push(edge.kind);
        self.curved.push(false);
        self.hidden.push(edge.hidden);
        self.number.push(edge.number);
    }
}

/// Items, and room for more: without it the first one more would copy them all.
fn roomy<T>(items: impl ExactSizeIterator<Item = T>, more: usize) -> Vec<T> {
    let mut out = Vec::with_capacity(items.len() + more);
    out.extend(items);
    out
}

/// Edges at which a contour of the mesh is still an outline, because no face there has been traced: a traced face has
/// its own outline, and mesh edges, also those beside a planar face, no longer stand for it.
fn untraced(image: &Image) -> Vec<bool> {
    let known = |e: usize| {
        let around = &image.incident[image.offsets[e] as usize..image.offsets[e + 1] as usize];
        around.iter().any(|&t| image.traced[image.triangle_face[t as usize] as usize])
    };
    image.curved.par_iter().enumerate().map(|(e, &curved)| curved && !known(e)).collect()
}
