//! Rasterizes faces with sixteen samples per pixel: edge functions, evaluated incrementally for eight columns at a
//! time.
//!
//! J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988. The samples are sheared, so that an edge
//! function is not affine in column and row; but it is, with the same growth, for every fourth of either. So there are
//! four rows of lanes to start from, the lanes within a row shifted each by its own shear.

use super::face::Face;
use super::grid::{LANES, TILE_WIDTH};
use super::sampling::Sampling;
use super::slope::{Slope, nearer, window};
use super::tile::Tile;

/// Beyond this value an edge function keeps its sign all over the tile.
pub const FAR: i64 = 1_000_000_000;

/// Rows and columns until the pattern of samples repeats.
const PERIOD: usize = 4;

/// An edge function at the samples of a tile's first rows and columns, `PERIOD` of them until the pattern repeats.
#[derive(Clone, Copy)]
struct Edge {
    at: [[i32; LANES]; PERIOD],
    by_row: i32,
    by_lanes: i32,
}

impl Edge {
    /// `a`, `b`: growth per column and row; `value`: at the first sample.
    #[inline(always)]
    fn new(a: i32, b: i32, value: i64, sampling: &Sampling) -> Edge {
        // Left and top edges own what lies on them.
        let value = value.wrapping_sub(i64::from(!(a > 0 || (a == 0 && b > 0))));
        let mut at = [[0i32; LANES]; PERIOD];
        for (row, lanes) in at.iter_mut().enumerate() {
            let value = value.wrapping_add(i64::from(a).wrapping_mul(i64::from(sampling.shear[row])));
            for l in 0..4 {
                let v = value.wrapping_add(i64::from(b).wrapping_mul(i64::from(sampling.shear[l])));
                let v = (v >> sampling.shift).clamp(-FAR, FAR) as i32;
                lanes[l] = v;
                lanes[l + 4] = v;
            }
            for (l, v) in lanes.iter_mut().enumerate() {
                *v = v.wrapping_add(a.wrapping_mul(l as i32));
            }
        }
        Edge { at, by_row: b, by_lanes: a.wrapping_mul(LANES as i32) }
    }

    /// At the lanes from column `chunk * LANES` of a row.
    #[inline(always)]
    fn lanes(&self, row: usize, chunk: usize) -> [i32; LANES] {
        let more = self.by_row.wrapping_mul(row as i32).wrapping_add(self.by_lanes.wrapping_mul(chunk as i32));
        let mut out = self.at[row % PERIOD];
        for v in &mut out {
            *v = v.wrapping_add(more);
        }
        out
    }
}

/// The span of each row: the columns that a face may own, widened by the shear of the samples and by rounding, in 2^-20
/// of a column. The edge functions decide; the span only skips columns where they cannot all be positive.
struct Spans {
    /// A bound from each edge, as start and slope: first of left edges, then of right ones.
    left: [[i64; 2]; 3],
    right: [[i64; 2]; 3],
}

const FINE: u32 = 20;

impl Spans {
    const NONE: Spans = Spans { left: [[0; 2]; 3], right: [[(TILE_WIDTH as i64) << FINE, 0]; 3] };

    /// Edge k with its coefficients a, b and its value at the first sample.
    #[inline(always)]
    fn bound(&mut self, k: usize, a: i32, b: i32, value: i64, per_step: f64) {
        if a == 0 {
            return;
        }
        let over = -f64::from(1u32 << FINE) / f64::from(a);
        let (start, slope) = (value as f64 * per_step * over, f64::from(b) * over);
        let spare = 0.5 * f64::from(1u32 << FINE) + 0.5 * slope.abs();
        if a > 0 {
            self.left[k] = [(start - spare) as i64, slope as i64];
        } else {
            self.right[k] = [(start + spare) as i64, slope as i64];
        }
    }

