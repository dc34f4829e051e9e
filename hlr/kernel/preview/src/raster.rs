//! Rasterizes faces into the z-buffer of one tile: which samples a face owns, and which of these it is nearest at.
//!
//! J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988: three edge functions, each positive on
//! the inner side, followed from sample to sample by additions.
//!
//! ```text
//!   E(x, y) = (x1 - x0) (y - y0) - (y1 - y0) (x - x0)         grid of 1/256 pixel, y down, area positive
//! ```
//!
//! A sample on an edge belongs to the face whose left or top edge it is, so that of two faces with a common edge
//! exactly one owns it. All that is exact: E is an integer; samples are 2^shift steps apart, so its sign at sample (i,
//! j) is that of floor(E(0, 0) / 2^shift) + A i + B j, which fits 32 bits within a tile.

use super::face::Face;
use super::grid::LANES;
use super::sampling::Sampling;
use super::slope::window;
use super::tile::Tile;
use super::{edge_functions, narrow_faces, row_spans};

impl Tile {
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
        if tile.pyramid.hides(&tile.samples, rows, chunks, nearest) {
            continue;
        }
        tile.pyramid.touch(rows, chunks);
        if sampling.side == 1 && narrow_faces::lanes(face) == 1 {
            narrow_faces::fill::<1>(&mut tile.samples, face, first, rows);
        } else if sampling.side == 1 && narrow_faces::lanes(face) == 2 {
            narrow_faces::fill::<2>(&mut tile.samples, face, first, rows);
        } else if sampling.side == 1 {
            row_spans::fill(tile, face, first, sampling);
        } else {
            edge_functions::fill(tile, face, first, sampling);
        }
    }
}

/// Calls `found` with column, row and depth of each sample of the tile that the face owns.
pub fn owned(face: &Face, first: [i32; 2], sampling: &Sampling, mut found: impl FnMut(usize, usize, f32)) {
    if sampling.side > 1 {
        return edge_functions::each(face, first, sampling, found);
    }
    let mut scan = row_spans::Scan::new(face, first, sampling);
    while let Some((row, from, to)) = scan.next_span() {
        for column in from..to {
            let lanes = scan.slope.lanes(row, column / LANES * LANES, sampling);
            found(column, row, lanes[column % LANES]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::{TILE_HEIGHT, TILE_WIDTH};
    use super::super::plane::Plane;
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
        (area != 0).then(|| deep(&at(0), &at(1), [0.5; 3], triangle, sampling))
    }

    fn deep(x: &[i32; 3], y: &[i32; 3], depth: [f32; 3], triangle: u32, sampling: &Sampling) -> Face {
        let plane = Plane::on_grid(x, y, &depth.map(f64::from));
        Face::new(*x, *y, depth, plane, triangle, sampling, [usize::MAX; 2])
    }

    /// The ownership rule in rational numbers: inside, or on a left or top edge.
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

    /// The order of faces decides how much of what is hidden is skipped, but never skips what is visible.
    #[test]
    fn the_order_of_faces_does_not_matter() {
        let mut state = 11;
        for sampling in [Sampling::CENTRES, Sampling::SIXTEEN] {
            for size in [500, 2000, 4000, 30000] {
                let mut faces: Vec<Face> = (0..1500)
                    .filter_map(|t| {
                        let corner = [0, 1].map(|_| random(&mut state, 16384));
                        let mut p = || corner.map(|c| c + random(&mut state, size) - size / 2);
                        let f = face([p(), p(), p()], t, &sampling)?;
                        let depth = random(&mut state, 50) as f32 / 50.0;
                        let depth = [0, 1, 2].map(|_| depth + random(&mut state, 3) as f32 / 100.0);
                        Some(deep(&f.x, &f.y, depth, t, &sampling))
                    })
                    .collect();
                let filled = |faces: &[Face]| {
                    let mut tile = Tile::new();
                    tile.fill(&faces.iter().collect::<Vec<_>>(), [0, 0], &sampling);
                    tile
                };
                let one = filled(&faces);
                faces.sort_by(|a, b| a.depth[0].total_cmp(&b.depth[0]));
                assert!(one.samples == filled(&faces).samples, "from near to far");
                faces.reverse();
                assert!(one.samples == filled(&faces).samples, "from far to near");
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
                    let f = face([p(), p(), p()], t, &sampling)?;
                    let depth = [0, 1, 2].map(|_| random(&mut state, 1000) as f32 / 1000.0);
                    Some(deep(&f.x, &f.y, depth, t, &sampling))
                })
                .collect();
            let (mut one, mut two) = (Tile::new(), Tile::new());
            let faces: Vec<&Face> = faces.iter().collect();
            one.fill(&faces, [0, 0], &sampling);
            fill_any(&mut two, &faces, [0, 0], &sampling);
            assert!(one.samples == two.samples);
        }
    }
}
