//! The polygon table: which way each triangle faces, and whether it is counted.

use rayon::prelude::*;

use super::mesh::Mesh;
use crate::boxes::aabb::Aabb;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::orient2d;

/// Angle to the line of sight, in radians, up to which a triangle counts as edge-on: its file rounds its corners.
const ALMOST: f64 = 2e-5;

/// Twice a triangle's area in the image over its larger extent (in x or y), in grid units: roughly its height. Up to
/// this, rounding the corners may have turned the triangle over.
const NEEDLE: i128 = 2;

const FRONT: u8 = 1;
const BACK: u8 = 2;
const ALMOST_EDGE_ON: u8 = 4;
const COUNTED: u8 = 8;

/// Triangles that one thread looks at in one go.
const TRIANGLES_AT_ONCE: usize = 1 << 12;

pub struct PolygonTable {
    /// Per triangle what is known of it, as bits: one byte is all that an edge reads of a triangle beside it.
    bits: Vec<u8>,
    pub culled: usize,
    /// Per group.
    pub extents: Vec<Extent>,
}

/// How far a group reaches.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Around all its triangles.
    pub bounds: Aabb,
    /// Depth of the farthest corner of its counted triangles.
    pub farthest: i32,
}

impl Extent {
    const NONE: Extent = Extent { bounds: Aabb::EMPTY, farthest: i32::MIN };

    fn union(&self, other: &Extent) -> Extent {
        Extent { bounds: self.bounds.union(&other.bounds), farthest: self.farthest.max(other.farthest) }
    }
}

impl PolygonTable {
    pub fn new<A: Arithmetic>(mesh: &Mesh) -> PolygonTable {
        let mut bits = vec![0u8; mesh.triangles.len()];
        let found: Vec<(usize, Vec<(i32, Extent)>)> = bits
            .par_chunks_mut(TRIANGLES_AT_ONCE)
            .enumerate()
            .map(|(chunk, bits)| {
                let (mut culled, mut extents) = (0, Vec::new());
                let mut own = (-1, Extent::NONE);
                for (t, bits) in (chunk * TRIANGLES_AT_ONCE..).zip(bits) {
                    let (p, q, r) = mesh.corners(t);
                    let group = mesh.triangle_group[t];
                    // The triangles of a group stand together.
                    if group != own.0 {
                        extents.push(own);
                        own = (group, Extent::NONE);
                    }
                    let bounds = Aabb::of(&[p, q, r]);
                    own.1.bounds = own.1.bounds.union(&bounds);
                    let facing = orient2d::<A>(p, q, r).sign();
                    if facing == 0 {
                        continue;
                    }
                    let cull = mesh.groups[group as usize].cull;
                    *bits = if facing > 0 {
                        FRONT | COUNTED
                    } else if cull {
                        BACK
                    } else {
                        BACK | COUNTED
                    };
                    culled += usize::from(facing < 0 && cull);
                    if almost_edge_on((p, q, r)) {
                        *bits |= ALMOST_EDGE_ON;
                    }
                    if *bits & COUNTED != 0 {
                        own.1.farthest = own.1.farthest.max(bounds.high[2]);
                    }
                }
                extents.push(own);
                (culled, extents)
            })
            .collect();
        let mut extents = vec![Extent::NONE; mesh.groups.len()];
        for (group, own) in found.iter().flat_map(|f| &f.1).filter(|(group, _)| *group >= 0) {
            let whole = &mut extents[*group as usize];
            *whole = whole.union(own);
        }
        PolygonTable { bits, culled: found.iter().map(|f| f.0).sum(), extents }
    }

    /// Mean height in the image of counted triangles, in grid units, estimated from some of them.
    pub fn mean_height(&self, mesh: &Mesh) -> f64 {
        const EVERY: usize = 61;
        let (mut count, mut sum) = (0u64, 0u64);
        for t in (0..mesh.triangles.len()).step_by(EVERY).filter(|&t| self.counted(t)) {
            let (p, q, r) = mesh.corners(t);
            count += 1;
            sum += u64::from(p[1].max(q[1]).max(r[1]).abs_diff(p[1].min(q[1]).min(r[1])));
        }
        sum as f64 / count.max(1) as f64
    }

    /// +1 toward the viewer, -1 away, 0 edge-on.
    #[inline(always)]
    pub fn facing(&self, triangle: usize) -> i8 {
        facing(self.bits[triangle])
    }

    /// `facing` of all triangles.
    pub fn all_facing(&self) -> Vec<i8> {
        self.bits.par_iter().with_min_len(1 << 16).map(|&bits| facing(bits)).collect()
    }

    /// Edge-on except for rounding in its file, although `facing` is not 0.
    #[inline(always)]
    pub fn almost_edge_on(&self, triangle: usize) -> bool {
        self.bits[triangle] & ALMOST_EDGE_ON != 0
    }

    /// Whether culling hides an edge of these triangles without any search: all are turned away, and none of them by
    /// rounding alone.
    pub fn turned_away(&self, mesh: &Mesh, triangles: &[i32]) -> bool {
        let away = |&t: &i32| self.facing(t as usize) < 0 && !is_needle(mesh.corners(t as usize));
        !triangles.is_empty() && triangles.iter().all(away)
    }

    /// Counted in front of others: not edge-on, and facing the viewer where its group allows culling. A line of sight
    /// that meets a closed solid from outside meets a face toward the viewer first, so the others add nothing to
    /// the question whether anything is in front.
    #[inline(always)]
    pub fn counted(&self, triangle: usize) -> bool {
        self.bits[triangle] & COUNTED != 0
    }
}

/// Whether a group's polygons are left out. behind: per group; empty: none are.
#[inline(always)]
pub fn is_left_out(behind: &[bool], group: i32) -> bool {
    behind.get(group as usize) == Some(&true)
}

#[inline(always)]
fn facing(bits: u8) -> i8 {
    (bits & FRONT) as i8 - ((bits & BACK) >> 1) as i8
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
    use super::{BACK, PolygonTable, is_needle};
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
            crossing: &[],
            role: &[],
            groups: Vec::new(),
        };
        PolygonTable { bits: vec![BACK; 2], culled: 2, extents: Vec::new() }.turned_away(&mesh, &[0, 1])
    }

    #[test]
    fn an_edge_beside_a_needle_is_not_hidden_by_culling_alone() {
        assert!(hidden_beside(1000));
        assert!(!hidden_beside(1) && !hidden_beside(0));
    }
}
