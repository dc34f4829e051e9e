use super::*;
use crate::geometry::curve::Curve;
use crate::model::Model;

/// A compound of a cylinder of radius 1 and height 2, in either layout, as OpenCASCADE writes it.
const CYLINDERS: [&[u8]; 2] =
    [include_bytes!("../../tests/cylinder_3.bin"), include_bytes!("../../tests/cylinder_4.bin")];

/// The same as a stream.
const STREAM: &[u8] = include_bytes!("../../tests/cylinder_stream.bin");

/// The same cylinder as text of each version, the first and the last with triangles. Two boxes, one of them mirrored,
/// and a loose face, in a compound of compounds.
const TEXTS: [&[u8]; 4] = [
    include_bytes!("../../tests/cylinder_1.brep"),
    include_bytes!("../../tests/cylinder_2.brep"),
    include_bytes!("../../tests/cylinder_3.brep"),
    include_bytes!("../../tests/boxes.brep"),
];

fn whole(text: &[u8]) -> Vec<u8> {
    let mut source = read_file(text, &|| false).unwrap();
    let pieces = pieces(&mut source.dump).unwrap();
    let roots: Vec<Root> = pieces.iter().map(|piece| Root { source: 0, piece }).collect();
    merged(&[&source], &roots).unwrap()
}

#[test]
fn both_layouts_say_the_same() {
    let [old, new] = CYLINDERS.map(|bytes| read(bytes).unwrap());
    assert_eq!(old.shapes, new.shapes);
    assert_eq!((old.curves, old.curves2, &old.surfaces), (new.curves, new.curves2, &new.surfaces));
    assert_eq!(new.shapes.len(), 14);
    let kinds: Vec<u8> = new.surfaces.iter().flatten().map(|s| s.kind).collect();
    assert_eq!(kinds, [2, 1, 1]);
}

#[test]
fn a_stream_says_the_same() {
    let (found, wanted) = (read(STREAM).unwrap(), read(CYLINDERS[1]).unwrap());
    let kind = |shape: &Shape| match &shape.kind {
        Kind::Edge { tolerance, on, continuity, .. } => (6, *tolerance, on.len(), *continuity),
        Kind::Face { tolerance, .. } => (4, *tolerance, 0, 0),
        Kind::Vertex { tolerance, point } => (7, *tolerance + point[2], 0, 0),
        other => (u8::from(*other != Kind::Wire), 0.0, 0, 0),
    };
    let kinds = |dump: &Dump| dump.shapes.iter().map(|shape| (kind(shape), shape.subs.clone())).collect::<Vec<_>>();
    assert_eq!(kinds(&found), kinds(&wanted));
    assert_eq!(found.root, wanted.root);
    assert_eq!((found.curves.len(), found.curves2.len()), (wanted.curves.len(), wanted.curves2.len()));
    let surfaces = |dump: &Dump| dump.surfaces.iter().flatten().map(|s| s.data.clone()).collect::<Vec<_>>();
    let sorted = |mut all: Vec<Vec<f64>>| {
        all.sort_by(|a, b| a.partial_cmp(b).unwrap());
        all
    };
    assert_eq!(sorted(surfaces(&found)), sorted(surfaces(&wanted)));
    let (found, wanted) = (Model::read(STREAM, None).unwrap(), Model::read(CYLINDERS[1], None).unwrap());
    assert_eq!(crate::bounds::boxes(&found), crate::bounds::boxes(&wanted));
    assert_eq!(found.classes.len(), wanted.classes.len());
}

#[test]
fn a_reference_of_a_stream_leads_back_to_an_item_of_its_kind() {
    // The last reference, to a shape; it is made to lead anywhere else.
    let at = (0..STREAM.len() - 4).rev().find(|&at| STREAM[at] == 2 && STREAM[at + 3] == 7).unwrap();
    let distance = u16::from_le_bytes([STREAM[at + 1], STREAM[at + 2]]);
    for other in (0..2000u16).filter(|other| *other != distance) {
        let mut changed = STREAM.to_vec();
        changed[at + 1..at + 3].copy_from_slice(&other.to_le_bytes());
        if let Ok(dump) = read(&changed) {
            assert!(dump.shapes.iter().enumerate().all(|(i, shape)| shape.subs.iter().all(|s| (s.shape as usize) < i)));
        }
    }
}

