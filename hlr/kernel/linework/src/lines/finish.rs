//! Finishes the drawing: puts each line on its curve, moves the drawing's lower left corner to the origin, and sorts
//! the lines.

use rayon::prelude::*;

use super::Polyline;
use super::camera::Camera;
use super::candidates::About;
use super::cut::{Cut, Trait};
use super::drawing::{Curve, Kind, Line, Lines};
use crate::curves::arcs::Arc;
use crate::fit::Form;
use crate::fit::arc::grow;
use crate::fit::bezier::Chain;
use crate::fit::plane::{Vec2, dot, minus};
use crate::fit::route::Border;
use crate::fit::routes::{Curves, Fit, Guide, OnCurve, on_curves};
use hlr_brep::geometry::curve::Curve as Spatial;
use hlr_brep::geometry::nurbs::Nurbs;

/// A line before it is moved and sorted: its points, its curve, and its bounding box.
struct Made {
    line: Polyline,
    curve: Option<Curve>,
    bounds: [Vec2; 2],
}

/// The guide of a chain: its curve, if known, in its place, and whether a surface may end at it.
pub fn guide(about: &About, of: &Trait, curve: Option<u32>, place: u32, bulge: f64) -> Guide {
    // Whether a surface may end here in the image. The outline of a mesh counts as one of its edges.
    let border = match about.kind {
        Kind::SHARP | Kind::BOUNDARY => Border::Edge,
        Kind::OUTLINE if of.without_brep => Border::Edge,
        Kind::OUTLINE => Border::Outline,
        _ => Border::None,
    };
    Guide { curve, place, border, bulge, smoothed: of.noisy && of.without_brep }
}

/// The lines, sorted by part, kind, edge, face and second part, and the lower left corner they were moved from.
///
/// `about`, `guides`: per chain. `hidden`: whether hidden lines are drawn.
pub fn finish(
    mut cut: Cut,
    about: &[About],
    guides: &[Guide],
    curves: &Curves,
    camera: &Camera,
    fit: &Fit,
    hidden: bool,
) -> (Lines, Vec2) {
    // A smoothed contour was moved on paper; its points in space move with it.
    for line in cut.lines.iter_mut().filter(|line| guides[line.chain as usize].smoothed) {
        for (p, image) in line.space.iter_mut().zip(&line.flat) {
            *p = camera.moved(p, image);
        }
    }
    let own: Vec<Guide> = cut.lines.iter().map(|line| guides[line.chain as usize]).collect();
    // If no line has a curve, no line end moves to one.
    let plain = !curves.known && cut.smooth.iter().all(Option::is_none);
    let mut made: Vec<Made> = if plain {
        cut.lines.into_iter().map(|line| Made { bounds: around(&line), line, curve: None }).collect()
    } else {
        let found = on_curves(&cut.lines, &own, curves, camera, fit, &cut.meetings);
        let made = cut.lines.into_par_iter().zip(cut.smooth).zip(&own).zip(found);
        made.filter_map(|(((line, smooth), guide), found)| Some(bent(line, smooth, guide, found?, curves, camera, fit)))
            .collect()
    };
    made.retain(|m| m.line.visible || hidden);
    let mut low = [f64::INFINITY; 2];
    made.iter().for_each(|m| low = [0, 1].map(|k| low[k].min(m.bounds[0][k])));
    if made.is_empty() {
        low = [0.0; 2];
    }
    // The sort is stable: lines with equal keys keep their order.
    made.par_sort_by_key(|m| {
        let a = &about[m.line.chain as usize];
        (a.part, a.kind, a.edge, a.face, a.other)
    });
    (Lines(made.into_par_iter().map(|m| line(m, about, &low)).collect()), low)
}

fn around(line: &Polyline) -> [Vec2; 2] {
    let mut out = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    line.flat.iter().for_each(|p| grow(&mut out, p));
    out
}

/// A line with its true ends, on its curve or on that of a smoothed contour.
fn bent(
    mut line: Polyline,
    smooth: Option<Chain>,
    guide: &Guide,
    found: OnCurve,
    curves: &Curves,
    camera: &Camera,
    fit: &Fit,
) -> Made {
    let last = line.flat.len() - 1;
    (line.flat[0], line.flat[last]) = (found.flat[0], found.flat[1]);
    (line.space[0], line.space[last]) = (found.space[0], found.space[1]);
    let kept = |i: usize| i == 0 || i == last || found.inner.contains(&i);
    let mut numbers = 0..;
    line.flat.retain(|_| numbers.next().is_none_or(kept));
    let mut numbers = 0..;
    line.space.retain(|_| numbers.next().is_none_or(kept));
    let [mut first, second] = found.grown;
    first.reverse();
    let end = line.flat.len() - 1;
    line.flat.splice(end..end, second.iter().map(|p| p.0));
    line.space.splice(end..end, second.iter().map(|p| p.1));
    line.flat.splice(1..1, first.iter().map(|p| p.0));
    line.space.splice(1..1, first.iter().map(|p| p.1));
    let mut bounds = found.bounds;
    if found.form == Some(Form::Straight) {
        flatten(&mut line);
    }
    if guide.bulge > 0.0 && found.form.as_ref().is_some_and(|form| *form != Form::Straight) {
        rise(&mut line, guide, found.range, curves, camera, fit);
    }
    let mut curve = found.form.and_then(|form| match form {
        Form::Straight => None,
        Form::Arc(e, angles) => Some(Curve::Arc(Arc { centre: e.centre, axes: e.axes, angles })),
        Form::Chain(chain) => Some(Curve::Chain(chain)),
    });
    if let Some(mut chain) = smooth {
        chain.bounds().iter().for_each(|p| grow(&mut bounds, p));
        let last = chain.points.len() - 1;
        (chain.points[0], chain.points[last]) = (line.flat[0], line.flat[line.flat.len() - 1]);
        curve = Some(Curve::Chain(chain));
    }
    Made { line, curve, bounds }
}

