//! Reads any bytes as a dump of a shape, divides it into pieces and its edges into chords, joins its faces' borders, and
//! looks how far it reaches.
//!
//! Bytes that do not begin like a dump or a stream alter a valid one instead: each three of them are a position and a new
//! value. One byte more alters the stream.

use hlr_brep::divided::divided;
use hlr_brep::edges::polyline;
use hlr_brep::faces::border;
use hlr_brep::format::IDENTITY;
use hlr_brep::model::Model;
use hlr_brep::reach::reach;

const GOOD: &[u8] = include_bytes!("../../brep/tests/cylinder_4.bin");
const STREAM: &[u8] = include_bytes!("../../brep/tests/cylinder_stream.bin");
const DEFLECTION: f64 = 0.05;
/// Radians.
const ANGLE: f64 = 0.5;

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
}
