//! Edge flips: an inner edge becomes the other diagonal of its two triangles.

use super::plane::{area, side};
use crate::geometry::vector::{Vector, cross, dot, sub};

/// Limit on the rounds over all edges.
const ROUNDS: usize = 16;

/// Flips edges that cost more than the limit, where the other diagonal costs less. Returns whether any edge was
/// flipped.
pub fn flip(uv: &[[f64; 2]], triangles: &mut [[u32; 3]], cost: &impl Fn(u32, u32) -> f64, limit: f64) -> bool {
    let mut twins = twins(triangles);
    let mut changed = false;
    for _ in 0..ROUNDS {
        let mut turned = false;
        for edge in 0..3 * triangles.len() {
            let twin = twins[edge] as usize;
            if twins[edge] == NONE || twin < edge {
                continue;
            }
            let (a, b) = (start(triangles, edge), start(triangles, twin));
            let before = cost(a, b);
            if before <= limit {
                continue;
            }
            let (c, d) = (start(triangles, before_in(edge)), start(triangles, before_in(twin)));
            let at = |i: u32| &uv[i as usize];
            // Strictly convex: a d b c is counterclockwise.
            if c != d && side(at(d), at(b), at(c)) > 0.0 && side(at(c), at(a), at(d)) > 0.0 && cost(c, d) < before {
                turn(triangles, &mut twins, edge, twin);
                turned = true;
            }
        }
        changed |= turned;
        if !turned {
            break;
        }
    }
    changed
}

/// Flips edges of triangles that are turned over in (u, v), where that corrects them. Triangles that are
/// counterclockwise in a bent chart may be clockwise in (u, v).
pub fn upright(uv: &[[f64; 2]], triangles: &mut [[u32; 3]]) {
    // The rounded area decides nearly all triangles without exact arithmetic.
    let doubtful = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|i| uv[i as usize]);
        area(&a, &b, &c) <= 0.0
    };
    if !triangles.iter().any(|t| doubtful(&t)) {
        return;
    }
    let mut twins = twins(triangles);
    upright_of_twins(uv, triangles, &mut twins);
}

/// The same where the twins of all edges are known; they are kept right.
pub fn upright_of_twins(uv: &[[f64; 2]], triangles: &mut [[u32; 3]], twins: &mut [u32]) {
    let over = |t: [u32; 3]| {
        let [a, b, c] = t.map(|i| &uv[i as usize]);
        side(a, b, c) < 0.0
    };
    for t in 0..triangles.len() {
        let mut wrong = over(triangles[t]);
        for edge in 3 * t..3 * t + 3 {
            let twin = twins[edge] as usize;
            if !wrong || twins[edge] == NONE {
                continue;
            }
            let (a, b) = (start(triangles, edge), start(triangles, twin));
            let (c, d) = (start(triangles, before_in(edge)), start(triangles, before_in(twin)));
            if c != d && !over([c, d, b]) && !over([d, c, a]) {
                turn(triangles, twins, edge, twin);
                wrong = over(triangles[t]);
            }
        }
    }
}

/// Height divided by longest side. Below this a triangle is a needle.
const NEEDLE: f64 = 1e-6;

/// The height of a triangle divided by its longest side, negative where it is turned over in (u, v); and the number of
/// that side.
type Slim = (f64, usize);

/// How slim a triangle is in (u, v).
pub fn slim_in_plane(uv: &[[f64; 2]]) -> impl Fn([u32; 3]) -> Slim {
    |t| {
        let p = t.map(|i| uv[i as usize]);
        let (square, longest) = longest(|k, next| {
            let [u, v] = [0, 1].map(|c| p[next][c] - p[k][c]);
            u * u + v * v
        });
        (area(&p[0], &p[1], &p[2]) / square, longest)
    }
}

/// How slim a triangle is in space.
pub fn slim_in_space(uv: &[[f64; 2]], points: &[Vector]) -> impl Fn([u32; 3]) -> Slim {
    |t| {
        let p = t.map(|i| points[i as usize]);
        let (square, longest) = longest(|k, next| {
            let way = sub(&p[next], &p[k]);
            dot(&way, &way)
        });
        let n = cross(&sub(&p[1], &p[0]), &sub(&p[2], &p[0]));
        let [a, b, c] = t.map(|i| &uv[i as usize]);
        let height = dot(&n, &n).sqrt() / square;
        (if side(a, b, c) > 0.0 { height } else { -height }, longest)
    }
}

/// The longest of three sides; the square of the length of one, from a corner to the next, is given by `square`.
fn longest(square: impl Fn(usize, usize) -> f64) -> (f64, usize) {
    let [a, b, c] = [square(0, 1), square(1, 2), square(2, 0)];
    let most = a.max(b).max(c).max(f64::MIN_POSITIVE);
    (
        most,
        if a >= most {
            0
        } else if b >= most {
            1
        } else {
            2
        },
    )
}

