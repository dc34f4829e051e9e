//! Bounds on the second derivatives of a surface's height above a plane, over a rectangle of parameters.

use super::control_net::{ControlNet, Range, height};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, along, cross, dot, length, scaled, sub};
use hlr_exact::elementary::sin_cos;

/// A surface, with the control nets that the bounds use repeatedly.
pub enum Bends<'a> {
    /// A smooth surface: the second derivatives in the middle, with a bound on how much they change.
    Smooth(&'a Surface),
    Nets(Box<Nets>),
    /// A spline turned about an axis: a point of the axis, its direction, and control nets.
    Round(Vector, Vector, Box<[ControlNet; 3]>),
}

pub struct Nets {
    whole: ControlNet,
    slopes: [ControlNet; 2],
    /// Second derivatives by uu, uv, vv.
    bends: [ControlNet; 3],
    rational: bool,
}

/// Ranges over a rectangle: the second derivatives (uu, uv, vv) of height times weight; the value, first and second
/// derivatives of the weight.
pub struct Ranges {
    pub height: [Range; 3],
    pub weight: Range,
    pub slopes: [Range; 2],
    pub bends: [Range; 3],
    /// Bounds on the jumps of the slopes, first of the height, then of the weight; each by u and v.
    pub jumps: [[f64; 2]; 2],
}

const WEIGHT: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

impl Bends<'_> {
    /// None where only the values of the surface are known.
    pub fn new(surface: &Surface) -> Option<Bends<'_>> {
        let nets = |whole: ControlNet, rational| {
            let slopes = [0, 1].map(|side| whole.derived(side));
            let bends = [slopes[0].derived(0), slopes[0].derived(1), slopes[1].derived(1)];
            Bends::Nets(Box::new(Nets { whole, slopes, bends, rational }))
        };
        match surface {
            Surface::Spline(s) => Some(nets(ControlNet::of_spline(s), s.is_rational())),
            Surface::Extrusion(way, curve) if matches!(**curve, Curve::Spline(_)) => {
                Some(nets(ControlNet::of_extrusion(way, curve)?, true))
            }
            Surface::Revolution(origin, axis, curve) if let Curve::Spline(n) = curve.as_ref() => {
                let whole = ControlNet::of_curve(n);
                let slope = whole.derived(1);
                Some(Bends::Round(*origin, *axis, Box::new([whole, slope.clone(), slope.derived(1)])))
            }
            Surface::Extrusion(_, curve) | Surface::Revolution(_, _, curve) => {
                matches!(**curve, Curve::Line { .. } | Curve::Ellipse { .. }).then_some(Bends::Smooth(surface))
            }
            Surface::Offset(..) => None,
            _ => Some(Bends::Smooth(surface)),
        }
    }

    /// None where the rectangle crosses the end of a period.
    pub fn on(&self, n: &Vector, origin: &Vector, rectangle: [Range; 2]) -> Option<Ranges> {
        let none = [0.0; 2];
        let one = |height| Ranges { height, weight: [1.0; 2], slopes: [none; 2], bends: [none; 3], jumps: [none; 2] };
        match self {
            Bends::Smooth(surface) => {
                let middle = rectangle.map(|[low, high]| 0.5 * (low + high));
                let half = rectangle.map(|[low, high]| 0.5 * (high - low));
                let jet = surface.jet(middle);
                let change = change(surface, rectangle, half)?;
                let values = [jet.duu, jet.duv, jet.dvv].map(|d| dot(&d, n));
                Some(one([0, 1, 2].map(|k| [values[k] - change[k], values[k] + change[k]])))
            }
            Bends::Nets(nets) => {
                if (0..2).any(|side| nets.whole.comes_round(side, rectangle[side])) {
                    return None;
                }
                let form = height(n, origin);
                let bends = nets.bends.each_ref().map(|net| net.range(&form, rectangle));
                let jumps = |form: &[f64; 4]| [0, 1].map(|side| nets.whole.jump(side, form, rectangle));
                if !nets.rational {
                    return Some(Ranges { jumps: [jumps(&form), none], ..one(bends) });
                }
                let of = |net: &ControlNet| net.range(&WEIGHT, rectangle);
                Some(Ranges {
                    height: bends,
                    weight: of(&nets.whole),
                    slopes: nets.slopes.each_ref().map(of),
                    bends: nets.bends.each_ref().map(of),
                    jumps: [jumps(&form), jumps(&WEIGHT)],
                })
            }
            Bends::Round(middle, axis, nets) => {
                // The height is a(v) cos u + b(v) sin u + c(v).
                let upright = dot(n, axis);
                let about = |w: Vector| height(&w, middle);
                let a = about(along(n, axis, -upright));
                let b = about(cross(n, axis));
                let mut c = about(scaled(axis, upright));
                c[3] += dot(n, &sub(middle, origin));
                let [low, high] = rectangle[0];
                let half = 0.5 * (high - low);
                let near = |x: f64| [(x - half).max(-1.0), (x + half).min(1.0)];
                let (sin, cos) = sin_cos(0.5 * (low + high));
                let (sin, cos) = (near(sin), near(cos));
                let of = |k: usize, form: &[f64; 4]| nets[k].range(form, rectangle);
                let turned = |k: usize, x: Range, y: Range| plus(times(of(k, &a), x), times(of(k, &b), y));
                let less = |range: Range| [-range[1], -range[0]];
                let jump = [&a, &b, &c].map(|form| nets[0].jump(1, form, rectangle));
                Some(Ranges {
                    height: [
                        less(turned(0, cos, sin)),
                        turned(1, less(sin), cos),
                        plus(turned(2, cos, sin), of(2, &c)),
                    ],
                    weight: of(0, &WEIGHT),
                    slopes: [none, of(1, &WEIGHT)],
                    bends: [none, none, of(2, &WEIGHT)],
                    jumps: [[0.0, jump.iter().sum()], [0.0, nets[0].jump(1, &WEIGHT, rectangle)]],
                })
            }
        }
    }
}

