//! Caches the shading data of the triangles of one tile: a hash table with open addressing, emptied in constant time.

use super::shade::Ready;

/// Slots of the table: twice as many as triangles are kept, so that one is found after a step or two.
const PLACES: usize = 8192;

pub struct ShadingCache {
    /// Turn, triangle, and index into `ready`; an entry of an earlier turn is empty.
    places: Vec<(u32, u32, u32)>,
    ready: Vec<Ready>,
    turn: u32,
}

impl ShadingCache {
    pub fn new() -> ShadingCache {
        ShadingCache { places: vec![(0, 0, 0); PLACES], ready: Vec::new(), turn: 1 }
    }

    /// Forgets all entries, for the next tile.
    pub fn forget(&mut self) {
        self.ready.clear();
        self.turn = self.turn.wrapping_add(1);
        if self.turn == 0 {
            self.places.fill((0, 0, 0));
            self.turn = 1;
        }
    }

    #[inline(always)]
    pub fn get(&mut self, triangle: u32, make: impl FnOnce() -> Ready) -> &Ready {
        let mut at = triangle as usize % PLACES;
        loop {
            let (turn, held, index) = self.places[at];
            if turn != self.turn {
                break;
            }
            if held == triangle {
                return &self.ready[index as usize];
            }
            at = (at + 1) % PLACES;
        }
        self.make(triangle, at, make())
    }

    #[inline(never)]
    fn make(&mut self, triangle: u32, mut at: usize, ready: Ready) -> &Ready {
        if self.ready.len() >= PLACES / 2 {
            self.forget();
            at = triangle as usize % PLACES;
        }
        let index = self.ready.len();
        self.places[at] = (self.turn, triangle, index as u32);
        self.ready.push(ready);
        &self.ready[index]
    }
}

impl Default for ShadingCache {
    fn default() -> ShadingCache {
        ShadingCache::new()
    }
}
