//! T-junctions: a hidden line ends exactly where the covering line crosses it. Computed from the true curves of both.
//!
//! ```text
//!     visible      |            the change was found where the tessellations cross (x);
//!   ------------x- | - - - -    it moves along its own curve to the other's (|)
//!                  | hidden
//! ```
//!
//! Where two lines touch, as an outline touches the rim of its face, the change lies at the point of contact. If the
//! last bit of an outline was left out because it coincides with the rim, the outline is extended to that point.

use rayon::prelude::*;

use super::pierced::{Meeting, at_meeting};
use super::places::Places;
use super::plane::{length, minus, to_segment};
use super::route::{Border, Change, Goal, Move, Route};
use crate::lines::View;
use hlr_accuracy::{JUNCTION_ALONG, JUNCTION_EDGE, JUNCTION_MET, JUNCTION_OUTLINE, JUNCTION_TOUCH};

/// Sine of the angle below which two lines touch rather than cross.
const GRAZING: f64 = 0.1;
/// Sine of the angle below which two lines count as parallel.
const ALIKE: f64 = 1e-6;
const STEPS: usize = 12;

/// The ends that move: changes of visibility, and outlines that are extended. A line up to `contact` (model units)
/// behind another may still hide it. `meetings`: of intersection lines, sorted by their first coordinate; an end at one
/// moves there.
pub fn junctions(
    routes: &[Route],
    accuracy: f64,
    contact: f64,
    view: &View,
    (meetings, beside): (&[Meeting], f64),
) -> Vec<Move> {
    let mut changes = changes(routes);
    let mut out = Vec::new();
    if !meetings.is_empty() {
        changes.retain(|change| match at_meeting(routes, change, meetings, beside) {
            Some(moves) => {
                out.extend(moves);
                false
            }
            None => true,
        });
    }
    out.extend(covered(routes, &changes, accuracy, contact, view));
    out
}

/// The changes at lines of surfaces that cover what goes on behind them.
fn covered(routes: &[Route], changes: &[Change], accuracy: f64, contact: f64, view: &View) -> Vec<Move> {
    let near = near(routes, changes, JUNCTION_OUTLINE * accuracy);
    near.par_chunk_by(|a, b| a.0 == b.0)
        .flat_map_iter(|group| {
            let Change { at, ends } = &changes[group[0].0];
            let (i, end_of_own) = ends[0];
            let own = &routes[i];
            let goes_on = ends.len() == 1 && own.left_out[end_of_own];
            let start = own.parameter(end_of_own * (own.flat.len() - 2), end_of_own as f64);
            let mut best = (f64::INFINITY, None);
            for &(_, j, k) in group {
                let other = &routes[j];
                let (away, s) = to_segment(at, &other.flat[k], &other.flat[k + 1]);
                let lifted = own.border == Border::Outline || other.border == Border::Outline;
                let reach = if lifted { JUNCTION_OUTLINE } else { JUNCTION_EDGE } * accuracy;
                if away > reach + own.bulge + other.bulge {
                    continue;
                }
                let from = (start, other.parameter(k, s));
                let crossed = if ends.len() > 1 { crossing(own, other, from, away, accuracy) } else { None };
                let found = crossed.or_else(|| {
                    if lifted { touching(own, other, from, JUNCTION_ALONG * accuracy, accuracy) } else { None }
                });
                let Some((t, u)) = found else { continue };
                let Some(t) = own.ending(t, start) else { continue };
                // An outline that is touched beyond its end is extended to that place. Where the visible line would draw
                // back to it, the outline has been left out beside that line: neither would be drawn there.
                let draws_back = own.visible == ((t > start) == (end_of_own == 0));
                let extended = crossed.is_none() && other.border == Border::Outline && !draws_back;
                let reach = if extended { JUNCTION_ALONG } else { JUNCTION_OUTLINE };
                let moved = length(&minus(&own.at(t)[0], &own.at(start)[0]));
                // What was left out of an outline runs beside the other line, before it or behind it.
                let before = || view.depth(&other.in_space(u, view)) <= view.depth(&own.in_space(t, view)) + contact;
                if moved < best.0 && (goes_on || before()) && within(other, u, reach * accuracy) {
                    best = (moved, Some(t));
                }
            }
            // Lines of one edge share its parameter, up to whole turns; each polyline counts from its own start.
            let alike = ends.iter().all(|e| routes[e.0].curve.is_some() == own.curve.is_some());
            let target = best.1.filter(|_| alike);
            ends.iter()
                .filter_map(move |&(line, end)| {
                    let (route, t) = (&routes[line], target?);
                    let to = if route.curve.is_some() {
                        let last = route.parameter(end * (route.flat.len() - 2), end as f64);
                        Goal::Parameter(last + (t - start))
                    } else if line != i && (t > start) == (end_of_own == 0) {
                        Goal::Around(own.at(t)[0], own.in_space(t, view))
                    } else {
                        Goal::Point(own.at(t)[0], own.in_space(t, view))
                    };
                    Some(Move { line, end, to })
                })
                .collect::<Vec<_>>()
        })
        .collect()
}