pub fn plus(a: Range, b: Range) -> Range {
    [a[0] + b[0], a[1] + b[1]]
}

pub fn times(a: Range, b: Range) -> Range {
    let all = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(*x), h.max(*x)])
}

/// Bounds on how much the second derivatives uu, uv, vv differ from those in the middle, along any unit direction.
fn change(surface: &Surface, [_, v]: [Range; 2], [hu, hv]: [f64; 2]) -> Option<[f64; 3]> {
    // Bounds of the third derivatives, by uuu, uuv, uvv, vvv.
    let [a, b, c, d] = match surface {
        Surface::Plane(_) => [0.0; 4],
        Surface::Cylinder(_, r) => [r.abs(), 0.0, 0.0, 0.0],
        Surface::Cone(_, r, sin, _) => {
            let radius = v.iter().map(|v| (r + v * sin).abs()).fold(0.0, f64::max);
            [radius, sin.abs(), 0.0, 0.0]
        }
        Surface::Sphere(_, r) => [r.abs(); 4],
        Surface::Torus(_, major, minor) => [major.abs() + minor.abs(), minor.abs(), minor.abs(), minor.abs()],
        Surface::Extrusion(_, curve) => [size(curve)?[2], 0.0, 0.0, 0.0],
        Surface::Revolution(origin, _, curve) => {
            let [first, second, third] = size(curve)?;
            let middle = curve.point(0.5 * (v[0] + v[1]));
            let arm = length(&sub(&middle, origin)) + first * hv;
            [arm, first, second, third]
        }
        _ => return None,
    };
    Some([a * hu + b * hv, b * hu + c * hv, c * hu + d * hv])
}

/// Bounds of the first, second and third derivative.
fn size(curve: &Curve) -> Option<[f64; 3]> {
    match curve {
        Curve::Line { a, .. } => Some([length(a), 0.0, 0.0]),
        Curve::Ellipse { a, b, .. } => Some([length(a) + length(b); 3]),
        _ => None,
    }
}
