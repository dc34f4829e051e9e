//! Finds surfaces that are planes although the file stores them as another kind.

use super::curve::{Curve, SPLINE, Vec3};
use super::vector::{along, cross, dot, from_line, length, sub, unit};

const PLANE: u8 = 1;
const REVOLUTION: u8 = 6;
const EXTRUSION: u8 = 7;
const SPLINES: u8 = 8;
const OFFSET: u8 = 9;
/// Cosines between directions below this are rounding.
const UPRIGHT: f64 = 1e-9;

/// Whether the surface of a record departs from a plane by no more than the tolerance.
pub fn is_flat(kind: u8, data: &[f64], tolerance: f64) -> bool {
    let three = |i: usize| -> Vec3 { [data[i], data[i + 1], data[i + 2]] };
    match kind {
        PLANE => true,
        REVOLUTION if data.len() > 7 => {
            let axis = three(3);
            match Curve::from_record(data[6] as u8, &data[7..]) {
                Some(Curve::Line { a, .. }) => dot(&a, &axis).abs() <= UPRIGHT,
                Some(Curve::Ellipse { a, b, .. }) => dot(&a, &axis).abs().max(dot(&b, &axis).abs()) <= tolerance,
                Some(Curve::Spline(n)) => {
                    let heights = n.poles.iter().map(|&[x, y, z, w]| dot(&[x / w, y / w, z / w], &axis));
                    spread(heights) <= tolerance
                }
                _ => false,
            }
        }
        EXTRUSION if data.len() > 4 && data[3] as u8 == SPLINE => {
            let way = three(0);
            let Some(Curve::Spline(n)) = Curve::from_record(SPLINE, &data[4..]) else { return false };
            let flattened: Vec<Vec3> = n
                .poles
                .iter()
                .map(|&[x, y, z, w]| [x / w, y / w, z / w])
                .map(|p| along(&p, &way, -dot(&p, &way)))
                .collect();
            let [first, far] = widest(&flattened);
            flattened.iter().all(|p| from_line(p, &first, &far) <= tolerance)
        }
        EXTRUSION if data.len() > 4 => {
            matches!(Curve::from_record(data[3] as u8, &data[4..]), Some(Curve::Line { .. }))
        }
        SPLINES if data.len() > 6 => {
            let count = (data[2] * data[3]) as usize;
            let Some(begin) = count.checked_mul(4).and_then(|n| data.len().checked_sub(n)) else { return false };
            let poles: Vec<Vec3> = data[begin..].as_chunks::<4>().0.iter().map(|p| [p[0], p[1], p[2]]).collect();
            let [first, far] = widest(&poles);
            let by = |a: &&Vec3, b: &&Vec3| from_line(a, &first, &far).total_cmp(&from_line(b, &first, &far));
            let Some(side) = poles.iter().max_by(by) else { return false };
            let Some(normal) = unit(&cross(&sub(&far, &first), &sub(side, &first))) else { return true };
            // The plane may lie halfway between the outermost poles.
            spread(poles.iter().map(|p| dot(&sub(p, &first), &normal))) <= 2.0 * tolerance
        }
        OFFSET if data.len() > 2 => is_flat(data[1] as u8, &data[2..], tolerance),
        _ => false,
    }
}

fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    high - low
}

/// The first point and the one farthest from it.
fn widest(points: &[Vec3]) -> [Vec3; 2] {
    let first = points.first().copied().unwrap_or_default();
    let by = |a: &&Vec3, b: &&Vec3| length(&sub(a, &first)).total_cmp(&length(&sub(b, &first)));
    [first, points.iter().max_by(by).copied().unwrap_or_default()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_is_flat_up_to_its_bulge() {
        let patch = |bulge: f64| {
            let mut data = vec![1.0, 1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
            data.extend([0.0, 0.0, 1.0, 1.0, 2.0, 0.0, 1.0, 1.0, 0.0, 2.0, 1.0, 1.0, 2.0, 2.0, 1.0 + bulge, 1.0]);
            data
        };
        assert!(is_flat(SPLINES, &patch(0.0), 1e-9) && is_flat(SPLINES, &patch(1e-4), 1e-3));
        assert!(!is_flat(SPLINES, &patch(0.1), 1e-3));
    }

    #[test]
    fn a_line_turned_about_an_axis_is_a_disc_or_a_cone() {
        let turned = |rise: f64| {
            [&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0][..], &[1.0, 0.0, 2.0, 1.0, 0.0, rise, 0.0, 0.0, 0.0]].concat()
        };
        assert!(is_flat(REVOLUTION, &turned(0.0), 1e-6) && !is_flat(REVOLUTION, &turned(0.5), 1e-6));
    }
}
