//! Projects the triangles of the model, rounds them to the grid of the picture, and sorts them roughly from near to
//! far.

use rayon::prelude::*;

use super::Model;
use super::face::{Chunk, Face, Vertex};
use super::grid::GRID;
use super::lens::Lens;
use super::near_clip::cut;
use super::plane::Plane;
use super::sampling::Sampling;
use super::workspace::Workspace;
use hlr_brep::geometry::vector::Vector;

/// Triangles that are sorted together, by their nearest corner: few enough that what lies in front is drawn first, and
/// many enough that sorting costs nothing.
const CHUNK: usize = 256;

/// Puts all faces that own a sample of the picture into `space.chunks`, roughly from near to far. Their order does not
/// change the picture; near faces first let hidden ones be skipped sooner. False when stopped.
pub fn faces(
    model: &Model,
    lens: &Lens,
    sampling: &Sampling,
    space: &mut Workspace,
    stopped: &(dyn Fn() -> bool + Sync),
) -> bool {
    let (wide, high) = (lens.size[0] as f64 * f64::from(GRID), lens.size[1] as f64 * f64::from(GRID));
    let near = lens.near();
    let projector = lens.projector();
    let project = |p: &Vector| {
        let [x, y, depth, z] = projector.project(p);
        let (x, y) = (x * f64::from(GRID), y * f64::from(GRID));
        // Half a picture beyond the border is allowed; NaN fails the test.
        let within = (x - 0.5 * wide).abs() <= wide && (y - 0.5 * high).abs() <= high && z >= near;
        if within { Vertex::at(x, y, depth.max(0.0)) } else { Vertex::OFF }
    };
    model.points.par_iter().with_min_len(4096).map(project).collect_into_vec(&mut space.vertices);
    let vertices = &space.vertices;
    let count = model.triangles.len();
    space.chunks.resize_with(count.div_ceil(CHUNK), Chunk::default);
    space.chunks.par_iter_mut().enumerate().with_min_len(16).for_each(|(c, chunk)| {
        chunk.faces.clear();
        if !stopped() {
            for t in c * CHUNK..(c * CHUNK + CHUNK).min(count) {
                let [a, b, c] = model.triangles[t];
                let (a, b, c) = (vertices[a as usize], vertices[b as usize], vertices[c as usize]);
                if a.is_off() || b.is_off() || c.is_off() {
                    cut_faces(model, lens, sampling, t, &mut chunk.faces);
                } else {
                    add(a, b, c, t, model.cull[t], lens, sampling, &mut chunk.faces);
                }
            }
        }
        chunk.nearest = chunk.faces.iter().flat_map(|f| f.depth).fold(f32::INFINITY, f32::min);
    });
    space.chunks.sort_by(|a, b| a.nearest.total_cmp(&b.nearest));
    !stopped()
}

#[allow(clippy::too_many_arguments)] // a triangle, its number, and how it is looked at
#[inline(always)]
fn add(a: Vertex, b: Vertex, c: Vertex, t: usize, cull: bool, lens: &Lens, sampling: &Sampling, out: &mut Vec<Face>) {
    let area = i64::from(b.x - a.x) * i64::from(c.y - a.y) - i64::from(b.y - a.y) * i64::from(c.x - a.x);
    // With y down, counter-clockwise triangles have a negative area.
    if area == 0 || (area > 0 && cull) {
        return;
    }
    let (b, c) = if area > 0 { (b, c) } else { (c, b) };
    let (x, y, depth) = ([a.x, b.x, c.x], [a.y, b.y, c.y], [a.depth, b.depth, c.depth]);
    let corners = [a.place(), b.place(), c.place()];
    let plane = Plane::through(&corners).unwrap_or_else(|| Plane::on_grid(&x, &y, &depth));
    let face = Face::new(x, y, depth.map(|z| z as f32), plane, t as u32, sampling, lens.size);
    if face.reach.iter().all(|r| r[0] < r[1]) {
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
            Vertex::at(place[0], place[1], lens.depth(v[2]).max(0.0))
        })
        .collect();
    for i in 2..polygon.len() {
        add(polygon[0], polygon[i - 1], polygon[i], t, model.cull[t], lens, sampling, out);
    }
}
