//! Reads any bytes as a dump of a shape, divides it into pieces and its edges into chords, joins its faces' borders, and
//! looks how far it reaches; then meshes it, and cuts its parts in the middle.
//!
//! Bytes that do not begin like a dump or a stream alter a valid one instead: each three of them are a position and a new
//! value. One byte more alters the stream.

use std::sync::atomic::AtomicUsize;
use std::time::{Duration, Instant};

use hlr_brep::assemble::assemble;
use hlr_brep::body::model_of;
use hlr_brep::bounds::boxes;
use hlr_brep::cut::{Cut, Plane, cut_all};
use hlr_brep::divided::divided;
use hlr_brep::edges::polyline;
use hlr_brep::faces::border;
use hlr_brep::format::IDENTITY;
use hlr_brep::model::Model;
use hlr_brep::reach::reach;
use hlr_brep::tessellate::{ChordErrors, Limits, Watch, tessellate};
use hlr_mesh::tables::Tables;

const GOOD: &[u8] = include_bytes!("../../brep/tests/cylinder_4.bin");
const STREAM: &[u8] = include_bytes!("../../brep/tests/cylinder_stream.bin");
const DEFLECTION: f64 = 0.05;
/// Radians.
const ANGLE: f64 = 0.5;
/// Of the size of a model: the chord error of its mesh, and what counts as on a plane.
const COARSE: f64 = 1e-2;
const NEAR: f64 = 1e-7;
/// A model that reaches farther is refused before it is meshed.
const FARTHEST: f64 = 1e60;
/// Of a mesh, so that a case takes milliseconds.
const SMALL: Limits = Limits { points: 5_000, steps: 50_000 };
/// Whoever waits so long stops a cut, which has no other limits than those of a drawing.
const PATIENCE: Duration = Duration::from_millis(100);

pub fn run(data: &[u8]) {
    if data.starts_with(b"\nOpen CASCADE") || data.starts_with(b"Open CASCADE") || data.starts_with(&STREAM[..3]) {
        return read(data);
    }
    let mut changed = if data.len() % 3 == 1 { STREAM } else { GOOD }.to_vec();
    for &[high, low, value] in data.as_chunks::<3>().0 {
        let at = usize::from(high) << 8 | usize::from(low);
        let length = changed.len();
        changed[at % length] = value;
    }
    read(&changed);
}

fn read(data: &[u8]) {
    if let Ok((model, pieces)) = divided(data, data.len() % 2 == 1) {
        assert!(pieces.iter().flatten().all(|piece| piece.part < model.parts.len()));
    }
    let Ok(model) = Model::read(data, None) else { return };
    let placed: Vec<_> = (0..model.parts.len()).map(|part| (part, IDENTITY)).collect();
    let ends = reach(&model, &placed, [[0.6, 0.8, 0.0], [-0.48, 0.36, 0.8]]);
    assert!(ends.iter().flatten().all(|end| !end.is_nan()));
    let lines: Vec<_> = model.edges.iter().map(|edge| polyline(&model, edge, DEFLECTION, ANGLE)).collect();
    for line in lines.iter().flatten() {
        assert!(line.points.len() > 1 && line.points.len() == line.parameters.len());
        assert!(line.points.iter().flatten().all(|c| c.is_finite()));
        assert!(line.parameters.is_sorted());
    }
    for face in &model.faces {
        let Ok(found) = border(&model, face, &lines, DEFLECTION) else { continue };
        for (points, chords) in found.loops.loops.iter().zip(&found.chords) {
            assert_eq!(points.len(), chords.len());
            assert!(points.iter().all(|p| (p.node as usize) < found.nodes.len()));
        }
    }
    mesh_and_cut(&model);
}

/// Meshes a model, and what is left of its parts by a plane through the middle of each.
fn mesh_and_cut(model: &Model) {
    let boxes = boxes(model);
    let size = |[low, high]: &[[f64; 3]; 2]| (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let largest = boxes.iter().map(size).fold(0.0, f64::max);
    let reached = |[low, high]: &[[f64; 3]; 2]| low[0] > high[0] || low.iter().chain(high).all(|c| c.abs() < FARTHEST);
    if largest <= 0.0 || !boxes.iter().all(reached) {
        return;
    }
    mesh(model, COARSE * largest);
    let begin = Instant::now();
    let middle = |(part, [low, high]): (usize, &[[f64; 3]; 2])| {
        let level = 0.6 * (0.5 * low[0] + 0.5 * high[0]) + 0.8 * (0.5 * low[2] + 0.5 * high[2]);
        let plane = Plane { normal: [0.6, 0.0, 0.8], level, near: NEAR * largest };
        level.is_finite().then_some((part, plane))
    };
    let planes: Vec<_> = boxes.iter().enumerate().filter_map(middle).collect();
    let mut left = Vec::new();
    for cut in cut_all(model, &planes, &|| begin.elapsed() > PATIENCE) {
        if let Cut::Pieces(pieces) = cut {
            left.extend(pieces);
        }
    }
    if !left.is_empty() {
        mesh(&model_of(left, true), COARSE * largest);
    }
}

fn mesh(model: &Model, deflection: f64) {
    let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
    let Ok(meshed) = tessellate(model, &ChordErrors::same(model, deflection), ANGLE, SMALL, &watch) else { return };
    let parts = assemble(model, &meshed);
    assert_eq!(parts.len(), model.parts.len());
    let Ok(tables) = Tables::of_roots(parts, &vec![false; model.faces.len()]) else { return };
    assert!(tables.points.iter().flatten().all(|c| c.is_finite()));
    assert!(tables.triangles.iter().flatten().all(|&i| (i as usize) < tables.points.len()));
}
