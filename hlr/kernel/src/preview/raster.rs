//! Which samples a face owns, and which of those are nearer than what was there: the z-buffer of one tile.
//!
//! J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988: three edge functions, each positive on the
//! inner side, followed from sample to sample by additions.
//!
//! ```text
//!   E(x, y) = (x1 - x0) (y - y0) - (y1 - y0) (x - x0)         grid of 1/256 pixel, y down, area positive
//! ```
//!
//! A sample on an edge belongs to the face whose left or top edge it is, so that of two faces with a common edge exactly
//! one owns it. All that is exact: E is an integer; samples are 2^shift steps apart, so its sign at sample (i, j) is that
//! of floor(E(0, 0) / 2^shift) + A i + B j, which fits 32 bits within a tile.
//!
//! ```text
//!   one sample a pixel        sixteen: a grid of 4 x 4, sheared so that all x and all y differ (rooks)
//!   +-------+                 rows shifted in x by SHEAR[row], columns in y by SHEAR[column]
//!   |   .   |
//!   +-------+
//! ```

use super::NOTHING;
use super::faces::{Face, GRID};

pub const TILE_WIDTH: usize = 64;
pub const TILE_HEIGHT: usize = 64;
const LANES: usize = 8;
const EMPTY: u32 = 2f32.to_bits();
/// Beyond this an edge function keeps its sign all over the tile.
const FAR: i64 = 1_000_000_000;

/// Where a pixel is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// Samples along a side of a pixel: 1 or 4.
    pub side: usize,
    shift: u32,
    shear: [i32; 4],
}

impl Sampling {
    pub const CENTRES: Sampling = Sampling { side: 1, shift: 8, shear: [0; 4] };
    pub const SIXTEEN: Sampling = Sampling { side: 4, shift: 6, shear: [-24, 8, -8, 24] };

    /// Rows of tiles in a picture of this height.
    pub fn strips(&self, height: usize) -> usize {
        (height * self.side).div_ceil(TILE_HEIGHT)
    }

    /// First sample and the one after the last, along one axis, that a face may own; `size` in pixels.
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

    /// A sample's place in pixels.
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

/// Depth and owner of the samples of one tile.
pub struct Tile {
    /// The bits of depths: 0 nearest, 1 farthest, 2 where nothing is.
    depth: [[u32; TILE_WIDTH]; TILE_HEIGHT],
    pub triangle: [[u32; TILE_WIDTH]; TILE_HEIGHT],
}

impl Tile {
    pub fn new() -> Tile {
        Tile { depth: [[EMPTY; TILE_WIDTH]; TILE_HEIGHT], triangle: [[NOTHING; TILE_WIDTH]; TILE_HEIGHT] }
    }

    pub fn clear(&mut self) {
        self.depth.as_flattened_mut().fill(EMPTY);
        self.triangle.as_flattened_mut().fill(NOTHING);
    }

    pub fn depth(&self, i: usize, j: usize) -> f32 {
        f32::from_bits(self.depth[j][i])
    }

    /// Faces in their order: of equal depths the first stays. `first`: column and row of the tile's first sample.
    pub fn fill(&mut self, faces: &[Face], first: [i32; 2], sampling: &Sampling) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has what the function is compiled for. It is the same function, and no instruction
            // of that set rounds otherwise (there is no fused multiplication): the bits are the same.
            unsafe { fill_avx2(self, faces, first, sampling) };
            return;
        }
        fill_any(self, faces, first, sampling);
    }
}

