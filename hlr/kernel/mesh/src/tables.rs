//! The meshes of all parts, one after another.

use std::ops::Range;

use hlr_brep::assemble::PartMesh;
use hlr_brep::format::{IDENTITY, Matrix};

use super::clean::clean;

/// Part p owns points[point_start[p]..point_start[p + 1]] and so on. Triangles, nodes of edges and corners count
/// through all parts; faces and edges have the numbers that they have in their own part.
#[derive(Clone, Debug, Default)]
pub struct Tables {
    pub point_start: Vec<i32>,
    pub points: Vec<[f64; 3]>,
    pub triangle_start: Vec<i32>,
    pub triangles: Vec<[i32; 3]>,
    pub triangle_face: Vec<i32>,
    /// Per triangle: the triangle of its part, as the source hands it over, that it is or is a piece of.
    pub origin: Vec<i32>,
    pub face_start: Vec<i32>,
    pub face_planar: Vec<bool>,
    /// Polylines: edge_nodes[edge_offsets[e]..edge_offsets[e + 1]] are points.
    pub edge_start: Vec<i32>,
    pub edge_offsets: Vec<i32>,
    pub edge_nodes: Vec<i32>,
    pub edge_index: Vec<i32>,
    pub edge_class: Vec<u8>,
    /// Per part: whether it has faces and edges; whether no two of its points are known to be in one place; its
    /// placement; the error of its coordinates.
    pub brep: Vec<bool>,
    pub joined: Vec<bool>,
    pub transform: Vec<Matrix>,
    pub precision: Vec<f64>,
    /// Per triangle: its corners in `uv`, -1 for parts without surfaces; empty where no part has any.
    pub node_start: Vec<i32>,
    pub corner: Vec<[i32; 3]>,
    pub uv: Vec<[f64; 2]>,
    /// Per face: its surface, -1 for none; the placement of the surface in the part; whether its normal points inward.
    pub face_shape: Vec<i32>,
    pub face_place: Vec<Matrix>,
    pub face_reversed: Vec<bool>,
}

/// There are more items than numbers of 32 bits.
#[derive(Debug)]
pub struct TooMany;

impl Tables {
    pub fn len(&self) -> usize {
        self.brep.len()
    }

    pub fn is_empty(&self) -> bool {
        self.brep.is_empty()
    }

    pub(super) fn open() -> Tables {
        let starts = || vec![0];
        Tables {
            point_start: starts(),
            triangle_start: starts(),
            face_start: starts(),
            edge_start: starts(),
            edge_offsets: starts(),
            node_start: starts(),
            ..Tables::default()
        }
    }

    /// Ends a part: all that was added since the last end belongs to it.
    fn end(&mut self) -> Result<(), TooMany> {
        let number = |count: usize| i32::try_from(count).map_err(|_| TooMany);
        // Three sides a triangle.
        number(3 * self.triangles.len())?;
        self.point_start.push(number(self.points.len())?);
        self.triangle_start.push(number(self.triangles.len())?);
        self.face_start.push(number(self.face_planar.len())?);
        self.edge_start.push(number(self.edge_index.len())?);
        self.node_start.push(number(self.uv.len())?);
        number(self.edge_nodes.len()).map(|_| ())
    }

    /// Tables of the meshes of roots; `planar`: per underlying face.
    pub fn of_roots(roots: Vec<PartMesh>, planar: &[bool]) -> Result<Tables, TooMany> {
        let mut out = Tables::open();
        for root in roots {
            if root.triangles.is_empty() || !root.edge_index.is_empty() {
                out.add_root(root, planar);
            } else {
                out.add_bare(&root);
            }
            out.transform.push(IDENTITY);
            out.precision.push(0.0);
            out.joined.push(false);
            out.end()?;
        }
        Ok(out)
    }

    /// These tables with the chosen triangles alone, and with other points as nodes of the edges.
    pub fn with_triangles(&self, chosen: &[bool], edge_nodes: &[i32]) -> Tables {
        fn keep<T>(rows: &mut Vec<T>, chosen: &[bool]) {
            let mut next = chosen.iter();
            rows.retain(|_| *next.next().unwrap_or(&false));
        }
        let mut out = self.clone();
        keep(&mut out.triangles, chosen);
        keep(&mut out.triangle_face, chosen);
        keep(&mut out.origin, chosen);
        keep(&mut out.corner, chosen);
        let count = |own: &[i32]| chosen[own[0] as usize..own[1] as usize].iter().filter(|&&c| c).count() as i32;
        for (p, own) in self.triangle_start.windows(2).enumerate() {
            out.triangle_start[p + 1] = out.triangle_start[p] + count(own);
        }
        out.edge_nodes = edge_nodes.to_vec();
        out
    }

