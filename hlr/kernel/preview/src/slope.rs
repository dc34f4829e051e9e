//! Depth of a face along the rows of a tile, eight samples at once, and the depth test against the nearest so far.

use super::face::Face;
use super::grid::{LANES, TILE_HEIGHT, TILE_WIDTH};
use super::sampling::Sampling;

/// Depth over a tile: an affine function, clamped to the face's own range.
pub struct Slope {
    start: f64,
    dx: f64,
    dy: f64,
    low: f32,
    high: f32,
    lanes: [f32; LANES],
}

impl Slope {
    #[inline(always)]
    pub fn new(face: &Face, first: [i32; 2], sampling: &Sampling) -> Slope {
        let step = f64::from(1i32 << sampling.shift);
        let plane = &face.plane;
        let (dx, dy) = (plane.dx * step, plane.dy * step);
        let mut lanes = [0f32; LANES];
        for (l, v) in lanes.iter_mut().enumerate() {
            let shear = sampling.shear[l & 3] as f32 / 64.0;
            *v = dx as f32 * l as f32 + dy as f32 * shear;
        }
        Slope {
            start: plane.start + dx * (f64::from(first[0]) + 0.5) + dy * (f64::from(first[1]) + 0.5),
            dx,
            dy,
            low: face.depth[0].min(face.depth[1]).min(face.depth[2]),
            high: face.depth[0].max(face.depth[1]).max(face.depth[2]),
            lanes,
        }
    }

    /// Depth at eight columns of a row; the first is a multiple of eight. So the depth of a sample depends on the plane
    /// and on the sample alone: faces in one plane are rounded alike.
    #[inline(always)]
    pub fn lanes(&self, row: usize, column: usize, sampling: &Sampling) -> [f32; LANES] {
        let start = self.start(row, column, sampling);
        let mut out = self.lanes;
        for v in &mut out {
            *v += start;
        }
        self.within(out)
    }

    /// For samples that are not sheared, and eight lanes from any column on.
    #[inline(always)]
    pub fn shifted(&self, column: usize) -> Shifted<'_> {
        let before = column % LANES;
        let (mut lanes, mut later) = ([0f32; LANES], [0u32; LANES]);
        for l in 0..LANES {
            lanes[l] = self.lanes[(before + l) % LANES];
            later[l] = if before + l < LANES { 0 } else { u32::MAX };
        }
        Shifted { slope: self, column: column - before, lanes, later }
    }

    /// Depth at a column from which eight lanes start.
    #[inline(always)]
    fn start(&self, row: usize, column: usize, sampling: &Sampling) -> f32 {
        let shear = f64::from(sampling.shear[row & 3]) / 64.0;
        (self.start + self.dy * row as f64 + self.dx * (column as f64 + shear)) as f32
    }

    #[inline(always)]
    fn within(&self, mut out: [f32; LANES]) -> [f32; LANES] {
        for v in &mut out {
            *v = if *v > self.low { *v } else { self.low };
        }
        for v in &mut out {
            *v = if *v < self.high { *v } else { self.high };
        }
        out
    }
}

/// The depths of `Slope` at eight columns that lie in two chunks of lanes.
pub struct Shifted<'a> {
    slope: &'a Slope,
    /// Where the first chunk starts.
    column: usize,
    lanes: [f32; LANES],
    /// All bits are set in lanes of the second chunk.
    later: [u32; LANES],
}

impl Shifted<'_> {
    /// The depths in a row, `chunks` chunks further on.
    #[inline(always)]
    pub fn lanes(&self, row: usize, chunks: usize) -> [f32; LANES] {
        let column = self.column + chunks * LANES;
        let one = self.slope.start(row, column, &Sampling::CENTRES).to_bits();
        let two = self.slope.start(row, column + LANES, &Sampling::CENTRES).to_bits();
        let mut out = [0f32; LANES];
        for (l, v) in out.iter_mut().enumerate() {
            *v = f32::from_bits(one & !self.later[l] | two & self.later[l]) + self.lanes[l];
        }
        self.slope.within(out)
    }
}

/// Rows and chunks of lanes of a tile that a face reaches.
#[inline(always)]
pub fn window(face: &Face, first: [i32; 2]) -> ([usize; 2], [usize; 2]) {
    let [columns, rows] = face.reach;
    let within = |v: i32, from: i32, most: usize| v.wrapping_sub(from).clamp(0, most as i32) as usize;
    let chunks =
        [within(columns[0], first[0], TILE_WIDTH) / LANES, within(columns[1], first[0], TILE_WIDTH).div_ceil(LANES)];
    ([within(rows[0], first[1], TILE_HEIGHT), within(rows[1], first[1], TILE_HEIGHT)], chunks)
}

/// Where a sample is not masked as outside and z is less than its depth, the triangle takes its place.
#[inline(always)]
pub fn nearer(outside: &[i32; LANES], z: &[f32; LANES], triangle: u32, samples: &mut [f64; LANES]) {
    for l in 0..LANES {
        // A masked depth becomes larger than any other, and stays a number.
        let z = z[l].to_bits() | (outside[l] as u32 & 0x7000_0000);
        let here = f64::from_bits(u64::from(z) << 32 | u64::from(triangle));
        samples[l] = if here < samples[l] { here } else { samples[l] };
    }
}
