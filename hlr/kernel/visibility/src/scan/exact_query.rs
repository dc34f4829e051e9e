//! The slow, certain test: one drawn edge against every polygon separately, without assuming how polygons join.
//!
//! Used only where the count of the fast way failed its check. Each polygon is counted by itself (whether it covers the
//! start, then crossings with its three borders and its plane), so the sum over all polygons cannot be inconsistent.

use std::sync::OnceLock;

use super::active_spans::Count;
use super::box_tree::{Aabb, BoxTree};
use super::invisibility::{Event, Segment, walk};
use super::mesh::Mesh;
use super::piercing::pierce;
use super::polygon_table::PolygonTable;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::crossing;

pub struct ExactQuery<'a> {
    mesh: &'a Mesh<'a>,
    table: &'a PolygonTable,
    tree: OnceLock<BoxTree>,
}

impl<'a> ExactQuery<'a> {
    pub fn new(mesh: &'a Mesh<'a>, table: &'a PolygonTable) -> Self {
        ExactQuery { mesh, table, tree: OnceLock::new() }
    }

    fn tree(&self) -> &BoxTree {
        self.tree.get_or_init(|| {
            let items = (0..self.mesh.triangles.len())
                .filter(|&t| self.table.counted(self.mesh, t))
                .map(|t| {
                    let (p, q, r) = self.mesh.corners(t);
                    (Aabb::of(&[p, q, r]), t as u32)
                })
                .collect();
            BoxTree::new(items)
        })
    }

    /// Segments of one drawn edge; false if even these counts contradict each other.
    pub fn decide<A: Arithmetic>(&self, edge: usize, out: &mut Vec<Segment>) -> bool {
        let (a, b) = self.mesh.ends(edge);
        self.decide_by::<A>(self.mesh.edge_group[edge], Aabb::of(&[a, b]), |_| Some((a, b)), out)
    }

    /// The same, where the edge has another position for some polygons, or is not compared with them at all. `ends`:
    /// its position for each polygon. `reach`: a box around all these positions.
    pub fn decide_by<'p, A: Arithmetic>(
        &self,
        group: i32,
        mut reach: Aabb,
        ends: impl Fn(usize) -> Option<(&'p Point, &'p Point)>,
        out: &mut Vec<Segment>,
    ) -> bool {
        let mesh = self.mesh;
        reach.low[2] = i32::MIN;
        let (mut start, mut end) = (Count::default(), Count::default());
        let mut events: Vec<Event<A::Parameter>> = Vec::new();
        self.tree().query(&reach, |t| {
            let t = t as usize;
            let Some((a, b)) = ends(t) else { return };
            let Some(cover) = mesh.cover::<A>(t) else { return };
            let delta = mesh.delta(group, mesh.triangle_group[t]);
            let (plain, moved) = cover.hides_end(a, b, delta);
            start.plain += i32::from(plain);
            start.moved += i32::from(moved);
            let (plain, moved) = cover.hides_end(b, a, delta);
            end.plain += i32::from(plain);
            end.moved += i32::from(moved);
            for k in 0..3 {
                let (p, q) = cover.edge(k);
                if let Some(hit) = crossing::<A>(a, b, p, q)
                    && hit.beneath > A::Volume::ZERO
                {
                    let beyond = hit.beneath > A::depth(delta) * A::raise(hit.d);
                    let at = A::crossing(hit.n, hit.d);
                    let moved = if beyond { hit.to_left } else { 0 };
                    events.push(Event { drawn: 0, at, plain: hit.to_left, moved });
                }
            }
            pierce(a, b, &cover, delta, |at, plain, moved| {
                events.push(Event { drawn: 0, at, plain, moved });
            });
        });
        walk(start, &mut events, end, out)
    }
}
