//! Triangulates faces of more than three corners.
//!
//! A fan where that lies within the face, else ear clipping (G. H. Meisters, "Polygons have ears", 1975). Every side of
//! a face stays a side of its triangles, also where three corners lie on one line: the neighbours use them all.

use super::{Fault, Stop};

/// Corners beyond this are not looked at closely: what takes so many is a fan, or was made to take long.
const MOST_CORNERS: usize = 4096;

/// Triangles, and for each its face; None where face and triangle are one and the same.
pub type Cut = (Vec<[i32; 3]>, Option<Vec<u32>>);

/// Corners of faces, one face after another.
#[derive(Default)]
pub struct Faces {
    corners: Vec<i32>,
    /// Where faces end; empty while all are triangles.
    ends: Vec<usize>,
}

impl Faces {
    pub fn len(&self) -> usize {
        if self.ends.is_empty() { self.corners.len() / 3 } else { self.ends.len() }
    }

    /// A face; none of fewer than three corners. Numbers that do not fit become -1.
    pub fn push(&mut self, face: &[i64]) -> bool {
        if face.len() < 3 {
            return false;
        }
        if face.len() != 3 && self.ends.is_empty() {
            self.ends = (1..=self.corners.len() / 3).map(|k| 3 * k).collect();
        }
        self.corners.extend(face.iter().map(|&v| i32::try_from(v).unwrap_or(-1)));
        if face.len() != 3 || !self.ends.is_empty() {
            self.ends.push(self.corners.len());
        }
        true
    }

    /// Triangles of all faces in order, and for each its face; None where face and triangle are one and the same.
    pub fn triangles(self, points: &[[f64; 3]], stop: Stop) -> Result<Cut, Fault> {
        if self.ends.is_empty() {
            return Ok((self.corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(), None));
        }
        let (mut out, mut face) = (Vec::with_capacity(self.corners.len() / 2), Vec::new());
        let mut first = 0;
        for (k, &end) in self.ends.iter().enumerate() {
            super::polled(k, stop)?;
            divided(points, &self.corners[first..end], &mut out);
            face.resize(out.len(), k as u32);
            first = end;
        }
        Ok((out, Some(face)))
    }
}

/// Adds the triangles of one face, oriented as the face is.
fn divided(points: &[[f64; 3]], face: &[i32], out: &mut Vec<[i32; 3]>) {
    let fan = |out: &mut Vec<[i32; 3]>| out.extend((2..face.len()).map(|k| [face[0], face[k - 1], face[k]]));
    if face.len() == 3 || face.len() > MOST_CORNERS {
        return fan(out);
    }
    let Some(flat) = flattened(points, face) else { return fan(out) };
    let turn = |a: usize, b: usize, c: usize| turn(flat[a], flat[b], flat[c]);
    if (2..face.len()).all(|k| turn(0, k - 1, k) >= 0.0) {
        return fan(out);
    }
    let mut ring: Vec<usize> = (0..face.len()).collect();
    let before = out.len();
    while ring.len() > 3 {
        let n = ring.len();
        let corner = |k: usize| [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
        let ear = (0..n).find(|&k| {
            let [a, b, c] = corner(k);
            turn(a, b, c) > 0.0
                && ring.iter().all(|&i| {
                    [a, b, c].contains(&i) || turn(a, b, i) < 0.0 || turn(b, c, i) < 0.0 || turn(c, a, i) < 0.0
                })
        });
        let Some(ear) = ear else {
            // The face crosses or touches itself: no triangulation is right.
            out.truncate(before);
            return fan(out);
        };
        out.push(corner(ear).map(|i| face[i]));
        ring.remove(ear);
    }
    out.push([ring[0], ring[1], ring[2]].map(|i| face[i]));
}

/// Projects the corners along the face's normal, so that it runs counter-clockwise; None where a corner does not exist
/// or the face has no area.
fn flattened(points: &[[f64; 3]], face: &[i32]) -> Option<Vec<[f64; 2]>> {
    let at: Option<Vec<[f64; 3]>> = face.iter().map(|&v| points.get(usize::try_from(v).ok()?).copied()).collect();
    let at = at?;
    let origin = at[0];
    let near = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] - origin[k]);
    let mut normal = [0.0; 3];
    for (k, &p) in at.iter().enumerate() {
        let (p, q) = (near(p), near(at[(k + 1) % at.len()]));
        for (c, n) in normal.iter_mut().enumerate() {
            let (i, j) = ((c + 1) % 3, (c + 2) % 3);
            *n += p[i] * q[j] - p[j] * q[i];
        }
    }
    let most = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
    if !(normal[most].abs() > 0.0 && normal[most].is_finite()) {
        return None;
    }
    let (i, j) = ((most + 1) % 3, (most + 2) % 3);
    let (i, j) = if normal[most] > 0.0 { (i, j) } else { (j, i) };
    Some(at.into_iter().map(near).map(|p| [p[i], p[j]]).collect())
}

fn turn(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(points: &[[f64; 3]], faces: &[&[i64]]) -> (Vec<[i32; 3]>, Option<Vec<u32>>) {
        let mut all = Faces::default();
        faces.iter().for_each(|face| assert!(all.push(face)));
        all.triangles(points, &|| false).unwrap()
    }

    #[test]
    fn a_convex_face_is_a_fan() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let (found, face) = triangles(&square, &[&[0, 1, 2], &[0, 1, 2, 3]]);
        assert_eq!((found, face), (vec![[0, 1, 2], [0, 1, 2], [0, 2, 3]], Some(vec![0, 1, 1])));
        assert_eq!(triangles(&square, &[&[0, 1, 2]]), (vec![[0, 1, 2]], None));
    }

    #[test]
    fn a_concave_face_keeps_its_area_and_all_its_corners() {
        // An L, standing, with a corner in the middle of a side.
        let l: Vec<[f64; 3]> = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [0, 1]]
            .map(|[x, z]| [f64::from(x), 5.0, f64::from(z)])
            .to_vec();
        for shift in 0..7 {
            let face: Vec<i64> = (0..7).map(|k| (k + shift) % 7).collect();
            let (found, _) = triangles(&l, &[&face]);
            assert_eq!(found.len(), 5);
            let area = |t: &[i32; 3]| {
                let [p, q, r] = t.map(|v| [l[v as usize][0], l[v as usize][2]]);
                turn(p, q, r)
            };
            assert!(found.iter().all(|t| area(t) >= 0.0), "{found:?}");
            assert_eq!(found.iter().map(area).sum::<f64>(), 6.0);
        }
    }

    #[test]
    fn what_has_no_triangulation_is_a_fan() {
        let bow = [[0.0, 0.0, 0.0], [4.0, 4.0, 0.0], [4.0, 0.0, 0.0], [0.0, 5.0, 0.0], [f64::NAN; 3]];
        assert_eq!(triangles(&bow, &[&[0, 1, 2, 3]]).0.len(), 2);
        assert_eq!(triangles(&bow, &[&[0, 1, 2, 4]]).0.len(), 2);
        assert_eq!(triangles(&bow, &[&[0, 1, 2, 9]]).0, [[0, 1, 2], [0, 2, 9]]);
        assert_eq!(triangles(&bow, &[&[0, 1, 2, i64::MAX]]).0, [[0, 1, 2], [0, 2, -1]]);
        assert!(!Faces::default().push(&[0, 1]));
    }
}
