//! Proves the chord error of every face's finished mesh, and prints what could be proved.
//!
//! ```text
//! cargo run --release -p hlr-brep --example mesh_certificate -- SHARE FILE SIZE [FILE SIZE]... [--faces]
//! ```
//!
//! The deflection is given as a share of the size. Errors are printed in deflections:
//!
//! ```text
//! proved    upper bound on the error of all triangles of curved faces
//! measured  largest error found at a single place
//! above     triangles whose proved bound exceeds the deflection
//! unproved  triangles across the ends of a period, and on surfaces of which only values are known
//! ```

use std::sync::atomic::AtomicUsize;

use hlr_brep::certificate::{Certificate, certify};
use hlr_brep::geometry::surface::Surface;
use hlr_brep::model::Model;
use hlr_brep::tessellate::{ChordErrors, LIMITS, Watch, tessellate};
use rayon::prelude::*;

const ANGLE: f64 = 0.35;

fn main() {
    let (options, arguments): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let [share, rest @ ..] = arguments.as_slice() else { panic!("SHARE FILE SIZE ...") };
    let share: f64 = share.parse().expect("a share");
    println!("{:32} {:>9} {:>9} {:>7} {:>7} {:>9}", "model", "triangles", "proved", "measured", "above", "unproved");
    for pair in rest.chunks_exact(2) {
        let model = Model::read(&std::fs::read(&pair[0]).expect("a file"), None).expect("a dump");
        let deflection = share * pair[1].parse::<f64>().expect("a length");
        let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
        let made =
            tessellate(&model, &ChordErrors::same(&model, deflection), ANGLE, LIMITS, &watch).expect("not stopped");
        let of_faces: Vec<Certificate> = model
            .faces
            .par_iter()
            .zip(&made.faces)
            .map(|(face, meshed)| {
                let curved = face.surface.as_ref().filter(|surface| !matches!(surface, Surface::Plane(_)));
                curved.map_or_else(Certificate::default, |surface| certify(surface, &meshed.mesh, deflection))
            })
            .collect();
        if options.iter().any(|option| option == "--faces") {
            for (number, found) in of_faces.iter().enumerate().filter(|(_, f)| f.above + f.unproved > 0) {
                let kind = format!("{:?}", model.faces[number].surface);
                let kind: String = kind.chars().skip(5).take_while(|c| c.is_alphanumeric()).collect();
                println!("  face {number} {kind}: {}", told(found, deflection));
            }
        }
        let all = of_faces.into_iter().fold(Certificate::default(), Certificate::and);
        println!("{:32} {}", pair[0].rsplit('/').next().unwrap_or_default(), told(&all, deflection));
    }
}

fn told(found: &Certificate, deflection: f64) -> String {
    let Certificate { bound, measured, triangles, above, unproved } = found;
    format!("{triangles:9} {:9.3} {:7.3} {above:7} {unproved:9}", bound / deflection, measured / deflection)
}
