//! The edge table: contours with their jumps, the edges to be drawn, and those that culling alone decides.

use std::ops::Range;

use rayon::prelude::*;

use super::mesh::{DRAWN, Mesh, OUTLINE};
use super::polygon_table::PolygonTable;

/// A contour edge: passing it changes the count.
#[derive(Clone, Copy, Debug)]
pub struct Contour {
    pub edge: u32,
    /// Polygons on its left minus polygons on its right.
    pub jump: i32,
}

pub struct EdgeTable {
    pub contours: Vec<Contour>,
    /// Edges whose visibility has to be found.
    pub drawn: Vec<u32>,
    /// Edges of closed groups at which all faces are turned away: hidden by their own group, without any search.
    pub hidden: Vec<u32>,
    /// Drawn edges seen end-on: points in the image.
    pub projecting: usize,
}

enum Fate {
    Ignored,
    Projecting,
    Hidden,
    Drawn,
}

/// Edges that one thread looks at in one go.
const EDGES_AT_ONCE: usize = 1 << 13;

impl EdgeTable {
    pub fn new(mesh: &Mesh, table: &PolygonTable) -> EdgeTable {
        let all: Vec<u32> = (0..mesh.edges.len() as u32).step_by(EDGES_AT_ONCE).collect();
        let parts: Vec<EdgeTable> = all
            .into_par_iter()
            .map(|first| EdgeTable::of(mesh, table, first..(first + EDGES_AT_ONCE as u32).min(mesh.edges.len() as u32)))
            .collect();
        EdgeTable {
            contours: parts.iter().flat_map(|part| &part.contours).copied().collect(),
            drawn: parts.iter().flat_map(|part| &part.drawn).copied().collect(),
            hidden: parts.iter().flat_map(|part| &part.hidden).copied().collect(),
            projecting: parts.iter().map(|part| part.projecting).sum(),
        }
    }

    fn of(mesh: &Mesh, table: &PolygonTable, edges: Range<u32>) -> EdgeTable {
        let mut out = EdgeTable { contours: Vec::new(), drawn: Vec::new(), hidden: Vec::new(), projecting: 0 };
        for edge in edges {
            let e = edge as usize;
            let jump = jump(mesh, table, e);
            if jump != 0 && !seen_end_on(mesh, e) {
                out.contours.push(Contour { edge, jump });
            }
            match fate(mesh, table, e, jump) {
                Fate::Ignored => {}
                Fate::Projecting => out.projecting += 1,
                Fate::Hidden => out.hidden.push(edge),
                Fate::Drawn => out.drawn.push(edge),
            }
        }
        out
    }
}

/// Whether an edge is a point in the image.
fn seen_end_on(mesh: &Mesh, edge: usize) -> bool {
    let (a, b) = mesh.ends(edge);
    a[0] == b[0] && a[1] == b[1]
}

/// Counted triangles on the left of lo -> hi minus those on its right.
fn jump(mesh: &Mesh, table: &PolygonTable, edge: usize) -> i32 {
    let [lo, hi] = mesh.edges[edge];
    let mut sum = 0;
    for &t in mesh.incident(edge) {
        let t = t as usize;
        if !table.counted(t) {
            continue;
        }
        let [p, q, r] = mesh.triangles[t];
        let forward = (p == lo && q == hi) || (q == lo && r == hi) || (r == lo && p == hi);
        sum += i32::from(table.facing(t)) * if forward { 1 } else { -1 };
    }
    sum
}

/// Whether an edge lies between a triangle that is almost edge-on and one that is not, both turned the same way. A
/// strip of such triangles has no width on paper, but the surfaces on its two sides may be far apart in depth. So its
/// borders are outlines, as they would be if it were exactly edge-on.
fn beside_edge_on(mesh: &Mesh, table: &PolygonTable, edge: usize) -> bool {
    let &[s, t] = mesh.incident(edge) else {
        return false;
    };
    let (s, t) = (s as usize, t as usize);
    table.almost_edge_on(s) != table.almost_edge_on(t) && table.facing(s) == table.facing(t)
}

fn fate(mesh: &Mesh, table: &PolygonTable, edge: usize, jump: i32) -> Fate {
    let role = mesh.role[edge];
    if role & DRAWN == 0 && (role & OUTLINE == 0 || (jump == 0 && !beside_edge_on(mesh, table, edge))) {
        return Fate::Ignored;
    }
    if seen_end_on(mesh, edge) {
        return Fate::Projecting;
    }
    if mesh.groups[mesh.edge_group[edge] as usize].cull && table.turned_away(mesh, mesh.incident(edge)) {
        return Fate::Hidden;
    }
    Fate::Drawn
}
