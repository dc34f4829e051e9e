//! Which boxes come near another one: where none does, no search is needed.

use super::aabb::{Aabb, Item};
use super::tree::Tree;
use hlr_exact::snap::Grid;

/// Per box (low, high) whether it comes near another one: always true where it does, rarely where it does not. A box
/// that is not finite is near none. None where they lie too far apart for a grid.
pub fn boxes_meet(low: &[[f64; 3]], high: &[[f64; 3]]) -> Option<Vec<bool>> {
    let finite = |i: &usize| low[*i].iter().chain(&high[*i]).all(|c| c.is_finite());
    let used: Vec<usize> = (0..low.len()).filter(finite).collect();
    let corners: Vec<[f64; 3]> = used.iter().flat_map(|&i| [low[i], high[i]]).collect();
    let grid = Grid::uniform_around(&corners)?;
    // One step wider on each side, to cover the rounding.
    let boxes: Vec<Aabb> = used
        .iter()
        .map(|&i| Aabb { low: grid.snap(&low[i]).map(|c| c - 1), high: grid.snap(&high[i]).map(|c| c + 1) })
        .collect();
    let items: Vec<Item> = boxes.iter().enumerate().map(|(k, b)| (*b, k as u32)).collect();
    let tree = Tree::new(&items);
    let mut meets = vec![false; low.len()];
    for (k, &i) in used.iter().enumerate() {
        meets[i] = tree.any(&boxes[k], |other| other as usize != k);
    }
    Some(meets)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_boxes_in_one_plane_meet_where_they_overlap_alone() {
        let low = |x: f64| [x, 0.0, 3.0];
        let high = |x: f64| [x + 0.1, 0.1, 3.0];
        let found = |starts: &[f64]| {
            let [low, high] = [low, high].map(|end| starts.iter().map(|&x| end(x)).collect::<Vec<_>>());
            boxes_meet(&low, &high).unwrap()
        };
        assert_eq!(found(&[0.0, 0.2, 0.4]), [false; 3]);
        assert_eq!(found(&[0.0, 0.05, 0.4]), [true, true, false]);
    }
}
