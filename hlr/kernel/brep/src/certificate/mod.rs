//! A proof that the mesh of a face keeps its chord error. For each triangle in (u, v) it bounds the distance of the
//! surface from the triangle, measured along the mean normal of the corners or at right angles to the triangle.
//!
//! The error is measured between points of the surface. The distance of a file's edges from the surface is not
//! included.
//!
//! Let f be the height of the surface above the plane through its points at a triangle's corners, times the surface's
//! weight where it has one. Let H be the second derivative of f, and H_i its mean on the way from x to the corner v_i.
//! Then, with l_i the barycentric coordinates of x,
//!
//! f(x) - sum l_i f(v_i) = - sum l_i H_i(v_i - x, v_i - x) / 2.
//!
//! `second_derivatives` gives a box that contains H. For the middle of the box the sum is a quadratic form, whose
//! extreme is exact. The rest of the box adds at most (dH_uu a^2 + 2 dH_uv a b + dH_vv b^2) / 8 for the triangle's
//! width a and height b. A knot at which the slope jumps by J along u adds J a / 4, and likewise along v. Where the
//! bound is too large, the triangle is divided into four. That divides the uncertainty by four or more, or by two where
//! slopes jump.

pub(crate) mod control_net;
mod second_derivatives;

use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, add, cross, dot, sub, unit};
use crate::mesh::FaceMesh;
use control_net::Range;
use second_derivatives::{Bends, Ranges, plus, times};

/// How many times in a row a triangle may be divided into four.
const DEPTH: u32 = 7;
/// Where the measured error exceeds the limit, the proof stops as soon as its bound is at most this factor larger.
const CLOSE: f64 = 1.02;
/// Share of the deflection that is allowed for rounding.
const ROUNDING: f64 = 1e-9;
/// Cosine of the angle between a triangle's own normal and the mean normal of its corners. Below it the triangle is a
/// needle, and its own normal is not used.
const UPRIGHT: f64 = 0.9;

/// What is proved of a mesh. Errors are in the unit of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Upper bound: no triangle is farther from the surface.
    pub bound: f64,
    /// Lower bound: some point of the surface is this far from its triangle.
    pub measured: f64,
    pub triangles: usize,
    /// Triangles whose proved bound exceeds the deflection.
    pub above: usize,
    /// Triangles of which nothing can be proved: across the ends of a period, and on surfaces of which only values are
    /// known.
    pub unproved: usize,
}

impl Certificate {
    pub fn and(self, other: Certificate) -> Certificate {
        Certificate {
            bound: self.bound.max(other.bound),
            measured: self.measured.max(other.measured),
            triangles: self.triangles + other.triangles,
            above: self.above + other.above,
            unproved: self.unproved + other.unproved,
        }
    }
}

/// Proves the chord error of a face's mesh against a deflection.
pub fn certify(surface: &Surface, mesh: &FaceMesh, deflection: f64) -> Certificate {
    let mut all = Certificate { triangles: mesh.triangles.len(), ..Certificate::default() };
    if matches!(surface, Surface::Plane(_)) {
        return all;
    }
    let bends = Bends::new(surface);
    for t in &mesh.triangles {
        let uv = t.map(|i| mesh.uv[i as usize]);
        if crate::mesh::area(&uv) == 0.0 {
            continue; // It covers nothing.
        }
        let points = uv.map(|p| surface.point(p));
        let normals = t.map(|i| mesh.normals[i as usize]);
        let mean = unit(&add(&add(&normals[0], &normals[1]), &normals[2]));
        let own = unit(&cross(&sub(&points[1], &points[0]), &sub(&points[2], &points[0])));
        let upright = own.filter(|n| mean.is_none_or(|mean| dot(n, &mean) >= UPRIGHT));
        let proofs = [mean, upright].into_iter().flatten().filter_map(|n| {
            let heights = points.map(|p| dot(&n, &sub(&p, &points[0])));
            let origin = points[0];
            let mut proof =
                Proof { surface, bends: bends.as_ref()?, n, origin, uv, heights, limit: deflection, measured: 0.0 };
            Some((proof.bound(uv, [0.0; 3], 0)?, proof.measured))
        });
        // The triangle's own normal is tried only where the mean normal gives too large a bound.
        let mut least: Option<(f64, f64)> = None;
        for (bound, measured) in proofs {
            least = Some(least.map_or((bound, measured), |(b, s)| (b.min(bound), s.min(measured))));
            if bound <= deflection * (1.0 + ROUNDING) {
                break;
            }
        }
        let Some((bound, measured)) = least else {
            all.unproved += 1;
            continue;
        };
        all.bound = all.bound.max(bound);
        all.measured = all.measured.max(measured);
        all.above += usize::from(bound > deflection * (1.0 + ROUNDING));
    }
    all
}

/// The proof for one triangle.
struct Proof<'a> {
    surface: &'a Surface,
    bends: &'a Bends<'a>,
    n: Vector,
    origin: Vector,
    uv: [[f64; 2]; 3],
    /// Heights of the corners above the plane through the first corner, along n.
    heights: [f64; 3],
    limit: f64,
    measured: f64,
}

