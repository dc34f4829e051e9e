//! Reads any bytes as a BREP file, and makes a dump and a model of its pieces.
//!
//! Bytes that do not begin like a file alter a valid one instead: each three of them are a position and a new character.

use hlr_brep::bounds::boxes;
use hlr_brep::format::{Root, merged, pieces, read, read_file};
use hlr_brep::model::Model;

const GOOD: &[u8] = include_bytes!("../../brep/tests/boxes.brep");

pub fn run(data: &[u8]) {
    if data.starts_with(b"CASCADE") || data.starts_with(b"DBRep") || data.starts_with(b"Open") {
        return check(data);
    }
    let mut changed = GOOD.to_vec();
    for &[high, low, value] in data.as_chunks::<3>().0 {
        let at = usize::from(high) << 8 | usize::from(low);
        let length = changed.len();
        changed[at % length] = USUAL[usize::from(value) % USUAL.len()];
    }
    check(&changed);
}

/// What a text is made of.
const USUAL: &[u8] = b"0123456789 -+.e*\n";

fn check(data: &[u8]) {
    let Ok(mut source) = read_file(data, &|| false) else { return };
    let Ok(pieces) = pieces(&mut source.dump) else { return };
    let roots: Vec<Root> = pieces.iter().map(|piece| Root { source: 0, piece }).collect();
    let dump = merged(&[&source], &roots).expect("a dump of what was read");
    assert!(read(&dump).is_ok(), "what is read as a file can be read as a dump");
    if let Ok(model) = Model::read(&dump, None) {
        assert_eq!((boxes(&model).len(), model.parts.len()), (pieces.len(), pieces.len()));
    }
}