#[test]
fn shapes_nested_without_end_are_refused() {
    let open: Vec<u8> = [stream::SHAPES.start, 7, 0].repeat(100_000);
    assert_eq!(read(&open).err().unwrap().what, "shapes nested too deep");
    assert_eq!(read(&[199]).err().unwrap().what, "a line without an end");
}

#[test]
fn a_file_becomes_the_dump_that_opencascade_writes() {
    for text in TEXTS[..3].iter().chain(&CYLINDERS) {
        let (found, wanted) = (read(&whole(text)).unwrap(), read(CYLINDERS[1]).unwrap());
        assert_eq!(found.curves, wanted.curves);
        assert_eq!(found.surfaces, wanted.surfaces);
        assert!(found.shapes.len() >= wanted.shapes.len());
        assert!(found.triangulations.is_empty());
    }
}

#[test]
fn several_files_become_the_parts_of_one() {
    let mut sources: Vec<Source> = [TEXTS[0], TEXTS[3]].map(|text| read_file(text, &|| false).unwrap()).into();
    let pieces: Vec<Vec<Piece>> = sources.iter_mut().map(|source| pieces(&mut source.dump).unwrap()).collect();
    assert_eq!(pieces.iter().map(Vec::len).collect::<Vec<_>>(), [1, 3]);
    assert!(determinant(&pieces[1][1].place) < 0.0, "one of the boxes is mirrored");
    let roots: Vec<Root> = (0..)
        .zip(&pieces)
        .flat_map(|(source, pieces)| pieces.iter().map(move |piece| Root { source, piece }))
        .collect();
    let dump = merged(&[&sources[0], &sources[1]], &roots).unwrap();
    let model = Model::read(&dump, None).unwrap();
    assert_eq!(model.parts.iter().map(|part| part.faces.len()).collect::<Vec<_>>(), [3, 6, 6, 1]);
    assert_eq!(model.parts.iter().map(|part| part.solids).collect::<Vec<_>>(), [1, 1, 1, 0]);
    let boxes = crate::bounds::boxes(&model);
    assert_eq!(boxes[0], [[-1.0, -1.0, 0.0], [1.0, 1.0, 2.0]]);
    assert_eq!(boxes[1], [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]]);
    // The face that is loose is moved up by 7, turned, and moved up by 9.
    assert!(boxes[3][0][2] > 10.5 && boxes[3][1][2] < 11.8, "{:?}", boxes[3]);
}

#[test]
fn no_byte_of_damage_does_more_than_an_error() {
    for bytes in CYLINDERS.into_iter().chain([STREAM]) {
        for end in 0..bytes.len() {
            assert!(read(&bytes[..end]).is_err(), "cut at {end}");
        }
        for at in 0..bytes.len() {
            for flip in [1u8, 0x80, 0xff] {
                let mut changed = bytes.to_vec();
                changed[at] ^= flip;
                let _ = read(&changed);
            }
        }
    }
}

/// The same dump with its root as FreeCAD names it.
fn as_freecad(bytes: &[u8]) -> Vec<u8> {
    let (tables, root) = bytes.split_at(bytes.len() - 9);
    let count = read(bytes).unwrap().shapes.len() as i32;
    let written = i32::from_le_bytes(*root[1..].first_chunk().unwrap());
    let orientation = i32::from(root[0]).to_le_bytes();
    [tables, &(count - written + 1).to_le_bytes(), &root[5..], &orientation].concat()
}

#[test]
fn the_root_of_a_freecad_file_is_the_same_and_its_damage_an_error() {
    for bytes in CYLINDERS {
        let own = as_freecad(bytes);
        assert_eq!(read(&own).unwrap().root, read(bytes).unwrap().root);
        let recorded = |data: &[u8]| read_file(data, &|| false).unwrap().recorded.bytes;
        assert_eq!(recorded(&own), recorded(bytes));
        for at in own.len() - 12..own.len() {
            for value in 0..=255 {
                let mut changed = own.clone();
                changed[at] = value;
                let _ = read(&changed);
            }
        }
        for number in [0, -1, i32::MIN, i32::MAX, read(bytes).unwrap().shapes.len() as i32 + 1] {
            let mut changed = own.clone();
            let at = own.len() - 12;
            changed[at..at + 4].copy_from_slice(&number.to_le_bytes());
            assert!(read(&changed).is_err(), "{number}");
        }
    }
}

