//! Planes, cylinders, cones, extrusions: no inner points.

use std::f64::consts::{PI, TAU};

use super::shapes::*;
use crate::geometry::surface::Surface;
use crate::mesh::{FaceMesh, Fault, Progress, mesh_face};

fn meshed(surface: &Surface, places: &[Vec<[f64; 2]>], deflection: f64) -> FaceMesh {
    let face = loops(surface, places);
    let mesh = mesh_face(surface, &face, deflection, 0.5, &Progress::free()).unwrap();
    assert!((area(&mesh) - enclosed(&face)).abs() < 1e-9 * enclosed(&face).abs(), "{}", area(&mesh));
    mesh
}

#[test]
fn a_disc_with_holes() {
    let plane = surface(1, &[]);
    let holes =
        [circle([0.0, 0.0], 5.0, 60, true), circle([2.0, 0.0], 1.0, 20, false), circle([-2.0, 1.0], 0.5, 12, false)];
    let mesh = meshed(&plane, &holes, 0.1);
    assert_eq!(mesh.triangles.len(), 92 + 2 * 2 - 2);
    assert_eq!(mesh.points.len(), 92);
}

#[test]
fn corners_in_one_line_have_no_needle_between_them() {
    // The lower chain, below the wider upper side, bulges by less than is visible.
    let low = (0..=8).map(|i| [f64::from(i), -1e-13 * f64::from(i * (8 - i))]);
    let places = [low.chain([[9.0, 4.0], [-1.0, 4.0]]).collect::<Vec<_>>()];
    let mesh = meshed(&surface(1, &[]), &places, 0.1);
    assert_eq!(mesh.triangles.len(), 9);
    for t in &mesh.triangles {
        assert!(crate::mesh::area(&t.map(|i| mesh.uv[i as usize])) > 0.5, "{t:?}");
    }
}

#[test]
fn loops_that_run_the_wrong_way_are_named_and_change_nothing() {
    let plane = surface(1, &[]);
    let round = |forward: [bool; 3]| {
        let [rim, hole, island] = forward;
        let places =
            [circle([0.0, 0.0], 5.0, 40, rim), circle([0.0, 0.0], 3.0, 20, hole), circle([0.0, 0.0], 1.0, 12, island)];
        let mesh = mesh_face(&plane, &loops(&plane, &places), 0.1, 0.5, &Progress::free()).unwrap();
        (area(&mesh), mesh.turned)
    };
    let (right, none) = round([true, false, true]);
    assert!(none.is_empty());
    for (sense, named) in [
        ([false, false, true], vec![0]),
        ([true, true, true], vec![1]),
        ([true, false, false], vec![2]),
        ([false, true, false], vec![0, 1, 2]),
    ] {
        let (area, found) = round(sense);
        assert!((area - right).abs() < 1e-12 * right);
        assert_eq!(found, named);
    }
}

#[test]
fn a_bent_face_with_a_hole_that_runs_the_wrong_way() {
    let torus = surface(5, &[5.0, 2.0]);
    let round = |hole| {
        let places = [frame([0.0, 0.0], [2.0, 2.0], 8, 8), circle([1.0, 1.0], 0.4, 20, hole)];
        mesh_face(&torus, &loops(&torus, &places), 0.05, 0.5, &Progress::free()).unwrap()
    };
    let (right, wrong) = (round(false), round(true));
    assert!(right.turned.is_empty());
    assert_eq!((wrong.turned, wrong.triangles.len()), (vec![1], right.triangles.len()));
}

#[test]
fn a_plate_with_400_holes() {
    let plane = surface(1, &[]);
    let mut places = vec![frame([0.0, 0.0], [20.0, 20.0], 1, 1)];
    for i in 0..20 {
        for j in 0..20 {
            places.push(circle([f64::from(i) + 0.5, f64::from(j) + 0.5], 0.3, 24, false));
        }
    }
    let mesh = meshed(&plane, &places, 0.1);
    assert_eq!(mesh.triangles.len(), 4 + 400 * 24 + 2 * 400 - 2);
}

#[test]
fn islands_in_holes() {
    let rings = (0..10).map(|k| circle([0.0, 0.0], 10.0 - f64::from(k), 16, k % 2 == 0)).collect::<Vec<_>>();
    meshed(&surface(1, &[]), &rings, 0.1);
}

