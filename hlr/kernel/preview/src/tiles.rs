//! Strip by strip on all cores, tile by tile within a strip.
//!
//! ```text
//!   strip 0  | tile | tile | tile |      faces are listed for each tile that they reach: chunks of them side by side,
//!   strip 1  | tile | tile | tile |      and each tile goes through all lists
//! ```

use rayon::prelude::*;

use super::faces::{Chunk, Face};
use super::raster::{Sampling, TILE_HEIGHT, TILE_WIDTH, Tile};
use super::workspace::Workspace;

/// Lists that are made side by side: enough for any machine's cores, few enough that a tile finds its faces at once.
const LISTS: usize = 32;

/// A tile whose z-buffer is filled with the opaque faces.
pub struct Filled<'a> {
    pub tile: &'a Tile,
    /// Of the first sample: column and row.
    pub first: [usize; 2],
    /// Transparent faces, in the order of the model.
    pub glass: &'a [&'a Face],
}

/// Fill all tiles that `space.chunks` reach of a picture of `size`; `show` writes a tile into the rows of its strip, which are
/// `size[0]` wide and hold `nothing`, and may keep what it likes in a `scratch` of its thread. `glass` tells the
/// transparent triangles. False when stopped.
#[allow(clippy::too_many_arguments)] // what is drawn, where to, and how
pub fn each_tile<P: Copy + Send + Sync, S>(
    space: &mut Workspace,
    size: [usize; 2],
    sampling: &Sampling,
    glass: &[bool],
    out: &mut [P],
    nothing: P,
    stopped: &(dyn Fn() -> bool + Sync),
    scratch: impl Fn() -> S + Sync + Send,
    show: impl Fn(&mut S, &Filled, &mut [P]) + Sync,
) -> bool {
    let rows = TILE_HEIGHT / sampling.side;
    let tiles = [(size[0] * sampling.side).div_ceil(TILE_WIDTH), sampling.strips(size[1])];
    let chunks = &space.chunks;
    let share = chunks.len().div_ceil(LISTS).max(1);
    space.lists.resize_with(chunks.len().div_ceil(share), List::default);
    space.lists.par_iter_mut().zip(chunks.par_chunks(share)).for_each(|(l, c)| l.refill(c, tiles, glass));
    let faces = |tile: usize| space.lists.iter().zip(chunks.chunks(share)).flat_map(move |(l, c)| l.of(tile, c));
    out.par_chunks_mut(rows * size[0]).enumerate().with_max_len(1).for_each_init(
        || (Tile::new(), Vec::new(), Vec::new(), scratch()),
        |(tile, solid, clear, scratch), (strip, out)| {
            if stopped() {
                return;
            }
            // By the thread that goes on with them: the pages of a new picture are had when they are first written.
            out.fill(nothing);
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
                show(scratch, &Filled { tile, first, glass: clear }, out);
            }
        },
    );
    !stopped()
}

/// Which of some chunks' faces reach into which tile, in their order: a counting sort by tile.
#[derive(Default)]
pub struct List {
    starts: Vec<u32>,
    /// Chunk, face, and whether it is transparent.
    listed: Vec<(u32, u16, bool)>,
}

impl List {
    /// `tiles`: how many, across and down.
    fn refill(&mut self, chunks: &[Chunk], [across, down]: [usize; 2], glass: &[bool]) {
        let reached = |face: &Face| {
            let [columns, rows] = face.reach;
            let of = |[first, end]: [i32; 2], side: usize| first as usize / side..(end as usize - 1) / side + 1;
            (of(columns, TILE_WIDTH), of(rows, TILE_HEIGHT))
        };
        // One ahead while filling: starts[t + 1] runs from the start of t to its end.
        let starts = &mut self.starts;
        starts.clear();
        starts.resize(across * down + 2, 0);
        for face in chunks.iter().flat_map(|c| &c.faces) {
            let (columns, rows) = reached(face);
            for row in rows {
                for count in &mut starts[2 + row * across..][columns.clone()] {
                    *count += 1;
                }
            }
        }
        for t in 2..starts.len() {
            starts[t] += starts[t - 1];
        }
        self.listed.resize(starts[across * down + 1] as usize, (0, 0, false));
        for (c, chunk) in chunks.iter().enumerate() {
            for (i, face) in chunk.faces.iter().enumerate() {
                let (columns, rows) = reached(face);
                let entry = (c as u32, i as u16, glass[face.triangle as usize]);
                for row in rows {
                    for next in &mut starts[1 + row * across..][columns.clone()] {
                        self.listed[*next as usize] = entry;
                        *next += 1;
                    }
                }
            }
        }
    }

    fn of<'a>(&'a self, tile: usize, chunks: &'a [Chunk]) -> impl Iterator<Item = (&'a Face, bool)> {
        let range = self.starts[tile] as usize..self.starts[tile + 1] as usize;
        self.listed[range].iter().map(|&(c, i, clear)| (&chunks[c as usize].faces[i as usize], clear))
    }
}
