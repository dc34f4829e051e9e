//! Finds pieces of a surface that are height fields: along one axis their triangles lie side by side, so no two of them
//! meet.
//!
//! If all triangles are turned one way, the number of them that cover a place is the winding number of their common
//! border around it: sides that two triangles share cancel. If the border touches itself nowhere and runs once around
//! what it encloses, that number is 1 inside and 0 outside. So only the border has to be checked: on a smooth surface,
//! a few hundred sides for thousands of triangles.
//!
//! ```text
//!      ______            Then two triangles have nothing in common but the corners and sides that they share: inside,
//!     /\  /\ \           a place on a side or at a corner is covered all around by the triangles there, and the border
//!    /__\/__\_\          does not touch itself.
//!    \  /\  / /
//! ```
//!
//! After P. Volino and N. Magnenat-Thalmann, "Efficient self-collision detection on smoothly discretized surface
//! animations using geometrical shape regularity", Computer Graphics Forum 13 (1994), which does not check the border.

use std::cmp::Ordering;

use super::triangle_pair::{Numbered, product, way};
use hlr_exact::Point;

/// Most triangles of a piece.
pub const MOST: usize = 1 << 15;

/// A point projected along the axis.
type Place = [i64; 2];

/// A directed side of the border: the piece lies to its left.
#[derive(Clone, Copy)]
struct Side {
    from: i32,
    to: i32,
    a: Place,
    b: Place,
}

/// The axes and senses along which the outside of a triangle is seen: two bits per axis.
pub fn seen_along(corners: [&Point; 3]) -> u8 {
    (0..3).fold(0, |bits, axis| {
        let [p, q, r] = corners.map(|p| place(p, axis, true));
        bits | match turn(&p, &q, &r).cmp(&0) {
            Ordering::Greater => 1 << (2 * axis),
            Ordering::Less => 2 << (2 * axis),
            Ordering::Equal => 0,
        }
    })
}

/// Whether these triangles are a height field along one of the axes that they are all seen along.
pub fn is_height_field(points: &[Point], triangles: impl Iterator<Item = [i32; 3]>, along: u8) -> bool {
    let Some(border) = border(triangles) else { return false };
    (0..6).filter(|bit| along >> bit & 1 == 1).any(|bit| {
        let at = |v: i32| place(&points[v as usize], bit / 2, bit % 2 == 0);
        let mut sides: Vec<Side> = border.iter().map(|&[from, to]| Side { from, to, a: at(from), b: at(to) }).collect();
        once_around(&sides) && !touches_itself(&mut sides)
    })
}

/// A place along an axis as it is seen, or from behind.
#[inline]
fn place(p: &Point, axis: usize, outside: bool) -> Place {
    let (x, y) = (i64::from(p[(axis + 1) % 3]), i64::from(p[(axis + 2) % 3]));
    if outside { [x, y] } else { [y, x] }
}

/// Twice the signed area. Coordinates are at most 2^30, so this is less than 2^63.
#[inline]
fn turn(p: &Place, q: &Place, r: &Place) -> i64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

const EMPTY: u64 = u64::MAX;
const FORTH: u8 = 1;
const BACK: u8 = 2;

/// The sides that only one triangle has, sorted by their first corners. None if a side is used twice in one direction,
/// or if the border passes a corner more than once.
fn border(triangles: impl Iterator<Item = [i32; 3]>) -> Option<Vec<[i32; 2]>> {
    let (least, most) = triangles.size_hint();
    let slots = (4 * most.unwrap_or(least)).next_power_of_two().max(16);
    let shift = 64 - slots.trailing_zeros();
    let (mut keys, mut used) = (vec![EMPTY; slots], vec![0u8; slots]);
    for [p, q, r] in triangles {
        for (a, b) in [(p, q), (q, r), (r, p)] {
            let key = (a.min(b) as u64) << 32 | a.max(b) as u64;
            let mut slot = (key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> shift) as usize;
            while keys[slot] != EMPTY && keys[slot] != key {
                slot = (slot + 1) & (slots - 1);
            }
            let way = if a < b { FORTH } else { BACK };
            if used[slot] & way != 0 {
                return None;
            }
            keys[slot] = key;
            used[slot] |= way;
        }
    }
    let mut out: Vec<[i32; 2]> = keys
        .iter()
        .zip(&used)
        .filter(|(_, used)| **used == FORTH || **used == BACK)
        .map(|(&key, &used)| {
            let (low, high) = ((key >> 32) as i32, key as i32);
            if used == FORTH { [low, high] } else { [high, low] }
        })
        .collect();
    out.sort_unstable();
    (out.windows(2).all(|w| w[0][0] != w[1][0])).then_some(out)
}

