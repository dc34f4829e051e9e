//! Meshes of faces that may take only so many steps.

use super::curved::wavy;
use super::shapes::*;
use crate::mesh::{FaceMesh, Fault, Interrupted, Progress, mesh_face};

/// The mesh of a wavy patch with a hole, with so many steps.
fn meshed(steps: &Progress) -> Result<FaceMesh, Interrupted> {
    let patch = wavy(12, 1.0, true);
    let face = loops(&patch, &[circle([0.5, 0.5], 0.45, 400, true), circle([0.4, 0.6], 0.1, 120, false)]);
    let mesh = steps.watched(|| mesh_face(&patch, &face, 0.01, 0.5, steps).unwrap())?;
    // Proved to fill the loops; the border is as it was.
    assert!((area(&mesh) - enclosed(&face)).abs() < 1e-9);
    assert!(face.loops.iter().flatten().zip(&mesh.points).all(|(border, point)| border.point == *point));
    let error = chord_error(&patch, &mesh);
    assert!(error <= mesh.unfinished.max(0.01), "{error} {}", mesh.unfinished);
    Ok(mesh)
}

#[test]
fn a_face_that_runs_out_of_steps_keeps_the_mesh_that_it_has() {
    let (whole, never) = (meshed(&Progress::free()).unwrap(), || false);
    let (mut before, mut lost, mut unfinished) = (0, 0, Vec::new());
    for most in (0..400_000).step_by(5_000) {
        match meshed(&Progress::new(&never, None, most)) {
            Err(why) => {
                assert_eq!((why, before), (Interrupted::TooMuch, 0));
                lost += 1;
            }
            Ok(mesh) => {
                assert!(mesh.triangles.len() >= before);
                before = mesh.triangles.len();
                if mesh.unfinished > 0.0 {
                    assert!(mesh.unfinished > 0.01 && before < whole.triangles.len());
                    unfinished.push(mesh.unfinished);
                } else {
                    assert_eq!(mesh, whole);
                }
            }
        }
    }
    assert!(lost > 3 && unfinished.len() > 3 && before == whole.triangles.len(), "{lost} {unfinished:?} {before}");
}

#[test]
fn a_face_that_has_to_end_early_gets_no_more_points() {
    let (never, whole) = (|| false, meshed(&Progress::free()).unwrap());
    let mesh = meshed(&Progress::half_spent(&never, None, 1_000_000)).unwrap();
    assert!(mesh.unfinished > 0.01 && mesh.triangles.len() < whole.triangles.len());
    assert_eq!(meshed(&Progress::half_spent(&never, None, 10_000)), Err(Interrupted::TooMuch));
}

#[test]
fn a_point_of_the_border_far_off_its_sphere_ends_the_work_soon() {
    let sphere = surface(4, &[10.0]);
    let hole = circle([1.0, 0.2], 0.1, 8, false);
    let mut face = loops(&sphere, &[frame([0.3, -0.4], [1.8, 0.9], 40, 40), hole]);
    let far = &mut face.loops[1][3].point;
    far[2] += 3.0;
    let steps = Progress::free();
    let mesh = mesh_face(&sphere, &face, 0.01, 0.5, &steps).unwrap();
    assert!(mesh.unfinished > 0.01 && (area(&mesh) - enclosed(&face)).abs() < 1e-9, "{}", mesh.unfinished);
    assert!(steps.count() < 100_000, "{}", steps.count());
}

#[test]
fn chords_that_cross_are_found_before_points_are_placed() {
    let sphere = surface(4, &[10.0]);
    let mut places = circle([1.0, 0.2], 0.6, 60, true);
    places.swap(20, 22);
    let steps = Progress::free();
    let fault = mesh_face(&sphere, &loops(&sphere, &[places]), 1e-4, 0.5, &steps).unwrap_err();
    assert!(matches!(fault, Fault::Crossing(_)), "{fault:?}");
    assert!(steps.count() < 100_000, "{}", steps.count());
}
