use super::*;

const CYLINDER: &[u8] = include_bytes!("../../tests/cylinder_4.bin");

/// The number of triangles, on so many threads.
fn triangles(threads: usize, deflection: f64, most_points: usize) -> Result<usize, Ended> {
    let model = Model::read(CYLINDER, None).unwrap();
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let limits = Limits { points: most_points, steps: MOST_STEPS };
    let made = pool.install(|| tessellate(&model, &ChordErrors::same(&model, deflection), 0.5, limits, &watch))?;
    Ok(made.faces.iter().map(|face| face.mesh.triangles.len()).sum())
}

#[test]
fn a_face_that_takes_too_many_steps_for_any_mesh_has_none_and_the_others_have() {
    let model = Model::read(CYLINDER, None).unwrap();
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let faults = |most_steps| {
        let made =
            meshed(&model, &ChordErrors::same(&model, 1e-6), 0.5, &AtomicUsize::new(0), most_steps, &watch).unwrap();
        made.faces.into_iter().map(|face| face.fault).collect::<Vec<_>>()
    };
    assert_eq!(faults(MOST_STEPS), [None, None, None]);
    for threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| faults(10_000)), [Some(Fault::TooMuchWork), None, None]);
    }
}

#[test]
fn a_mesh_with_too_many_points_is_refused_on_any_number_of_threads() {
    for threads in [1, 4] {
        assert!(triangles(threads, 1e-6, MOST_POINTS).unwrap() > 5_000);
        for most in [0, 100, 2_000, 10_000] {
            assert_eq!(triangles(threads, 1e-6, most), Err(Ended::TooFine));
        }
        assert_eq!(triangles(threads, 0.01, 1_000), triangles(1, 0.01, MOST_POINTS));
    }
}

#[test]
fn a_triangle_that_gets_no_point_ends_the_work_soon() {
    // Damaged: the loop of face 22, on a sphere, touches and crosses itself. A long chord there has the number of another
    // point, so that its triangle is not known as one of the border.
    let model = Model::read(include_bytes!("../../tests/touching.bin"), None).unwrap();
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let made = tessellate(&model, &ChordErrors::same(&model, 7e-3), 0.5, Limits { steps: 1_000_000, ..LIMITS }, &watch)
        .unwrap();
    assert!(made.faces.iter().all(|face| face.fault != Some(Fault::TooMuchWork)));
    assert!(matches!(made.faces[22].fault, Some(Fault::Crossing(_))));
}
