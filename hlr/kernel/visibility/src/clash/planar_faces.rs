//! The planar faces of a scene, and which triangles stand on them.
//!
//! A wall meets the planar face that it stands on in corners and sides of both, and nowhere else: a triangle that has
//! corners in common with the face, and lies on one side of it with the others, does not pass through the face. On a
//! plate with holes that decides nearly all pairs whose boxes overlap: each triangle between the holes overlaps with
//! the walls of all of them.
//!
//! ```text
//!          /\    /|         The left triangle stands on a corner of the face, the right one on a side of its border.
//!         /  \  / |
//!     ___/____\/__|____
//! ```

pub const NO_PLANE: i32 = -1;

/// Of a corner: the planar faces that it is a corner of. All are `CROWDED` where there are more: then less is known, and
/// more tested, in whatever order the triangles are.
type AtCorner = [i32; 3];
const CROWDED: i32 = -2;

#[derive(Default)]
pub struct PlanarFaces {
    /// Per triangle its planar face, or NO_PLANE. Triangles of one planar face do not pass through one another.
    pub of: Vec<i32>,
    at_corner: Vec<AtCorner>,
    /// Per triangle and side k, from corner k to the next: the planar face beyond it, or NO_PLANE.
    beyond: Vec<[i32; 3]>,
}

/// The triangles of edge e are incident[offsets[e]..offsets[e + 1]].
#[derive(Clone, Copy)]
pub struct Edges<'a> {
    pub edges: &'a [[i32; 2]],
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
}

impl PlanarFaces {
    /// Of triangles whose neighbours are not known.
    pub fn without_neighbours(of: Vec<i32>) -> PlanarFaces {
        PlanarFaces { of, ..PlanarFaces::default() }
    }

    /// of: per triangle its planar face, or NO_PLANE. corners: the number of corners of all triangles.
    pub fn new(of: Vec<i32>, triangles: &[[i32; 3]], corners: usize, by: &Edges) -> PlanarFaces {
        if of.iter().all(|&face| face == NO_PLANE) {
            return PlanarFaces::without_neighbours(of);
        }
        let mut at_corner = vec![[NO_PLANE; 3]; corners];
        for (triangle, &face) in triangles.iter().zip(&of).filter(|(_, face)| **face != NO_PLANE) {
            for &corner in triangle {
                let faces = &mut at_corner[corner as usize];
                if faces.contains(&face) || faces[0] == CROWDED {
                    continue;
                }
                match faces.iter_mut().find(|f| **f == NO_PLANE) {
                    Some(free) => *free = face,
                    None => *faces = [CROWDED; 3],
                }
            }
        }
        let mut beyond = vec![[NO_PLANE; 3]; triangles.len()];
        for (edge, ends) in by.edges.iter().zip(by.offsets.windows(2)) {
            let &[s, t] = &by.incident[ends[0] as usize..ends[1] as usize] else { continue };
            let (s, t) = (s as usize, t as usize);
            if of[s] != of[t] {
                set_beyond(&mut beyond[s], &triangles[s], edge, of[t]);
                set_beyond(&mut beyond[t], &triangles[t], edge, of[s]);
            }
        }
        PlanarFaces { of, at_corner, beyond }
    }

    /// Whether both triangles are of one planar face.
    #[inline]
    pub fn of_one_face(&self, s: u32, t: u32) -> bool {
        let face = self.of[s as usize];
        face != NO_PLANE && face == self.of[t as usize]
    }

    /// The corners, a bit each, in which triangle t stands on a planar face: one corner of the face, or both ends of a
    /// side of its border. 0 if it does not, or is of the face itself.
    #[inline]
    pub fn feet_on(&self, face: i32, t: u32, corners: &[i32; 3]) -> u8 {
        if face == NO_PLANE || self.at_corner.is_empty() {
            return 0;
        }
        let on = |k: usize| self.at_corner[corners[k] as usize].contains(&face);
        let feet = u8::from(on(0)) | u8::from(on(1)) << 1 | u8::from(on(2)) << 2;
        let beyond = |k: usize| self.beyond[t as usize][k] == face;
        let stands = match feet {
            0b001 | 0b010 | 0b100 => true,
            0b011 => beyond(0),
            0b110 => beyond(1),
            0b101 => beyond(2),
            _ => false,
        };
        if stands { feet } else { 0 }
    }
}

