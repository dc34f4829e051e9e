//! What triangles enclose: their area as a vector, which is zero where they close, and their volume.

use crate::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub};
use crate::tessellate::MeshedFace;

/// Sums over triangles as seen from a point. `size`: their area; `volume`: six times that of the cones over them.
pub struct Enclosed {
    from: Vector,
    pub area: Vector,
    pub size: f64,
    pub volume: f64,
}

impl Enclosed {
    pub fn seen_from(from: Vector) -> Enclosed {
        Enclosed { from, area: [0.0; 3], size: 0.0, volume: 0.0 }
    }

    /// Adds the triangles of a face; those of a reversed one look the other way.
    pub fn add(&mut self, face: &MeshedFace, reversed: bool) {
        self.each(face, reversed, Enclosed::add_triangle);
    }

    /// Adds what lies below the plane through the point from which they are seen.
    pub fn add_below(&mut self, face: &MeshedFace, reversed: bool, normal: &Vector) {
        self.each(face, reversed, |sum, t| {
            let height = t.map(|p| dot(&p, normal));
            let mut kept: Vec<Vector> = Vec::with_capacity(4);
            for k in 0..3 {
                let n = (k + 1) % 3;
                if height[k] <= 0.0 {
                    kept.push(t[k]);
                }
                if (height[k] <= 0.0) != (height[n] <= 0.0) {
                    kept.push(along(&t[k], &sub(&t[n], &t[k]), height[k] / (height[k] - height[n])));
                }
            }
            for k in 2..kept.len() {
                sum.add_triangle([kept[0], kept[k - 1], kept[k]]);
            }
        });
    }

    fn each(&mut self, face: &MeshedFace, reversed: bool, mut add: impl FnMut(&mut Enclosed, [Vector; 3])) {
        let from = self.from;
        for &[a, b, c] in &face.mesh.triangles {
            let t = if reversed { [a, c, b] } else { [a, b, c] };
            add(self, t.map(|i| sub(&face.mesh.points[i as usize], &from)));
        }
    }

    fn add_triangle(&mut self, [a, b, c]: [Vector; 3]) {
        let area = scaled(&cross(&sub(&b, &a), &sub(&c, &a)), 0.5);
        self.area = add(&self.area, &area);
        self.size += length(&area);
        self.volume += dot(&a, &cross(&b, &c));
    }
}
