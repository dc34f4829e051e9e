//! The geometric predicates of the visibility pass: signs of integer polynomials in the snapped points.
//!
//! Ties are broken by symbolic perturbation. A drawn segment f = a -> b counts as moved by (e^2, e^3, -e) for an
//! infinitely small e > 0, and its end points as moved inward by eta (b - a) with eta >> e. Perturbing f alone is
//! enough (no two obscuring things are ever compared), and every tie below is one of these two shifts, spelled out:
//!
//! ```text
//!   a on the line p->q        the other end's side decides (eta); both on it: the shift (e^2, e^3)
//!   p or q on the line a->b   the shift, seen from the other side
//!   equal depth               f is in front (the -e)
//! ```
//! So a face that contains f, or is coplanar with it, never hides it, and an edge that leaves a shared vertex
//! behind a face is hidden from its very start.
//!
//! Written once for all kinds of numbers (`arithmetic`); only with exact ones are the signs the true ones.

use super::Point;
use super::arithmetic::{Arithmetic, Ring};

/// Twice the signed area of p, q, r in the image; positive counter-clockwise. |result| < 2^63.
#[inline(always)]
pub fn orient2d<A: Arithmetic>(p: &Point, q: &Point, r: &Point) -> A::Area {
    let c = A::coordinate;
    let (px, py) = (c(p[0]), c(p[1]));
    (c(q[0]) - px) * (c(r[1]) - py) - (c(q[1]) - py) * (c(r[0]) - px)
}

/// Side of the line p -> q on which a point shifted by (e^2, e^3) lies, where the point itself is on the line.
#[inline]
pub fn shifted_side(p: &Point, q: &Point) -> i32 {
    let dy = i64::from(q[1]) - i64::from(p[1]);
    if dy != 0 {
        return -(dy.signum() as i32);
    }
    (i64::from(q[0]) - i64::from(p[0])).signum() as i32
}

/// Side of the line p -> q of the inward-moved end point of f, from the orientations of this end and the other.
#[inline]
pub fn end_side<N: Ring>(here: N, there: N, p: &Point, q: &Point) -> i32 {
    if here != N::ZERO {
        here.sign()
    } else if there != N::ZERO {
        there.sign()
    } else {
        shifted_side(p, q)
    }
}

/// Where f = a -> b passes behind the edge p -> q: the parameter n / d on f, and the depth of f beneath the edge.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<A: Arithmetic> {
    pub n: A::Area,
    pub d: A::Area,
    /// (z of f - z of the edge) * d at the crossing.
    pub beneath: A::Volume,
    /// +1 where f goes to the left of p -> q, -1 where it goes to the right.
    pub to_left: i32,
}

/// The crossing of two segments in the image, or None. Degree 2 to find it, degree 3 for the depth.
#[inline(always)]
pub fn crossing<A: Arithmetic>(a: &Point, b: &Point, p: &Point, q: &Point) -> Option<Crossing<A>> {
    let zero = A::Area::ZERO;
    let oa = orient2d::<A>(p, q, a);
    let ob = orient2d::<A>(p, q, b);
    // A touching end point takes the side of the other end, so only a strict change of side crosses.
    if (oa <= zero && ob <= zero) || (oa >= zero && ob >= zero) {
        return None;
    }
    let op = orient2d::<A>(a, b, p);
    let oq = orient2d::<A>(a, b, q);
    let side = |o: A::Area| if o != zero { o.sign() } else { -shifted_side(a, b) };
    if side(op) == side(oq) {
        return None;
    }
    let d = oa - ob;
    let z = |v: &Point| A::depth(i64::from(v[2]));
    let beneath = (z(a) - z(p)) * A::raise(d) + A::raise(oa) * (z(b) - z(a)) + A::raise(op) * (z(q) - z(p));
    let flip = d < zero;
    Some(Crossing {
        n: if flip { -oa } else { oa },
        d: if flip { -d } else { d },
        beneath: if flip { -beneath } else { beneath },
        to_left: if oa < zero { 1 } else { -1 },
    })
}

/// Whether a triangle lies strictly on one side of the line a -> b in the image: then it neither hides any of the
/// segment, nor is crossed or pierced by it.
#[inline(always)]
pub fn is_beside<A: Arithmetic>(a: &Point, b: &Point, triangle: [&Point; 3]) -> bool {
    let [p, q, r] = triangle.map(|v| orient2d::<A>(a, b, v).sign());
    p != 0 && p == q && q == r
}

/// A triangle with non-zero image area, turned counter-clockwise, ready for point queries.
#[derive(Clone, Copy, Debug)]
pub struct Cover<A: Arithmetic> {
    pub p: Point,
    pub q: Point,
    pub r: Point,
    /// Twice its image area, positive.
    pub area: A::Area,
}

impl<A: Arithmetic> Cover<A> {
    /// None for a triangle seen edge-on: it never covers.
    #[inline]
    pub fn new(p: &Point, q: &Point, r: &Point) -> Option<Cover<A>> {
        let area = orient2d::<A>(p, q, r);
        match area.sign() {
            1 => Some(Cover { p: *p, q: *q, r: *r, area }),
            -1 => Some(Cover { p: *p, q: *r, r: *q, area: -area }),
            _ => None,
        }
    }

    /// Orientations of `v` against the three edges, each opposite to p, q, r in turn.
    #[inline(always)]
    pub fn sides(&self, v: &Point) -> [A::Area; 3] {
        [orient2d::<A>(&self.q, &self.r, v), orient2d::<A>(&self.r, &self.p, v), orient2d::<A>(&self.p, &self.q, v)]
    }

