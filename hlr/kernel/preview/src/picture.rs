//! Shades the samples of each tile, once per pixel and triangle, and resolves them to pixels.

use super::NOTHING;
use super::faces::faces;
use super::grid::{TILE_HEIGHT, TILE_WIDTH};
use super::resolve::Encoder;
use super::sampling::Sampling;
use super::shade::{Ready, Scene};
use super::shading_cache::ShadingCache;
use super::tiles::{Filled, each_tile};
use super::transparent::{Layer, layers, over};
use super::workspace::Workspace;

/// Writes RGBA, row by row, into `out`. `background`: linear light, premultiplied. False when stopped.
pub fn picture(
    scene: &Scene,
    sampling: &Sampling,
    background: [f32; 4],
    space: &mut Workspace,
    out: &mut [[u8; 4]],
    stopped: &(dyn Fn() -> bool + Sync),
) -> bool {
    if !faces(scene.model, scene.lens, sampling, space, stopped) {
        return false;
    }
    let encoder = Encoder::new();
    let nothing = encoder.pixel(background);
    let painter = || Painter { scene, sampling, background, encoder: &encoder, kept: ShadingCache::new() };
    let size = scene.lens.size;
    each_tile(
        space,
        size,
        sampling,
        scene.model.transparent,
        out,
        Some(nothing),
        stopped,
        painter,
        |painter, filled, rows| {
            painter.tile(filled, rows, size[0]);
        },
    )
}

struct Painter<'a> {
    scene: &'a Scene<'a>,
    sampling: &'a Sampling,
    background: [f32; 4],
    encoder: &'a Encoder,
    kept: ShadingCache,
}

impl Painter<'_> {
    fn tile(&mut self, filled: &Filled, rows: &mut [[u8; 4]], width: usize) {
        self.kept.forget();
        let side = self.sampling.side;
        let left = filled.first[0] / side;
        let wide = (TILE_WIDTH / side).min(width - left);
        let mut found: Vec<Layer> = Vec::new();
        layers(filled.tile, filled.transparent, filled.first, self.sampling, &mut found);
        for (j, row) in rows.chunks_mut(width).take(TILE_HEIGHT / side).enumerate() {
            let row = &mut row[left..left + wide];
            if side == 1 && found.is_empty() {
                self.runs(filled, j, row);
                continue;
            }
            for (i, pixel) in row.iter_mut().enumerate() {
                if let Some(colour) = self.mean(filled, &found, [i * side, j * side]) {
                    *pixel = self.encoder.pixel(colour);
                }
            }
        }
    }

    /// A row with one opaque sample per pixel: run by run of one triangle.
    fn runs(&mut self, filled: &Filled, j: usize, row: &mut [[u8; 4]]) {
        let mut column = 0;
        while let Some((from, to, triangle)) = filled.tile.run(j, column) {
            if from >= row.len() {
                return;
            }
            let place = self.sampling.place(filled.first[0] + from, filled.first[1] + j);
            let (scene, encoder) = (self.scene, self.encoder);
            let to = to.min(row.len());
            scene.shade_run(self.ready(triangle, place), place, &mut row[from..to], encoder);
            column = to;
        }
    }

    #[inline(always)]
    fn colour(&mut self, triangle: u32, place: [f64; 2]) -> [f32; 4] {
        let scene = self.scene;
        scene.shade(self.ready(triangle, place), place)
    }

    #[inline(always)]
    fn ready(&mut self, triangle: u32, place: [f64; 2]) -> &Ready {
        let scene = self.scene;
        self.kept.get(triangle, || scene.ready(triangle, place))
    }

    /// The mean of a pixel's samples; `[i, j]` is the first, within the tile. None where all are background.
    fn mean(&mut self, filled: &Filled, layers: &[Layer], [i, j]: [usize; 2]) -> Option<[f32; 4]> {
        let side = self.sampling.side;
        let mut known = Known::default();
        let mut sum = [0.0f32; 4];
        let mut any = false;
        for y in j..j + side {
            for x in i..i + side {
                let place = self.sampling.place(filled.first[0] + x, filled.first[1] + y);
                let triangle = filled.tile.triangle(x, y);
                let mut here = self.background;
                if triangle != NOTHING {
                    any = true;
                    here = known.get(triangle, || opaque(self.colour(triangle, place)));
                }
                let sample = (y * TILE_WIDTH + x) as u16;
                let from = layers.partition_point(|l| l.sample < sample);
                for layer in layers[from..].iter().take_while(|l| l.sample == sample) {
                    any = true;
                    here = over(known.get(layer.triangle, || premultiplied(self.colour(layer.triangle, place))), here);
                }
                for k in 0..4 {
                    sum[k] += here[k];
                }
            }
        }
        let share = 1.0 / (side * side) as f32;
        any.then(|| sum.map(|c| c * share))
    }
}

fn opaque(c: [f32; 4]) -> [f32; 4] {
    [c[0], c[1], c[2], 1.0]
}

fn premultiplied(c: [f32; 4]) -> [f32; 4] {
    // Highlights on a transparent face fade with it here: close enough, and never brighter than white.
    [c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]]
}

/// Colours of the triangles of one pixel: each is shaded the first time it is met.
#[derive(Default)]
struct Known {
    entries: [(u32, [f32; 4]); 4],
    count: usize,
}

impl Known {
    fn get(&mut self, triangle: u32, shade: impl FnOnce() -> [f32; 4]) -> [f32; 4] {
        let held = self.count.min(self.entries.len());
        if let Some((_, colour)) = self.entries[..held].iter().find(|(t, _)| *t == triangle) {
            return *colour;
        }
        let colour = shade();
        self.entries[self.count % self.entries.len()] = (triangle, colour);
        self.count += 1;
        colour
    }
}
