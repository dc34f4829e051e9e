//! Surfaces of faces, with OpenCASCADE's parameters: points, first derivatives, normals.
//!
//! A record is a kind and a run of numbers:
//!
//! ```text
//! 1-5 plane, cylinder, cone, sphere, torus   origin, x, y, z directions, then the radii (cone: radius, half angle)
//! 6 revolution   a point of the axis, its direction, the kind of the curve, its numbers (`curve.rs`)
//! 7 extrusion    the direction, the kind of the curve, its numbers
//! 8 spline       degrees u, v; pole counts u, v; periods u, v (0: none); knots u, v with repetition; poles
//!                (x, y, z, w), v fastest
//! 9 offset       the distance, the kind of the basis, the basis's numbers
//! ```

use hlr_exact::elementary::{cos, sin, sin_cos};
use std::f64::consts::TAU;

use super::curve::Curve;
use super::jet::upright;
use super::spline_surface::SplineSurface;
use super::vector::{Vector, add, along, cross, dot, scaled, sub, unit};

#[derive(Clone, Debug)]
pub struct Frame {
    origin: Vector,
    x: Vector,
    y: Vector,
    z: Vector,
}

#[derive(Clone, Debug)]
pub enum Surface {
    Plane(Frame),
    Cylinder(Frame, f64),
    /// Radius at the origin; sine and cosine of the half angle.
    Cone(Frame, f64, f64, f64),
    Sphere(Frame, f64),
    /// Major and minor radius.
    Torus(Frame, f64, f64),
    /// A point of the axis, the direction of the axis, and the curve that is turned about it.
    Revolution(Vector, Vector, Box<Curve>),
    Extrusion(Vector, Box<Curve>),
    Spline(Box<SplineSurface>),
    Offset(Box<Surface>, f64),
}

/// Share of the way to a nearby point at which the normal of a singular point is evaluated.
const BESIDE: f64 = 1e-8;

impl Surface {
    /// Reads a record; None for an unknown kind, or numbers that do not fit the kind.
    pub fn read(kind: u8, data: &[f64]) -> Option<Surface> {
        let frame = |count: usize| {
            let three = |i: usize| [data[i], data[i + 1], data[i + 2]];
            (data.len() == 12 + count).then(|| Frame { origin: three(0), x: three(3), y: three(6), z: three(9) })
        };
        Some(match kind {
            1 => Surface::Plane(frame(0)?),
            2 => Surface::Cylinder(frame(1)?, data[12]),
            3 => Surface::Cone(frame(2)?, data[12], sin(data[13]), cos(data[13])),
            4 => Surface::Sphere(frame(1)?, data[12]),
            5 => Surface::Torus(frame(2)?, data[12], data[13]),
            6 => {
                let [a, b, c, x, y, z, kind, curve @ ..] = data else { return None };
                let curve = Curve::from_record(*kind as u8, curve)?;
                Surface::Revolution([*a, *b, *c], [*x, *y, *z], Box::new(curve))
            }
            7 => {
                let [x, y, z, kind, curve @ ..] = data else { return None };
                Surface::Extrusion([*x, *y, *z], Box::new(Curve::from_record(*kind as u8, curve)?))
            }
            8 => Surface::Spline(Box::new(SplineSurface::read(data)?)),
            9 => {
                let (head, basis) = data.split_at_checked(2)?;
                Surface::Offset(Box::new(Surface::read(head[1] as u8, basis)?), head[0])
            }
            _ => return None,
        })
    }

    /// The point, and the derivatives by u and v.
    pub fn d1(&self, [u, v]: [f64; 2]) -> (Vector, Vector, Vector) {
        match self {
            Surface::Plane(f) => (along(&along(&f.origin, &f.x, u), &f.y, v), f.x, f.y),
            Surface::Cylinder(f, r) => {
                let (out, turn) = f.around(u);
                (along(&along(&f.origin, &out, *r), &f.z, v), scaled(&turn, *r), f.z)
            }
            Surface::Cone(f, r, sin, cos) => {
                let (out, turn) = f.around(u);
                let radius = r + v * sin;
                let point = along(&along(&f.origin, &out, radius), &f.z, v * cos);
                (point, scaled(&turn, radius), along(&scaled(&out, *sin), &f.z, *cos))
            }
            Surface::Sphere(f, r) => f.ring(u, v, 0.0, *r),
            Surface::Torus(f, major, minor) => f.ring(u, v, *major, *minor),
            Surface::Revolution(origin, axis, curve) => {
                let [p, d, _] = curve.derivatives(v);
                let (sin, cos) = sin_cos(u);
                let turned = |w: &Vector| {
                    let upright = scaled(axis, dot(axis, w) * (1.0 - cos));
                    along(&along(&upright, w, cos), &cross(axis, w), sin)
                };
                let arm = turned(&sub(&p, origin));
                (add(origin, &arm), cross(axis, &arm), turned(&d))
            }
            Surface::Extrusion(way, curve) => {
                let [p, d, _] = curve.derivatives(u);
                (along(&p, way, v), d, *way)
            }
            Surface::Spline(s) => s.d1(u, v),
            Surface::Offset(basis, distance) => Surface::offset_d1(basis, *distance, [u, v]),
        }
    }

