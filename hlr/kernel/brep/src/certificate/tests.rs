use std::f64::consts::{FRAC_PI_2, TAU};

use rayon::prelude::*;

use super::*;
use crate::mesh::tests::shapes::{Random, circle, frame, loops, surface};
use crate::mesh::{Progress, mesh_face};

/// The greatest gap, sampled at many places of each triangle: along the mean normal of its corners or along its own
/// normal, whichever gap is less.
fn sampled(surface: &Surface, mesh: &FaceMesh) -> f64 {
    const STEPS: u32 = 9;
    let of_triangle = |t: &[u32; 3]| {
        let uv = t.map(|i| mesh.uv[i as usize]);
        let points = uv.map(|p| surface.point(p));
        let normals = t.map(|i| mesh.normals[i as usize]);
        let mean = unit(&add(&add(&normals[0], &normals[1]), &normals[2])).unwrap();
        let own = unit(&cross(&sub(&points[1], &points[0]), &sub(&points[2], &points[0])));
        let along = |n: Vector| {
            let places = (0..=STEPS).flat_map(|i| (0..=STEPS - i).map(move |j| [i, j, STEPS - i - j]));
            places.fold(0.0f64, |most, place| {
                let l = place.map(|k| f64::from(k) / f64::from(STEPS));
                let at = [0, 1].map(|k| l[0] * uv[0][k] + l[1] * uv[1][k] + l[2] * uv[2][k]);
                let flat: f64 = (0..3).map(|k| l[k] * dot(&points[k], &n)).sum();
                most.max((dot(&surface.point(at), &n) - flat).abs())
            })
        };
        let own = own.filter(|n| dot(n, &mean) >= UPRIGHT);
        along(mean).min(own.map_or(f64::INFINITY, along))
    };
    mesh.triangles.iter().map(of_triangle).fold(0.0, f64::max)
}

/// A patch of degree 3 over the unit square with a knot in the middle of u, its heights and weights drawn at random.
fn patch(random: &mut Random, weights: f64) -> Surface {
    let mut data = vec![3.0, 3.0, 5.0, 4.0, 0.0, 0.0];
    data.extend([0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]);
    data.extend([0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    for (i, j) in (0..5u8).flat_map(|i| (0..4u8).map(move |j| (i, j))) {
        let weight = 1.0 + weights * random.next();
        data.extend([f64::from(i) / 4.0, f64::from(j) / 3.0, 0.4 * random.next(), weight]);
    }
    Surface::read(8, &data).unwrap()
}

#[test]
fn a_bound_is_never_less_than_the_error_and_comes_near_it() {
    let deflection = 8e-3;
    let mut random = Random(11);
    let square = || frame([0.0, 0.0], [1.0, 1.0], 60, 60);
    let line = [1.0, 1.0, 0.2, 0.0, 1.0, 0.0, 0.3, 0.0, 0.0, 0.0];
    let arc = [2.0, 3.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let spline = |weight: f64| {
        // Degree 2 with a double knot in the middle: the surface has a kink there.
        let knots = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
        let poles = [[2.0, 0.0], [2.5, 0.3], [2.4, 0.6], [2.3, 0.9], [2.0, 1.2]];
        let poles = poles.iter().flat_map(|[x, z]| [*x, 0.0, *z, if *z == 0.3 { weight } else { 1.0 }]);
        [5.0, 2.0, 5.0, 1.0].into_iter().chain(knots).chain(poles).collect::<Vec<_>>()
    };
    let about = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let cases = [
        (surface(2, &[2.0]), frame([0.0, 0.0], [3.0, 1.0], 60, 1)),
        (surface(3, &[2.0, 0.4]), frame([0.0, 0.0], [3.0, 1.0], 70, 1)),
        (surface(4, &[2.0]), frame([0.0, -1.0], [FRAC_PI_2, 1.0], 60, 60)),
        (surface(5, &[3.0, 1.0]), frame([0.0, 0.0], [TAU, TAU], 200, 150)),
        (Surface::read(6, &[&about, &arc[..]].concat()).unwrap(), circle([0.0, 1.0], 0.8, 90, true)),
        (Surface::read(6, &[&about, &line[..]].concat()).unwrap(), frame([0.0, 0.0], [2.0, 1.0], 70, 10)),
        (Surface::read(6, &[&about, &spline(1.0)[..]].concat()).unwrap(), frame([0.0, 0.0], [2.0, 1.0], 70, 60)),
        (Surface::read(6, &[&about, &spline(3.0)[..]].concat()).unwrap(), frame([0.0, 0.0], [2.0, 0.5], 70, 60)),
        (patch(&mut random, 0.0), square()),
        (patch(&mut random, 0.0), circle([0.5, 0.5], 0.4, 120, true)),
        (patch(&mut random, 0.5), square()),
        (patch(&mut random, 3.0), square()),
    ];
    cases.into_par_iter().for_each(|(surface, border)| {
        let mesh = mesh_face(&surface, &loops(&surface, &[border]), deflection, 0.5, &Progress::free()).unwrap();
        let real = sampled(&surface, &mesh);
        for asked in [deflection, 0.6 * deflection] {
            let found = certify(&surface, &mesh, asked);
            assert_eq!(found.unproved, 0);
            assert!(found.bound >= real * (1.0 - 1e-9), "{surface:?}: {} {real}", found.bound);
            assert!(found.bound <= asked.max(1.03 * real), "{surface:?}: {} {real}", found.bound);
            assert_eq!(found.above > 0, found.bound > asked * (1.0 + 1e-9));
        }
        assert_eq!(certify(&surface, &mesh, deflection).above, 0, "{surface:?}");
        assert!(certify(&surface, &mesh, 0.6 * real).above > 0);
    });
}

#[test]
fn a_jump_of_the_slope_counts_only_where_it_is() {
    // Degree 1: two planes that meet at u = 0.5, with and without a kink, with and without weights.
    for (rise, weight) in [(0.3, 1.0), (0.0, 1.0), (0.3, 2.0), (0.0, 2.0)] {
        let mut data = vec![1.0, 1.0, 3.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
        for (u, z) in [(0.0, 0.0), (0.5, rise), (1.0, 0.0)] {
            let w = if u == 0.5 { weight } else { 1.0 };
            data.extend([u, 0.0, z, w, u, 1.0, z, w]);
        }
        let roof = Surface::read(8, &data).unwrap();
        let mesh = |uv: [[f64; 2]; 3]| FaceMesh {
            uv: uv.to_vec(),
            points: uv.map(|p| roof.point(p)).to_vec(),
            normals: uv.map(|p| roof.normal(p).unwrap()).to_vec(),
            triangles: vec![[0, 1, 2]],
            ..FaceMesh::default()
        };
        for (uv, across) in
            [([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]], rise > 0.0), ([[0.0, 0.0], [0.5, 0.0], [0.2, 1.0]], false)]
        {
            let (mesh, found) = (mesh(uv), certify(&roof, &mesh(uv), 1e-3));
            assert_eq!((found.unproved, found.above), (0, usize::from(across)), "{rise} {weight} {uv:?}");
            assert!(found.bound >= sampled(&roof, &mesh) * (1.0 - 1e-9) || !across);
        }
    }
}
