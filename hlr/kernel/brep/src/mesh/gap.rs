//! An estimate of the largest distance between a surface and a triangle whose corners lie on it.
//!
//! Let n be a fixed direction, H the second derivative of n . S, and x = sum l_i v_i a point of the triangle. The gap
//! along n is sum l_i H_i(v_i - x, v_i - x) / 2, where H_i is a mean of H on the way from x to v_i. H is known at the
//! corners and assumed to change linearly between them. For departures from that, a share of its size is added.

use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, cross, dot, sub, unit};

/// Allowance for a nonlinear change of H, as a share of (H_uu a^2 + 2 H_uv a b + H_vv b^2) / 8. H is its largest value
/// at the corners, a and b the width and height of the triangle in (u, v).
const SHARE: f64 = 0.06;
/// Factor on the gap that is measured at four places: it may be larger between them.
const MARGIN: f64 = 1.1;
/// If H differs by more than this share of its largest value from corner to corner, its change may be nonlinear.
const UNEVEN: f64 = 0.3;

/// A corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    pub uv: [f64; 2],
    pub point: Vector,
    /// The unit normal; 0 where the surface has none.
    pub normal: Vector,
}

/// Second derivatives duu, duv, dvv at a corner, and the point of the surface there.
pub type Bend = [Vector; 4];

/// A corner on the surface, or at a given point beside the surface.
pub fn corner(surface: &Surface, uv: [f64; 2], point: Option<Vector>) -> (Corner, Bend) {
    let jet = surface.jet(uv);
    let n = cross(&jet.du, &jet.dv);
    let longest = dot(&jet.du, &jet.du).max(dot(&jet.dv, &jet.dv));
    let normal = if dot(&n, &n) > 1e-13 * longest * longest { unit(&n) } else { None };
    let corner = Corner { uv, point: point.unwrap_or(jet.point), normal: normal.unwrap_or_default() };
    (corner, [jet.duu, jet.duv, jet.dvv, jet.point])
}

/// A triangle's error: as a whole, and along each of its edges 0-1, 1-2, 2-0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gap {
    pub whole: f64,
    pub edges: [f64; 3],
}

/// The error of a triangle. If a quick bound already keeps the deflection, that bound, without the errors of the edges.
///
/// `kinked`: knots of a spline lie between the corners. In that case, and where H changes much, gaps are measured as
/// well.
pub fn gap(surface: &Surface, corners: [&Corner; 3], bends: [&Bend; 3], kinked: bool, deflection: f64) -> Gap {
    if let Surface::Sphere(_, r) = surface {
        return on_sphere(r.abs(), corners);
    }
    let [a, b, c] = corners;
    let Some(n) = unit(&add(&add(&a.normal, &b.normal), &c.normal)) else { return Gap::default() };
    let forms = bends.map(|bend| [0, 1, 2].map(|k| dot(&bend[k], &n)));
    let steps = [(a, b), (b, c), (c, a)].map(|(p, q)| [q.uv[0] - p.uv[0], q.uv[1] - p.uv[1]]);
    let form = |h: &[f64; 3], [u, v]: [f64; 2]| h[0] * u * u + 2.0 * h[1] * u * v + h[2] * v * v;
    // H at each corner, applied to each edge.
    let along = steps.map(|step| [0, 1, 2].map(|k| form(&forms[k], step)));
    let size = [0, 1].map(|k| steps.iter().fold(0.0f64, |m, s| m.max(s[k].abs())));
    let most = [0, 1, 2].map(|k| forms.iter().fold(0.0f64, |m, f| m.max(f[k].abs())));
    let rest = |step: [f64; 2]| SHARE * form(&most, step) / 8.0;
    let largest = along.iter().flatten().fold(0.0f64, |m, h| m.max(h.abs()));
    let uneven = |h: &[f64; 3]| {
        let (low, high) = h.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, g), x| (l.min(*x), g.max(*x)));
        high - low > UNEVEN * largest
    };
    let doubtful = kinked || along.iter().any(uneven);
    let measured = if doubtful { MARGIN * measured(surface, corners, bends, &n) } else { 0.0 };
    // sum l_i l_j is at most one third.
    let glance = largest / 6.0 + rest(size);
    let glance = glance.max(measured);
    if glance <= deflection {
        return Gap { whole: glance, edges: [0.0; 3] };
    }
    Gap {
        whole: measured.max(0.5 * extreme(&along) + rest(size)),
        // Along an edge H changes linearly from one end to the other.
        edges: [0, 1, 2].map(|i| 0.0625 * (along[i][i] + along[i][(i + 1) % 3]).abs() + rest(steps[i].map(f64::abs))),
    }
}

/// The largest gap along n at the middles of the edges and at the centroid.
fn measured(surface: &Surface, corners: [&Corner; 3], bends: [&Bend; 3], n: &Vector) -> f64 {
    let mut most = 0.0f64;
    for l in &PLACES[..4] {
        let at = [0, 1].map(|k| l[0] * corners[0].uv[k] + l[1] * corners[1].uv[k] + l[2] * corners[2].uv[k]);
        let flat: f64 = (0..3).map(|k| l[k] * dot(&bends[k][3], n)).sum();
        most = most.max((dot(&surface.point(at), n) - flat).abs());
    }
    most
}

