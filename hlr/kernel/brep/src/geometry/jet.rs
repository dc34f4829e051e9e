//! A point of a surface with its first and second derivatives.

use super::vector::{Vector, add, along, cross, dot, length, scaled, unit};

/// Share of the square of the longer derivative: if |du x dv| is below that, the surface has no normal there.
const SINGULAR: f64 = 1e-13;

/// A point of a surface with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    pub point: Vector,
    pub du: Vector,
    pub dv: Vector,
    pub duu: Vector,
    pub duv: Vector,
    pub dvv: Vector,
}

impl Jet {
    /// The unit normal and its derivatives by u and v; None where the surface has no normal.
    pub fn normal(&self) -> Option<(Vector, [Vector; 2])> {
        let normal = upright(&self.du, &self.dv)?;
        let size = length(&cross(&self.du, &self.dv));
        Some((normal, self.changes(&normal, size)))
    }

    /// The derivatives of the unit normal by u and v. size: of du x dv.
    pub(super) fn changes(&self, normal: &Vector, size: f64) -> [Vector; 2] {
        let of = |du: &Vector, dv: &Vector| {
            let change = add(&cross(du, &self.dv), &cross(&self.du, dv));
            scaled(&along(&change, normal, -dot(normal, &change)), 1.0 / size)
        };
        [of(&self.duu, &self.duv), of(&self.duv, &self.dvv)]
    }
}

/// The unit normal of these derivatives; None where one is 0 or they are parallel.
pub(super) fn upright(du: &Vector, dv: &Vector) -> Option<Vector> {
    let n = cross(du, dv);
    let longest = dot(du, du).max(dot(dv, dv));
    if dot(&n, &n) > SINGULAR * longest * longest { unit(&n) } else { None }
}
