//! `cargo bench --bench visibility`: the visibility pass on random prisms in a grid of cells, median of nine runs.
//!
//! ```text
//! cargo bench --bench visibility -- 4000 16000    prisms per scene
//! ```

#![allow(clippy::disallowed_methods)]

use std::time::Instant;

use hlr_exact::arithmetic::Exact;
use hlr_mesh::topology::{Topology, topology};
use hlr_visibility::scan::active_edges::crossings;
use hlr_visibility::scan::active_spans::Seeds;
use hlr_visibility::scan::edge_table::EdgeTable;
use hlr_visibility::scan::mesh::{DRAWN, OUTLINE};
use hlr_visibility::scan::own_faces::OwnFaces;
use hlr_visibility::scan::piercing::piercings;
use hlr_visibility::scan::polygon_table::PolygonTable;
use hlr_visibility::scan::scene::{Group, Numbers, Scene as Seen, solve};
use hlr_visibility::scan::sweep::Steps;

/// Sides of the prisms that stand for cylinders. Half of all prisms are cylinders, half are boxes.
const ROUND: usize = 40;

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

struct Scene {
    points: Vec<[f64; 3]>,
    triangles: Vec<[i32; 3]>,
    part: Vec<i32>,
    smooth: Vec<bool>,
}

fn rotation(r: &mut Random) -> [[f64; 3]; 3] {
    let q: Vec<f64> = (0..4).map(|_| r.unit() - 0.5).collect();
    let n = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    let (w, x, y, z) = (q[0] / n, q[1] / n, q[2] / n, q[3] / n);
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

fn prisms(count: usize) -> Scene {
    let mut r = Random(1);
    let cells = (count as f64).cbrt().ceil() as usize;
    let mut scene = Scene { points: vec![], triangles: vec![], part: vec![], smooth: vec![] };
    for i in 0..count {
        let centre = [i % cells, (i / cells) % cells, i / (cells * cells)].map(|k| 20.0 * k as f64);
        let turn = rotation(&mut r);
        let round = r.unit() < 0.5;
        let n = if round { ROUND } else { 4 };
        let (radius, half) = (2.0 + 4.0 * r.unit(), 2.0 + 4.0 * r.unit());
        let first = scene.points.len() as i32;
        for k in 0..2 * n {
            let a = std::f64::consts::TAU * (k % n) as f64 / n as f64;
            let p = [radius * a.cos(), radius * a.sin(), if k < n { -half } else { half }];
            scene.points.push([0, 1, 2].map(|j| centre[j] + (0..3).map(|m| turn[j][m] * p[m]).sum::<f64>()));
        }
        let n = n as i32;
        let mut add = |t: [i32; 3], smooth: bool| {
            scene.triangles.push(t.map(|v| v + first));
            scene.part.push(i as i32);
            scene.smooth.push(smooth);
        };
        for k in 0..n {
            let next = (k + 1) % n;
            add([k, next, n + next], round);
            add([k, n + next, n + k], round);
            if k > 0 && k < n - 1 {
                add([0, next, k], false);
                add([n, n + k, n + next], false);
            }
        }
    }
    scene
}

fn in_view(p: &[f64; 3]) -> [f64; 3] {
    let (h, t, s) = (0.5f64.sqrt(), (1.0f64 / 3.0).sqrt(), (1.0f64 / 6.0).sqrt());
    [h * (p[0] + p[1]), s * (p[1] - p[0] + 2.0 * p[2]), -t * (p[0] - p[1] + p[2])]
}

/// Role per edge. Drawn: where a cap meets a side, or two flat sides meet. Outline: between the sides of a cylinder.
fn roles(scene: &Scene, t: &Topology) -> Vec<u8> {
    let corner = |t: usize, k: usize| scene.points[scene.triangles[t][k] as usize];
    let normal = |t: usize| {
        let (p, q, r) = (corner(t, 0), corner(t, 1), corner(t, 2));
        let (u, v) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let l = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.map(|c| c / l)
    };
    (0..t.edges.len())
        .map(|e| {
            let both = &t.incident[t.offsets[e] as usize..t.offsets[e + 1] as usize];
            let (a, b) = (normal(both[0] as usize), normal(both[1] as usize));
            if (0..3).map(|k| a[k] * b[k]).sum::<f64>() < 0.8 { DRAWN } else { OUTLINE }
        })
        .collect()
}

fn median(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..9)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[4]
}

fn main() {
    let counts: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let counts = if counts.is_empty() { vec![1000, 4000] } else { counts };
    println!("| prisms | triangles | topology | snap | tables | seeds | crossings | piercing | whole call (ms) |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for count in counts {
        let scene = prisms(count);
        let view: Vec<[f64; 3]> = scene.points.iter().map(in_view).collect();
        let t = topology(&scene.triangles, scene.points.len());
        let role = roles(&scene, &t);
        let edge_part: Vec<i32> =
            (0..t.edges.len()).map(|e| scene.part[t.incident[t.offsets[e] as usize] as usize]).collect();
        let groups = vec![Group { cull: true, sound: true, delta: 0.125, cap: 1.0, tight: false }; count];
        let seen = Seen {
            points: &view,
            triangles: &scene.triangles,
            triangle_group: &scene.part,
            edges: &t.edges,
            offsets: &t.offsets,
            incident: &t.incident,
            edge_group: &edge_part,
            crossing: &[],
            role: &role,
            groups: &groups,
        };
        let (mesh, grid) = seen.snapped().expect("finite points");
        let go = || false;
        let topo = median(|| drop(topology(&scene.triangles, scene.points.len())));
        let snap = median(|| drop(view.iter().map(|p| grid.snap(p)).collect::<Vec<_>>()));
        let polygons = PolygonTable::new::<Exact>(&mesh);
        let edges = EdgeTable::new(&mesh, &polygons);
        let tables = median(|| drop(EdgeTable::new(&mesh, &PolygonTable::new::<Exact>(&mesh))));
        let seeds = median(|| drop(Seeds::new::<Exact>(&mesh, &polygons, &edges.drawn, &[], &go)));
        let cross = median(|| drop(crossings::<Exact>(&mesh, &edges.drawn, &edges.contours, &go)));
        let pierce =
            median(|| drop(piercings::<Exact>(&mesh, &polygons, OwnFaces::NONE.slant(&mesh), &edges.drawn, &[], &go)));
        let whole = median(|| drop(solve(&seen, OwnFaces::NONE, Steps::ALL, Numbers::Exact, &go)));
        println!(
            "| {count} | {} | {topo:.1} | {snap:.1} | {tables:.1} | {seeds:.1} | {cross:.1} | {pierce:.1} | {whole:.1} |",
            scene.triangles.len(),
        );
    }
}
