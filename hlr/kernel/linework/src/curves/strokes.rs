//! Strokes as rows: points on the decimal grid, and the kind of curve that leads to each.

/// Kinds of rows.
pub const START: u8 = 0;
pub const LINE: u8 = 1;
/// A control point of the curve that the next QUADRATIC or CUBIC row ends.
pub const CONTROL: u8 = 2;
pub const QUADRATIC: u8 = 3;
pub const CUBIC: u8 = 4;
/// The end of an elliptic arc; its shape is in the table of arcs.
pub const ARC: u8 = 5;
/// A whole circle or ellipse. Its centre is the only row of its stroke.
pub const WHOLE: u8 = 6;

/// Radii in steps of 10^-(places + EXTRA) mm, rotation of the first radius in 10^-ROTATION degrees, y up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shape {
    pub radii: [i64; 2],
    pub rotation: i64,
    pub large: bool,
    pub rising: bool,
}

/// Strokes of one layer, in grid steps of 10^-places millimetres, y up.
pub struct Strokes<'a> {
    pub points: &'a [[i64; 2]],
    pub op: &'a [u8],
    /// Per row, index into `arcs`, or -1.
    pub arc: &'a [i32],
    pub arcs: &'a [Shape],
    /// (strokes + 1) offsets into the rows.
    pub starts: &'a [i64],
    pub closed: &'a [bool],
    pub places: usize,
}
