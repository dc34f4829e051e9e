//! Finds the interval of a curve along which a polyline runs.

use super::placed::Placed;
use super::plane::{Vec2, length, minus, to_segment};
use hlr_accuracy::{CURVE_BETWEEN, CURVE_END};
use hlr_brep::geometry::curve::Vec3;

/// How far rounding may make a parameter step back, as a share of the period.
const BACKLASH: f64 = 1e-7;

/// A little less than one, for what is rounded.
const SURELY: f64 = 1.0 - 1e-6;

/// The parameters of a line's points on the curve along which it runs, rising or falling.
pub fn along(placed: &Placed, flat: &[Vec2], space: &[Vec3], accuracy: f64, bulge: f64) -> Option<Vec<f64>> {
    let found: Vec<f64> = space.iter().map(|p| placed.track.nearest(&placed.curve, p)).collect();
    if !found.iter().all(|t| t.is_finite()) {
        return None;
    }
    // Polygons of edges run along their curve; a line runs against it only if it was reversed.
    [1.0, -1.0].into_iter().find_map(|sign| {
        let mut t = unrolled(&found, placed.track.period, sign)?;
        snap(placed, &mut t, accuracy);
        follows(placed, &t, flat, accuracy, bulge).then_some(t)
    })
}

/// The parameters, with turns added so that all steps have one sign; None if that is impossible.
fn unrolled(found: &[f64], period: Option<f64>, sign: f64) -> Option<Vec<f64>> {
    let mut out = vec![found[0]];
    let mut total = 0.0;
    let extent = found.iter().fold(0.0, |m: f64, t| m.max((t - found[0]).abs()));
    for w in found.windows(2) {
        let mut step = sign * (w[1] - w[0]);
        if let Some(period) = period {
            step = step.rem_euclid(period);
            if step > (1.0 - BACKLASH) * period {
                step -= period;
            }
        } else if step < -BACKLASH * extent {
            return None;
        }
        total += step;
        out.push(out[0] + sign * total);
    }
    match period {
        // A closed line: once around from a point to itself.
        Some(period) if total <= BACKLASH * period && found.len() > 2 => None,
        Some(period) if total > (1.0 + BACKLASH) * period => None,
        _ => (total > 0.0).then_some(out),
    }
}

/// Sets ends that are within the accuracy of the curve's own ends to exactly those.
fn snap(placed: &Placed, t: &mut [f64], accuracy: f64) {
    let last = t.len() - 1;
    let whole = placed.range[1] - placed.range[0];
    for i in [0, last] {
        for end in placed.range {
            let turns = placed.track.period.map_or(0.0, |p| ((t[i] - end) / p).round() * p);
            let goal = end + turns;
            let apart = || length(&minus(&placed.on_paper(t[i])[0], &placed.on_paper(goal)[0]));
            if (goal - t[i]).abs() < 0.05 * whole && apart() <= CURVE_END * accuracy {
                t[i] = goal;
                break;
            }
        }
    }
}

/// Whether the curve passes the line's vertices within the accuracy, and stays near it in between. An end of the line
/// may lie in the middle of a chord, and be off the curve by as much as the chord is.
fn follows(placed: &Placed, t: &[f64], flat: &[Vec2], accuracy: f64, bulge: f64) -> bool {
    let between = CURVE_BETWEEN * accuracy + bulge;
    let near = |t: f64, a: &Vec2, b: &Vec2| to_segment(&placed.on_paper(t)[0], a, b).0 <= between;
    let bend = placed.paper.most_bend();
    let mut before = 0.0;
    (0..flat.len()).all(|i| {
        let off = length(&minus(&placed.on_paper(t[i])[0], &flat[i]));
        if i > 0 {
            let (a, b, step) = (&flat[i - 1], &flat[i], t[i] - t[i - 1]);
            // Between two parameters a curve rises above its chord by an eighth of the bend times their difference
            // squared, at most. Where that is little, no place in between is looked at.
            let surely = bend.is_some_and(|bend| 0.125 * bend * step * step + off.max(before) < SURELY * between);
            if !surely && ![0.25, 0.5, 0.75].iter().all(|s| near(t[i - 1] + step * s, a, b)) {
                return false;
            }
        }
        before = off;
        off <= accuracy + bulge
    })
}

#[cfg(test)]
mod tests {
    use super::super::project::Projection;
    use super::*;
    use hlr_brep::geometry::curve::Curve;
    use std::f64::consts::TAU;

    /// With and without the bend: a chord follows its curve where all places in between do, and no other does.
    #[test]
    fn chords_follow_an_ellipse_as_far_as_places_in_between_lie_beside_them() {
        let projection = Projection([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        let (mut near, mut far, mut sure) = (0, 0, 0);
        for width in [10.0, 3.0, 0.4] {
            let curve = Curve::Ellipse { p: [1.0, 2.0, 3.0], a: [10.0, 0.0, 0.0], b: [0.0, width, 5.0] };
            let placed = Placed::new(curve, [0.0, TAU], &projection, 1e-6);
            let bend = placed.paper.most_bend().expect("an ellipse");
            for k in 0..3000 {
                let (from, step) = (f64::from(k) * 0.01, f64::from(k % 30 + 1) * 0.1);
                let t = [from, from + step];
                let [a, b] = t.map(|t| placed.on_paper(t)[0]);
                let most = CURVE_BETWEEN * 0.05;
                let beside = |s: f64| to_segment(&placed.on_paper(from + step * s)[0], &a, &b).0 <= most;
                let wanted = [0.25, 0.5, 0.75].into_iter().all(beside);
                assert_eq!(follows(&placed, &t, &[a, b], 0.05, 0.0), wanted, "{width} {from} {step}");
                *(if wanted { &mut near } else { &mut far }) += 1;
                sure += usize::from(0.125 * bend * step * step < most);
            }
        }
        assert!(near > 1000 && far > 1000 && sure > 500, "{near} {far} {sure}");
    }
}
