//! Lists the faces that reach into each tile.

use super::face::{Chunk, Face};
use super::grid::{TILE_HEIGHT, TILE_WIDTH};

/// The faces of some chunks that reach into each tile, in their order: a counting sort by tile.
#[derive(Default)]
pub struct List {
    starts: Vec<u32>,
    /// Chunk, face, and whether it is transparent.
    listed: Vec<(u32, u16, bool)>,
}

impl List {
    /// `tiles`: number of tiles, across and down.
    pub fn refill(&mut self, chunks: &[Chunk], [across, down]: [usize; 2], transparent: &[bool]) {
        let reached = |face: &Face| {
            let [columns, rows] = face.reach;
            let of = |[first, end]: [i32; 2], side: usize| first as usize / side..(end as usize - 1) / side + 1;
            (of(columns, TILE_WIDTH), of(rows, TILE_HEIGHT))
        };
        // Shifted by one while filling: starts[t + 1] moves from the start of tile t to its end.
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
                let entry = (c as u32, i as u16, transparent[face.triangle as usize]);
                for row in rows {
                    for next in &mut starts[1 + row * across..][columns.clone()] {
                        self.listed[*next as usize] = entry;
                        *next += 1;
                    }
                }
            }
        }
    }

    pub fn of<'a>(&'a self, tile: usize, chunks: &'a [Chunk]) -> impl Iterator<Item = (&'a Face, bool)> {
        let range = self.starts[tile] as usize..self.starts[tile + 1] as usize;
        self.listed[range].iter().map(|&(c, i, clear)| (&chunks[c as usize].faces[i as usize], clear))
    }
}
