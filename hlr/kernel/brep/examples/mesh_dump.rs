//! Meshes every face of a dump (`BinTools.Write` of a shape without triangles) and prints what came of it.
//!
//! ```text
//! cargo run --release -p hlr-brep --example mesh_dump -- FILE DEFLECTION [--sample] [--faults] [--slow] [--kinds] [--only FACE] [--loops FACE] [--driver]
//! ```

use std::collections::BTreeMap;
use std::sync::atomic::AtomicUsize;
use std::time::Instant;

use hlr_brep::edges::polyline;
use hlr_brep::faces::border;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, cross, dot, length, scaled, sub};
use hlr_brep::mesh::{FaceMesh, Fault, border_share, mesh_face};
use hlr_brep::model::Model;
use hlr_brep::tessellate::{Watch, tessellate};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, deflection, ..] = arguments.as_slice() else { panic!("FILE DEFLECTION") };
    let deflection: f64 = deflection.parse().expect("a length");
    let has = |name: &str| arguments.iter().any(|a| a == name);
    let bytes = std::fs::read(file).expect("a file");
    let start = Instant::now();
    let model = Model::read(&bytes).expect("a dump");
    let parsed = start.elapsed().as_secs_f64();
    if has("--driver") {
        return driven(&model, deflection, parsed);
    }
    let start = Instant::now();
    let mut shares = vec![1.0f64; model.edges.len()];
    for face in &model.faces {
        let share = face.surface.as_ref().map_or(1.0, border_share);
        for used in face.wires.iter().flatten() {
            shares[used.edge as usize] = shares[used.edge as usize].min(share);
        }
    }
    let lines: Vec<_> =
        model.edges.iter().zip(&shares).map(|(e, share)| polyline(&model, e, share * deflection, 0.5)).collect();
    let edges = start.elapsed().as_secs_f64();
    let (mut triangles, mut points, mut kinds, mut faults) = (0, 0, BTreeMap::new(), BTreeMap::new());
    let (mut bordering, mut worst) = (0.0, (0.0f64, 0));
    for (number, face) in model.faces.iter().enumerate() {
        let Some(surface) = &face.surface else {
            *faults.entry("no surface").or_insert(0) += 1;
            continue;
        };
        if let Some(k) = arguments.iter().position(|a| a == "--only")
            && arguments[k + 1].parse() != Ok(number)
        {
            continue;
        }
        let start = Instant::now();
        let border = border(&model, face, &lines, deflection);
        bordering += start.elapsed().as_secs_f64();
        let start = Instant::now();
        let made = border.as_ref().map_err(Clone::clone).and_then(|b| mesh_face(surface, &b.loops, deflection, 0.5));
        let time = start.elapsed().as_secs_f64();
        let entry = kinds.entry(kind(surface)).or_insert((0, 0, 0.0));
        entry.0 += 1;
        entry.2 += time;
        if let Some(k) = arguments.iter().position(|a| a == "--loops")
            && arguments[k + 1].parse() == Ok(number)
        {
            for (i, points) in border.iter().flat_map(|b| &b.loops.loops).enumerate() {
                for (k, p) in points.iter().enumerate() {
                    println!("{i} {k} {:?} {:?} {}", p.uv, p.point, p.node);
                }
            }
        }
        match made {
            Ok(mesh) => {
                entry.1 += mesh.triangles.len();
                triangles += mesh.triangles.len();
                points += mesh.points.len();
                if has("--slow") && time > 0.005 {
                    println!("face {number} {} {} triangles {time:.4} s", kind(surface), mesh.triangles.len());
                }
                if has("--sample") {
                    // What the edges themselves are off the surface is the file's.
                    let points = border.iter().flat_map(|b| b.loops.loops.iter().flatten());
                    let off = points.map(|p| length(&sub(&p.point, &surface.point(p.uv)))).fold(0.0, f64::max);
                    let error = (sampled(surface, &mesh) - off).max(0.0) / deflection;
                    if error > worst.0 {
                        worst = (error, number);
                    }
                    if has("--faults") && error > 1.0 {
                        println!("face {number} {}: {error:.2} deflections", kind(surface));
                    }
                }
            }
            Err(fault) => {
                let name = match &fault {
                    Fault::Crossing(_) => "crossing",
                    Fault::Open => "open",
                    Fault::Degenerate => "degenerate",
                    Fault::TooFine => "too fine",
                    Fault::NotCertified(_) => "not certified",
                };
                *faults.entry(name).or_insert(0) += 1;
                if has("--faults") {
                    let text: String = format!("{fault:?}").chars().take(70).collect();
                    println!("face {number} {} {text}", kind(surface));
                }
            }
        }
    }
    let mesh: f64 = kinds.values().map(|k: &(usize, usize, f64)| k.2).sum();
    println!(
        "{triangles} triangles, {points} points, {} faces; parse {parsed:.4} edges {edges:.4} borders {bordering:.4} mesh {mesh:.4} s; {faults:?}",
        model.faces.len()
    );
    if has("--kinds") {
        for (name, (faces, triangles, time)) in &kinds {
            println!("  {name:10} {faces:6} faces {triangles:8} triangles {:9.1} us", time * 1e6);
        }
    }
    if has("--sample") {
        println!("  worst chord error {:.3} deflections, face {}", worst.0, worst.1);
    }
}

