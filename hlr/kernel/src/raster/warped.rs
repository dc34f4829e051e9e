//! Polygons that lie in no plane, in the model: each is triangulated before anything else, and its triangles keep its id.
//!
//! What rounding alone bends is left to `screen`, which looks at the rounded corners.

use super::plane::Point;
use super::scene::Scene;
use super::triangulate::triangulate;

/// Of a polygon's size: what lies nearer to its plane is planar.
const FLAT: f64 = 1e-7;
/// Steps across a polygon, for its triangulation.
const GRID: f64 = (1 << 21) as f64;

/// The arrays of a scene of planar polygons, and the polygon of the given scene that each is of.
pub struct Planar {
    pub corners: Vec<i32>,
    pub loops: Vec<i32>,
    pub polygons: Vec<i32>,
    pub cull: Vec<bool>,
    pub owner: Vec<u32>,
}

/// None where all polygons are planar, as triangles are.
pub fn planar(scene: &Scene) -> Option<Planar> {
    if !(0..scene.len()).any(|p| is_warped(scene, p)) {
        return None;
    }
    let mut out = Planar { corners: vec![], loops: vec![0], polygons: vec![0], cull: vec![], owner: vec![] };
    for p in 0..scene.len() {
        match is_warped(scene, p).then(|| triangles(scene, p)).flatten() {
            Some(triangles) => triangles.iter().for_each(|t| out.add(std::iter::once(&t[..]), scene.cull[p], p)),
            None => out.add(scene.loops_of(p), scene.cull[p], p),
        }
    }
    Some(out)
}

impl Planar {
    fn add<'a>(&mut self, loops: impl Iterator<Item = &'a [i32]>, cull: bool, owner: usize) {
        for l in loops {
            self.corners.extend_from_slice(l);
            self.loops.push(self.corners.len() as i32);
        }
        self.polygons.push(self.loops.len() as i32 - 1);
        self.cull.push(cull);
        self.owner.push(owner as u32);
    }
}

/// Newell's plane of a polygon in the model: normal of length 1 and offset; None where it has no area.
pub fn plane_of(scene: &Scene, polygon: usize) -> Option<[f64; 4]> {
    let base = scene.points[*scene.loops_of(polygon).flatten().next()? as usize];
    let at = |i: i32| -> [f64; 3] { std::array::from_fn(|k| scene.points[i as usize][k] - base[k]) };
    let mut n = [0.0f64; 3];
    let (mut mean, mut count, mut size) = ([0.0; 3], 0.0, 0.0f64);
    for l in scene.loops_of(polygon) {
        let mut p = at(l[l.len() - 1]);
        for &i in l {
            let q = at(i);
            n[0] += (p[1] - q[1]) * (p[2] + q[2]);
            n[1] += (p[2] - q[2]) * (p[0] + q[0]);
            n[2] += (p[0] - q[0]) * (p[1] + q[1]);
            for k in 0..3 {
                mean[k] += q[k];
                size = size.max(q[k].abs());
            }
            count += 1.0;
            p = q;
        }
    }
    if n.iter().all(|c| c.abs() <= FLAT * FLAT * size * size) {
        n = largest(scene, polygon, &base);
    }
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let n = n.map(|c| c / length);
    let offset = (0..3).map(|k| n[k] * (base[k] + mean[k] / count)).sum();
    Some([n[0], n[1], n[2], offset])
}

/// The normal of the largest triangle at the first corner: for loops that cross themselves so that their halves cancel.
fn largest(scene: &Scene, polygon: usize, base: &[f64; 3]) -> [f64; 3] {
    let from: Vec<[f64; 3]> = scene
        .loops_of(polygon)
        .flatten()
        .map(|&i| std::array::from_fn(|k| scene.points[i as usize][k] - base[k]))
        .collect();
    let mut best = ([0.0; 3], 0.0);
    for (k, u) in from.iter().enumerate() {
        for v in &from[k + 1..] {
            let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let size = n.iter().map(|c| c * c).sum::<f64>();
            if size > best.1 {
                best = (n, size);
            }
        }
    }
    best.0
}

fn is_warped(scene: &Scene, polygon: usize) -> bool {
    let mut corners = scene.loops_of(polygon).flatten();
    if corners.clone().count() <= 3 {
        return false;
    }
    let Some([a, b, c, d]) = plane_of(scene, polygon) else { return false };
    let size = size_of_polygon(scene, polygon);
    corners.any(|&i| {
        let p = &scene.points[i as usize];
        (a * p[0] + b * p[1] + c * p[2] - d).abs() > FLAT * size
    })
}

fn size_of_polygon(scene: &Scene, polygon: usize) -> f64 {
    let mut size = 0.0f64;
    for k in 0..3 {
        let all = scene.loops_of(polygon).flatten().map(|&i| scene.points[i as usize][k]);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        size = size.max(high - low);
    }
    size
}

/// Triangles of a polygon seen along its normal, as indices into the scene's points.
fn triangles(scene: &Scene, polygon: usize) -> Option<Vec<[i32; 3]>> {
    let normal = plane_of(scene, polygon)?;
    let axis = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
    let size = size_of_polygon(scene, polygon);
    let (mut points, mut number, mut loops): (Vec<Point>, Vec<i32>, Vec<_>) = (vec![], vec![], vec![]);
    let base = scene.points[*scene.loops_of(polygon).flatten().next()? as usize];
    for l in scene.loops_of(polygon) {
        let start = points.len();
        for &i in l {
            let p = &scene.points[i as usize];
            let at = |k: usize| ((p[k] - base[k]) / size * GRID).round() as i32;
            points.push([at((axis + 1) % 3), at((axis + 2) % 3), 0]);
            number.push(i);
        }
        loops.push(start..points.len());
    }
    let found = triangulate(&points, &loops, scene.rule)?;
    Some(found.into_iter().map(|t| t.map(|i| number[i])).collect())
}
