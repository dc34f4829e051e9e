//! Traces the borders between areas: chains of cracks between pixels, from one point where three areas meet to the
//! next.
//!
//! ```text
//!   1 1 1 | 2 2          a node: three or four cracks meet there
//!   1 1 1 | 2 2
//!   ------+----          a chain: cracks one after another, with one area on this side and one on that
//!   3 3 3 | 2 2
//! ```

use super::runs::Runs;

/// A crack: the two pixels that it lies between, by column and row; one of them may lie outside of the map.
pub type Crack = [[i32; 2]; 2];

pub struct Chain {
    /// The areas to its left and to its right, in its direction.
    pub cells: [u32; 2],
    /// The nodes at its ends, as numbers of the grid's corners; None for a closed chain without nodes.
    pub ends: Option<[u32; 2]>,
    pub cracks: Vec<Crack>,
}

struct Map<'a> {
    cells: &'a [u32],
    width: usize,
    height: usize,
}

/// right, down, left, up
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Map<'_> {
    fn cell(&self, [x, y]: [i32; 2]) -> u32 {
        let inside = (0..self.width as i32).contains(&x) && (0..self.height as i32).contains(&y);
        if inside { self.cells[y as usize * self.width + x as usize] } else { 0 }
    }

    /// The crack that leads from a corner of pixels in a direction; None where both sides belong to one area.
    fn crack(&self, [x, y]: [i32; 2], way: usize) -> Option<Crack> {
        let crack = match way {
            0 => [[x, y - 1], [x, y]],
            1 => [[x - 1, y], [x, y]],
            2 => [[x - 1, y - 1], [x - 1, y]],
            _ => [[x - 1, y - 1], [x, y - 1]],
        };
        (self.cell(crack[0]) != self.cell(crack[1])).then_some(crack)
    }

    fn ways(&self, at: [i32; 2]) -> usize {
        (0..4).filter(|&w| self.crack(at, w).is_some()).count()
    }

    fn number(&self, [x, y]: [i32; 2]) -> usize {
        y as usize * (self.width + 1) + x as usize
    }
}

/// `cells`: areas row by row; outside of the map lies area 0, nothing. `runs`: stretches of one area in its rows.
pub fn chains(cells: &[u32], runs: &Runs, [width, height]: [usize; 2]) -> Vec<Chain> {
    let map = Map { cells, width, height };
    // Cracks already walked: to the right of a corner, and down from it.
    let mut walked = vec![0u8; (width + 1) * (height + 1)];
    let mut out = Vec::new();
    for only_nodes in [true, false] {
        for y in 0..=height {
            // A node lies where a run ends, and so does the first corner of a chain without nodes, from above.
            let rows = y.saturating_sub(1)..(y + 1).min(height);
            let mut ends: Vec<usize> = rows.flat_map(|row| runs.columns(row)).chain([width]).collect();
            ends.sort_unstable();
            ends.dedup();
            for x in ends {
                let at = [x as i32, y as i32];
                let count = map.ways(at);
                if count == 0 || (only_nodes && count == 2) {
                    continue;
                }
                for way in 0..4 {
                    if let Some(chain) = walk(&map, &mut walked, at, way, only_nodes) {
                        out.push(chain);
                    }
                }
            }
        }
    }
    out
}

fn walk(map: &Map, walked: &mut [u8], from: [i32; 2], way: usize, open: bool) -> Option<Chain> {
    let first = map.crack(from, way)?;
    let mut mark = |at: [i32; 2], way: usize| {
        let next = [at[0] + STEPS[way][0], at[1] + STEPS[way][1]];
        let (corner, bit) = if way < 2 { (at, 1 << way) } else { (next, 1 << (way - 2)) };
        let known = &mut walked[map.number(corner)];
        let fresh = *known & bit == 0;
        *known |= bit;
        (fresh, next)
    };
    let (fresh, mut at) = mark(from, way);
    if !fresh {
        return None;
    }
    let mut cracks = vec![first];
    let mut came = way;
    while at != from && (!open || map.ways(at) == 2) {
        // The only way to go on that does not lead back.
        let (way, crack) = (0..4).filter(|&w| w != (came + 2) % 4).find_map(|w| map.crack(at, w).map(|c| (w, c)))?;
        cracks.push(crack);
        (_, at) = mark(at, way);
        came = way;
    }
    let ends = open.then(|| [map.number(from) as u32, map.number(at) as u32]);
    // A crack names first the pixel above it or to its left.
    let [a, b] = first.map(|pixel| map.cell(pixel));
    Some(Chain { cells: if way == 0 || way == 3 { [a, b] } else { [b, a] }, ends, cracks })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(cells: &[u32], size: [usize; 2]) -> Vec<Chain> {
        chains(cells, &Runs::new(cells, size[0], u32::eq), size)
    }

    #[test]
    fn three_areas_meet_in_two_nodes() {
        let found = found(&[1, 1, 2, 2], [4, 1]);
        assert_eq!(found.len(), 3);
        assert!(found.iter().all(|c| c.ends.is_some()));
        assert_eq!(found.iter().map(|c| c.cracks.len()).sum::<usize>(), 5 + 5 + 1);
    }

    #[test]
    fn an_island_is_one_closed_chain() {
        let found = found(&[0, 0, 0, 0, 7, 0, 0, 0, 0], [3, 3]);
        assert_eq!(found.len(), 1);
        assert!(found[0].ends.is_none());
        assert_eq!(found[0].cracks.len(), 4);
    }
}
