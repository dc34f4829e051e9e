//! Three-dimensional vectors as plain arrays.

pub type Vector = [f64; 3];

pub fn add(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline]
pub fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn scaled(a: &Vector, s: f64) -> Vector {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// a + b s.
pub fn along(a: &Vector, b: &Vector, s: f64) -> Vector {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}

#[inline]
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: &Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The vector scaled to length 1; None for the zero vector.
pub fn unit(a: &Vector) -> Option<Vector> {
    let size = length(a);
    (size > 0.0 && size.is_finite()).then(|| scaled(a, 1.0 / size))
}

/// Distance from p to the line through a and b; to the point a if b is the same.
pub fn from_line(p: &Vector, a: &Vector, b: &Vector) -> f64 {
    let (d, q) = (sub(b, a), sub(p, a));
    let square = dot(&d, &d);
    if square == 0.0 { length(&q) } else { length(&along(&q, &d, -dot(&q, &d) / square)) }
}
