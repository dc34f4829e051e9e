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

/// What a range of edges adds to the table.
#[derive(Default)]
struct Part {
    contours: Vec<Contour>,
    drawn: Vec<u32>,
    hidden: Vec<u32>,
    projecting: usize,
    /// Edges between a wall, which is exactly edge-on, and what is turned away: each with its triangle of the wall.
    behind_walls: Vec<(u32, i32)>,
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
        let parts: Vec<Part> = all
            .into_par_iter()
            .map(|first| Part::of(mesh, table, first..(first + EDGES_AT_ONCE as u32).min(mesh.edges.len() as u32)))
            .collect();
        let mut drawn: Vec<u32> = parts.iter().flat_map(|part| &part.drawn).copied().collect();
        let beside: Vec<(u32, i32)> = parts.iter().flat_map(|part| &part.behind_walls).copied().collect();
        if !beside.is_empty() {
            let walls = Walls::new(mesh, table, &beside);
            drawn.extend(beside.into_iter().filter(|&(e, wall)| !walls.lined(mesh, e, wall)).map(|(e, _)| e));
            drawn.sort_unstable();
        }
        EdgeTable {
            contours: parts.iter().flat_map(|part| &part.contours).copied().collect(),
            drawn,
            hidden: parts.iter().flat_map(|part| &part.hidden).copied().collect(),
            projecting: parts.iter().map(|part| part.projecting).sum(),
        }
    }
}

impl Part {
    fn of(mesh: &Mesh, table: &PolygonTable, edges: Range<u32>) -> Part {
        let mut out = Part::default();
        for edge in edges {
            let e = edge as usize;
            let jump = jump(mesh, table, e);
            if jump != 0 && !seen_end_on(mesh, e) {
                out.contours.push(Contour { edge, jump });
            }
            match fate(mesh, table, e, jump) {
                Fate::Ignored => out.behind_walls.extend(behind_wall(mesh, table, e).map(|wall| (edge, wall))),
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

/// Whether a surface ends or folds over at an edge, in the image. Where layers of one go on, there may be one triangle
/// more on the one side than on the other. jump: of the edge.
fn ends_at(mesh: &Mesh, table: &PolygonTable, edge: usize, jump: i32) -> bool {
    let counted = |&&t: &&i32| table.counted(t as usize) && table.facing(t as usize) != 0;
    jump.abs() > 1 || (jump != 0 && mesh.incident(edge).iter().filter(counted).count() == 1)
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

/// The triangle of a wall at an edge that would be an outline if what is turned away were counted; None at others.
fn behind_wall(mesh: &Mesh, table: &PolygonTable, edge: usize) -> Option<i32> {
    if mesh.role[edge] & OUTLINE == 0 {
        return None;
    }
    let &[s, t] = mesh.incident(edge) else { return None };
    let wall = match [s, t].map(|t| table.facing(t as usize)) {
        [0, -1] => s,
        [-1, 0] => t,
        _ => return None,
    };
    (!seen_end_on(mesh, edge)).then_some(wall)
}

/// Walls that are exactly edge-on, and the lines that they have in the image without their borders to what is turned away.
/// The triangles of one lie in one plane along the line of sight, so all its borders lie on one straight line. Where the
/// surface comes toward the viewer by steps, it has none:
///
/// ```text
///                           ___
///     viewer >-            (   |
///                           )__|____ wall         nothing is turned toward the viewer, and no jump tells of the wall
///                                   \
///                                    |___
/// ```
struct Walls {
    /// Per triangle, its wall.
    wall: Vec<u32>,
    /// The lines, ascending: their wall, and their ends in the image. Along a straight line, places are ordered by x,
    /// then y.
    lines: Vec<(u32, [Place; 2])>,
}

type Place = [i32; 2];

const NONE: u32 = u32::MAX;

impl Walls {
    /// The walls at edges, each given with its triangle of the wall.
    fn new(mesh: &Mesh, table: &PolygonTable, beside: &[(u32, i32)]) -> Walls {
        let edge_on = |t: i32| table.facing(t as usize) == 0;
        let (mut lines, mut joined) = (Vec::new(), Vec::new());
        for edge in 0..mesh.edges.len() {
            let around = mesh.incident(edge);
            if !around.iter().any(|&t| edge_on(t)) || seen_end_on(mesh, edge) {
                continue;
            }
            let role = mesh.role[edge];
            if role & DRAWN != 0 || (role != 0 && ends_at(mesh, table, edge, jump(mesh, table, edge))) {
                lines.extend(around.iter().filter(|&&t| edge_on(t)).map(|&t| (t, in_image(mesh, edge))));
            }
            if let &[s, t] = around
                && edge_on(s)
                && edge_on(t)
            {
                joined.extend([[s, t], [t, s]]);
            }
        }
        joined.sort_unstable();
        let mut wall = vec![NONE; mesh.triangles.len()];
        for (number, &(_, first)) in (0..).zip(beside) {
            let mut next = vec![first];
            while let Some(t) = next.pop() {
                if wall[t as usize] == NONE {
                    wall[t as usize] = number;
                    let from = joined.partition_point(|pair| pair[0] < t);
                    next.extend(joined[from..].iter().take_while(|pair| pair[0] == t).map(|pair| pair[1]));
                }
            }
        }
        let mut lines: Vec<(u32, [Place; 2])> = lines.into_iter().map(|(t, ends)| (wall[t as usize], ends)).collect();
        lines.sort_unstable();
        Walls { wall, lines }
    }

    /// Whether the lines of its wall cover an edge from end to end.
    fn lined(&self, mesh: &Mesh, edge: u32, triangle: i32) -> bool {
        let wall = self.wall[triangle as usize];
        let [mut from, to] = in_image(mesh, edge as usize);
        let first = self.lines.partition_point(|line| line.0 < wall);
        for (_, [a, b]) in self.lines[first..].iter().take_while(|line| line.0 == wall && line.1[0] <= to) {
            if *a > from {
                return false;
            }
            from = from.max(*b);
        }
        from >= to
    }
}

/// The ends of an edge in the image, ascending.
fn in_image(mesh: &Mesh, edge: usize) -> [Place; 2] {
    let (a, b) = mesh.ends(edge);
    let [a, b] = [a, b].map(|p| [p[0], p[1]]);
    [a.min(b), a.max(b)]
}

fn fate(mesh: &Mesh, table: &PolygonTable, edge: usize, jump: i32) -> Fate {
    let role = mesh.role[edge];
    let outlines = || ends_at(mesh, table, edge, jump) || beside_edge_on(mesh, table, edge);
    if role & DRAWN == 0 && (role & OUTLINE == 0 || !outlines()) {
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
