//! Puts all lines of a drawing on their curves, and moves line ends at other lines to the crossing of the two curves.

use rayon::prelude::*;

use super::arc::grow;
use super::junction::junctions;
use super::pierced::Meeting;
use super::plane::{Vec2, length, minus};
use super::route::{Border, Goal, Move, Route};
use super::shared_end::share_ends;
use super::smooth_joints::{Grown, smooth_joints, swallowed};
use super::{Drawn, Form, Placed, located, piece};
use crate::lines::Polyline;
use crate::lines::camera::Camera;
use crate::lines::simplify::off;
use hlr_accuracy::{JUNCTION_CORNER, JUNCTION_PIERCED};
use hlr_brep::geometry::curve::{Curve, Vec3};

/// Curves in space, their parameter ranges, and their possible places: matrices into the model, row by row.
#[derive(Default)]
pub struct Curves {
    /// Whether any curves are known. If not, no line ends on another's curve.
    pub known: bool,
    pub curves: Vec<Option<Curve>>,
    pub ranges: Vec<[f64; 2]>,
    pub places: Vec<[[f64; 4]; 3]>,
}

/// Tolerances: in millimetres on paper, except `closed` and `contact`, in model units.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    pub accuracy: f64,
    /// How far chords between points along a circle of a mesh may be off it, as a share of the accuracy.
    pub chord: f64,
    /// Ends of a curve that are nearer than this are one point.
    pub closed: f64,
    /// The depth within which curves touch.
    pub contact: f64,
}

/// The curve along which a line runs.
#[derive(Clone, Copy, Debug)]
pub struct Guide {
    /// Index into `Curves`; None where the curve is not known.
    pub curve: Option<u32>,
    pub place: u32,
    pub border: Border,
    /// How far the curve rises above the chords it was found on, millimetres on paper.
    pub bulge: f64,
    /// The line is the smoothed contour of a mesh, moved on paper.
    pub smoothed: bool,
}

/// A line on its curve: its true ends, the points kept in between, and its form (None: it stays a polyline).
pub struct OnCurve {
    pub form: Option<Form>,
    pub range: [f64; 2],
    pub flat: [Vec2; 2],
    pub space: [Vec3; 2],
    pub inner: std::ops::Range<usize>,
    /// Points between the first and the last of these and the ends, where an end has moved a long way.
    pub grown: [Vec<(Vec2, Vec3)>; 2],
    pub bounds: [Vec2; 2],
}

/// Each line on the curve of its guide; None where another line of its chain takes its place. `meetings`: of intersection
/// lines, sorted by their first coordinate.
pub fn on_curves(
    lines: &[Polyline],
    guides: &[Guide],
    curves: &Curves,
    camera: &Camera,
    fit: &Fit,
    meetings: &[Meeting],
) -> Vec<Option<OnCurve>> {
    let (projection, view, accuracy) = (camera.projection(), camera.view(), fit.accuracy);
    let n = lines.len();
    // Lines along one curve in one place share its search table.
    let key = |i: u32| guides[i as usize].curve.map(|c| (c, guides[i as usize].place));
    let mut order: Vec<u32> = (0..n as u32).filter(|&i| key(i).is_some()).collect();
    order.sort_by_key(|&i| (key(i), i));
    let groups: Vec<&[u32]> = order.chunk_by(|&a, &b| key(a) == key(b)).collect();
    let stand: Vec<Option<Placed>> = groups
        .par_iter()
        .map(|group| {
            let (c, p) = key(group[0])?;
            let curve = curves.curves[c as usize].as_ref()?.moved(&curves.places[p as usize]);
            Some(Placed::new(curve, curves.ranges[c as usize], &projection, fit.closed))
        })
        .collect();
    let mut placed: Vec<Option<&Placed>> = vec![None; n];
    for (group, stand) in groups.iter().zip(&stand) {
        group.iter().for_each(|&i| placed[i as usize] = stand.as_ref());
    }
    let mut routes: Vec<Route> = (0..n)
        .into_par_iter()
        .map(|i| {
            let (line, guide) = (&lines[i], &guides[i]);
            let curve = placed[i].and_then(|p| Some((p, located(p, &line.flat, &line.space, accuracy, guide.bulge)?)));
            Route {
                chain: line.chain as i32,
                visible: line.visible,
                left_out: line.left_out,
                border: guide.border,
                flat: &line.flat,
                space: &line.space,
                bulge: if curve.is_some() { guide.bulge } else { 0.0 },
                curve,
            }
        })
        .collect();
    let beside = JUNCTION_PIERCED * accuracy / camera.scale;
    let mut moves = junctions(&routes, accuracy, fit.contact, &view, (meetings, beside));
    let joints = smooth_joints(&routes, &moves, accuracy, fit.contact, &view);
    let first_joint = moves.len();
    moves.extend(joints);
    let mut grown: Vec<Grown> = Vec::new();
    // The ends of polylines that move. Ends of curves move with their interval.
    let mut moved: Vec<[Option<(Vec2, Vec3)>; 2]> = vec![[None; 2]; n];
    let mut between: Vec<[Vec<(Vec2, Vec3)>; 2]> = vec![<[Vec<_>; 2]>::default(); n];
    for (k, Move { line, end, to }) in moves.into_iter().enumerate() {
        match (&mut routes[line].curve, to) {
            (Some((_, ts)), Goal::Parameter(t)) => {
                let at = end * (ts.len() - 1);
                let rest = ts[ts.len() - 1 - at];
                // An end never moves past the line's other end.
                if (ts[at] - rest) * (t - rest) > 0.0 {
                    if k >= first_joint && (t - rest).abs() > (ts[at] - rest).abs() {
                        grown.push(Grown { line, end, range: [ts[at], t] });
                    }
                    ts[at] = t;
                }
            }
            (None, Goal::Point(flat, space) | Goal::Around(flat, space)) => {
                moved[line][end] = Some((flat, space));
                let around = matches!(to, Goal::Around(..));
                let corner = || corner(&routes[line], end, (flat, space), accuracy, camera.scale);
                between[line][end] = if around { corner().into_iter().collect() } else { Vec::new() };
            }
            _ => {}
        }
    }
    let gone = swallowed(&mut routes, &grown);
    grown.iter().for_each(|g| between[g.line][g.end] = points_between(&routes[g.line], g.range, fit));
    let mut drawn: Vec<Option<Drawn>> = routes
        .par_iter()
        .map(|route| {
            let (p, ts) = route.curve.as_ref()?;
            piece(p, [ts[0], ts[ts.len() - 1]], accuracy)
        })
        .collect();
    share_ends(&routes, &mut drawn, accuracy);
    routes
        .into_par_iter()
        .zip(drawn)
        .zip(moved)
        .zip(gone)
        .zip(between)
        .map(|((((route, drawn), moved), gone), grown)| match (drawn, &route.curve) {
            _ if gone => None,
            (Some(drawn), Some((_, ts))) => Some(OnCurve { grown, ..along(drawn, ts) }),
            (None, None) => Some(OnCurve { grown, ..as_it_was(&route, moved) }),
            _ => Some(as_it_was(&route, moved)),
        })
        .collect()
}

