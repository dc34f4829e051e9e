//! Turns faces of a part that look the other way than their neighbours.
//!
//! Each face of a compound of loose faces is turned as its surface happens to be. Where two of them go on smoothly as one
//! another, and one looks outward and the other inward, the edge between them would count as a crease.
//!
//! A mirror image of a body is inside out, and is turned for that. Among sewn faces single ones may be placed as mirror
//! images: such a face has been sewn as it looks now, and must not be turned once more.

use crate::explore::{Part, PlacedUse};
use crate::format::Orientation;

/// A face beside another, and whether one of them has to be turned for both to look the same way.
type Neighbour = (u32, bool);

/// Turns the fewer faces of each set that hangs together. A set in which no choice lets all agree stays as it is, as a
/// Moebius strip. All faces of a set count as mirrored, or none, as most of them are. In a solid a face that looks the
/// other way is a defect, which is told.
pub fn turn_to_agree(part: &mut Part) {
    if part.solids > 0 {
        return;
    }
    let pairs = pairs(part);
    let mirrored = part.faces.iter().filter(|face| face.mirrored).count();
    let mixed = mirrored > 0 && mirrored < part.faces.len();
    if !mixed && !pairs.iter().any(|&(_, _, differs)| differs) {
        return;
    }
    let mut beside: Vec<Vec<Neighbour>> = vec![Vec::new(); part.faces.len()];
    for &(one, other, differs) in &pairs {
        beside[one as usize].push((other, differs));
        beside[other as usize].push((one, differs));
    }
    let mut turned: Vec<Option<bool>> = vec![None; part.faces.len()];
    for first in 0..part.faces.len() as u32 {
        if turned[first as usize].is_some() {
            continue;
        }
        let set = settle(first, &beside, &mut turned);
        let mirrored = set.iter().filter(|&&face| part.faces[face as usize].mirrored).count();
        for &face in &set {
            part.faces[face as usize].mirrored = 2 * mirrored > set.len();
        }
    }
    let is_turned = |face: u32| turned[face as usize] == Some(true);
    for used in part.uses.iter_mut().filter(|used| is_turned(used.face)) {
        used.orientation = Orientation::Reversed.compose(used.orientation);
    }
    for (face, placed) in (0..).zip(&mut part.faces) {
        placed.reversed ^= is_turned(face);
    }
}

/// Two faces at an edge that no other has, and whether they look opposite ways: they use it in the same sense.
fn pairs(part: &Part) -> Vec<(u32, u32, bool)> {
    let mut at: Vec<(u32, [Option<PlacedUse>; 2])> = vec![(0, [None; 2]); part.edges.len()];
    for used in &part.uses {
        let (count, both) = &mut at[used.edge as usize];
        if let Some(free) = both.get_mut(*count as usize) {
            *free = Some(*used);
        }
        *count += 1;
    }
    let pair = |(count, both): (u32, [Option<PlacedUse>; 2])| {
        let [Some(one), Some(other)] = both else { return None };
        let bound = one.orientation.bounds() && other.orientation.bounds();
        let apart = count == 2 && one.face != other.face && bound;
        apart.then_some((one.face, other.face, one.orientation == other.orientation))
    };
    at.into_iter().filter_map(pair).collect()
}

