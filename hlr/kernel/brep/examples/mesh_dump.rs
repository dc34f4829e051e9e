//! Meshes every face of a dump (`BinTools.Write` of a shape without triangles) and prints the result.
//!
//! ```text
//! cargo run --release -p hlr-brep --example mesh_dump -- FILE DEFLECTION [--faults] [--slow] [--kinds] [--only FACE] [--loops FACE] [--driver]
//! ```

use std::collections::BTreeMap;
use std::sync::atomic::AtomicUsize;
use std::time::Instant;

use hlr_brep::edges::polyline;
use hlr_brep::faces::border;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::mesh::{Fault, Progress, border_share, mesh_face};
use hlr_brep::model::Model;
use hlr_brep::tessellate::{ChordErrors, LIMITS, Watch, tessellate};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, deflection, ..] = arguments.as_slice() else { panic!("FILE DEFLECTION") };
    let deflection: f64 = deflection.parse().expect("a length");
    let has = |name: &str| arguments.iter().any(|a| a == name);
    let bytes = std::fs::read(file).expect("a file");
    let start = Instant::now();
    let model = Model::read(&bytes, None).expect("a dump");
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
    let mut bordering = 0.0;
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
        let made = border
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|b| mesh_face(surface, &b.loops, deflection, 0.5, &Progress::free()));
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
            }
            Err(fault) => {
                let name = match &fault {
                    Fault::Crossing(_) => "crossing",
                    Fault::Open => "open",
                    Fault::Degenerate => "degenerate",
                    Fault::TooFine => "too fine",
                    Fault::NotCertified(..) => "not certified",
                    Fault::TooMuchWork => "too much work",
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
}

/// All faces by the driver, on all threads.
fn driven(model: &Model, deflection: f64, parsed: f64) {
    let start = Instant::now();
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let made = tessellate(model, &ChordErrors::same(model, deflection), 0.5, LIMITS, &watch).expect("not stopped");
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
