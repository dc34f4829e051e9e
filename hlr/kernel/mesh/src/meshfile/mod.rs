//! Reads the mesh files STL, OBJ, PLY and OFF: from bytes to points and triangles, without a library.
//!
//! Counts in a header are not trusted: memory grows with what has been read, and an error names what is missing. Faces
//! of more than three corners become triangles here, concave ones too.

pub mod obj;
pub mod off;
pub mod ply;
mod ply_type;
mod polygon;
pub mod stl;
mod text;

/// What a file holds. Each piece is a part of its own; all share the points.
#[derive(Debug, Default, PartialEq)]
pub struct MeshFile {
    pub points: Vec<[f64; 3]>,
    pub pieces: Vec<Piece>,
    pub paint: Paint,
}

#[derive(Debug, Default, PartialEq)]
pub struct Piece {
    /// Empty where the file gives none.
    pub name: String,
    /// Corners as numbers of points; negative or too large where the file names a point that does not exist.
    pub triangles: Vec<[i32; 3]>,
}

/// Colours, red, green, blue and opacity.
#[derive(Debug, Default, PartialEq)]
pub enum Paint {
    #[default]
    None,
    /// One per point.
    Points(Vec<[u8; 4]>),
    /// One per triangle of the only piece.
    Triangles(Vec<[u8; 4]>),
}

/// Why a file cannot be read, worded as the end of a sentence.
#[derive(Debug, PartialEq)]
pub enum Fault {
    /// The file ends too early: "its header announces ...".
    Cut(String),
    /// What is wrong, and where: "line 7 has 2 coordinates instead of 3".
    Broken(String),
    Stopped,
}

/// More points than this have no 32-bit numbers.
pub const MOST_POINTS: usize = i32::MAX as usize;

/// Returns whether to stop; called now and then while reading.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// Lines or rows between two calls of `Stop`.
const PATIENCE: usize = 1 << 14;

/// Asks at regular steps whether to stop.
pub fn polled(step: usize, stop: Stop) -> Result<(), Fault> {
    if step.is_multiple_of(PATIENCE) && stop() { Err(Fault::Stopped) } else { Ok(()) }
}

/// "1 row", "2 rows".
pub fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}
