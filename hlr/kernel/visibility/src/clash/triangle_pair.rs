//! The segment in which two triangles pass through each other.
//!
//! ```text
//!         a            An edge of one triangle whose ends lie on different sides of the other's plane pierces that
//!        / \           plane; where it does so inside the other triangle, the common segment ends.
//!   b---x---x----b
//!     \/     \/        A corner on the plane counts as above it (so a face that ends on a plane meets it once, from one
//!                      side), and the inside is closed: no gap where two triangles share the edge that is met.
//! ```
//!
//! After P. Guigue and O. Devillers, "Fast and robust triangle-triangle overlap test using orientation predicates",
//! Journal of Graphics Tools 8 (2003).

use hlr_exact::Point;
use hlr_mesh::vector::{cross, dot, sub};

/// A triangle with the numbers of its corners: an edge is cut the same way from both triangles that share it.
#[derive(Clone, Copy)]
pub struct Numbered<'a> {
    pub corner: [&'a Point; 3],
    pub number: [i32; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Rounded to the grid, in ascending order.
    pub ends: [Point; 2],
    /// How far each triangle reaches beyond the other's plane on its shallower side; the lesser of both, in grid units.
    pub depth: f64,
    /// Sine of the angle between the planes.
    pub sine: f64,
}

/// Six times the volume of the tetrahedron p, q, r, s. Coordinates up to 2^30 give less than 2^97.
pub fn orient3d(p: &Point, q: &Point, r: &Point, s: &Point) -> i128 {
    above(&exact_normal(p, q, r), p, s)
}

/// Of the plane through p, q and r. Differences are less than 2^31, so the sums of two products less than 2^63.
#[inline]
fn exact_normal(p: &Point, q: &Point, r: &Point) -> [i64; 3] {
    product(&way(p, q), &way(p, r))
}

#[inline]
pub fn product(u: &[i64; 3], v: &[i64; 3]) -> [i64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// How far s lies above the plane through p, in lengths of its normal.
#[inline]
fn above(normal: &[i64; 3], p: &Point, s: &Point) -> i128 {
    let w = way(p, s);
    let product = |k: usize| i128::from(normal[k]) * i128::from(w[k]);
    product(0) + product(1) + product(2)
}

#[inline]
pub fn way(from: &Point, to: &Point) -> [i64; 3] {
    [
        i64::from(to[0]) - i64::from(from[0]),
        i64::from(to[1]) - i64::from(from[1]),
        i64::from(to[2]) - i64::from(from[2]),
    ]
}

/// Whether all of `of` lies on the plane of a triangle or above it, for planes square to an axis: then they do not meet.
/// Faces that lie on one another from outside are told apart here.
#[inline]
pub fn lies_on(plane: &Numbered, of: &Numbered) -> bool {
    let [p, q, r] = plane.corner;
    let Some(k) = (0..3).find(|&k| p[k] == q[k] && q[k] == r[k]) else { return false };
    let upward = exact_normal(p, q, r)[k].signum();
    of.corner.iter().all(|s| upward * (i64::from(s[k]) - i64::from(p[k])) >= 0)
}

/// A triangle in floating point: worked out once for all that it is tried with.
pub struct Facet<'a> {
    pub of: &'a Numbered<'a>,
    /// Exact, as are all differences of 32-bit numbers.
    corner: [[f64; 3]; 3],
    /// From the first corner to the others.
    ways: [[f64; 3]; 2],
    /// The longest component of the ways.
    size: f64,
    /// Each component is off by 4 units of 2^-53 size^2 at most.
    normal: [f64; 3],
}

impl<'a> Facet<'a> {
    #[inline]
    pub fn new(of: &'a Numbered<'a>) -> Facet<'a> {
        let corner = of.corner.map(|v| [f64::from(v[0]), f64::from(v[1]), f64::from(v[2])]);
        let ways = [sub(&corner[1], &corner[0]), sub(&corner[2], &corner[0])];
        let size = greater(longest(&ways[0]), longest(&ways[1]));
        Facet { of, corner, ways, size, normal: cross(&ways[0], &ways[1]) }
    }

    /// Whether all corners of a triangle but those in `but`, a bit each, certainly lie on one side of this one's plane.
    #[inline]
    pub fn has_on_one_side(&self, other: &Facet, but: u8) -> bool {
        let mut size = self.size;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, corner) in other.corner.iter().enumerate() {
            if but >> k & 1 == 1 {
                continue;
            }
            let w = sub(corner, &self.corner[0]);
            size = greater(size, longest(&w));
            let side = dot(&self.normal, &w);
            (low, high) = (-greater(-low, -side), greater(high, side));
        }
        // The sum is off by 30 units of 2^-53 size^3.
        let error = 32.0 * f64::EPSILON * size * size * size;
        low > error || high < -error
    }

    /// ```text
    ///        /\   |   b      A wall stands on each side of a, square to its plane: all of b is outside one of them.
    ///       / a\  |  /\
    ///      /____\ | /__\
    /// ```
    #[inline]
    fn has_beside(&self, other: &Facet) -> bool {
        let [u, v] = &self.ways;
        let ways = other.corner.map(|corner| sub(&corner, &self.corner[0]));
        let size = ways.iter().map(longest).fold(self.size, greater);
        // A wall's normal is off by 32 units of 2^-53 size^3 and at most 8 size^3 long, a place beside it 2 sizes away:
        // the sum is off by 320 units of 2^-53 size^4.
        let error = 256.0 * f64::EPSILON * size * size * size * size;
        let outside = |from: &[f64; 3], side: &[f64; 3]| {
            let outward = cross(side, &self.normal);
            ways.iter().all(|w| dot(&outward, &sub(w, from)) > error)
        };
        outside(&[0.0; 3], u) || outside(u, &sub(v, u)) || outside(v, &[-v[0], -v[1], -v[2]])
    }
}

