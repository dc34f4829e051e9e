//! Where edges and outlines lie when they are compared with the triangles of the faces that they bound.
//!
//! The visibility pass compares them polygon by polygon (`hlr_visibility::scan::own_faces`). Edges without triangles,
//! which are added to the image and never drawn, give it their places.

use rayon::slice::ParallelSliceMut;

use super::image::{Classes, Edge, Image, Outlined};
use hlr_brep::geometry::vector::Vector;
use hlr_mesh::topology::components;
use hlr_visibility::scan::stretches::Stretches;

/// A stretch of an edge with one of the faces that the edge bounds.
pub struct Stretch {
    pub edge: i32,
    /// Parameters from the edge's first to its second vertex.
    pub range: [f64; 2],
    /// Numbered through all parts.
    pub face: i32,
    /// How its ends are moved off that face before it is compared with it, model units.
    pub off: [Vector; 2],
    /// How its ends are moved before it is compared with everything else; summed over the faces of a stretch, and used
    /// only where the stretch is not the whole edge, or is `replaced`.
    pub lift: [Vector; 2],
    /// As in `Stretches`.
    pub beside: u8,
    pub dented: bool,
    /// The edge itself is moved, and a line of its own stands for it in its place: an outline that others come near.
    pub replaced: bool,
}

/// Adds these stretches, sorted by edge, then by parameter; nothing where there are none. `sheet`: those of `sheets`.
pub(super) fn add(out: &mut Outlined, image: &Image, classes: &Classes, sheet: Vec<i32>, all: &[Stretch]) {
    if all.is_empty() {
        return;
    }
    let same = |a: &Stretch, b: &Stretch| a.edge == b.edge && a.range == b.range;
    let mut own = Stretches { offsets: vec![0], sheet, ..Stretches::NONE };
    // Stretches that are not the whole edge get points of their own.
    for stretch in all.chunk_by(same) {
        let first = &stretch[0];
        let whole = first.range == [0.0, 1.0];
        let lift = || {
            let sum = |k: usize, i: usize| stretch[1..].iter().fold(first.lift[k][i], |sum, s| sum + s.lift[k][i]);
            [0, 1].map(|k| [0, 1, 2].map(|i| sum(k, i)))
        };
        own.line.push(if whole && !first.replaced { first.edge } else { along(out, classes, first, lift()) });
        own.edge.push(first.edge);
        own.range.push(on_paper(out, image, first));
        own.beside.push(first.beside);
        own.dented.push(stretch.iter().any(|s| s.dented));
        own.face.extend(stretch.iter().map(|s| s.face));
        own.offsets.push(own.face.len() as i32);
    }
    own.off = all.iter().map(|stretch| along(out, classes, stretch, stretch.off)).collect();
    out.own = own;
}

/// Adds an edge along a stretch whose ends are moved; its number.
fn along(out: &mut Outlined, classes: &Classes, stretch: &Stretch, moved: [Vector; 2]) -> i32 {
    let edge = stretch.edge as usize;
    let [a, b] = out.edges[edge].map(|p| out.points[p as usize]);
    let next = out.points.len() as i32;
    for (t, moved) in stretch.range.into_iter().zip(moved) {
        out.points.push([0, 1, 2].map(|i| a[i] * (1.0 - t) + b[i] * t));
        out.lift.push(moved);
    }
    let (part, group) = (out.part[edge], out.group[edge]);
    out.push(Edge { ends: [next, next + 1], part, group, kind: classes.interior, hidden: false, number: -1 });
    out.edges.len() as i32 - 1
}

/// The parameters of a stretch along the edge's image.
fn on_paper(out: &Outlined, image: &Image, stretch: &Stretch) -> [f64; 2] {
    if !image.view.perspective {
        return stretch.range;
    }
    let [a, b] = out.edges[stretch.edge as usize].map(|p| image.view.depth(&out.points[p as usize]));
    stretch.range.map(|t| t * b / (t * b + (1.0 - t) * a))
}

