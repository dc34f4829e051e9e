//! Checks the readers of mesh files on any bytes: the result is consistent, and no larger than the bytes allow.

use hlr_mesh::meshfile::{Fault, MeshFile, Paint, obj, off, ply, stl};

/// No reader makes more than this of one byte: a corner of a polygon takes two, and is a triangle at most.
const MOST: usize = 1;

pub fn run(data: &[u8]) {
    for (read, checked) in [(stl::read as Reader, true), (obj::read, true), (off::read, true), (ply::read, false)] {
        if let Ok(found) = read(data, &|| false) {
            check(&found, data.len(), checked);
        }
    }
}

type Reader = fn(&[u8], &(dyn Fn() -> bool + Sync)) -> Result<MeshFile, Fault>;

fn check(found: &MeshFile, bytes: usize, in_range: bool) {
    let triangles: usize = found.pieces.iter().map(|piece| piece.triangles.len()).sum();
    assert!(found.points.len() <= MOST * bytes && triangles <= MOST * bytes);
    let range = 0..found.points.len() as i32;
    if in_range {
        assert!(found.pieces.iter().flat_map(|p| p.triangles.iter().flatten()).all(|v| range.contains(v)));
    }
    match &found.paint {
        Paint::None => {}
        Paint::Points(colors) => assert_eq!(colors.len(), found.points.len()),
        Paint::Triangles(colors) => assert_eq!(colors.len(), triangles),
    }
}
