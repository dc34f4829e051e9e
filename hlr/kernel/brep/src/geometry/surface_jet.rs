//! First and second derivatives of surfaces, kind by kind.

use super::curve::Curve;
use super::jet::Jet;
use super::surface::{Frame, Surface};
use super::vector::{Vector, add, along, cross, dot, scaled, sub};
use hlr_exact::elementary::sin_cos;

impl Surface {
    pub fn jet(&self, uv: [f64; 2]) -> Jet {
        let zero = [0.0; 3];
        let [u, v] = uv;
        match self {
            Surface::Plane(_) => {
                let (point, du, dv) = self.d1(uv);
                Jet { point, du, dv, duu: zero, duv: zero, dvv: zero }
            }
            Surface::Cylinder(f, r) => {
                let (out, turn) = f.around(u);
                let point = along(&along(&f.origin(), &out, *r), &f.axis(), v);
                Jet { point, du: scaled(&turn, *r), dv: f.axis(), duu: scaled(&out, -r), duv: zero, dvv: zero }
            }
            Surface::Cone(f, r, sin, cos) => {
                let (out, turn) = f.around(u);
                let radius = r + v * sin;
                Jet {
                    point: along(&along(&f.origin(), &out, radius), &f.axis(), v * cos),
                    du: scaled(&turn, radius),
                    dv: along(&scaled(&out, *sin), &f.axis(), *cos),
                    duu: scaled(&out, -radius),
                    duv: scaled(&turn, *sin),
                    dvv: zero,
                }
            }
            Surface::Sphere(f, r) => Self::ring_jet(f, uv, 0.0, *r),
            Surface::Torus(f, major, minor) => Self::ring_jet(f, uv, *major, *minor),
            Surface::Revolution(origin, axis, curve) => {
                let [p, d, dd] = curve.derivatives(v);
                let (sin, cos) = sin_cos(u);
                let turned = |w: &Vector| {
                    let upright = scaled(axis, dot(axis, w) * (1.0 - cos));
                    along(&along(&upright, w, cos), &cross(axis, w), sin)
                };
                let (arm, dv) = (turned(&sub(&p, origin)), turned(&d));
                let du = cross(axis, &arm);
                let point = add(origin, &arm);
                Jet { point, du, dv, duu: cross(axis, &du), duv: cross(axis, &dv), dvv: turned(&dd) }
            }
            Surface::Extrusion(way, curve) => {
                let [p, du, duu] = curve.derivatives(u);
                Jet { point: along(&p, way, v), du, dv: *way, duu, duv: zero, dvv: zero }
            }
            Surface::Spline(s) => s.jet(u, v),
            Surface::Offset(basis, distance) => Surface::offset_jet(basis, *distance, uv),
        }
    }

    /// A circle of radius `minor`, at the distance `major` from the axis and turned about it.
    fn ring_jet(f: &Frame, [u, v]: [f64; 2], major: f64, minor: f64) -> Jet {
        let (out, turn) = f.around(u);
        let (sin, cos) = sin_cos(v);
        let radius = major + minor * cos;
        Jet {
            point: along(&along(&f.origin(), &out, radius), &f.axis(), minor * sin),
            du: scaled(&turn, radius),
            dv: along(&scaled(&out, -minor * sin), &f.axis(), minor * cos),
            duu: scaled(&out, -radius),
            duv: scaled(&turn, -minor * sin),
            dvv: along(&scaled(&out, -minor * cos), &f.axis(), -minor * sin),
        }
    }

