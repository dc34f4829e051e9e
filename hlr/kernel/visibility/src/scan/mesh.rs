//! The input of the pass: borrowed topology, snapped points, and the properties of each group.

use hlr_exact::Point;
use hlr_exact::arithmetic::Arithmetic;
use hlr_exact::predicates::Cover;

/// Drawn always.
pub const DRAWN: u8 = 1;
/// Drawn where it is a contour (the mesh outline of a curved face).
pub const OUTLINE: u8 = 2;

#[derive(Clone, Copy, Debug)]
pub struct SnappedGroup {
    /// Closed and consistently oriented: polygons facing away need not be counted.
    pub cull: bool,
    /// Does not pass through itself: drawn edges need no piercing search against their own group.
    pub sound: bool,
    /// Contact tolerance in depth units of the grid.
    pub delta: i64,
    /// The most that an edge may be moved before it is compared with this group, in depth units of the grid. It is less
    /// than the group's thickness, or edges behind it would show through.
    pub cap: i64,
    /// The group's lines lie exactly on other groups' polygons by construction: only its own tolerance counts.
    pub tight: bool,
}

pub struct Mesh<'a> {
    pub points: Vec<Point>,
    pub triangles: &'a [[i32; 3]],
    pub triangle_group: &'a [i32],
    pub edges: &'a [[i32; 2]],
    /// Triangles incident to edge e: incident[offsets[e]..offsets[e + 1]].
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    pub edge_group: &'a [i32],
    pub role: &'a [u8],
    pub groups: Vec<SnappedGroup>,
    /// Pairs of groups that have an intersection line: the lower number first, ascending.
    pub crossing: &'a [[i32; 2]],
}

impl Mesh<'_> {
    #[inline(always)]
    pub fn ends(&self, edge: usize) -> (&Point, &Point) {
        let [a, b] = self.edges[edge];
        (&self.points[a as usize], &self.points[b as usize])
    }

    #[inline(always)]
    pub fn corners(&self, triangle: usize) -> (&Point, &Point, &Point) {
        let [p, q, r] = self.triangles[triangle];
        (&self.points[p as usize], &self.points[q as usize], &self.points[r as usize])
    }

    #[inline(always)]
    pub fn cover<A: Arithmetic>(&self, triangle: usize) -> Option<Cover<A>> {
        let (p, q, r) = self.corners(triangle);
        Cover::new(p, q, r)
    }

    pub fn incident(&self, edge: usize) -> &[i32] {
        &self.incident[self.offsets[edge] as usize..self.offsets[edge + 1] as usize]
    }

    /// Whether two groups have an intersection line.
    pub fn crosses(&self, a: i32, b: i32) -> bool {
        self.crossing.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }

    /// How far a drawn edge is moved toward the viewer before it is compared with another group.
    ///
    /// Contacts between groups are equal only up to snapping and tessellation. Inside one sound group neighbours share
    /// their vertices, ties are exact, and nothing is moved: so no stub appears where an edge dives behind its own
    /// face. One constant per pair of groups keeps the counts consistent.
    #[inline(always)]
    pub fn delta(&self, drawn_group: i32, polygon_group: i32) -> i64 {
        let own = &self.groups[drawn_group as usize];
        if drawn_group == polygon_group {
            return if own.sound || own.cull { 0 } else { own.delta };
        }
        let other = &self.groups[polygon_group as usize];
        let delta = if own.tight { own.delta } else { own.delta.max(other.delta) };
        delta.min(other.cap)
    }
}
