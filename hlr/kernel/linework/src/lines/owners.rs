//! Which of two lines is drawn where they run side by side, and whether they may be farther apart than lines that
//! coincide.
//!
//! ```text
//!   ______ ______
//!         |  foot          Where a foot is sunk into a wall by little, its own edge (e) and the intersection line (i) are
//!   wall i|e               both there: seen at right angles to the wall the edge is visible, and seen at a slant the line.
//!         |                They are further apart than lines that coincide, but not so far that both could be read.
//! ```

use super::candidates::About;

/// Whose a line is: its part, and of an intersection line the other one.
#[derive(Clone, Copy, Debug)]
pub struct Owners {
    pub parts: [i32; 2],
    /// An intersection line along which one surface is nowhere deep in the other.
    pub shallow: bool,
}

impl Owners {
    pub fn of(about: &About) -> Owners {
        Owners { parts: [about.part, about.other], shallow: about.shallow }
    }

    /// Whether one of two is a shallow intersection line of the other's part.
    pub fn is_sunk_in(&self, other: &Owners) -> bool {
        (self.shallow || other.shallow) && self.parts.iter().any(|&part| part >= 0 && other.parts.contains(&part))
    }
}

/// A strict order of lines, and whose each is.
#[derive(Clone, Copy)]
pub struct Order<'a> {
    pub rank: &'a [u32],
    pub owners: &'a [Owners],
}

#[cfg(test)]
mod tests {
    use super::super::coincident::uncovered;
    use super::super::gaps::Widths;
    use super::super::{Polyline, View};
    use super::*;

    const VIEW: View = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };
    const WIDTHS: Widths = Widths { same: 0.01, under: 0.1 };
    const FOOT: Owners = Owners { parts: [1, -1], shallow: false };
    const STRANGER: Owners = Owners { parts: [7, -1], shallow: false };
    const SHALLOW: Owners = Owners { parts: [0, 1], shallow: true };
    const DEEP: Owners = Owners { parts: [0, 1], shallow: false };

    /// A level line.
    fn level(from: f64, to: f64, y: f64) -> Polyline {
        let flat = vec![[from, y], [to, y]];
        Polyline { visible: true, space: flat.iter().map(|p| [p[0], p[1], 0.0]).collect(), flat, ..Polyline::default() }
    }

    /// The x of the ends of what is left of an edge from 2 to 6, and of an intersection line from 0 to 10 beside it.
    fn left(edge: Owners, line: Owners) -> Vec<[f64; 2]> {
        let order = Order { rank: &[0, 1], owners: &[edge, line] };
        let found = uncovered(vec![level(2.0, 6.0, 0.05), level(0.0, 10.0, 0.0)], &order, WIDTHS, &VIEW);
        found.iter().map(|line| [line.flat[0][0], line.flat[1][0]]).collect()
    }

    #[test]
    fn a_shallow_intersection_line_is_left_out_beside_an_edge_of_its_part_and_nowhere_else() {
        let found = left(FOOT, SHALLOW);
        assert_eq!(found.len(), 3);
        let [before, after] = [found[1], found[2]];
        assert_eq!((before[0], after[1]), (0.0, 10.0));
        // No gap opens: the line goes on where the edge ends.
        assert!((before[1] - 2.0).abs() <= WIDTHS.same + 1e-9 && (after[0] - 6.0).abs() <= WIDTHS.same + 1e-9);
    }

    #[test]
    fn lines_of_other_parts_and_deep_ones_are_both_drawn() {
        assert_eq!(left(STRANGER, SHALLOW), [[2.0, 6.0], [0.0, 10.0]]);
        assert_eq!(left(FOOT, DEEP), [[2.0, 6.0], [0.0, 10.0]]);
    }
}