fn changes(routes: &[Route]) -> Vec<Change> {
    let of_line = |(i, route): (usize, &Route)| {
        [0, 1].map(|end| {
            let p = route.flat[end * (route.flat.len() - 1)];
            ((route.chain, p[0].to_bits(), p[1].to_bits()), (i, end))
        })
    };
    let changing = changing(routes);
    let may_change = |route: &Route| {
        route.flat.len() > 1 && (route.border == Border::Outline || changing[route.chain as usize] == [true; 2])
    };
    let lines = routes.par_iter().enumerate().filter(|(_, route)| may_change(route));
    let mut meeting: Vec<_> = lines.flat_map_iter(of_line).collect();
    meeting.par_sort_unstable();
    // Where a visible and a hidden line of one edge meet, both ends move together.
    let mut out: Vec<Change> = meeting
        .chunk_by(|a, b| a.0 == b.0)
        .map(|met| met.iter().map(|(_, end)| *end))
        .filter(|ends| {
            let alone = ends.len() == 1 && ends.clone().all(|(i, _)| routes[i].border == Border::Outline);
            let any_is = |visible| ends.clone().any(|(i, _)| routes[i].visible == visible);
            (alone || any_is(false)) && any_is(true)
        })
        .map(|ends| {
            let ends: Vec<(usize, usize)> = ends.collect();
            let (i, end) = ends[0];
            Change { at: routes[i].flat[end * (routes[i].flat.len() - 1)], ends }
        })
        .collect();
    out.par_sort_by(|a, b| a.at[0].total_cmp(&b.at[0]).then(a.at[1].total_cmp(&b.at[1])).then(a.ends.cmp(&b.ends)));
    out
}

/// Of each chain, whether it has hidden lines, and visible ones.
fn changing(routes: &[Route]) -> Vec<[bool; 2]> {
    let mut of_chain = Vec::new();
    for route in routes {
        let chain = route.chain as usize;
        if chain >= of_chain.len() {
            of_chain.resize(chain + 1, [false; 2]);
        }
        of_chain[chain][usize::from(route.visible)] = true;
    }
    of_chain
}

/// Visible borders of other chains near changes, as (change, line, segment).
fn near(routes: &[Route], changes: &[Change], reach: f64) -> Vec<(usize, usize, usize)> {
    let places = Places::of(changes.iter().map(|change| change.at).collect());
    let mut out: Vec<(usize, usize, usize)> = routes
        .par_iter()
        .enumerate()
        .filter(|(_, route)| route.visible && route.border != Border::None)
        .flat_map_iter(|(j, route)| {
            let places = &places;
            route.flat.windows(2).enumerate().flat_map(move |(k, w)| {
                let low = [0, 1].map(|c| w[0][c].min(w[1][c]) - reach);
                let high = [0, 1].map(|c| w[0][c].max(w[1][c]) + reach);
                let near = move |&c: &usize| {
                    let Change { at, ends } = &changes[c];
                    routes[ends[0].0].chain != route.chain && to_segment(at, &w[0], &w[1]).0 <= reach
                };
                places.within([low, high]).into_iter().filter(near).map(move |c| (c, j, k))
            })
        })
        .collect();
    out.par_sort_unstable();
    out
}

/// Solves own(t) = other(u) by Newton's method. `away`: distance of the solution from the start of the search, mm.
fn crossing(own: &Route, other: &Route, (start, u): (f64, f64), away: f64, accuracy: f64) -> Option<(f64, f64)> {
    let (mut t, mut u) = (start, u);
    for _ in 0..STEPS {
        let ([p, a], [q, b]) = (own.at(t), other.at(u));
        let d = minus(&q, &p);
        let cross = a[0] * b[1] - a[1] * b[0];
        let sine = cross.abs() / (length(&a) * length(&b));
        if sine.is_nan() || sine <= GRAZING {
            return None;
        }
        if length(&d) <= JUNCTION_MET * accuracy {
            // The flatter the angle, the farther along its own line may a change move.
            let most = (away.max(JUNCTION_EDGE * accuracy) / sine).min(JUNCTION_ALONG * accuracy);
            return (length(&minus(&p, &own.at(start)[0])) <= most).then_some((t, u));
        }
        t += (d[0] * b[1] - d[1] * b[0]) / cross;
        u += (d[0] * a[1] - d[1] * a[0]) / cross;
    }
    None
}

