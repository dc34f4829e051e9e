//! The rotation of a surface's normal along a straight line in (u, v), in closed form where the rate is constant.

use super::surface::Surface;
use super::vector::{Vector, cross, scaled};

impl Surface {
    /// The rotation of the unit normal on the way from `uv` by `step`: a vector along the axis, its length the angle in
    /// radians; 0 for a constant normal. None if the rate is not constant, or not known to be.
    pub fn turning(&self, [u, v]: [f64; 2], [along_u, along_v]: [f64; 2]) -> Option<Vector> {
        match self {
            Surface::Plane(_) => Some([0.0; 3]),
            Surface::Cylinder(f, _) => Some(scaled(&f.pole(), along_u)),
            // Beyond the apex of a cone the normal is reversed.
            Surface::Cone(f, r, sin, _) => {
                let one_side = (r + v * sin) * (r + (v + along_v) * sin) > 0.0;
                one_side.then(|| scaled(&f.pole(), along_u))
            }
            Surface::Sphere(f, _) | Surface::Torus(f, ..) if along_v == 0.0 => Some(scaled(&f.pole(), along_u)),
            Surface::Torus(_, major, minor) if major.abs() <= minor.abs() => None,
            Surface::Sphere(f, _) | Surface::Torus(f, ..) if along_u == 0.0 => {
                Some(scaled(&cross(&f.around(u).0, &f.axis()), along_v))
            }
            Surface::Revolution(_, axis, _) if along_v == 0.0 => Some(scaled(axis, along_u)),
            Surface::Extrusion(..) if along_u == 0.0 => Some([0.0; 3]),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vector::{add, dot, length, sub, unit};

    /// Rotates about an axis by its length in radians.
    fn turned(v: &Vector, axis: &Vector) -> Vector {
        let angle = length(axis);
        let Some(k) = unit(axis) else { return *v };
        let (sin, cos) = angle.sin_cos();
        let upright = scaled(&k, dot(&k, v) * (1.0 - cos));
        add(&add(&scaled(v, cos), &scaled(&cross(&k, v), sin)), &upright)
    }

    #[test]
    fn normals_turn_as_they_are_said_to() {
        // Right-handed and left-handed frames.
        for hand in [1.0, -1.0] {
            let frame = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, -0.8 * hand, 0.6 * hand];
            let of = |kind: u8, more: &[f64]| Surface::read(kind, &[&frame, more].concat()).unwrap();
            let curve = [2.0, 1.0, 0.0, 0.5, 0.0, 1.0, 0.3, 0.2, 0.0];
            let swept = |kind: u8, head: &[f64]| Surface::read(kind, &[head, &[2.0], &curve[1..], &[0.1]].concat());
            let surfaces = [
                of(1, &[]),
                of(2, &[2.0]),
                of(3, &[2.0, 0.4]),
                of(3, &[2.0, -0.4]),
                of(4, &[3.0]),
                of(5, &[3.0, 1.0]),
                swept(6, &[0.1, 0.2, 0.0, 0.0, 0.0, 1.0]).unwrap(),
                swept(7, &[0.1, 0.2, 1.0]).unwrap(),
            ];
            let mut told = 0;
            for surface in &surfaces {
                for (uv, step) in [([0.3, 0.2], [0.7, 0.0]), ([0.3, 0.2], [0.0, 0.9]), ([0.3, 0.2], [0.5, -0.4])] {
                    let Some(axis) = surface.turning(uv, step) else { continue };
                    told += 1;
                    let first = surface.normal(uv).unwrap();
                    for share in [0.25, 0.5, 1.0] {
                        let there = surface.normal([uv[0] + share * step[0], uv[1] + share * step[1]]).unwrap();
                        let wanted = turned(&first, &scaled(&axis, share));
                        assert!(length(&sub(&there, &wanted)) < 1e-12, "{surface:?} {step:?}");
                    }
                }
            }
            assert_eq!(told, 3 + 3 + 3 + 3 + 2 + 2 + 1 + 1);
        }
    }

    #[test]
    fn what_turns_over_on_the_way_is_not_said_to_turn() {
        let frame = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let of = |kind: u8, more: &[f64]| Surface::read(kind, &[&frame, more].concat()).unwrap();
        assert!(of(3, &[1.0, 0.5]).turning([0.0, 0.0], [0.0, -5.0]).is_none());
        assert!(of(5, &[1.0, 2.0]).turning([0.0, 0.0], [0.0, 3.0]).is_none());
    }
}
