//! Planar faces that hardly anything of their own body crosses: their triangles need not be tried one by one.
//!
//! ```text
//!       |   |     |   |       The walls of a plate's holes end on its top. Each lies below it, but for the corners that
//!     __|   |_____|   |__     are the top's own: so the whole top is done with, and not each of its triangles with
//!                             each wall whose box it overlaps.
//! ```

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use rayon::prelude::*;

use super::planar_faces::{NO_PLANE, PlanarFaces};
use super::surfaces::Surfaces;
use crate::boxes::aabb::{Aabb, Item};
use crate::boxes::tree::Tree;

/// To try the triangles of a smaller face costs less than to find out that nothing crosses it.
const FEW: u32 = 48;
/// A face that more triangles may meet is left to the search: it finds those that are near one another.
const MOST: u32 = 128;
/// How far corners of a planar face may lie off its plane, in grid units: they were rounded.
const ROUNDED: f64 = 2.0;
/// With fewer triangles a second thread gains nothing.
const ALONE: usize = 1 << 10;

#[derive(Clone, Copy)]
struct Face {
    group: i32,
    bounds: Aabb,
    largest: Largest,
}

/// The triangle of a face with the largest area, which gives its plane; of equally large ones that whose corners come
/// last. So the order of triangles and of their corners does not matter.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Largest {
    /// Doubled and squared.
    area: f64,
    /// In ascending order.
    corners: [[i32; 3]; 3],
}

impl Largest {
    fn new(surfaces: &Surfaces, t: usize) -> Largest {
        let mut corners = surfaces.triangles[t].map(|v| surfaces.points[v as usize]);
        corners.sort_unstable();
        Largest { area: normal(&corners).iter().map(|c| c * c).sum(), corners }
    }
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

/// The faces that are left out of the search within their group.
#[derive(Default)]
pub struct UncrossedFaces {
    /// Per planar face, by number.
    faces: Vec<bool>,
    /// A face and a triangle of the same group that may cross it after all: the pairs that are still to be tried.
    pub exceptions: Vec<(i32, u32)>,
}

impl UncrossedFaces {
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// face: a number, or NO_PLANE.
    #[inline]
    pub fn contains(&self, face: i32) -> bool {
        usize::try_from(face).is_ok_and(|f| self.faces.get(f) == Some(&true))
    }
}

/// Faces of many triangles that hardly anything of their own group meets but in their own corners and border.
pub fn uncrossed_faces(surfaces: &Surfaces, stopped: &(dyn Fn() -> bool + Sync)) -> UncrossedFaces {
    let faces = large_faces(surfaces);
    let planes: Vec<Option<Plane>> = faces.iter().map(|face| plane(face.as_ref()?)).collect();
    let with_plane = faces.iter().zip(&planes).enumerate().filter(|(_, (_, plane))| plane.is_some());
    let boxes: Vec<Item> = with_plane.filter_map(|(f, (face, _))| Some((face.as_ref()?.bounds, f as u32))).collect();
    if boxes.is_empty() {
        return UncrossedFaces::default();
    }
    let tree = Tree::new(&boxes);
    let met: Vec<AtomicU32> = faces.iter().map(|_| AtomicU32::new(0)).collect();
    let add_exceptions = |t: u32, out: &mut Vec<(i32, u32)>| {
        let (group, corners) = (surfaces.group[t as usize], &surfaces.triangles[t as usize]);
        if !surfaces.itself[group as usize] || stopped() {
            return;
        }
        tree.query(&surfaces.bounds(t), |f| {
            let (Some(face), Some(plane)) = (&faces[f as usize], &planes[f as usize]) else { return };
            if face.group != group || met[f as usize].load(Relaxed) > MOST {
                return;
            }
            let feet = surfaces.planar.feet_on(f as i32, t, corners);
            let free = (0..3).filter(|k| feet >> k & 1 == 0);
            let heights = free.map(|k| plane.height(&surfaces.points[corners[k] as usize]));
            if surfaces.planar.of[t as usize] == f as i32 {
                // A face whose corners lie off its plane is not judged by it.
                let off = heights.map(f64::abs).fold(0.0, f64::max) > ROUNDED;
                met[f as usize].fetch_add(if off { MOST + 1 } else { 0 }, Relaxed);
                return;
            }
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), h| (low.min(h), high.max(h)));
            if low <= 2.0 * ROUNDED && high >= -2.0 * ROUNDED {
                met[f as usize].fetch_add(1, Relaxed);
                out.push((f as i32, t));
            }
        });
    };
    let parts = (0..surfaces.triangles.len() as u32).into_par_iter().with_min_len(ALONE);
    let mut exceptions: Vec<(i32, u32)> = parts
        .fold(Vec::new, |mut out, t| {
            add_exceptions(t, &mut out);
            out
        })
        .reduce(Vec::new, |mut a, b| {
            a.extend(b);
            a
        });
    let few = |f: usize| planes[f].is_some() && met[f].load(Relaxed) <= MOST;
    let faces: Vec<bool> = (0..faces.len()).map(few).collect();
    exceptions.retain(|&(f, _)| faces[f as usize]);
    exceptions.sort_unstable();
    if !faces.contains(&true) {
        return UncrossedFaces::default();
    }
    UncrossedFaces { faces, exceptions }
}