/// Moves the points of a line that is straight on paper onto its chord. In space they stay where they are.
fn flatten(line: &mut Polyline) {
    let (first, last) = (line.flat[0], line.flat[line.flat.len() - 1]);
    let way = minus(&last, &first);
    let square = dot(&way, &way);
    if square == 0.0 {
        return;
    }
    let mut before = 0.0f64;
    for p in &mut line.flat {
        before = (dot(&minus(p, &first), &way) / square).clamp(before, 1.0);
        *p = [0, 1].map(|k| first[k] + way[k] * before);
    }
    let end = line.flat.len() - 1;
    line.flat[end] = last;
}

/// A curve rises above the chords on which it was found: its line gets points on the curve itself.
fn rise(line: &mut Polyline, guide: &Guide, range: [f64; 2], curves: &Curves, camera: &Camera, fit: &Fit) {
    let Some(curve) = guide.curve.and_then(|c| curves.curves[c as usize].as_ref()) else { return };
    let parameters = match curve {
        Spatial::Spline(spline) => knots(spline, range),
        _ => even(line, range, camera, fit),
    };
    let last = line.flat.len() - 1;
    let (ends, space_ends) = ([line.flat[0], line.flat[last]], [line.space[0], line.space[last]]);
    line.space = parameters.into_iter().map(|t| curve.derivatives(t)[0]).collect();
    line.flat = line.space.iter().map(|p| camera.point(p)).collect();
    line.flat.insert(0, ends[0]);
    line.flat.push(ends[1]);
    line.space.insert(0, space_ends[0]);
    line.space.push(space_ends[1]);
}

/// The knots of a spline between the ends of a range, which may go beyond the seam of a closed one.
fn knots(spline: &Nurbs, [begin, end]: [f64; 2]) -> Vec<f64> {
    let (low, high) = spline.domain();
    let turned = |turn: f64| spline.knots.iter().map(move |&t| (t + turn * (high - low), t));
    let mut inside: Vec<(f64, f64)> = [-1.0, 0.0, 1.0].into_iter().flat_map(turned).collect();
    inside.retain(|(t, _)| *t > begin.min(end) && *t < begin.max(end));
    inside.sort_by(|a, b| a.0.total_cmp(&b.0));
    inside.dedup_by_key(|(t, _)| *t);
    if begin > end {
        inside.reverse();
    }
    inside.into_iter().map(|(_, t)| t).collect()
}

/// Evenly spaced angles between the ends of a range.
fn even(line: &Polyline, [begin, end]: [f64; 2], camera: &Camera, fit: &Fit) -> Vec<f64> {
    let [low, high] = around(line);
    let reach = (high[0] - low[0]).max(high[1] - low[1]);
    // A circle rises r s^2 / 8 above the chord of a step s (radians). Perspective may double the length of a step.
    let step = (8.0 * fit.chord * fit.accuracy / reach).sqrt() * if camera.eye.is_some() { 0.5 } else { 1.0 };
    let inner = ((end - begin).abs() / step).ceil() as usize;
    (1..=inner).map(|k| begin + (end - begin) / (inner + 1) as f64 * k as f64).collect()
}

/// The finished line, with `low` as origin.
fn line(made: Made, about: &[About], low: &Vec2) -> Line {
    let Made { line, mut curve, .. } = made;
    let a = &about[line.chain as usize];
    let moved = |p: &mut Vec2| *p = [p[0] - low[0], p[1] - low[1]];
    match &mut curve {
        None => {}
        Some(Curve::Arc(arc)) => moved(&mut arc.centre),
        Some(Curve::Chain(chain)) => chain.points.iter_mut().for_each(moved),
    }
    let mut flat = line.flat;
    flat.iter_mut().for_each(moved);
    Line {
        kind: a.kind,
        visible: line.visible,
        part: a.part,
        edge: a.edge,
        face: a.face,
        other: a.other,
        flat,
        space: line.space,
        curve,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_knots_of_a_closed_spline_are_found_beyond_its_seam_and_backward() {
        let poles = vec![[0.0, 0.0, 0.0, 1.0]; 7];
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 3.0];
        let spline = Nurbs { degree: 3, rational: false, sampled: true, knots, poles };
        assert_eq!(super::knots(&spline, [0.5, 2.5]), [1.0, 2.0]);
        assert_eq!(super::knots(&spline, [2.5, 0.5]), [2.0, 1.0]);
        // From 2.5 over the seam at 3, which is 0, to 1.5: the seam, then 1.
        assert_eq!(super::knots(&spline, [2.5, 4.5]).len(), 2);
        assert_eq!(super::knots(&spline, [2.5, 4.5])[1], 1.0);
        assert!(super::knots(&spline, [1.0, 2.0]).is_empty());
    }

    #[test]
    fn points_of_a_line_that_is_straight_on_paper_lie_on_its_chord_in_order() {
        let flat = vec![[0.0, 0.0], [-0.01, 0.001], [3.0, 0.002], [2.99, 0.0], [4.0, 0.0]];
        let space = vec![[0.0; 3]; 5];
        let mut line = Polyline { visible: true, flat, space: space.clone(), ..Polyline::default() };
        flatten(&mut line);
        assert_eq!(line.flat, [[0.0, 0.0], [0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [4.0, 0.0]]);
        assert_eq!(line.space, space);
    }
}
