//! Which boxes come near another one: where none does, no search is needed.

use super::aabb::{Aabb, Item};
use super::tree::Tree;
use hlr_exact::snap::Grid;

/// Per box (low, high) whether it comes near another one: always true where it does, rarely where it does not. A box
/// that is not finite is near none. None where they lie too far apart for a grid.
pub fn boxes_meet(low: &[[f64; 3]], high: &[[f64; 3]]) -> Option<Vec<bool>> {
    boxes_of_others_meet(low, high, &(0..low.len() as u32).collect::<Vec<u32>>())
}

/// The same where boxes have owners: whether each comes near one of another owner.
pub fn boxes_of_others_meet(low: &[[f64; 3]], high: &[[f64; 3]], owner: &[u32]) -> Option<Vec<bool>> {
    let finite = |i: &usize| low[*i].iter().chain(&high[*i]).all(|c| c.is_finite());
    let used: Vec<usize> = (0..low.len()).filter(finite).collect();
    let corners: Vec<[f64; 3]> = used.iter().flat_map(|&i| [low[i], high[i]]).collect();
    let grid = Grid::uniform_around(&corners)?;
    // One step wider on each side, to cover the rounding.
    let boxes: Vec<Aabb> = used
        .iter()
        .map(|&i| Aabb { low: grid.snap(&low[i]).map(|c| c - 1), high: grid.snap(&high[i]).map(|c| c + 1) })
        .collect();
    let items: Vec<Item> = boxes.iter().zip(&used).map(|(b, &i)| (*b, i as u32)).collect();
    let tree = Tree::new(&items);
    let owners = tree.only_owners(owner);
    let mut meets = vec![false; low.len()];
    for (own, &i) in boxes.iter().zip(&used) {
        let other = |item: u32| owner[item as usize] != owner[i];
        // Boxes of one owner may all lie upon one another: where there is no other's, none is looked at.
        meets[i] = tree.any_within(own, |node| owners[node] != Some(owner[i]), other);
    }
    Some(meets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::below;

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

    #[test]
    fn finds_what_a_plain_search_finds() {
        let mut random = below(3);
        for (count, owners, size) in [(0, 1, 1), (40, 3, 30), (400, 7, 10), (400, 400, 10)] {
            let mut cube = |_| {
                let low = [random(100), random(100), random(100)];
                [low.map(f64::from), low.map(|c| f64::from(c + random(size)))]
            };
            let boxes: Vec<[[f64; 3]; 2]> = (0..count).map(&mut cube).collect();
            let owner: Vec<u32> = (0..count as u32).map(|i| i % owners).collect();
            let [low, high] = [0, 1].map(|end| boxes.iter().map(|b| b[end]).collect::<Vec<_>>());
            let meet = |a: usize, b: usize| (0..3).all(|k| low[a][k] <= high[b][k] && low[b][k] <= high[a][k]);
            let near = |a: usize| (0..count).any(|b| owner[a] != owner[b] && meet(a, b));
            let wanted: Vec<bool> = (0..count).map(near).collect();
            assert!(count == 0 || wanted.iter().any(|&near| near) && !wanted.iter().all(|&near| near));
            assert_eq!(boxes_of_others_meet(&low, &high, &owner).unwrap(), wanted);
        }
    }

    #[test]
    fn boxes_of_one_owner_upon_one_another_end_soon() {
        // A search through all pairs of the first owner's would take minutes.
        let nested = |i: u32| f64::from(i + 1);
        let count = 300_000;
        let mut high: Vec<[f64; 3]> = (0..count).map(|i| [nested(i); 3]).collect();
        let mut low: Vec<[f64; 3]> = (0..count).map(|i| [-nested(i); 3]).collect();
        let mut owner = vec![0; count as usize];
        low.push([1e6; 3]);
        high.push([1e6 + 1.0; 3]);
        owner.push(1);
        assert!(!boxes_of_others_meet(&low, &high, &owner).unwrap().contains(&true));
    }
}
