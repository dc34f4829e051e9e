//! Spheres, tori, splines: chord errors compared with dense samples, and the number of triangles.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::shapes::*;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{cross, dot, sub, unit};
use crate::mesh::{FaceMesh, Progress, mesh_face};

/// Number of chords of an arc that keep half the deflection.
fn chords(radius: f64, angle: f64, deflection: f64) -> usize {
    let step = 2.0 * (1.0 - 0.5 * deflection / radius).acos();
    (angle / step.min(0.5)).ceil() as usize
}

fn meshed(surface: &Surface, places: &[Vec<[f64; 2]>], deflection: f64, most: f64) -> FaceMesh {
    let face = loops(surface, places);
    let mesh = mesh_face(surface, &face, deflection, 0.5, &Progress::free()).unwrap();
    let error = chord_error(surface, &mesh);
    println!("{} triangles, error {:.3} deflections", mesh.triangles.len(), error / deflection);
    assert!(error <= deflection, "{error}");
    // Compared with the number of equilateral triangles that the second fundamental form asks for.
    assert!((mesh.triangles.len() as f64) < most, "{} triangles, {most}", mesh.triangles.len());
    assert!(mesh.normals.iter().all(|n| (n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9));
    mesh
}

/// The loop around a sphere, with its seam and two poles.
fn whole_sphere(steps: usize) -> Vec<[f64; 2]> {
    let rise = |k: usize| -FRAC_PI_2 + PI * k as f64 / steps as f64;
    let mut places = vec![[0.0, -FRAC_PI_2]];
    places.extend((0..=steps).map(|k| [TAU, rise(k)]));
    places.extend((1..=steps).map(|k| [0.0, rise(steps + 1 - k)]));
    places
}

#[test]
fn a_sphere_with_poles_and_seam() {
    for (radius, deflection) in [(10.0, 0.01), (10.0, 0.1), (1.0, 0.05), (10.0, 0.003)] {
        let sphere = surface(4, &[radius]);
        let ideal = 4.0 * PI * radius * radius / (1.299 * 2.0 * radius * deflection);
        let mesh = meshed(&sphere, &[whole_sphere(chords(radius, PI, deflection))], deflection, 1.5 * ideal + 60.0);
        assert!(mesh.points.len() > 10);
    }
}

#[test]
fn a_spherical_cap_without_pole() {
    let sphere = surface(4, &[10.0]);
    let d = 0.01;
    let count = chords(7.0, 1.5, d);
    meshed(&sphere, &[frame([0.3, -0.4], [1.8, 0.9], count, count)], d, 1200.0);
    // A round patch with a round hole.
    meshed(&sphere, &[circle([1.0, 0.2], 0.6, 60, true), circle([1.1, 0.2], 0.1, 16, false)], d, 1200.0);
}

#[test]
fn a_whole_torus() {
    for (major, minor, d) in [(10.0, 3.0, 0.01), (10.0, 3.0, 0.1), (100.0, 1.0, 0.02)] {
        let torus = surface(5, &[major, minor]);
        let border = frame([0.0, 0.0], [TAU, TAU], chords(major + minor, TAU, d), chords(minor, TAU, d));
        meshed(&torus, &[border], d, 1e9);
    }
}

/// At the neck, edges of the stretched chart pass points on the wrong side. A chart that is not stretched takes twelve
/// times as many triangles.
#[test]
fn a_torus_whose_hole_is_nearly_closed() {
    let d = 0.01;
    let border = frame([0.0, 0.0], [TAU, TAU], chords(20.0, TAU, d), chords(10.0, TAU, d));
    let most = meshed(&surface(5, &[10.0, 9.9]), std::slice::from_ref(&border), d, 1e9).triangles.len();
    meshed(&surface(5, &[10.0, 10.0 - 1e-5]), &[border], d, 1.1 * most as f64);
}

#[test]
fn a_fillet_strip_of_a_torus() {
    let torus = surface(5, &[40.0, 2.0]);
    let d = 0.02;
    let border = frame([0.0, 0.0], [FRAC_PI_2, FRAC_PI_2], chords(42.0, FRAC_PI_2, d), chords(2.0, FRAC_PI_2, d));
    meshed(&torus, &[border], d, 1e9);
}

/// The data of a bicubic patch with even knots. `pole`: the place of the pole in row i and column j, and its weight.
fn bicubic(poles: usize, pole: impl Fn(usize, usize) -> [f64; 4]) -> Vec<f64> {
    let mut data = vec![3.0, 3.0, poles as f64, poles as f64, 0.0, 0.0];
    for _ in 0..2 {
        data.extend([0.0; 4]);
        data.extend((1..poles - 3).map(|k| k as f64 / (poles - 3) as f64));
        data.extend([1.0; 4]);
    }
    data.extend((0..poles * poles).flat_map(|k| pole(k / poles, k % poles)));
    data
}

/// A bicubic patch with waves.
pub fn wavy(poles: usize, height: f64, rational: bool) -> Surface {
    let data = bicubic(poles, |i, j| {
        let (x, y) = (10.0 * i as f64 / (poles - 1) as f64, 10.0 * j as f64 / (poles - 1) as f64);
        let w = if rational { 1.0 + 0.3 * ((i * 3 + j * 5) % 4) as f64 } else { 1.0 };
        [x, y, height * ((x * 1.1).sin() + (y * 0.7 + x * 0.3).cos()), w]
    });
    Surface::read(8, &data).unwrap()
}

#[test]
fn a_wavy_patch_with_trimming() {
    for rational in [false, true] {
        let patch = wavy(12, 1.0, rational);
        let d = 0.01;
        let border = circle([0.5, 0.5], 0.45, 400, true);
        let hole = circle([0.4, 0.6], 0.1, 120, false);
        meshed(&patch, &[border, hole], d, 1e9);
        meshed(&patch, &[frame([0.0, 0.0], [1.0, 1.0], 150, 150)], d, 1e9);
    }
}

#[test]
fn a_fine_patch_in_a_coarse_face() {
    // Flat except for one bump.
    let data = bicubic(40, |i, j| {
        let bump = if (18..21).contains(&i) && (25..28).contains(&j) { 2.0 } else { 0.0 };
        let slope = 0.002 * (i * i) as f64;
        [i as f64, j as f64, bump + slope, 1.0]
    });
    let patch = Surface::read(8, &data).unwrap();
    meshed(&patch, &[frame([0.0, 0.0], [1.0, 1.0], 30, 30)], 0.005, 5000.0);
}

#[test]
fn a_bottle_turned_about_an_axis() {
    // An ellipse beside the axis.
    let s =
        Surface::read(6, &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 5.0, 0.0, 0.0, 2.0, 0.0, 0.5, 0.0, 0.0, 4.0]).unwrap();
    let d = 0.01;
    meshed(&s, &[frame([0.0, 0.0], [TAU, TAU], chords(7.0, TAU, d), chords(8.0, TAU, d))], d, 1e9);
}

