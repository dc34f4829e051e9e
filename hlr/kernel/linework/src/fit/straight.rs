//! Finds pieces of curves that are straight on paper: short ones, flat ones, and planar ones seen edge-on. The image of
//! the last may run back over itself.

use super::placed::Placed;
use super::plane::{Vec2, dot, length, minus};
use super::project::Paper;
use hlr_accuracy::{CURVE_STRAIGHT, CURVE_TURN};

const PLACES: usize = 8;
/// Halvings of the interval around a turning point.
const HALVINGS: usize = 40;
/// Steps, each twice as long as the one before, in which a turning point is sought beyond the end of a piece: from a
/// thousandth of the way between two places to twice that way.
const STEPS: i32 = 12;

/// The parameters of both ends of the straight line that covers a whole piece, in the order of its range.
pub fn straight(placed: &Placed, range: [f64; 2], accuracy: f64) -> Option<[f64; 2]> {
    let (a, b) = (range[0].min(range[1]), range[0].max(range[1]));
    let places = PLACES.max(4 * placed.paper.spans(a, b)).max((2.0 * (b - a)) as usize * usize::from(turning(placed)));
    let t = |i: usize| range[0] + (range[1] - range[0]) * (i as f64 / places as f64);
    if wide([0, places / 3, 2 * places / 3].map(|i| placed.on_paper(t(i))[0]), CURVE_STRAIGHT * accuracy) {
        return None;
    }
    let points: Vec<Vec2> = (0..=places).map(|i| placed.on_paper(t(i))[0]).collect();
    let far = |from: &Vec2| -> usize {
        let mut best = (0, -1.0);
        for (i, p) in points.iter().enumerate() {
            let d = length(&minus(p, from));
            if d > best.1 {
                best = (i, d);
            }
        }
        best.0
    };
    let one = far(&points[0]);
    let other = far(&points[one]);
    let way = minus(&points[one], &points[other]);
    let size = length(&way);
    if size <= 0.0 {
        return None;
    }
    let way = way.map(|c| c / size);
    let off = |p: &Vec2| {
        let d = minus(p, &points[other]);
        (d[0] * way[1] - d[1] * way[0]).abs()
    };
    if !points.iter().all(|p| off(p) <= CURVE_STRAIGHT * accuracy) {
        return None;
    }
    // Extremes are ends of the piece, or turning points: bracketed by the neighbouring samples, then halved by the sign of
    // the slope.
    let ahead = if range[0] < range[1] { 1.0 } else { -1.0 };
    let along = |t: f64| dot(&placed.on_paper(t)[0], &way);
    let refine = |i: usize, sign: f64| {
        let rises = |t: f64| sign * ahead * dot(&placed.on_paper(t)[1], &way) > 0.0;
        let (mut low, mut high) = (t(i.max(1) - 1), t((i + 1).min(places)));
        if (i == 0 && !rises(low)) || (i == places && rises(high)) {
            let out = if i == 0 { t(0) - t(1) } else { t(1) - t(0) };
            return beyond(placed, t(i), out, &way.map(|c| c * sign), CURVE_TURN * accuracy).unwrap_or(t(i));
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if rises(middle) { low = middle } else { high = middle }
        }
        let turning = 0.5 * (low + high);
        let end = i == 0 || i == places;
        if end && sign * along(turning) <= sign * along(t(i)) { t(i) } else { turning }
    };
    let (one, other) = (refine(one, 1.0), refine(other, -1.0));
    Some(if (one < other) == (range[0] < range[1]) { [one, other] } else { [other, one] })
}

/// Where a curve that goes on along `way`, in steps of `out`, turns back, if that is no farther than `most` from the end of
/// its piece, and on its edge.
fn beyond(placed: &Placed, end: f64, out: f64, way: &Vec2, most: f64) -> Option<f64> {
    let from = dot(&placed.on_paper(end)[0], way);
    let rises = |t: f64| out * dot(&placed.on_paper(t)[1], way) > 0.0;
    let steps = (0..STEPS).rev().map(|k| on_edge(placed, end, end + 2.0 * out * 0.5f64.powi(k)));
    let past = steps.take_while(|t| dot(&placed.on_paper(*t)[0], way) - from <= most).find(|t| !rises(*t))?;
    let (mut low, mut high) = (end, past);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if rises(middle) { low = middle } else { high = middle }
    }
    let gain = dot(&placed.on_paper(low)[0], way) - from;
    ((past - end) * out > 0.0 && (0.0..=most).contains(&gain)).then_some(low)
}

