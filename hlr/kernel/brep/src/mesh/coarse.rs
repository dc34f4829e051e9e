//! Triangles of a doubly curved face that are too coarse, and how their errors become smaller.

use super::gap::Gap;
use std::cmp::Ordering;

/// A triangle that exceeds the deflection. It still exists if the triangle of this number still has these corners.
pub struct Coarse {
    pub gap: Gap,
    pub corners: [u32; 3],
    pub number: usize,
}

impl Coarse {
    /// The order of errors, and of corners where these are equal.
    pub fn order(&self, other: &Coarse) -> Ordering {
        self.gap.whole.total_cmp(&other.gap.whole).then(other.corners.cmp(&self.corners))
    }
}

/// When the largest error became smaller the last time, and of which triangle it was then.
pub struct Fall {
    pub least: f64,
    pub corners: [u32; 3],
    pub round: usize,
}