    /// The same, or None as soon as one of them is negative: `v` lies outside.
    #[inline(always)]
    pub fn sides_within(&self, v: &Point) -> Option<[A::Area; 3]> {
        let one = orient2d::<A>(&self.q, &self.r, v);
        if one < A::Area::ZERO {
            return None;
        }
        let two = orient2d::<A>(&self.r, &self.p, v);
        if two < A::Area::ZERO {
            return None;
        }
        let three = orient2d::<A>(&self.p, &self.q, v);
        (three >= A::Area::ZERO).then_some([one, two, three])
    }

    /// (z of v - z of the triangle's plane there) * area: positive where the triangle's plane is in front.
    #[inline(always)]
    pub fn beneath(&self, v: &Point, sides: &[A::Area; 3]) -> A::Volume {
        let depth = |c: &Point| A::depth(i64::from(c[2]));
        let z = |s: A::Area, c: &Point| A::raise(s) * (depth(c) - depth(v));
        -(z(sides[0], &self.p) + z(sides[1], &self.q) + z(sides[2], &self.r))
    }

    /// The edge opposite to corner k, counter-clockwise.
    #[inline]
    pub fn edge(&self, k: usize) -> (&Point, &Point) {
        match k {
            0 => (&self.q, &self.r),
            1 => (&self.r, &self.p),
            _ => (&self.p, &self.q),
        }
    }

    /// Whether the triangle hides the inward-moved end `here` of the segment here -> there, for f as it lies and
    /// for f moved toward the viewer by `delta`.
    pub fn hides_end(&self, here: &Point, there: &Point, delta: i64) -> (bool, bool) {
        let zero = A::Area::ZERO;
        let mut oh = [zero; 3];
        for (k, side) in oh.iter_mut().enumerate() {
            let (p, q) = self.edge(k);
            *side = orient2d::<A>(p, q, here);
            // Mostly a triangle around the vertex itself, away from the direction in which f leaves: out at once.
            if *side < zero || (*side == zero && end_side(zero, orient2d::<A>(p, q, there), p, q) < 0) {
                return (false, false);
            }
        }
        let gh = self.beneath(here, &oh);
        let shift = self.shift(delta);
        let mut gt = None;
        let mut behind = |s: A::Volume| {
            if gh != s { gh > s } else { *gt.get_or_insert_with(|| self.beneath(there, &self.sides(there))) > s }
        };
        let plain = behind(A::Volume::ZERO);
        (plain, if delta == 0 { plain } else { behind(shift) })
    }

    /// A depth tolerance as `beneath` counts depth.
    #[inline(always)]
    pub fn shift(&self, delta: i64) -> A::Volume {
        A::depth(delta) * A::raise(self.area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::Exact;

    type Cover = super::Cover<Exact>;

    fn crossing(a: &Point, b: &Point, p: &Point, q: &Point) -> Option<Crossing<Exact>> {
        super::crossing(a, b, p, q)
    }

    #[test]
    fn a_segment_beneath_an_edge_is_crossed_once() {
        let c = crossing(&[0, 0, 10], &[10, 0, 10], &[5, -5, 0], &[5, 5, 0]).unwrap();
        assert_eq!((c.n * 2, c.to_left), (c.d, -1));
        assert_eq!(c.beneath, 10 * i128::from(c.d));
    }

    #[test]
    fn touching_end_points_do_not_cross() {
        // a lies on the edge: the seed at a' already sees the side to which f leaves.
        assert!(crossing(&[0, 0, 5], &[10, 0, 5], &[0, -5, 0], &[0, 5, 0]).is_none());
        // The edge's end lies on f: exactly one of two edges meeting there is crossed.
        let up = crossing(&[-5, 0, 5], &[5, 0, 5], &[0, 0, 0], &[0, 9, 0]).is_some();
        let down = crossing(&[-5, 0, 5], &[5, 0, 5], &[0, 0, 0], &[0, -9, 0]).is_some();
        assert!(up != down);
    }

    #[test]
    fn a_face_that_contains_the_segment_does_not_hide_it() {
        let t = Cover::new(&[0, 0, 0], &[10, 0, 0], &[0, 10, 0]).unwrap();
        assert_eq!(t.hides_end(&[1, 1, 0], &[3, 3, 0], 0), (false, false));
        assert_eq!(t.hides_end(&[1, 1, 0], &[3, 3, 5], 0), (true, true));
        assert_eq!(t.hides_end(&[1, 1, 3], &[3, 3, 3], 3), (true, false));
    }

    #[test]
    fn a_triangle_beside_a_segment_does_nothing_to_it() {
        let (mut state, mut beside) = (1u64, 0);
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) % 7) as i32
        };
        for _ in 0..20_000 {
            let [a, b, p, q, r] = [(); 5].map(|()| [random(), random(), random()]);
            let Some(cover) = Cover::new(&p, &q, &r) else { continue };
            if !is_beside::<Exact>(&a, &b, [&p, &q, &r]) {
                continue;
            }
            beside += 1;
            assert_eq!([cover.hides_end(&a, &b, 1), cover.hides_end(&b, &a, 1)], [(false, false); 2]);
            assert!((0..3).all(|k| crossing(&a, &b, cover.edge(k).0, cover.edge(k).1).is_none()));
        }
        assert!(beside > 5000);
    }

    #[test]
    fn extreme_corners_do_not_overflow() {
        let m = (1 << 30) - 1;
        let z = 1 << 29;
        let t = Cover::new(&[-m, -m, -z], &[m, -m, z], &[m, m, -z]).unwrap();
        assert_eq!(t.area, 4 * i64::from(m) * i64::from(m));
        let _ = t.hides_end(&[m, m, z], &[-m, -m, z], 1 << 28);
        let _ = crossing(&[-m, -m, -z], &[m, m, z], &[-m, m, z], &[m, -m, -z]).unwrap();
    }
}
