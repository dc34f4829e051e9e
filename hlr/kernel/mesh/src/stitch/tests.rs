use super::*;

const REACH: f64 = 0.01;

fn faces(points: &[Vec3], triangles: &[[i32; 3]]) -> (usize, usize) {
    let found = stitch(points, triangles, REACH);
    (found.triangles.len(), borders(&found.triangles, points.len()).len())
}

/// A square of two triangles in the plane z, from x to x + 1.
fn square(x: f64, z: f64, points: &mut Vec<Vec3>) -> Vec<[i32; 3]> {
    let n = points.len() as i32;
    points.extend([[x, 0.0, z], [x + 1.0, 0.0, z], [x + 1.0, 1.0, z], [x, 1.0, z]]);
    vec![[n, n + 1, n + 2], [n, n + 2, n + 3]]
}

#[test]
fn two_squares_side_by_side_become_one_sheet() {
    for gap in [0.0, 0.004, -0.004] {
        let mut points = Vec::new();
        let all = [square(0.0, 0.0, &mut points), square(1.0 + gap, gap, &mut points)].concat();
        assert_eq!(faces(&points, &all), (4, 6));
    }
}

#[test]
fn beyond_the_reach_they_stay_two() {
    let mut points = Vec::new();
    let all = [square(0.0, 0.0, &mut points), square(1.02, 0.0, &mut points)].concat();
    assert_eq!(stitch(&points, &all, REACH), Stitched { triangles: all, origin: vec![0, 1, 2, 3], seams: 0 });
}

#[test]
fn corners_that_merely_touch_stay_two() {
    let mut points = Vec::new();
    let mut all = square(0.0, 0.0, &mut points);
    points.extend([[1.001, 1.001, 0.0], [2.0, 1.5, 0.0], [1.5, 2.0, 0.0]]);
    all.push([4, 5, 6]);
    let found = stitch(&points, &all, REACH);
    assert_eq!((found.seams, found.triangles), (0, all));
}

#[test]
fn a_border_that_crosses_another_is_not_joined_to_it() {
    let mut points = Vec::new();
    let mut all = square(0.0, 0.0, &mut points);
    points.extend([[1.001, 0.5, -0.5], [1.001, 0.5, 0.5], [2.0, 0.5, 0.0]]);
    all.push([4, 5, 6]);
    assert_eq!(stitch(&points, &all, REACH).seams, 0);
}

#[test]
fn corners_on_the_other_side_are_put_into_it() {
    // To the right of the square's side x = 1 three triangles, whose corners lie on it nearly.
    let mut points = Vec::new();
    let mut all = square(0.0, 0.0, &mut points);
    points.extend([[1.002, 0.001, 0.0], [0.999, 0.3, 0.0], [1.001, 0.6, 0.002], [1.0, 0.998, 0.0], [2.0, 0.5, 0.0]]);
    all.extend([[4, 8, 5], [5, 8, 6], [6, 8, 7]]);
    let found = stitch(&points, &all, REACH);
    assert_eq!(found.seams, 3);
    assert_eq!(found.triangles.len(), 7);
    assert_eq!(borders(&found.triangles, points.len()).len(), 5);
    assert_eq!(found.origin, [0, 0, 0, 1, 2, 3, 4]);
    // Both corners at an end have become one.
    let used: std::collections::HashSet<i32> = found.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), 4 + 2 + 1);
}

#[test]
fn a_needle_is_not_joined_to_itself() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.001, 0.0]];
    assert_eq!(stitch(&points, &[[0, 1, 2]], REACH).seams, 0);
}

#[test]
fn no_triangle_falls_flat_where_sides_are_shorter_than_the_reach() {
    // A fan of triangles whose rim goes round within the reach.
    let mut points = vec![[0.0, 0.0, 1.0]];
    let n = 24;
    for k in 0..n {
        let angle = f64::from(k) * std::f64::consts::TAU / f64::from(n);
        points.push([0.004 * angle.cos(), 0.004 * angle.sin(), 0.0]);
    }
    let all: Vec<[i32; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    let found = stitch(&points, &all, REACH);
    assert!(found.triangles.iter().all(|[a, b, c]| a != b && b != c && c != a));
}

#[test]
fn the_numbers_of_corners_do_not_matter() {
    let mut points = Vec::new();
    let all = [square(0.0, 0.0, &mut points), square(1.003, 0.0, &mut points)].concat();
    let n = points.len() as i32;
    let back: Vec<Vec3> = points.iter().rev().copied().collect();
    let other: Vec<[i32; 3]> = all.iter().map(|t| t.map(|v| n - 1 - v)).collect();
    let (one, two) = (stitch(&points, &all, REACH), stitch(&back, &other, REACH));
    let places =
        |s: &Stitched, p: &[Vec3]| -> Vec<[Vec3; 3]> { s.triangles.iter().map(|t| t.map(|v| p[v as usize])).collect() };
    assert_eq!(places(&one, &points), places(&two, &back));
}