#[test]
fn a_cylinder_with_its_seam() {
    let cylinder = surface(2, &[2.0]);
    let mesh = meshed(&cylinder, &[frame([0.0, 0.0], [TAU, 5.0], 40, 1)], 0.01);
    assert_eq!(mesh.triangles.len(), 80);
    assert!(chord_error(&cylinder, &mesh) < 2.0 * (1.0 - (PI / 40.0).cos()) + 1e-9);
}

#[test]
fn a_cylinder_cut_finer_on_one_end() {
    let cylinder = surface(2, &[2.0]);
    let mut border = frame([0.0, 0.0], [TAU, 5.0], 40, 3);
    border.splice(43..83, frame([0.0, 0.0], [TAU, 5.0], 97, 3)[100..197].iter().copied());
    let mesh = meshed(&cylinder, &[border], 0.01);
    assert!(chord_error(&cylinder, &mesh) < 2.0 * (1.0 - (PI / 40.0).cos()) + 1e-9);
}

#[test]
fn a_half_cylinder_with_an_oval_hole() {
    let cylinder = surface(2, &[2.0]);
    let hole = circle([1.6, 2.5], 1.0, 48, false).iter().map(|p| [p[0], 2.5 + 1.8 * (p[1] - 2.5)]).collect();
    let border = frame([0.0, 0.0], [PI, 5.0], 24, 1);
    let mesh = meshed(&cylinder, &[border, hole], 0.01);
    assert!(chord_error(&cylinder, &mesh) < 2.0 * (1.0 - (PI / 48.0).cos()) + 1e-9);
    assert_eq!(mesh.points.len(), 50 + 48);
}