/// Flips the longest sides of needles, where the new triangles are less slim and `fits` holds for both. Corners of the
/// border may lie on one line except for rounding: in a plane, along a ruling, and in space on a flat surface that is
/// written as a spline. A needle between them has no normal, and snapping the image to its grid may turn it over.
///
/// ```text
///      p ---- q ---- r          p ---- q ---- r
///       \ '-.___.-' /            \    / \    /       Before: p r q is a needle. After: there is none.
///          '-. .-'                 '-/   \-'
///             s                       s
/// ```
pub fn without_needles(
    triangles: &mut [[u32; 3]],
    slim: impl Fn([u32; 3]) -> Slim,
    fits: impl Fn([[u32; 3]; 2]) -> bool,
) {
    if triangles.iter().all(|&t| slim(t).0 > NEEDLE) {
        return;
    }
    let mut twins = twins(triangles);
    for _ in 0..ROUNDS {
        let mut turned = false;
        for t in 0..triangles.len() {
            let (height, longest) = slim(triangles[t]);
            let (edge, twin) = (3 * t + longest, twins[3 * t + longest] as usize);
            if height > NEEDLE || twins[edge] == NONE {
                continue;
            }
            let (a, b) = (start(triangles, edge), start(triangles, twin));
            let (c, d) = (start(triangles, before_in(edge)), start(triangles, before_in(twin)));
            let least = |one: [u32; 3], other: [u32; 3]| slim(one).0.min(slim(other).0);
            let new = [[c, d, b], [d, c, a]];
            if c != d && least(new[0], new[1]) > least(triangles[t], triangles[twin / 3]) && fits(new) {
                turn(triangles, &mut twins, edge, twin);
                turned = true;
            }
        }
        if !turned {
            break;
        }
    }
}

pub const NONE: u32 = u32::MAX;

fn start(triangles: &[[u32; 3]], edge: usize) -> u32 {
    triangles[edge / 3][edge % 3]
}

pub fn after_in(edge: usize) -> usize {
    edge - edge % 3 + (edge + 1) % 3
}

pub fn before_in(edge: usize) -> usize {
    edge - edge % 3 + (edge + 2) % 3
}

/// Flips an edge: the triangles a b c and b a d become c d b and d c a.
pub fn turn(triangles: &mut [[u32; 3]], twins: &mut [u32], edge: usize, twin: usize) {
    let (a, b) = (start(triangles, edge), start(triangles, twin));
    let (c, d) = (start(triangles, before_in(edge)), start(triangles, before_in(twin)));
    let outer = [after_in(edge), before_in(edge), after_in(twin), before_in(twin)].map(|e| twins[e]);
    let (one, other) = (edge / 3, twin / 3);
    triangles[one] = [c, d, b];
    triangles[other] = [d, c, a];
    let mut join = |e: usize, t: u32| {
        twins[e] = t;
        if t != NONE {
            twins[t as usize] = e as u32;
        }
    };
    // b-c, c-a, a-d, d-b.
    join(3 * one + 2, outer[0]);
    join(3 * other + 1, outer[1]);
    join(3 * other + 2, outer[2]);
    join(3 * one + 1, outer[3]);
    join(3 * one, 3 * other as u32);
}

/// For each edge of each triangle the edge that runs along it in the opposite sense.
pub fn twins(triangles: &[[u32; 3]]) -> Vec<u32> {
    let count = triangles.iter().flatten().max().map_or(0, |&i| i as usize + 1);
    let edges = 0..3 * triangles.len();
    let ends = |edge: usize| (start(triangles, edge), start(triangles, after_in(edge)));
    // Sorted by lower end, then by upper end.
    let mut first = vec![0u32; count + 1];
    for edge in edges.clone() {
        let (a, b) = ends(edge);
        first[a.min(b) as usize + 1] += 1;
    }
    for i in 0..count {
        first[i + 1] += first[i];
    }
    let mut next = first.clone();
    let mut sorted = vec![(0u32, 0u32); edges.len()];
    for edge in edges.clone() {
        let (a, b) = ends(edge);
        let place = &mut next[a.min(b) as usize];
        sorted[*place as usize] = (a.max(b), edge as u32);
        *place += 1;
    }
    let mut twins = vec![NONE; edges.len()];
    for w in first.windows(2) {
        let part = &mut sorted[w[0] as usize..w[1] as usize];
        part.sort_unstable();
        for pair in part.windows(2) {
            if pair[0].0 == pair[1].0 {
                twins[pair[0].1 as usize] = pair[1].1;
                twins[pair[1].1 as usize] = pair[0].1;
            }
        }
    }
    twins
}