    /// Knots of the parameter u (0) or v (1) between `low` and `high`, ascending, without the ends. Derivatives may
    /// jump there.
    pub fn knots(&self, side: usize, low: f64, high: f64) -> Vec<f64> {
        let within = |knots: &[f64], first: f64, last: f64, period: f64| {
            let mut out = Vec::new();
            let turns = if period > 0.0 {
                (((low - last) / period).floor() as i64).max(-8)..=(((high - first) / period).ceil() as i64).min(8)
            } else {
                0..=0
            };
            for turn in turns {
                out.extend(knots.iter().filter(|&&k| first <= k && k <= last).map(|k| k + turn as f64 * period));
            }
            let near = 1e-9 * (high - low);
            out.retain(|&k| low + near < k && k < high - near);
            out.sort_by(f64::total_cmp);
            out.dedup_by(|a, b| *a - *b <= near);
            out
        };
        match (self, side) {
            (Surface::Revolution(_, _, curve), 1) | (Surface::Extrusion(_, curve), 0) => match curve.as_ref() {
                Curve::Spline(n) => {
                    let (first, last) = n.domain();
                    within(&n.knots, first, last, 0.0)
                }
                _ => Vec::new(),
            },
            (Surface::Spline(s), _) => {
                let (knots, [first, last], period) = s.knots(side);
                within(knots, first, last, period)
            }
            (Surface::Offset(basis, _), _) => basis.knots(side, low, high),
            _ => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::vector::length;
    use super::*;

    fn surfaces() -> Vec<Surface> {
        let frame = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, -0.8, 0.6];
        let of = |kind: u8, more: &[f64]| Surface::read(kind, &[&frame, more].concat()).unwrap();
        let curve = [1.0, 0.0, 0.0, 0.5, 0.0, 1.0, 0.3, 0.2, 0.0];
        let mut spline = vec![2.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        spline.extend([0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0]);
        for i in 0..12u8 {
            let k = f64::from(i);
            spline.extend([f64::from(i / 4), f64::from(i % 4), (k * 1.7).sin(), 1.0 + 0.2 * (k * 0.9).cos()]);
        }
        vec![
            of(1, &[]),
            of(2, &[2.0]),
            of(3, &[2.0, 0.4]),
            of(4, &[3.0]),
            of(5, &[3.0, 1.0]),
            Surface::read(6, &[&[0.1, 0.2, 0.0, 0.0, 0.0, 1.0, 2.0], &curve[..]].concat()).unwrap(),
            Surface::read(7, &[&[0.1, 0.2, 1.0, 2.0], &curve[..]].concat()).unwrap(),
            Surface::read(8, &spline).unwrap(),
            Surface::read(9, &[&[0.3, 5.0], &frame[..], &[3.0, 1.0]].concat()).unwrap(),
        ]
    }

    #[test]
    fn knots_are_those_of_the_curve_or_of_the_surface_and_come_again_after_a_period() {
        let curve = [5.0, 1.0, 2.0, 0.0, 5.0, 5.0, 8.0, 8.0, 1.0, 0.0, 0.0, 1.0, 2.0, 0.0, 1.0, 1.0];
        let line = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let revolved = |of: &[f64]| Surface::read(6, &[&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], of].concat()).unwrap();
        let extruded = |of: &[f64]| [&[0.0, 0.0, 1.0], of].concat();
        let both = |s: &Surface| [0, 1].map(|side| s.knots(side, 0.0, 10.0));
        assert_eq!(both(&revolved(&curve)), [vec![], vec![5.0, 8.0]]);
        assert_eq!(both(&revolved(&line)), [vec![], vec![]]);
        let plain = Surface::read(7, &extruded(&curve)).unwrap();
        assert_eq!(both(&plain), [vec![5.0, 8.0], vec![]]);
        let offset = Surface::read(9, &[&[0.5, 7.0], &extruded(&curve)[..]].concat()).unwrap();
        assert_eq!(both(&offset), both(&plain));
        assert_eq!(both(&Surface::read(7, &extruded(&line)).unwrap()), [vec![], vec![]]);
        // Both ends are excluded.
        assert_eq!(plain.knots(0, 5.0, 8.0), [0.0; 0]);
        // Degree 1, three poles along u, two along v; period 10 along u, none along v.
        let poles: Vec<f64> = (0..6).flat_map(|i| [f64::from(i), f64::from(i * i), 0.0, 1.0]).collect();
        let head = [1.0, 1.0, 3.0, 2.0, 10.0, 0.0, 0.0, 0.0, 4.0, 10.0, 10.0, 0.0, 0.0, 1.0, 1.0];
        let spline = Surface::read(8, &[&head[..], &poles].concat()).unwrap();
        assert_eq!(spline.knots(0, -7.0, 17.0), [-6.0, 0.0, 4.0, 10.0, 14.0]);
        assert_eq!(spline.knots(1, -7.0, 17.0), [0.0, 1.0]);
    }

    #[test]
    fn derivatives_are_those_of_the_points() {
        let h = 1e-5;
        for surface in surfaces() {
            for uv in [[0.3, 0.25], [0.7, 0.8]] {
                let jet = surface.jet(uv);
                let (p, du, dv) = surface.d1(uv);
                let ((_, a, b), (_, c, d)) = (surface.d1([uv[0] + h, uv[1]]), surface.d1([uv[0] - h, uv[1]]));
                let ((_, _, e), (_, _, f)) = (surface.d1([uv[0], uv[1] + h]), surface.d1([uv[0], uv[1] - h]));
                let half = |x: &Vector, y: &Vector| scaled(&sub(x, y), 0.5 / h);
                let pairs = [
                    (jet.point, p),
                    (jet.du, du),
                    (jet.dv, dv),
                    (jet.duu, half(&a, &c)),
                    (jet.duv, half(&b, &d)),
                    (jet.dvv, half(&e, &f)),
                ];
                for (k, (got, want)) in pairs.iter().enumerate() {
                    assert!(length(&sub(got, want)) < 2e-4, "{surface:?} {uv:?} {k}: {got:?} {want:?}");
                }
            }
        }
    }

    #[test]
    fn changes_of_the_normal_are_those_of_normals_beside() {
        let h = 1e-5;
        for surface in surfaces() {
            for uv in [[0.3, 0.25], [0.7, 0.8]] {
                let (normal, changes) = surface.jet(uv).normal().unwrap();
                assert!(length(&sub(&normal, &surface.normal(uv).unwrap())) < 1e-9, "{surface:?}");
                for k in 0..2 {
                    let beside = [-h, h].map(|step| {
                        let mut at = uv;
                        at[k] += step;
                        surface.normal(at).unwrap()
                    });
                    let want = scaled(&sub(&beside[1], &beside[0]), 0.5 / h);
                    assert!(length(&sub(&changes[k], &want)) < 1e-5, "{surface:?} {uv:?} {k}: {changes:?} {want:?}");
                }
            }
        }
    }
}
