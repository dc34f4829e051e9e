//! Edges that are easy to classify: the angle between their faces is constant, or far from every limit.

use super::side::{Fixed, NEARLY_TANGENT, Side, TANGENT, angle, ascending, crossed, divided, spans};
use crate::format::{determinant, turned};
use crate::geometry::curve::Curve;
use crate::geometry::vector::{Vector, cross, length, scaled, sub};

/// Radians over the whole of an edge: normals whose rotations differ by less count as turning together.
const TOGETHER: f64 = 1e-9;
/// Share of the edge: the faces are also compared this close to its ends.
const END: f64 = 1e-6;
/// Factor on the largest difference between neighbouring places: how much the angle may change between them.
const FARTHER: f64 = 2.0;

/// Whether the faces meet at the same angle all along the edge: both normals are constant, or turn alike, or one turns
/// about the other. This covers rulings, seams, rims, and chains of fillets of planes, cylinders, cones and tori.
pub fn is_even(sides: &[Fixed; 2]) -> bool {
    let [Some(one), Some(other)] = sides.each_ref().map(|s| turning(s.side)) else { return false };
    let stays = [&one, &other].map(|axis| length(axis) <= TOGETHER);
    let about = |axis: &Vector, fixed: &Fixed| fixed.at(0.5).is_some_and(|n| length(&cross(axis, &n)) <= TOGETHER);
    match stays {
        [true, true] => true,
        [true, false] => about(&other, &sides[0]),
        [false, true] => about(&one, &sides[1]),
        [false, false] => length(&sub(&one, &other)) <= TOGETHER,
    }
}

/// The rotation of a side's normal from end to end: a vector along the axis, its length the angle in radians.
fn turning(side: &Side) -> Option<Vector> {
    let (from, step) = match side.curve {
        None => ([0.0; 2], [0.0; 2]),
        Some((Curve::Line { p, a }, [first, last])) => {
            ([0, 1].map(|k| p[k] + first * a[k]), [0, 1].map(|k| (last - first) * a[k]))
        }
        Some(_) => return None,
    };
    let axis = side.surface.turning(from, step)?;
    // A mirror image reverses the sense of rotation.
    Some(side.place.map_or(axis, |place| scaled(&turned(place, &axis), determinant(place).signum())))
}

/// Whether the faces are tangent, judged at the middles of `parts` equal parts of the edge; None where that leaves a
/// doubt. Between every two knots there is a place.
pub fn clear_case(sides: &[Fixed; 2], parts: usize) -> Option<bool> {
    let spans = spans(sides);
    let mut breaks = divided(&spans, parts.div_ceil(spans.len() - 1));
    breaks.extend(crossed(sides, &breaks));
    ascending(&mut breaks);
    let places = breaks.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let (mut least, mut most, mut farther, mut before) = (f64::INFINITY, 0.0f64, 0.0f64, None);
    for share in [END].into_iter().chain(places).chain([1.0 - END]) {
        let angle = angle(sides, share)?;
        (least, most) = (least.min(angle), most.max(angle));
        farther = before.map_or(0.0, |before: f64| farther.max(FARTHER * (angle - before).abs()));
        before = Some(angle);
        if least <= NEARLY_TANGENT && most + farther > TANGENT {
            return None;
        }
    }
    if most + farther <= TANGENT {
        return Some(true);
    }
    (least - farther > NEARLY_TANGENT).then_some(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Matrix;
    use crate::geometry::surface::Surface;

    const FRAME: [f64; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

    fn surface(kind: u8, more: &[f64]) -> Surface {
        Surface::read(kind, &[&FRAME, more].concat()).unwrap()
    }

    fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
        Curve::Line { p: [from[0], from[1], 0.0], a: [to[0] - from[0], to[1] - from[1], 0.0] }
    }

    fn side<'a>(surface: &'a Surface, curve: &'a Curve, place: Option<&'a Matrix>) -> Side<'a> {
        Side { surface, curve: Some((curve, [0.0, 1.0])), place, reversed: false, free: false }
    }

    fn even(one: &Side, other: &Side) -> bool {
        is_even(&[Fixed::new(one), Fixed::new(other)])
    }

    #[test]
    fn normals_that_turn_alike_stay_together() {
        let (cylinder, torus, plane) = (surface(2, &[2.0]), surface(5, &[2.0, 0.5]), surface(1, &[]));
        let rim = line([0.2, 1.0], [1.4, 1.0]);
        let one = side(&cylinder, &rim, None);
        // A fillet about the same axis; one that runs the other way; the plane across; a ruling; a helix.
        let back = line([-0.2, 1.0], [-1.4, 1.0]);
        let (ruling, helix) = (line([0.2, 0.0], [0.2, 3.0]), line([0.2, 0.0], [1.4, 3.0]));
        assert!(even(&one, &side(&torus, &rim, None)));
        assert!(!even(&one, &side(&torus, &back, None)));
        assert!(even(&one, &side(&plane, &rim, None)) && even(&side(&plane, &rim, None), &one));
        assert!(even(&side(&cylinder, &ruling, None), &side(&plane, &rim, None)));
        assert!(even(&one, &side(&cylinder, &helix, None)));
        assert!(!even(&one, &side(&cylinder, &ruling, None)));
        // About a tilted axis, about a parallel axis, and mirrored, where the same direction of u turns the other way.
        let tilted = [[1.0, 0.0, 0.0, 0.0], [0.0, 0.8, -0.6, 0.0], [0.0, 0.6, 0.8, 0.0]];
        let beside = [[1.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let mirror = [[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        assert!(!even(&one, &side(&torus, &rim, Some(&tilted))));
        assert!(!even(&one, &side(&plane, &rim, Some(&tilted))));
        assert!(even(&one, &side(&torus, &rim, Some(&beside))));
        assert!(!even(&one, &side(&torus, &rim, Some(&mirror))));
        assert!(even(&one, &side(&torus, &back, Some(&mirror))));
    }
}