/// A parameter beyond `end`, or the end of the edge where that comes first.
fn on_edge(placed: &Placed, end: f64, t: f64) -> f64 {
    let [low, high] = placed.range;
    match placed.track.period {
        Some(period) if high - low >= (1.0 - 1e-12) * period => t,
        Some(period) => {
            let turns = ((end - low) / period + 1e-9).floor() * period;
            t.clamp(low + turns, (high + turns).max(low + turns))
        }
        None => t.clamp(low.min(high), high.max(low)),
    }
}

/// Whether no straight line passes all three points within a distance: if one does, the least height of their triangle
/// is at most twice that. Most curves are known not to be straight by three of their points.
fn wide([p, q, r]: [Vec2; 3], away: f64) -> bool {
    let sides = [minus(&q, &p), minus(&r, &q), minus(&p, &r)];
    let longest = sides.iter().map(length).fold(0.0, f64::max);
    (sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]).abs() > 2.0 * away * longest
}

fn turning(placed: &Placed) -> bool {
    matches!(placed.paper, Paper::Ellipse { .. })
}

#[cfg(test)]
mod tests {
    use super::super::project::Projection;
    use super::*;
    use hlr_brep::geometry::curve::Curve;
    use std::f64::consts::{PI, TAU};

    /// A circle of radius 8 in the plane of x and depth, seen along y.
    fn edge_on() -> Placed {
        let seen = Projection([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        let curve = Curve::Ellipse { p: [0.0; 3], a: [8.0, 0.0, 0.0], b: [0.0, 0.0, 8.0] };
        Placed::new(curve, [0.0, TAU], &seen, 1e-9)
    }

    #[test]
    fn a_circle_seen_edge_on_is_drawn_from_one_turning_point_to_the_other() {
        let placed = edge_on();
        for range in [[-0.04, PI + 0.04], [0.0, PI], [PI + 0.04, -0.04], [-0.2, TAU - 0.2]] {
            let Some(ends) = straight(&placed, range, 0.05) else { panic!() };
            let x = ends.map(|t| placed.on_paper(t)[0][0]);
            assert!((x[0].abs() - 8.0).abs() < 1e-9 && (x[0] + x[1]).abs() < 1e-9, "{range:?}: {x:?}");
        }
        // An end that does not turn stays.
        assert_eq!(straight(&placed, [0.5, 2.5], 0.05), Some([0.5, 2.5]));
    }

    #[test]
    fn a_line_that_ends_right_before_its_curve_turns_back_ends_there() {
        // 8 (1 - cos 0.1) is 0.04, less than half of the accuracy; 8 (1 - cos 0.2) is 0.16.
        for (range, there) in [([0.1, 2.5], [0.0, 2.5]), ([2.5, 0.1], [2.5, 0.0]), ([0.2, 2.5], [0.2, 2.5])] {
            let Some(ends) = straight(&edge_on(), range, 0.1) else { panic!() };
            assert!((0..2).all(|k| (ends[k] - there[k]).abs() < 1e-6), "{range:?}: {ends:?}");
        }
        // The edge itself ends: an arc from 0.05 on.
        let arc = Placed { range: [0.05, 3.0], ..edge_on() };
        assert_eq!(straight(&arc, [0.05, 2.5], 0.05), Some([0.05, 2.5]));
        assert_eq!(straight(&arc, [0.05 + TAU, 2.5 + TAU], 0.05), Some([0.05 + TAU, 2.5 + TAU]));
        let wider = Placed { range: [-0.5, 3.0], ..edge_on() };
        let Some([first, _]) = straight(&wider, [0.05, 2.5], 0.05) else { panic!() };
        assert!(first.abs() < 1e-6, "{first}");
    }
}
