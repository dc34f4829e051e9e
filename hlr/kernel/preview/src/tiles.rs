//! Rasterizes the picture strip by strip on all cores, tile by tile within a strip.
//!
//! ```text
//!   strip 0  | tile | tile | tile |      faces are listed for each tile that they reach: chunks of them side by side,
//!   strip 1  | tile | tile | tile |      and each tile goes through all lists
//! ```

use rayon::prelude::*;

use super::face::Face;
use super::grid::{TILE_HEIGHT, TILE_WIDTH};
use super::sampling::Sampling;
use super::tile::Tile;
use super::tile_lists::List;
use super::workspace::Workspace;

/// Lists that are made in parallel: enough for any machine's cores, few enough that a tile finds its faces quickly.
const LISTS: usize = 32;

/// A tile whose z-buffer is filled with the opaque faces.
pub struct Filled<'a> {
    pub tile: &'a Tile,
    /// Column and row of the first sample.
    pub first: [usize; 2],
    /// Transparent faces, in the order of the model.
    pub transparent: &'a [&'a Face],
}

/// Fills all tiles of a picture of `size` that `space.chunks` reach. `show` writes a tile into the rows of its strip,
/// which are `size[0]` wide and filled with `nothing` (None: as they were), and may keep data in a `scratch` of its
/// thread. `transparent`: per triangle. False when stopped.
#[allow(clippy::too_many_arguments)] // what is drawn, where to, and how
pub fn each_tile<P: Copy + Send + Sync, S>(
    space: &mut Workspace,
    size: [usize; 2],
    sampling: &Sampling,
    transparent: &[bool],
    out: &mut [P],
    nothing: Option<P>,
    stopped: &(dyn Fn() -> bool + Sync),
    scratch: impl Fn() -> S + Sync + Send,
    show: impl Fn(&mut S, &Filled, &mut [P]) + Sync,
) -> bool {
    let rows = TILE_HEIGHT / sampling.side;
    let tiles = [(size[0] * sampling.side).div_ceil(TILE_WIDTH), sampling.strips(size[1])];
    let chunks = &space.chunks;
    let share = chunks.len().div_ceil(LISTS).max(1);
    space.lists.resize_with(chunks.len().div_ceil(share), List::default);
    space.lists.par_iter_mut().zip(chunks.par_chunks(share)).for_each(|(l, c)| l.refill(c, tiles, transparent));
    let faces = |tile: usize| space.lists.iter().zip(chunks.chunks(share)).flat_map(move |(l, c)| l.of(tile, c));
    out.par_chunks_mut(rows * size[0]).enumerate().with_max_len(1).for_each_init(
        || (Tile::new(), Vec::new(), Vec::new(), scratch()),
        |(tile, solid, clear, scratch), (strip, out)| {
            if stopped() {
                return;
            }
            // Filled by the thread that goes on with the rows: the system assigns the pages of a new picture at the
            // first write.
            if let Some(nothing) = nothing {
                out.fill(nothing);
            }
            for column in 0..tiles[0] {
                solid.clear();
                clear.clear();
                for (face, is_clear) in faces(strip * tiles[0] + column) {
                    if is_clear { &mut *clear } else { &mut *solid }.push(face);
                }
                if solid.is_empty() && clear.is_empty() {
                    continue;
                }
                let first = [column * TILE_WIDTH, strip * TILE_HEIGHT];
                tile.clear();
                tile.fill(solid, first.map(|c| c as i32), sampling);
                show(scratch, &Filled { tile, first, transparent: clear }, out);
            }
        },
    );
    !stopped()
}