#[test]
fn a_cone_to_its_apex() {
    // Radius 2 at v = 0; the apex is below.
    let half = 0.4f64;
    let cone = surface(3, &[2.0, half]);
    let apex = -2.0 / half.sin();
    let border = frame([0.0, apex], [TAU, 3.0], 1, 1);
    let mut places = vec![border[0], border[1]];
    places.extend((0..80).map(|k| [TAU * (1.0 - f64::from(k) / 80.0), 3.0]));
    places.push([0.0, 3.0]);
    let face = loops(&cone, &[places]);
    assert_eq!(face.loops[0][0].node, face.loops[0][1].node);
    let mesh = mesh_face(&cone, &face, 0.01, 0.5, &Progress::free()).unwrap();
    assert_eq!(mesh.triangles.len(), 80);
    let radius = 2.0 + 3.0 * half.sin();
    let (error, bound) = (chord_error(&cone, &mesh), radius * (1.0 - (PI / 80.0).cos()));
    assert!(error < 1.001 * bound, "{error} {bound}");
    assert!(mesh.normals.iter().all(|n| (n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9));
}

#[test]
fn a_cone_with_a_coarse_small_end() {
    let half = 0.6f64;
    let cone = surface(3, &[0.5, half]);
    let (far, count) = (9.5 / half.sin(), 90);
    let deflection = 10.0 * half.cos() * (1.0 - (PI / count as f64).cos());
    let small = 24;
    let mut border: Vec<_> = (0..small).map(|k| [TAU * k as f64 / small as f64, 0.0]).collect();
    border.extend((0..=count).map(|k| [TAU * (1.0 - k as f64 / count as f64), far]));
    border.insert(small, [TAU, 0.0]);
    let mesh = meshed(&cone, &[border], deflection * 1.01);
    let error = chord_error(&cone, &mesh);
    // At the border the edge's own error is larger: part of its arc's deviation lies within the surface.
    let limit = deflection / half.cos();
    assert!(error < limit * 1.001, "{error} {limit}");
}

#[test]
fn an_extruded_ellipse() {
    let s = Surface::read(7, &[0.1, 0.2, 1.0, 2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0]).unwrap();
    let mesh = meshed(&s, &[frame([0.0, 0.0], [TAU, 5.0], 100, 1)], 0.01);
    assert_eq!(mesh.triangles.len(), 200);
    assert!(chord_error(&s, &mesh) < 0.01);
}

#[test]
fn loops_that_touch_at_a_vertex() {
    let plane = surface(1, &[]);
    // Two holes share a corner, a third one touches the border.
    let outer = frame([0.0, 0.0], [10.0, 10.0], 2, 2);
    let one = vec![[2.0, 2.0], [2.0, 4.0], [4.0, 4.0], [4.0, 2.0]];
    let two = vec![[4.0, 4.0], [4.0, 6.0], [6.0, 6.0], [6.0, 4.0]];
    let three = vec![[5.0, 0.0], [5.0, 1.0], [6.0, 1.0]];
    meshed(&plane, &[outer, one, two, three], 0.1);
}

/// Two to four holes that share a corner, in all ways in which they can lie around it.
#[test]
fn holes_around_a_corner() {
    let plane = surface(1, &[]);
    let place = |direction: usize| {
        let (angle, radius) = (direction as f64 * TAU / 16.0, [3.0, 4.0][direction % 2]);
        [angle.cos(), angle.sin()].map(|c| (c * radius * 64.0).round() / 64.0)
    };
    // A bit for each of 16 directions: the sides of the holes at the corner, in turns begin and end.
    for chosen in (1u32..1 << 16).filter(|chosen| matches!(chosen.count_ones(), 4 | 6 | 8)).step_by(13) {
        let sides: Vec<usize> = (0..16).filter(|direction| chosen >> direction & 1 == 1).collect();
        for turned in [0, 1] {
            let sides: Vec<usize> =
                sides[turned..].iter().copied().chain(sides[..turned].iter().map(|d| d + 16)).collect();
            let hole = |ends: &[usize]| {
                let rim = (ends[0]..=ends[1]).rev().map(place);
                [[0.0; 2]].into_iter().chain(rim).collect::<Vec<_>>()
            };
            let outer = frame([-10.0, -10.0], [20.0, 20.0], 1, 1);
            meshed(&plane, &std::iter::once(outer).chain(sides.chunks(2).map(hole)).collect::<Vec<_>>(), 0.1);
        }
    }
}

#[test]
fn a_slit() {
    let plane = surface(1, &[]);
    let border = vec![
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 2.0],
        [1.0, 2.0],
        [2.0, 2.5],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let mesh = meshed(&plane, &[border], 0.1);
    assert!(mesh.triangles.len() >= 6);
}

#[test]
fn loops_that_cross() {
    let plane = surface(1, &[]);
    let outer = frame([0.0, 0.0], [10.0, 10.0], 1, 1);
    let hole = vec![[8.0, 8.0], [8.0, 9.0], [11.0, 9.0], [11.0, 8.0]];
    let face = loops(&plane, &[outer.clone(), hole]);
    assert_eq!(
        mesh_face(&plane, &face, 0.1, 0.5, &Progress::free()),
        Err(Fault::Crossing(vec![[0, 1, 1, 1], [0, 1, 1, 3]]))
    );
    let eight = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let face = loops(&plane, &[eight]);
    assert_eq!(mesh_face(&plane, &face, 0.1, 0.5, &Progress::free()), Err(Fault::Crossing(vec![[0, 1, 0, 3]])));
    // A corner on a chord.
    let hole = vec![[8.0, 8.0], [8.0, 9.0], [10.0, 8.5]];
    let face = loops(&plane, &[outer, hole]);
    assert!(matches!(mesh_face(&plane, &face, 0.1, 0.5, &Progress::free()), Err(Fault::Crossing(_))));
}

/// Ends of edges that miss their vertex: points at nearly the same place, in an order that crosses itself.
#[test]
fn neighbours_in_nearly_one_place() {
    let plane = surface(1, &[]);
    let places =
        vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0 + 1e-7], [4.0 + 1e-8, 3.0], [3.0, 3.0], [0.0, 3.0], [1e-8, 3.0]];
    let face = loops(&plane, std::slice::from_ref(&places));
    let mesh = mesh_face(&plane, &face, 0.1, 0.5, &Progress::free()).unwrap();
    // Each point is a node of its own, so each must be in the mesh.
    assert_eq!(mesh.triangles.len(), places.len() - 2);
    assert_eq!(mesh.points, face.loops[0].iter().map(|p| p.point).collect::<Vec<_>>());
    let mut used: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used.len(), places.len());
}

