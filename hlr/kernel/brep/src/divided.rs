//! Divides shapes in memory into pieces, and makes the model of all distinct ones.

use rustc_hash::FxHashMap;

use crate::explore::children;
use crate::format::{Damaged, Matrix, pieces_of, read};
use crate::model::Model;

/// A solid of a shape, or all that lies outside its solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Number of its part in the model.
    pub part: usize,
    pub solid: bool,
    /// Where it stands in its shape.
    pub place: Matrix,
}

/// The model of the pieces of all children of the root, a compound, each distinct piece once; and the pieces of each
/// child, without its placement. Pieces are the same where shape and orientation are.
///
/// # Errors
/// The bytes are damaged, or nest shapes beyond measure.
pub fn divided(bytes: &[u8]) -> Result<(Model, Vec<Vec<Piece>>), Damaged> {
    let mut dump = read(bytes)?;
    let (mut parts, mut numbers, mut found) = (Vec::new(), FxHashMap::default(), Vec::new());
    for child in children(&dump, None)?.into_iter().flatten() {
        let mut own = Vec::new();
        for piece in pieces_of(&mut dump, child)? {
            let next = parts.len();
            let key = piece.subs.first().filter(|_| !piece.loose).map(|sub| (sub.shape, sub.orientation as u8));
            let part = key.map_or(next, |key| *numbers.entry(key).or_insert(next));
            if part == next {
                parts.push(piece.subs);
            }
            own.push(Piece { part, solid: piece.solid, place: piece.place });
        }
        found.push(own);
    }
    Ok((Model::of(dump, &parts)?, found))
}
