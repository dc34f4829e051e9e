//! Points of the parameter plane: orientation by exact signs, areas and distances in floating point.

use robust::{Coord, orient2d};

/// Positive where c is to the left of the line from a to b; the sign is exact.
pub fn side(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    let coord = |p: &[f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether a comes before b: from left to right, and upward on a vertical line.
pub fn precedes(a: &[f64; 2], b: &[f64; 2]) -> bool {
    a[0] < b[0] || (a[0] == b[0] && a[1] < b[1])
}

/// Twice the area of a triangle, rounded.
pub fn area(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Square of the distance from p to the segment a b.
pub fn distance2(p: &[f64; 2], a: &[f64; 2], b: &[f64; 2]) -> f64 {
    let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = d[0] * d[0] + d[1] * d[1];
    let t = if square > 0.0 { ((q[0] * d[0] + q[1] * d[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (q[0] - t * d[0], q[1] - t * d[1]);
    x * x + y * y
}