/// Whether two triangles certainly do not meet, or only in the corner that they share: the other corners of one lie on
/// one side of the other's plane, or of the wall on one of its sides. Decided in floating point, and only where the
/// rounding cannot matter.
#[inline]
pub fn apart(a: &Facet, b: &Facet) -> bool {
    // The smaller one rather lies on one side of the larger one than the other way round.
    let (a, b) = if a.size < b.size { (b, a) } else { (a, b) };
    let (on_a, on_b) = (shared(b.of, a.of), shared(a.of, b.of));
    a.has_on_one_side(b, on_b) || b.has_on_one_side(a, on_a) || on_a == 0 && (a.has_beside(b) || b.has_beside(a))
}

/// The corners of `of`, a bit each, that are corners of the other triangle too.
#[inline]
fn shared(other: &Numbered, of: &Numbered) -> u8 {
    (0..3).fold(0, |bits, k| bits | u8::from(other.number.contains(&of.number[k])) << k)
}

#[inline]
fn longest(v: &[f64; 3]) -> f64 {
    greater(greater(v[0].abs(), v[1].abs()), v[2].abs())
}

/// Of two numbers, where neither is NaN: `f64::max` asks for that.
#[inline]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// None where they do not meet, or only in a point, or lie in one plane.
pub fn meet(a: &Numbered, b: &Numbered) -> Option<Meeting> {
    let side_b = sides(a, b)?;
    let side_a = sides(b, a)?;
    let mut found = Ends::default();
    pierce(a, &side_a, b, &mut found);
    pierce(b, &side_b, a, &mut found);
    let ends = found.farthest()?;
    let (na, nb) = (Facet::new(a).normal, Facet::new(b).normal);
    let length = |v: &[f64; 3]| dot(v, v).sqrt();
    let (la, lb) = (length(&na), length(&nb));
    let depth = (shallower(&side_a) / lb).min(shallower(&side_b) / la);
    Some(Meeting { ends, depth, sine: length(&cross(&na, &nb)) / (la * lb) })
}

