//! Ambient occlusion in screen space: the share of the hemisphere above a point that nearby surfaces block.
//!
//! M. McGuire, B. Osman, M. Bukowski, P. Hennessy, "The Alchemy screen-space ambient obscurance algorithm", High
//! Performance Graphics 2011: samples on a spiral around the pixel. A point at offset v that rises above the tangent
//! plane reduces the light by
//!
//! ```text
//!     max(0, v . n - bias) / (v . v + epsilon)
//! ```
//!
//! The spiral is turned by one of sixteen angles, chosen by the pixel's position in a square of 4 x 4. The mean over
//! that square, of pixels of about the same depth, removes the pattern. Nothing is random.

use hlr_exact::elementary::sin_cos;
use rayon::prelude::*;

use super::depth_map::MapSample;
use super::lens::Lens;
use super::surface::Surface;
use super::{Model, NOTHING};
use hlr_brep::geometry::vector::{Vector, along, dot, sub};

const SAMPLES: usize = 20;
const TURNS: f64 = 7.0;
/// Share of the radius: a rise below this counts as flat.
const BIAS: f64 = 0.02;
const STRENGTH: f64 = 1.1;

pub struct Occlusion {
    size: [usize; 2],
    /// Depth and openness, 1 for nothing above.
    map: Vec<[f32; 2]>,
    /// Depths that differ by less belong to one surface.
    alike: f32,
}

impl Occlusion {
    /// `radius` in pixels of the image plane. None when stopped.
    pub fn new(
        model: &Model,
        lens: &Lens,
        map: &[MapSample],
        radius: f64,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Option<Occlusion> {
        let [width, height] = lens.size;
        let reach = radius / lens.scale;
        let alike = (reach / (lens.range[1] - lens.range[0])).min(1.0) as f32;
        let mut raw = vec![1.0f32; width * height];
        raw.par_chunks_mut(width).enumerate().for_each(|(j, row)| {
            if stopped() {
                return;
            }
            let mut last: Option<(u32, Surface)> = None;
            for (i, open) in row.iter_mut().enumerate() {
                let here = map[j * width + i];
                if here.triangle == NOTHING {
                    continue;
                }
                if last.as_ref().is_none_or(|(t, _)| *t != here.triangle) {
                    last = Some((here.triangle, Surface::new(model, lens, here.triangle)));
                }
                if let Some((_, surface)) = &last {
                    *open = openness(lens, map, [i, j], surface, reach);
                }
            }
        });
        let map = (0..height)
            .into_par_iter()
            .flat_map_iter(|j| {
                let (raw, map) = (&raw, &map);
                (0..width).map(move |i| {
                    let here = map[j * width + i].depth;
                    let (mut sum, mut count) = (0.0, 0.0);
                    for y in j.saturating_sub(2)..(j + 2).min(height) {
                        for x in i.saturating_sub(2)..(i + 2).min(width) {
                            if (map[y * width + x].depth - here).abs() <= alike {
                                sum += raw[y * width + x];
                                count += 1.0;
                            }
                        }
                    }
                    [here, if count > 0.0 { sum / count } else { 1.0 }]
                })
            })
            .collect();
        (!stopped()).then_some(Occlusion { size: lens.size, map, alike })
    }

    /// Openness at a place, in pixels, of a surface of this depth: that of the surrounding pixel with the nearest
    /// depth.
    pub fn open(&self, place: [f64; 2], depth: f32) -> f32 {
        let at = |k: usize, by: i64| (place[k].floor() as i64 + by).clamp(0, self.size[k] as i64 - 1) as usize;
        let mut best = (f32::INFINITY, 1.0);
        for (dx, dy) in [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)] {
            let [there, open] = self.map[at(1, dy) * self.size[0] + at(0, dx)];
            let apart = (there - depth).abs();
            if apart < best.0 {
                best = (apart, open);
            }
        }
        if best.0 <= self.alike { best.1 } else { 1.0 }
    }
}

fn openness(lens: &Lens, map: &[MapSample], [i, j]: [usize; 2], surface: &Surface, reach: f64) -> f32 {
    let [width, height] = lens.size;
    let place = [i as f64 + 0.5, j as f64 + 0.5];
    let w = surface.weights([place[0] - lens.centre[0], place[1] - lens.centre[1]]);
    let n = surface.normal(w).map(f64::from);
    let here = surface.point(w);
    let ahead = lens.view(&here)[2];
    let pixels = reach * lens.scale * lens.distance.map_or(1.0, |d| d / ahead);
    let turn = f64::from(TURN[j & 3][i & 3]) / 16.0;
    let (mut sum, epsilon) = (0.0, 0.01 * reach * reach);
    for k in 0..SAMPLES {
        let share = (k as f64 + 0.5) / SAMPLES as f64;
        let (sin, cos) = sin_cos((share * TURNS + turn) * std::f64::consts::TAU);
        let x = place[0] + share * pixels * cos;
        let y = place[1] + share * pixels * sin;
        if x < 0.0 || y < 0.0 || x >= width as f64 || y >= height as f64 {
            continue;
        }
        let there = map[y as usize * width + x as usize];
        if there.triangle == NOTHING {
            continue;
        }
        let other = point_at(lens, [x.floor() + 0.5, y.floor() + 0.5], f64::from(there.depth));
        let v = sub(&other, &here);
        let square = dot(&v, &v);
        if square < 4.0 * reach * reach {
            sum += (dot(&v, &n) - BIAS * reach).max(0.0) / (square + epsilon);
        }
    }
    (1.0 - STRENGTH * sum * reach / SAMPLES as f64).clamp(0.0, 1.0) as f32
}

/// The turn of the spiral in each pixel of the square, sixteenths of a full turn; neighbours differ much.
const TURN: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The model point visible at a place, in pixels, at this depth.
fn point_at(lens: &Lens, place: [f64; 2], depth: f64) -> Vector {
    let ahead = lens.ahead_at(depth);
    let w = lens.distance.map_or(1.0, |d| ahead / d) / lens.scale;
    let x = (place[0] - lens.centre[0]) * w;
    let y = -(place[1] - lens.centre[1]) * w;
    along(&along(&along(&lens.origin, &lens.right, x), &lens.up, y), &lens.ahead, ahead)
}
