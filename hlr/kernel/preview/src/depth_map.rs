//! The depth map: depth and triangle at the centre of each pixel.

use super::faces::faces;
use super::grid::{TILE_HEIGHT, TILE_WIDTH};
use super::lens::Lens;
use super::sampling::Sampling;
use super::tiles::each_tile;
use super::workspace::Workspace;
use super::{Model, NOTHING};

/// Depth (0 nearest, 1 farthest, 2 nothing) and triangle (NOTHING for none).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSample {
    pub depth: f32,
    pub triangle: u32,
}

/// Depths row by row. Transparent faces count as opaque. None when stopped.
pub fn depth_map(
    model: &Model,
    lens: &Lens,
    space: &mut Workspace,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<MapSample>> {
    let sampling = Sampling::CENTRES;
    if !faces(model, lens, &sampling, space, stopped) {
        return None;
    }
    let [width, height] = lens.size;
    let nothing = MapSample { depth: 2.0, triangle: NOTHING };
    let mut out = vec![nothing; width * height];
    let solid = vec![false; model.triangles.len()];
    each_tile(
        space,
        lens.size,
        &sampling,
        &solid,
        &mut out,
        None,
        stopped,
        || (),
        |(), filled, rows| {
            let wide = TILE_WIDTH.min(width - filled.first[0]);
            for (j, row) in rows.chunks_mut(width).take(TILE_HEIGHT).enumerate() {
                for (i, sample) in row[filled.first[0]..filled.first[0] + wide].iter_mut().enumerate() {
                    *sample = MapSample { depth: filled.tile.depth(i, j), triangle: filled.tile.triangle(i, j) };
                }
            }
        },
    )
    .then_some(out)
}