/// Sides of `of`'s corners against the plane of `plane`; None where the plane does not part them.
fn sides(plane: &Numbered, of: &Numbered) -> Option<[i128; 3]> {
    let [p, q, r] = plane.corner;
    let normal = exact_normal(p, q, r);
    let [a, b, c] = of.corner;
    let found = [above(&normal, p, a), above(&normal, p, b), above(&normal, p, c)];
    let below = found.iter().filter(|&&s| s < 0).count();
    (below == 1 || below == 2).then_some(found)
}

/// Points where edges of `a` go through `b`; side: of a's corners against b's plane.
fn pierce(a: &Numbered, side: &[i128; 3], b: &Numbered, found: &mut Ends) {
    for k in 0..3 {
        let (mut i, mut j) = (k, (k + 1) % 3);
        if (side[i] < 0) == (side[j] < 0) {
            continue;
        }
        if a.number[i] > a.number[j] {
            (i, j) = (j, i);
        }
        let (p, q) = (a.corner[i], a.corner[j]);
        let turn = |m: usize| orient3d(p, q, b.corner[m], b.corner[(m + 1) % 3]).signum();
        let turns = [turn(0), turn(1), turn(2)];
        if turns.contains(&1) && turns.contains(&-1) {
            continue;
        }
        let t = side[i] as f64 / (side[i] - side[j]) as f64;
        found.add(
            [0, 1, 2].map(|c| (f64::from(p[c]) + t * (f64::from(q[c]) - f64::from(p[c]))).round_ties_even() as i32),
        );
    }
}

/// Ends of the common segment, each found once or more.
#[derive(Default)]
struct Ends {
    points: [Point; 6],
    count: usize,
}

impl Ends {
    fn add(&mut self, point: Point) {
        if !self.points[..self.count].contains(&point) && self.count < 6 {
            self.points[self.count] = point;
            self.count += 1;
        }
    }

    fn farthest(&self) -> Option<[Point; 2]> {
        let points = &self.points[..self.count];
        let apart =
            |p: &Point, q: &Point| -> i128 { (0..3).map(|k| (i128::from(p[k]) - i128::from(q[k])).pow(2)).sum() };
        let mut best = None;
        for (i, p) in points.iter().enumerate() {
            for q in &points[i + 1..] {
                let pair = if p < q { [*p, *q] } else { [*q, *p] };
                let key = (apart(p, q), pair);
                if best.is_none_or(|b| key > b) {
                    best = Some(key);
                }
            }
        }
        best.map(|(_, pair)| pair)
    }
}