/// All faces by the driver, on all threads.
fn driven(model: &Model, deflection: f64, parsed: f64) {
    let start = Instant::now();
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let made = tessellate(model, deflection, 0.5, &watch).expect("not stopped");
    let time = start.elapsed().as_secs_f64();
    let triangles: usize = made.faces.iter().map(|f| f.mesh.triangles.len()).sum();
    println!("{triangles} triangles, {} faces; parse {parsed:.4} all {time:.4} s", made.faces.len());
    for (number, face) in made.faces.iter().enumerate() {
        if let Some(fault) = &face.fault {
            let name = model.faces[number].surface.as_ref().map_or("none", kind);
            let text: String = format!("{fault:?}").chars().take(90).collect();
            println!("  face {number} {name} {text}");
        }
    }
}

fn kind(surface: &Surface) -> &'static str {
    match surface {
        Surface::Plane(..) => "plane",
        Surface::Cylinder(..) => "cylinder",
        Surface::Cone(..) => "cone",
        Surface::Sphere(..) => "sphere",
        Surface::Torus(..) => "torus",
        Surface::Revolution(..) => "revolution",
        Surface::Extrusion(..) => "extrusion",
        Surface::Spline(..) => "spline",
        Surface::Offset(..) => "offset",
    }
}

/// Greatest distance of surface points amid triangles and their edges to the triangles around.
fn sampled(surface: &Surface, mesh: &FaceMesh) -> f64 {
    let from_segment = |p: &Vector, a: &Vector, b: &Vector| {
        let (d, q) = (sub(b, a), sub(p, a));
        let square = dot(&d, &d);
        let t = if square > 0.0 { (dot(&q, &d) / square).clamp(0.0, 1.0) } else { 0.0 };
        length(&sub(&q, &scaled(&d, t)))
    };
    let from_triangle = |p: &Vector, [a, b, c]: [Vector; 3]| {
        let n = cross(&sub(&b, &a), &sub(&c, &a));
        let square = dot(&n, &n);
        let inside = |from: &Vector, to: &Vector| dot(&cross(&sub(to, from), &sub(p, from)), &n) >= 0.0;
        if square > 0.0 && inside(&a, &b) && inside(&b, &c) && inside(&c, &a) {
            return dot(&sub(p, &a), &n).abs() / square.sqrt();
        }
        [(a, b), (b, c), (c, a)].iter().map(|(x, y)| from_segment(p, x, y)).fold(f64::INFINITY, f64::min)
    };
    // All corners at a pole are one.
    let mut at_node = BTreeMap::new();
    let place: Vec<usize> = (0..mesh.points.len())
        .map(|i| mesh.nodes.get(i).map_or(i, |&node| *at_node.entry(node).or_insert(i)))
        .collect();
    let mut around = vec![Vec::new(); mesh.points.len()];
    for (k, t) in mesh.triangles.iter().enumerate() {
        t.iter().for_each(|&i| around[place[i as usize]].push(k));
    }
    let corners = |k: usize| mesh.triangles[k].map(|i| mesh.points[i as usize]);
    let mut worst = 0.0f64;
    for (k, t) in mesh.triangles.iter().enumerate() {
        let uv = t.map(|i| mesh.uv[i as usize]);
        for [x, y] in [[0.33, 0.33], [0.5, 0.25], [0.25, 0.5], [0.25, 0.25], [0.45, 0.45], [0.1, 0.45], [0.45, 0.1]] {
            let at = [0, 1].map(|k| x * uv[0][k] + y * uv[1][k] + (1.0 - x - y) * uv[2][k]);
            let p = surface.d1(at).0;
            let own = from_triangle(&p, corners(k));
            if own > worst {
                let beside = t.iter().flat_map(|&i| &around[place[i as usize]]);
                worst = worst.max(beside.fold(own, |least, &k| least.min(from_triangle(&p, corners(k)))));
            }
        }
    }
    worst
}
