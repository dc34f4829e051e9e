//! The meshes of parts, each at its placement.

use hlr_brep::format::{IDENTITY, Matrix, moved};

use super::tables::{Tables, TooMany, range};

/// The placement of a part, and its number among the parts of the tables.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub part: usize,
    pub transform: Matrix,
    pub precision: f64,
}

impl Tables {
    /// Whether these are all parts as they are, each once and where it stands.
    pub fn are_all(&self, parts: &[Placed]) -> bool {
        let own = |(p, placed): (usize, &Placed)| {
            let moved = placed.transform != IDENTITY || self.transform[p] != IDENTITY;
            placed.part == p && !moved && placed.precision == self.precision[p]
        };
        parts.len() == self.len() && parts.iter().enumerate().all(own)
    }

    /// Returns these parts, each at its placement; triangles of mirrored ones are reversed.
    pub fn placed(&self, parts: &[Placed]) -> Result<Tables, TooMany> {
        let mut out = Tables {
            point_start: starts(&self.point_start, parts, 1)?,
            // Three sides a triangle.
            triangle_start: starts(&self.triangle_start, parts, 3)?,
            face_start: starts(&self.face_start, parts, 1)?,
            edge_start: starts(&self.edge_start, parts, 1)?,
            node_start: starts(&self.node_start, parts, 1)?,
            ..Tables::open()
        };
        let of_triangles = |rows: &[i32]| gathered(&self.triangle_start, rows, parts);
        let ((points, uv), ((triangles, corner), (face, origin))) = rayon::join(
            || (self.placed_points(parts), gathered(&self.node_start, &self.uv, parts)),
            || (self.placed_triangles(parts, &out), (of_triangles(&self.triangle_face), of_triangles(&self.origin))),
        );
        (out.points, out.uv, out.triangles, out.corner) = (points, uv, triangles, corner);
        (out.triangle_face, out.origin) = (face, origin);
        out.face_planar = gathered(&self.face_start, &self.face_planar, parts);
        out.face_shape = gathered(&self.face_start, &self.face_shape, parts);
        out.face_place = gathered(&self.face_start, &self.face_place, parts);
        out.face_reversed = gathered(&self.face_start, &self.face_reversed, parts);
        out.edge_index = gathered(&self.edge_start, &self.edge_index, parts);
        out.edge_class = gathered(&self.edge_start, &self.edge_class, parts);
        out.add_polylines(self, parts)?;
        out.brep = parts.iter().map(|placed| self.brep[placed.part]).collect();
        out.joined = parts.iter().map(|placed| self.joined[placed.part]).collect();
        out.transform = parts.iter().map(|placed| placed.transform).collect();
        out.precision = parts.iter().map(|placed| placed.precision).collect();
        Ok(out)
    }

    fn placed_points(&self, parts: &[Placed]) -> Vec<[f64; 3]> {
        let mut out = Vec::with_capacity(count(&self.point_start, parts));
        for Placed { part, transform, .. } in parts {
            let own = &self.points[range(&self.point_start, *part)];
            if *transform == IDENTITY {
                out.extend(own);
            } else {
                out.extend(own.iter().map(|p| moved(transform, p)));
            }
        }
        out
    }

    /// Triangles and their corners in the parameter plane; `starts`: where the placed parts begin.
    fn placed_triangles(&self, parts: &[Placed], starts: &Tables) -> (Vec<[i32; 3]>, Vec<[i32; 3]>) {
        let room = count(&self.triangle_start, parts);
        let mut triangles = Vec::with_capacity(room);
        let mut corner = Vec::with_capacity(if self.corner.is_empty() { 0 } else { room });
        for (i, placed) in parts.iter().enumerate() {
            let (part, own) = (placed.part, range(&self.triangle_start, placed.part));
            let point = starts.point_start[i] - self.point_start[part];
            let node = starts.node_start[i] - self.node_start[part];
            let mirrored = mirrors(&placed.transform);
            let turned = |t: [i32; 3]| if mirrored { [t[0], t[2], t[1]] } else { t };
            triangles.extend(self.triangles[own.clone()].iter().map(|t| turned(t.map(|v| v + point))));
            if !self.corner.is_empty() {
                let placed = |c: &[i32; 3]| turned(c.map(|i| if i < 0 { i } else { i + node }));
                corner.extend(self.corner[own].iter().map(placed));
            }
        }
        (triangles, corner)
    }

