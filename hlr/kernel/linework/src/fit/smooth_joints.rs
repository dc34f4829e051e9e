//! Ends at which an outline goes on smoothly as another line: as the rim of the bore that its shaft stands in, or as the
//! line along which its tube dives into a block. The two touch in space, and on paper too.
//!
//! ```text
//!     outline of the shaft  ---------o . .  x---.      o: the place of contact, where both end
//!                                         ` -    \     x: where the facets of the shaft no longer hide the rim
//!     rim of the bore                         ` -  )
//! ```
//!
//! Close to the place of contact both run within the deflection of one another, so each may end a long way off it.

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::junction::touching;
use super::plane::{Vec2, dot, length, minus};
use super::route::{Border, Goal, Move, Route};
use crate::lines::View;
use hlr_accuracy::{JOINT_REACH, JUNCTION_OUTLINE, JUNCTION_TOUCH};

/// Cosine of the angle between two lines that go on as one another.
const ON: f64 = 0.9;
/// Cosine of half the angle by which a line turns on its way to the place of contact, at most.
const STRAIGHT_ON: f64 = 0.98;
/// Sine of the angle below which two lines run along one another, and touch nowhere in particular.
const ALONG: f64 = 1e-4;

/// More than sums of a few distances are off by rounding.
const ROUNDED_UP: f64 = 1.001;

/// Of the way that an end moved: how far apart two lines are found to touch a third in the same place.
const SAME_PLACE: f64 = 1e-3;

/// A visible end: its line, which end, its place, and the unit direction in which it points.
#[derive(Clone, Copy)]
struct End {
    line: usize,
    end: usize,
    at: Vec2,
    way: Vec2,
}

/// The visible ends that move to places of contact. `moved`: ends that were moved to where a line crosses, which stay.
/// A contact is no deeper than `contact` (model units).
pub fn smooth_joints(routes: &[Route], moved: &[Move], accuracy: f64, contact: f64, view: &View) -> Vec<Move> {
    if !routes.iter().any(|route| route.visible && route.border == Border::Outline) {
        return Vec::new();
    }
    let mut all = ends(routes);
    all.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    let outlines: Vec<End> = all.iter().filter(|end| routes[end.line].border == Border::Outline).copied().collect();
    let settled: FxHashSet<(usize, usize)> = moved.iter().map(|m| (m.line, m.end)).collect();
    let near = JUNCTION_TOUCH * accuracy;
    // Whether an end may move: no other meets it, and no line that crosses explains it.
    let is_free = |own: &End| {
        let beside = within(&all, own.at[0], near).iter().any(|e| !same(e, own) && distance(e, own) <= near);
        !beside && !settled.contains(&(own.line, own.end))
    };
    let joint = |own: &End| -> Option<Vec<Move>> {
        let facing = |o: &&End| dot(&own.way, &o.way) < -ON && distance(o, own) <= JOINT_REACH;
        let asked = within(&outlines, own.at[0], JOINT_REACH).iter().filter(facing);
        let found = asked.filter_map(|o| Some((o, contact_of(routes, own, o, accuracy, contact, view)?)));
        let (outline, (_, [first, second])) = found.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        Some(if is_free(outline) { vec![first, second] } else { vec![first] })
    };
    let asked = |own: &&End| {
        let line = &routes[own.line];
        line.border != Border::Outline && line.curve.is_some() && is_free(own)
    };
    all.par_iter().filter(asked).filter_map(joint).flatten_iter().collect()
}

/// Those of the ends (sorted by x) whose x is within `reach` of this one.
fn within(all: &[End], x: f64, reach: f64) -> &[End] {
    let from = all.partition_point(|e| e.at[0] < x - reach);
    &all[from..from + all[from..].partition_point(|e| e.at[0] <= x + reach)]
}

fn same(a: &End, b: &End) -> bool {
    (a.line, a.end) == (b.line, b.end)
}

fn distance(a: &End, b: &End) -> f64 {
    length(&minus(&a.at, &b.at))
}

