//! Measures the chord error of each face of a dump against dense samples of its surface, and shows where it comes from.
//!
//! ```text
//! cargo run --release -p hlr-brep --example mesh_error -- FILE DEFLECTION [--all]
//! ```
//!
//! All figures are in deflections; faces with a total above 1 are printed (`--all`: every one):
//!
//! ```text
//! total   distance of surface points within triangles from the triangles around
//! gap     the same with the border's corners moved onto the surface: the part that a finer mesh would reduce
//! corner  distance of the border's corners from the surface at their (u, v)
//! edge    shortest distance of the curves of the face's edges from the surface: the file's own error
//! known   largest tolerance of the face's edges
//! ```

use std::collections::BTreeMap;
use std::sync::atomic::AtomicUsize;

use hlr_brep::faces::near;
use hlr_brep::format::moved;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, cross, dot, length, scaled, sub};
use hlr_brep::mesh::FaceMesh;
use hlr_brep::model::Model;
use hlr_brep::shapes::Face;
use hlr_brep::tessellate::{ChordErrors, LIMITS, Tessellation, Watch, tessellate};

/// Number of places compared along each edge.
const ALONG: usize = 200;
/// Places inside triangles and on their edges, by the weights of two corners.
const PLACES: [[f64; 2]; 13] = [
    [0.33, 0.33],
    [0.5, 0.25],
    [0.25, 0.5],
    [0.25, 0.25],
    [0.45, 0.45],
    [0.1, 0.45],
    [0.45, 0.1],
    [0.5, 0.5],
    [0.5, 0.0],
    [0.0, 0.5],
    [0.25, 0.75],
    [0.75, 0.0],
    [0.0, 0.25],
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, deflection, ..] = arguments.as_slice() else { panic!("FILE DEFLECTION") };
    let deflection: f64 = deflection.parse().expect("a length");
    let all = arguments.iter().any(|a| a == "--all");
    let model = Model::read(&std::fs::read(file).expect("a file"), None).expect("a dump");
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let made = tessellate(&model, &ChordErrors::same(&model, deflection), 0.35, LIMITS, &watch).expect("not stopped");
    let (mut most, mut above, mut real) = ([0.0f64; 2], 0, 0);
    for (number, (face, meshed)) in model.faces.iter().zip(&made.faces).enumerate() {
        let Some(surface) = &face.surface else { continue };
        if let Some(fault) = &meshed.fault {
            println!("  face {number}: {fault}");
        }
        if !meshed.mesh.turned.is_empty() {
            println!("  face {number}: loops {:?} run the wrong way", meshed.mesh.turned);
        }
        if matches!(surface, Surface::Plane(_)) {
            continue;
        }
        let mesh = &meshed.mesh;
        let on: Vec<Vector> = mesh.uv.iter().map(|&uv| surface.point(uv)).collect();
        let [total, gap] = [&mesh.points, &on].map(|points| error(surface, mesh, points, deflection) / deflection);
        most = [most[0].max(total), most[1].max(gap)];
        above += usize::from(total > 1.0);
        real += usize::from(gap > 1.0);
        if total > 1.0 || gap > 1.0 || all {
            let corner = mesh.points.iter().zip(&on).map(|(p, q)| length(&sub(p, q))).fold(0.0, f64::max) / deflection;
            let edge = edge_off(&model, face, surface, &made) / deflection;
            let edges = face.wires.iter().flatten().map(|used| model.edges[used.edge as usize].tolerance);
            let known = edges.fold(0.0, f64::max) / deflection;
            println!(
                "  face {number} {}: total {total:.2} gap {gap:.2} corner {corner:.2} edge {edge:.2} known {known:.2}, {} triangles",
                format!("{surface:?}").split(['(', ' ']).next().unwrap_or_default(),
                mesh.triangles.len()
            );
        }
    }
    let triangles: usize = made.faces.iter().map(|f| f.mesh.triangles.len()).sum();
    println!(
        "{triangles} triangles; total {:.2}, above 1: {above} faces; gap {:.2}, above 1: {real} faces",
        most[0], most[1]
    );
}

