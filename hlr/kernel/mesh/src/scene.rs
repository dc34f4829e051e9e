//! All parts as one scene: mesh edges with their classes, the source's edges as walks over them, groups, and reports.

use hlr_brep::format::Matrix;
use rayon::prelude::*;

use super::bodies::{Bodies, bodies};
use super::convexity::may_fold;
use super::facts::Facts;
use super::kinds::{INTERIOR, SHARP};
use super::tables::{Tables, per_item};
use super::walks::{Walks, source_walks};

const SMOOTH: u8 = 1;

#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub triangle_part: Vec<i32>,
    /// Per edge with triangles: the part of its first triangle.
    pub edge_part: Vec<i32>,
    pub edge_group: Vec<i32>,
    /// Along the edges of the source.
    pub walks: Walks,
    /// Edges of the source along which no triangle has an edge; their numbers follow those of the others.
    pub loose: Vec<[i32; 2]>,
    /// Class of every edge; edges without triangles are at the end. INTERIOR where no edge of the source runs.
    pub kind: Vec<u8>,
    /// Per triangle: its face may show an outline.
    pub curved: Vec<bool>,
    /// Per edge with triangles: one of its faces may show an outline, or is a plane that such a face runs into.
    pub edge_curved: Vec<bool>,
    pub bodies: Bodies,
    /// Per group: it is not certainly one convex body.
    pub folded: Vec<bool>,
    /// Triangles and facts where something was turned the right way round: of these alone, else as they were.
    pub turned: Option<Turned>,
    pub reports: Vec<Report>,
    pub surfaces: Surfaces,
}

/// What is different after closed surfaces that were inside out have been turned.
#[derive(Clone, Debug)]
pub struct Turned {
    pub which: Vec<bool>,
    pub triangles: Vec<[i32; 3]>,
    pub facts: Facts,
}

/// Counts of one part: border edges, edges of more than two triangles, edges between faces of opposite orientation,
/// triangles without area, groups that are not closed, groups turned, triangles, edges of the source.
pub type Report = [i64; 8];

/// How many counts of a report, the first ones, are of what may be a defect.
pub const DEFECTS: usize = 6;

/// Per face of all parts: the placement of its surface in the model. Per triangle: its corners in (u, v).
#[derive(Clone, Debug, Default)]
pub struct Surfaces {
    pub corner: Option<Vec<[i32; 3]>>,
    pub place: Vec<Matrix>,
    pub inward: Vec<bool>,
    pub curved: Vec<bool>,
}

impl Scene {
    /// Per triangle: the number of its planar face, counted over all parts; None where its face is curved.
    pub fn planar_face(&self, tables: &Tables) -> impl Iterator<Item = Option<i32>> {
        let face = |t: usize| tables.face_start[self.triangle_part[t] as usize] + tables.triangle_face[t];
        (0..self.curved.len()).map(move |t| (!self.curved[t]).then(|| face(t)))
    }
}

/// With fewer edges or triangles a second thread gains nothing.
const ALONE: usize = 1 << 15;

pub fn scene(tables: &Tables, facts: &Facts) -> Scene {
    let triangle_part = tables.triangle_part();
    let face_of = |t: usize| (tables.face_start[triangle_part[t] as usize] + tables.triangle_face[t]) as usize;
    let edges = || (0..facts.edges.len()).into_par_iter().with_min_len(ALONE);
    let triangles = (0..triangle_part.len()).into_par_iter().with_min_len(ALONE);
    let curved: Vec<bool> = triangles.map(|t| !tables.face_planar[face_of(t)]).collect();
    let edge_part: Vec<i32> = edges().map(|e| triangle_part[facts.around(e)[0] as usize]).collect();
    let of_brep = |part: i32| tables.brep[part as usize];
    // Side by side: edges of the source, and bodies.
    let of_edges = || {
        let (mut walks, loose) = source_walks(tables, &facts.edges);
        let kind = kinds(facts.edges.len() + loose.len(), &walks);
        walks.straight = between_planes(&walks, facts, &kind, &curved);
        let edge_curved =
            edge_curved(facts, &kind, &curved, &face_of, tables.face_planar.len(), &|e| of_brep(edge_part[e]));
        (walks, loose, kind, edge_curved)
    };
    let of_bodies = || {
        let bodies = bodies(tables, facts, &triangle_part, &curved);
        let turned = turned(tables, facts, &bodies);
        let (triangles, after) = turned.as_ref().map_or((&tables.triangles, facts), |t| (&t.triangles, &t.facts));
        let folded = may_fold(&bodies, &tables.points, triangles, after);
        let reports = reports(tables, facts, &triangle_part, &edge_part, &bodies);
        let edge_group = edges().map(|e| bodies.group_of[facts.around(e)[0] as usize]).collect();
        let surfaces = surfaces(tables, turned.as_ref(), &face_of);
        (bodies, turned, folded, reports, edge_group, surfaces)
    };
    let ((walks, loose, kind, edge_curved), (bodies, turned, folded, reports, edge_group, surfaces)) =
        rayon::join(of_edges, of_bodies);
    Scene {
        triangle_part,
        edge_part,
        edge_group,
        walks,
        loose,
        kind,
        curved,
        edge_curved,
        bodies,
        folded,
        turned,
        reports,
        surfaces,
    }
}

