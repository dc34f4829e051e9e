//! Edge flips: an inner edge becomes the other diagonal of its two triangles.

use super::plane::{area, side};
use hlr_exact::elementary::hypot;

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

/// Flips the longest sides of needles, where the new triangles are less slim and `fits` holds for the new edge. In a plane,
/// and along a ruling, corners of the border may lie on one line except for rounding. A needle between them has no
/// normal, and snapping the image to its grid may turn it over.
///
/// ```text
///      p ---- q ---- r          p ---- q ---- r
///       \ '-.___.-' /            \    / \    /       Before: p r q is a needle. After: there is none.
///          '-. .-'                 '-/   \-'
///             s                       s
/// ```
pub fn without_needles(uv: &[[f64; 2]], triangles: &mut [[u32; 3]], fits: impl Fn(u32, u32) -> bool) {
    let is_needle = |t: &[u32; 3]| {
        let p = t.map(|i| uv[i as usize]);
        let square = |a: &[f64; 2], b: &[f64; 2]| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2);
        let longest = square(&p[0], &p[1]).max(square(&p[1], &p[2])).max(square(&p[2], &p[0]));
        area(&p[0], &p[1], &p[2]) <= NEEDLE * longest
    };
    if !triangles.iter().any(is_needle) {
        return;
    }
    // The height over the longest side divided by that side, and the number of that side.
    let slim = |t: [u32; 3]| {
        let p = t.map(|i| uv[i as usize]);
        let length = |k: usize| hypot(p[(k + 1) % 3][0] - p[k][0], p[(k + 1) % 3][1] - p[k][1]);
        let longest = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
        (area(&p[0], &p[1], &p[2]) / length(longest).powi(2).max(f64::MIN_POSITIVE), longest)
    };
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
            if c != d && least([c, d, b], [d, c, a]) > least(triangles[t], triangles[twin / 3]) && fits(c, d) {
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
