//! Points and derivatives of the surface at a distance from another one, its basis.
//!
//! A pole of the basis has no normal to be offset along, and beyond it the normals point the other way. Shells of bowls
//! and domes have such faces, and their basis often goes on beyond the pole:
//!
//! ```text
//!   ----.           .----   basis, turned about the axis of a bowl
//!        `--.___.--'
//!   - -.             .- -   at the distance: beyond the pole on the wrong side
//!       `-.___._.--'
//! ```
//!
//! So places at a pole take after places on the side where most of the basis is.

use super::jet::{Jet, upright};
use super::surface::Surface;
use super::vector::{Vector, along, cross, dot, length, scaled, sub, unit};

/// Step of the differences that give second derivatives, in offset distances; at most this share of the range of the
/// parameter: beside a pole the derivative vanishes, and a step of a given length would be many turns.
const STEP: f64 = 1e-3;
/// Share of the way to the middle of the basis on which derivatives at a pole are taken.
const BESIDE: f64 = 1e-6;

/// What is known of a place without second derivatives.
struct Place {
    point: Vector,
    du: Vector,
    dv: Vector,
    normal: Vector,
}

impl Surface {
    /// The point at a distance from `basis`.
    pub fn offset_point(basis: &Surface, distance: f64, uv: [f64; 2]) -> Vector {
        let (point, du, dv) = basis.d1(uv);
        match upright(&du, &dv) {
            Some(normal) => along(&point, &normal, distance),
            None => Self::offset_d1(basis, distance, uv).0,
        }
    }

    /// Point and first derivatives.
    pub fn offset_d1(basis: &Surface, distance: f64, uv: [f64; 2]) -> (Vector, Vector, Vector) {
        let place = place(&basis.jet(uv), basis, distance, uv);
        (place.point, place.du, place.dv)
    }

    /// All derivatives; the second ones by differences of the first ones on both sides.
    pub fn offset_jet(basis: &Surface, distance: f64, uv: [f64; 2]) -> Jet {
        let own = basis.jet(uv);
        let here = place(&own, basis, distance, uv);
        let domain = basis.domain(1.0);
        let between = |side: usize, derivative: &Vector| {
            let [low, high] = domain[side];
            let step = STEP * (distance.abs().max(1e-12) / length(derivative).max(1e-12)).min(high - low);
            let beside = |steps: f64| {
                let mut uv = uv;
                uv[side] += steps * step;
                place(&basis.jet(uv), basis, distance, uv)
            };
            let [mut before, mut after] = [beside(-1.0), beside(1.0)];
            if dot(&before.normal, &after.normal) < 0.0 {
                // Both on the same side of a pole, and neither at it.
                let inward = 1.5 * (f64::midpoint(low, high) - uv[side]).signum();
                [before, after] = [beside(inward - 1.0), beside(inward + 1.0)];
            }
            let change = |of: fn(&Place) -> &Vector| scaled(&sub(of(&after), of(&before)), 0.5 / step);
            [change(|p| &p.du), change(|p| &p.dv)]
        };
        let ([duu, duv], [_, dvv]) = (between(0, &own.du), between(1, &own.dv));
        Jet { point: here.point, du: here.du, dv: here.dv, duu, duv, dvv }
    }
}

/// By Weingarten's equations, from the basis at `uv`.
fn place(own: &Jet, basis: &Surface, distance: f64, uv: [f64; 2]) -> Place {
    let offset = |j: &Jet, normal: Vector, [nu, nv]: [Vector; 2]| Place {
        point: along(&own.point, &normal, distance),
        du: along(&j.du, &nu, distance),
        dv: along(&j.dv, &nv, distance),
        normal,
    };
    if let Some((normal, changes)) = own.normal() {
        return offset(own, normal, changes);
    }
    // The parameter along which the surface leaves the pole; the derivative by the other one vanishes.
    let side = usize::from(dot(&own.du, &own.du) < dot(&own.dv, &own.dv));
    let [low, high] = basis.domain(1.0)[side];
    let way = f64::midpoint(low, high) - uv[side];
    let mut nearby = uv;
    nearby[side] += BESIDE * way;
    let nearby = basis.jet(nearby);
    // Beside the pole the derivative that vanishes is as long as the step, and has the direction of the mixed one.
    let normal = unit(&if side == 1 { cross(&own.duv, &own.dv) } else { cross(&own.du, &own.duv) });
    match (normal, nearby.normal()) {
        (Some(normal), Some((_, changes))) => offset(&nearby, scaled(&normal, way.signum()), changes),
        _ => offset(own, [0.0; 3], [[0.0; 3]; 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const FRAME: [f64; 12] = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, -0.8, 0.6];

    fn sphere(radius: f64) -> Surface {
        Surface::read(4, &[&FRAME[..], &[radius]].concat()).unwrap()
    }

    /// A cap of revolution about z: its meridian is a cubic that begins on the other side of the axis.
    fn cap() -> Surface {
        let meridian = [3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let poles = [[-1.0, 0.2], [2.0, -0.4], [5.0, 0.5], [7.0, 3.0]].map(|[x, z]| [x, 0.0, z, 1.0]);
        let data = [&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 5.0], &meridian[..], poles.as_flattened()].concat();
        Surface::read(6, &data).unwrap()
    }

    #[test]
    fn beside_a_sphere_is_a_sphere_at_its_poles_too() {
        for distance in [-1.0, 0.5] {
            let (offset, wanted) = (Surface::Offset(Box::new(sphere(3.0)), distance), sphere(3.0 + distance));
            for v in [0.3, FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-6, FRAC_PI_2, -FRAC_PI_2] {
                let uv = [0.7, v];
                let (got, want) = (offset.jet(uv), wanted.jet(uv));
                let near = |a: &Vector, b: &Vector, most: f64| {
                    let off = length(&sub(a, b));
                    assert!(off < most, "distance {distance}, v {v}: {a:?} {b:?}");
                };
                near(&got.point, &want.point, 1e-12);
                near(&offset.point(uv), &want.point, 1e-12);
                let firsts = [(got.du, want.du), (got.dv, want.dv)];
                firsts.iter().for_each(|(a, b)| near(a, b, 1e-5));
                let seconds = [(got.duu, want.duu), (got.duv, want.duv), (got.dvv, want.dvv)];
                seconds.iter().for_each(|(a, b)| near(a, b, 5e-3));
            }
        }
    }

    #[test]
    fn where_the_basis_goes_on_beyond_its_pole_second_derivatives_are_those_of_the_face() {
        let basis = cap();
        // The meridian crosses the axis here.
        let radius = |v: f64| basis.point([0.0, v])[0];
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if radius(middle) < 0.0 { low = middle } else { high = middle }
        }
        let offset = Surface::Offset(Box::new(basis.clone()), 0.4);
        let inside = offset.jet([0.3, high + 0.02]);
        for beyond in [0.0, 1e-9, 1e-6, 1e-4] {
            let at = offset.jet([0.3, high + beyond]);
            for (got, want) in [(at.duu, inside.duu), (at.duv, inside.duv), (at.dvv, inside.dvv)] {
                assert!(length(&sub(&got, &want)) < 2.0, "{beyond}: {got:?} {want:?}");
            }
        }
    }
}
