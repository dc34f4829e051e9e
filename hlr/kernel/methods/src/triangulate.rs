//! Triangulates polygons that are not planar.
//!
//! Ear clipping (Meisters 1975); holes are first joined to the outline by bridges (Eberly). All of it is in integers in
//! the image. Edges are kept, so the triangles together own exactly the pixels of the polygon. A loop that crosses
//! itself has no such triangulation without new corners, which would be off the grid: the result is `None`, and the
//! polygon keeps its outline, in one plane.

use super::limits::Watch;
use super::plane::{Point, turn};
use super::scene::Rule;
use std::ops::Range;

/// Triangles as indices into the corners of all loops, one after another; None where loops cross, or touch so that no
/// ear is left, or where time ran out.
pub fn triangulate(points: &[Point], loops: &[Range<usize>], rule: Rule, watch: &Watch) -> Option<Vec<[usize; 3]>> {
    if crosses(points, loops, watch) {
        return None;
    }
    let twice = |t: [usize; 3]| i128::from(turn(&points[t[0]], &points[t[1]], &points[t[2]]));
    let area = |l: &Range<usize>| -> i128 {
        let n = l.len();
        (0..n).map(|k| twice([l.start, l.start + k, l.start + (k + 1) % n])).sum()
    };
    // The outline is the largest loop; it is walked with positive area, holes the other way.
    let outline = (0..loops.len()).max_by_key(|&k| area(&loops[k]).abs())?;
    let walked = |l: &Range<usize>, positive: bool| -> Vec<usize> {
        let mut out: Vec<usize> = l.clone().collect();
        if (area(l) > 0) != positive {
            out.reverse();
        }
        out
    };
    let flipped = area(&loops[outline]) < 0;
    let mut ring = walked(&loops[outline], true);
    let mut holes: Vec<Vec<usize>> =
        (0..loops.len()).filter(|&k| k != outline).map(|k| walked(&loops[k], false)).collect();
    // The hole that reaches farthest right first: its bridge meets no other hole.
    holes.sort_by_key(|h| std::cmp::Reverse(h.iter().map(|&i| points[i][0]).max()));
    for hole in holes {
        bridge(points, &mut ring, &hole, watch)?;
    }
    let mut triangles = ears(points, ring, watch)?;
    if flipped {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    let whole = match rule {
        // Loops within the outline are holes, whichever way they run.
        Rule::EvenOdd => 2 * area(&loops[outline]).abs() - loops.iter().map(|l| area(l).abs()).sum::<i128>(),
        Rule::NonZero => loops.iter().map(area).sum::<i128>().abs(),
    };
    let parts: i128 = triangles.iter().map(|&t| twice(t)).sum();
    (whole == parts.abs()).then_some(triangles)
}

/// Whether two edges that are not neighbours meet, or time ran out.
fn crosses(points: &[Point], loops: &[Range<usize>], watch: &Watch) -> bool {
    let edges: Vec<(usize, usize)> =
        loops.iter().flat_map(|l| l.clone().map(move |i| (i, if i + 1 == l.end { l.start } else { i + 1 }))).collect();
    for (k, &(a, b)) in edges.iter().enumerate() {
        for &(c, d) in &edges[k + 1..] {
            if watch.over() {
                return true;
            }
            if a == c || a == d || b == c || b == d {
                continue;
            }
            let [p, q, r, s] = [a, b, c, d].map(|i| &points[i]);
            let (o1, o2) = (turn(p, q, r).signum(), turn(p, q, s).signum());
            let (o3, o4) = (turn(r, s, p).signum(), turn(r, s, q).signum());
            if o1 * o2 < 0 && o3 * o4 < 0 {
                return true;
            }
        }
    }
    false
}

/// Joins a hole to the ring by the shortest bridge that crosses neither.
fn bridge(points: &[Point], ring: &mut Vec<usize>, hole: &[usize], watch: &Watch) -> Option<()> {
    let start = (0..hole.len()).max_by_key(|&k| (points[hole[k]][0], points[hole[k]][1]))?;
    let from = &points[hole[start]];
    let distance = |i: usize| -> i64 {
        let (dx, dy) = (points[i][0] - from[0], points[i][1] - from[1]);
        dx * dx + dy * dy
    };
    let mut order: Vec<usize> = (0..ring.len()).collect();
    order.sort_by_key(|&k| distance(ring[k]));
    let clear = |k: usize| {
        let to = &points[ring[k]];
        let n = ring.len();
        let free = |a: usize, b: usize| {
            let (p, q) = (&points[a], &points[b]);
            let (o1, o2) = (turn(from, to, p).signum(), turn(from, to, q).signum());
            let (o3, o4) = (turn(p, q, from).signum(), turn(p, q, to).signum());
            !(o1 * o2 < 0 && o3 * o4 < 0)
        };
        // The bridge must start inside the angle at the ring's corner, so that it runs inside the polygon.
        let (before, after) = (&points[ring[(k + n - 1) % n]], &points[ring[(k + 1) % n]]);
        let within = if turn(before, to, after) >= 0 {
            turn(before, to, from) >= 0 && turn(to, after, from) >= 0
        } else {
            turn(before, to, from) >= 0 || turn(to, after, from) >= 0
        };
        within
            && !watch.over()
            && (0..n).all(|i| free(ring[i], ring[(i + 1) % n]))
            && (0..hole.len()).all(|i| free(hole[i], hole[(i + 1) % hole.len()]))
    };
    let k = order.into_iter().find(|&k| clear(k))?;
    let mut joined: Vec<usize> = ring[..=k].to_vec();
    joined.extend((0..=hole.len()).map(|i| hole[(start + i) % hole.len()]));
    joined.extend(&ring[k..]);
    *ring = joined;
    Some(())
}

fn ears(points: &[Point], mut ring: Vec<usize>, watch: &Watch) -> Option<Vec<[usize; 3]>> {
    let mut out = Vec::with_capacity(ring.len());
    while ring.len() > 2 {
        let n = ring.len();
        // Tests corner by corner, each against all others.
        let ear = (0..n).find(|&k| {
            let [a, b, c] = [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
            let [p, q, r] = [&points[a], &points[b], &points[c]];
            let side = turn(p, q, r);
            // A corner on a straight line, or a spike, is removed without a triangle.
            side == 0
                || (side > 0
                    && !watch.over()
                    && ring.iter().all(|&i| {
                        let v = &points[i];
                        let shared = [p, q, r].iter().any(|w| w[0] == v[0] && w[1] == v[1]);
                        shared || turn(p, q, v) < 0 || turn(q, r, v) < 0 || turn(r, p, v) < 0
                    }))
        })?;
        let [a, b, c] = [ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]];
        if turn(&points[a], &points[b], &points[c]) > 0 {
            out.push([a, b, c]);
        }
        ring.remove(ear);
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::Limits;

    fn triangles(points: &[Point], loops: &[Range<usize>], rule: Rule) -> Option<Vec<[usize; 3]>> {
        triangulate(points, loops, rule, &Watch::new(&|| false, Limits::NONE))
    }

    #[test]
    fn a_square_with_a_hole() {
        let points: Vec<Point> =
            [[0, 0], [9, 0], [9, 9], [0, 9], [3, 3], [6, 3], [6, 6], [3, 6]].map(|[x, y]| [x, y, 0]).to_vec();
        for (rule, found) in [(Rule::EvenOdd, true), (Rule::NonZero, false)] {
            // An inner loop that runs the same way as the outline is a hole under the even-odd rule only.
            let t = triangles(&points, &[0..4, 4..8], rule);
            assert_eq!(t.is_some(), found);
            let mut turned = points.clone();
            turned[4..].reverse();
            let t = triangles(&turned, &[0..4, 4..8], rule).unwrap();
            let area: i64 = t.iter().map(|t| turn(&turned[t[0]], &turned[t[1]], &turned[t[2]])).sum();
            assert_eq!(area, 2 * (81 - 9));
        }
    }

    #[test]
    fn a_bow_tie_has_no_triangulation() {
        let points: Vec<Point> = [[0, 0], [4, 4], [4, 0], [0, 4]].map(|[x, y]| [x, y, 0]).to_vec();
        assert!(triangles(&points, std::slice::from_ref(&(0..4)), Rule::EvenOdd).is_none());
    }
}