/// The largest distance of the surface from the plane of a triangle at places within it, with a margin. It does not
/// depend on normals at the corners, which say little where a triangle is far too coarse. 0 for triangles without area.
pub fn off_plane(surface: &Surface, corners: [&Corner; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner.point);
    let Some(n) = unit(&cross(&sub(&b, &a), &sub(&c, &a))) else { return 0.0 };
    let off = |l: &[f64; 3]| {
        let at = [0, 1].map(|k| l[0] * corners[0].uv[k] + l[1] * corners[1].uv[k] + l[2] * corners[2].uv[k]);
        dot(&sub(&surface.point(at), &a), &n).abs()
    };
    MARGIN * PLACES.iter().map(off).fold(0.0, f64::max)
}

/// Barycentric coordinates of the places in a triangle where gaps are compared. The gaps are greatest near these
/// places.
const PLACES: [[f64; 3]; 10] = {
    const T: f64 = 1.0 / 3.0;
    [
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.5],
        [0.5, 0.0, 0.5],
        [T, T, T],
        [0.5, 0.25, 0.25],
        [0.25, 0.5, 0.25],
        [0.25, 0.25, 0.5],
        [0.4, 0.4, 0.2],
        [0.2, 0.4, 0.4],
        [0.4, 0.2, 0.4],
    ]
};

/// Greatest |sum l_i H_i'(v_i - x, v_i - x)|, where H_i' is a third of H at v_i and two thirds of H at x: the mean on
/// the way of a form that changes linearly. `along`: H at each corner, applied to the edges 0-1, 1-2, 2-0.
fn extreme(along: &[[f64; 3]; 3]) -> f64 {
    let mut most = 0.0f64;
    for l in PLACES {
        let mut sum = 0.0;
        // H(v_i - x, v_i - x) from the edges: with d_i = sum_j l_j (v_i - v_j).
        let here = |h: [f64; 3], i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // Along i-j, j-k, k-i; 2 H(v_i - v_j, v_i - v_k) is the first and the last less the middle one.
            let (p, q, r) = (h[i], h[j], h[k]);
            l[j] * l[j] * p + l[k] * l[k] * r + l[j] * l[k] * (p + r - q)
        };
        let mean = along.map(|h| l[0] * h[0] + l[1] * h[1] + l[2] * h[2]);
        for i in 0..3 {
            let own = along.map(|h| h[i]);
            sum += l[i] * (2.0 * here(mean, i) + here(own, i)) / 3.0;
        }
        most = most.max(sum.abs());
    }
    most
}

/// The exact error on a sphere: from the circle through the corners, or from the longest edge if the centre of that
/// circle is not in the triangle.
fn on_sphere(radius: f64, corners: [&Corner; 3]) -> Gap {
    let [a, b, c] = corners.map(|k| k.point);
    let squares = [sub(&b, &a), sub(&c, &b), sub(&a, &c)].map(|d| dot(&d, &d));
    let [p, q, r] = squares;
    let longest = p.max(q).max(r);
    let n = cross(&sub(&b, &a), &sub(&c, &a));
    let circle = if 2.0 * longest >= p + q + r { 0.25 * longest } else { p * q * r / (4.0 * dot(&n, &n)) };
    let height = |square: f64| {
        let square = square.min(radius * radius);
        square / (radius + (radius * radius - square).sqrt())
    };
    Gap { whole: height(circle), edges: squares.map(|s| height(0.25 * s)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::shapes::Random;

    /// A bicubic patch over the unit square: x = u, y = v, and a height of the third degree.
    fn patch(c: [f64; 7]) -> Surface {
        let terms = [(2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];
        // u^k in Bernstein polynomials of degree 3.
        let share = |i: u8, k: u8| match k {
            0 => 1.0,
            1 => f64::from(i) / 3.0,
            2 => [0.0, 0.0, 1.0 / 3.0, 1.0][i as usize],
            _ => [0.0, 0.0, 0.0, 1.0][i as usize],
        };
        let mut data = vec![3.0, 3.0, 4.0, 4.0, 0.0, 0.0];
        (0..2).for_each(|_| data.extend([0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]));
        for i in 0..4 {
            for j in 0..4 {
                let z: f64 = terms.iter().zip(c).map(|(&(a, b), c)| c * share(i, a) * share(j, b)).sum();
                data.extend([f64::from(i) / 3.0, f64::from(j) / 3.0, z, 1.0]);
            }
        }
        Surface::read(8, &data).unwrap()
    }

    #[test]
    fn no_gap_is_greater_than_its_bound() {
        let mut random = Random(3);
        for _ in 0..2000 {
            let surface = patch(std::array::from_fn(|k| (2.0 * random.next() - 1.0) * if k < 3 { 0.5 } else { 0.15 }));
            let uv: [[f64; 2]; 3] = std::array::from_fn(|_| [random.next(), random.next()]);
            let made = uv.map(|p| corner(&surface, p, None));
            let corners = made.each_ref().map(|m| &m.0);
            let got = gap(&surface, corners, made.each_ref().map(|m| &m.1), false, 0.0).whole;
            let n = corners.iter().fold([0.0; 3], |sum, c| add(&sum, &c.normal));
            let n = unit(&n).unwrap();
            let mut most = 0.0f64;
            for i in 0..=40 {
                for j in 0..=40 - i {
                    let l = [f64::from(i) / 40.0, f64::from(j) / 40.0, 1.0 - f64::from(i + j) / 40.0];
                    let at = [0, 1].map(|k| l[0] * uv[0][k] + l[1] * uv[1][k] + l[2] * uv[2][k]);
                    let flat: f64 = (0..3).map(|k| l[k] * dot(&corners[k].point, &n)).sum();
                    most = most.max((dot(&surface.point(at), &n) - flat).abs());
                }
            }
            assert!(got >= most && got < 1.2 * most + 0.03, "{got} {most}");
        }
    }
}
