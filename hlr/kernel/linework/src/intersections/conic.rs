//! Circles and ellipses among intersection lines.

use super::face::Face;
use hlr_accuracy::INTERSECTION_MET;
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, along, cross, dot, length, scaled, sub};
use hlr_exact::elementary::hypot;

/// Of the radius: files round their numbers.
const ROUNDING: f64 = 5e-7;
/// A circle so much larger than the figure of its points cannot be told from a straight line.
const LARGE: f64 = 1e3;
/// Sine of the angle to a cylinder's axis below which a plane cuts it along rulings.
const ALONG_AXIS: f64 = 1e-3;

/// The ellipse or circle that all points lie on, within a share of the deflection, in the order of the points; None
/// where there is none.
pub fn conic(faces: [&Face; 2], points: &[Vector], deflection: f64) -> Option<Curve> {
    let [a, b] = faces;
    let found = plane_and_cylinder(a, b).or_else(|| plane_and_cylinder(b, a)).or_else(|| circle(points))?;
    let Curve::Ellipse { p: centre, a: major, b: minor } = &found else { return None };
    let near = INTERSECTION_MET * deflection + ROUNDING * length(major).max(length(minor));
    let up = cross(major, minor);
    let square = dot(&up, &up);
    let on = |p: &Vector| {
        let arm = sub(p, centre);
        let (x, y) = (dot(&cross(&arm, minor), &up) / square, dot(&cross(major, &arm), &up) / square);
        let (off, reach) = (dot(&arm, &up).abs() / square.sqrt(), hypot(x, y));
        // Along the arm: at least as far as the nearest point of the ellipse.
        off <= near && (reach - 1.0).abs() / reach * length(&arm) <= near
    };
    if !points.iter().all(on) {
        return None;
    }
    let way = cross(&sub(&points[0], centre), &sub(&points[1], centre));
    let minor = if dot(&way, &up) < 0.0 { scaled(minor, -1.0) } else { *minor };
    Some(Curve::Ellipse { p: *centre, a: *major, b: minor })
}

/// The ellipse in which a plane cuts a cylinder.
fn plane_and_cylinder(plane: &Face, cylinder: &Face) -> Option<Curve> {
    let (Surface::Plane(plate), Surface::Cylinder(bore, radius)) = (plane.surface, cylinder.surface) else {
        return None;
    };
    let [origin, x, y, _] = plate.vectors();
    let (on, normal) = (plane.moved(&origin), cross(&plane.turned(&x), &plane.turned(&y)));
    let [centre, x, y, z] = bore.vectors();
    let (centre, [x, y, z]) = (cylinder.moved(&centre), [x, y, z].map(|way| cylinder.turned(&way)));
    let lean = dot(&normal, &z);
    if lean.abs() < ALONG_AXIS * length(&normal) * length(&z) {
        return None;
    }
    // What lies over a point of the cylinder's base, on the plane.
    let lifted = |way: &Vector| along(way, &z, -dot(&normal, way) / lean);
    let centre = along(&centre, &z, dot(&normal, &sub(&on, &centre)) / lean);
    Some(Curve::Ellipse { p: centre, a: lifted(&scaled(&x, *radius)), b: lifted(&scaled(&y, *radius)) })
}

/// The circle through three of the points.
fn circle(points: &[Vector]) -> Option<Curve> {
    let last = points.len() - 1;
    let [i, j, k] = if points[0] == points[last] { [0, last / 3, 2 * last / 3] } else { [0, last / 2, last] };
    let (a, b) = (sub(&points[j], &points[i]), sub(&points[k], &points[i]));
    let up = cross(&a, &b);
    let square = dot(&up, &up);
    let size = length(&a).max(length(&b));
    if last < 3 || square == 0.0 {
        return None;
    }
    // The centre of a triangle's circumscribed circle.
    let to = sub(&scaled(&cross(&b, &up), dot(&a, &a)), &scaled(&cross(&a, &up), dot(&b, &b)));
    let to = scaled(&to, 0.5 / square);
    let (centre, arm) = (along(&points[i], &to, 1.0), scaled(&to, -1.0));
    let axis = scaled(&up, 1.0 / square.sqrt());
    (length(&arm) <= LARGE * size).then(|| Curve::Ellipse { p: centre, a: arm, b: cross(&axis, &arm) })
}
