//! The slow, certain test: one drawn edge against every polygon separately, without assuming how polygons join.
//!
//! Used only where the count of the fast way failed its check. Each polygon is counted by itself (whether it covers the
//! start, then crossings with its three borders and its plane), so the sum over all polygons cannot be inconsistent.

use std::sync::OnceLock;

use super::invisibility::{Event, Segment, walk};
use super::mesh::Mesh;
use super::piercing::{Ends, pierce};
use super::polygon_table::{PolygonTable, is_left_out};
use super::query_points::Count;
use crate::boxes::aabb::Aabb;
use crate::boxes::tree::Tree;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::{crossing, is_beside};

pub struct ExactQuery<'a> {
    mesh: &'a Mesh<'a>,
    table: &'a PolygonTable,
    behind: &'a [bool],
    tree: OnceLock<Tree>,
}

impl<'a> ExactQuery<'a> {
    /// behind: per group, whether its polygons are left out; empty: of none.
    pub fn new(mesh: &'a Mesh<'a>, table: &'a PolygonTable, behind: &'a [bool]) -> Self {
        ExactQuery { mesh, table, behind, tree: OnceLock::new() }
    }

    /// Whether an edge is of a group that is left out: it is hidden from end to end, and need not be asked about.
    pub fn leaves_out(&self, edge: i32) -> bool {
        is_left_out(self.behind, self.mesh.edge_group[edge as usize])
    }

    /// All polygons but those that are left out.
    pub fn tree(&self) -> &Tree {
        self.tree.get_or_init(|| Tree::on_one_thread(&self.boxes(0..self.mesh.triangles.len() as u32)))
    }

    /// Makes the tree of all polygons on all threads, before these ask for it.
    pub fn prepare(&self) {
        if self.tree.get().is_none() {
            // If another thread was faster, its tree is the same.
            let _ = self.tree.set(Tree::new(&self.boxes(0..self.mesh.triangles.len() as u32)));
        }
    }

    /// The boxes of those of these triangles that are counted, and not left out.
    pub fn boxes(&self, triangles: impl IntoIterator<Item = u32>) -> Vec<(Aabb, u32)> {
        let asked = |t: usize| self.table.counted(t) && !is_left_out(self.behind, self.mesh.triangle_group[t]);
        let boxed = |t: u32| {
            let (p, q, r) = self.mesh.corners(t as usize);
            (Aabb::of(&[p, q, r]), t)
        };
        triangles.into_iter().filter(|&t| asked(t as usize)).map(boxed).collect()
    }

    /// Segments of one drawn edge; false if even these counts contradict each other.
    pub fn decide<A: Arithmetic>(&self, edge: usize, out: &mut Vec<Segment>) -> bool {
        let ends = self.mesh.ends(edge);
        let mut found = Vec::new();
        self.in_front(self.tree(), Aabb::of(&[ends.0, ends.1]), |t| found.push((t, ends)));
        let group = self.mesh.edge_group[edge];
        self.decide_by::<A>(found, |t| self.mesh.delta(group, self.mesh.triangle_group[t]), out)
    }

    /// Calls `visit` with the polygons of a tree that may lie in front of a box.
    pub fn in_front(&self, tree: &Tree, mut reach: Aabb, mut visit: impl FnMut(usize)) {
        reach.low[2] = i32::MIN;
        tree.query(&reach, |t| visit(t as usize));
    }

    /// Whether `wanted` is true of a polygon that may lie in front of a box.
    pub fn any_in_front(&self, mut reach: Aabb, mut wanted: impl FnMut(usize) -> bool) -> bool {
        reach.low[2] = i32::MIN;
        self.tree().any(&reach, |t| wanted(t as usize))
    }

    /// The same as `decide`, where the edge may have another position for some polygons. `polygons`: those it is
    /// compared with, and its ends for each; `delta`: how far it is moved toward the viewer before that.
    pub fn decide_by<'p, A: Arithmetic>(
        &self,
        polygons: impl IntoIterator<Item = (usize, (&'p Point, &'p Point))>,
        delta: impl Fn(usize) -> i64,
        out: &mut Vec<Segment>,
    ) -> bool {
        let mesh = self.mesh;
        let (mut start, mut end) = (Count::default(), Count::default());
        let mut events: Vec<Event<A::Parameter>> = Vec::new();
        for (t, (a, b)) in polygons {
            let (p, q, r) = mesh.corners(t);
            if is_beside::<A>(a, b, [p, q, r]) {
                continue;
            }
            let Some(cover) = mesh.cover::<A>(t) else { continue };
            // Most that are left lie beyond one border of the polygon, or before its plane: it hides nothing of them.
            let Some(ends) = Ends::over(&cover, a, b) else { continue };
            if ends.beneath.iter().all(|g| *g < A::Volume::ZERO) {
                continue;
            }
            let delta = delta(t);
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
            pierce(&cover, &ends, delta, |at, plain, moved| {
                events.push(Event { drawn: 0, at, plain, moved });
            });
        }
        walk(start, &mut events, end, out)
    }
}
