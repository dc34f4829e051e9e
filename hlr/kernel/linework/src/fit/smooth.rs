//! Smooths the contour of a mesh, which zigzags from facet to facet, into curves within the accuracy of it.
//!
//! 1. `relaxed`   vertices move to the middle of the zigzag; ends and pinned vertices stay. Two passes, so that round
//!    shapes do not shrink (G. Taubin, "A signal processing approach to fair surface design", 1995).
//! 2. `reduced`   only the vertices that the shape needs are kept (Douglas and Peucker)
//! 3. `tangents`  at kept vertices that a smooth curve can pass within the tolerance; the others are corners
//! 4. `contour_fit`  cubic curves from corner to corner, divided at the kept vertices until close enough
//!
//! ```text
//!      /\  /\                         the contour of the mesh
//!   --/  \/  \--          --------    and what is drawn
//! ```
//!
//! Moves and fitting errors add up to at most four fifths of the accuracy. A contour that cannot be smoothed within
//! that stays as it is.

use super::bezier::{Chain, at};
use super::contour_fit::Fitting;
use super::plane::{Vec2, dot, length, minus, to_segment};
use crate::lines::simplify::off;
use crate::lines::{Polyline, View, distance};
use hlr_accuracy::{CONTOUR_BULGE, CONTOUR_CHORD, CONTOUR_FIT, CONTOUR_FLAT, CONTOUR_MOVE};
use hlr_brep::geometry::curve::Vec3;
use hlr_exact::elementary::{atan2, sin_cos};

/// A sharper turn than this is a corner however short its sides; radians.
const CORNER: f64 = 2.0;
const PASSES: usize = 12;
/// Shrinking and growing passes of Taubin's filter.
const STEPS: [f64; 2] = [0.5, -0.526];
const PLACES: usize = 16;
const STEPS_OF_SEARCH: usize = 24;

/// The smooth line and its curves; no curves where it is straight. `pinned` vertices stay where they are. Where the
/// line is straight on paper, it keeps the points it needs to stay within `depth` (model units) in space.
pub fn smooth(
    line: &Polyline,
    pinned: &dyn Fn(&Vec2) -> bool,
    accuracy: f64,
    depth: f64,
    view: &View,
) -> (Polyline, Option<Chain>) {
    let n = line.flat.len();
    if n < 3 {
        return (line.clone(), None);
    }
    let closed = n > 3 && line.flat[0] == line.flat[n - 1];
    let fixed: Vec<bool> = (0..n).map(|i| (!closed && (i == 0 || i + 1 == n)) || pinned(&line.flat[i])).collect();
    let way = relaxed(&line.flat, &fixed, closed, CONTOUR_MOVE * accuracy);
    let kept = reduced(&way, &fixed, closed, CONTOUR_FLAT * accuracy);
    let tangents = tangents(&way, &kept, closed, CONTOUR_BULGE * accuracy);
    let mut fitting = Fitting::new(&way, &kept, &tangents, CONTOUR_FIT * accuracy);
    fitting.all(&fixed);
    let pieces = fitting.pieces;
    let mut out = Polyline {
        chain: line.chain,
        visible: line.visible,
        left_out: line.left_out,
        flat: vec![way[0]],
        space: vec![line.space[0]],
    };
    for piece in &pieces {
        let many = steps(&piece.points, CONTOUR_CHORD * accuracy);
        let mut places: Vec<f64> = (1..many).map(|k| k as f64 / many as f64).collect();
        let (from, to) = (piece.from, piece.to);
        places.extend(bends(&line.space[from..=to], depth).iter().map(|i| nearest(&piece.points, &way[from + i])));
        places.sort_by(f64::total_cmp);
        for t in places {
            let p = at(&piece.points, t);
            let q = beside(line, &way, piece.from, piece.to, &p, view);
            put(&mut out, p, q);
        }
        put(&mut out, way[piece.to], line.space[piece.to]);
    }
    if out.flat.len() < 2 {
        // So small that rounding moved all of it to one point.
        return (line.clone(), None);
    }
    if closed {
        let last = out.flat.len() - 1;
        (out.flat[last], out.space[last]) = (out.flat[0], out.space[0]);
    }
    if pieces.iter().all(|p| p.straight) {
        return (out, None);
    }
    let mut points = vec![way[0]];
    pieces.iter().for_each(|p| points.extend(&p.points[1..]));
    if closed {
        let last = points.len() - 1;
        points[last] = points[0];
    }
    (out, Some(Chain { degree: 3, points }))
}

