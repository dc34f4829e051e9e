//! Measures the time from a dump to its mesh, in milliseconds on one thread: the shortest of several runs.
//!
//! ```text
//! cargo run --release -p hlr-brep --example mesh_time -- RUNS FILE DEFLECTION [FILE DEFLECTION]...
//! ```
//!
//! Columns: reading with the edges' classes, meshing, putting parts together, triangles, a checksum of the mesh.

use std::hash::{DefaultHasher, Hasher};
use std::sync::atomic::AtomicUsize;
use std::time::Instant;

use hlr_brep::assemble::{PartMesh, assemble};
use hlr_brep::model::Model;
use hlr_brep::tessellate::{ChordErrors, LIMITS, Watch, tessellate};

const ANGLE: f64 = 0.35;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [runs, rest @ ..] = arguments.as_slice() else { panic!("RUNS FILE DEFLECTION ...") };
    let runs: usize = runs.parse().expect("a number of runs");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| {
        for pair in rest.chunks_exact(2) {
            let bytes = std::fs::read(&pair[0]).expect("a file");
            let deflection: f64 = pair[1].parse().expect("a length");
            let mut least = [f64::INFINITY; 3];
            let mut made = Vec::new();
            for _ in 0..runs {
                let start = Instant::now();
                let mut marks = [0.0; 4];
                let mut mark = |k: usize| marks[k] = start.elapsed().as_secs_f64() * 1e3;
                let model = Model::read(&bytes, None).expect("a dump");
                mark(1);
                let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
                let meshed = tessellate(&model, &ChordErrors::same(&model, deflection), ANGLE, LIMITS, &watch)
                    .expect("not stopped");
                mark(2);
                made = assemble(&model, &meshed);
                mark(3);
                for (k, least) in least.iter_mut().enumerate() {
                    *least = least.min(marks[k + 1] - marks[k]);
                }
            }
            let name = pair[0].rsplit('/').next().unwrap_or_default();
            let triangles: usize = made.iter().map(|part| part.triangles.len()).sum();
            let [read, mesh, parts] = least;
            println!("{name:32} {read:9.3} {mesh:9.3} {parts:9.3} {triangles:8} {:016x}", checksum(&made));
        }
    });
}

fn checksum(parts: &[PartMesh]) -> u64 {
    let mut hash = DefaultHasher::new();
    for part in parts {
        part.points.iter().flatten().chain(part.uv.iter().flatten()).for_each(|x| hash.write_u64(x.to_bits()));
        let numbers = part.triangles.iter().flatten().chain(part.corner.iter().flatten());
        numbers.chain(&part.triangle_face).chain(&part.edge_nodes).for_each(|&i| hash.write_i32(i));
        part.edge_index.iter().chain(&part.edge_counts).for_each(|&i| hash.write_i32(i));
        hash.write(&part.edge_class);
    }
    hash.finish()
}
