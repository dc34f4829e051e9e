//! Whether the mesh of a piece is joined beside the plane of its cut.

use rustc_hash::FxHashMap;

use super::plane::{Plane, ROUNDING};
use crate::explore::Part;
use crate::geometry::vector::{Vector, length, sub};
use crate::tessellate::MeshedFace;

/// Whether each side of a triangle of a piece is there as often the other way round, where both of its ends are so near
/// the plane. A strip between the plane and a seam beside it may be too narrow to be meshed with the rest of its face,
/// and has too little area to be missed.
pub fn is_joined(part: &Part, faces: &[MeshedFace], plane: &Plane, near: f64) -> bool {
    let mut places = Places::new(part, faces);
    let mut sides: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for placed in &part.faces {
        let mesh = &faces[placed.face as usize].mesh;
        let mut number = |p: &Vector| (plane.height(p).abs() <= near).then(|| places.number(p));
        let numbers: Vec<Option<u32>> = mesh.points.iter().map(&mut number).collect();
        for t in &mesh.triangles {
            for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                let (Some(a), Some(b)) = (numbers[a as usize], numbers[b as usize]) else { continue };
                if a != b {
                    let ahead = (a < b) != placed.reversed;
                    *sides.entry([a.min(b), a.max(b)]).or_insert(0) += if ahead { 1 } else { -1 };
                }
            }
        }
    }
    sides.values().all(|&count| count == 0)
}

/// Places, each with a number. An edge and a vertex at its end may give the same place with other last digits.
struct Places {
    /// How far two points in one place may be apart.
    apart: f64,
    numbers: FxHashMap<[u64; 3], u32>,
    /// By the cell of a grid of that width: the points that came first to their place.
    cells: FxHashMap<[i64; 3], Vec<(Vector, u32)>>,
}

impl Places {
    fn new(part: &Part, faces: &[MeshedFace]) -> Places {
        let points = part.faces.iter().flat_map(|placed| &faces[placed.face as usize].mesh.points);
        let farthest = points.flatten().fold(0.0_f64, |most, c| most.max(c.abs()));
        Places { apart: ROUNDING * farthest, numbers: FxHashMap::default(), cells: FxHashMap::default() }
    }

    fn number(&mut self, point: &Vector) -> u32 {
        let bits = point.map(|c| (c + 0.0).to_bits());
        if let Some(&found) = self.numbers.get(&bits) {
            return found;
        }
        let cell = point.map(|c| (c / self.apart).floor() as i64);
        let known = self.known(point, cell);
        let number = known.unwrap_or(self.numbers.len() as u32);
        if known.is_none() {
            self.cells.entry(cell).or_default().push((*point, number));
        }
        self.numbers.insert(bits, number);
        number
    }

    /// The number of a place that a point is in.
    fn known(&self, point: &Vector, [x, y, z]: [i64; 3]) -> Option<u32> {
        let beside = |c: i64| (c.saturating_sub(1))..=(c.saturating_add(1));
        let cells = beside(x).flat_map(|x| beside(y).flat_map(move |y| beside(z).map(move |z| [x, y, z])));
        let mut near = cells.filter_map(|cell| self.cells.get(&cell)).flatten();
        near.find(|(other, _)| length(&sub(point, other)) <= self.apart).map(|&(_, number)| number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_differ_by_rounding_are_in_one_place() {
        let mut places = Places { apart: 1e-13, numbers: FxHashMap::default(), cells: FxHashMap::default() };
        let corner = places.number(&[-0.05, 0.0, 0.6]);
        assert_eq!(places.number(&[-0.049_999_999_999_999_82, -0.0, 0.6]), corner);
        let beside = places.number(&[-0.05, 1e-9, 0.6]);
        assert_ne!(beside, corner);
        assert_eq!(places.number(&[-0.05, 1.000_01e-9, 0.6]), beside);
    }
}