/// By number: planar faces of many triangles, all of one group that is searched for passing through itself.
fn large_faces(surfaces: &Surfaces) -> Vec<Option<Face>> {
    let PlanarFaces { of, .. } = surfaces.planar;
    let count = of.iter().max().map_or(0, |&last| (last + 1).max(0) as usize);
    let mut triangles = vec![0; count];
    of.iter().filter(|f| **f != NO_PLANE).for_each(|&f| triangles[f as usize] += 1);
    let mut faces: Vec<Option<Face>> = vec![None; count];
    let mut mixed = vec![false; count];
    for (t, &f) in of.iter().enumerate().filter(|(_, f)| **f != NO_PLANE && triangles[**f as usize] >= FEW) {
        let (group, bounds) = (surfaces.group[t], surfaces.bounds(t as u32));
        let largest = Largest::new(surfaces, t);
        let face = faces[f as usize].get_or_insert(Face { group, bounds, largest });
        face.bounds = face.bounds.union(&bounds);
        mixed[f as usize] |= face.group != group;
        if largest > face.largest {
            face.largest = largest;
        }
    }
    for (face, mixed) in faces.iter_mut().zip(mixed) {
        if face.is_some_and(|f| mixed || !surfaces.itself[f.group as usize]) {
            *face = None;
        }
    }
    faces
}

fn normal(corners: &[[i32; 3]; 3]) -> [f64; 3] {
    let [p, q, r] = corners.map(|c| c.map(f64::from));
    let way = |to: [f64; 3]| [to[0] - p[0], to[1] - p[1], to[2] - p[2]];
    let (u, v) = (way(q), way(r));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The plane of a face's largest triangle. None where it has no area.
fn plane(face: &Face) -> Option<Plane> {
    let Largest { area, corners } = face.largest;
    let length = area.sqrt();
    (length > 0.0).then(|| Plane { origin: corners[0].map(f64::from), unit: normal(&corners).map(|c| c / length) })
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::Edges;
    use super::*;
    use crate::random::below;
    use hlr_mesh::topology::topology;

    const SIDE: i32 = 8;

    /// A square face of 8 x 8 x 2 triangles with walls below its border, and other triangles anywhere.
    fn scene(others: &[[[i32; 3]; 3]]) -> (Vec<[i32; 3]>, Vec<[i32; 3]>, Vec<i32>) {
        let step = 1000;
        let across = SIDE + 1;
        let at = |x: i32, y: i32| y * across + x;
        let mut points: Vec<[i32; 3]> =
            (0..across * across).map(|k| [step * (k % across), step * (k / across), 0]).collect();
        let mut triangles = Vec::new();
        for (x, y) in (0..SIDE * SIDE).map(|k| (k % SIDE, k / SIDE)) {
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
        let mut face = vec![0; triangles.len()];
        for (x, low) in (0..SIDE).zip(points.len() as i32..) {
            points.push([step * x + 300, -200 * (x % 2), -2 * step]);
            triangles.push([at(x + 1, 0), at(x, 0), low]);
            triangles.push([at(x + 1, 0), low, low + i32::from(x + 1 < SIDE)]);
        }
        for corners in others {
            let first = points.len() as i32;
            points.extend(corners);
            triangles.push([first, first + 1, first + 2]);
        }
        face.resize(triangles.len(), NO_PLANE);
        (points, triangles, face)
    }

    fn found(points: &[[i32; 3]], triangles: &[[i32; 3]], planar: &PlanarFaces) -> (Vec<[u32; 2]>, u64, bool) {
        let group = vec![0; triangles.len()];
        let surfaces = Surfaces { points, triangles, group: &group, itself: &[true], planar };
        let found = surfaces.clashes(&|| false);
        let uncrossed = uncrossed_faces(&surfaces, &|| false).contains(0);
        (found.found.iter().map(|c| c.triangles).collect(), found.tests, uncrossed)
    }

    #[test]
    fn what_is_found_is_the_same_with_and_without() {
        let mut below = below(7);
        let mut random = |low: i32, high: i32| low + below(high - low);
        let mut met = 0;
        for count in [0, 1, 3, 20, 3 * MOST as usize] {
            let mut corner = || [random(-500, 8500), random(-500, 8500), 1000 * random(-1, 2)];
            let others: Vec<[[i32; 3]; 3]> = (0..count).map(|_| [corner(), corner(), corner()]).collect();
            let (points, triangles, face) = scene(&others);
            let topology = topology(&triangles, points.len());
            let by = Edges { edges: &topology.edges, offsets: &topology.offsets, incident: &topology.incident };
            let known = PlanarFaces::new(face.clone(), &triangles, points.len(), &by);
            let (with, few, uncrossed) = found(&points, &triangles, &known);
            // Without a planar face every pair is tried.
            let (without, many, _) =
                found(&points, &triangles, &PlanarFaces::without_neighbours(vec![NO_PLANE; triangles.len()]));
            assert_eq!(with, without, "{count}");
            assert_eq!(uncrossed, count <= MOST as usize, "{count}");
            assert!(few < many, "{few} {many}");
            met += with.len();
        }
        assert!(met > 500, "{met}");
    }
}