fn shallower(side: &[i128; 3]) -> f64 {
    let above = side.iter().copied().fold(0, i128::max);
    let below = side.iter().copied().fold(0, i128::min);
    above.min(-below) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::below;

    fn met(a: [Point; 3], b: [Point; 3]) -> Option<Meeting> {
        let (a, b) = (a.each_ref(), b.each_ref());
        meet(&Numbered { corner: a, number: [0, 1, 2] }, &Numbered { corner: b, number: [3, 4, 5] })
    }

    const FLOOR: [Point; 3] = [[-100, -100, 0], [100, -100, 0], [0, 100, 0]];

    #[test]
    fn a_wall_through_a_floor() {
        let found = met(FLOOR, [[-10, 0, -7], [10, 0, -7], [0, 0, 20]]).unwrap();
        assert_eq!((found.ends[0][1], found.ends[1][1]), (0, 0));
        assert_eq!((found.ends[0][2], found.ends[1][2]), (0, 0));
        assert_eq!((found.depth, found.sine), (7.0, 1.0));
        let other_way = met([[-10, 0, -7], [10, 0, -7], [0, 0, 20]], FLOOR).unwrap();
        assert_eq!(found.ends, other_way.ends);
    }

    #[test]
    fn what_only_touches_does_not_meet() {
        assert_eq!(met(FLOOR, [[0, 0, 0], [5, 0, 9], [0, 5, 9]]), None);
        assert_eq!(met(FLOOR, [[0, 0, 0], [5, 0, -9], [0, 5, -9]]), None);
        assert_eq!(met(FLOOR, [[-9, 0, 0], [9, 0, 0], [0, 9, 0]]), None);
        assert_eq!(met(FLOOR, [[-9, 0, 5], [9, 0, 5], [0, 0, 9]]), None);
        assert_eq!(met(FLOOR, [[300, 0, -5], [310, 0, -5], [300, 0, 9]]), None);
    }

    #[test]
    fn a_face_that_ends_on_a_plane_meets_it_from_one_side_only() {
        let above = met(FLOOR, [[-9, 0, 0], [9, 0, 0], [0, 0, 9]]);
        let below = met(FLOOR, [[-9, 0, 0], [9, 0, 0], [0, 0, -9]]);
        assert!(above.is_some() != below.is_some());
        assert_eq!(above.or(below).unwrap().ends, [[-9, 0, 0], [9, 0, 0]]);
        assert_eq!(above.or(below).unwrap().depth, 0.0);
    }

    #[test]
    fn edges_that_cross_end_the_segment_for_both_neighbours() {
        // The wall's foot crosses the floor's diagonal: both halves of the floor end there.
        let wall = [[-50, 0, -10], [50, 0, -10], [0, 0, 90]];
        let left = met([[-100, -100, 0], [0, -100, 0], [0, 100, 0]], wall).unwrap();
        let right = met([[0, -100, 0], [100, -100, 0], [0, 100, 0]], wall).unwrap();
        assert_eq!(left.ends[1], right.ends[0]);
    }

    #[test]
    fn what_is_called_apart_does_not_meet() {
        let mut random = below(1);
        let (mut told, mut met, mut on) = (0, 0, 0);
        for k in 0..20_000 {
            let range = [5, 50, 1 << 30][k % 3];
            let corners: Vec<Point> = (0..6).map(|_| [0, 1, 2].map(|_| random(range))).collect();
            // Every other pair shares a corner.
            let last = if k % 2 == 0 { 5 } else { 0 };
            let a = Numbered { corner: [&corners[0], &corners[1], &corners[2]], number: [0, 1, 2] };
            let b = Numbered { corner: [&corners[3], &corners[4], &corners[last]], number: [3, 4, last as i32] };
            let found = meet(&a, &b).is_some();
            let apart = apart(&Facet::new(&a), &Facet::new(&b));
            assert!(!(apart && found), "{corners:?}");
            assert!(!(lies_on(&a, &b) && found), "{corners:?}");
            assert_eq!(lies_on(&a, &b), is_square(&a) && sides_of(&a, &b).iter().all(|s| *s >= 0), "{corners:?}");
            on += usize::from(lies_on(&a, &b));
            told += usize::from(apart);
            met += usize::from(found);
        }
        assert!(told > 5_000 && met > 1_000 && on > 100, "{told} {met} {on}");
    }

    fn is_square(a: &Numbered) -> bool {
        (0..3).any(|k| a.corner.iter().all(|p| p[k] == a.corner[0][k]))
    }

    fn sides_of(a: &Numbered, b: &Numbered) -> [i128; 3] {
        b.corner.map(|s| orient3d(a.corner[0], a.corner[1], a.corner[2], s))
    }

    #[test]
    fn the_largest_coordinates_do_not_overflow() {
        let m = 1 << 29;
        assert!(orient3d(&[-2 * m; 3], &[2 * m - 1, -m, -m], &[-m, 2 * m - 1, -m], &[-m, -m, 2 * m - 1]) > 0);
        let found = met([[-m, -m, 0], [m, -m, 0], [0, m, 0]], [[-m, 0, -m], [m, 0, -m], [0, 0, m]]).unwrap();
        assert_eq!(found.ends, [[-m / 2, 0, 0], [m / 2, 0, 0]]);
    }
}