#[test]
fn no_damage_to_a_text_does_more_than_an_error() {
    for text in TEXTS {
        let last = text.iter().rposition(|b| *b == b'+' || *b == b'-').unwrap();
        for end in (0..last).step_by(7) {
            assert!(read_file(&text[..end], &|| false).is_err(), "cut at {end}");
        }
        for at in 0..text.len() {
            for new in [[b' ', b'-'], [b'9', b'*'], [b'0', b'2']][at % 3] {
                let mut changed = text.to_vec();
                changed[at] = new;
                if let Ok(mut source) = read_file(&changed, &|| false)
                    && let Ok(pieces) = pieces(&mut source.dump)
                {
                    let roots: Vec<Root> = pieces.iter().map(|piece| Root { source: 0, piece }).collect();
                    let dump = merged(&[&source], &roots).unwrap();
                    // What is read as text can be read again in binary.
                    assert!(read(&dump).is_ok(), "{at} {new}");
                }
            }
        }
    }
}

#[test]
fn counts_without_bytes_take_no_memory() {
    let text = b"\nOpen CASCADE Topology V4, (c) Open Cascade\nLocations 999999999\n";
    assert_eq!(read(text).err().unwrap().what, "a count that the bytes cannot hold");
    let text = b"CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 1\n7 0 0 3 999999 9 \n";
    assert_eq!(read_file(text, &|| false).err().unwrap().what, "a count that the bytes cannot hold");
}

#[test]
fn a_root_among_no_shapes_is_an_error() {
    let text = b"CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 0\nPolygon3D 0\n\
                 PolygonOnTriangulations 0\nSurfaces 0\nTriangulations 0\n\nTShapes 0\n+1 0 *\n";
    assert_eq!(read_file(text, &|| false).err().unwrap().what, "a reference to nothing");
}

#[test]
fn a_direction_that_is_no_unit_vector_is_damage() {
    let ones =
        |bytes: &[u8]| (0..bytes.len() - 8).filter(|&at| bytes[at..at + 8] == 1f64.to_le_bytes()).collect::<Vec<_>>();
    let mut refused = 0;
    for bytes in CYLINDERS {
        for at in ones(bytes) {
            let mut changed = bytes.to_vec();
            changed[at..at + 8].copy_from_slice(&2f64.powi(-32).to_le_bytes());
            refused +=
                usize::from(read(&changed).is_err_and(|damage| damage.what == "a direction whose length is not 1"));
        }
    }
    assert!(refused > 10, "{refused}");
}

#[test]
fn a_rounded_direction_is_a_unit_vector_again() {
    let text = b"CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 2\n\
                 1 0 0 0 2 0 0\n2 0 0 0 0 0 1 1 1e-3 1e-3 0 1 0 5\n";
    let mut text = Text::new(text, &|| false).unwrap();
    locations::read(&mut text).unwrap();
    curves::section(&mut text, Table::Curves2, curves::plane_curve).unwrap();
    let found = curves::section(&mut text, Table::Curves, curves::space_curve).unwrap();
    assert_eq!(found[0], Some(Curve::Line { p: [0.0; 3], a: [1.0, 0.0, 0.0] }));
    let Some(Curve::Ellipse { a, b, .. }) = found[1] else { panic!() };
    assert!((a[0].hypot(a[1]) - 5.0).abs() < 1e-14 && a[2] == 0.0 && (a[0] * b[0] + a[1] * b[1]).abs() < 1e-14);
}

#[test]
fn reading_stops_when_asked() {
    let many = "1 0 0 0 1 0 0\n".repeat(20_000);
    let text = format!("CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 20000\n{many}");
    assert_eq!(read_file(text.as_bytes(), &|| true).err().unwrap().what, "stopped");
    assert_eq!(read_file(text.as_bytes(), &|| false).err().unwrap().what, "Polygon3D");
}
