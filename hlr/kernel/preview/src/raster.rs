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

use super::faces::Face;
use super::pyramid::Pyramid;
pub use super::sampling::Sampling;
use super::{NOTHING, edges, small, spans};

pub const TILE_WIDTH: usize = 64;
pub const TILE_HEIGHT: usize = 64;
pub const LANES: usize = 8;
/// Depth 2, farther than all, and no triangle.
const EMPTY: f64 = f64::from_bits((2f32.to_bits() as u64) << 32 | NOTHING as u64);
/// Beyond this an edge function keeps its sign all over the tile.
pub const FAR: i64 = 1_000_000_000;

/// Depth and owner of the samples of one tile: the bits of a depth, which is not negative, above the number of a triangle.
/// So the nearer of two is the smaller number, and of equal depths that of the first triangle. It is kept as the double of
/// those bits, which compares alike, because processors have an instruction for the lesser of doubles.
pub struct Tile {
    seen: [[f64; TILE_WIDTH]; TILE_HEIGHT],
    pyramid: Pyramid,
}

impl Tile {
    pub fn new() -> Tile {
        Tile { seen: [[EMPTY; TILE_WIDTH]; TILE_HEIGHT], pyramid: Pyramid::EMPTY }
    }

    pub fn clear(&mut self) {
        self.seen.as_flattened_mut().fill(EMPTY);
        self.pyramid.clear();
    }

    /// The next run of one triangle in a row, from a column on: its first column, the one after its last, and the triangle.
    #[inline(always)]
    pub fn run(&self, row: usize, from: usize) -> Option<(usize, usize, u32)> {
        let (seen, drawn) = (&self.seen[row], self.pyramid.drawn(row));
        let mut at = from;
        while at < TILE_WIDTH {
            let triangle = seen[at].to_bits() as u32;
            if triangle != NOTHING {
                let mut to = at + 1;
                while to < TILE_WIDTH && seen[to].to_bits() as u32 == triangle {
                    to += 1;
                }
                return Some((at, to, triangle));
            }
            at += 1;
            while at.is_multiple_of(LANES) && at < TILE_WIDTH && drawn >> (at / LANES) & 1 == 0 {
                at += LANES;
            }
        }
        None
    }

    /// What is seen along a row.
    #[inline(always)]
    pub fn row(&mut self, row: usize) -> &mut [f64; TILE_WIDTH] {
        &mut self.seen[row]
    }

    #[inline(always)]
    pub fn depth(&self, i: usize, j: usize) -> f32 {
        f32::from_bits((self.seen[j][i].to_bits() >> 32) as u32)
    }

    /// NOTHING for none.
    #[inline(always)]
    pub fn triangle(&self, i: usize, j: usize) -> u32 {
        self.seen[j][i].to_bits() as u32
    }