    /// Adds the edges' polylines; the starts of points are known.
    fn add_polylines(&mut self, of: &Tables, parts: &[Placed]) -> Result<(), TooMany> {
        for (i, placed) in parts.iter().enumerate() {
            let edges = range(&of.edge_start, placed.part);
            let offsets = &of.edge_offsets[edges.start..=edges.end];
            let shift = self.edge_nodes.len() as i32 - offsets[0];
            self.edge_offsets.extend(offsets[1..].iter().map(|o| o + shift));
            let point = self.point_start[i] - of.point_start[placed.part];
            let chain = offsets[0] as usize..offsets[offsets.len() - 1] as usize;
            self.edge_nodes.extend(of.edge_nodes[chain].iter().map(|v| v + point));
            i32::try_from(self.edge_nodes.len()).map_err(|_| TooMany)?;
        }
        Ok(())
    }
}

/// How many items these parts have.
fn count(start: &[i32], parts: &[Placed]) -> usize {
    parts.iter().map(|placed| range(start, placed.part).len()).sum()
}

/// Where the items of each of these parts start, then their number; an error where `times` as many have no number.
fn starts(start: &[i32], parts: &[Placed], times: usize) -> Result<Vec<i32>, TooMany> {
    i32::try_from(times * count(start, parts)).map_err(|_| TooMany)?;
    let mut out = Vec::with_capacity(parts.len() + 1);
    out.push(0);
    for (before, placed) in parts.iter().enumerate() {
        out.push(out[before] + range(start, placed.part).len() as i32);
    }
    Ok(out)
}

/// The rows of these parts, one part after another; none where the table has none.
fn gathered<T: Copy>(start: &[i32], rows: &[T], parts: &[Placed]) -> Vec<T> {
    if rows.is_empty() {
        return Vec::new();
    }
    let mut out = Vec::with_capacity(count(start, parts));
    parts.iter().for_each(|placed| out.extend(&rows[range(start, placed.part)]));
    out
}

fn mirrors(m: &Matrix) -> bool {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
        < 0.0
}

#[cfg(test)]
mod tests {
    use super::super::tables::tests::one;
    use super::*;

    #[test]
    fn a_mirrored_copy_is_turned_round() {
        let mirror = [[-1.0, 0.0, 0.0, 5.0], IDENTITY[1], IDENTITY[2]];
        let at = |transform| Placed { part: 0, transform, precision: 0.0 };
        let found = one().placed(&[at(IDENTITY), at(mirror)]).unwrap();
        assert_eq!((found.points[1], found.points[5]), ([1.0, 0.0, 0.0], [4.0, 0.0, 0.0]));
        assert_eq!((found.triangles[1], found.triangles[5]), ([0, 1, 3], [4, 7, 5]));
        assert_eq!((found.corner[1], found.corner[5]), ([3, 4, 5], [15, 17, 16]));
        assert_eq!((found.edge_offsets, found.edge_nodes), (vec![0, 2, 4, 6, 8], vec![0, 1, 1, 2, 4, 5, 5, 6]));
        assert_eq!(found.point_start, [0, 4, 8]);
    }

    #[test]
    fn parts_that_stay_as_they_are_are_told_from_moved_ones() {
        let place = [[1.0, 0.0, 0.0, 5.0], IDENTITY[1], IDENTITY[2]];
        let at = |part, transform, precision| Placed { part, transform, precision };
        let (alone, still) = (one(), at(0, IDENTITY, 0.0));
        assert!(alone.are_all(&[still]));
        for others in [vec![], vec![still, still], vec![at(0, place, 0.0)], vec![at(0, IDENTITY, 1e-3)]] {
            assert!(!alone.are_all(&others), "{others:?}");
        }
        let two = alone.placed(&[still, still]).unwrap();
        assert!(two.are_all(&[still, at(1, IDENTITY, 0.0)]) && !two.are_all(&[at(1, IDENTITY, 0.0), still]));
        let moved = alone.placed(&[at(0, place, 0.0)]).unwrap();
        assert!(!moved.are_all(&[still]) && !moved.are_all(&[at(0, place, 0.0)]));
    }
}
