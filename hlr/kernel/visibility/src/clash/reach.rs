//! Measures how far a surface goes beyond a triangle that it crosses, near the crossing.
//!
//! ```text
//!            surface        From the middle of the common segment, the cross-section of the surface is followed both
//!               /           ways over smooth edges, as long as it climbs away from the plane. It ends at sharp edges,
//!      ________/________    at borders, and where it turns back. So the result depends neither on where the triangle's
//!  plane      /|            corners are nor on how the surface is divided: a corner far away along a bore's rim has no
//!            | | depth      influence.
//!             ¯
//! ```

use super::planar_faces::Edges;
use hlr_mesh::kinds::SHARP;
use hlr_mesh::vector::{cross, dot, sub};

/// A mesh with its edges, ascending, and the class of each (`hlr_mesh::kinds`).
pub struct Sheet<'a> {
    pub points: &'a [Vec3],
    pub triangles: &'a [[i32; 3]],
    pub normals: &'a [Vec3],
    edges: Edges<'a>,
    kinds: &'a [u8],
    /// Per point the number of the first edge that has it as its lower end; at last the number of edges.
    first: Vec<u32>,
}

pub type Vec3 = [f64; 3];

/// Cosine of an angle: a surface that turns by more between two triangles has a sharp edge there. Chords turn by at
/// most half a radian.
const SMOOTH: f64 = 0.77;
/// The same for an edge of the source that is sharp. At less the two faces may be facets of one surface.
const SHALLOW: f64 = 0.937;
/// Sine of an angle: a section that climbs less has turned parallel to the plane and ends there.
const LEVEL: f64 = 0.1;
/// The same as a share of the sine at the start: a section that begins flat may become flatter.
const FLATTER: f64 = 0.3;
/// Sine of an angle: planes that are parallel except for rounding have no cross-section.
pub const PARALLEL: f64 = 1e-9;
pub const STEPS: usize = 1000;

/// Where the section leaves a triangle: over its side k, at a place relative to the section's start.
#[derive(Clone, Copy)]
pub struct Exit {
    pub side: usize,
    pub place: Vec3,
}

