use super::*;

/// A compound of a cylinder of radius 1 and height 2, in either layout, as OpenCASCADE writes it.
const CYLINDERS: [&[u8]; 2] =
    [include_bytes!("../../tests/cylinder_3.bin"), include_bytes!("../../tests/cylinder_4.bin")];

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
fn no_byte_of_damage_does_more_than_an_error() {
    for bytes in CYLINDERS {
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

#[test]
fn counts_without_bytes_take_no_memory() {
    let text = b"\nOpen CASCADE Topology V4, (c) Open Cascade\nLocations 999999999\n";
    assert_eq!(read(text).err().unwrap().what, "a count that the bytes cannot hold");
}