/// Where several walks run along one edge, the first gives its class.
fn kinds(edges: usize, walks: &Walks) -> Vec<u8> {
    let mut kind = vec![INTERIOR; edges];
    for (walk, w) in walks.offsets.windows(2).enumerate().rev() {
        for &e in &walks.edges[w[0] as usize..w[1] as usize] {
            kind[e as usize] = walks.kind[walk];
        }
    }
    kind
}

fn between_planes(walks: &Walks, facts: &Facts, kind: &[u8], curved: &[bool]) -> Vec<bool> {
    let flat = |&e: &i32| {
        let e = e as usize;
        e < facts.edges.len() && kind[e] == SHARP && {
            let around = facts.around(e);
            around.len() == 2 && !around.iter().any(|&t| curved[t as usize])
        }
    };
    let straight = |w: &[i32]| w[0] < w[1] && walks.edges[w[0] as usize..w[1] as usize].iter().all(flat);
    walks.offsets.windows(2).map(straight).collect()
}

fn turned(tables: &Tables, facts: &Facts, bodies: &Bodies) -> Option<Turned> {
    if !bodies.turned.contains(&true) {
        return None;
    }
    let which: Vec<bool> = bodies.group_of.iter().map(|&g| bodies.turned[g as usize]).collect();
    let (mut triangles, mut facts) = (tables.triangles.clone(), facts.clone());
    for t in (0..which.len()).filter(|&t| which[t]) {
        triangles[t].swap(1, 2);
        // As a product: minus zero stays what it was before there was a kernel.
        facts.normals[t].iter_mut().for_each(|c| *c *= -1.0);
    }
    Some(Turned { which, triangles, facts })
}

fn reports(tables: &Tables, facts: &Facts, part_of: &[i32], edge_part: &[i32], bodies: &Bodies) -> Vec<Report> {
    let mut out = vec![[0; 8]; tables.len()];
    for (e, &part) in edge_part.iter().enumerate() {
        let report = &mut out[part as usize];
        match facts.around(e).len() {
            1 => report[0] += 1,
            2 => report[2] += i64::from(facts.balance[e] != 0),
            _ => report[1] += 1,
        }
    }
    facts.flat.iter().for_each(|&t| out[part_of[t as usize] as usize][3] += 1);
    for (g, &part) in bodies.part_of.iter().enumerate() {
        out[part as usize][4] += i64::from(!bodies.groups.closed[g]);
        out[part as usize][5] += i64::from(bodies.turned[g]);
    }
    for (p, report) in out.iter_mut().enumerate() {
        report[6] = i64::from(tables.triangle_start[p + 1] - tables.triangle_start[p]);
        // An edge that changes its class is there in pieces.
        let edges = &tables.edge_index[tables.edge_start[p] as usize..tables.edge_start[p + 1] as usize];
        report[7] = edges.chunk_by(|a, b| a == b).count() as i64;
    }
    out
}

/// A planar face that a curved one runs into tangentially is the curved face's outline when it is seen edge-on, and
/// rounding decides along which of its edges it folds. Inside a planar face nothing folds: needles between corners in
/// one line are turned any way.
///
/// An edge of a B-rep's mesh whose two triangles lie on top of one another, folded by more than a right angle, shows
/// none: no smooth surface does that between two chords. Where edge curve and surface differ by the file's own
/// tolerance, the tessellation laps over itself in slivers. A mesh without B-rep has such edges where it is that sharp,
/// and where the crease angle is larger still, the outline is all that is drawn of them.
fn edge_curved(
    facts: &Facts,
    kind: &[u8],
    curved: &[bool],
    face_of: &(dyn Fn(usize) -> usize + Sync),
    faces: usize,
    of_brep: &(dyn Fn(usize) -> bool + Sync),
) -> Vec<bool> {
    let mut run_into = vec![false; faces];
    for e in (0..facts.edges.len()).filter(|&e| kind[e] == SMOOTH) {
        facts.around(e).iter().take(2).for_each(|&t| run_into[face_of(t as usize)] = true);
    }
    let shows = |&t: &i32| curved[t as usize] || run_into[face_of(t as usize)];
    let in_plane = |e: usize| kind[e] == INTERIOR && facts.around(e).iter().all(|&t| !curved[t as usize]);
    let on_top = |e: usize| of_brep(e) && facts.fold[e] < 0.0 && facts.balance[e] == 0;
    let of = |e: usize| !on_top(e) && !in_plane(e) && facts.around(e).iter().any(shows);
    (0..facts.edges.len()).into_par_iter().with_min_len(1 << 12).map(of).collect()
}