/// Whether the border consists of one outer loop, or of several apart from one another, and of holes, which run the
/// other way.
fn once_around(sides: &[Side]) -> bool {
    let mut passed = vec![false; sides.len()];
    let mut around: Vec<[Place; 2]> = Vec::new();
    for start in 0..sides.len() {
        let (mut at, mut area) = (start, 0i128);
        let mut bounds = [sides[start].a; 2];
        while !passed[at] {
            passed[at] = true;
            let Side { to, a, b, .. } = &sides[at];
            area += i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0]);
            for k in [0, 1] {
                bounds[0][k] = bounds[0][k].min(b[k]);
                bounds[1][k] = bounds[1][k].max(b[k]);
            }
            // Every corner at which a side ends is one at which a side begins.
            match sides.binary_search_by_key(to, |s| s.from) {
                Ok(next) => at = next,
                Err(_) => return false,
            }
        }
        let apart = |other: &[Place; 2]| (0..2).any(|k| bounds[0][k] > other[1][k] || bounds[1][k] < other[0][k]);
        if area > 0 {
            if !around.iter().all(apart) {
                return false;
            }
            around.push(bounds);
        }
    }
    true
}

/// Whether two sides have a point in common that is not a corner of both.
fn touches_itself(sides: &mut [Side]) -> bool {
    sides.sort_unstable_by_key(|s| (s.a[0].min(s.b[0]), s.from));
    let mut active: Vec<Side> = Vec::new();
    for s in sides.iter() {
        let left = s.a[0].min(s.b[0]);
        let (low, high) = (s.a[1].min(s.b[1]), s.a[1].max(s.b[1]));
        let mut k = 0;
        while k < active.len() {
            let other = &active[k];
            if other.a[0].max(other.b[0]) < left {
                active.swap_remove(k);
                continue;
            }
            k += 1;
            if other.a[1].max(other.b[1]) >= low && other.a[1].min(other.b[1]) <= high && touch(s, other) {
                return true;
            }
        }
        active.push(*s);
    }
    false
}

fn touch(s: &Side, t: &Side) -> bool {
    if s.to == t.from || t.to == s.from {
        if s.to == t.from && t.to == s.from {
            return true;
        }
        let (corner, p, q) = if s.to == t.from { (&s.b, &s.a, &t.b) } else { (&s.a, &s.b, &t.a) };
        // Folded back onto itself.
        let along = (0..2).map(|k| i128::from(p[k] - corner[k]) * i128::from(q[k] - corner[k])).sum::<i128>();
        return turn(corner, p, q) == 0 && along > 0;
    }
    let beside = |s: &Side, t: &Side| {
        let (a, b) = (turn(&s.a, &s.b, &t.a), turn(&s.a, &s.b, &t.b));
        (a > 0 && b > 0) || (a < 0 && b < 0)
    };
    !beside(s, t) && !beside(t, s)
}

/// Whether two triangles that share a corner certainly meet nowhere else: projected along the axis along which the
/// narrower of them appears widest, a side of one of them at that corner separates them.
pub fn only_at(a: &Numbered, b: &Numbered, corner: i32) -> bool {
    let ways = |of: &Numbered| {
        let [p, q, r] = of.corner;
        match of.number.iter().position(|&v| v == corner) {
            Some(1) => [way(q, r), way(q, p)],
            Some(2) => [way(r, p), way(r, q)],
            _ => [way(p, q), way(p, r)],
        }
    };
    let (a, b) = (ways(a), ways(b));
    let (n, m) = (product(&a[0], &a[1]), product(&b[0], &b[1]));
    let width = |k: usize| n[k].unsigned_abs().min(m[k].unsigned_abs());
    let widest = width(0).max(width(1)).max(width(2));
    if widest == 0 {
        false
    } else if width(2) == widest {
        parted::<0, 1>(&a, n[2], &b, m[2])
    } else if width(1) == widest {
        parted::<2, 0>(&a, n[1], &b, m[1])
    } else {
        parted::<1, 2>(&a, n[0], &b, m[0])
    }
}

/// Whether a side of one of two triangles separates them, seen along an axis: X and Y are the other two. n, m: of their
/// normals, what is along that axis.
#[inline]
fn parted<const X: usize, const Y: usize>(a: &[[i64; 3]; 2], n: i64, b: &[[i64; 3]; 2], m: i64) -> bool {
    let side = |u: &[i64; 3], v: &[i64; 3]| (u[X] * v[Y] - u[Y] * v[X]).signum();
    let by = |[u, v]: &[[i64; 3]; 2], n: i64, others: &[[i64; 3]; 2]| {
        let beyond = |w: &[i64; 3], sign: i64| side(w, &others[0]) == sign && side(w, &others[1]) == sign;
        beyond(u, -n.signum()) || beyond(v, n.signum())
    };
    by(a, n, b) || by(b, m, a)
}

#[cfg(test)]
mod tests {
    use super::super::triangle_pair::meet;
    use super::*;
    use crate::random::below;

    fn told(points: &[Point], triangles: &[[i32; 3]]) -> bool {
        let corners = |t: &[i32; 3]| t.map(|v| &points[v as usize]);
        let along = triangles.iter().fold(u8::MAX, |bits, t| bits & seen_along(corners(t)));
        is_height_field(points, triangles.iter().copied(), along)
    }