impl Proof<'_> {
    /// An upper bound of the gap on a part of the triangle, from the gaps at the part's corners; None where there is no
    /// bound.
    fn bound(&mut self, uv: [[f64; 2]; 3], gaps: [f64; 3], depth: u32) -> Option<f64> {
        let known = gaps.iter().fold(0.0f64, |m, g| m.max(g.abs()));
        self.measured = self.measured.max(known);
        let rectangle: [Range; 2] =
            [0, 1].map(|k| uv.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], p| [l.min(p[k]), h.max(p[k])]));
        let ranges = self.bends.on(&self.n, &self.origin, rectangle);
        let bound = ranges.and_then(|ranges| self.at_once(uv, gaps, rectangle, &ranges));
        if let Some(bound) = bound
            && (bound <= self.limit || (self.measured > self.limit && bound <= CLOSE * self.measured))
        {
            return Some(bound);
        }
        if depth == DEPTH {
            return bound;
        }
        let middle = |i: usize, j: usize| [0, 1].map(|k| 0.5 * (uv[i][k] + uv[j][k]));
        let [ab, bc, ca] = [middle(0, 1), middle(1, 2), middle(2, 0)];
        let [x, y, z] = [ab, bc, ca].map(|p| self.gap(p));
        let [a, b, c] = uv;
        let [f, g, h] = gaps;
        let parts =
            [([a, ab, ca], [f, x, z]), ([ab, b, bc], [x, g, y]), ([ca, bc, c], [z, y, h]), ([ab, bc, ca], [x, y, z])];
        parts.into_iter().try_fold(0.0f64, |most, (uv, gaps)| Some(most.max(self.bound(uv, gaps, depth + 1)?)))
    }

    /// Height of the surface above the triangle along n, both taken at the same (u, v).
    fn gap(&self, p: [f64; 2]) -> f64 {
        dot(&self.n, &sub(&self.surface.point(p), &self.origin)) - self.plane(p)
    }

    /// Height of the triangle along n at a point in (u, v).
    fn plane(&self, p: [f64; 2]) -> f64 {
        let [x, y] = self.slopes();
        self.heights[0] + x * (p[0] - self.uv[0][0]) + y * (p[1] - self.uv[0][1])
    }

    fn slopes(&self) -> [f64; 2] {
        let [a, b, c] = self.uv;
        let [d, e] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1]]);
        let area = d[0] * e[1] - d[1] * e[0];
        let [f, g] = [self.heights[1] - self.heights[0], self.heights[2] - self.heights[0]];
        [(f * e[1] - g * d[1]) / area, (g * d[0] - f * e[0]) / area]
    }

    fn at_once(&self, uv: [[f64; 2]; 3], gaps: [f64; 3], rectangle: [Range; 2], ranges: &Ranges) -> Option<f64> {
        let weight = ranges.weight;
        let mut forms = ranges.height;
        let mut jumps = ranges.jumps[0];
        if weight != [1.0; 2] {
            // The second derivatives of the weight times the triangle's height.
            let corners = [0, 1, 2, 3].map(|k| self.plane([rectangle[0][k & 1], rectangle[1][k >> 1]]));
            let height = corners.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(*x), h.max(*x)]);
            let slopes = self.slopes();
            for (form, [i, j], bend) in [(0, [0, 0], 0), (1, [0, 1], 1), (2, [1, 1], 2)] {
                let twice = plus(scaled(ranges.slopes[i], slopes[j]), scaled(ranges.slopes[j], slopes[i]));
                let less = plus(times(ranges.bends[bend], height), twice);
                forms[form] = plus(forms[form], scaled(less, -1.0));
            }
            let most = height[1].max(-height[0]);
            jumps = [0, 1].map(|side| jumps[side] + most * ranges.jumps[1][side]);
        }
        let middle = forms.map(|[low, high]| 0.5 * (low + high));
        let half = forms.map(|[low, high]| 0.5 * (high - low));
        let along = [(0, 1), (1, 2), (2, 0)].map(|(i, j): (usize, usize)| {
            let [a, b] = [0, 1].map(|k| uv[j][k] - uv[i][k]);
            middle[0] * a * a + 2.0 * middle[1] * a * b + middle[2] * b * b
        });
        let [a, b] = rectangle.map(|[low, high]| high - low);
        let uneven = (half[0] * a * a + 2.0 * half[1] * a * b + half[2] * b * b) / 8.0;
        let rest = 0.5 * extreme(along) + uneven + 0.25 * (jumps[0] * a + jumps[1] * b);
        let known = gaps.iter().fold(0.0f64, |m, g| m.max(g.abs()));
        let bound = (known * weight[1] + rest) / weight[0];
        (weight[0] > 0.0 && bound.is_finite()).then_some(bound)
    }
}

/// Greatest |h01 l0 l1 + h12 l1 l2 + h20 l2 l0| on a triangle: at the middle of an edge, or at a stationary point
/// inside.
fn extreme([p, q, r]: [f64; 3]) -> f64 {
    let edges = [p, q, r].iter().fold(0.0f64, |m, h| m.max(0.25 * h.abs()));
    // p l1 + r l2 = p l0 + q l2 = r l0 + q l1.
    let l = [q * (p + r - q), r * (p + q - r), p * (q + r - p)];
    let sum: f64 = l.iter().sum();
    if sum == 0.0 || l.iter().any(|x| x * sum < 0.0) {
        return edges;
    }
    let l = l.map(|x| x / sum);
    edges.max((p * l[0] * l[1] + q * l[1] * l[2] + r * l[2] * l[0]).abs())
}

fn scaled(a: Range, s: f64) -> Range {
    if s < 0.0 { [s * a[1], s * a[0]] } else { [s * a[0], s * a[1]] }
}

#[cfg(test)]
mod tests;
