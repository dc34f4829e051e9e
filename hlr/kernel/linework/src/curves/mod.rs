//! The curves of a drawing as strokes on a decimal grid, and their text as path data of SVG and PDF.
//!
//! 1. `rows`, `arcs`  each line as rows: a grid point and the kind of curve that leads to it
//! 2. `layer`         strokes of one class and visibility, joined where one ends and the next begins
//! 3. `dashes`        the dash pattern fitted to each hidden stroke, by its `length`
//! 4. `svg`, `pdf`    the text

pub mod arcs;
pub mod dashes;
mod digits;
pub mod layer;
mod length;
pub mod pdf;
pub mod rows;
mod strokes;
pub mod svg;
