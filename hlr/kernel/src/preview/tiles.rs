//! Strip by strip on all cores, tile by tile within a strip.
//!
//! ```text
//!   strip 0  | tile | tile | tile |      a face is copied into each tile it reaches, so that a tile reads its faces
//!   strip 1  | tile | tile | tile |      one after the other
//! ```

use rayon::prelude::*;

use super::faces::{Chunk, Face};
use super::raster::{Sampling, TILE_HEIGHT, TILE_WIDTH, Tile};

/// A tile whose z-buffer is filled with the opaque faces.
pub struct Filled<'a> {
    pub tile: &'a Tile,
    /// Of the first sample: column and row.
    pub first: [usize; 2],
    /// Transparent faces, in the order of the model.
    pub glass: &'a [Face],
}

/// Fill all tiles that something reaches of a picture of `size`; `show` writes a tile into the rows of its strip, which are `size[0]` wide, and may keep
/// what it likes in a `scratch` of its thread.
/// `glass` tells the transparent triangles. False when stopped.
#[allow(clippy::too_many_arguments)] // what is drawn, where to, and how
pub fn each_tile<P: Send, S>(
    chunks: &[Chunk],
    size: [usize; 2],
    sampling: &Sampling,
    glass: &[bool],
    out: &mut [P],
    stopped: &(dyn Fn() -> bool + Sync),
    scratch: impl Fn() -> S + Sync + Send,
    show: impl Fn(&mut S, &Filled, &mut [P]) + Sync,
) -> bool {
    let rows = TILE_HEIGHT / sampling.side;
    out.par_chunks_mut(rows * size[0]).enumerate().with_max_len(1).for_each_init(
        || (Tile::new(), Bins::default(), scratch()),
        |(tile, bins, scratch), (strip, out)| {
            if stopped() {
                return;
            }
            bins.sort(chunks, strip, size, sampling, glass);
            for column in 0..bins.columns {
                let (solid, clear) = (bins.solid.of(column), bins.clear.of(column));
                if solid.is_empty() && clear.is_empty() {
                    continue;
                }
                let first = [column * TILE_WIDTH, strip * TILE_HEIGHT];
                tile.clear();
                tile.fill(solid, first.map(|c| c as i32), sampling);
                show(scratch, &Filled { tile, first, glass: clear }, out);
            }
        },
    );
    !stopped()
}

/// The faces of one strip by tile.
#[derive(Default)]
struct Bins {
    columns: usize,
    solid: Bin,
    clear: Bin,
}

#[derive(Default)]
struct Bin {
    starts: Vec<u32>,
    faces: Vec<Face>,
}

impl Bin {
    fn of(&self, column: usize) -> &[Face] {
        &self.faces[self.starts[column] as usize..self.starts[column + 1] as usize]
    }

    fn reset(&mut self, columns: usize) {
        self.starts.clear();
        self.starts.resize(columns + 2, 0);
        self.faces.clear();
    }
}

impl Bins {
    /// A counting sort by column.
    fn sort(&mut self, chunks: &[Chunk], strip: usize, size: [usize; 2], sampling: &Sampling, glass: &[bool]) {
        self.columns = (size[0] * sampling.side).div_ceil(TILE_WIDTH);
        let last = self.columns - 1;
        let reach = |face: &Face| {
            let columns = sampling.reach(&face.x, size[0]);
            [columns[0] as usize / TILE_WIDTH, ((columns[1] - 1) as usize / TILE_WIDTH).min(last)]
        };
        let all = || chunks.iter().flat_map(|chunk| chunk.in_strip(strip));
        self.solid.reset(self.columns);
        self.clear.reset(self.columns);
        for face in all() {
            let bin = if glass[face.triangle as usize] { &mut self.clear } else { &mut self.solid };
            let [a, b] = reach(face);
            for column in a..=b {
                bin.starts[column + 2] += 1;
            }
        }
        for bin in [&mut self.solid, &mut self.clear] {
            for column in 2..bin.starts.len() {
                bin.starts[column] += bin.starts[column - 1];
            }
            let none = Face { x: [0; 3], y: [0; 3], depth: [0.0; 3], triangle: 0 };
            bin.faces.resize(bin.starts[self.columns + 1] as usize, none);
        }
        for face in all() {
            let bin = if glass[face.triangle as usize] { &mut self.clear } else { &mut self.solid };
            let [a, b] = reach(face);
            for column in a..=b {
                // One ahead while filling: starts[c + 1] runs from the start of c to its end.
                let place = &mut bin.starts[column + 1];
                bin.faces[*place as usize] = *face;
                *place += 1;
            }
        }
    }
}