/// Decides for all faces that hang together with the first, and returns them.
fn settle(first: u32, beside: &[Vec<Neighbour>], turned: &mut [Option<bool>]) -> Vec<u32> {
    let mut set = vec![first];
    let mut agree = true;
    turned[first as usize] = Some(false);
    let mut next = 0;
    while next < set.len() {
        let face = set[next] as usize;
        next += 1;
        for &(other, differs) in &beside[face] {
            let wanted = turned[face] != Some(differs);
            match turned[other as usize] {
                None => {
                    turned[other as usize] = Some(wanted);
                    set.push(other);
                }
                Some(known) => agree &= known == wanted,
            }
        }
    }
    let set_size = set.len();
    let many = set.iter().filter(|&&face| turned[face as usize] == Some(true)).count();
    for &face in &set {
        let own = &mut turned[face as usize];
        *own = own.map(|own| agree && own != (2 * many > set_size));
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::{PlacedEdge, PlacedFace};
    use Orientation::{Forward, Reversed};

    /// Faces in a row, each of which has an edge with the next; some are reversed. `closed`: the last has one with the
    /// first, which it uses in the same sense as that or not.
    fn row(reversed: &[bool], closed: Option<bool>) -> Part {
        let count = reversed.len() as u32;
        let way = |back: bool| if back { Reversed } else { Forward };
        let mut uses = Vec::new();
        for (face, &back) in (0..count).zip(reversed) {
            let mut put = |edge: u32, back: bool| uses.push(PlacedUse { edge, face, orientation: way(back) });
            if face > 0 {
                put(face - 1, !back);
            } else if let Some(same) = closed {
                put(count - 1, back == same);
            }
            if face + 1 < count || closed.is_some() {
                put(face, back);
            }
        }
        let faces =
            reversed.iter().map(|&reversed| PlacedFace { face: 0, location: 0, reversed, mirrored: false }).collect();
        Part { faces, edges: vec![PlacedEdge { edge: 0, location: 0 }; count as usize], uses, solids: 0 }
    }

    fn turned(mut part: Part) -> Vec<bool> {
        turn_to_agree(&mut part);
        part.faces.iter().map(|face| face.reversed).collect()
    }

    #[test]
    fn the_fewer_faces_turn() {
        assert_eq!(turned(row(&[false, true, true, false, true], None)), [true; 5]);
        assert_eq!(turned(row(&[true, false, false], None)), [false; 3]);
        assert_eq!(turned(row(&[true, false], None)), [true; 2], "as the first, where there are as many");
        assert_eq!(turned(row(&[true, true, true], None)), [true; 3]);
        assert_eq!(turned(row(&[false, true, false], Some(false))), [false; 3]);
        let solid = Part { solids: 1, ..row(&[false, true, false], Some(false)) };
        assert_eq!(turned(solid), [false, true, false]);
    }

    #[test]
    fn uses_turn_with_their_faces() {
        let mut part = row(&[false, true, false], Some(false));
        turn_to_agree(&mut part);
        assert!(pairs(&part).iter().all(|&(_, _, differs)| !differs));
        let senses = |part: &Part| part.uses.iter().map(|used| used.orientation).collect::<Vec<_>>();
        assert_eq!(senses(&part), senses(&row(&[false; 3], Some(false))));
    }

    #[test]
    fn all_faces_that_hang_together_are_mirrored_or_none() {
        let mirrored = |which: &[usize], count: usize| {
            let mut part = row(&vec![false; count], None);
            which.iter().for_each(|&face| part.faces[face].mirrored = true);
            // The last face is apart.
            part.uses.retain(|used| used.face + 1 < count as u32);
            turn_to_agree(&mut part);
            assert!(part.faces.iter().all(|face| !face.reversed));
            part.faces.iter().map(|face| face.mirrored).collect::<Vec<_>>()
        };
        assert_eq!(mirrored(&[1], 5), [false; 5]);
        assert_eq!(mirrored(&[1, 2, 3], 5), [true, true, true, true, false]);
        assert_eq!(mirrored(&[4], 5), [false, false, false, false, true]);
        assert_eq!(mirrored(&[0, 1], 5), [false; 5], "where there are as many");
    }

    #[test]
    fn a_moebius_strip_and_edges_of_three_faces_stay() {
        assert_eq!(turned(row(&[false, false, true, false], Some(true))), [false, false, true, false]);
        let mut fan = row(&[false, true, false], None);
        fan.uses.push(PlacedUse { edge: 0, face: 2, orientation: Forward });
        fan.uses.push(PlacedUse { edge: 1, face: 0, orientation: Forward });
        assert_eq!(turned(fan), [false, true, false]);
    }
}
