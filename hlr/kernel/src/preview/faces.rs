//! Triangles as the raster takes them: corners on the grid of 1/256 pixel, depth at each, sorted into strips of the picture.

use rayon::prelude::*;

use super::Model;
use super::lens::Lens;
use super::near::cut;
use super::raster::{Sampling, TILE_HEIGHT};
use crate::geometry::vector::Vector;

/// Steps of the grid in a pixel.
pub const GRID: i32 = 256;
/// Most pixels a side: the raster's integers hold tiles of faces twice as large.
pub const MOST_PIXELS: usize = 16384;
/// Triangles a thread takes at a time.
const CHUNK: usize = 4096;

/// A triangle in the picture, its corners in the order of positive area, y down.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    pub x: [i32; 3],
    pub y: [i32; 3],
    pub depth: [f32; 3],
    pub triangle: u32,
}

/// The faces of some triangles, and which of them reach into which strip.
pub struct Chunk {
    pub faces: Vec<Face>,
    starts: Vec<u32>,
    listed: Vec<u32>,
}

impl Chunk {
    pub fn in_strip(&self, strip: usize) -> impl Iterator<Item = &Face> {
        let range = self.starts[strip] as usize..self.starts[strip + 1] as usize;
        self.listed[range].iter().map(|&i| &self.faces[i as usize])
    }
}

#[derive(Clone, Copy)]
struct Vertex {
    x: i32,
    y: i32,
    depth: f32,
}

impl Vertex {
    /// Not on the grid: behind the near plane, or too far outside.
    const OFF: Vertex = Vertex { x: i32::MIN, y: 0, depth: 0.0 };

    fn is_off(&self) -> bool {
        self.x == i32::MIN
    }
}

/// All faces that own a sample of the picture, in the order of the triangles. None when stopped.
pub fn faces(
    model: &Model,
    lens: &Lens,
    sampling: &Sampling,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Chunk>> {
    let (wide, high) = (lens.size[0] as f64 * f64::from(GRID), lens.size[1] as f64 * f64::from(GRID));
    let near = lens.near();
    let projector = lens.projector();
    let vertices: Vec<Vertex> = model
        .points
        .par_iter()
        .with_min_len(4096)
        .map(|p| {
            let [x, y, depth, z] = projector.project(p);
            let (x, y) = (x * f64::from(GRID), y * f64::from(GRID));
            // Half a picture beyond the border; what is no number is not within it either.
            let within = (x - 0.5 * wide).abs() <= wide && (y - 0.5 * high).abs() <= high && z >= near;
            if within { Vertex { x: nearest(x), y: nearest(y), depth: depth.max(0.0) as f32 } } else { Vertex::OFF }
        })
        .collect();
    let strips = sampling.strips(lens.size[1]);
    let count = model.triangles.len();
    let chunks: Vec<Chunk> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| {
            let mut faces = Vec::with_capacity(CHUNK);
            if !stopped() {
                for t in c * CHUNK..(c * CHUNK + CHUNK).min(count) {
                    let [a, b, c] = model.triangles[t];
                    let (a, b, c) = (vertices[a as usize], vertices[b as usize], vertices[c as usize]);
                    if a.is_off() || b.is_off() || c.is_off() {
                        cut_faces(model, lens, sampling, t, &mut faces);
                    } else {
                        add(a, b, c, t, model.cull[t], lens, sampling, &mut faces);
                    }
                }
            }
            listed(faces, sampling, strips)
        })
        .collect();
    (!stopped()).then_some(chunks)
}

#[inline(always)]
fn nearest(v: f64) -> i32 {
    // Rounded to even, without a call: 2^52 leaves no room for a fraction.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    ((v + ROUND) - ROUND) as i32
}

#[allow(clippy::too_many_arguments)]
#[inline(always)]
fn add(a: Vertex, b: Vertex, c: Vertex, t: usize, cull: bool, lens: &Lens, sampling: &Sampling, out: &mut Vec<Face>) {
    let area = i64::from(b.x - a.x) * i64::from(c.y - a.y) - i64::from(b.y - a.y) * i64::from(c.x - a.x);
    // With y down, what is counter-clockwise has a negative area.
    if area == 0 || (area > 0 && cull) {
        return;
    }
    let (b, c) = if area > 0 { (b, c) } else { (c, b) };
    let face = Face { x: [a.x, b.x, c.x], y: [a.y, b.y, c.y], depth: [a.depth, b.depth, c.depth], triangle: t as u32 };
    let (columns, rows) = (sampling.reach(&face.x, lens.size[0]), sampling.reach(&face.y, lens.size[1]));
    if columns[0] < columns[1] && rows[0] < rows[1] {
        out.push(face);
    }
}

#[cold]
fn cut_faces(model: &Model, lens: &Lens, sampling: &Sampling, t: usize, out: &mut Vec<Face>) {
    let corners: [Vector; 3] = model.triangles[t].map(|i| lens.view(&model.points[i as usize]));
    let polygon: Vec<Vertex> = cut(&corners, lens)
        .iter()
        .map(|v| {
            let place = lens.place(v).map(|c| c * f64::from(GRID));
            Vertex { x: nearest(place[0]), y: nearest(place[1]), depth: lens.depth(v[2]).max(0.0) as f32 }
        })
        .collect();
    for i in 2..polygon.len() {
        add(polygon[0], polygon[i - 1], polygon[i], t, model.cull[t], lens, sampling, out);
    }
}

/// A counting sort by strip.
fn listed(faces: Vec<Face>, sampling: &Sampling, strips: usize) -> Chunk {
    let reach: Vec<[u32; 2]> = faces
        .iter()
        .map(|f| {
            let rows = sampling.reach(&f.y, usize::MAX);
            [rows[0] as usize / TILE_HEIGHT, (rows[1] as usize - 1) / TILE_HEIGHT].map(|s| s.min(strips - 1) as u32)
        })
        .collect();
    let mut starts = vec![0u32; strips + 1];
    for r in &reach {
        for s in r[0]..=r[1] {
            starts[s as usize + 1] += 1;
        }
    }
    for s in 0..strips {
        starts[s + 1] += starts[s];
    }
    let mut next = starts.clone();
    let mut list = vec![0u32; starts[strips] as usize];
    for (i, r) in reach.iter().enumerate() {
        for s in r[0]..=r[1] {
            list[next[s as usize] as usize] = i as u32;
            next[s as usize] += 1;
        }
    }
    Chunk { faces, starts, listed: list }
}