impl Default for Tile {
    fn default() -> Tile {
        Tile::new()
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn fill_avx2(tile: &mut Tile, faces: &[Face], first: [i32; 2], sampling: &Sampling) {
    fill_any(tile, faces, first, sampling);
}

#[inline(always)]
fn fill_any(tile: &mut Tile, faces: &[Face], first: [i32; 2], sampling: &Sampling) {
    for face in faces {
        if sampling.side == 1 {
            fill_face::<1>(tile, face, first, sampling);
        } else {
            fill_face::<4>(tile, face, first, sampling);
        }
    }
}

/// An edge function at the samples of a tile's first rows and columns, `P` of them until the pattern repeats.
#[derive(Clone, Copy)]
struct Edge<const P: usize> {
    at: [[i32; LANES]; P],
    by_row: i32,
    by_lanes: i32,
}

impl<const P: usize> Edge<P> {
    /// `a`, `b`: growth per column and row; `value`: at the first sample.
    #[inline(always)]
    fn new(a: i32, b: i32, value: i64, sampling: &Sampling) -> Edge<P> {
        // Left and top edges own what lies on them.
        let value = value.wrapping_sub(i64::from(!(a > 0 || (a == 0 && b > 0))));
        let mut at = [[0i32; LANES]; P];
        for (row, lanes) in at.iter_mut().enumerate() {
            if P == 1 {
                *lanes = [(value >> sampling.shift).clamp(-FAR, FAR) as i32; LANES];
            } else {
                let value = value.wrapping_add(i64::from(a).wrapping_mul(i64::from(sampling.shear[row & 3])));
                for l in 0..4 {
                    let v = value.wrapping_add(i64::from(b).wrapping_mul(i64::from(sampling.shear[l])));
                    let v = (v >> sampling.shift).clamp(-FAR, FAR) as i32;
                    lanes[l] = v;
                    lanes[l + 4] = v;
                }
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
        let mut out = self.at[row % P];
        for v in &mut out {
            *v = v.wrapping_add(more);
        }
        out
    }
}

/// The span of each row: columns that a face may own, widened by what the shear moves samples, and by what rounding may.
/// The edge functions decide; this saves looking where they cannot all be positive. In 2^-20 of a column.
struct Spans {
    /// A bound by each edge, as start and slope: those of left edges, and those of right ones.
    left: [[i64; 2]; 3],
    right: [[i64; 2]; 3],
}

const FINE: u32 = 20;

impl Spans {
    const NONE: Spans = Spans { left: [[0; 2]; 3], right: [[(TILE_WIDTH as i64) << FINE, 0]; 3] };

    /// Edge k with its coefficients a, b and its value at the first sample.
    #[inline(always)]
    fn bound<const P: usize>(&mut self, k: usize, a: i32, b: i32, value: i64, per_step: f64) {
        if a == 0 {
            return;
        }
        let over = -f64::from(1u32 << FINE) / f64::from(a);
        let (start, slope) = (value as f64 * per_step * over, f64::from(b) * over);
        let spare = if P == 1 { 1024.0 } else { 0.5 * f64::from(1u32 << FINE) + 0.5 * slope.abs() };
        if a > 0 {
            self.left[k] = [(start - spare) as i64, slope as i64];
        } else {
            self.right[k] = [(start + spare) as i64, slope as i64];
        }
    }

    /// Chunks of lanes, within the face's own.
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
struct Ready<const P: usize> {
    edges: [Edge<P>; 3],
    spans: Spans,
    slope: Slope<P>,
    rows: [usize; 2],
    chunks: [usize; 2],
}

impl<const P: usize> Ready<P> {
    #[inline(always)]
    fn new(face: &Face, first: [i32; 2], sampling: &Sampling) -> Ready<P> {
        let (rows, chunks) = window(face, first, sampling);
        let half = 1i32 << (sampling.shift - 1);
        let (x, y) = ((first[0] << sampling.shift).wrapping_add(half), (first[1] << sampling.shift).wrapping_add(half));
        let per_step = 1.0 / f64::from(1u32 << sampling.shift);
        let mut spans = Spans::NONE;
        let mut edge = |k: usize, n: usize| {
            let (a, b) = (face.y[k].wrapping_sub(face.y[n]), face.x[n].wrapping_sub(face.x[k]));
            let value = i64::from(a)
                .wrapping_mul(i64::from(x.wrapping_sub(face.x[k])))
                .wrapping_add(i64::from(b).wrapping_mul(i64::from(y.wrapping_sub(face.y[k]))));
            spans.bound::<P>(k, a, b, value, per_step);
            Edge::new(a, b, value, sampling)
        };
        let edges = [edge(0, 1), edge(1, 2), edge(2, 0)];
        Ready { edges, spans, slope: Slope::new(face, first, sampling), rows, chunks }
    }
}

/// Depth over a tile: affine, and never beyond the face's own.
struct Slope<const P: usize> {
    start: f64,
    dx: f64,
    dy: f64,
    low: f32,
    high: f32,
    lanes: [f32; LANES],
}

impl<const P: usize> Slope<P> {
    #[inline(always)]
    fn new(face: &Face, first: [i32; 2], sampling: &Sampling) -> Slope<P> {
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
            let shear = if P == 1 { 0.0 } else { sampling.shear[l & 3] as f32 / 64.0 };
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

    #[inline(always)]
    fn lanes(&self, row: usize, chunk: usize, sampling: &Sampling) -> [f32; LANES] {
        let shear = if P == 1 { 0.0 } else { f64::from(sampling.shear[row & 3]) / 64.0 };
        let start = (self.start + self.dy * row as f64 + self.dx * ((chunk * LANES) as f64 + shear)) as f32;
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
fn window(face: &Face, first: [i32; 2], sampling: &Sampling) -> ([usize; 2], [usize; 2]) {
    let columns = sampling.reach(&face.x, usize::MAX);
    let rows = sampling.reach(&face.y, usize::MAX);
    let within = |v: i32, from: i32, most: usize| v.wrapping_sub(from).clamp(0, most as i32) as usize;
    let chunks =
        [within(columns[0], first[0], TILE_WIDTH) / LANES, within(columns[1], first[0], TILE_WIDTH).div_ceil(LANES)];
    ([within(rows[0], first[1], TILE_HEIGHT), within(rows[1], first[1], TILE_HEIGHT)], chunks)
}

#[inline(always)]
fn fill_face<const P: usize>(tile: &mut Tile, face: &Face, first: [i32; 2], sampling: &Sampling) {
    let ready = Ready::<P>::new(face, first, sampling);
    let edges = &ready.edges;
    for row in ready.rows[0]..ready.rows[1].min(TILE_HEIGHT) {
        let (depths, _) = tile.depth[row].as_chunks_mut::<LANES>();
        let (owners, _) = tile.triangle[row].as_chunks_mut::<LANES>();
        let [from, to] = ready.spans.row(row, ready.chunks);
        for chunk in from..to.min(TILE_WIDTH / LANES) {
            let (a, b, c) = (edges[0].lanes(row, chunk), edges[1].lanes(row, chunk), edges[2].lanes(row, chunk));
            let z = ready.slope.lanes(row, chunk, sampling);
            nearer(&a, &b, &c, &z, face.triangle, &mut depths[chunk], &mut owners[chunk]);
        }
    }
}

/// Where all three edge functions are positive and z is less than the depth, it takes its place. Without branches: depths
/// are not negative, so they compare as the integers that their bits are, and a sign shifted all through is a mask.
#[inline(always)]
fn nearer(
    a: &[i32; LANES],
    b: &[i32; LANES],
    c: &[i32; LANES],
    z: &[f32; LANES],
    triangle: u32,
    depth: &mut [u32; LANES],
    owner: &mut [u32; LANES],
) {
    for l in 0..LANES {
        let z = z[l].to_bits();
        let outside = (a[l] | b[l] | c[l]) >> 31;
        let wins = ((z.wrapping_sub(depth[l]) as i32 >> 31) & !outside) as u32;
        depth[l] ^= (depth[l] ^ z) & wins;
        owner[l] ^= (owner[l] ^ triangle) & wins;
    }
}

/// Call `found` with column, row and depth of each sample of the tile that the face owns.
pub fn owned(face: &Face, first: [i32; 2], sampling: &Sampling, found: impl FnMut(usize, usize, f32)) {
    if sampling.side == 1 {
        each::<1>(face, first, sampling, found);
    } else {
        each::<4>(face, first, sampling, found);
    }
}

fn each<const P: usize>(face: &Face, first: [i32; 2], sampling: &Sampling, mut found: impl FnMut(usize, usize, f32)) {
    let ready = Ready::<P>::new(face, first, sampling);
    for row in ready.rows[0]..ready.rows[1] {
        let [from, to] = ready.spans.row(row, ready.chunks);
        for chunk in from..to {
            let [a, b, c] = [0, 1, 2].map(|k| ready.edges[k].lanes(row, chunk));
            let z = ready.slope.lanes(row, chunk, sampling);
            for l in 0..LANES {
                if (a[l] | b[l] | c[l]) >= 0 {
                    found(chunk * LANES + l, row, z[l]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(state: &mut u64, n: i32) -> i32 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((*state >> 33) as i32).rem_euclid(n)
    }

    fn face(p: [[i32; 2]; 3], triangle: u32) -> Option<Face> {
        let [a, b, c] = p.map(|q| q.map(i64::from));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let order = if area > 0 { [0, 1, 2] } else { [0, 2, 1] };
        let at = |k: usize| order.map(|o| p[o][k]);
        (area != 0).then(|| Face { x: at(0), y: at(1), depth: [0.5; 3], triangle })
    }

    /// The rule in rational terms: inside, or on a left or top edge.
    fn owns(f: &Face, x: i64, y: i64) -> bool {
        (0..3).all(|k| {
            let n = (k + 1) % 3;
            let (ex, ey) = (i64::from(f.x[n] - f.x[k]), i64::from(f.y[n] - f.y[k]));
            let value = ex * (y - i64::from(f.y[k])) - ey * (x - i64::from(f.x[k]));
            value > 0 || (value == 0 && (ey < 0 || (ey == 0 && ex > 0)))
        })
    }

    #[test]
    fn owns_exactly_what_the_rule_says() {
        let mut state = 1;
        for sampling in [Sampling::CENTRES, Sampling::SIXTEEN] {
            for turn in 0..2000 {
                let spread = [300, 3000, 20000, 4_000_000][turn % 4];
                let mut p = || [0, 1].map(|_| random(&mut state, 2 * spread) - spread / 2);
                let points = [p(), p(), p()].map(|q| if turn % 3 == 0 { q.map(|c| c / 64 * 64 + 32) } else { q });
                let Some(f) = face(points, 7) else { continue };
                let first = [64 * (turn as i32 % 3), 32 * (turn as i32 % 2)];
                let mut tile = Tile::new();
                tile.fill(&[f], first, &sampling);
                let mut listed = 0;
                owned(&f, first, &sampling, |i, j, _| {
                    listed += 1;
                    assert_eq!(tile.triangle[j][i], 7);
                });
                let mut count = 0;
                for j in 0..TILE_HEIGHT {
                    for i in 0..TILE_WIDTH {
                        let [x, y] = sampling.place(i + first[0] as usize, j + first[1] as usize);
                        let expected = owns(&f, (x * 256.0) as i64, (y * 256.0) as i64);
                        assert_eq!(tile.triangle[j][i] == 7, expected, "{f:?} {i} {j}");
                        count += usize::from(expected);
                    }
                }
                assert_eq!(count, listed);
            }
        }
    }

    #[test]
    fn a_fan_paints_every_sample_once() {
        let mut state = 5;
        for sampling in [Sampling::CENTRES, Sampling::SIXTEEN] {
            for _ in 0..200 {
                let centre = [0, 1].map(|_| random(&mut state, 2000) + 500);
                let ring: Vec<[i32; 2]> =
                    vec![[0, 0], [1500, 0], [3000, 100], [3000, 3000], [1000, 3100], [0, 3000], [0, 777]];
                let mut painted = vec![0; TILE_WIDTH * TILE_HEIGHT];
                for k in 0..ring.len() {
                    if let Some(f) = face([centre, ring[k], ring[(k + 1) % ring.len()]], 0) {
                        owned(&f, [0, 0], &sampling, |i, j, _| painted[j * TILE_WIDTH + i] += 1);
                    }
                }
                assert!(painted.iter().all(|&n| n <= 1));
                let step = 256 / sampling.side;
                for (k, n) in painted.iter().enumerate() {
                    let (i, j) = (k % TILE_WIDTH, k / TILE_WIDTH);
                    let inner =
                        2 * step < i * step && 2 * step < j * step && (i + 2) * step < 3000 && (j + 2) * step < 3000;
                    assert!(*n == 1 || !inner, "hole at {i} {j}");
                }
            }
        }
    }

    #[test]
    fn without_avx_it_is_the_same() {
        let mut state = 9;
        for sampling in [Sampling::CENTRES, Sampling::SIXTEEN] {
            let faces: Vec<Face> = (0..300)
                .filter_map(|t| {
                    let mut p = || [0, 1].map(|_| random(&mut state, 16000));
                    let mut f = face([p(), p(), p()], t)?;
                    f.depth = [0, 1, 2].map(|_| random(&mut state, 1000) as f32 / 1000.0);
                    Some(f)
                })
                .collect();
            let (mut one, mut two) = (Tile::new(), Tile::new());
            one.fill(&faces, [0, 0], &sampling);
            fill_any(&mut two, &faces, [0, 0], &sampling);
            assert!(one.triangle == two.triangle && one.depth == two.depth);
        }
    }
}
