//! The farthest depth of each block of a tile: a face whose nearest depth is beyond it is hidden there.
//!
//! N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer visibility", SIGGRAPH 1993, with only the two lowest levels of
//! their pyramid: a tile is small. A block is updated only when its depth is asked for after something was drawn into
//! it.
//!
//! ```text
//!   +---+---+---+--       8 x 8 samples a block: a row of it is what the raster takes at once
//!   | 7 | 9 | 2 |         hidden: nearest corner of the face > farthest sample of each block that the face's box meets
//!   +---+---+---+--
//! ```

use super::grid::{LANES, TILE_HEIGHT, TILE_WIDTH};

const ROWS: usize = 8;
const DOWN: usize = TILE_HEIGHT / ROWS;
const ACROSS: usize = TILE_WIDTH / LANES;
const _: () = assert!(ACROSS <= 8);

pub struct Pyramid {
    farthest: [[f32; ACROSS]; DOWN],
    /// Blocks drawn into since their depth was last computed: a bit for each column of blocks.
    stale: [u8; DOWN],
    /// Blocks drawn into at all.
    drawn: [u8; DOWN],
}

impl Pyramid {
    /// Nothing is drawn yet.
    pub const EMPTY: Pyramid =
        Pyramid { farthest: [[f32::INFINITY; ACROSS]; DOWN], stale: [0; DOWN], drawn: [0; DOWN] };

    pub fn clear(&mut self) {
        *self = Pyramid::EMPTY;
    }

    /// Whether all beyond `nearest` is hidden in these rows and chunks of lanes. `samples`: those of the `Tile`.
    #[inline(always)]
    pub fn hides(
        &mut self,
        samples: &[[f64; TILE_WIDTH]; TILE_HEIGHT],
        rows: [usize; 2],
        chunks: [usize; 2],
        nearest: f32,
    ) -> bool {
        for down in rows[0] / ROWS..rows[1].div_ceil(ROWS) {
            for across in chunks[0]..chunks[1] {
                if self.stale[down] >> across & 1 == 1 {
                    self.stale[down] &= !(1 << across);
                    self.farthest[down][across] = farthest(samples, down, across);
                }
                if nearest <= self.farthest[down][across] {
                    return false;
                }
            }
        }
        true
    }

    /// Marks a block as drawn into.
    #[inline(always)]
    pub fn touch(&mut self, rows: [usize; 2], chunks: [usize; 2]) {
        let columns = ((1u32 << chunks[1]) - (1u32 << chunks[0].min(chunks[1]))) as u8;
        for down in rows[0] / ROWS..rows[1].div_ceil(ROWS) {
            self.stale[down] |= columns;
            self.drawn[down] |= columns;
        }
    }

    /// The chunks of lanes of a row into which something may have been drawn, one bit each.
    #[inline(always)]
    pub fn drawn(&self, row: usize) -> u8 {
        self.drawn[row / ROWS]
    }
}

#[inline(always)]
fn farthest(samples: &[[f64; TILE_WIDTH]; TILE_HEIGHT], down: usize, across: usize) -> f32 {
    let mut most = [0.0f64; LANES];
    for row in &samples[down * ROWS..(down + 1) * ROWS] {
        if let Some(lanes) = row[across * LANES..].first_chunk::<LANES>() {
            for (m, v) in most.iter_mut().zip(lanes) {
                *m = if *v > *m { *v } else { *m };
            }
        }
    }
    let most = most.iter().fold(0.0f64, |m, v| if *v > m { *v } else { m });
    f32::from_bits((most.to_bits() >> 32) as u32)
}
