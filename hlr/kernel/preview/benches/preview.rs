//! Frames of a scene of boxes and cylinders: `cargo bench --bench preview [parts]`.

#![allow(clippy::disallowed_methods)]

use std::time::Instant;

use hlr_preview::Model;
use hlr_preview::depth_map::depth_map;
use hlr_preview::faces::faces;
use hlr_preview::lens::Lens;
use hlr_preview::picture::picture;
use hlr_preview::sampling::Sampling;
use hlr_preview::shade::{Light, Scene};
use hlr_preview::workspace::Workspace;

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[derive(Default)]
struct Mesh {
    points: Vec<[f64; 3]>,
    triangles: Vec<[i32; 3]>,
    corner: Vec<[i32; 3]>,
    normals: Vec<[f32; 3]>,
}

/// A prism with this many sides along z, smooth where it is round, then rotated at random.
fn prism(mesh: &mut Mesh, sides: usize, radius: f64, length: f64, centre: [f64; 3], random: &mut Random) {
    let (a, b) = (random.next() * 6.3, random.next() * 6.3);
    let turned = |p: [f64; 3]| {
        let q = [p[0] * a.cos() - p[1] * a.sin(), p[0] * a.sin() + p[1] * a.cos(), p[2]];
        [q[0], q[1] * b.cos() - q[2] * b.sin(), q[1] * b.sin() + q[2] * b.cos()]
    };
    let first = mesh.points.len() as i32;
    for k in 0..sides {
        let angle = std::f64::consts::TAU * k as f64 / sides as f64;
        let (s, c) = angle.sin_cos();
        for z in [-0.5 * length, 0.5 * length] {
            let p = turned([radius * c, radius * s, z]);
            mesh.points.push([0, 1, 2].map(|i| p[i] + centre[i]));
            mesh.normals.push(turned([c, s, 0.0]).map(|v| v as f32));
        }
    }
    let mut add = |t: [i32; 3], smooth: bool| {
        let t = t.map(|i| first + i);
        mesh.triangles.push(t);
        mesh.corner.push(if smooth { t } else { [-1; 3] });
    };
    let n = sides as i32;
    for k in 0..n {
        let m = (k + 1) % n;
        add([2 * k, 2 * m, 2 * m + 1], sides > 8);
        add([2 * k, 2 * m + 1, 2 * k + 1], sides > 8);
        if k > 0 && k < n - 1 {
            add([0, 2 * m, 2 * k], false);
            add([1, 2 * k + 1, 2 * m + 1], false);
        }
    }
}

fn main() {
    let parts: usize = std::env::args().filter_map(|a| a.parse().ok()).next().unwrap_or(4000);
    let side = (parts as f64).cbrt().ceil() as usize;
    let mut random = Random(1);
    let mut mesh = Mesh::default();
    for i in 0..parts {
        let centre = [i % side, i / side % side, i / side / side].map(|c| 20.0 * c as f64);
        let sides = if random.next() < 0.5 { 4 } else { 26 };
        let (radius, length) = (2.0 + 4.0 * random.next(), 4.0 + 8.0 * random.next());
        prism(&mut mesh, sides, radius, length, centre, &mut random);
    }
    let count = mesh.triangles.len();
    let model = Model {
        points: &mesh.points,
        triangles: &mesh.triangles,
        corner: &mesh.corner,
        normals: &mesh.normals,
        paint: &vec![[0; 3]; count],
        colours: &[[0.5, 0.5, 0.5, 1.0]],
        cull: &vec![true; count],
        transparent: &vec![false; count],
    };
    let (d, s) = (1.0 / 3f64.sqrt(), 0.5f64.sqrt());
    let extent = 20.0 * side as f64;
    let lens = Lens {
        right: [s, s, 0.0],
        up: [-d * s, d * s, 2.0 * d * s],
        ahead: [-d, d, -d],
        origin: [0.5 * extent; 3],
        scale: 0.6 * 1080.0 / extent,
        centre: [960.0, 540.0],
        distance: None,
        range: [-extent, extent],
        size: [1920, 1080],
    };
    let scene = Scene {
        model: &model,
        lens: &lens,
        light: Light { toward: [d, -d, d], ambient: 0.2, diffuse: 0.8, specular: 0.0 },
        shadow: None,
        occlusion: None,
    };
    let go = || false;
    let mut space = Workspace::default();
    faces(&model, &lens, &Sampling::CENTRES, &mut space, &go);
    println!("{parts} parts, {count} triangles, {} faces", space.faces());
    let mut pixels = vec![[0u8; 4]; lens.size[0] * lens.size[1]];
    for threads in [1, 2] {
        let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { continue };
        pool.install(|| {
            let mut time = |what: &str, work: &mut dyn FnMut(&mut Workspace)| {
                let mut all: Vec<f64> = (0..15)
                    .map(|_| {
                        let start = Instant::now();
                        work(&mut space);
                        1000.0 * start.elapsed().as_secs_f64()
                    })
                    .collect();
                all.sort_by(f64::total_cmp);
                println!("{threads} threads, {what}: {:.2} ms, best {:.2}", all[7], all[0]);
            };
            time("faces", &mut |space| {
                faces(&model, &lens, &Sampling::CENTRES, space, &go);
            });
            time("depth and owners", &mut |space| drop(depth_map(&model, &lens, space, &go)));
            for (what, sampling) in [("picture", Sampling::CENTRES), ("antialiased", Sampling::SIXTEEN)] {
                time(what, &mut |space| {
                    picture(&scene, &sampling, [1.0; 4], space, &mut pixels, &go);
                });
            }
        });
    }
}
