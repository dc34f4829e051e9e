//! Rasterizes narrow faces with one sample per pixel: all columns fit into one or two vectors, the three edge functions
//! at their columns, and one addition each from row to row. Most faces of a fine mesh are like that, and finding the
//! span of each row (`row_spans`) would cost more than looking at a few columns too many.
//!
//! ```text
//!            columns at .. at + 7
//!          +---------------+
//!   row 0  |     . x       |        a column is owned where no edge function is negative: their sign bits, or-ed
//!   row 1  |   . x x x     |
//!   row 2  | x x x x x x x |
//!          +---------------+
//! ```

use super::face::Face;
use super::grid::{GRID, LANES, TILE_HEIGHT, TILE_WIDTH};
use super::sampling::Sampling;
use super::slope::{Slope, nearer};

/// Number of vectors of lanes that hold the face's columns; 0: the face is too large.
#[inline(always)]
pub fn lanes(face: &Face) -> usize {
    let [columns, rows] = face.reach.map(|r| r[1].wrapping_sub(r[0]));
    let extent = |c: &[i32; 3]| c[0].max(c[1]).max(c[2]).wrapping_sub(c[0].min(c[1]).min(c[2]));
    let narrow = extent(&face.x) <= 2 * LANES as i32 * GRID && extent(&face.y) <= TILE_HEIGHT as i32 * GRID;
    if !narrow || rows > TILE_HEIGHT as i32 || columns > 2 * LANES as i32 {
        return 0;
    }
    if columns <= LANES as i32 { 1 } else { 2 }
}

/// `rows`: the rows of the tile that the face reaches.
#[inline(always)]
pub fn fill<const N: usize>(
    samples: &mut [[f64; TILE_WIDTH]; TILE_HEIGHT],
    face: &Face,
    first: [i32; 2],
    rows: [usize; 2],
) {
    const HALF: i32 = GRID / 2;
    const SHIFT: u32 = Sampling::CENTRES.shift;
    let at = face.reach[0][0].wrapping_sub(first[0]).clamp(0, (TILE_WIDTH - N * LANES) as i32);
    let x = (first[0].wrapping_add(at) << SHIFT).wrapping_add(HALF);
    let y = (first[1].wrapping_add(rows[0] as i32) << SHIFT).wrapping_add(HALF);
    let along = [0, 1, 2].map(|k: usize| x.wrapping_sub(face.x[k]));
    let down = [0, 1, 2].map(|k: usize| y.wrapping_sub(face.y[k]));
    // Distances are below 2^15 across and 2^16 down, growths below 2^14: 32 bits hold all values.
    let edge = |k: usize, n: usize| {
        let (a, b) = (face.y[k].wrapping_sub(face.y[n]), face.x[n].wrapping_sub(face.x[k]));
        let value = a.wrapping_mul(along[k]).wrapping_add(b.wrapping_mul(down[k]));
        // Left and top edges own what lies on them.
        let value = value.wrapping_sub(i32::from(!(a > 0 || (a == 0 && b > 0)))) >> SHIFT;
        let mut lanes = [[value; LANES]; N];
        for (l, v) in lanes.as_flattened_mut().iter_mut().enumerate() {
            *v = v.wrapping_add(a.wrapping_mul(l as i32));
        }
        (lanes, b)
    };
    let ((mut one, b1), (mut two, b2), (mut three, b3)) = (edge(0, 1), edge(1, 2), edge(2, 0));

    let slope = Slope::new(face, first, &Sampling::CENTRES);
    let at = at as usize;
    let depths = slope.shifted(at);
    for (row, samples) in samples[rows[0]..rows[1]].iter_mut().enumerate() {
        let (lanes, _) = samples[at..].as_chunks_mut::<LANES>();
        for (n, samples) in lanes.iter_mut().take(N).enumerate() {
            let mut outside = [0i32; LANES];
            for l in 0..LANES {
                outside[l] = (one[n][l] | two[n][l] | three[n][l]) >> 31;
                one[n][l] = one[n][l].wrapping_add(b1);
                two[n][l] = two[n][l].wrapping_add(b2);
                three[n][l] = three[n][l].wrapping_add(b3);
            }
            let z = depths.lanes(rows[0] + row, n);
            nearer(&outside, &z, face.triangle, samples);
        }
    }
}
