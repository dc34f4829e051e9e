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
use super::places::{Places, around};
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
#[derive(Clone, Copy, Debug)]
struct End {
    line: usize,
    end: usize,
    at: Vec2,
    way: Vec2,
}

/// Where the curve of a line ends, beside the end of its polyline: the parameter, and the place and derivative there.
struct Start {
    t: f64,
    on_paper: [Vec2; 2],
}

impl Start {
    fn of(routes: &[Route], end: &End) -> Start {
        let route = &routes[end.line];
        let t = route.parameter(end.end * (route.flat.len() - 2), end.end as f64);
        Start { t, on_paper: route.at(t) }
    }
}

/// The visible ends that move to places of contact. `moved`: ends that were moved to where a line crosses, which stay.
/// A contact is no deeper than `contact` (model units).
pub fn smooth_joints(routes: &[Route], moved: &[Move], accuracy: f64, contact: f64, view: &View) -> Vec<Move> {
    if !routes.iter().any(|route| route.visible && route.border == Border::Outline) {
        return Vec::new();
    }
    let mut all = ends(routes);
    all.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    let places = Places::of(all.iter().map(|end| end.at).collect());
    let outlines = Outlines::of(routes, &all);
    let settled: FxHashSet<(usize, usize)> = moved.iter().map(|m| (m.line, m.end)).collect();
    let near = JUNCTION_TOUCH * accuracy;
    // Whether an end may move: no other meets it, and no line that crosses explains it.
    let is_free = |own: &End| {
        let meets = |k: usize| !same(&all[k], own) && distance(&all[k], own) <= near;
        !settled.contains(&(own.line, own.end)) && !places.any(around(&own.at, near), meets)
    };
    let joint = |own: &End| -> Option<Vec<Move>> {
        let start = Start::of(routes, own);
        let facing = |o: &End| dot(&own.way, &o.way) < -ON && distance(o, own) <= JOINT_REACH;
        let curve = routes[own.line].curve.as_ref().and_then(|(placed, _)| placed.paper.bounds());
        let ahead = outlines.ahead_of(own, &start, slack(accuracy), curve);
        let asked = ahead.into_iter().map(|k| (k, &outlines.ends[k])).filter(|(_, (o, _))| facing(o));
        let found = asked.filter_map(|(k, (o, from))| {
            let (far, moves) = contact_of(routes, (own, &start), (o, from), accuracy, contact, view)?;
            Some((far, k, moves))
        });
        let (_, k, [first, second]) = found.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        Some(if is_free(&outlines.ends[k].0) { vec![first, second] } else { vec![first] })
    };
    let asked = |own: &&End| {
        let line = &routes[own.line];
        line.border != Border::Outline && line.curve.is_some() && is_free(own)
    };
    all.par_iter().filter(asked).filter_map(joint).flatten_iter().collect()
}

/// The visible ends of outlines, looked up by where their curves end.
struct Outlines {
    ends: Vec<(End, Start)>,
    places: Places,
    /// The numbers of the ends by the numbers of the places.
    of_place: Vec<usize>,
    /// How far from its end a curve ends, at most.
    off: f64,
}

impl Outlines {
    fn of(routes: &[Route], all: &[End]) -> Outlines {
        let own = all.iter().filter(|end| routes[end.line].border == Border::Outline);
        let ends: Vec<(End, Start)> = own.map(|end| (*end, Start::of(routes, end))).collect();
        let place = |k: usize| ends[k].1.on_paper[0];
        let mut of_place: Vec<usize> = (0..ends.len()).collect();
        of_place.sort_by(|&a, &b| place(a)[0].total_cmp(&place(b)[0]));
        let places = Places::of(of_place.iter().map(|&k| place(k)).collect());
        let off = ends.iter().map(|(end, start)| off(end, start)).filter(|off| off.is_finite()).fold(0.0, f64::max);
        Outlines { ends, places, of_place, off }
    }

    /// Those that may lie straight ahead of an end, as `is_ahead` says, within the reach of joints.
    ///
    /// ```text
    ///              .----------------------.
    ///     ---------|x                     |      x: where the curve ends. What is ahead lies in a wedge, a little
    ///              '----------------------'      farther back and to the sides: in this rectangle
    /// ```
    /// Both meet where the curve of the end is, and the outline's end is not far from there. curve: the box of that one.
    fn ahead_of(&self, own: &End, start: &Start, slack: f64, curve: Option<[Vec2; 2]>) -> Vec<usize> {
        // Those close by lie within twice the slack.
        let close = 3.0 * slack;
        let reach = (ROUNDED_UP * (JOINT_REACH + self.off + off(own, start))).max(close);
        if !reach.is_finite() {
            return Vec::new();
        }
        let onward = (STRAIGHT_ON * (reach - slack) - slack).max(0.0);
        let aside = (ROUNDED_UP * (reach * reach - onward * onward).sqrt()).max(close);
        let mut corners = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for (along, across) in [(-close, aside), (-close, -aside), (reach, aside), (reach, -aside)] {
            let [x, y] = own.way;
            let corner = [along * x - across * y, along * y + across * x];
            for k in 0..2 {
                corners[0][k] = corners[0][k].min(start.on_paper[0][k] + corner[k]);
                corners[1][k] = corners[1][k].max(start.on_paper[0][k] + corner[k]);
            }
        }
        if let Some([low, high]) = curve {
            for k in 0..2 {
                corners[0][k] = corners[0][k].max(low[k] - close);
                corners[1][k] = corners[1][k].min(high[k] + close);
            }
        }
        self.places.within(corners).into_iter().map(|place| self.of_place[place]).collect()
    }
}

