//! Triangles that lie in one place with another one of their part.

use rayon::prelude::*;

use super::tables::{Tables, range};

impl Tables {
    /// Per part, whether its points are not joined and two of its triangles, turned the same way, may lie in one place;
    /// always true where they do.
    ///
    /// Each place is hashed to 64 bits, so that one sort of integers finds equal ones. Two different places have the
    /// same hash with a chance of 2^-64, unless coordinates were made for it.
    pub fn triangles_in_one_place(&self) -> Vec<bool> {
        let found = |part: usize| {
            if self.joined[part] {
                return false;
            }
            let place = |point: &[f64; 3]| hash(point.map(|c| (c + 0.0).to_bits()));
            let corners = |t: &[i32; 3]| hash(turned(t.map(|v| place(&self.points[v as usize]))));
            // Most parts have no two points in one place.
            twice(self.points[range(&self.point_start, part)].iter().map(place).collect())
                && twice(self.triangles[range(&self.triangle_start, part)].iter().map(corners).collect())
        };
        (0..self.len()).into_par_iter().map(found).collect()
    }
}

/// Whether two of these numbers are equal.
fn twice(mut numbers: Vec<u64>) -> bool {
    numbers.par_sort_unstable();
    numbers.windows(2).any(|w| w[0] == w[1])
}

/// The same three in the same cyclic order, the same whichever of them is listed first.
fn turned([a, b, c]: [u64; 3]) -> [u64; 3] {
    [a, b, c].min([b, c, a]).min([c, a, b])
}

/// A hash of all bits: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
fn hash(numbers: [u64; 3]) -> u64 {
    numbers.into_iter().fold(0, |sum: u64, number| {
        let mut x = sum.wrapping_add(number).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One part of these triangles.
    fn part(points: &[[f64; 3]], triangles: &[[i32; 3]]) -> Tables {
        Tables {
            point_start: vec![0, points.len() as i32],
            points: points.to_vec(),
            triangle_start: vec![0, triangles.len() as i32],
            triangles: triangles.to_vec(),
            joined: vec![false],
            brep: vec![true],
            ..Tables::default()
        }
    }

    #[test]
    fn two_triangles_in_one_place_are_found_whichever_corner_is_first() {
        // Points 3 to 5 lie in the places of points 0 to 2; the sign of a zero does not count.
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0; 3], [1.0, -0.0, 0.0], [0.0, 1.0, -0.0]];
        for other in [[3, 4, 5], [4, 5, 3], [5, 3, 4], [0, 4, 2]] {
            let mut found = part(&points, &[[0, 1, 2], other]);
            assert_eq!(found.triangles_in_one_place(), [true], "{other:?}");
            found.joined[0] = true;
            assert_eq!(found.triangles_in_one_place(), [false]);
        }
    }

    #[test]
    fn neighbours_and_triangles_turned_over_are_not_in_one_place() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(part(&points, &[[0, 1, 2], [4, 3, 5]]).triangles_in_one_place(), [false]);
        assert_eq!(part(&points, &[[0, 1, 2], [0, 4, 3]]).triangles_in_one_place(), [false]);
    }
}
