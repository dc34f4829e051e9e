//! Tells whether a ray meets a triangle mesh, and where it does so first.
//!
//! T. Moeller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; boxes as in T. Kay, J. Kajiya,
//! "Ray tracing complex scenes", 1986.

use std::cell::Cell;

use hlr_brep::geometry::vector::{cross, dot, sub};

use super::boxes::{Bounds, Tree};

pub type Vec3 = [f64; 3];

pub struct Caster<'a> {
    points: &'a [Vec3],
    triangles: &'a [[i32; 3]],
    tree: Tree<3>,
}

/// Tolerance beyond a triangle's sides, in barycentric coordinates: a ray between two triangles that share an edge
/// meets one of them.
const BESIDE: f64 = 1e-12;

impl<'a> Caster<'a> {
    pub fn new(points: &'a [Vec3], triangles: &'a [[i32; 3]]) -> Self {
        let boxes: Vec<Bounds<3>> = triangles.iter().map(|t| Bounds::of(&t.map(|i| points[i as usize]))).collect();
        Caster { points, triangles, tree: Tree::new(&boxes) }
    }

    /// Whether a triangle meets origin + t * way for some t in 0..1.
    pub fn is_blocked(&self, origin: &Vec3, way: &Vec3) -> bool {
        let inverse = way.map(|c| 1.0 / c);
        let mut hit = false;
        self.tree.walk(
            |bounds, _| bounds.entry(origin, &inverse, 1.0).map(|_| 0.0),
            |i| {
                hit = self.meeting(i, origin, way).is_some();
                hit
            },
        );
        hit
    }

    /// The least t in 0..1 at which a triangle meets origin + t * way, and that triangle; of several, the first.
    pub fn first(&self, origin: &Vec3, way: &Vec3) -> Option<(f64, u32)> {
        let inverse = way.map(|c| 1.0 / c);
        let best = Cell::new(None::<(f64, u32)>);
        self.tree.walk(
            |bounds, _| bounds.entry(origin, &inverse, best.get().map_or(1.0, |(t, _)| t)),
            |i| {
                let nearer = |t: &f64| best.get().is_none_or(|known| (*t, i) < known);
                if let Some(t) = self.meeting(i, origin, way).filter(nearer) {
                    best.set(Some((t, i)));
                }
                false
            },
        );
        best.get()
    }

    /// The t in 0..1 at which a triangle meets origin + t * way.
    fn meeting(&self, triangle: u32, origin: &Vec3, way: &Vec3) -> Option<f64> {
        let [a, b, c] = self.triangles[triangle as usize].map(|i| &self.points[i as usize]);
        let (ab, ac) = (sub(b, a), sub(c, a));
        let across = cross(way, &ac);
        let volume = dot(&ab, &across);
        if volume == 0.0 {
            return None;
        }
        let from = sub(origin, a);
        let u = dot(&from, &across) / volume;
        let q = cross(&from, &ab);
        let v = dot(way, &q) / volume;
        let t = dot(&ac, &q) / volume;
        (u >= -BESIDE && v >= -BESIDE && u + v <= 1.0 + BESIDE && (0.0..=1.0).contains(&t)).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_blocks_what_passes_through_it() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let caster = Caster::new(&points, &triangles);
        for (x, y, inside) in [(0.3, 0.2, true), (0.5, 0.5, true), (0.2, 0.9, true), (1.1, 0.5, false)] {
            assert_eq!(caster.is_blocked(&[x, y, -1.0], &[0.0, 0.0, 2.0]), inside);
            assert_eq!(caster.is_blocked(&[x, y, 1.0], &[0.0, 0.0, -2.0]), inside);
            assert!(!caster.is_blocked(&[x, y, -1.0], &[0.0, 0.0, 0.9]), "it ends before");
            assert!(!caster.is_blocked(&[x, y, 1.0], &[0.0, 0.0, 2.0]), "it runs away");
        }
    }

    #[test]
    fn the_first_of_many_squares_is_met() {
        let n = 60;
        let depth = |k: usize| ((k * 37) % n) as f64;
        let points: Vec<Vec3> = (0..n)
            .flat_map(|k| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [x, y, depth(k)]))
            .collect();
        let triangles: Vec<[i32; 3]> =
            (0..n as i32).flat_map(|k| [[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]]).collect();
        let caster = Caster::new(&points, &triangles);
        for start in 0..n - 1 {
            let way = [0.0, 0.0, 100.0];
            let (t, triangle) = caster.first(&[0.7, 0.2, start as f64 + 0.5], &way).expect("there are squares ahead");
            assert!((t * 100.0 - 0.5).abs() < 1e-9);
            assert_eq!(depth(triangle as usize / 2), start as f64 + 1.0);
        }
        assert_eq!(caster.first(&[0.7, 0.2, n as f64], &[0.0, 0.0, 100.0]), None);
        assert_eq!(caster.first(&[0.7, 0.2, -1.0], &[0.0, 0.0, 0.9]), None);
    }

    #[test]
    fn no_ray_slips_through_a_seam() {
        let n = 40;
        let at = |i: usize, j: usize| {
            let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
            [x + 0.003 * (7.0 * y).sin(), y + 0.003 * (5.0 * x).cos(), 0.1 * (x * 6.0).sin() * (y * 5.0).cos()]
        };
        let points: Vec<Vec3> = (0..=n).flat_map(|i| (0..=n).map(move |j| at(i, j))).collect();
        let number = |i: usize, j: usize| (i * (n + 1) + j) as i32;
        let triangles: Vec<[i32; 3]> = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                let (a, b, c, d) = (number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let caster = Caster::new(&points, &triangles);
        // Through edges and vertices themselves.
        for t in &triangles {
            let [a, b, _] = t.map(|i| points[i as usize]);
            for p in [a, [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))] {
                if (0.1..0.9).contains(&p[0]) && (0.1..0.9).contains(&p[1]) {
                    assert!(caster.is_blocked(&[p[0], p[1], 1.0], &[0.0, 0.0, -2.0]), "{p:?}");
                }
            }
        }
    }
}
