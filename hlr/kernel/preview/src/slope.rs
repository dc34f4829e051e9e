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
        let (x1, y1) = (f64::from(face.x[1] - face.x[0]), f64::from(face.y[1] - face.y[0]));
        let (x2, y2) = (f64::from(face.x[2] - face.x[0]), f64::from(face.y[2] - face.y[0]));
        let z0 = f64::from(face.depth[0]);
        let (z1, z2) = (f64::from(face.depth[1]) - z0, f64::from(face.depth[2]) - z0);
        let step = f64::from(1i32 << sampling.shift);
        let over = step / (x1 * y2 - x2 * y1);
        let dx = (z1 * y2 - z2 * y1) * over;
        let dy = (z2 * x1 - z1 * x2) * over;
        let at = |f: i32, corner: i32| f64::from(f) + 0.5 - f64::from(corner) / step;
        let mut lanes = [0f32; LANES];
        for (l, v) in lanes.iter_mut().enumerate() {
            let shear = sampling.shear[l & 3] as f32 / 64.0;
            *v = dx as f32 * l as f32 + dy as f32 * shear;
        }
        Slope {
            start: z0 + dx * at(first[0], face.x[0]) + dy * at(first[1], face.y[0]),
            dx,
            dy,
            low: face.depth[0].min(face.depth[1]).min(face.depth[2]),
            high: face.depth[0].max(face.depth[1]).max(face.depth[2]),
            lanes,
        }
    }

    /// Depth at eight columns of a row; the first is a multiple of four, or samples are not sheared.
    #[inline(always)]
    pub fn lanes(&self, row: usize, column: usize, sampling: &Sampling) -> [f32; LANES] {
        let shear = f64::from(sampling.shear[row & 3]) / 64.0;
        let start = (self.start + self.dy * row as f64 + self.dx * (column as f64 + shear)) as f32;
        let mut out = self.lanes;
        for v in &mut out {
            *v += start;
        }
        for v in &mut out {
            *v = if *v > self.low { *v } else { self.low };
        }
        for v in &mut out {
            *v = if *v < self.high { *v } else { self.high };
        }
        out
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
