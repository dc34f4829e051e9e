//! All methods on one scene: the same picture.

use super::bsp::Tree;
use super::canvas::Canvas;
use super::limits::{Limits, Watch};
use super::prepare::{Bent, screen};
use super::ray_casting::Acceleration;
use super::scan_line::Coherence;
use super::scan_line_z_buffer::Lists;
use super::scene::{Camera, Rule, Scene};
use super::statistics::Statistics;
use super::z_buffer::Nearer;
use super::{bsp, depth_sort, ray_casting, scan_line, scan_line_z_buffer, span_list, warnock, z_buffer};

fn random(state: &mut u64, n: u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    ((*state >> 33) % n) as f64
}

#[test]
fn random_triangles_look_the_same_to_all_methods() {
    let never = || false;
    for seed in 1..60u64 {
        let mut state = seed;
        let points: Vec<[f64; 3]> =
            (0..36).map(|_| [random(&mut state, 41), random(&mut state, 31), random(&mut state, 9)]).collect();
        let corners: Vec<i32> = (0..36).collect();
        let loops: Vec<i32> = (0..=12).map(|k| 3 * k).collect();
        let polygons: Vec<i32> = (0..=12).collect();
        let scene = Scene {
            points: &points,
            corners: &corners,
            loops: &loops,
            polygons: &polygons,
            cull: &[false; 12],
            values: &[],
            rule: Rule::EvenOdd,
            patches: &[],
        };
        let camera = Camera {
            matrix: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]],
            width: 40,
            height: 30,
            front: f64::NEG_INFINITY,
            back: f64::INFINITY,
            near: f64::NEG_INFINITY,
            image_space: true,
        };
        let watch = Watch::new(&never, Limits::NONE);
        let mut statistics = Statistics::default();
        let on = screen(&scene, &camera, Bent::Triangulated, &watch, &mut statistics).unwrap();
        let picture = |name: &str| {
            let mut canvas = Canvas::new(40, 30, false);
            let mut s = Statistics::default();
            let c = &mut canvas;
            match name {
                "z-buffer" => z_buffer::render(&on, c, Nearer::Smaller, &watch, &mut s),
                "larger" => z_buffer::render(&on, c, Nearer::Larger, &watch, &mut s),
                "rows" => scan_line_z_buffer::render(&on, c, Lists::PerPolygon, &watch, &mut s),
                "rows, merged" => scan_line_z_buffer::render(&on, c, Lists::Merged, &watch, &mut s),
                "scan line" => scan_line::render(&on, c, Coherence::BothEnds, &watch, &mut s),
                "spans" => span_list::render(&on, c, &watch, &mut s),
                "warnock" => warnock::render(&on, c, &watch, &mut s),
                "depth sort" => depth_sort::render(&on, c, &watch, &mut s),
                "bsp" => {
                    let tree = Tree::new(&scene, &watch, &mut s).unwrap();
                    bsp::render(&tree, &on, &camera, c, &watch, &mut s)
                }
                "flat" => ray_casting::render(&on, c, Acceleration::Flat, &watch, &mut s),
                "hierarchy" => ray_casting::render(&on, c, Acceleration::Hierarchy, &watch, &mut s),
                "grid" => ray_casting::render(&on, c, Acceleration::Grid, &watch, &mut s),
                _ => ray_casting::render(&on, c, Acceleration::Partition, &watch, &mut s),
            };
            canvas.pixels
        };
        let expected = picture("flat");
        for name in [
            "z-buffer",
            "larger",
            "rows",
            "rows, merged",
            "scan line",
            "spans",
            "warnock",
            "depth sort",
            "bsp",
            "hierarchy",
            "grid",
            "partition",
        ] {
            let found = picture(name);
            let wrong = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
            assert_eq!(wrong, 0, "{name}, seed {seed}: {wrong} pixels");
        }
    }
}