#[test]
fn an_offset_patch() {
    let waves = bicubic(8, |i, j| {
        let (x, y) = (i as f64, j as f64);
        [x, y, 0.5 * ((x * 0.8).sin() + (y * 0.7).cos()), 1.0]
    });
    let data = [vec![0.4, 8.0], waves].concat();
    let s = Surface::read(9, &data).unwrap();
    meshed(&s, &[frame([0.0, 0.0], [1.0, 1.0], 60, 60)], 0.01, 1e9);
}

/// Greatest angle in radians between neighbouring triangles.
fn turning(mesh: &FaceMesh) -> f64 {
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.points[i as usize]);
        unit(&cross(&sub(&b, &a), &sub(&c, &a)))
    };
    let mut worst = 0.0f64;
    let mut sides = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            sides.insert((t[k], t[(k + 1) % 3]), normal(t));
        }
    }
    for (&(a, b), one) in &sides {
        if let (Some(one), Some(Some(other))) = (one, sides.get(&(b, a))) {
            worst = worst.max(dot(one, other).clamp(-1.0, 1.0).acos());
        }
    }
    worst
}

#[test]
fn neighbours_keep_the_angle_where_the_deflection_is_coarse() {
    let sphere = surface(4, &[100.0]);
    let torus = surface(5, &[100.0, 30.0]);
    let coarse = 8.0;
    let on_sphere = meshed(&sphere, &[whole_sphere(chords(100.0, PI, coarse))], coarse, 1e9);
    let on_torus = meshed(&torus, &[frame([0.0, 0.0], [TAU, TAU], 14, 14)], coarse, 1e9);
    let turns = [turning(&on_sphere), turning(&on_torus)];
    // Where a surface bends in one direction only, triangles are long, and neighbours turn by up to twice as much.
    assert!(turns[0] < 0.5 && turns[1] < 1.0, "{turns:?}");
}