/// The place, at most `reach` away along own, where own and other are parallel. Two straight lines are so nowhere, or
/// everywhere.
///
/// ```text
///    own     --------------o- - - -        sought is the place where the tangents' angle vanishes,
///   other         .  -  ~ ~ ~ -  .         by the secant method along other
/// ```
pub(super) fn touching(
    own: &Route,
    other: &Route,
    (start, u): (f64, f64),
    reach: f64,
    accuracy: f64,
) -> Option<(f64, f64)> {
    // The foot point on own of a place of other, and the sine of the angle between them there.
    let look = |mut t: f64, u: f64| {
        let [q, b] = other.at(u);
        let [mut p, mut a] = own.at(t);
        for _ in 0..STEPS {
            let d = minus(&q, &p);
            let next = t + (d[0] * a[0] + d[1] * a[1]) / (a[0] * a[0] + a[1] * a[1]);
            if next == t {
                break;
            }
            t = next;
            [p, a] = own.at(t);
        }
        (t, length(&minus(&q, &p)), (a[0] * b[1] - a[1] * b[0]) / (length(&a) * length(&b)))
    };
    let speed = length(&other.at(u)[1]);
    let (mut u0, mut u1) = (u, u + accuracy / speed);
    let (t0, _, mut g0) = look(start, u0);
    let mut t = t0;
    if g0.abs() > 2.0 * GRAZING {
        return None;
    }
    for _ in 0..STEPS {
        let (foot, away, g1) = look(t, u1);
        t = foot;
        if !g1.is_finite() || length(&minus(&own.at(t)[0], &own.at(start)[0])) > reach {
            return None;
        }
        // At a seam the angle may stop short of zero.
        if g1.abs() < ALIKE || (g1 == g0 && g1.abs() < 1e3 * ALIKE) {
            return (away <= JUNCTION_TOUCH * accuracy).then_some((t, u1));
        }
        if g1 == g0 {
            return None;
        }
        (u0, u1, g0) = (u1, u1 - g1 * (u1 - u0) / (g1 - g0), g1);
    }
    None
}

/// Whether a parameter lies on the line itself, or beyond its end by less than `reach`.
fn within(route: &Route, u: f64, reach: f64) -> bool {
    let (first, last) = (route.parameter(0, 0.0), route.parameter(route.flat.len() - 2, 1.0));
    let (low, high) = (first.min(last), first.max(last));
    if (low..=high).contains(&u) {
        return true;
    }
    let end = if u < low { low } else { high };
    length(&minus(&route.at(u)[0], &route.at(end)[0])) <= reach
}

#[cfg(test)]
mod tests {
    use super::super::plane::Vec2;
    use super::*;
    use hlr_brep::geometry::curve::Vec3;

    fn straight<'a>(chain: i32, visible: bool, flat: &'a [Vec2], space: &'a [Vec3]) -> Route<'a> {
        Route { chain, visible, left_out: [false; 2], border: Border::Edge, flat, space, curve: None, bulge: 0.0 }
    }

    #[test]
    fn a_change_moves_onto_the_line_that_hides() {
        let deep = [[0.0, 0.0, 5.0]; 2];
        let (visible, hidden) = ([[0.0, 0.0], [1.02, 0.0]], [[1.02, 0.0], [3.0, 0.0]]);
        let wall = [[1.0, -1.0], [1.0, 1.0]];
        let mut routes = vec![
            straight(0, true, &visible, &deep),
            straight(0, false, &hidden, &deep),
            straight(1, true, &wall, &[[0.0; 3]; 2]),
        ];
        let view = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };
        let found = junctions(&routes, 0.05, 0.1, &view, (&[], 0.0));
        assert_eq!(found.len(), 2);
        for step in found {
            let (Goal::Point(flat, space) | Goal::Around(flat, space)) = step.to else { panic!() };
            assert!((flat[0] - 1.0).abs() < 1e-12 && space == deep[0]);
        }
        // Too far away, no border of a surface, farther from the viewer, or of the same edge: nothing moves.
        assert!(junctions(&routes, 0.01, 0.1, &view, (&[], 0.0)).is_empty());
        routes[2].border = Border::None;
        assert!(junctions(&routes, 0.05, 0.1, &view, (&[], 0.0)).is_empty());
        routes[2].border = Border::Edge;
        routes[2].space = &[[0.0, 0.0, 9.0]; 2];
        assert!(junctions(&routes, 0.05, 0.1, &view, (&[], 0.0)).is_empty());
        routes[2].space = &[[0.0; 3]; 2];
        routes[2].chain = 0;
        assert!(junctions(&routes, 0.05, 0.1, &view, (&[], 0.0)).is_empty());
    }

    #[test]
    fn what_takes_over_the_last_bit_of_another_line_goes_around_the_corner() {
        let deep = [[0.0, 0.0, 5.0]; 2];
        let (hidden, visible) = ([[3.0, 0.0], [1.02, 0.0]], [[1.02, 0.0], [1.02, 4.0]]);
        let view = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };
        let moves = |x: f64| {
            let wall = [[x, -1.0], [x, 1.0]];
            let routes = [
                straight(0, false, &hidden, &deep),
                straight(0, true, &visible, &deep),
                straight(1, true, &wall, &[[0.0; 3]; 2]),
            ];
            let found = junctions(&routes, 0.05, 0.1, &view, (&[], 0.0));
            found.iter().map(|m| (m.line, matches!(m.to, Goal::Around(..)))).collect::<Vec<_>>()
        };
        assert_eq!(moves(1.04), [(0, false), (1, true)]);
        assert_eq!(moves(1.0), [(0, false), (1, false)]);
    }
}
