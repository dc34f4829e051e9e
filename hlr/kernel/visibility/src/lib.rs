//! Decides by exact integers which pieces of the edges are visible, and where surfaces pass through one another.

pub mod clash;
pub mod scan;
