use std::f64::consts::PI;

use super::*;
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::vector::{cross, dot, length, sub};

const HERE: [[f64; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
const DEFLECTION: f64 = 0.02;

/// The surface of a plane or a cylinder: origin, x, y and z; a radius only of a cylinder.
fn surface(origin: Vector, x: Vector, y: Vector, radius: Option<f64>) -> Surface {
    let numbers: Vec<f64> = [origin, x, y, cross(&x, &y)].into_iter().flatten().chain(radius).collect();
    Surface::read(if radius.is_some() { 2 } else { 1 }, &numbers).unwrap()
}

fn upright(radius: f64) -> Surface {
    surface([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Some(radius))
}

/// A cylinder along x.
fn lying(radius: f64) -> Surface {
    surface([0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], Some(radius))
}

/// A line to be found: its faces, and where the meshes cross.
struct Line {
    faces: [usize; 2],
    points: Vec<Vector>,
}

/// The points and curves of lines. Points that are alike are one; each segment has triangles of its own, with corners
/// near it.
fn found(surfaces: Vec<Option<Surface>>, lines: &[Line]) -> (Vec<Vec<Vector>>, Vec<Option<Found>>) {
    let (mut points, mut nodes) = (Vec::<Vector>::new(), Vec::new());
    for p in lines.iter().flat_map(|line| &line.points) {
        let known = points.iter().position(|q| q == p);
        nodes.push(known.unwrap_or(points.len()) as i32);
        points.extend(known.is_none().then_some(*p));
    }
    let (mut segments, mut pairs, mut offsets) = (Vec::new(), Vec::new(), vec![0]);
    let (mut vertices, mut triangles, mut corner) = (Vec::<Vector>::new(), Vec::new(), Vec::new());
    let (mut uv, mut face) = (Vec::<[f64; 2]>::new(), Vec::new());
    let mut first = 0;
    for line in lines {
        for k in 0..line.points.len() - 1 {
            segments.push([nodes[first + k], nodes[first + k + 1]]);
            pairs.push([0, 1].map(|side| {
                let number = line.faces[side];
                for (t, p) in [[0.0, 0.0], [0.3, 0.0], [0.0, 0.3]].into_iter().zip([k, k + 1, k]) {
                    let at = surfaces[number].as_ref().map_or([0.0; 2], |s| place_near(s, &line.points[p]));
                    uv.push([at[0] + t[0], at[1] + t[1]]);
                    vertices.push(surfaces[number].as_ref().map_or(line.points[p], |s| s.point(uv[uv.len() - 1])));
                }
                let n = vertices.len() as i32;
                triangles.push([n - 3, n - 2, n - 1]);
                corner.push([n - 3, n - 2, n - 1]);
                face.push(number as i32);
                face.len() as i32 - 1
            }));
        }
        first += line.points.len();
        offsets.push(segments.len() as i32);
    }
    let record = |i: usize| FaceRecord {
        surface: surfaces[i].is_some().then_some(i as u32),
        place: HERE,
        sign: 1.0,
        curved: true,
    };
    let sheets = Sheets {
        points: &vertices,
        triangles: &triangles,
        triangle_face: &face,
        corner: &corner,
        uv: &uv,
        faces: (0..surfaces.len()).map(record).collect(),
        surfaces: &surfaces,
        deflection: DEFLECTION,
    };
    let order: Vec<i32> = (0..segments.len() as i32).collect();
    let crossed = Crossed {
        points: &points,
        segments: &segments,
        triangles: &pairs,
        offsets: &offsets,
        order: &order,
        reversed: &vec![false; order.len()],
    };
    let (moved, curves) = curves(&sheets, &crossed, &|| false);
    let along = |i: usize| crossed.nodes(i).map(|node| moved[node]).collect();
    ((0..lines.len()).map(along).collect(), curves)
}

/// Parameters of the point of a plane or cylinder near another.
fn place_near(surface: &Surface, p: &Vector) -> [f64; 2] {
    hlr_brep::faces::near(surface, p, [0.1, 0.1]).unwrap_or([0.0; 2])
}

/// A point moved by a little that changes from one to the next.
fn roughly(k: usize, p: Vector) -> Vector {
    let off = |n: usize| DEFLECTION * 0.7 * ((k * (7 + 4 * n)) as f64).sin();
    [0, 1, 2].map(|i| p[i] + off(i))
}

#[test]
fn a_plane_cuts_a_cylinder_in_an_ellipse_that_runs_with_the_line() {
    let (sin, cos) = 0.4f64.sin_cos();
    let plate = || surface([0.0, 0.0, 1.0], [cos, 0.0, sin], [0.0, 1.0, 0.0], None);
    for sense in [1.0, -1.0] {
        let at = |k: usize| {
            let (y, x) = (sense * 0.25 * k as f64).sin_cos();
            roughly(k, [3.0 * x, 3.0 * y, 1.0 + 3.0 * x * sin / cos])
        };
        let line = Line { faces: [0, 1], points: (0..12).map(at).collect() };
        let (points, curves) = found(vec![Some(plate()), Some(upright(3.0))], &[line]);
        let Some(Found { curve: Curve::Ellipse { p, a, b }, rise, .. }) = &curves[0] else { panic!() };
        assert!(
            length(&sub(p, &[0.0, 0.0, 1.0])) < 1e-12 && (dot(a, a).max(dot(b, b)) - 9.0 / (cos * cos)).abs() < 1e-9
        );
        assert!(dot(&cross(a, b), &[0.0, 0.0, sense]) > 0.0);
        assert!(points[0].iter().all(|q| (q[0].hypot(q[1]) - 3.0).abs() < 1e-12));
        // A chord of a quarter radian on a circle of radius 3.
        assert!((0.02..0.04).contains(rise), "{rise}");
    }
}

#[test]
fn cylinders_that_cross_have_a_dense_spline_through_points_of_both() {
    // The line in which a cylinder of radius 2 goes into one of radius 3, whole.
    let at = |k: usize| {
        let (y, z) = (2.0 * PI * (k % 8) as f64 / 8.0).sin_cos();
        roughly(k % 8, [(9.0 - 4.0 * y * y).sqrt(), 2.0 * y, 2.0 * z])
    };
    let line = Line { faces: [0, 1], points: (0..=8).map(at).collect() };
    let (points, curves) = found(vec![Some(upright(3.0)), Some(lying(2.0))], &[line]);
    let Some(Found { curve: Curve::Spline(spline), .. }) = &curves[0] else { panic!() };
    let off = |q: &Vector| (q[0].hypot(q[1]) - 3.0).abs().max((q[1].hypot(q[2]) - 2.0).abs());
    assert!(points[0].iter().all(|q| off(q) < 1e-12) && points[0][0] == points[0][8]);
    let (low, high) = spline.domain();
    let worst = (0..=999).map(|i| off(&spline.point(low + (high - low) * f64::from(i) / 999.0))).fold(0.0, f64::max);
    assert!(worst < 1.5 * hlr_accuracy::INTERSECTION_FIT * DEFLECTION, "{worst}");
}

#[test]
fn three_faces_have_a_corner_that_both_lines_share() {
    let (floor, wall) = (
        surface([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], None),
        surface([0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], None),
    );
    let corner = [8f64.sqrt(), 1.0, 0.0];
    let rough = roughly(5, corner);
    let arc = |k: usize| {
        let (y, x) = (1.0f64.atan2(corner[0]) + 0.2 * k as f64).sin_cos();
        if k == 0 { rough } else { roughly(k, [3.0 * x, 3.0 * y, 0.0]) }
    };
    let up = |k: usize| if k == 0 { rough } else { [corner[0], 1.0, 0.5 * k as f64] };
    let lines = [
        Line { faces: [0, 2], points: (0..6).map(arc).collect() },
        Line { faces: [1, 2], points: (0..4).map(up).collect() },
    ];
    let (points, curves) = found(vec![Some(floor), Some(wall), Some(upright(3.0))], &lines);
    assert!(curves.iter().all(Option::is_some) && points[0][0] == points[1][0]);
    assert!(length(&sub(&points[0][0], &corner)) < 1e-12);
}

#[test]
fn there_is_no_curve_between_planes_or_without_surfaces_or_where_faces_touch() {
    let plane = |z: f64| surface([0.0, 0.0, z], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], None);
    let wall = || surface([0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], None);
    let straight: Vec<Vector> = (0..5).map(|k| [f64::from(k), 0.0, 0.0]).collect();
    let of = |surfaces: Vec<Option<Surface>>| {
        let (points, curves) = found(surfaces, &[Line { faces: [0, 1], points: straight.clone() }]);
        assert_eq!(points[0], straight);
        curves[0].is_none()
    };
    assert!(of(vec![Some(plane(0.0)), Some(wall())]));
    assert!(of(vec![Some(lying(2.0)), None]));
    // The plane touches the cylinder along this line, or passes a little below it, at 2.6 degrees.
    let lowered = |z: f64| surface([0.0, 0.0, z], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], Some(2.0));
    assert!(of(vec![Some(lowered(-2.0)), Some(plane(0.0))]));
    assert!(!of_near(lowered(-1.998), plane(0.0)));
}

/// Whether a line along x has no curve.
fn of_near(cylinder: Surface, plane: Surface) -> bool {
    let points = (0..5).map(|k| [f64::from(k), 0.09, 0.0]).collect();
    found(vec![Some(cylinder), Some(plane)], &[Line { faces: [0, 1], points }]).1[0].is_none()
}

#[test]
fn a_line_farther_away_than_chord_errors_explain_has_no_curve() {
    let plate = || surface([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], None);
    let without = |off: f64| {
        let at = |k: u32| {
            let (y, x) = (0.3 * f64::from(k)).sin_cos();
            [(3.0 + off) * x, (3.0 + off) * y, 0.0]
        };
        let points = (0..5).map(at).collect();
        found(vec![Some(plate()), Some(upright(3.0))], &[Line { faces: [0, 1], points }]).1[0].is_none()
    };
    assert!(!without(2.0 * DEFLECTION) && without(6.0 * DEFLECTION));
}

#[test]
fn a_point_that_steps_back_is_left_out() {
    let plate = surface([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], None);
    let at = |t: f64| [3.0 * t.cos(), 3.0 * t.sin(), 0.0];
    let points = [0.0, 0.3, 0.299, 0.6, 0.9].map(at).to_vec();
    let (points, curves) = found(vec![Some(plate), Some(upright(3.0))], &[Line { faces: [0, 1], points }]);
    assert!(curves[0].is_some() && points[0][1] == points[0][2]);
    let angles: Vec<f64> = points[0].iter().map(|p| p[1].atan2(p[0])).collect();
    assert!(angles.windows(2).all(|w| w[0] <= w[1]));
}

#[test]
fn where_cylinders_of_one_radius_touch_each_line_goes_straight_on() {
    // One of the two ellipses, y = z, through the points (+-3, 0, 0) where both surfaces touch.
    let at = |k: usize| {
        let (y, x) = (2.0 * PI * (k % 24) as f64 / 24.0).sin_cos();
        [3.0 * x, 3.0 * y, 3.0 * y]
    };
    let line = Line { faces: [0, 1], points: (0..=24).map(|k| at(k + 3)).collect() };
    let across = surface([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], Some(3.0));
    let (points, curves) = found(vec![Some(upright(3.0)), Some(across)], &[line]);
    assert!(curves[0].is_some());
    assert!(points[0].iter().all(|p| (p[1] - p[2]).abs() < DEFLECTION && (p[0].hypot(p[1]) - 3.0).abs() < DEFLECTION));
    // Where they touch no point is told, but the line passes there.
    assert!(length(&sub(&points[0][9], &[-3.0, 0.0, 0.0])) < DEFLECTION);
}
