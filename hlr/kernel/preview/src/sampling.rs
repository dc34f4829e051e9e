//! The sample positions of a pixel: one at its centre, or sixteen.
//!
//! ```text
//!   one sample a pixel        sixteen: a grid of 4 x 4, sheared so that all x and all y differ (rooks)
//!   +-------+                 rows shifted in x by SHEAR[row], columns in y by SHEAR[column]
//!   |   .   |
//!   +-------+
//! ```

use super::grid::{GRID, TILE_HEIGHT};

/// The sample positions of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// Samples along a side of a pixel: 1 or 4.
    pub side: usize,
    pub shift: u32,
    pub shear: [i32; 4],
}

impl Sampling {
    pub const CENTRES: Sampling = Sampling { side: 1, shift: 8, shear: [0; 4] };
    pub const SIXTEEN: Sampling = Sampling { side: 4, shift: 6, shear: [-24, 8, -8, 24] };

    /// Rows of tiles in a picture of this height.
    pub fn strips(&self, height: usize) -> usize {
        (height * self.side).div_ceil(TILE_HEIGHT)
    }

    /// First sample, and one after the last, that a face may own along one axis; `size` in pixels.
    #[inline(always)]
    pub fn reach(&self, corners: &[i32; 3], size: usize) -> [i32; 2] {
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        let (step, spread) = (1 << self.shift, self.shear[3]);
        let first = (low - step / 2 - spread + step - 1) >> self.shift;
        let end = ((high - step / 2 + spread) >> self.shift) + 1;
        let most = size.saturating_mul(self.side).min(i32::MAX as usize) as i32;
        [first.max(0), end.min(most)]
    }

    /// Position of a sample in pixels.
    #[inline(always)]
    pub fn place(&self, i: usize, j: usize) -> [f64; 2] {
        let step = 1i64 << self.shift;
        let at = |k: usize, across: usize| {
            let steps = k as i64 * step + step / 2 + i64::from(self.shear[across & 3]);
            steps as f64 / f64::from(GRID)
        };
        [at(i, j), at(j, i)]
    }
}
