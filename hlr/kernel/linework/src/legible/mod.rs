//! What a pen can show of a drawing: how close its lines run, and which lines only make a blot.
//!
//! 1. `ink`       the segments and boxes of all lines, in one `grid` of square cells for each visibility, which finds
//!    what lies beside a place
//! 2. `spacing`   how much ink lies at which distance from a line alongside
//! 3. `joints`    which lines meet at their ends
//! 4. `left_out`  figures smaller than the pen, and lines between others closer than the pen
//!
//! Coordinates are rounded to steps of 1/1024 mm first, and lengths of ink are counted in whole steps. So sums do not
//! depend on their order, and the result on no number of threads.

mod grid;
pub mod ink;
mod joints;
pub mod left_out;
pub mod spacing;

#[cfg(test)]
mod tests;