impl<'a> Sheet<'a> {
    pub fn new(
        points: &'a [Vec3],
        (triangles, normals): (&'a [[i32; 3]], &'a [Vec3]),
        (edges, kinds): (Edges<'a>, &'a [u8]),
    ) -> Sheet<'a> {
        let mut first = Vec::with_capacity(points.len() + 1);
        for (number, &[lower, _]) in edges.edges.iter().enumerate() {
            if first.len() <= lower as usize {
                first.resize(lower as usize + 1, number as u32);
            }
        }
        first.resize(points.len() + 1, edges.edges.len() as u32);
        Sheet { points, triangles, normals, edges, kinds, first }
    }

    /// How far the surface of triangle `of` goes beyond the plane through `at` with the normal `up` on its shallower
    /// side, in model units, followed up to `most`. Infinite where it cannot be measured.
    pub fn reach(&self, up: &Vec3, of: u32, at: &Vec3, most: f64) -> f64 {
        let across = cross(up, &self.normals[of as usize]);
        let sine = dot(&across, &across).sqrt();
        if sine < PARALLEL {
            return f64::INFINITY;
        }
        let section = across.map(|c| c / sine);
        let level = LEVEL.min(FLATTER * sine);
        let Some([a, b]) = self.exits(of, at, &section) else { return f64::INFINITY };
        let (high, low) = if dot(&a.place, up) > dot(&b.place, up) { (a, b) } else { (b, a) };
        let climb = |exit, up: &Vec3| self.climb((of, exit), at, &section, up, level, most);
        climb(high, up).min(climb(low, &up.map(|c| -c)))
    }

    /// The greatest height of the section that leaves a triangle over the given side.
    fn climb(
        &self,
        (mut triangle, mut exit): (u32, Exit),
        at: &Vec3,
        section: &Vec3,
        up: &Vec3,
        level: f64,
        most: f64,
    ) -> f64 {
        let mut height = dot(&exit.place, up).max(0.0);
        for _ in 0..STEPS {
            if height >= most {
                return height;
            }
            let Some(edge) = self.edge(triangle, exit.side) else { return height };
            let Some((next, left)) = self.onward(triangle, edge, at, section) else { return height };
            let turn = dot(&self.normals[triangle as usize], &self.normals[next as usize]);
            if turn < SHALLOW && self.sharp(edge) {
                return height;
            }
            let way = sub(&left.place, &exit.place);
            let higher = dot(&left.place, up);
            if higher - height < level * dot(&way, &way).sqrt() {
                return height.max(higher);
            }
            (triangle, exit, height) = (next, left, higher);
        }
        f64::INFINITY
    }

    /// The next triangle along a section that leaves a triangle over an edge, and where the section leaves that one; None
    /// where the surface ends or turns by more than facets do.
    pub fn onward(&self, triangle: u32, edge: usize, at: &Vec3, section: &Vec3) -> Option<(u32, Exit)> {
        let (next, entry) = self.over(triangle, edge)?;
        if dot(&self.normals[triangle as usize], &self.normals[next as usize]) < SMOOTH {
            return None;
        }
        let corners = self.corners(next, at);
        let left = [1, 2].iter().find_map(|k| leave(&corners, (entry + k) % 3, section))?;
        Some((next, left))
    }

    /// Where a section through `at` leaves the triangle it begins in; None unless at two places.
    pub fn exits(&self, triangle: u32, at: &Vec3, section: &Vec3) -> Option<[Exit; 2]> {
        let corners = self.corners(triangle, at);
        let exits: Vec<Exit> = (0..3).filter_map(|side| leave(&corners, side, section)).collect();
        <[Exit; 2]>::try_from(exits).ok()
    }

    fn corners(&self, triangle: u32, at: &Vec3) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|v| sub(&self.points[v as usize], at))
    }

    /// The number of a side's edge.
    pub fn edge(&self, triangle: u32, side: usize) -> Option<usize> {
        let own = self.triangles[triangle as usize];
        let (a, b) = (own[side], own[(side + 1) % 3]);
        let first = self.first[a.min(b) as usize] as usize;
        let from_lower = &self.edges.edges[first..self.first[a.min(b) as usize + 1] as usize];
        from_lower.binary_search_by_key(&a.max(b), |edge| edge[1]).ok().map(|k| first + k)
    }

    /// Whether this is a sharp edge of the source.
    pub fn sharp(&self, edge: usize) -> bool {
        self.kinds[edge] == SHARP
    }

    /// The triangles along an edge.
    pub fn along(&self, edge: usize) -> &[i32] {
        let Edges { offsets, incident, .. } = self.edges;
        &incident[offsets[edge] as usize..offsets[edge + 1] as usize]
    }

    /// The triangle beyond a side, and which side of its own that is; None where there is not exactly one.
    pub fn beyond(&self, triangle: u32, side: usize) -> Option<(u32, usize)> {
        self.over(triangle, self.edge(triangle, side)?)
    }

    /// The triangle on the other side of one of a triangle's edges, and which side of its own that is.
    fn over(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        let [a, b] = self.edges.edges[edge];
        let [s, t] = *self.along(edge) else { return None };
        let next = if s == triangle as i32 { t } else { s };
        let corners = self.triangles[next as usize];
        let entry = (0..3).find(|&k| corners[k] != a && corners[k] != b).map(|apex| (apex + 1) % 3)?;
        Some((next as u32, entry))
    }
}

