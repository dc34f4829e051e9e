//! Point inversion: the parameters (u, v) of a point on a surface.

use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, dot, length, sub};

const MOST_STEPS: usize = 30;
/// Start values tried along each parameter where no guess is known.
const GRID: usize = 12;

/// The parameters near `guess` of the surface's point nearest to a given point; None where the search does not
/// converge.
pub fn near(surface: &Surface, point: &Vector, guess: [f64; 2]) -> Option<[f64; 2]> {
    let mut uv = guess;
    let (mut place, mut du, mut dv) = surface.d1(uv);
    let mut off = sub(point, &place);
    for _ in 0..MOST_STEPS {
        // A Gauss-Newton step: the surface is replaced by its tangent plane.
        let (a, b, c) = (dot(&du, &du), dot(&du, &dv), dot(&dv, &dv));
        let (e, f) = (dot(&du, &off), dot(&dv, &off));
        let determinant = a * c - b * b;
        if determinant <= 1e-14 * a * c {
            return None;
        }
        let step = [(c * e - b * f) / determinant, (a * f - b * e) / determinant];
        let mut share = 1.0;
        loop {
            let next = [uv[0] + share * step[0], uv[1] + share * step[1]];
            let (p, x, y) = surface.d1(next);
            let rest = sub(point, &p);
            if dot(&rest, &rest) <= dot(&off, &off) {
                (uv, place, du, dv, off) = (next, p, x, y, rest);
                break;
            }
            share *= 0.5;
            if share < 1e-3 {
                return place.iter().all(|c| c.is_finite()).then_some(uv);
            }
        }
        let moved = share * (step[0].abs() * length(&du) + step[1].abs() * length(&dv));
        if moved <= 1e-13 * (1.0 + length(point)) {
            break;
        }
    }
    place.iter().all(|c| c.is_finite()).then_some(uv)
}

/// The parameters of the surface's point nearest to a given point, without a guess, within ranges of u and v.
pub fn anywhere(surface: &Surface, point: &Vector, [u, v]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let mut best: Option<(f64, [f64; 2])> = None;
    for i in 0..=GRID {
        for j in 0..=GRID {
            let at = |[low, high]: [f64; 2], k: usize| low + (high - low) * k as f64 / GRID as f64;
            let guess = [at(u, i), at(v, j)];
            let off = length(&sub(point, &surface.point(guess)));
            if off.is_finite() && best.is_none_or(|(least, _)| off < least) {
                best = Some((off, guess));
            }
        }
    }
    near(surface, point, best?.1)
}
