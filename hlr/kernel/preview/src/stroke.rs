//! Draws antialiased lines on top of a picture.
//!
//! Coverage of a pixel is taken across the line only: the length that a box of one pixel, centred at the distance d
//! from the axis, shares with the line's width. Where several pieces cover a pixel the greatest counts, so that a line
//! is not darker where its pieces join.
//!
//! ```text
//!    -h      0   d   h            shared = min(d + 1/2, h) - max(d - 1/2, -h)
//!     |======+======|
//!               [---+---]
//! ```

use hlr_exact::elementary::hypot;
use rayon::prelude::*;

/// A straight piece with round ends, in pixels.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub half: f64,
}

const BAND: usize = 32;

/// Draws pieces of one colour (straight sRGB and opacity) over an RGBA picture. False when stopped.
pub fn stroke(
    picture: &mut [[u8; 4]],
    width: usize,
    pieces: &[Piece],
    colour: [u8; 4],
    stopped: &(dyn Fn() -> bool + Sync),
) -> bool {
    let height = picture.len() / width.max(1);
    let bands = height.div_ceil(BAND);
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); bands];
    for (k, p) in pieces.iter().enumerate() {
        let reach = p.half + 1.0;
        let rows = span(p.from[1].min(p.to[1]) - reach, p.from[1].max(p.to[1]) + reach, height);
        if rows[0] < rows[1] {
            for list in &mut lists[rows[0] / BAND..=(rows[1] - 1) / BAND] {
                list.push(k as u32);
            }
        }
    }
    picture.par_chunks_mut(BAND * width).zip(lists).enumerate().for_each(|(band, (rows, list))| {
        if list.is_empty() || stopped() {
            return;
        }
        let mut cover = vec![0.0f32; rows.len()];
        for &k in &list {
            paint(&pieces[k as usize], band * BAND, width, &mut cover);
        }
        for (pixel, &share) in rows.iter_mut().zip(&cover) {
            if share > 0.0 {
                *pixel = blended(*pixel, colour, share);
            }
        }
    });
    !stopped()
}

/// Whole pixels from `low` to `high`, within 0..most.
fn span(low: f64, high: f64, most: usize) -> [usize; 2] {
    [low.floor(), high.ceil()].map(|v| v.clamp(0.0, most as f64) as usize)
}

fn paint(p: &Piece, top: usize, width: usize, cover: &mut [f32]) {
    let reach = p.half + 1.0;
    let height = cover.len() / width;
    let rows = span(p.from[1].min(p.to[1]) - reach - top as f64, p.from[1].max(p.to[1]) + reach - top as f64, height);
    let along = [p.to[0] - p.from[0], p.to[1] - p.from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    for j in rows[0]..rows[1] {
        let y = (top + j) as f64 + 0.5;
        // Only the part of the piece near this row decides the columns.
        let columns = near_row(p, along, y, reach, width);
        for i in columns[0]..columns[1] {
            let q = [i as f64 + 0.5 - p.from[0], y - p.from[1]];
            let t = if square > 0.0 { ((q[0] * along[0] + q[1] * along[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
            let d = hypot(q[0] - t * along[0], q[1] - t * along[1]);
            let shared = ((d + 0.5).min(p.half) - (d - 0.5).max(-p.half)).clamp(0.0, 1.0) as f32;
            let here = &mut cover[j * width + i];
            *here = here.max(shared);
        }
    }
}

fn near_row(p: &Piece, along: [f64; 2], y: f64, reach: f64, width: usize) -> [usize; 2] {
    let (mut a, mut b) = (0.0, 1.0);
    if along[1] != 0.0 {
        let at = |y: f64| ((y - p.from[1]) / along[1]).clamp(0.0, 1.0);
        let ends = [at(y - reach), at(y + reach)];
        (a, b) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    }
    let x = [a, b].map(|t: f64| p.from[0] + t * along[0]);
    span(x[0].min(x[1]) - reach, x[0].max(x[1]) + reach, width)
}

/// Blends sRGB values, not linear light, as other programs draw lines: in linear light they would look thin.
fn blended(under: [u8; 4], colour: [u8; 4], share: f32) -> [u8; 4] {
    let a = share * f32::from(colour[3]) / 255.0;
    let below = f32::from(under[3]) / 255.0;
    let alpha = a + below * (1.0 - a);
    let mut out = [0, 0, 0, (alpha * 255.0 + 0.5) as u8];
    for k in 0..3 {
        let mixed = (a * f32::from(colour[k]) + (1.0 - a) * below * f32::from(under[k])) / alpha;
        out[k] = (mixed + 0.5) as u8;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_two_pixels_wide_between_pixels_fills_two_rows() {
        let mut picture = vec![[255, 255, 255, 255]; 100];
        stroke(&mut picture, 10, &[Piece { from: [-5.0, 5.0], to: [15.0, 5.0], half: 1.0 }], [0, 0, 0, 255], &|| false);
        let rows: Vec<u8> = (0..10).map(|j| picture[j * 10 + 5][0]).collect();
        assert_eq!(rows, [255, 255, 255, 255, 0, 0, 255, 255, 255, 255]);
    }

    #[test]
    fn a_thin_line_is_as_grey_as_it_is_thin() {
        let mut picture = vec![[255, 255, 255, 255]; 100];
        stroke(&mut picture, 10, &[Piece { from: [5.5, -5.0], to: [5.5, 15.0], half: 0.1 }], [0, 0, 0, 255], &|| false);
        assert_eq!(picture[55], [204, 204, 204, 255]);
        assert_eq!(picture[53], [255; 4]);
    }
}