/// How far from the end of a line its curve ends.
fn off(end: &End, start: &Start) -> f64 {
    length(&minus(&end.at, &start.on_paper[0]))
}

/// How far a place of contact lies from the two ends at most, besides the way ahead: of an outline it is near the end.
fn slack(accuracy: f64) -> f64 {
    (JUNCTION_OUTLINE + JUNCTION_TOUCH) * accuracy * ROUNDED_UP
}

/// Whether a place is so near, or so far straight ahead, that a place of contact beside it may be.
fn is_ahead(ahead: &Vec2, way: &Vec2, accuracy: f64) -> bool {
    let (far, slack) = (length(ahead), slack(accuracy));
    far - slack <= JUNCTION_OUTLINE * accuracy || dot(ahead, way) + slack >= STRAIGHT_ON * (far - slack)
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
    (own, Start { t: start, on_paper: [before, a] }): (&End, &Start),
    (outline, Start { t: from, on_paper: [after, b] }): (&End, &Start),
    accuracy: f64,
    contact: f64,
    view: &View,
) -> Option<(f64, [Move; 2])> {
    let (line, other, start, from) = (&routes[own.line], &routes[outline.line], *start, *from);
    if (a[0] * b[1] - a[1] * b[0]).abs() <= ALONG * length(a) * length(b) {
        return None;
    }
    // The place is so near the outline's end that most others are told by where that end is: no search for them.
    if !is_ahead(&minus(after, before), &own.way, accuracy) {
        return None;
    }
    let near = |far: f64| far <= JUNCTION_OUTLINE * accuracy;
    let (t, u) = touching(line, other, (start, from), JOINT_REACH, accuracy)?;
    let (t, u) = (line.ending(t, start)?, other.ending(u, from)?);
    let place = line.at(t)[0];
    let (there, space) = (other.at(u)[0], other.in_space(u, view));
    let deep = view.depth(&line.in_space(t, view)) - view.depth(&space);
    let way = minus(&place, before);
    let far = length(&way);
    // A long way goes nearly straight on.
    let onward = near(far) || dot(&way, &own.way) >= STRAIGHT_ON * far;
    let met = length(&minus(&place, &there)) <= JUNCTION_TOUCH * accuracy
        && near(length(&minus(&there, after)))
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

    #[test]
    fn every_outline_ahead_of_an_end_is_found() {
        // Short outlines in all directions, scattered by a congruential generator.
        let mut state = 5u32;
        let mut next = |size: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            size * f64::from(state >> 8) / f64::from(1 << 24)
        };
        let flat: Vec<[Vec2; 2]> = (0..800)
            .map(|_| {
                let (at, turn) = ([next(60.0), next(50.0)], next(std::f64::consts::TAU));
                [at, [at[0] + turn.cos(), at[1] + turn.sin()]]
            })
            .collect();
        let deep: Vec<[Vec3; 2]> = flat.iter().map(|line| line.map(|[x, y]| [x, y, 0.0])).collect();
        let routes: Vec<Route> = (0..flat.len())
            .map(|k| Route {
                chain: k as i32,
                visible: true,
                left_out: [false; 2],
                border: Border::Outline,
                flat: &flat[k],
                space: &deep[k],
                curve: None,
                bulge: 0.0,
            })
            .collect();
        let all = ends(&routes);
        let outlines = Outlines::of(&routes, &all);
        let (mut wanted, mut looked_at) = (0, 0);
        for own in &all {
            let start = Start::of(&routes, own);
            let found = outlines.ahead_of(own, &start, slack(ACCURACY), None);
            looked_at += found.len();
            for (k, (outline, from)) in outlines.ends.iter().enumerate() {
                let ahead = minus(&from.on_paper[0], &start.on_paper[0]);
                if distance(own, outline) <= JOINT_REACH && is_ahead(&ahead, &own.way, ACCURACY) {
                    wanted += 1;
                    assert!(found.contains(&k), "{own:?} {outline:?}");
                }
            }
            let near = [own.at.map(|c| c - 2.0), own.at.map(|c| c + 2.0)];
            let found = outlines.ahead_of(own, &start, slack(ACCURACY), Some(near));
            let beside = |k: &usize| (0..2).all(|c| (outlines.ends[*k].0.at[c] - own.at[c]).abs() < 2.5);
            assert!(found.iter().all(beside), "no farther away than where the curve is");
        }
        assert!(wanted > 10_000 && looked_at < all.len() * all.len() / 4, "{wanted} {looked_at}");
    }
}