/// Where a section, a plane through the origin, crosses a side. A corner in the plane counts as before it.
fn leave(corners: &[Vec3; 3], side: usize, section: &Vec3) -> Option<Exit> {
    let (p, q) = (&corners[side], &corners[(side + 1) % 3]);
    let (a, b) = (dot(p, section), dot(q, section));
    if (a < 0.0) == (b < 0.0) {
        return None;
    }
    let t = a / (a - b);
    Some(Exit { side, place: [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hlr_mesh::kinds::INTERIOR;
    use hlr_mesh::topology;

    /// The reach of the surface around triangle `of` beyond triangle 0.
    fn reach(points: &[Vec3], triangles: &[[i32; 3]], of: u32, at: Vec3, most: f64) -> f64 {
        reach_with(INTERIOR, points, triangles, of, at, most)
    }

    /// The same, all edges being of this class.
    fn reach_with(kind: u8, points: &[Vec3], triangles: &[[i32; 3]], of: u32, at: Vec3, most: f64) -> f64 {
        let t = topology::topology(triangles, points.len());
        let normals = &topology::normals(points, triangles)[..];
        let edges = Edges { edges: &t.edges, offsets: &t.offsets, incident: &t.incident };
        let kinds = vec![kind; t.edges.len()];
        let sheet = Sheet::new(points, (triangles, normals), (edges, &kinds));
        sheet.reach(&normals[0], of, &at, most)
    }

    /// The plane z = 0, and a wall through it along x, from z = -low to z = high, cut into `strips` that lean along x;
    /// `corner`: where its first lower corner lies instead.
    fn wall(low: f64, high: f64, strips: i32, lean: f64, corner: Option<Vec3>) -> (Vec<Vec3>, Vec<[i32; 3]>) {
        let mut points = vec![[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]];
        let mut triangles = vec![[0, 1, 2]];
        for k in 0..=strips {
            let x = f64::from(k) / f64::from(strips);
            points.extend([[x, 0.0, -low], [x + lean, 0.0, high]]);
        }
        for k in 0..strips {
            let a = 3 + 2 * k;
            triangles.extend([[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]);
        }
        points[3] = corner.unwrap_or(points[3]);
        (points, triangles)
    }

    #[test]
    fn a_wall_goes_as_deep_however_it_is_cut() {
        for strips in [1, 7, 100] {
            let (points, triangles) = wall(0.25, 5.0, strips, 3.0, None);
            let middle = strips / 2;
            let at = [0.25 / 5.25 * 3.0 + (f64::from(middle) + 0.2) / f64::from(strips), 0.0, 0.0];
            let of = 1 + 2 * middle as u32;
            let found = reach(&points, &triangles, of, at, 100.0);
            assert!((found - 0.25).abs() < 1e-12, "{strips}: {found}");
            assert!(reach(&points, &triangles, of, at, 0.1) >= 0.1);
        }
    }

    #[test]
    fn a_corner_far_away_is_not_here() {
        let (points, triangles) = wall(0.01, 5.0, 1, 3.0, Some([-50.0, 0.0, -3.0]));
        let x = 1.0 - 0.01 / 5.01 * 0.5;
        let found = reach(&points, &triangles, 1, [x, 0.0, 0.0], 100.0);
        assert!(found < 0.02, "{found}");
    }

    #[test]
    fn a_surface_goes_on_over_a_bend_and_ends_at_an_edge() {
        let (mut points, mut triangles) = wall(1.0, 5.0, 1, 0.0, None);
        // Below the wall the surface bends by 30 degrees and continues for the same length; then it bends by 90
        // degrees.
        let (sine, cosine) = 30f64.to_radians().sin_cos();
        points.extend([[0.0, sine, -1.0 - cosine], [1.0, sine, -1.0 - cosine]]);
        triangles.push([5, 3, 7]);
        triangles.push([5, 7, 8]);
        let at = [0.7, 0.0, 0.0];
        let found = reach(&points, &triangles, 1, at, 100.0);
        assert!((found - 1.0 - cosine).abs() < 1e-12, "{found}");
        (points[7], points[8]) = ([0.0, 1.0, -1.5], [1.0, 1.0, -1.5]);
        assert!((reach(&points, &triangles, 1, at, 100.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_surface_ends_at_a_sharp_edge_that_turns_more_than_facets_do() {
        for (degrees, ends) in [(30.0f64, true), (10.0, false)] {
            let (mut points, mut triangles) = wall(0.25, 5.0, 1, 0.0, None);
            let (sine, cosine) = degrees.to_radians().sin_cos();
            points.extend([[0.0, sine, -0.25 - cosine], [1.0, sine, -0.25 - cosine]]);
            triangles.extend([[5, 3, 7], [5, 7, 8]]);
            let at = [0.3, 0.0, 0.0];
            let whole = reach(&points, &triangles, 1, at, 100.0);
            assert!((whole - 0.25 - cosine).abs() < 1e-12, "{whole}");
            let found = reach_with(SHARP, &points, &triangles, 1, at, 100.0);
            assert!((found - if ends { 0.25 } else { whole }).abs() < 1e-12, "{degrees}: {found}");
        }
    }
}
