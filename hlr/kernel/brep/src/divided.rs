//! Divides shapes in memory into pieces, and makes the model of all distinct ones.

use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use crate::explore::children;
use crate::format::{Damaged, IDENTITY, Matrix, Sub, chained, pieces_of, read};
use crate::model::Model;

/// A solid of a shape, or all that lies outside its solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Number of its part in the model.
    pub part: usize,
    pub solid: bool,
    /// Where it stands in the model.
    pub place: Matrix,
}

/// The model of the pieces of shapes, each distinct piece once; and the pieces of each shape. The shapes are the root
/// where it stands `alone`, else the children of the root, a compound. Pieces are the same where shape and orientation
/// are.
///
/// # Errors
/// The bytes are damaged, or nest shapes beyond measure.
pub fn divided(bytes: &[u8], alone: bool) -> Result<(Model, Vec<Vec<Piece>>), Damaged> {
    let mut dump = read(bytes)?;
    let shapes: Vec<Sub> = if alone {
        vec![Sub { location: dump.locations.written(dump.root.location), ..dump.root }]
    } else {
        children(&dump, None)?.into_iter().flatten().collect()
    };
    let (mut parts, mut numbers, mut found) = (Vec::new(), FxHashMap::default(), Vec::with_capacity(shapes.len()));
    // By shape and orientation: what it divides into.
    let mut known: FxHashMap<(u32, u8), Vec<Piece>> = FxHashMap::default();
    for shape in shapes {
        let pieces = match known.entry((shape.shape, shape.orientation as u8)) {
            Entry::Occupied(before) => before.into_mut(),
            Entry::Vacant(new) => {
                let mut own = Vec::new();
                for piece in pieces_of(&mut dump, shape)? {
                    let next = parts.len();
                    let key = piece.subs.first().filter(|_| !piece.loose).map(|sub| (sub.shape, sub.orientation as u8));
                    let part = key.map_or(next, |key| *numbers.entry(key).or_insert(next));
                    if part == next {
                        parts.push(piece.subs);
                    }
                    own.push(Piece { part, solid: piece.solid, place: piece.place });
                }
                new.insert(own)
            }
        };
        let outer = dump.locations.matrix(shape.location);
        let placed = |piece: &Piece| Piece { place: within(&outer, &piece.place), ..*piece };
        found.push(pieces.iter().map(placed).collect());
    }
    Ok((Model::of(dump, &parts)?, found))
}

/// The place of what stands at `inner` in something that stands at `outer`.
fn within(outer: &Matrix, inner: &Matrix) -> Matrix {
    if *inner == IDENTITY {
        *outer
    } else if *outer == IDENTITY {
        *inner
    } else {
        chained(outer, inner)
    }
}
