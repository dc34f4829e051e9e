//! The polygon table: which way each triangle faces, and whether it is counted.

use rayon::prelude::*;

use super::mesh::Mesh;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::orient2d;

/// Angle to the line of sight, in radians, up to which a triangle counts as edge-on: its file rounds its corners.
const ALMOST: f64 = 2e-5;

/// Twice a triangle's area in the image over its larger extent (in x or y), in grid units: roughly its height. Up to
/// this, rounding the corners may have turned the triangle over.
const NEEDLE: i128 = 2;

pub struct PolygonTable {
    /// +1 toward the viewer, -1 away, 0 edge-on.
    pub facing: Vec<i8>,
    /// Edge-on except for rounding in its file, although `facing` is not 0.
    pub almost: Vec<bool>,
    pub culled: usize,
}

impl PolygonTable {
    pub fn new<A: Arithmetic>(mesh: &Mesh) -> PolygonTable {
        let (mut facing, mut almost): (Vec<i8>, Vec<bool>) = (Vec::new(), Vec::new());
        (0..mesh.triangles.len())
            .into_par_iter()
            .map(|t| {
                let (p, q, r) = mesh.corners(t);
                let facing = orient2d::<A>(p, q, r).sign() as i8;
                (facing, facing != 0 && almost_edge_on((p, q, r)))
            })
            .unzip_into_vecs(&mut facing, &mut almost);
        let culled = facing
            .par_iter()
            .zip(mesh.triangle_group)
            .filter(|&(&f, &p)| f < 0 && mesh.groups[p as usize].cull)
            .count();
        PolygonTable { facing, almost, culled }
    }

    /// Whether culling hides an edge of these triangles without any search: all are turned away, and none of them by
    /// rounding alone.
    pub fn turned_away(&self, mesh: &Mesh, triangles: &[i32]) -> bool {
        let away = |&t: &i32| self.facing[t as usize] < 0 && !is_needle(mesh.corners(t as usize));
        !triangles.is_empty() && triangles.iter().all(away)
    }

    /// Counted in front of others: not edge-on, and facing the viewer where its group allows culling. A line of sight
    /// that meets a closed solid from outside meets a face toward the viewer first, so the others add nothing to
    /// the question whether anything is in front.
    #[inline(always)]
    pub fn counted(&self, mesh: &Mesh, triangle: usize) -> bool {
        let f = self.facing[triangle];
        f > 0 || (f < 0 && !mesh.groups[mesh.triangle_group[triangle] as usize].cull)
    }
}

/// Whether a triangle is hardly higher than a grid unit, as between corners in one line, so that rounding decides which
/// way it faces.
fn is_needle((p, q, r): (&Point, &Point, &Point)) -> bool {
    let way = |a: &Point, b: &Point| [0, 1].map(|k| i128::from(b[k]) - i128::from(a[k]));
    let sides = [way(p, q), way(q, r), way(r, p)];
    let area = sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0];
    let longest = sides.iter().flatten().map(|d| d.abs()).max().unwrap_or_default();
    area.abs() <= NEEDLE * longest
}

fn almost_edge_on((p, q, r): (&Point, &Point, &Point)) -> bool {
    let way = |a: &Point| [0, 1, 2].map(|k| f64::from(a[k]) - f64::from(p[k]));
    let (u, v) = (way(q), way(r));
    let [x, y, z] = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    z * z <= ALMOST * ALMOST * (x * x + y * y)
}

#[cfg(test)]
mod tests {
    use super::{PolygonTable, is_needle};
    use crate::scan::mesh::Mesh;
    use hlr_exact::Point;

    #[test]
    fn a_needle_is_no_higher_than_rounding() {
        let needle = |y: i32| is_needle((&[0, 0, 0], &[1_000_000, y, 9], &[2_000_000, 0, -9]));
        assert!(needle(0) && needle(1) && needle(-2));
        assert!(!needle(3) && !needle(-1000));
        assert!(!is_needle((&[0, 0, 0], &[5, 0, 0], &[0, 5, 0])));
    }

    /// Whether culling hides an edge between a triangle that is turned away and one whose third corner is `off` grid
    /// units from the edge.
    fn hidden_beside(off: i32) -> bool {
        let points: Vec<Point> = vec![[0, 0, 0], [1_000_000, 0, 0], [0, 1_000_000, 0], [500_000, -off, 0]];
        let mesh = Mesh {
            points,
            triangles: &[[0, 2, 1], [0, 1, 3]],
            triangle_group: &[0, 0],
            edges: &[],
            offsets: &[0],
            incident: &[],
            edge_group: &[],
            role: &[],
            groups: Vec::new(),
        };
        PolygonTable { facing: vec![-1, -1], almost: vec![false; 2], culled: 2 }.turned_away(&mesh, &[0, 1])
    }

    #[test]
    fn an_edge_beside_a_needle_is_not_hidden_by_culling_alone() {
        assert!(hidden_beside(1000));
        assert!(!hidden_beside(1) && !hidden_beside(0));
    }
}