fn put(line: &mut Polyline, flat: Vec2, space: Vec3) {
    if line.flat.last() != Some(&flat) {
        line.flat.push(flat);
        line.space.push(space);
    }
}

/// The next or previous vertex; a closed line wraps around.
fn neighbour(i: usize, forward: bool, n: usize, closed: bool) -> Option<usize> {
    match (forward, closed) {
        (true, _) if i + 1 < n => Some(i + 1),
        (false, _) if i > 0 => Some(i - 1),
        // The last vertex of a closed line is its first.
        (true, true) => Some(1),
        (false, true) => Some(n - 2),
        _ => None,
    }
}

fn relaxed(flat: &[Vec2], fixed: &[bool], closed: bool, most: f64) -> Vec<Vec2> {
    let n = flat.len();
    let mut way = flat.to_vec();
    for step in STEPS.iter().cycle().take(2 * PASSES) {
        let before = way.clone();
        for i in (0..n).filter(|&i| !fixed[i]) {
            let (Some(a), Some(b)) = (neighbour(i, false, n, closed), neighbour(i, true, n, closed)) else { continue };
            let (to_a, to_b) = (minus(&before[a], &before[i]), minus(&before[b], &before[i]));
            let (la, lb) = (length(&to_a), length(&to_b));
            if la == 0.0 || lb == 0.0 {
                continue;
            }
            // Weighted so that a vertex on a straight line does not move.
            let pull = [0, 1].map(|k| (to_a[k] * lb + to_b[k] * la) / (la + lb));
            // A bend too large to be smoothed within the tolerance is left as it is.
            let share = (3.0 - length(&pull) / most).clamp(0.0, 1.0);
            let moved = [0, 1].map(|k| before[i][k] + step * share * pull[k]);
            let off = minus(&moved, &flat[i]);
            let size = length(&off);
            way[i] = if size > most { [0, 1].map(|k| flat[i][k] + off[k] * (most / size)) } else { moved };
        }
    }
    way
}

