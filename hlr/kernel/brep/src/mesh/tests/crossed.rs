//! Loops that cross, or lie upon one another.

use std::collections::BTreeMap;

use super::shapes::*;
use crate::geometry::surface::Surface;
use crate::mesh::{FaceLoops, FaceMesh, Progress, mesh_crossed, mesh_face};

/// Loops whose points all have nodes of their own.
fn apart(surface: &Surface, places: &[Vec<[f64; 2]>]) -> FaceLoops {
    let mut found = loops(surface, places);
    found.loops.iter_mut().flatten().zip(0..).for_each(|(point, number)| point.node = number);
    found
}

fn filled(surface: &Surface, loops: &FaceLoops) -> FaceMesh {
    assert!(mesh_face(surface, loops, 0.05, 0.5, &Progress::free()).is_err());
    mesh_crossed(surface, loops, 0.05, 0.5, &Progress::free()).unwrap()
}

/// The area in (u, v).
fn inside(mesh: &FaceMesh) -> f64 {
    mesh.triangles.iter().map(|t| 0.5 * crate::mesh::area(&t.map(|i| mesh.uv[i as usize])).max(0.0)).sum()
}

/// Sides of triangles without a counterpart, less the chords of the loops.
fn open_sides(loops: &FaceLoops, mesh: &FaceMesh) -> usize {
    let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    let mut count = |a: u32, b: u32, by: i32| {
        *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { by } else { -by };
    };
    for t in &mesh.triangles {
        (0..3).for_each(|k| count(t[k], t[(k + 1) % 3], 1));
    }
    let mut start = 0;
    for points in &loops.loops {
        let last = points.len() as u32;
        (0..last).for_each(|k| count(start + k, start + (k + 1) % last, -1));
        start += last;
    }
    sides.values().filter(|count| **count != 0).count()
}

fn square(low: [f64; 2], side: f64, hole: bool) -> Vec<[f64; 2]> {
    let mut around = frame(low, low.map(|x| x + side), 1, 1);
    if hole {
        around.reverse();
    }
    around
}

#[test]
fn holes_with_a_part_of_a_side_in_common_leave_no_gap() {
    let plane = surface(1, &[]);
    for shift in [0.0, 0.5, 1.0] {
        let places =
            [square([0.0, 0.0], 6.0, false), square([1.0, 1.0], 1.0, true), square([2.0, 1.0 + shift], 1.0, true)];
        let face = apart(&plane, &places);
        let mesh = filled(&plane, &face);
        assert!((inside(&mesh) - 34.0).abs() < 1e-9, "{}", inside(&mesh));
        assert_eq!(open_sides(&face, &mesh), 0);
        // Points keep their places and nodes, and come first.
        let points: Vec<_> = face.loops.iter().flatten().collect();
        assert!(points.iter().zip(&mesh.points).all(|(p, q)| p.point == *q));
        assert!(points.iter().map(|p| p.node).eq(mesh.nodes.iter().copied()));
    }
}

#[test]
fn holes_that_overlap_are_one() {
    let plane = surface(1, &[]);
    let places = [square([0.0, 0.0], 6.0, false), square([1.0, 1.0], 2.0, true), square([2.0, 2.5], 2.0, true)];
    assert!((inside(&filled(&plane, &apart(&plane, &places))) - (36.0 - 7.5)).abs() < 1e-9);
    // Turned over, it is the same.
    let turned = places.map(|mut points| {
        points.reverse();
        points
    });
    assert!((inside(&filled(&plane, &apart(&plane, &turned))) - (36.0 - 7.5)).abs() < 1e-9);
}

#[test]
fn a_tail_to_and_fro_encloses_nothing() {
    // Along the upper side to the right and beyond it, and back along other points.
    let tail = [[4.0, 0.0], [4.0, 4.0], [5.0, 4.0], [7.0, 4.0], [6.0, 4.0], [3.5, 4.0], [0.0, 4.0], [0.0, 0.0]];
    for (surface, low) in [(surface(1, &[]), 0.0), (surface(5, &[50.0, 20.0]), 0.1)] {
        let places = [tail.map(|[u, v]| [low + 0.1 * u, low + 0.1 * v]).to_vec()];
        let face = apart(&surface, &places);
        let mesh = filled(&surface, &face);
        assert!((inside(&mesh) - 0.16).abs() < 1e-6, "{}", inside(&mesh));
        assert_eq!(open_sides(&face, &mesh), 0);
    }
}

