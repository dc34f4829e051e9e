//! Transparent faces: collects every layer in front of the nearest opaque face, sorted by depth.
//!
//! L. Carpenter, "The A-buffer, an antialiased hidden surface method", SIGGRAPH 1984: each sample keeps a list of what
//! covers it. A tile's lists are one array, sorted by sample, then farthest first.

use super::face::Face;
use super::grid::TILE_WIDTH;
use super::raster::owned;
use super::sampling::Sampling;
use super::tile::Tile;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// row * TILE_WIDTH + column, within the tile.
    pub sample: u16,
    pub depth: f32,
    pub triangle: u32,
}

/// Share of the range of depth: a transparent face this near to an opaque one counts as coincident with it.
const APART: f32 = 2e-6;

/// All layers of a tile, sorted by sample, then farthest first. At equal depths the first triangle lies in front.
pub fn layers(tile: &Tile, faces: &[&Face], first: [usize; 2], sampling: &Sampling, out: &mut Vec<Layer>) {
    out.clear();
    for face in faces {
        owned(face, first.map(|c| c as i32), sampling, |i, j, depth| {
            if depth < tile.depth(i, j) - APART {
                out.push(Layer { sample: (j * TILE_WIDTH + i) as u16, depth, triangle: face.triangle });
            }
        });
    }
    out.sort_unstable_by(|a, b| {
        a.sample.cmp(&b.sample).then(b.depth.total_cmp(&a.depth)).then(b.triangle.cmp(&a.triangle))
    });
    // A triangle that was cut may own a sample only once.
    out.dedup_by(|a, b| a.sample == b.sample && a.triangle == b.triangle);
}

/// Blends `over` in front of `under`; colours premultiplied by their opacity.
#[inline(always)]
pub fn over(over: [f32; 4], under: [f32; 4]) -> [f32; 4] {
    let through = 1.0 - over[3];
    [0, 1, 2, 3].map(|k| over[k] + through * under[k])
}