/// Indices of the vertices that are kept, ascending; always with the first and the last.
fn reduced(way: &[Vec2], fixed: &[bool], closed: bool, tolerance: f64) -> Vec<usize> {
    let n = way.len();
    let mut kept = vec![0];
    kept.extend((1..n - 1).filter(|&i| fixed[i]));
    kept.push(n - 1);
    if closed && kept.len() == 2 {
        let far = (1..n - 1).max_by(|&i, &j| distance(&way[0], &way[i]).total_cmp(&distance(&way[0], &way[j])));
        kept.insert(1, far.unwrap_or(n / 2));
    }
    let mut stack: Vec<(usize, usize)> = kept.windows(2).map(|w| (w[0], w[1])).collect();
    while let Some((a, b)) = stack.pop() {
        let mut worst = (tolerance, a);
        for i in a + 1..b {
            let d = to_segment(&way[i], &way[a], &way[b]).0;
            if d > worst.0 {
                worst = (d, i);
            }
        }
        if worst.1 > a {
            kept.push(worst.1);
            stack.extend([(a, worst.1), (worst.1, b)]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// The vertices between its ends that a polyline in space needs (Douglas and Peucker).
fn bends(space: &[Vec3], tolerance: f64) -> Vec<usize> {
    let mut kept = Vec::new();
    let mut stack = vec![(0, space.len() - 1)];
    while let Some((a, b)) = stack.pop() {
        let worst = (a + 1..b).map(|i| (off(&space[i], &space[a], &space[b]), i)).max_by(|x, y| x.0.total_cmp(&y.0));
        if let Some((d, i)) = worst
            && d > tolerance
        {
            kept.push(i);
            stack.extend([(a, i), (i, b)]);
        }
    }
    kept
}

/// The parameter of the point of a curve nearest to p: the best of some samples, refined by ternary search.
fn nearest(points: &[Vec2; 4], p: &Vec2) -> f64 {
    let far = |t: f64| distance(&at(points, t), p);
    let place = |k: usize| k as f64 / PLACES as f64;
    let best = (0..=PLACES).min_by(|&i, &j| far(place(i)).total_cmp(&far(place(j)))).unwrap_or(0);
    let (mut low, mut high) = (place(best.saturating_sub(1)), place((best + 1).min(PLACES)));
    for _ in 0..STEPS_OF_SEARCH {
        let third = (high - low) / 3.0;
        if far(low + third) < far(high - third) { high -= third } else { low += third }
    }
    0.5 * (low + high)
}

/// Unit tangents at the kept vertices, None at corners and at open ends.
///
/// A curve whose tangents are turned by a and b from a chord of length l bulges by l (a + b) / 8 beyond it. So each
/// side of a vertex allows a turn of 4 bulge / l radians. Within that, the circle through three vertices gives the
/// tangent.
fn tangents(way: &[Vec2], kept: &[usize], closed: bool, bulge: f64) -> Vec<Option<Vec2>> {
    let m = kept.len();
    (0..m)
        .map(|i| {
            let (a, b) = (neighbour(i, false, m, closed)?, neighbour(i, true, m, closed)?);
            let (one, two) = (minus(&way[kept[i]], &way[kept[a]]), minus(&way[kept[b]], &way[kept[i]]));
            let (l, k) = (length(&one), length(&two));
            let turn = atan2(one[0] * two[1] - one[1] * two[0], dot(&one, &two));
            if l == 0.0 || k == 0.0 || turn.abs() > CORNER {
                return None;
            }
            let (most_one, most_two) = (4.0 * bulge / l, 4.0 * bulge / k);
            if turn.abs() > most_one + most_two {
                return None;
            }
            let share = (turn.abs() * l / (l + k)).max(turn.abs() - most_two).min(most_one).copysign(turn);
            let (s, c) = sin_cos(share);
            let unit = one.map(|v| v / l);
            Some([c * unit[0] - s * unit[1], s * unit[0] + c * unit[1]])
        })
        .collect()
}

/// Number of equal parameter steps whose chords are within the tolerance of the curve.
fn steps(p: &[Vec2; 4], tolerance: f64) -> usize {
    let bend = |i: usize| length(&[0, 1].map(|k| p[i][k] - 2.0 * p[i + 1][k] + p[i + 2][k]));
    ((0.75 * bend(0).max(bend(1)) / tolerance).sqrt().ceil() as usize).clamp(1, 1 << 12)
}

/// The point in space of the contour whose image is nearest to a point p of its curve.
fn beside(line: &Polyline, way: &[Vec2], from: usize, to: usize, p: &Vec2, view: &View) -> Vec3 {
    let mut best = (f64::INFINITY, from, 0.0);
    for i in from..to {
        let (d, s) = to_segment(p, &way[i], &way[i + 1]);
        if d < best.0 {
            best = (d, i, s);
        }
    }
    let (a, b) = (&line.space[best.1], &line.space[best.1 + 1]);
    let s = view.in_space(best.2, view.depth(a), view.depth(b));
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };

    fn line(flat: Vec<Vec2>) -> Polyline {
        let space = flat.iter().map(|p| [p[0], p[1], 7.0]).collect();
        Polyline { chain: 3, visible: true, flat, space, ..Polyline::default() }
    }

    fn farthest(from: &[Vec2], to: &[Vec2]) -> f64 {
        from.iter()
            .map(|p| to.windows(2).map(|w| to_segment(p, &w[0], &w[1]).0).fold(f64::INFINITY, f64::min))
            .fold(0.0, f64::max)
    }

    fn sharpest(flat: &[Vec2]) -> f64 {
        flat.windows(3)
            .map(|w| {
                let (a, b) = (minus(&w[1], &w[0]), minus(&w[2], &w[1]));
                (a[0] * b[1] - a[1] * b[0]).atan2(dot(&a, &b)).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_zigzag_goes_and_the_ends_stay() {
        let jag = |i: i32| if i == 0 || i == 60 { 0.0 } else { 0.04 * f64::from(i % 2 * 2 - 1) };
        let arc = |i: i32| 0.01 * f64::from(i);
        let raw = line((0..=60).map(|i| [(20.0 + jag(i)) * arc(i).cos(), (20.0 + jag(i)) * arc(i).sin()]).collect());
        assert!(sharpest(&raw.flat) > 0.7);
        let (found, chain) = smooth(&raw, &|_| false, 0.1, 0.1, &VIEW);
        assert!(sharpest(&found.flat) < 0.1, "{}", sharpest(&found.flat));
        assert_eq!((found.flat[0], found.flat.last()), (raw.flat[0], raw.flat.last()));
        assert!(farthest(&raw.flat, &found.flat) < 0.1 && farthest(&found.flat, &raw.flat) < 0.1);
        assert!(chain.is_some_and(|c| c.points.len() <= 7));
        assert!(found.space.iter().all(|p| p[2] == 7.0));
    }

    #[test]
    fn what_is_straight_on_paper_keeps_its_bends_along_the_sight() {
        let ring = |i: i32| (0.1 * f64::from(i)).sin_cos();
        let mut raw = line((0..=31).map(|i| [-10.0 * ring(i).1, 0.0]).collect());
        raw.space = (0..=31).map(|i| [-10.0 * ring(i).1, 0.0, 10.0 * ring(i).0]).collect();
        let (found, chain) = smooth(&raw, &|_| false, 0.1, 0.1, &VIEW);
        assert!(chain.is_none() && found.flat.len() < raw.flat.len());
        let round = |p: &Vec3| (p[0] * p[0] + p[2] * p[2]).sqrt();
        let half = |w: &[Vec3]| [0, 1, 2].map(|k| 0.5 * (w[0][k] + w[1][k]));
        assert!(found.space.windows(2).all(|w| (round(&half(w)) - 10.0).abs() < 0.2));
    }

    #[test]
    fn what_rounding_makes_a_point_stays_a_line() {
        let least = f64::from_bits(1);
        for corners in [3, 4, 5, 6, 8] {
            let at = |i: usize| if i % corners == 1 { [least, 0.0] } else { [0.0, 0.0] };
            let raw = line((0..=corners).map(at).collect());
            let (found, _) = smooth(&raw, &|_| false, 1e-300, 1e-300, &VIEW);
            assert!(found.flat.len() > 1 && found.flat.len() == found.space.len(), "{found:?}");
        }
    }

    #[test]
    fn corners_and_facets_stay() {
        let raw = line(vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [16.0, 18.0]]);
        let (found, chain) = smooth(&raw, &|_| false, 0.1, 0.1, &VIEW);
        assert_eq!((found.flat, chain), (raw.flat, None));
    }

    #[test]
    fn a_closed_line_is_smooth_where_it_begins_unless_it_is_pinned_there() {
        let point = |i: usize| (i as f64 * std::f64::consts::TAU / 90.0).sin_cos();
        let mut flat: Vec<Vec2> = (0..90).map(|i| [10.0 * point(i).0, 10.0 * point(i).1]).collect();
        flat.push(flat[0]);
        let (found, chain) = smooth(&line(flat.clone()), &|_| false, 0.1, 0.1, &VIEW);
        assert_eq!(found.flat[0], found.flat[found.flat.len() - 1]);
        let Some(chain) = chain else { panic!() };
        let p = &chain.points;
        let (first, last) = (minus(&p[1], &p[0]), minus(&p[p.len() - 1], &p[p.len() - 2]));
        assert!((first[0] * last[1] - first[1] * last[0]).abs() < 1e-9 * dot(&first, &last));
        let pin = flat[17];
        let (found, _) = smooth(&line(flat), &|p| *p == pin, 0.1, 0.1, &VIEW);
        assert!(found.flat.contains(&pin));
    }
}
