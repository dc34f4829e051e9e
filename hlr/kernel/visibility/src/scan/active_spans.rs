//! Counts how many polygons lie in front of each end point of a drawn edge: the seeds of the counts along the edges.
//!
//! A point is queried once (`query_points`), however many edges end there: strict answers hold for all of them. Only ties
//! (mostly the faces around the vertex itself) are decided per edge, by the direction in which it leaves.

use std::sync::atomic::AtomicU64;

use rayon::prelude::*;

use super::mesh::Mesh;
use super::polygon_table::{PolygonTable, is_left_out};
use super::query_points::{Count, NONE, Stop, Stops, unpacked};
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::orient2d;

/// Height of a band, and width of a column, in heights of an average polygon.
const POLYGONS_A_BAND: f64 = 0.5;
/// Polygons that one thread looks at in one go.
const POLYGONS_AT_ONCE: usize = 1 << 12;

pub struct Seeds {
    slot: Vec<u32>,
    strict: Vec<Count>,
    tie_offsets: Vec<u32>,
    ties: Vec<u32>,
    pub asked: usize,
}

impl Seeds {
    /// Counts for every end of the given edges. behind: per group, whether its polygons are left out; empty: of none.
    pub fn new<A: Arithmetic>(
        mesh: &Mesh,
        table: &PolygonTable,
        edges: &[u32],
        behind: &[bool],
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Seeds {
        let mut slot = vec![NONE; mesh.points.len()];
        let mut asked: Vec<Stop> = Vec::new();
        for &e in edges {
            for v in mesh.edges[e as usize] {
                if slot[v as usize] == NONE {
                    slot[v as usize] = asked.len() as u32;
                    let (at, group) = (mesh.points[v as usize], mesh.edge_group[e as usize]);
                    asked.push(Stop { at, slot: asked.len() as u32, group });
                }
            }
        }
        let stops = Stops::new(&asked, POLYGONS_A_BAND * table.mean_height(mesh));
        // Sums do not depend on the order in which threads add to them.
        let strict: Vec<AtomicU64> = asked.iter().map(|_| AtomicU64::new(0)).collect();
        let chunks: Vec<usize> = (0..mesh.triangles.len()).step_by(POLYGONS_AT_ONCE).collect();
        let ties: Vec<Vec<(u32, u32)>> = chunks
            .into_par_iter()
            .map(|first| {
                let mut ties = Vec::new();
                if !stopped() {
                    let chunk = first..(first + POLYGONS_AT_ONCE).min(mesh.triangles.len());
                    let asked = |&t: &usize| table.counted(t) && !is_left_out(behind, mesh.triangle_group[t]);
                    for t in chunk.filter(asked) {
                        stops.count::<A>(mesh, t, mesh.triangles[t].map(|v| slot[v as usize]), &strict, &mut ties);
                    }
                }
                ties
            })
            .collect();
        let strict = strict.into_iter().map(|both| unpacked(both.into_inner())).collect();
        let (tie_offsets, ties) = by_slot(asked.len(), &ties);
        Seeds { slot, strict, tie_offsets, ties, asked: asked.len() }
    }

    /// The count at the inward-moved end `here` of the drawn edge here -> there.
    pub fn at<A: Arithmetic>(&self, mesh: &Mesh, group: i32, here: i32, there: i32) -> Count {
        let s = self.slot[here as usize] as usize;
        let mut count = self.strict[s];
        let (h, o) = (&mesh.points[here as usize], &mesh.points[there as usize]);
        for &t in &self.ties[self.tie_offsets[s] as usize..self.tie_offsets[s + 1] as usize] {
            let t = t as usize;
            let [p, q, r] = mesh.triangles[t];
            // The other corners, where this end is one of them.
            let others = match here {
                _ if here == p => Some([q, r]),
                _ if here == q => Some([r, p]),
                _ if here == r => Some([p, q]),
                _ => None,
            };
            if let Some([q, r]) = others {
                // The edge is a side of this polygon: nowhere behind it, even less if moved toward the viewer.
                if q == there || r == there {
                    continue;
                }
                // Or it leaves beside the polygon.
                let (q, r) = (&mesh.points[q as usize], &mesh.points[r as usize]);
                let (one, two) = (orient2d::<A>(h, q, o).sign(), orient2d::<A>(r, h, o).sign());
                if one * two < 0 {
                    continue;
                }
            }
            let Some(cover) = mesh.cover::<A>(t) else { continue };
            let (plain, moved) = cover.hides_end(h, o, mesh.delta(group, mesh.triangle_group[t]));
            count.plain += i32::from(plain);
            count.moved += i32::from(moved);
        }
        count
    }
}

/// Counting sort of pairs of a slot and a polygon: where each slot's polygons begin, and the polygons.
fn by_slot(slots: usize, found: &[Vec<(u32, u32)>]) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0u32; slots + 1];
    for &(s, _) in found.iter().flatten() {
        offsets[s as usize + 1] += 1;
    }
    for s in 0..slots {
        offsets[s + 1] += offsets[s];
    }
    let mut next = offsets.clone();
    let mut out = vec![0u32; offsets[slots] as usize];
    for &(s, t) in found.iter().flatten() {
        out[next[s as usize] as usize] = t;
        next[s as usize] += 1;
    }
    (offsets, out)
}