    /// `first`: column and row of the tile's first sample.
    pub fn fill(&mut self, faces: &[&Face], first: [i32; 2], sampling: &Sampling) {
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
fn fill_avx2(tile: &mut Tile, faces: &[&Face], first: [i32; 2], sampling: &Sampling) {
    fill_any(tile, faces, first, sampling);
}

#[inline(always)]
fn fill_any(tile: &mut Tile, faces: &[&Face], first: [i32; 2], sampling: &Sampling) {
    for face in faces {
        let (rows, chunks) = window(face, first);
        let nearest = face.depth[0].min(face.depth[1]).min(face.depth[2]);
        if tile.pyramid.hides(&tile.seen, rows, chunks, nearest) {
            continue;
        }
        tile.pyramid.touch(rows, chunks);
        if sampling.side == 1 && small::lanes(face) == 1 {
            small::fill::<1>(&mut tile.seen, face, first, rows);
        } else if sampling.side == 1 && small::lanes(face) == 2 {
            small::fill::<2>(&mut tile.seen, face, first, rows);
        } else if sampling.side == 1 {
            spans::fill(tile, face, first, sampling);
        } else {
            edges::fill(tile, face, first, sampling);
        }
    }
}

/// Depth over a tile: affine, and never beyond the face's own.
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

    /// At eight columns of a row; the first is a multiple of four, or samples are not sheared.
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

/// Where nothing is masked as outside, and z is less than the depth, the triangle takes its place.
#[inline(always)]
pub fn nearer(outside: &[i32; LANES], z: &[f32; LANES], triangle: u32, seen: &mut [f64; LANES]) {
    for l in 0..LANES {
        // What is outside is farther than anything, and still a number.
        let z = z[l].to_bits() | (outside[l] as u32 & 0x7000_0000);
        let here = f64::from_bits(u64::from(z) << 32 | u64::from(triangle));
        seen[l] = if here < seen[l] { here } else { seen[l] };
    }
}

/// Call `found` with column, row and depth of each sample of the tile that the face owns.
pub fn owned(face: &Face, first: [i32; 2], sampling: &Sampling, mut found: impl FnMut(usize, usize, f32)) {
    if sampling.side > 1 {
        return edges::each(face, first, sampling, found);
    }
    let mut scan = spans::Scan::new(face, first, sampling);
    while let Some((row, from, to)) = scan.next_span() {
        for column in from..to {
            found(column, row, scan.slope.lanes(row, column, sampling)[0]);
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

    fn face(p: [[i32; 2]; 3], triangle: u32, sampling: &Sampling) -> Option<Face> {
        let [a, b, c] = p.map(|q| q.map(i64::from));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let order = if area > 0 { [0, 1, 2] } else { [0, 2, 1] };
        let at = |k: usize| order.map(|o| p[o][k]);
        (area != 0).then(|| Face::new(at(0), at(1), [0.5; 3], triangle, sampling, [usize::MAX; 2]))
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
                let Some(f) = face(points, 7, &sampling) else { continue };
                let first = [64 * (turn as i32 % 3), 32 * (turn as i32 % 2)];
                let mut tile = Tile::new();
                tile.fill(&[&f], first, &sampling);
                let mut listed = 0;
                owned(&f, first, &sampling, |i, j, _| {
                    listed += 1;
                    assert_eq!(tile.triangle(i, j), 7);
                });
                let mut count = 0;
                for j in 0..TILE_HEIGHT {
                    for i in 0..TILE_WIDTH {
                        let [x, y] = sampling.place(i + first[0] as usize, j + first[1] as usize);
                        let expected = owns(&f, (x * 256.0) as i64, (y * 256.0) as i64);
                        assert_eq!(tile.triangle(i, j) == 7, expected, "{f:?} {i} {j}");
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
                    if let Some(f) = face([centre, ring[k], ring[(k + 1) % ring.len()]], 0, &sampling) {
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

    /// What lies behind is left out sooner or later, by the order of the faces, but never what is seen.
    #[test]
    fn the_order_of_faces_does_not_matter() {
        let mut state = 11;
        for sampling in [Sampling::CENTRES, Sampling::SIXTEEN] {
            for size in [500, 2000, 4000, 30000] {
                let mut faces: Vec<Face> = (0..1500)
                    .filter_map(|t| {
                        let corner = [0, 1].map(|_| random(&mut state, 16384));
                        let mut p = || corner.map(|c| c + random(&mut state, size) - size / 2);
                        let mut f = face([p(), p(), p()], t, &sampling)?;
                        let depth = random(&mut state, 50) as f32 / 50.0;
                        f.depth = [0, 1, 2].map(|_| depth + random(&mut state, 3) as f32 / 100.0);
                        Some(f)
                    })
                    .collect();
                let filled = |faces: &[Face]| {
                    let mut tile = Tile::new();
                    tile.fill(&faces.iter().collect::<Vec<_>>(), [0, 0], &sampling);
                    tile
                };
                let one = filled(&faces);
                faces.sort_by(|a, b| a.depth[0].total_cmp(&b.depth[0]));
                assert!(one.seen == filled(&faces).seen, "from near to far");
                faces.reverse();
                assert!(one.seen == filled(&faces).seen, "from far to near");
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
                    let mut f = face([p(), p(), p()], t, &sampling)?;
                    f.depth = [0, 1, 2].map(|_| random(&mut state, 1000) as f32 / 1000.0);
                    Some(f)
                })
                .collect();
            let (mut one, mut two) = (Tile::new(), Tile::new());
            let faces: Vec<&Face> = faces.iter().collect();
            one.fill(&faces, [0, 0], &sampling);
            fill_any(&mut two, &faces, [0, 0], &sampling);
            assert!(one.seen == two.seen);
        }
    }
}
