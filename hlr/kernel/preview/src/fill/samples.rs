//! Samples the picture at the points of a grid, one per pixel: the stack of visible faces, and their combined colour.

use std::collections::HashMap;
use std::iter::empty;

use super::runs::Runs;
use crate::NOTHING;
use crate::faces::faces;
use crate::grid::{TILE_HEIGHT, TILE_WIDTH};
use crate::resolve::Encoder;
use crate::sampling::Sampling;
use crate::shade::{Ready, Scene};
use crate::shading_cache::ShadingCache;
use crate::tiles::{Filled, each_tile};
use crate::transparent::{Layer, layers, over};
use crate::workspace::Workspace;

/// What is visible at a point.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// A number for the stack of faces above one another: 0 for nothing.
    pub stack: u64,
    /// The nearest triangle, and the nearest opaque one; NOTHING for none.
    pub front: u32,
    pub solid: u32,
    /// Lightness, 0 to 255.
    pub tone: f32,
    /// sRGB and opacity, 0 to 255.
    pub colour: [u8; 4],
}

const NONE: Sample = Sample { stack: 0, front: NOTHING, solid: NOTHING, tone: 0.0, colour: [0; 4] };

pub struct Grid {
    pub size: [usize; 2],
    pub samples: Vec<Sample>,
    /// Stretches of one stack in the rows, and the number of each one's stack, from 0 for nothing.
    pub runs: Runs,
    pub faces: Vec<u32>,
    /// Per number: the stack, and the triangle where it was first met.
    stacks: Vec<u64>,
    pub first: Vec<u32>,
}

impl Grid {
    /// Whether the stack with this number is visible at a place.
    pub fn shows(&self, place: usize, number: u32) -> bool {
        self.samples[place].stack == self.stacks[number as usize]
    }
}

/// None when stopped.
pub fn grid(scene: &Scene, label: &[i32], space: &mut Workspace, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Grid> {
    let sampling = Sampling::CENTRES;
    if !faces(scene.model, scene.lens, &sampling, space, stopped) {
        return None;
    }
    let size = scene.lens.size;
    let mut samples = vec![NONE; size[0] * size[1]];
    let encoder = Encoder::new();
    let looker = || Looker { scene, label, encoder: &encoder, kept: ShadingCache::new() };
    if !each_tile(
        space,
        size,
        &sampling,
        scene.model.transparent,
        &mut samples,
        None,
        stopped,
        looker,
        |l, filled, rows| {
            l.tile(filled, rows, size[0]);
        },
    ) {
        return None;
    }
    let runs = Runs::new(&samples, size[0], |a, b| a.stack == b.stack);
    let mut number: HashMap<u64, u32> = HashMap::from([(0, 0)]);
    let (mut stacks, mut first) = (vec![0], vec![NOTHING]);
    let face = |k: usize| {
        let sample = &samples[runs.places(k).start];
        *number.entry(sample.stack).or_insert_with(|| {
            stacks.push(sample.stack);
            first.push(sample.front);
            first.len() as u32 - 1
        })
    };
    let faces = (0..runs.count()).map(face).collect();
    Some(Grid { size, samples, runs, faces, stacks, first })
}

struct Looker<'a> {
    scene: &'a Scene<'a>,
    label: &'a [i32],
    encoder: &'a Encoder,
    kept: ShadingCache,
}

impl Looker<'_> {
    fn tile(&mut self, filled: &Filled, rows: &mut [Sample], width: usize) {
        self.kept.forget();
        let left = filled.first[0];
        let wide = TILE_WIDTH.min(width - left);
        let sampling = Sampling::CENTRES;
        let mut found: Vec<Layer> = Vec::new();
        layers(filled.tile, filled.transparent, filled.first, &sampling, &mut found);
        for (j, row) in rows.chunks_mut(width).take(TILE_HEIGHT).enumerate() {
            let row = &mut row[left..left + wide];
            if found.is_empty() {
                self.runs(filled, j, row);
                continue;
            }
            for (i, sample) in row.iter_mut().enumerate() {
                let place = sampling.place(left + i, filled.first[1] + j);
                let number = (j * TILE_WIDTH + i) as u16;
                let from = found.partition_point(|l| l.sample < number);
                let clear = found[from..].iter().take_while(|l| l.sample == number);
                *sample = self.look(filled.tile.triangle(i, j), clear.map(|l| l.triangle), place);
            }
        }
    }

    /// A row without transparent faces: run by run of one triangle.
    fn runs(&mut self, filled: &Filled, j: usize, row: &mut [Sample]) {
        let mut column = 0;
        while let Some((from, to, triangle)) = filled.tile.run(j, column) {
            if from >= row.len() {
                return;
            }
            let place = Sampling::CENTRES.place(filled.first[0] + from, filled.first[1] + j);
            column = to.min(row.len());
            let run = &mut row[from..column];
            let scene = self.scene;
            if let Ready::Flat(_) = self.kept.get(triangle, || scene.ready(triangle, place)) {
                run.fill(self.look(triangle, empty(), place));
                continue;
            }
            for (i, sample) in run.iter_mut().enumerate() {
                *sample = self.look(triangle, empty(), [place[0] + i as f64, place[1]]);
            }
        }
    }

    /// `clear`: transparent triangles before the opaque one, the farthest first.
    fn look(&mut self, solid: u32, clear: impl Iterator<Item = u32>, place: [f64; 2]) -> Sample {
        let (mut stack, mut front, mut sum) = (0u64, solid, [0.0f32; 4]);
        if solid != NOTHING {
            let c = self.colour(solid, place);
            sum = [c[0], c[1], c[2], 1.0];
            stack = mixed(stack, self.number(solid, c));
        }
        for triangle in clear {
            let c = self.colour(triangle, place);
            sum = over([c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]], sum);
            stack = mixed(stack, self.number(triangle, c));
            front = triangle;
        }
        if front == NOTHING {
            return NONE;
        }
        let light = (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / sum[3].max(1e-6);
        let colour = self.encoder.pixel(sum);
        Sample { stack: stack.max(1), front, solid, tone: 255.0 * light.max(0.0).sqrt(), colour }
    }

    fn colour(&mut self, triangle: u32, place: [f64; 2]) -> [f32; 4] {
        let scene = self.scene;
        let ready = self.kept.get(triangle, || scene.ready(triangle, place));
        scene.shade(ready, place)
    }

    /// The number of a triangle's face; where its corners have different colours, of the part of the face with this
    /// colour.
    fn number(&self, triangle: u32, colour: [f32; 4]) -> u64 {
        let paint = self.scene.model.paint[triangle as usize];
        let own = self.label[triangle as usize] as u64 + 1;
        if paint[0] == paint[1] && paint[1] == paint[2] {
            return own;
        }
        let [r, g, b, _] = self.encoder.pixel([colour[0], colour[1], colour[2], 1.0]).map(|c| u64::from(c >> 4));
        own | (1 + r + 16 * g + 256 * b) << 40
    }
}

/// Hash of a stack and one more face: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA
/// 2014.
fn mixed(stack: u64, number: u64) -> u64 {
    let mut z = stack.wrapping_mul(3).wrapping_add(number).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
