//! Divides the shape of a file into pieces: each solid, and what lies outside solids together.

use rustc_hash::FxHashSet;

use super::orientation::Orientation;
use super::shapes::{Kind, Sub};
use super::tokens::{Damaged, Read};
use super::{Dump, IDENTITY, MOST_FACTORS, Matrix};

/// A piece in the frame of the shape: shapes with numbers of the table of locations.
#[derive(Clone, Debug)]
pub struct Piece {
    /// One shape without its placement; or where `loose` any number of them, placed, that are drawn as one.
    pub subs: Vec<Sub>,
    pub loose: bool,
    pub place: Matrix,
    pub solid: bool,
}

/// Limit on the shapes that are visited; a file whose nesting has more is damaged.
const MOST: usize = 20_000_000;

/// The pieces of the root shape, without its own placement. None where it has neither faces nor edges.
///
/// # Errors
/// The file nests shapes beyond measure.
pub fn pieces(dump: &mut Dump) -> Read<Vec<Piece>> {
    pieces_of(dump, dump.root)
}

/// The pieces of a shape, without its own placement.
///
/// # Errors
/// Shapes are nested beyond measure.
pub fn pieces_of(dump: &mut Dump, shape: Sub) -> Read<Vec<Piece>> {
    let root = Sub { location: 0, ..shape };
    let kind = rank(&dump.shapes[root.shape as usize].kind);
    if (SOLID..=FACE).contains(&kind) {
        return Ok(vec![Piece { subs: vec![root], loose: false, place: IDENTITY, solid: kind == SOLID }]);
    }
    let solids = found(dump, root, SOLID, None)?;
    let mut loose = found(dump, root, SHELL, Some(SOLID))?;
    loose.extend(found(dump, root, FACE, Some(SHELL))?);
    loose.extend(found(dump, root, EDGE, Some(FACE))?);
    let mut pieces = Vec::new();
    for solid in &solids {
        let place = dump.locations.matrix(solid.location);
        pieces.push(Piece { subs: vec![Sub { location: 0, ..*solid }], loose: false, place, solid: true });
    }
    if !loose.is_empty() {
        let beside = !solids.is_empty();
        let subs = if beside { loose } else { vec![root] };
        pieces.push(Piece { subs, loose: beside, place: IDENTITY, solid: false });
    }
    Ok(pieces)
}

/// Numbers of the underlying faces of shapes, in the order of an explorer; a face counts once in each place.
///
/// # Errors
/// The file nests shapes beyond measure.
pub fn faces(dump: &mut Dump, subs: &[Sub]) -> Read<Vec<u32>> {
    let mut known = FxHashSet::default();
    let mut out = Vec::new();
    for sub in subs {
        for face in found(dump, *sub, FACE, None)? {
            if known.insert((face.shape, face.location)) {
                out.push(face.shape);
            }
        }
    }
    Ok(out)
}

const SOLID: u8 = 2;
const SHELL: u8 = 3;
const FACE: u8 = 4;
const EDGE: u8 = 6;

fn rank(kind: &Kind) -> u8 {
    match kind {
        Kind::Compound => 0,
        Kind::CompSolid => 1,
        Kind::Solid => SOLID,
        Kind::Shell => SHELL,
        Kind::Face { .. } => FACE,
        Kind::Wire => 5,
        Kind::Edge { .. } => EDGE,
        Kind::Vertex { .. } => 7,
    }
}

/// The shapes of a kind within a shape, each place once, as TopExp_Explorer meets them; not those within `avoid`.
fn found(dump: &mut Dump, root: Sub, kind: u8, avoid: Option<u8>) -> Read<Vec<Sub>> {
    let (mut out, mut known, mut stack) = (Vec::new(), FxHashSet::default(), vec![root]);
    let mut left = MOST;
    while let Some(item) = stack.pop() {
        left =
            left.checked_sub(1).ok_or(Damaged { what: "shapes nested beyond measure", at: 0, unsupported: false })?;
        let shape = &dump.shapes[item.shape as usize];
        let own = rank(&shape.kind);
        if Some(own) == avoid || own > kind || !known.insert((item.shape, item.location)) {
            continue;
        }
        if own == kind {
            out.push(item);
            continue;
        }
        for sub in shape.subs.iter().rev() {
            let within = dump.locations.written(sub.location);
            let location = dump.locations.product(item.location, within);
            let orientation = Orientation::compose(item.orientation, sub.orientation);
            stack.push(Sub { shape: sub.shape, orientation, location });
        }
        if dump.locations.factors_in_all() > MOST_FACTORS {
            return Err(Damaged { what: "shapes nested beyond measure", at: 0, unsupported: false });
        }
    }
    Ok(out)
}