    fn any_meet(points: &[Point], triangles: &[[i32; 3]]) -> bool {
        let numbered = |t: &[i32; 3]| Numbered { corner: t.map(|v| &points[v as usize]), number: *t };
        triangles.iter().enumerate().any(|(k, a)| {
            let far = triangles[k + 1..].iter().filter(|b| a.iter().filter(|v| b.contains(v)).count() < 2);
            far.into_iter().any(|b| meet(&numbered(a), &numbered(b)).is_some())
        })
    }

    /// A ramp around a shaft: `turns` turns, `steps` corners per turn, climbing by `climb`.
    fn ramp(steps: i32, turns: i32, climb: i32) -> (Vec<Point>, Vec<[i32; 3]>) {
        let corner = |k: i32, radius: f64| {
            let angle = f64::from(k) * std::f64::consts::TAU / f64::from(steps);
            [(radius * angle.cos()) as i32, (radius * angle.sin()) as i32, k * climb]
        };
        let last = steps * turns;
        let points = (0..=last).flat_map(|k| [corner(k, 1000.0), corner(k, 3000.0)]).collect();
        (points, (0..last).flat_map(|k| [[2 * k, 2 * k + 1, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 2]]).collect())
    }

    #[test]
    fn a_ramp_is_one_until_it_comes_round() {
        let (points, mut triangles) = ramp(12, 1, 100);
        // The image of its end touches the image of its beginning.
        assert!(!told(&points, &triangles));
        triangles.truncate(22);
        assert!(told(&points, &triangles));
        let (points, triangles) = ramp(12, 2, 100);
        assert!(!told(&points, &triangles) && !any_meet(&points, &triangles));
    }

    #[test]
    fn a_hole_is_no_harm_and_one_sheet_above_another_is() {
        let corner = |k: i32| [k % 4 * 10, k / 4 * 10, k * k % 7];
        let mut points: Vec<Point> = (0..16).map(corner).collect();
        let square = |k: i32| [[k, k + 1, k + 5], [k, k + 5, k + 4]];
        let mut triangles: Vec<[i32; 3]> = [0, 1, 2, 4, 6, 8, 9, 10].into_iter().flat_map(square).collect();
        assert!(told(&points, &triangles));
        for (shift, apart) in [([2, 2], false), ([40, 0], true), ([30, 0], false)] {
            points.truncate(16);
            points.extend((0..16).map(corner).map(|[x, y, z]| [x + shift[0], y + shift[1], z + 100]));
            triangles.truncate(16);
            triangles.extend([0, 1].into_iter().flat_map(square).map(|t| t.map(|v| v + 16)));
            assert_eq!(told(&points, &triangles), apart, "{shift:?}");
        }
    }

    #[test]
    fn a_corner_on_the_side_of_a_stranger_and_a_side_used_twice_are_told() {
        let points = [[0, 0, 0], [20, 0, 0], [0, 20, 0], [10, 0, 3], [15, -9, 0], [5, -9, 0], [9, 9, 9]];
        assert!(!told(&points, &[[0, 1, 2], [3, 5, 4]]));
        assert!(!told(&points, &[[0, 1, 2], [0, 1, 6]]));
        assert!(told(&points, &[[0, 1, 2], [0, 5, 1]]));
        assert!(told(&points, &[[0, 1, 2]]) && told(&points, &[]));
    }

    #[test]
    fn where_it_says_so_no_two_triangles_meet() {
        let mut random = below(1);
        let (mut fields, mut meeting) = (0, 0);
        for _ in 0..4000 {
            // A sheet whose corners are moved at random until it folds over.
            let shake = 1 + random(14);
            let points: Vec<Point> =
                (0..16).map(|k| [k % 4 * 8 + random(shake), k / 4 * 8 + random(shake), random(30)]).collect();
            let triangles: Vec<[i32; 3]> = (0..11)
                .filter(|k| k % 4 != 3)
                .flat_map(|k| [[k, k + 1, k + 5], [k, k + 5, k + 4]])
                .filter(|_| random(8) > 0)
                .collect();
            let (field, meets) = (told(&points, &triangles), any_meet(&points, &triangles));
            assert!(!field || !meets, "{points:?} {triangles:?}");
            fields += i32::from(field);
            meeting += i32::from(meets);
        }
        assert!(fields > 300 && meeting > 300, "{fields} {meeting}");
    }

    #[test]
    fn triangles_that_meet_at_a_corner_alone() {
        let mut below = below(7);
        let mut random = |n: i32| below(n) - n / 2;
        let (mut alone, mut more) = (0, 0);
        for _ in 0..20_000 {
            let points: Vec<Point> = (0..5).map(|_| [random(9), random(9), random(9)]).collect();
            let (a, b) = ([0, 1, 2], [3, 0, 4]);
            let numbered = |t: &[i32; 3]| Numbered { corner: t.map(|v| &points[v as usize]), number: *t };
            let meets = meet(&numbered(&a), &numbered(&b)).is_some();
            let only = only_at(&numbered(&a), &numbered(&b), 0);
            assert!(!(only && meets), "{points:?}");
            assert_eq!(only, only_at(&numbered(&b), &numbered(&a), 0));
            alone += i32::from(only);
            more += i32::from(meets);
        }
        assert!(alone > 3000 && more > 1000, "{alone} {more}");
    }
}