fn surfaces(tables: &Tables, turned: Option<&Turned>, face_of: &dyn Fn(usize) -> usize) -> Surfaces {
    let part = per_item(&tables.face_start);
    let place = part.iter().zip(&tables.face_place).map(|(&p, place)| composed(&tables.transform[p as usize], place));
    let curved = tables.face_planar.iter().zip(&tables.face_shape).map(|(planar, &shape)| !planar && shape >= 0);
    let mut out = Surfaces {
        corner: None,
        place: place.collect(),
        inward: tables.face_reversed.clone(),
        curved: curved.collect(),
    };
    if let Some(turned) = turned {
        let mut corner = tables.corner.clone();
        let mut faces = vec![false; tables.face_planar.len()];
        for t in (0..corner.len()).filter(|&t| turned.which[t]) {
            corner[t].swap(1, 2);
            faces[face_of(t)] = true;
        }
        out.inward.iter_mut().zip(faces).for_each(|(inward, turned)| *inward ^= turned);
        out.corner = Some(corner);
    }
    out
}

fn composed(outer: &Matrix, inner: &Matrix) -> Matrix {
    outer.map(|[a, b, c, d]| {
        // The sum starts from plus zero: records have no minus zeros.
        [0, 1, 2, 3].map(|j| 0.0 + a * inner[0][j] + b * inner[1][j] + c * inner[2][j] + if j == 3 { d } else { 0.0 })
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use hlr_brep::format::IDENTITY;

    /// Tetrahedra without B-rep; `order` of the corners of their triangles.
    pub fn tetrahedra(at: &[(f64, f64)], outward: &[bool]) -> Tables {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let (n, mut tables) = (at.len() as i32, Tables::default());
        for (k, (&(shift, size), out)) in (0..).zip(at.iter().zip(outward)) {
            tables.points.extend(corners.map(|p| p.map(|c| shift + size * c)));
            let turn = |[a, b, c]: [i32; 3]| if *out { [a, b, c] } else { [a, c, b] };
            tables.triangles.extend(sides.map(|t| turn(t.map(|v| v + 4 * k))));
        }
        tables.point_start = vec![0, 4 * n];
        tables.triangle_start = vec![0, 4 * n];
        tables.triangle_face = vec![0; 4 * n as usize];
        tables.origin = (0..4 * n).collect();
        (tables.face_start, tables.face_planar) = (vec![0, 1], vec![false]);
        (tables.edge_start, tables.edge_offsets, tables.node_start) = (vec![0, 0], vec![0], vec![0, 0]);
        (tables.brep, tables.joined, tables.precision) = (vec![false], vec![true], vec![0.0]);
        (tables.transform, tables.face_place) = (vec![IDENTITY], vec![IDENTITY]);
        tables.corner = vec![[-1; 3]; 4 * n as usize];
        (tables.face_shape, tables.face_reversed) = (vec![-1], vec![false]);
        tables
    }

    pub fn built(tables: &Tables) -> Scene {
        scene(tables, &Facts::of(&tables.points, &tables.triangles))
    }

    #[test]
    fn what_is_inside_out_is_turned_and_a_cavity_is_not() {
        let found = built(&tetrahedra(&[(0.0, 1.0), (5.0, 1.0)], &[true, false]));
        assert_eq!((&found.bodies.groups.cull, &found.bodies.turned), (&vec![true, true], &vec![false, true]));
        let turned = found.turned.unwrap();
        assert_eq!((turned.triangles[4], turned.which[3], turned.which[4]), ([4, 6, 5], false, true));
        let found = built(&tetrahedra(&[(0.0, 1.0), (0.1, 0.2)], &[true, false]));
        let groups = &found.bodies.groups;
        assert_eq!((&groups.cull, &groups.inward), (&vec![true, false], &vec![false, true]));
        assert!(found.turned.is_none());
    }

    #[test]
    fn a_convex_body_does_not_fold() {
        let found = built(&tetrahedra(&[(0.0, 1.0)], &[true]));
        assert_eq!((found.folded, found.reports[0]), (vec![false], [0, 0, 0, 0, 0, 0, 4, 0]));
        assert_eq!(found.bodies.groups.extent, [3.6 / 6.0 / (1.5 + 3f64.sqrt() / 2.0)]);
    }

    #[test]
    fn pieces_of_an_open_mesh() {
        let mut tables = tetrahedra(&[(0.0, 1.0), (5.0, 1.0)], &[true, true]);
        tables.triangles.pop();
        tables.triangle_start[1] = 7;
        let found = built(&tables);
        assert_eq!((&found.bodies.groups.closed, found.folded), (&vec![true, false], vec![false, true]));
        assert_eq!(found.reports[0], [3, 0, 0, 0, 1, 0, 7, 0]);
    }
    #[test]
    fn a_closed_piece_of_a_brep_is_sound() {
        let mut tables = tetrahedra(&[(0.0, 1.0), (5.0, 1.0)], &[true, true]);
        let groups = |tables: &Tables| built(tables).bodies.groups;
        assert_eq!((&groups(&tables).sound, &groups(&tables).without_brep), (&vec![false; 2], &vec![true; 2]));
        tables.brep = vec![true];
        assert_eq!((&groups(&tables).sound, &groups(&tables).without_brep), (&vec![true], &vec![false]));
        tables.triangles.pop();
        tables.triangle_start[1] = 7;
        assert_eq!((&groups(&tables).sound, &groups(&tables).without_brep), (&vec![true, false], &vec![false; 2]));
    }
}
