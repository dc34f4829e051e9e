//! Planar faces that nothing of their own body passes through: their triangles need not be tried one by one.
//!
//! ```text
//!       |   |     |   |       The walls of a plate's holes end on its top. Each lies below it, but for the corners that
//!     __|   |_____|   |__     are the top's own: so the whole top is done with, and not each of its triangles with
//!                             each wall whose box it overlaps.
//! ```

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::planar_faces::{NO_PLANE, PlanarFaces};
use super::search::Surfaces;
use crate::scan::box_tree::{Aabb, BoxTree};

/// A face of fewer triangles costs less than finding out that it is quiet.
const FEW: u32 = 6;
/// How far corners of a planar face may lie off its plane, in grid units: they were rounded.
const ROUNDED: f64 = 2.0;
/// With fewer triangles a second thread gains nothing.
const ALONE: usize = 1 << 12;

#[derive(Clone, Copy)]
struct Face {
    triangles: u32,
    group: i32,
    bounds: Aabb,
    /// The triangle with the largest area, and that area, doubled and squared.
    largest: u32,
    area: f64,
}

struct Plane {
    origin: [f64; 3],
    unit: [f64; 3],
}

impl Plane {
    #[inline]
    fn height(&self, point: &[i32; 3]) -> f64 {
        (0..3).map(|k| (f64::from(point[k]) - self.origin[k]) * self.unit[k]).sum()
    }
}

/// Per planar face, by number, whether nothing of its own group meets it but in its own corners and border.
pub fn quiet_faces(surfaces: &Surfaces, stopped: &(dyn Fn() -> bool + Sync)) -> Vec<bool> {
    let faces = large_faces(surfaces);
    let planes: Vec<Option<Plane>> = faces.iter().map(|face| plane(surfaces, face.as_ref()?)).collect();
    let off: Vec<AtomicBool> = planes.iter().map(|plane| AtomicBool::new(plane.is_none())).collect();
    let boxes = faces.iter().zip(&planes).enumerate().filter(|(_, (_, plane))| plane.is_some());
    let tree = BoxTree::new(boxes.filter_map(|(f, (face, _))| Some((face.as_ref()?.bounds, f as u32))).collect());
    let all = |f: &AtomicBool| f.load(Ordering::Relaxed);
    if off.iter().all(all) {
        return Vec::new();
    }
    (0..surfaces.triangles.len() as u32).into_par_iter().with_min_len(ALONE).for_each(|t| {
        if !surfaces.itself[surfaces.group[t as usize] as usize] || stopped() {
            return;
        }
        tree.query(&surfaces.bounds(t), |f| {
            let (Some(face), Some(plane)) = (&faces[f as usize], &planes[f as usize]) else { return };
            let own = surfaces.planar.of[t as usize] == f as i32;
            if face.group != surfaces.group[t as usize] || off[f as usize].load(Ordering::Relaxed) {
                return;
            }
            let corners = &surfaces.triangles[t as usize];
            let feet = surfaces.planar.feet_on(f as i32, t, corners);
            let heights = || {
                let free = (0..3).filter(|k| feet >> k & 1 == 0);
                free.map(|k| plane.height(&surfaces.points[corners[k] as usize]))
            };
            let flat = own && heights().all(|h| h.abs() <= ROUNDED);
            let beside = !own && (heights().all(|h| h > 2.0 * ROUNDED) || heights().all(|h| h < -2.0 * ROUNDED));
            if !flat && !beside {
                off[f as usize].store(true, Ordering::Relaxed);
            }
        });
    });
    off.iter().map(|off| !off.load(Ordering::Relaxed)).collect()
}

/// By number: planar faces of many triangles, all of one group that is searched for passing through itself.
fn large_faces(surfaces: &Surfaces) -> Vec<Option<Face>> {
    let PlanarFaces { of, .. } = surfaces.planar;
    let count = of.iter().max().map_or(0, |&last| (last + 1).max(0) as usize);
    let mut faces: Vec<Option<Face>> = vec![None; count];
    let mut mixed = vec![false; count];
    for (t, &f) in of.iter().enumerate().filter(|(_, f)| **f != NO_PLANE) {
        let (group, bounds) = (surfaces.group[t], surfaces.bounds(t as u32));
        let area = area(surfaces, t);
        let new = Face { triangles: 0, group, bounds, largest: t as u32, area };
        let face = faces[f as usize].get_or_insert(new);
        face.triangles += 1;
        face.bounds = face.bounds.union(&bounds);
        mixed[f as usize] |= face.group != group;
        if area > face.area {
            (face.largest, face.area) = (t as u32, area);
        }
    }
    for (face, mixed) in faces.iter_mut().zip(mixed) {
        if face.is_some_and(|f| mixed || f.triangles < FEW || !surfaces.itself[f.group as usize]) {
            *face = None;
        }
    }
    faces
}

fn normal(surfaces: &Surfaces, t: usize) -> ([f64; 3], [f64; 3]) {
    let [p, q, r] = surfaces.triangles[t].map(|v| surfaces.points[v as usize].map(f64::from));
    let way = |to: [f64; 3]| [to[0] - p[0], to[1] - p[1], to[2] - p[2]];
    let (u, v) = (way(q), way(r));
    (p, [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
}

fn area(surfaces: &Surfaces, t: usize) -> f64 {
    normal(surfaces, t).1.iter().map(|c| c * c).sum()
}

/// The plane of a face's largest triangle. None where it has no area.
fn plane(surfaces: &Surfaces, face: &Face) -> Option<Plane> {
    let (origin, normal) = normal(surfaces, face.largest as usize);
    let length = face.area.sqrt();
    (length > 0.0).then(|| Plane { origin, unit: normal.map(|c| c / length) })
}
