//! Ends of lines at surfaces that they pass through: an edge goes on behind a surface from where the edge and the true
//! surface meet, which is the end of an intersection line. The meshes meet a little beside it.

use super::plane::Vec2;
use super::route::{Change, Goal, Move, Route};
use hlr_brep::geometry::curve::Vec3;
use hlr_brep::geometry::vector::{length, sub};

/// A point of an intersection line: where the meshes meet, where the surfaces do, and that place on paper.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    pub meshed: Vec3,
    pub space: Vec3,
    pub flat: Vec2,
}

/// How ends move to the meetings where they are, if they are within `reach` of one (model units). `meetings`: sorted by
/// their first coordinate.
pub fn at_meeting(routes: &[Route], change: &Change, meetings: &[Meeting], reach: f64) -> Option<Vec<Move>> {
    let (line, end) = change.ends[0];
    let at = routes[line].space[end * (routes[line].space.len() - 1)];
    let from = meetings.partition_point(|m| m.meshed[0] < at[0] - reach);
    let beside = meetings[from..].iter().take_while(|m| m.meshed[0] <= at[0] + reach);
    let away = |m: &Meeting| length(&sub(&m.meshed, &at));
    let met = beside.filter(|m| away(m) <= reach).min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let moved = |&(line, end): &(usize, usize)| {
        let to = match &routes[line].curve {
            Some((placed, ts)) => {
                let start = ts[end * (ts.len() - 1)];
                let step = placed.track.nearest(&placed.curve, &met.space) - start;
                let turns = placed.track.period.map_or(0.0, |period| (step / period).round() * period);
                Goal::Parameter(routes[line].ending(start + step - turns, start)?)
            }
            None => Goal::Point(met.flat, met.space),
        };
        Some(Move { line, end, to })
    };
    change.ends.iter().map(moved).collect()
}

#[cfg(test)]
mod tests {
    use super::super::route::Border;
    use super::*;

    #[test]
    fn both_ends_of_a_change_move_to_the_nearest_meeting_within_reach() {
        let flat = [[[0.0, 0.0], [1.02, 0.0]], [[1.02, 0.0], [3.0, 0.0]]];
        let space = flat.map(|line| line.map(|[x, y]| [x, y, 7.0]));
        let route = |i: usize| Route {
            chain: 4,
            visible: i == 0,
            left_out: [false; 2],
            border: Border::Edge,
            flat: &flat[i],
            space: &space[i],
            curve: None,
            bulge: 0.0,
        };
        let change = Change { at: flat[0][1], ends: vec![(0, 1), (1, 0)] };
        let meeting = |x: f64, to: f64| Meeting { meshed: [x, 0.0, 7.0], space: [to, 0.0, 7.0], flat: [to, 0.0] };
        let meetings = [meeting(0.5, 0.4), meeting(1.019, 1.0), meeting(1.0215, 1.1)];
        let routes = [route(0), route(1)];
        let Some(moves) = at_meeting(&routes, &change, &meetings, 0.01) else { panic!() };
        assert_eq!(moves.iter().map(|m| (m.line, m.end)).collect::<Vec<_>>(), [(0, 1), (1, 0)]);
        for step in moves {
            let Goal::Point(flat, space) = step.to else { panic!() };
            assert_eq!((flat, space), ([1.0, 0.0], [1.0, 0.0, 7.0]));
        }
        assert!(at_meeting(&routes, &change, &meetings, 1e-4).is_none());
        assert!(
            at_meeting(
                &routes,
                &change,
                &[meeting(1.019, 1.0)].map(|m| Meeting { meshed: [1.02, 0.5, 7.0], ..m }),
                0.01
            )
            .is_none()
        );
    }
}
