//! Decides by exact integers which pieces of the edges are visible, and where surfaces pass through one another.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod boxes;
pub mod clash;
pub mod plan;
#[cfg(test)]
mod random;
pub mod scan;