/// Greatest distance from surface points within triangles and on their edges to the triangles around. If it exceeds
/// `enough`, the distance to the nearest of all triangles is taken.
fn error(surface: &Surface, mesh: &FaceMesh, points: &[Vector], enough: f64) -> f64 {
    // All corners at a pole count as one.
    let mut at_node = BTreeMap::new();
    let place: Vec<usize> =
        (0..points.len()).map(|i| mesh.nodes.get(i).map_or(i, |&node| *at_node.entry(node).or_insert(i))).collect();
    let mut around = vec![Vec::new(); points.len()];
    for (k, t) in mesh.triangles.iter().enumerate() {
        t.iter().for_each(|&i| around[place[i as usize]].push(k));
    }
    let corners = |k: usize| mesh.triangles[k].map(|i| points[i as usize]);
    let mut worst = 0.0f64;
    for (k, t) in mesh.triangles.iter().enumerate() {
        let uv = t.map(|i| mesh.uv[i as usize]);
        for [x, y] in PLACES {
            let at = [0, 1].map(|k| x * uv[0][k] + y * uv[1][k] + (1.0 - x - y) * uv[2][k]);
            let p = surface.point(at);
            let own = from_triangle(&p, corners(k));
            if own > worst {
                let nearer = |least: f64, k: usize| least.min(from_triangle(&p, corners(k)));
                let beside = t.iter().flat_map(|&i| &around[place[i as usize]]).fold(own, |least, &k| nearer(least, k));
                // At an apex a needle in (u, v) passes over triangles that it does not touch in space.
                let least = if beside > enough { (0..mesh.triangles.len()).fold(beside, nearer) } else { beside };
                worst = worst.max(least);
            }
        }
    }
    worst
}

fn from_triangle(p: &Vector, [a, b, c]: [Vector; 3]) -> f64 {
    let n = cross(&sub(&b, &a), &sub(&c, &a));
    let square = dot(&n, &n);
    let inside = |from: &Vector, to: &Vector| dot(&cross(&sub(to, from), &sub(p, from)), &n) >= 0.0;
    if square > 0.0 && inside(&a, &b) && inside(&b, &c) && inside(&c, &a) {
        return dot(&sub(p, &a), &n).abs() / square.sqrt();
    }
    [(a, b), (b, c), (c, a)].iter().map(|(x, y)| from_segment(p, x, y)).fold(f64::INFINITY, f64::min)
}

fn from_segment(p: &Vector, a: &Vector, b: &Vector) -> f64 {
    let (d, q) = (sub(b, a), sub(p, a));
    let square = dot(&d, &d);
    let t = if square > 0.0 { (dot(&q, &d) / square).clamp(0.0, 1.0) } else { 0.0 };
    length(&sub(&q, &scaled(&d, t)))
}

/// Greatest distance of the face's edges, as curves in space, from its surface.
fn edge_off(model: &Model, face: &Face, surface: &Surface, made: &Tessellation) -> f64 {
    let mut worst = 0.0f64;
    for used in face.wires.iter().flatten() {
        let edge = &model.edges[used.edge as usize];
        let (Some(curve), Some(line)) = (&edge.curve, &made.lines[used.edge as usize]) else { continue };
        let Some((of_surface, range)) = used.curve2 else { continue };
        let Some(of_surface) = &model.curves2[of_surface] else { continue };
        let [first, last] = [line.parameters[0], line.parameters[line.parameters.len() - 1]];
        for k in 0..=ALONG {
            let share = k as f64 / ALONG as f64;
            let point = curve.point(first + share * (last - first));
            let point = used.place.as_ref().map_or(point, |m| moved(m, &point));
            let [u, v, _] = of_surface.point(range[0] + share * (range[1] - range[0]));
            let off = |uv: [f64; 2]| length(&sub(&point, &surface.point(uv)));
            worst = worst.max(near(surface, &point, [u, v]).map_or(off([u, v]), off));
        }
    }
    worst
}
