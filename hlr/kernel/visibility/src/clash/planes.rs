//! The planes of planar faces: each is as certain as the whole face is wide, not as one sliver of its triangulation.

use std::cmp::Ordering;

use super::planar_faces::NO_PLANE;
use super::reach::{Sheet, Vec3};
use super::search::Clash;
use hlr_mesh::vector::{cross, dot, sub};

/// `off`: how far corners of the face lie off this plane.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub origin: Vec3,
    pub normal: Vec3,
    pub off: f64,
}

impl Plane {
    pub fn height(&self, p: &Vec3) -> f64 {
        dot(&sub(p, &self.origin), &self.normal)
    }
}

/// Planes by the number of their face.
#[derive(Default)]
pub struct Planes {
    /// Per face its place in `known`, or NONE.
    place: Vec<u32>,
    known: Vec<Plane>,
}

const NONE: u32 = u32::MAX;

impl Planes {
    /// The plane of a face that takes part in a clash.
    pub fn get(&self, face: i32) -> Option<&Plane> {
        self.known.get(*self.place.get(usize::try_from(face).ok()?)? as usize)
    }
}

/// The planes of the planar faces that take part in a clash. `face`: per triangle its planar face, or NO_PLANE.
///
/// Each is the plane of its widest triangle; of equally wide ones, of that whose corners come last. So the order of
/// triangles does not matter.
pub fn planes(sheet: &Sheet, face: &[i32], found: &[Clash]) -> Planes {
    let clashing = || found.iter().flat_map(|clash| clash.triangles).map(|t| face[t as usize]);
    let count = clashing().max().map_or(0, |last| (last + 1) as usize);
    let mut place = vec![NONE; count];
    let mut widest: Vec<Option<Candidate>> = Vec::new();
    for f in clashing().filter(|&f| f != NO_PLANE) {
        if place[f as usize] == NONE {
            place[f as usize] = widest.len() as u32;
            widest.push(None);
        }
    }
    if widest.is_empty() {
        return Planes::default();
    }
    let triangles = || {
        let placed = face.iter().map(|&f| usize::try_from(f).ok().and_then(|f| place.get(f)).copied().unwrap_or(NONE));
        placed.enumerate().filter(|&(_, place)| place != NONE).map(|(t, place)| (t, place as usize))
    };
    for (t, place) in triangles() {
        let (this, best) = (Candidate::new(sheet, t), &mut widest[place]);
        if best.as_ref().is_none_or(|best| this.compare(best) == Ordering::Greater) {
            *best = Some(this);
        }
    }
    let plane = |best: &Candidate| Plane { origin: best.corners[0], normal: sheet.normals[best.triangle], off: 0.0 };
    // Each has a triangle at least: that which clashes.
    let mut known: Vec<Plane> = widest.iter().flatten().map(plane).collect();
    for (t, place) in triangles() {
        let plane = &mut known[place];
        plane.off =
            sheet.triangles[t].iter().fold(plane.off, |o, &v| o.max(plane.height(&sheet.points[v as usize]).abs()));
    }
    Planes { place, known }
}

/// A triangle of a planar face, its corners in ascending order.
struct Candidate {
    width: f64,
    corners: [Vec3; 3],
    triangle: usize,
}

impl Candidate {
    fn new(sheet: &Sheet, triangle: usize) -> Candidate {
        let mut corners = sheet.triangles[triangle].map(|v| sheet.points[v as usize]);
        corners.sort_by(order);
        let [p, q, r] = &corners;
        let sides = [sub(q, p), sub(r, q), sub(p, r)];
        let area = cross(&sides[0], &sides[1]);
        let longest = sides.iter().map(|s| dot(s, s)).fold(0.0, f64::max).sqrt();
        let width = dot(&area, &area).sqrt() / longest;
        Candidate { width: if width.is_nan() { 0.0 } else { width }, corners, triangle }
    }

    fn compare(&self, other: &Candidate) -> Ordering {
        let corners = || self.corners.iter().zip(&other.corners).map(|(a, b)| order(a, b));
        self.width.total_cmp(&other.width).then_with(|| corners().fold(Ordering::Equal, Ordering::then))
    }
}

fn order(a: &Vec3, b: &Vec3) -> Ordering {
    a[0].total_cmp(&b[0]).then_with(|| a[1].total_cmp(&b[1])).then_with(|| a[2].total_cmp(&b[2]))
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::Edges;
    use super::super::search::Clash;
    use super::super::triangle_pair::Meeting;
    use super::*;
    use hlr_mesh::topology;

    #[test]
    fn a_face_is_as_certain_as_its_widest_triangle_in_any_order() {
        // A square, of which one corner lies a little too high, and a sliver at its side that is tilted by it.
        let points = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0], [4.0, -0.01, 0.002]];
        let triangles = [[0, 4, 1], [0, 1, 2], [0, 2, 3]];
        for turn in 0..3 {
            let mut triangles = triangles;
            triangles.rotate_left(turn);
            let normals = topology::normals(&points, &triangles);
            let edges = Edges { edges: &[], offsets: &[0], incident: &[] };
            let sheet = Sheet::new(&points, (&triangles, &normals), (edges, &[]));
            let meeting = Meeting { ends: [[0; 3]; 2], depth: 0.0, sine: 1.0 };
            let found = planes(&sheet, &[7, 7, 7], &[Clash { triangles: [0, 1], meeting }]);
            assert_eq!(found.get(7).unwrap().normal, [0.0, 0.0, 1.0]);
            assert_eq!(found.get(7).unwrap().off, 0.002);
        }
    }
}