#[test]
fn edges_that_nearly_lie_upon_one_another_enclose_next_to_nothing() {
    let torus = surface(5, &[50.0, 20.0]);
    let mut random = Random(3);
    for round in [13, 24, 25, 26, 28, 40] {
        let off = 0.1f64.powi(4 + round % 12);
        // An arch from the right to the left, before it a tail along it beyond its end, at other points.
        let mut along = |x: f64| [x, 0.4 + 0.3 * x * (1.0 - x) + off * (random.next() - 0.5)];
        let (count, other) = (60.0, 47.0 + f64::from(round));
        let mut places = vec![[0.0, 0.1], [0.5, 0.1]];
        places.extend((0..=60).map(|k| along(0.5 + 0.5 * f64::from(k) / count)));
        // Closer to one another than the mesher tells points apart.
        let close = |x: f64| (0..4).map(move |k| x - 3e-7 * f64::from(k));
        let back = (1..=47 + round).flat_map(|k| close(1.0 - 0.5 * f64::from(k) / other));
        places.extend(back.map(&mut along));
        places.extend((1..=60).map(|k| along(0.5 - 0.5 * f64::from(k) / count)));
        let face = apart(&torus, &[places]);
        let mesh = filled(&torus, &face);
        // The integral of the arch, above 0.1, from 0 to 0.5.
        assert!((inside(&mesh) - (0.15 + 0.3 / 12.0)).abs() < 1e-4 + off, "{off} {}", inside(&mesh));
    }
}

#[test]
fn a_ring_of_no_width_has_no_area() {
    let plane = surface(1, &[]);
    let places = [circle([0.0, 0.0], 5.0, 40, true), circle([0.0, 0.0], 5.0, 40, false)];
    let face = apart(&plane, &places);
    let mesh = filled(&plane, &face);
    assert!(inside(&mesh) < 1e-12 && mesh.triangles.len() == 80);
    assert_eq!(open_sides(&face, &mesh), 0);
}

/// How often loops run around a place.
fn turns(places: &[Vec<[f64; 2]>], [x, y]: [f64; 2]) -> i32 {
    let mut found = 0;
    for points in places {
        for (k, a) in points.iter().enumerate() {
            let b = points[(k + 1) % points.len()];
            if (a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > x {
                found += if b[1] > a[1] { 1 } else { -1 };
            }
        }
    }
    found
}

#[test]
fn tangles_are_filled_where_they_are_run_around() {
    let (plane, mut random) = (surface(1, &[]), Random(9));
    for round in 0..40 {
        let places: Vec<Vec<[f64; 2]>> = (0..1 + round % 3)
            .map(|_| (0..4 + random.below(6)).map(|_| [0, 1].map(|_| (random.next() * 6.0).round())).collect())
            .collect();
        let Some(mesh) = mesh_crossed(&plane, &apart(&plane, &places), 0.1, 0.5, &Progress::free()) else {
            panic!("{places:?}")
        };
        let signed = |points: &Vec<[f64; 2]>| -> f64 {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
        };
        let sense = if places.iter().map(signed).sum::<f64>() < 0.0 { -1 } else { 1 };
        const STEPS: usize = 60;
        let at = |i: usize| 6.0 * (i as f64 + 0.4817) / STEPS as f64;
        let held = (0..STEPS * STEPS).filter(|i| sense * turns(&places, [at(i / STEPS), at(i % STEPS)]) > 0).count();
        let sampled = 36.0 * held as f64 / (STEPS * STEPS) as f64;
        let found = inside(&mesh);
        assert!((found - sampled).abs() < 0.4, "{found} {sampled} {places:?}");
    }
}