    /// The chunks of lanes that the face reaches.
    #[inline(always)]
    fn row(&self, row: usize, chunks: [usize; 2]) -> [usize; 2] {
        const CHUNK: u32 = FINE + LANES.trailing_zeros();
        let at = |line: &[i64; 2]| line[0].wrapping_add(line[1].wrapping_mul(row as i64));
        let low = at(&self.left[0]).max(at(&self.left[1])).max(at(&self.left[2])).max(0);
        let high = at(&self.right[0]).min(at(&self.right[1])).min(at(&self.right[2]));
        [((low >> CHUNK) as usize).max(chunks[0]), (((high >> CHUNK) + 1).max(0) as usize).min(chunks[1])]
    }
}

/// All that a face needs in a tile.
struct Ready {
    edges: [Edge; 3],
    spans: Spans,
    slope: Slope,
    rows: [usize; 2],
    chunks: [usize; 2],
}

impl Ready {
    #[inline(always)]
    fn new(face: &Face, first: [i32; 2], sampling: &Sampling) -> Ready {
        let (rows, chunks) = window(face, first);
        let half = 1i32 << (sampling.shift - 1);
        let (x, y) = ((first[0] << sampling.shift).wrapping_add(half), (first[1] << sampling.shift).wrapping_add(half));
        let per_step = 1.0 / f64::from(1u32 << sampling.shift);
        let mut spans = Spans::NONE;
        let mut edge = |k: usize, n: usize| {
            let (a, b) = (face.y[k].wrapping_sub(face.y[n]), face.x[n].wrapping_sub(face.x[k]));
            let value = i64::from(a)
                .wrapping_mul(i64::from(x.wrapping_sub(face.x[k])))
                .wrapping_add(i64::from(b).wrapping_mul(i64::from(y.wrapping_sub(face.y[k]))));
            spans.bound(k, a, b, value, per_step);
            Edge::new(a, b, value, sampling)
        };
        let edges = [edge(0, 1), edge(1, 2), edge(2, 0)];
        Ready { edges, spans, slope: Slope::new(face, first, sampling), rows, chunks }
    }

    /// For eight samples: a mask of those that are not owned, and the depths.
    #[inline(always)]
    fn lanes(&self, row: usize, chunk: usize, sampling: &Sampling) -> ([i32; LANES], [f32; LANES]) {
        let [a, b, c] = &self.edges;
        let (mut outside, b, c) = (a.lanes(row, chunk), b.lanes(row, chunk), c.lanes(row, chunk));
        for l in 0..LANES {
            outside[l] = (outside[l] | b[l] | c[l]) >> 31;
        }
        (outside, self.slope.lanes(row, chunk * LANES, sampling))
    }
}

#[inline(always)]
pub fn fill(tile: &mut Tile, face: &Face, first: [i32; 2], sampling: &Sampling) {
    let ready = Ready::new(face, first, sampling);
    for row in ready.rows[0]..ready.rows[1] {
        let samples = tile.row(row);
        let [from, to] = ready.spans.row(row, ready.chunks);
        for chunk in from..to {
            let (outside, z) = ready.lanes(row, chunk, sampling);
            let at = chunk * LANES;
            if let Some(lanes) = samples[at..].first_chunk_mut::<LANES>() {
                nearer(&outside, &z, face.triangle, lanes);
            }
        }
    }
}

/// Calls `found` with column, row and depth of each sample that the face owns.
pub fn each(face: &Face, first: [i32; 2], sampling: &Sampling, mut found: impl FnMut(usize, usize, f32)) {
    let ready = Ready::new(face, first, sampling);
    for row in ready.rows[0]..ready.rows[1] {
        let [from, to] = ready.spans.row(row, ready.chunks);
        for chunk in from..to {
            let (outside, z) = ready.lanes(row, chunk, sampling);
            for l in (0..LANES).filter(|&l| outside[l] == 0) {
                found(chunk * LANES + l, row, z[l]);
            }
        }
    }
}