#[test]
fn slivers() {
    let plane = surface(1, &[]);
    let mut places: Vec<_> = (0..=50).map(|k| [f64::from(k), 1e-9 * f64::from(k * (50 - k))]).collect();
    places.reverse();
    places.splice(0..1, [[50.0, -1e-12]]);
    places.extend([[10.0, -1e-9]]);
    meshed(&plane, &[places], 0.1);
}

/// Polygons on a small integer grid, with many coincidences: the result is a proved mesh, or a crossing.
#[test]
fn random_polygons() {
    let plane = surface(1, &[]);
    let mut random = Random(7);
    let (mut sound, mut crossed, mut open) = (0, 0, 0);
    for _ in 0..20_000 {
        let size = 3 + random.below(6);
        let count = 3 + random.below(9);
        let pick = |random: &mut Random| [random.below(size) as f64, random.below(size) as f64];
        let mut places: Vec<[f64; 2]> = (0..count).map(|_| pick(&mut random)).collect();
        if random.below(2) == 0 {
            // Star-shaped about the middle: mostly without crossings.
            let c = 0.5 * size as f64 - 0.4;
            places.sort_by(|a, b| (a[1] - c).atan2(a[0] - c).total_cmp(&(b[1] - c).atan2(b[0] - c)));
        }
        places.dedup();
        if places.len() < 3 || places[0] == places[places.len() - 1] {
            continue;
        }
        let face = loops(&plane, &[places]);
        match mesh_face(&plane, &face, 0.1, 0.5, &Progress::free()) {
            Ok(_) => sound += 1,
            Err(Fault::Crossing(_)) => crossed += 1,
            Err(_) => open += 1,
        }
    }
    assert!(sound > 3000 && crossed > 3000, "{sound} {crossed} {open}");
    assert!(open < 3000, "{open}");
}

/// Many small polygons that do not meet, in any order.
#[test]
fn random_holes() {
    let plane = surface(1, &[]);
    let mut random = Random(99);
    for _ in 0..200 {
        let mut places = vec![frame([0.0, 0.0], [12.0, 12.0], 1 + random.below(9), 1 + random.below(9))];
        for i in 1..12 {
            for j in 1..12 {
                if random.below(3) == 0 {
                    let count = 3 + random.below(12);
                    places.push(circle([f64::from(i), f64::from(j)], 0.1 + 0.39 * random.next(), count, false));
                }
            }
        }
        meshed(&plane, &places, 0.1);
    }
}

/// A quarter of a cylinder, and of a cone, as rational splines that are straight along v or along u.
#[test]
fn splines_that_unroll() {
    let w = std::f64::consts::FRAC_1_SQRT_2;
    for top in [1.0, 0.25, 0.0] {
        let arc = [(1.0, 0.0, 1.0), (1.0, 1.0, w), (0.0, 1.0, 1.0)];
        let pole =
            |&(x, y, w): &(f64, f64, f64), k: f64| [10.0 * x * k, 10.0 * y * k, if k == top { 30.0 } else { 0.0 }, w];
        let ends = [[0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0]];
        let quarter = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let mut along_v = vec![2.0, 1.0, 3.0, 2.0, 0.0, 0.0];
        along_v.extend(quarter.iter().chain(&ends[0]));
        let low = if top == 1.0 { 0.999_999_999_999 } else { 1.0 };
        arc.iter().for_each(|p| along_v.extend([pole(p, low), pole(p, top)].as_flattened()));
        let mut along_u = vec![1.0, 2.0, 2.0, 3.0, 0.0, 0.0];
        along_u.extend(ends[0].iter().chain(&quarter));
        [low, top].iter().for_each(|&k| arc.iter().for_each(|p| along_u.extend(pole(p, k))));
        for (data, frame_of) in [(along_v, [20, 1]), (along_u, [1, 20])] {
            let s = Surface::read(8, &data).unwrap();
            let face = loops(&s, &[frame([0.0, 0.0], [1.0, 1.0], frame_of[0], frame_of[1])]);
            let mesh = mesh_face(&s, &face, 0.02, 0.5, &Progress::free()).unwrap();
            // At an apex only every other triangle has an area.
            assert_eq!(mesh.triangles.len(), if top == 0.0 { 20 } else { 40 });
            assert!(chord_error(&s, &mesh) < 0.02);
        }
    }
}
