//! Triangles that a mesh lists more than once, as exporters do that list each from both sides.

use std::collections::{BTreeMap, HashMap};

/// Another triangle with the same three corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duplicate {
    pub triangle: u32,
    /// Whether it runs around its corners the other way.
    pub reversed: bool,
}

/// Of each set of triangles with the same corners the one that comes first, and the others.
#[derive(Debug, Default)]
pub struct ListedTwice {
    /// Per first triangle the others, ascending.
    pub copies: BTreeMap<u32, Vec<Duplicate>>,
    later: HashMap<u32, u32>,
}

impl ListedTwice {
    /// Of the triangles for which `asked` holds.
    pub fn of(triangles: &[[i32; 3]], asked: impl Fn(&[i32; 3]) -> bool) -> ListedTwice {
        let (mut first, mut found) = (HashMap::new(), ListedTwice::default());
        for (t, corners) in (0..).zip(triangles).filter(|(_, corners)| asked(corners)) {
            let mut key = *corners;
            key.sort_unstable();
            let of = *first.entry(key).or_insert(t);
            if of != t {
                let reversed = is_even(corners) != is_even(&triangles[of as usize]);
                found.copies.entry(of).or_default().push(Duplicate { triangle: t, reversed });
                found.later.insert(t, of);
            }
        }
        found
    }

    /// Whether an earlier triangle has the same corners.
    pub fn comes_later(&self, triangle: u32) -> bool {
        self.later.contains_key(&triangle)
    }

    /// Whether the triangle is there from both sides.
    pub fn two_sided(&self, triangle: u32) -> bool {
        self.copies.get(&triangle).is_some_and(|copies| copies.iter().any(|copy| copy.reversed))
    }
}

/// Whether the corners, from the lowest on, ascend.
fn is_even(corners: &[i32; 3]) -> bool {
    let lowest = (1..3).fold(0, |best, k| if corners[k] < corners[best] { k } else { best });
    corners[(lowest + 1) % 3] < corners[(lowest + 2) % 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_found_however_their_corners_are_listed() {
        let triangles = [[4, 7, 5], [1, 2, 3], [5, 4, 7], [5, 7, 4], [3, 2, 1], [1, 2, 4]];
        let found = ListedTwice::of(&triangles, |_| true);
        let copy = |triangle, reversed| Duplicate { triangle, reversed };
        assert_eq!(found.copies[&0], [copy(2, false), copy(3, true)]);
        assert_eq!(found.copies[&1], [copy(4, true)]);
        assert_eq!((0..6).filter(|&t| found.comes_later(t)).collect::<Vec<u32>>(), [2, 3, 4]);
        assert_eq!((0..6).filter(|&t| found.two_sided(t)).collect::<Vec<u32>>(), [0, 1]);
        assert!(ListedTwice::of(&triangles, |corners| corners.contains(&9)).copies.is_empty());
    }
}
