//! Outlines of one body that face one another in the image: the turns of a spring that lie on one another.
//!
//! Before visibility is decided an outline is moved off its face (`outlined`), here into the next turn. So it is compared
//! once more in its true place (`hlr_visibility::scan::touching`).
//!
//! ```text
//!       ( turn )
//!       --------   outlines of two turns, as far apart on paper as the gap is wide: where both touch, each of them
//!       --------   lies beside the surface of the other
//!       ( turn )
//! ```

use super::trace::Silhouette;
use crate::lines::View;
use hlr_brep::geometry::vector::{Vector, dot};
use hlr_exact::snap::Grid;
use hlr_visibility::boxes::aabb::{Aabb, Item};
use hlr_visibility::boxes::tree::Tree;
use hlr_visibility::scan::own_faces::FACING;

/// Of the largest depth: what is nearer to the eye is left out, for its image is too large.
const NEAR: f64 = 1e-3;

/// A chord of an outline. number: among all.
struct Chord<'a> {
    number: u32,
    ends: [&'a Vector; 2],
    normal: &'a Vector,
    group: i32,
}

/// Per chord of each of these lines, one line after another, whether it faces an outline of the same closed body that
/// is as near on paper as `reach`, a length in the model, or somewhat farther. group: of each face; closed: of each group.
pub fn facing(lines: &[Silhouette], group: &[i32], closed: &[bool], view: &View, reach: f64) -> Vec<bool> {
    let (mut count, mut chords) = (0, Vec::new());
    for line in lines {
        let group = group[line.face as usize];
        let ends = line.points.iter().zip(line.points.iter().skip(1)).zip(&line.normals);
        let numbered = (count..).zip(ends);
        let of_line = numbered.map(|(number, ((a, b), normal))| Chord { number, ends: [a, b], normal, group });
        count += line.points.len().saturating_sub(1) as u32;
        if closed[group as usize] {
            chords.extend(of_line);
        }
    }
    let mut out = vec![false; count as usize];
    let boxes = on_paper(&mut chords, view, reach);
    let tree = Tree::on_one_thread(&boxes);
    for (reach, k) in &boxes {
        let own = &chords[*k as usize];
        out[own.number as usize] = tree.any(reach, |other| own.faces(&chords[other as usize]));
    }
    out
}

/// The box of each chord in the image, wider by half of `reach`; those too near to the eye are taken out.
fn on_paper(chords: &mut Vec<Chord>, view: &View, reach: f64) -> Vec<Item> {
    if view.perspective {
        let farthest = chords.iter().flat_map(|chord| chord.ends).map(|p| view.depth(p)).fold(0.0, f64::max);
        chords.retain(|chord| chord.ends.iter().all(|p| view.depth(p) > NEAR * farthest));
    }
    let across = view.across();
    let corners: Vec<Vector> = chords
        .iter()
        .flat_map(|chord| {
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            for (place, shorter) in chord.ends.iter().filter_map(|point| view.seen(point, &across)) {
                for k in 0..2 {
                    low[k] = low[k].min(place[k] - 0.5 * reach / shorter);
                    high[k] = high[k].max(place[k] + 0.5 * reach / shorter);
                }
            }
            [low, high].map(|[x, y]| [x, y, 0.0])
        })
        .collect();
    let Some(grid) = Grid::uniform_around(&corners) else { return Vec::new() };
    let boxed = |(corners, k): (&[Vector], u32)| {
        let (low, high) = (grid.snap(&corners[0]), grid.snap(&corners[1]));
        // One step wider, to cover the rounding.
        (Aabb { low: low.map(|c| c - 1), high: high.map(|c| c + 1) }, k)
    };
    corners.chunks_exact(2).zip(0..).map(boxed).collect()
}

impl Chord<'_> {
    fn faces(&self, other: &Chord) -> bool {
        self.group == other.group && dot(self.normal, other.normal) < FACING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight outline along x, at a height and a depth, with its normal along y.
    fn line(face: i32, y: f64, depth: f64, normal: f64) -> Silhouette {
        Silhouette {
            face,
            concave: false,
            points: vec![[0.0, y, -depth], [1.0, y, -depth], [2.0, y, -depth]],
            normals: vec![[0.0, normal, 0.0]; 3],
            rise: vec![0.0; 3],
            curve: None,
            source: -1,
        }
    }

    const BODIES: [i32; 3] = [0, 0, 1];

    fn found(lines: &[Silhouette], closed: bool, perspective: bool) -> Vec<bool> {
        let view = View { origin: [0.0; 3], away: [0.0, 0.0, -1.0], perspective };
        facing(lines, &BODIES, &[closed, true], &view, 0.1)
    }

    #[test]
    fn lines_that_face_one_another_within_reach_are_found() {
        let of = |face: i32, gap: f64, normal: f64| [line(0, 0.0, 1.0, 1.0), line(face, gap, 3.0, normal)];
        assert_eq!(found(&of(1, 0.09, -1.0), true, false), [true; 4]);
        assert_eq!(found(&of(1, 0.09, -1.0), false, false), [false; 4]);
        assert_eq!(found(&of(1, 0.11, -1.0), true, false), [false; 4]);
        assert_eq!(found(&of(1, 0.09, 1.0), true, false), [false; 4]);
        // Face 2 is of another body.
        assert_eq!(found(&of(2, 0.09, -1.0), true, false), [false; 4]);
        assert!(found(&[], true, false).is_empty());
    }

    #[test]
    fn in_perspective_they_are_as_near_as_they_appear() {
        // Twice as far from the eye and half as near to the axis: behind one another.
        let of = |depth: f64, y: f64| [line(0, 1.0, 1.0, 1.0), line(1, y, depth, -1.0)];
        assert!(found(&of(2.0, 2.0), true, true)[0]);
        assert_eq!(found(&of(2.0, 1.0), true, true), [false; 4]);
        assert_eq!(found(&of(1.0, 1.09), true, true), [true; 4]);
        // What is next to the eye, or behind it, is left out.
        assert_eq!(found(&of(1e-4, 1e-4), true, true), [false; 4]);
        assert_eq!(found(&of(-1.0, 1.0), true, true), [false; 4]);
    }
}