fn ends(routes: &[Route]) -> Vec<End> {
    let of = |(line, route): (usize, &Route)| {
        [0, 1].map(|end| {
            let last = route.flat.len() - 1;
            let (at, before) = (route.flat[end * last], route.flat[if end == 0 { 1 } else { last - 1 }]);
            let way = minus(&at, &before);
            let size = length(&way);
            End { line, end, at, way: [way[0] / size, way[1] / size] }
        })
    };
    let fit = routes.iter().enumerate().filter(|(_, route)| route.visible && route.flat.len() > 1);
    fit.flat_map(of).filter(|end| end.way[0].is_finite()).collect()
}

/// A line that has grown at one end, and the range of its curve there.
pub struct Grown {
    pub line: usize,
    pub end: usize,
    pub range: [f64; 2],
}

/// Takes out what other lines of its chain have where a line has grown: of hidden lines the bit there, and lines that lie
/// there altogether. True where nothing of a line is left.
pub fn swallowed(routes: &mut [Route], all: &[Grown]) -> Vec<bool> {
    let mut gone = vec![false; routes.len()];
    // Few chains have such lines, and few lines are of these chains.
    let mut of_chain: FxHashMap<i32, Vec<usize>> = all.iter().map(|g| (routes[g.line].chain, Vec::new())).collect();
    for (k, route) in routes.iter().enumerate() {
        if let Some(lines) = of_chain.get_mut(&route.chain) {
            lines.push(k);
        }
    }
    for &Grown { line, range: [from, to], .. } in all {
        let lines = of_chain.get(&routes[line].chain).into_iter().flatten();
        let slack = SAME_PLACE * (to - from).abs();
        let (low, high) = (from.min(to) - slack, from.max(to) + slack);
        for &k in lines.filter(|k| **k != line) {
            let Route { visible, curve: Some((placed, ts)), .. } = &mut routes[k] else { continue };
            let last = ts.len() - 1;
            // Each polyline counts whole turns from its own start.
            let turns = placed.track.period.map_or(0.0, |p| ((0.5 * (ts[0] + ts[last] - low - high)) / p).round() * p);
            let inside = [ts[0], ts[last]].map(|t| (low..=high).contains(&(t - turns)));
            if inside == [true, true] {
                gone[k] = true;
            } else if inside != [false, false] && !*visible {
                ts[if inside[0] { 0 } else { last }] = to + turns;
            }
        }
    }
    gone
}

/// How far the end of `own` moves, and how both ends move to their place of contact, if there is one.
fn contact_of(
    routes: &[Route],
    own: &End,
    outline: &End,
    accuracy: f64,
    contact: f64,
    view: &View,
) -> Option<(f64, [Move; 2])> {
    let (line, other) = (&routes[own.line], &routes[outline.line]);
    let last = |end: &End, route: &Route| route.parameter(end.end * (route.flat.len() - 2), end.end as f64);
    let (start, from) = (last(own, line), last(outline, other));
    let ([before, a], [after, b]) = (line.at(start), other.at(from));
    if (a[0] * b[1] - a[1] * b[0]).abs() <= ALONG * length(&a) * length(&b) {
        return None;
    }
    // The place is so near the outline's end that most others are told by where that end is: no search for them.
    let near = |far: f64| far <= JUNCTION_OUTLINE * accuracy;
    let ahead = minus(&after, &before);
    let slack = (JUNCTION_OUTLINE + JUNCTION_TOUCH) * accuracy * ROUNDED_UP;
    if !near(length(&ahead) - slack) && dot(&ahead, &own.way) + slack < STRAIGHT_ON * (length(&ahead) - slack) {
        return None;
    }
    let (t, u) = touching(line, other, (start, from), JOINT_REACH, accuracy)?;
    let (t, u) = (line.ending(t, start)?, other.ending(u, from)?);
    let place = line.at(t)[0];
    let (there, space) = (other.at(u)[0], other.in_space(u, view));
    let deep = view.depth(&line.in_space(t, view)) - view.depth(&space);
    let way = minus(&place, &before);
    let far = length(&way);
    // A long way goes nearly straight on.
    let onward = near(far) || dot(&way, &own.way) >= STRAIGHT_ON * far;
    let met = length(&minus(&place, &there)) <= JUNCTION_TOUCH * accuracy
        && near(length(&minus(&there, &after)))
        && deep.abs() <= contact
        && onward
        && far <= JOINT_REACH;
    let goal = |route: &Route, t: f64| match route.curve {
        Some(_) => Goal::Parameter(t),
        None => Goal::Point(there, space),
    };
    let moves = [
        Move { line: own.line, end: own.end, to: Goal::Parameter(t) },
        Move { line: outline.line, end: outline.end, to: goal(other, u) },
    ];
    met.then_some((far, moves))
}

