//! Replaces polylines along mesh edges by intervals of the true curves on paper:
//!
//! 1. `locate`   the parameters of a line's vertices on its edge's curve in space, checked against the line
//! 2. `project`  the curve on paper
//! 3. `junction`  ends where another line hides this one, moved to the crossing of the two curves
//!    `smooth_joints`  ends where an outline goes on as another line, moved to where the two touch
//!    `pierced`   ends where the line passes through a surface, moved to the end of the intersection line
//!    `places`   which ends lie near a place
//! 4. `straight`, `arc`, `bezier`, `cubic`  the first of these that is exact, or within its share of the accuracy
//! 5. `shared_end`  ends of one edge's lines that met before meet again, to the last bit
//!
//! Contours of meshes have no such curve: `smooth` makes one within the accuracy of the polyline.
//!
//! A curve that is farther from its line than the accuracy is rejected: the line stays a polyline.

pub(crate) mod arc;
pub mod bezier;
mod contour_fit;
mod cubic;
mod junction;
mod locate;
pub(crate) mod pierced;
mod placed;
mod places;
pub(crate) mod plane;
pub(crate) mod project;
pub mod route;
pub mod routes;
mod shared_end;
pub(crate) mod smooth;
mod smooth_joints;
mod straight;
mod track;

use arc::grow;
use bezier::Chain;
use hlr_accuracy::CURVE_FIT;
use hlr_brep::geometry::curve::Vec3;
pub use placed::{Drawn, Form, Placed};
use plane::Vec2;
use project::Paper;

/// The parameters of a line's points (on paper and in space) on its curve, or None where it does not run along it.
/// `bulge`: how far the curve is known to rise above the line's chords.
pub fn located(placed: &Placed, flat: &[Vec2], space: &[Vec3], accuracy: f64, bulge: f64) -> Option<Vec<f64>> {
    if flat.len() < 2 || matches!(placed.paper, Paper::Line) {
        return None;
    }
    locate::along(placed, flat, space, accuracy, bulge)
}

/// The drawn form of an interval of a curve. The interval may run backward, and beyond the seam of a closed curve. None
/// where it is a point: a line all of whose points lie beyond the end of its curve.
pub fn piece(placed: &Placed, range: [f64; 2], accuracy: f64) -> Option<Drawn> {
    if range[0] == range[1] {
        return None;
    }
    let ends = |range: [f64; 2]| {
        let (mut flat, mut space) =
            (range.map(|t| placed.on_paper(t)[0]), range.map(|t| placed.curve.point(placed.track.wrapped(t))));
        if placed.track.closes(range) {
            (flat[1], space[1]) = (flat[0], space[0]);
        }
        (flat, space)
    };
    if let Some(extremes) = straight::straight(placed, range, accuracy) {
        let (flat, space) = ends(extremes);
        let mut bounds = [flat[0], flat[0]];
        grow(&mut bounds, &flat[1]);
        return Some(Drawn { form: Form::Straight, range: extremes, flat, space, bounds });
    }
    let (flat, space) = ends(range);
    if !flat.iter().flatten().all(|c| c.is_finite()) {
        return None;
    }
    if let Some(ellipse) = &placed.ellipse {
        let angles = range.map(|t| ellipse.angle(t));
        let bounds = ellipse.bounds(angles[0], angles[1]);
        return Some(Drawn { form: Form::Arc(*ellipse, angles), range, flat, space, bounds });
    }
    let (low, high) = (range[0].min(range[1]), range[0].max(range[1]));
    let mut chain: Option<Chain> = None;
    // Beyond its seam a closed curve continues with its beginning.
    for [a, b] in placed.track.unbroken(low, high) {
        let mut next = bezier::exact(&placed.paper, a, b).unwrap_or_else(|| {
            let (corners, spans) = (placed.paper.corners(a, b), placed.paper.spans(a, b));
            cubic::fit(&|t| placed.paper.at(t), a, b, &corners, spans, CURVE_FIT * accuracy)
        });
        match &mut chain {
            Some(chain) => chain.points.extend(next.points.drain(1..)),
            None => chain = Some(next),
        }
    }
    let mut chain = chain?;
    if range[0] > range[1] {
        chain.points.reverse();
    }
    let last = chain.points.len() - 1;
    (chain.points[0], chain.points[last]) = (flat[0], flat[1]);
    if !chain.points.iter().flatten().all(|c| c.is_finite()) {
        return None;
    }
    let bounds = chain.bounds();
    Some(Drawn { form: Form::Chain(chain), range, flat, space, bounds })
}

#[cfg(test)]
mod tests {
    use super::project::Projection;
    use super::*;
    use hlr_brep::geometry::curve::Curve;
    use hlr_brep::geometry::nurbs::Nurbs;

    #[test]
    fn a_point_of_a_spline_is_no_piece_of_it() {
        let seen = Projection([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        let knots = [0.0; 4].into_iter().chain([1.0; 4]).collect();
        let poles = vec![[0.0, 0.0, 0.0, 1.0], [1.0, 4.0, 0.0, 1.0], [2.0, 4.0, 0.0, 1.0], [3.0, 0.0, 0.0, 1.0]];
        let curve = Curve::Spline(Nurbs { degree: 3, rational: false, sampled: false, knots, poles });
        let placed = Placed::new(curve, [0.0, 1.0], &seen, 1e-9);
        assert!(piece(&placed, [0.25, 0.75], 0.01).is_some());
        assert!([0.0, 0.5, 1.0].iter().all(|&t| piece(&placed, [t, t], 0.01).is_none()));
    }
}
