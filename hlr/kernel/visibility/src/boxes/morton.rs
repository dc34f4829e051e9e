//! Boxes sorted along Morton's curve (G. Morton, "A computer oriented geodetic data base", 1966): boxes that are near
//! one another on the curve are near one another in space, so one sort makes a hierarchy.

use rayon::prelude::*;

use super::aabb::{Aabb, Item, middle};

/// With fewer items a second thread gains nothing.
pub const ALONE: usize = 4096;
/// Fewer items are sorted by comparing them, and so many on all threads. The others are sorted by digits, which takes a
/// fifth of the time.
const FEW: usize = 512;
const MANY: usize = 1 << 17;

/// Items along the curve. codes: the position of each item along the curve, ascending; bits below `INDEX_BITS` do not
/// count.
pub struct Sorted {
    pub codes: Vec<u64>,
    pub items: Vec<Item>,
}

/// Sorts the items along the curve. whole: so many of one cell need not be sorted further; threads: on all threads.
pub fn sorted(items: &[Item], whole: usize, threads: bool) -> Sorted {
    let cube = MortonCube::of(items);
    let code = |(k, (bounds, _)): (usize, &Item)| cube.code(bounds) << INDEX_BITS | k as u64;
    let item = |code: &u64| items[(code & ((1 << INDEX_BITS) - 1)) as usize];
    let (codes, mut sorted): (Vec<u64>, Vec<Item>) = if threads && items.len() >= MANY {
        let mut codes: Vec<u64> = items.par_iter().with_min_len(ALONE).enumerate().map(code).collect();
        codes.par_sort_unstable();
        let sorted = codes.par_iter().with_min_len(ALONE).map(item).collect();
        (codes, sorted)
    } else {
        let mut codes: Vec<u64> = items.iter().enumerate().map(code).collect();
        if codes.len() < FEW {
            codes.sort_unstable()
        } else {
            sort_by_digits(&mut codes)
        }
        let sorted = codes.iter().map(item).collect();
        (codes, sorted)
    };
    sort_within_cells(&mut sorted, &codes, INDEX_BITS, whole);
    Sorted { codes, items: sorted }
}

/// Bits of a position along Morton's curve that are the number of the item, and bits of each of its coordinates.
pub const INDEX_BITS: u32 = 31;
const SIDE_BITS: u32 = 11;

/// Sorts codes whose lowest bits, the numbers of the items, ascend already: digit by digit, each with a counting sort.
fn sort_by_digits(codes: &mut Vec<u64>) {
    let mut other = vec![0; codes.len()];
    for shift in [0, 1, 2].map(|digit| INDEX_BITS + digit * SIDE_BITS) {
        let digit = |code: u64| (code >> shift) as usize & ((1 << SIDE_BITS) - 1);
        let mut next = [0u32; 1 << SIDE_BITS];
        codes.iter().for_each(|&code| next[digit(code)] += 1);
        let mut before = 0;
        for count in &mut next {
            before += std::mem::replace(count, before);
        }
        for &code in codes.iter() {
            let place = &mut next[digit(code)];
            other[*place as usize] = code;
            *place += 1;
        }
        std::mem::swap(codes, &mut other);
    }
}

/// A cube around the middles of boxes, divided into cells along Morton's curve. Middles are sums of two coordinates.
struct MortonCube {
    low: [i64; 3],
    side: u64,
    /// Sums lose so many bits.
    down: u32,
}

impl MortonCube {
    fn of(items: &[Item]) -> MortonCube {
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for middle in items.iter().map(|(bounds, _)| middle(bounds)) {
            low = [0, 1, 2].map(|k| low[k].min(middle[k]));
            high = [0, 1, 2].map(|k| high[k].max(middle[k]));
        }
        let side = (0..3).map(|k| high[k].saturating_sub(low[k])).max().unwrap_or(0).max(0) as u64;
        MortonCube { low, side, down: (64 - side.leading_zeros()).saturating_sub(SIDE_BITS) }
    }

    /// The position of a box's middle along the curve: the bits of its coordinates, interleaved.
    fn code(&self, of: &Aabb) -> u64 {
        let spread = |x: u64| {
            let x = (x | x << 16) & 0x0700_00FF;
            let x = (x | x << 8) & 0x0700_F00F;
            let x = (x | x << 4) & 0x430C_30C3;
            (x | x << 2) & 0x4924_9249
        };
        let middle = middle(of);
        (0..3).fold(0, |out, k| out | spread((middle[k] - self.low[k]) as u64 >> self.down) << k)
    }
}

/// Sorts the items of each cell that has more than `whole` along a curve through that cell alone: most items may lie in
/// one cell, where one lies far away. codes: of the items, ascending; shift: bits of them that do not count.
fn sort_within_cells(items: &mut [Item], codes: &[u64], shift: u32, whole: usize) {
    let mut rest = items;
    for cell in codes.chunk_by(|a, b| a >> shift == b >> shift) {
        let (own, after) = rest.split_at_mut(cell.len());
        rest = after;
        if own.len() <= whole {
            continue;
        }
        let cube = MortonCube::of(own);
        if cube.side > 0 {
            own.sort_by_cached_key(|(bounds, item)| (cube.code(bounds), *item));
            let finer: Vec<u64> = own.iter().map(|(bounds, _)| cube.code(bounds)).collect();
            sort_within_cells(own, &finer, 0, whole);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::bits;

    #[test]
    fn digits_sort_as_comparisons_do() {
        let mut random = bits(1);
        for bits in [33, 12, 0] {
            let mut codes: Vec<u64> = (0..5000).map(|k| (random() & ((1 << bits) - 1)) << INDEX_BITS | k).collect();
            let mut expected = codes.clone();
            expected.sort_unstable();
            sort_by_digits(&mut codes);
            assert_eq!(codes, expected);
        }
    }
}