#[cfg(test)]
mod tests {
    use super::super::Placed;
    use super::super::project::Projection;
    use super::*;
    use hlr_brep::geometry::curve::{Curve, Vec3};

    const ACCURACY: f64 = 0.05;
    const RADIUS: f64 = 10.0;

    /// A circle on paper that touches the upright outline at (10, 0): seen from below up to some angle before that, then
    /// hidden, seen again for a bit, and hidden.
    fn routes<'a>(rim: &'a Placed, flat: &'a [[Vec2; 2]], deep: &'a [[Vec3; 2]], ts: &[[f64; 2]]) -> Vec<Route<'a>> {
        let line = |k: usize, visible| Route {
            chain: 0,
            visible,
            left_out: [false; 2],
            border: Border::Edge,
            flat: &flat[k],
            space: &deep[k],
            curve: Some((rim, ts[k].to_vec())),
            bulge: 0.0,
        };
        let outline = Route { chain: 1, border: Border::Outline, curve: None, ..line(4, true) };
        vec![line(0, true), line(1, false), line(2, true), line(3, false), outline]
    }

    #[test]
    fn a_rim_goes_on_to_where_the_outline_touches_it_and_takes_the_place_of_its_pieces_before() {
        let circle = Curve::Ellipse { p: [0.0; 3], a: [RADIUS, 0.0, 0.0], b: [0.0, RADIUS, 0.0] };
        let projection = Projection([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        let rim = Placed::new(circle, [0.0, std::f64::consts::TAU], &projection, 1e-6);
        let ts = [[-1.0, -0.15], [-0.15, -0.1], [-0.1, -0.06], [-0.06, 0.5], [0.0; 2]];
        let at = |t: f64| [RADIUS * t.cos(), RADIUS * t.sin()];
        let near = |t: f64| [at(t - 0.01), at(t)];
        let flat = [near(-0.15), near(-0.1), near(-0.06), near(0.5), [[RADIUS, 0.0], [RADIUS, 30.0]]];
        let deep = flat.map(|line| line.map(|[x, y]| [x, y, 0.0]));
        let view = View { origin: [0.0; 3], away: [0.0, 0.0, -1.0], perspective: false };
        let mut all = routes(&rim, &flat, &deep, &ts);
        let moves = smooth_joints(&all, &[], ACCURACY, 0.1, &view);
        let found: Vec<(usize, usize)> = moves.iter().map(|m| (m.line, m.end)).collect();
        assert!(found.contains(&(0, 1)) && found.contains(&(2, 1)), "{found:?}");
        for step in moves.iter().filter(|m| m.line != 4) {
            let Goal::Parameter(t) = step.to else { panic!() };
            assert!(t.abs() < 1e-6, "{t}");
        }
        let gone = swallowed(&mut all, &[Grown { line: 0, end: 1, range: [-0.15, 0.0] }]);
        assert_eq!(gone, [false, true, true, false, false]);
        assert_eq!(all[3].curve.as_ref().map(|(_, ts)| ts[0]), Some(0.0));
        // What a crossing line explains stays, and so does what the outline passes far before.
        let settled = [Move { line: 0, end: 1, to: Goal::Parameter(-0.15) }];
        assert!(smooth_joints(&all, &settled, ACCURACY, 0.1, &view).iter().all(|m| m.line != 0));
        let before = deep.map(|line| line.map(|[x, y, _]| [x, y, if x == RADIUS { 9.0 } else { 0.0 }]));
        let apart = routes(&rim, &flat, &before, &ts);
        assert!(smooth_joints(&apart, &[], ACCURACY, 0.1, &view).is_empty());
    }
}
