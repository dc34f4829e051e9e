//! The planes of planar faces: each is as certain as the whole face is wide, not as one sliver of its triangulation.

use std::cmp::Ordering;
use std::collections::HashMap;

use super::reach::{Sheet, Vec3, cross, dot, minus};
use super::search::{Clash, NO_PLANE};

/// `off`: how far corners of the face lie off this plane.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub origin: Vec3,
    pub normal: Vec3,
    pub off: f64,
}

impl Plane {
    pub fn height(&self, p: &Vec3) -> f64 {
        dot(&minus(p, &self.origin), &self.normal)
    }
}

/// The planes of the planar faces that take part in a clash. `face`: per triangle its planar face, or NO_PLANE.
///
/// Each is the plane of its widest triangle; of equally wide ones, of that whose corners come last. So the order of
/// triangles does not matter.
pub fn planes(sheet: &Sheet, face: &[i32], found: &[Clash]) -> HashMap<i32, Plane> {
    let clashing = found.iter().flat_map(|clash| clash.triangles).map(|t| face[t as usize]);
    let mut widest: HashMap<i32, Option<Candidate>> = clashing.filter(|&f| f != NO_PLANE).map(|f| (f, None)).collect();
    if widest.is_empty() {
        return HashMap::new();
    }
    for (t, f) in face.iter().enumerate() {
        if let Some(best) = widest.get_mut(f) {
            let this = Candidate::new(sheet, t);
            if best.as_ref().is_none_or(|best| this.compare(best) == Ordering::Greater) {
                *best = Some(this);
            }
        }
    }
    let plane = |best: &Candidate| Plane { origin: best.corners[0], normal: sheet.normals[best.triangle], off: 0.0 };
    let mut planes: HashMap<i32, Plane> = widest.iter().filter_map(|(&f, c)| Some((f, plane(c.as_ref()?)))).collect();
    for (triangle, f) in sheet.triangles.iter().zip(face) {
        if let Some(plane) = planes.get_mut(f) {
            plane.off =
                triangle.iter().fold(plane.off, |off, &v| off.max(plane.height(&sheet.points[v as usize]).abs()));
        }
    }
    planes
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
        let sides = [minus(q, p), minus(r, q), minus(p, r)];
        let area = cross(&sides[0], &sides[1]);
        let longest = sides.iter().map(|s| dot(s, s)).fold(0.0, f64::max).sqrt();
        let width = dot(&area, &area).sqrt() / longest;
        Candidate { width: if width.is_nan() { 0.0 } else { width }, corners, triangle }
    }

    fn compare(&self, other: &Candidate) -> Ordering {
        let corners = self.corners.iter().zip(&other.corners).map(|(a, b)| order(a, b));
        self.width.total_cmp(&other.width).then(corners.fold(Ordering::Equal, Ordering::then))
    }
}

fn order(a: &Vec3, b: &Vec3) -> Ordering {
    a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).fold(Ordering::Equal, Ordering::then)
}

#[cfg(test)]
mod tests {
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
            let sheet = Sheet {
                points: &points,
                triangles: &triangles,
                edges: &[],
                offsets: &[],
                incident: &[],
                normals: &normals,
            };
            let meeting = Meeting { ends: [[0; 3]; 2], depth: 0.0, sine: 1.0 };
            let found = planes(&sheet, &[7, 7, 7], &[Clash { triangles: [0, 1], meeting }]);
            assert_eq!(found[&7].normal, [0.0, 0.0, 1.0]);
            assert_eq!(found[&7].off, 0.002);
        }
    }
}
