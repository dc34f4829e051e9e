//! The z-buffer of one tile of the picture.

use super::NOTHING;
use super::grid::{LANES, TILE_HEIGHT, TILE_WIDTH};
use super::pyramid::Pyramid;

/// Depth 2, farther than all others, and no triangle.
const EMPTY: f64 = f64::from_bits((2f32.to_bits() as u64) << 32 | NOTHING as u64);

/// Depth and triangle of the samples of one tile: the bits of the depth, which is not negative, above the triangle's
/// number. So the nearer of two samples is the smaller number, and at equal depths the first triangle wins. The number
/// is stored as the double of those bits, which compares alike, because processors have an instruction for the lesser
/// of two doubles.
pub struct Tile {
    pub(super) samples: [[f64; TILE_WIDTH]; TILE_HEIGHT],
    pub(super) pyramid: Pyramid,
}

impl Tile {
    pub fn new() -> Tile {
        Tile { samples: [[EMPTY; TILE_WIDTH]; TILE_HEIGHT], pyramid: Pyramid::EMPTY }
    }

    pub fn clear(&mut self) {
        self.samples.as_flattened_mut().fill(EMPTY);
        self.pyramid.clear();
    }

    /// The next run of one triangle in a row, from a column on: its first column, the one after its last, and the
    /// triangle.
    #[inline(always)]
    pub fn run(&self, row: usize, from: usize) -> Option<(usize, usize, u32)> {
        let (samples, drawn) = (&self.samples[row], self.pyramid.drawn(row));
        let mut at = from;
        while at < TILE_WIDTH {
            let triangle = samples[at].to_bits() as u32;
            if triangle != NOTHING {
                let mut to = at + 1;
                while to < TILE_WIDTH && samples[to].to_bits() as u32 == triangle {
                    to += 1;
                }
                return Some((at, to, triangle));
            }
            at += 1;
            while at.is_multiple_of(LANES) && at < TILE_WIDTH && drawn >> (at / LANES) & 1 == 0 {
                at += LANES;
            }
        }
        None
    }

    /// The samples of a row.
    #[inline(always)]
    pub fn row(&mut self, row: usize) -> &mut [f64; TILE_WIDTH] {
        &mut self.samples[row]
    }

    #[inline(always)]
    pub fn depth(&self, i: usize, j: usize) -> f32 {
        f32::from_bits((self.samples[j][i].to_bits() >> 32) as u32)
    }

    /// The triangle at a sample; NOTHING for none.
    #[inline(always)]
    pub fn triangle(&self, i: usize, j: usize) -> u32 {
        self.samples[j][i].to_bits() as u32
    }
}

impl Default for Tile {
    fn default() -> Tile {
        Tile::new()
    }
}
