//! A visibility oracle: exact, slow, and without any code of the kernel.
//!
//! Every drawn segment a -> b is compared with every triangle. What a triangle hides is where four conditions hold,
//! each linear in the segment's parameter t: inside the three sides of the triangle's image, and behind its plane. So
//! it is one interval with rational ends, and the hidden part is the union.
//!
//! Coincidences: depth z grows away from the viewer; the segment alone is moved by (e^2, e^3, -e), e > 0 going to 0.
//! Moving does not turn it: a condition alpha + beta t > 0 keeps its beta, so where beta is not 0 the unmoved end
//! counts, and where beta is 0 the sign of alpha + its terms in e, e^2, e^3, the first that is not 0.
//!
//! Snapped coordinates have at most 31 bits, so alpha and beta have at most 96: they fit i128.

use std::cmp::Ordering;

pub type Point = [i32; 3];

/// n / d, d > 0.
pub type Fraction = (i128, i128);

/// By continued fractions: no product, so nothing to overflow.
pub fn compare(a: Fraction, b: Fraction) -> Ordering {
    let whole = a.0.div_euclid(a.1).cmp(&b.0.div_euclid(b.1));
    let (r, s) = (a.0.rem_euclid(a.1), b.0.rem_euclid(b.1));
    match (whole, r, s) {
        (Ordering::Equal, 0, 0) => Ordering::Equal,
        (Ordering::Equal, 0, _) => Ordering::Less,
        (Ordering::Equal, _, 0) => Ordering::Greater,
        (Ordering::Equal, _, _) => compare((b.1, s), (a.1, r)),
        _ => whole,
    }
}

fn minus(a: Point, b: Point) -> [i128; 3] {
    [0, 1, 2].map(|k| i128::from(a[k]) - i128::from(b[k]))
}

/// Twice the signed area of the image.
pub fn area([p, q, r]: [Point; 3]) -> i128 {
    let (u, v) = (minus(q, p), minus(r, p));
    u[0] * v[1] - u[1] * v[0]
}

/// Across the triangle; its z is twice the signed area of the image.
pub fn normal([p, q, r]: [Point; 3]) -> [i128; 3] {
    let (u, v) = (minus(q, p), minus(r, p));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// What one triangle hides of a segment.
#[derive(Clone, Copy, Debug)]
pub struct Shadow {
    pub from: Fraction,
    pub to: Fraction,
    /// One of its ends, within the segment, is where the segment meets the triangle.
    pub pierced: bool,
}

/// What the triangle hides of a -> b moved toward the viewer by `delta`; None where it hides nothing.
pub fn shadow(a: Point, b: Point, [p, q, r]: [Point; 3], delta: i64) -> Option<Shadow> {
    let [p, q, r] = match area([p, q, r]).signum() {
        1 => [p, q, r],
        -1 => [p, r, q],
        _ => return None,
    };
    let run = minus(b, a);
    // alpha, beta, the terms of alpha in e, e^2, e^3
    let mut conditions = [(0, 0, [0; 3]); 4];
    for (k, (s, t)) in [(p, q), (q, r), (r, p)].into_iter().enumerate() {
        let (w, v) = (minus(t, s), minus(a, s));
        conditions[k] = (w[0] * v[1] - w[1] * v[0], w[0] * run[1] - w[1] * run[0], [0, -w[1], w[0]]);
    }
    // Its z is the area, so it grows away from the viewer.
    let n = normal([p, q, r]);
    let dot = |w: [i128; 3]| n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
    conditions[3] = (dot(minus(a, p)) - n[2] * i128::from(delta), dot(run), [-n[2], n[0], n[1]]);

    let (mut from, mut to) = ((0, 1), (1, 1));
    for (alpha, beta, terms) in conditions {
        match beta.signum() {
            0 => {
                if [alpha, terms[0], terms[1], terms[2]].into_iter().find(|&c| c != 0).unwrap_or(0) <= 0 {
                    return None;
                }
            }
            1 => from = if compare((-alpha, beta), from) == Ordering::Greater { (-alpha, beta) } else { from },
            _ => to = if compare((alpha, -beta), to) == Ordering::Less { (alpha, -beta) } else { to },
        }
    }
    let (alpha, beta, _) = conditions[3];
    let meets = |end: Fraction| beta != 0 && compare((-alpha * beta.signum(), beta.abs()), end) == Ordering::Equal;
    let pierced = (from.0 > 0 && meets(from)) || (to.0 < to.1 && meets(to));
    (compare(from, to) == Ordering::Less).then_some(Shadow { from, to, pierced })
}

pub const VISIBLE: u8 = 0;
pub const HIDDEN: u8 = 1;
pub const WITHIN: u8 = 2;

/// (from, to, state) of a segment that has these shadows as it lies, and those moved toward the viewer: hidden where it
/// is hidden either way, within the tolerance where only as it lies.
pub fn states(plain: &[Shadow], moved: &[Shadow]) -> Vec<(f64, f64, u8)> {
    let mut cuts = vec![(0, 1), (1, 1)];
    for s in plain.iter().chain(moved) {
        cuts.extend([s.from, s.to]);
    }
    cuts.sort_by(|a, b| compare(*a, *b));
    let mut out: Vec<(f64, f64, u8)> = Vec::new();
    for w in cuts.windows(2).filter(|w| compare(w[0], w[1]) == Ordering::Less) {
        let over = |s: &Shadow| compare(s.from, w[0]) != Ordering::Greater && compare(w[1], s.to) != Ordering::Greater;
        let state = match (plain.iter().any(over), moved.iter().any(over)) {
            (false, _) => VISIBLE,
            (true, true) => HIDDEN,
            (true, false) => WITHIN,
        };
        let end = w[1].0 as f64 / w[1].1 as f64;
        match out.last_mut() {
            Some(last) if last.2 == state => last.1 = end,
            _ => out.push((w[0].0 as f64 / w[0].1 as f64, end, state)),
        }
    }
    out
}
