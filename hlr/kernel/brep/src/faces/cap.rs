//! Caps: faces around a pole whose only border runs once around the axis.
//!
//! In (u, v) such a border is open: it ends a period beside its start. Modellers close it by a seam and an edge without
//! length at the pole. STEP has no such edges, and OpenCASCADE adds them to spheres, but not to other surfaces of
//! revolution. So they are added here: the seam is the meridian from the border's point nearest to the pole.
//!
//! ```text
//!     o-----------------o     the pole
//!     |                 |     the seam, twice
//!     |     __      ____o
//!     o____/  \____/          the border, from any u to u + period
//! ```

use super::node::Node;
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, along, dot, length, sub, unit};
use crate::mesh::LoopPoint;
use hlr_accuracy::MESH_BORDER;

/// Places at which a meridian is looked at on its way to the axis.
const STEPS: u32 = 256;
/// Halvings between two of them.
const HALVINGS: u32 = 60;
/// Of the distance from which the meridian comes: what is nearer to the axis lies on it.
const ON_AXIS: f64 = 1e-7;
/// Halvings of the seam.
const DEEPEST: u32 = 16;

/// Closes a loop that runs once around the axis of a surface of revolution, where the face has a pole on its inner side.
///
/// `turn`: the period of u, negative where the loop runs toward smaller u. `nodes`: of the face; those of the seam follow.
pub fn close(
    surface: &Surface,
    turn: f64,
    points: &mut Vec<LoopPoint>,
    chords: &mut Vec<Option<(u32, u32)>>,
    nodes: &mut Vec<Node>,
    [tolerance, deflection]: [f64; 2],
) {
    let Surface::Revolution(origin, axis, meridian) = surface else { return };
    // The inside is to the left in (u, v).
    let up = turn > 0.0;
    let height = |p: &LoopPoint| if up { p.uv[1] } else { -p.uv[1] };
    let Some(start) = (0..points.len()).max_by(|&i, &j| height(&points[i]).total_cmp(&height(&points[j]))) else {
        return;
    };
    let from = points[start].uv[1];
    let Some(pole) = pole(meridian, origin, axis, from, up, tolerance) else { return };
    points[..start].iter_mut().for_each(|p| p.uv[0] += turn);
    points.rotate_left(start);
    chords.rotate_left(start);
    let first = points[0];
    let u = first.uv[0];
    let mut added = |v: f64| {
        nodes.push(Node::Inside(nodes.len() as u32));
        LoopPoint { uv: [u, v], point: surface.point([u, v]), node: nodes.len() as u32 - 1 }
    };
    let seam = places(|v| surface.point([u, v]), [from, pole], MESH_BORDER * deflection);
    let near: Vec<LoopPoint> = seam.into_iter().chain([pole]).map(&mut added).collect();
    let far = |p: &LoopPoint| LoopPoint { uv: [p.uv[0] + turn, p.uv[1]], ..*p };
    points.push(far(&first));
    points.extend(near.iter().map(far));
    points.extend(near.iter().rev());
    chords.resize(points.len(), None);
}

/// Where a meridian meets the axis first, on its way from a place up or down.
fn pole(meridian: &Curve, origin: &Vector, axis: &Vector, from: f64, up: bool, tolerance: f64) -> Option<f64> {
    let axis = unit(axis)?;
    let off = |t: f64| {
        let arm = sub(&meridian.point(t), origin);
        along(&arm, &axis, -dot(&arm, &axis))
    };
    let side = unit(&off(from))?;
    let across = |t: f64| dot(&off(t), &side);
    let near = |t: f64| length(&off(t)) <= tolerance.max(ON_AXIS * across(from));
    let period = meridian.period();
    let [low, high] = meridian.domain(0.0);
    let end = match (period > 0.0, up) {
        (true, true) => from + period,
        (true, false) => from - period,
        (false, true) => high,
        (false, false) => low,
    };
    let mut before = from;
    for k in 1..=STEPS {
        let here = from + (end - from) * f64::from(k) / f64::from(STEPS);
        if across(here) <= 0.0 {
            let (mut out, mut on) = (before, here);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (out + on);
                if across(middle) > 0.0 { out = middle } else { on = middle }
            }
            return near(on).then_some(on);
        }
        before = here;
    }
    (end != from && near(end)).then_some(end)
}