/// Per face a number, the same for all faces that join smoothly.
pub(super) fn sheets(image: &Image, classes: &Classes) -> Vec<i32> {
    let around = |e: usize| &image.incident[image.offsets[e] as usize..image.offsets[e + 1] as usize];
    let tangent = (0..image.edges.len()).filter(|&e| classes.tangent[image.kind[e] as usize]);
    let mut pairs: Vec<[i32; 2]> = tangent
        .filter_map(|e| <[i32; 2]>::try_from(around(e)).ok())
        .map(|pair| pair.map(|t| image.triangle_face[t as usize]))
        .collect();
    pairs.par_sort_unstable();
    pairs.dedup();
    let mut joined = vec![-1; image.traced.len()];
    for (pair, label) in pairs.iter().zip(components(&pairs, image.traced.len())) {
        pair.iter().for_each(|&face| joined[face as usize] = label);
    }
    // Faces that stand alone first, then the sheets.
    let alone = joined.iter().filter(|label| **label < 0).count() as i32;
    let mut next = 0..alone;
    joined.into_iter().map(|label| if label < 0 { next.next().unwrap_or(alone) } else { alone + label }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::View;
    use hlr_visibility::scan::stretches::Beside;

    const TANGENT: u8 = 1;
    const OUTLINE: u8 = 2;
    const INTERIOR: u8 = 3;

    /// Two triangles side by side, each a face of its own, and the edge between them.
    fn image<'a>(kind: &'a [u8], perspective: bool) -> Image<'a> {
        Image {
            points: &[[0.0, 0.0, -1.0], [0.0, 4.0, -3.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]],
            edges: &[[0, 1]],
            offsets: &[0, 2],
            incident: &[0, 1],
            kind,
            part: &[0],
            group: &[0],
            curved: &[true],
            triangle_face: &[1, 2],
            triangle_group: &[0, 0],
            first: &[0],
            traced: &[false; 4],
            closed: &[true],
            near: &[false],
            convex: false,
            view: View { origin: [0.0; 3], away: [0.0, 0.0, -1.0], perspective },
        }
    }

    fn added(kind: u8, perspective: bool, stretches: &[Stretch]) -> Outlined {
        let (mut border, mut tangent) = ([true; 256], [false; 256]);
        (border[INTERIOR as usize], tangent[TANGENT as usize]) = (false, true);
        let classes = Classes { border: &border, tangent: &tangent, outline: OUTLINE, interior: INTERIOR };
        let kinds = [kind];
        let image = image(&kinds, perspective);
        let mut out = Outlined::of(&image, 0, 0);
        assert_eq!((out.points.len(), out.edges.len(), &out.curved[..]), (4, 1, &[true][..]));
        let sheet = sheets(&image, &classes);
        add(&mut out, &image, &classes, sheet, stretches);
        out
    }

    fn stretch(range: [f64; 2], face: i32, lift: f64) -> Stretch {
        let off = [[0.0, 0.0, f64::from(face)]; 2];
        let lift = [[lift, 0.0, 0.0]; 2];
        Stretch { edge: 0, range, face, off, lift, beside: Beside::Visible as u8, dented: face == 2, replaced: false }
    }

    #[test]
    fn a_part_of_an_edge_gets_points_of_its_own_and_the_sum_of_its_lifts() {
        let all = [stretch([0.0, 0.5], 1, 0.25), stretch([0.0, 0.5], 2, 0.5), stretch([0.5, 1.0], 1, 0.0)];
        let out = added(0, false, &all);
        assert_eq!((&out.own.edge[..], &out.own.offsets[..]), (&[0, 0][..], &[0, 2, 3][..]));
        assert_eq!((&out.own.line[..], &out.own.off[..]), (&[1, 2][..], &[3, 4, 5][..]));
        assert_eq!((&out.own.face[..], &out.own.dented[..]), (&[1, 2, 1][..], &[true, false][..]));
        assert_eq!(out.edges[1..], [[4, 5], [6, 7], [8, 9], [10, 11], [12, 13]]);
        assert_eq!((out.points[5], out.lift[5]), ([0.0, 2.0, -2.0], [0.75, 0.0, 0.0]));
        assert_eq!((out.points[11], out.lift[11]), ([0.0, 2.0, -2.0], [0.0, 0.0, 2.0]));
        assert!(out.kind[1..].iter().all(|kind| *kind == INTERIOR) && out.offsets[1..].iter().all(|at| *at == 2));
        // The whole edge is its own line.
        assert_eq!(added(0, false, &[stretch([0.0, 1.0], 1, 0.5)]).own.line, [0]);
        // Unless that is moved: then a line stands in its place.
        let out = added(0, false, &[Stretch { replaced: true, ..stretch([0.0, 1.0], 1, 0.0) }]);
        assert_eq!((&out.own.line[..], &out.edges[1..2]), (&[1][..], &[[4, 5]][..]));
        assert_eq!((out.points[5], out.lift[5]), ([0.0, 4.0, -3.0], [0.0; 3]));
    }

    #[test]
    fn parameters_on_paper_follow_the_perspective() {
        // The depths of the ends are 1 and 3: the middle in space is three quarters of the way on paper.
        assert_eq!(added(0, true, &[stretch([0.0, 0.5], 1, 0.0)]).own.range, [[0.0, 0.75]]);
        assert_eq!(added(0, false, &[stretch([0.0, 0.5], 1, 0.0)]).own.range, [[0.0, 0.5]]);
    }

    #[test]
    fn faces_that_join_smoothly_are_one_sheet() {
        let all = [stretch([0.0, 1.0], 1, 0.0)];
        assert_eq!(added(0, false, &all).own.sheet, [0, 1, 2, 3]);
        assert_eq!(added(TANGENT, false, &all).own.sheet, [0, 2, 2, 1]);
        assert!(added(TANGENT, false, &[]).own.sheet.is_empty());
    }
}