    pub fn point(&self, uv: [f64; 2]) -> Vector {
        match self {
            Surface::Spline(s) => s.point(uv[0], uv[1]),
            Surface::Offset(basis, distance) => Surface::offset_point(basis, *distance, uv),
            _ => self.d1(uv).0,
        }
    }

    /// Periods of u and v; 0 where it is not periodic.
    pub fn periods(&self) -> [f64; 2] {
        match self {
            Surface::Plane(_) => [0.0; 2],
            Surface::Cylinder(..) | Surface::Cone(..) | Surface::Sphere(..) => [TAU, 0.0],
            Surface::Torus(..) => [TAU, TAU],
            Surface::Revolution(_, _, curve) => [TAU, curve.period()],
            Surface::Extrusion(_, curve) => [curve.period(), 0.0],
            Surface::Spline(s) => s.period(),
            Surface::Offset(basis, _) => basis.periods(),
        }
    }

    /// Ranges of u and v; `size` replaces an infinite end.
    pub fn domain(&self, size: f64) -> [[f64; 2]; 2] {
        let (turn, open) = ([0.0, TAU], [-size, size]);
        match self {
            Surface::Plane(_) => [open, open],
            Surface::Cylinder(..) | Surface::Cone(..) => [turn, open],
            Surface::Sphere(..) => [turn, [-0.25 * TAU, 0.25 * TAU]],
            Surface::Torus(..) => [turn, turn],
            Surface::Revolution(_, _, curve) => [turn, curve.domain(size)],
            Surface::Extrusion(_, curve) => [curve.domain(size), open],
            Surface::Spline(s) => s.domain(),
            Surface::Offset(basis, _) => basis.domain(size),
        }
    }

    /// A point of the axis of revolution and its direction.
    pub fn axis(&self) -> Option<(Vector, Vector)> {
        match self {
            Surface::Torus(f, ..) => Some((f.origin, f.z)),
            Surface::Revolution(origin, axis, _) => Some((*origin, *axis)),
            _ => None,
        }
    }

    /// The centre of a sphere.
    pub fn centre(&self) -> Option<Vector> {
        if let Surface::Sphere(f, _) = self { Some(f.origin) } else { None }
    }

    /// The unit normal du x dv; None where the surface has none.
    pub fn normal(&self, uv: [f64; 2]) -> Option<Vector> {
        let (_, du, dv) = self.d1(uv);
        upright(&du, &dv)
    }

    /// The point and the unit normal; None where the surface has none.
    pub fn placed(&self, uv: [f64; 2]) -> (Vector, Option<Vector>) {
        let (p, du, dv) = self.d1(uv);
        (p, upright(&du, &dv))
    }

    /// The unit normal; at a pole or an apex, that of a point close by, toward the parameters `beside`.
    pub fn normal_toward(&self, uv: [f64; 2], beside: [f64; 2]) -> Option<Vector> {
        self.normal(uv).or_else(|| {
            let (_, du, dv) = self.d1([0, 1].map(|k| uv[k] + BESIDE * (beside[k] - uv[k])));
            unit(&cross(&du, &dv))
        })
    }
}

impl Frame {
    pub(super) fn origin(&self) -> Vector {
        self.origin
    }

    pub(super) fn axis(&self) -> Vector {
        self.z
    }

    /// The direction about which u turns from x to y; opposite to `axis` in a left-handed frame.
    pub(super) fn pole(&self) -> Vector {
        cross(&self.x, &self.y)
    }

    /// Origin, and the directions of x, y and z.
    pub fn vectors(&self) -> [Vector; 4] {
        [self.origin, self.x, self.y, self.z]
    }

    /// Radial and tangential directions at the angle u about z.
    pub(super) fn around(&self, u: f64) -> (Vector, Vector) {
        let (sin, cos) = sin_cos(u);
        (along(&scaled(&self.x, cos), &self.y, sin), along(&scaled(&self.y, cos), &self.x, -sin))
    }

    /// Point and derivatives of a circle of radius `minor`, at the distance `major` from the axis and turned about it.
    fn ring(&self, u: f64, v: f64, major: f64, minor: f64) -> (Vector, Vector, Vector) {
        let (out, turn) = self.around(u);
        let (sin, cos) = sin_cos(v);
        let radius = major + minor * cos;
        (
            along(&along(&self.origin, &out, radius), &self.z, minor * sin),
            scaled(&turn, radius),
            along(&scaled(&out, -minor * sin), &self.z, minor * cos),
        )
    }
}