/// Places between two others on a curve, so that its chords are no farther off it than `most`.
fn places(curve: impl Fn(f64) -> Vector, [from, to]: [f64; 2], most: f64) -> Vec<f64> {
    fn divide(curve: &impl Fn(f64) -> Vector, [from, to]: [f64; 2], most: f64, left: u32, out: &mut Vec<f64>) {
        let (a, b, middle) = (curve(from), curve(to), 0.5 * (from + to));
        let off = |share: f64| {
            let p = curve(from + share * (to - from));
            crate::edges::from_chord(&p, &a, &b)
        };
        if left == 0 || [0.25, 0.5, 0.75].iter().all(|share| off(*share) <= most) {
            return;
        }
        divide(curve, [from, middle], most, left - 1, out);
        out.push(middle);
        divide(curve, [middle, to], most, left - 1, out);
    }
    let mut out = Vec::new();
    divide(&curve, [from, to], most, DEEPEST, &mut out);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXIS: [Vector; 2] = [[0.0; 3], [0.0, 0.0, 1.0]];

    /// Half axes 20 and 10, t = 0 on the x axis.
    fn ellipse() -> Curve {
        Curve::Ellipse { p: [0.0; 3], a: [20.0, 0.0, 0.0], b: [0.0, 0.0, 10.0] }
    }

    fn found(meridian: &Curve, from: f64, up: bool) -> Option<f64> {
        pole(meridian, &AXIS[0], &AXIS[1], from, up, 1e-7)
    }

    #[test]
    fn a_meridian_is_followed_to_the_axis_on_either_side() {
        let quarter = std::f64::consts::FRAC_PI_2;
        assert!((found(&ellipse(), 0.3, true).unwrap() - quarter).abs() < 1e-12);
        assert!((found(&ellipse(), 0.3, false).unwrap() + quarter).abs() < 1e-12);
    }

    #[test]
    fn a_meridian_that_stays_off_the_axis_has_no_pole() {
        let ring = Curve::Ellipse { p: [30.0, 0.0, 0.0], a: [20.0, 0.0, 0.0], b: [0.0, 0.0, 10.0] };
        assert_eq!(found(&ring, 0.3, true), None);
        let past = Curve::Ellipse { p: [0.0, 1.0, 0.0], a: [20.0, 0.0, 0.0], b: [0.0, 0.0, 10.0] };
        assert_eq!(found(&past, 0.3, true), None);
    }

    #[test]
    fn a_cap_of_an_ellipsoid_is_closed_by_its_seam_and_its_pole() {
        let surface = Surface::Revolution(AXIS[0], AXIS[1], Box::new(ellipse()));
        for up in [true, false] {
            let turn = if up { std::f64::consts::TAU } else { -std::f64::consts::TAU };
            let at = |k: u32| [turn * f64::from(k) / 60.0, 0.3 + if k == 7 { 0.1 } else { 0.0 } * turn.signum()];
            let mut points: Vec<LoopPoint> =
                (0..60).map(|k| LoopPoint { uv: at(k), point: surface.point(at(k)), node: k }).collect();
            let mut chords: Vec<_> = (0..60).map(|k| Some((0, k))).collect();
            let mut nodes: Vec<Node> = (0..60).map(|k| Node::Edge(0, 0, k)).collect();
            close(&surface, turn, &mut points, &mut chords, &mut nodes, [1e-7, 0.01]);
            let seam = nodes.len() - 60;
            assert_eq!((points.len(), chords.len()), (60 + 1 + 2 * seam, points.len()));
            assert!((5..200).contains(&seam), "{seam}");
            assert_eq!((points[0].node, points[60].node), (7, 7), "the seam begins nearest to the pole");
            assert_eq!(chords.iter().flatten().count(), 60);
            let area: f64 = (0..points.len())
                .map(|i| (points[i].uv, points[(i + 1) % points.len()].uv))
                .map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0]))
                .sum();
            assert!(area > 0.0, "the inside is to the left");
            assert!(points.iter().all(|p| length(&sub(&surface.point(p.uv), &p.point)) < 1e-9));
        }
    }
}