/// A line that turns back over itself on paper is drawn between its extremes, without the points beyond them.
fn along(drawn: Drawn, ts: &[f64]) -> OnCurve {
    let (low, high) = (drawn.range[0].min(drawn.range[1]), drawn.range[0].max(drawn.range[1]));
    let inside = |t: &f64| *t > low && *t < high;
    let first = ts.iter().position(inside).unwrap_or(0);
    let inner = first..ts.iter().rposition(inside).map_or(first, |k| k + 1);
    let Drawn { form, range, flat, space, bounds } = drawn;
    OnCurve { form: Some(form), range, flat, space, inner, grown: Default::default(), bounds }
}

/// Points of a line in a range of its curve, without its ends: chords between them are near enough to the curve.
fn points_between(route: &Route, [from, to]: [f64; 2], fit: &Fit) -> Vec<(Vec2, Vec3)> {
    let Some((placed, _)) = &route.curve else { return Vec::new() };
    let ([p, a], [q, b]) = (placed.on_paper(from), placed.on_paper(to));
    let turn = (a[0] * b[1] - a[1] * b[0]).abs() / (length(&a) * length(&b));
    // An arc of length s that turns by w rises s w / 8 above its chord.
    let count = (length(&minus(&q, &p)) * turn / (8.0 * fit.chord * fit.accuracy)).sqrt().ceil() as usize;
    let at = |k: usize| from + (to - from) * k as f64 / (count + 1) as f64;
    (1..=count).map(|k| (placed.on_paper(at(k))[0], placed.curve.point(placed.track.wrapped(at(k))))).collect()
}

/// The old end of a polyline, where the chord from its new end to the next point would pass it too far away.
fn corner(route: &Route, end: usize, new: (Vec2, Vec3), accuracy: f64, scale: f64) -> Option<(Vec2, Vec3)> {
    let last = route.flat.len() - 1;
    let (old, next) = (end * last, if end == 0 { 1 } else { last - 1 });
    let flat = off(&route.flat[old], &new.0, &route.flat[next]);
    let space = off(&route.space[old], &new.1, &route.space[next]);
    (flat.max(space * scale) > JUNCTION_CORNER * accuracy).then(|| (route.flat[old], route.space[old]))
}

fn as_it_was(route: &Route, moved: [Option<(Vec2, Vec3)>; 2]) -> OnCurve {
    let last = route.flat.len() - 1;
    let ends = [0, 1].map(|k| moved[k].unwrap_or((route.flat[k * last], route.space[k * last])));
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    route.flat.iter().for_each(|p| grow(&mut bounds, p));
    ends.iter().for_each(|(p, _)| grow(&mut bounds, p));
    OnCurve {
        form: None,
        range: [f64::NAN; 2],
        flat: ends.map(|e| e.0),
        space: ends.map(|e| e.1),
        inner: 0..last + 1,
        grown: Default::default(),
        bounds,
    }
}

#[cfg(test)]
mod tests {
    use super::super::route::Border;
    use super::*;

    #[test]
    fn a_corner_stays_where_its_line_would_pass_it_on_paper_or_in_depth() {
        let flat = [[0.0, 0.0], [0.0, 8.0]];
        let kept = |new: Vec2, deep: f64| {
            let space = [[0.0, 0.0, 0.0], [0.0, 8.0, 0.0]];
            let (back_flat, back_space) = ([flat[1], flat[0]], [space[1], space[0]]);
            let route = |flat, space| Route {
                chain: 0,
                visible: true,
                left_out: [false; 2],
                border: Border::None,
                flat,
                space,
                curve: None,
                bulge: 0.0,
            };
            let there = (new, [new[0], new[1], deep]);
            let (on, back) = (route(&flat[..], &space[..]), route(&back_flat[..], &back_space[..]));
            let found = [corner(&on, 0, there, 1.0, 1.0), corner(&back, 1, there, 1.0, 1.0)];
            assert_eq!(found[0], found[1]);
            found[0].is_some()
        };
        assert!(!kept([0.1, 0.0], 0.0) && !kept([0.0, -2.0], 0.0));
        assert!(kept([0.5, 0.0], 0.0) && kept([0.1, 0.0], 0.5));
    }
}
