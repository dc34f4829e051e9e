//! Which pieces of the edges are seen, and where surfaces pass through one another: decided by exact integers.

pub mod clash;
pub mod scan;