    fn add_root(&mut self, mut root: PartMesh, planar: &[bool]) {
        let (point, node) = (self.points.len() as i32, self.uv.len() as i32);
        if point > 0 {
            root.triangles.iter_mut().flatten().chain(&mut root.edge_nodes).for_each(|v| *v += point);
        }
        if node > 0 {
            root.corner.iter_mut().flatten().for_each(|i| *i += node);
        }
        self.origin.extend(0..root.triangles.len() as i32);
        self.face_planar.extend(root.face_shape.iter().map(|&i| planar[i as usize]));
        append(&mut self.points, root.points);
        append(&mut self.triangles, root.triangles);
        append(&mut self.triangle_face, root.triangle_face);
        append(&mut self.edge_nodes, root.edge_nodes);
        for count in &root.edge_counts {
            self.edge_offsets.push(self.edge_offsets[self.edge_offsets.len() - 1] + count);
        }
        self.edge_index.extend(&root.edge_index);
        self.edge_class.extend(&root.edge_class);
        self.brep.push(true);
        append(&mut self.corner, root.corner);
        append(&mut self.uv, root.uv);
        self.face_shape.extend(&root.face_shape);
        self.face_place.extend(&root.face_place);
        self.face_reversed.extend(&root.face_reversed);
    }

    /// Adds tessellated geometry: its faces are loose triangles, and what they share must be found by position.
    fn add_bare(&mut self, root: &PartMesh) {
        let (point, faces) = (self.points.len() as i32, root.face_shape.len());
        let found = clean(&root.points, &root.triangles);
        match &found.kept {
            Some(kept) => self.triangle_face.extend(kept.iter().map(|&t| root.triangle_face[t as usize])),
            None => self.triangle_face.extend(&root.triangle_face),
        }
        self.points.extend(&found.points);
        self.triangles.extend(found.triangles.iter().map(|t| t.map(|v| v + point)));
        self.origin.extend(0..found.triangles.len() as i32);
        // A face may be one flat facet of a round surface, so it may show an outline.
        self.face_planar.resize(self.face_planar.len() + faces, false);
        self.brep.push(false);
        self.corner.resize(self.triangles.len(), [-1; 3]);
        self.face_shape.resize(self.face_planar.len(), -1);
        self.face_place.resize(self.face_planar.len(), IDENTITY);
        self.face_reversed.resize(self.face_planar.len(), false);
    }

    /// (t,) the part of each triangle.
    pub fn triangle_part(&self) -> Vec<i32> {
        per_item(&self.triangle_start)
    }

    /// The part of one triangle.
    pub fn part_of_triangle(&self, triangle: i32) -> usize {
        self.triangle_start.partition_point(|&start| start <= triangle) - 1
    }

    /// Whether all coordinates are finite and nearer to the origin than this.
    pub fn within(&self, largest: f64) -> bool {
        self.points.as_flattened().iter().all(|c| c.abs() < largest)
    }
}

/// The items of a part.
pub(super) fn range(start: &[i32], part: usize) -> Range<usize> {
    start[part] as usize..start[part + 1] as usize
}

/// Appends items; the first ones are not copied.
fn append<T>(all: &mut Vec<T>, items: Vec<T>) {
    if all.is_empty() {
        *all = items;
    } else {
        all.extend(items);
    }
}

/// The owner of every item; `start`: the first item of each owner, then the number of items.
pub fn per_item(start: &[i32]) -> Vec<i32> {
    let mut out = Vec::with_capacity(start.last().map_or(0, |&n| n as usize));
    for (owner, w) in (0..).zip(start.windows(2)) {
        out.resize(w[1] as usize, owner);
    }
    out
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub fn one() -> Tables {
        Tables::of_roots(vec![root()], &[true; 4]).unwrap()
    }

    fn root() -> PartMesh {
        PartMesh {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            triangle_face: vec![0, 1, 2, 3],
            edge_nodes: vec![0, 1, 1, 2],
            edge_counts: vec![2, 2],
            edge_index: vec![0, 1],
            edge_class: vec![0, 0],
            corner: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]],
            uv: vec![[0.0; 2]; 12],
            face_shape: vec![0, 1, 2, 3],
            face_place: vec![IDENTITY; 4],
            face_reversed: vec![false; 4],
        }
    }

    #[test]
    fn a_part_of_points_alone_counts_before_another() {
        let wire = || PartMesh { points: vec![[9.0; 3]; 2], ..PartMesh::default() };
        let found = Tables::of_roots(vec![wire(), root()], &[true; 4]).unwrap();
        assert_eq!(found.triangles, one().triangles.iter().map(|t| t.map(|v| v + 2)).collect::<Vec<_>>());
        assert_eq!((&found.edge_nodes[..2], found.corner[0]), (&[2, 3][..], one().corner[0]));
    }

    #[test]
    fn loose_triangles_are_joined_by_place() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0; 3]];
        let root = PartMesh {
            points,
            triangles: vec![[0, 1, 2], [3, 5, 4]],
            triangle_face: vec![0, 1],
            face_shape: vec![0, 1],
            face_place: vec![IDENTITY; 2],
            face_reversed: vec![false; 2],
            ..PartMesh::default()
        };
        let found = Tables::of_roots(vec![root], &[true; 2]).unwrap();
        assert_eq!((found.triangles, found.brep), (vec![[0, 1, 2], [1, 3, 2]], vec![false]));
        assert_eq!((found.face_planar, found.corner), (vec![false; 2], vec![[-1; 3]; 2]));
    }
}
