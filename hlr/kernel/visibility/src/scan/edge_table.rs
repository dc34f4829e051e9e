//! The edge table: contours with their jumps, the edges to be drawn, and those that culling alone decides.

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

impl EdgeTable {
    pub fn new(mesh: &Mesh, table: &PolygonTable) -> EdgeTable {
        let found: Vec<(i32, Fate)> = (0..mesh.edges.len())
            .into_par_iter()
            .map(|e| {
                let jump = jump(mesh, table, e);
                (jump, fate(mesh, table, e, jump))
            })
            .collect();
        let mut out = EdgeTable { contours: Vec::new(), drawn: Vec::new(), hidden: Vec::new(), projecting: 0 };
        for (e, (jump, fate)) in found.iter().enumerate() {
            let (a, b) = mesh.ends(e);
            if *jump != 0 && (a[0] != b[0] || a[1] != b[1]) {
                out.contours.push(Contour { edge: e as u32, jump: *jump });
            }
            match fate {
                Fate::Ignored => {}
                Fate::Projecting => out.projecting += 1,
                Fate::Hidden => out.hidden.push(e as u32),
                Fate::Drawn => out.drawn.push(e as u32),
            }
        }
        out
    }
}

/// Counted triangles on the left of lo -> hi minus those on its right.
fn jump(mesh: &Mesh, table: &PolygonTable, edge: usize) -> i32 {
    let [lo, hi] = mesh.edges[edge];
    let mut sum = 0;
    for &t in mesh.incident(edge) {
        let t = t as usize;
        if !table.counted(mesh, t) {
            continue;
        }
        let [p, q, r] = mesh.triangles[t];
        let forward = (p == lo && q == hi) || (q == lo && r == hi) || (r == lo && p == hi);
        sum += i32::from(table.facing[t]) * if forward { 1 } else { -1 };
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
    table.almost[s] != table.almost[t] && table.facing[s] == table.facing[t]
}

fn fate(mesh: &Mesh, table: &PolygonTable, edge: usize, jump: i32) -> Fate {
    let role = mesh.role[edge];
    if role & DRAWN == 0 && (role & OUTLINE == 0 || (jump == 0 && !beside_edge_on(mesh, table, edge))) {
        return Fate::Ignored;
    }
    let (a, b) = mesh.ends(edge);
    if a[0] == b[0] && a[1] == b[1] {
        return Fate::Projecting;
    }
    if mesh.groups[mesh.edge_group[edge] as usize].cull && table.turned_away(mesh, mesh.incident(edge)) {
        return Fate::Hidden;
    }
    Fate::Drawn
}