/// Notes the face beyond a side of a triangle.
fn set_beyond(beyond: &mut [i32; 3], triangle: &[i32; 3], edge: &[i32; 2], face: i32) {
    let side = (0..3).find(|&k| edge.contains(&triangle[k]) && edge.contains(&triangle[(k + 1) % 3]));
    if let Some(k) = side {
        beyond[k] = face;
    }
}

#[cfg(test)]
mod tests {
    use super::super::surfaces::Surfaces;
    use super::*;

    const FACE: i32 = 5;

    /// A square of two triangles, 0 1 2 and 0 2 3, and another triangle.
    fn square_and(triangle: [i32; 3], of: i32) -> (Vec<[i32; 3]>, PlanarFaces) {
        let triangles = vec![[0, 1, 2], [0, 2, 3], triangle];
        let mut edges: Vec<[i32; 2]> = triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let (mut offsets, mut incident) = (vec![0], Vec::new());
        for edge in &edges {
            incident.extend((0..3).filter(|&t: &i32| edge.iter().all(|v| triangles[t as usize].contains(v))));
            offsets.push(incident.len() as i32);
        }
        let by = Edges { edges: &edges, offsets: &offsets, incident: &incident };
        let planar = PlanarFaces::new(vec![FACE, FACE, of], &triangles, 9, &by);
        (triangles, planar)
    }

    #[test]
    fn a_wall_stands_on_a_corner_or_on_a_side_of_the_border() {
        let feet = |triangle: [i32; 3], of: i32| square_and(triangle, of).1.feet_on(FACE, 2, &triangle);
        assert_eq!(feet([2, 4, 5], NO_PLANE), 0b001);
        assert_eq!(feet([4, 2, 5], 7), 0b010);
        assert_eq!(feet([1, 0, 4], NO_PLANE), 0b011);
        assert_eq!(feet([4, 2, 1], NO_PLANE), 0b110);
        assert_eq!(feet([0, 4, 3], NO_PLANE), 0b101);
        // The diagonal 0 2 is no border of the face, nor is 1 3 a side of it; the last stand on nothing.
        for triangle in [[0, 2, 4], [1, 3, 4], [0, 1, 2], [4, 5, 6]] {
            assert_eq!(feet(triangle, NO_PLANE), 0, "{triangle:?}");
        }
        let (triangles, planar) = square_and([2, 4, 5], NO_PLANE);
        assert_eq!(planar.feet_on(planar.of[2], 0, &triangles[0]), 0);
        assert!(planar.of_one_face(0, 1) && !planar.of_one_face(1, 2) && !planar.of_one_face(2, 2));
    }

    #[test]
    fn only_what_stands_on_one_side_is_spared() {
        let m = 1000;
        let of = |triangle: [i32; 3], high: [i32; 2]| {
            let points = [[0, 0, 0], [m, 0, 0], [m, m, 0], [0, m, 0], [400, 500, high[0]], [500, 400, high[1]]];
            let (triangles, planar) = square_and(triangle, NO_PLANE);
            let surfaces =
                Surfaces { points: &points, triangles: &triangles, group: &[0; 3], itself: &[true], planar: &planar };
            let found = surfaces.clashes(&|| false);
            (found.tests, found.found.len())
        };
        assert_eq!(of([1, 4, 5], [90, 70]), (0, 0));
        assert_eq!(of([1, 4, 5], [-90, -70]), (0, 0));
        // It goes on through the face, from its corner.
        let (tests, found) = of([2, 4, 5], [-90, 70]);
        assert!(tests > 0 && found > 0);
        // It stands across the face, not on its border.
        assert!(of([1, 3, 4], [-90, 0]).0 > 0);
    }
}
