//! Vectors of the plane, and the distance to a segment.

pub type Vec2 = [f64; 2];

pub fn minus(a: &Vec2, b: &Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn dot(a: &Vec2, b: &Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn length(v: &Vec2) -> f64 {
    dot(v, v).sqrt()
}

/// Distance of a point to a segment, and where on it: 0 at a, 1 at b.
pub fn to_segment(p: &Vec2, a: &Vec2, b: &Vec2) -> (f64, f64) {
    let (d, way) = (minus(p, a), minus(b, a));
    let size = dot(&way, &way);
    let s = if size > 0.0 { (dot(&d, &way) / size).clamp(0.0, 1.0) } else { 0.0 };
    (length(&minus(&d, &way.map(|c| c * s))), s)
}
