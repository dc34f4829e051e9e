//! Non-planar polygons of the model: each is triangulated first, and its triangles keep its id.
//!
//! Polygons that only rounding bends are left to `screen`, which checks the rounded corners.

use super::limits::Watch;
use super::plane::Point;
use super::scene::Scene;
use super::triangulate::triangulate;

/// Share of a polygon's size: corners nearer to its plane than this are in it.
const FLAT: f64 = 1e-7;
/// Steps of the grid across a polygon, for its triangulation.
const GRID: f64 = (1 << 21) as f64;

/// The arrays of a scene of planar polygons, and per polygon the one of the given scene that it comes from.
pub struct Planar {
    pub corners: Vec<i32>,
    pub loops: Vec<i32>,
    pub polygons: Vec<i32>,
    pub cull: Vec<bool>,
    pub owner: Vec<u32>,
}

/// Returns None where time ran out, Some(None) where all polygons are planar, as triangles are.
pub fn planar(scene: &Scene, watch: &Watch) -> Option<Option<Planar>> {
    let mut warped = Vec::new();
    for p in 0..scene.len() {
        if watch.over() {
            return None;
        }
        if is_warped(scene, p) {
            warped.push(p);
        }
    }
    if warped.is_empty() {
        return Some(None);
    }
    let mut out = Planar { corners: vec![], loops: vec![0], polygons: vec![0], cull: vec![], owner: vec![] };
    let mut warped = warped.into_iter().peekable();
    for p in 0..scene.len() {
        if watch.over() {
            return None;
        }
        match warped.next_if_eq(&p).and_then(|p| triangles(scene, p, watch)) {
            Some(triangles) => triangles.iter().for_each(|t| out.add(std::iter::once(&t[..]), scene.cull[p], p)),
            None => out.add(scene.loops_of(p), scene.cull[p], p),
        }
    }
    Some(Some(out))
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

/// A plane in the model: one of its points, and its unit normal.
#[derive(Clone, Copy, Debug)]
pub struct Flat {
    pub base: [f64; 3],
    pub normal: [f64; 3],
}

impl Flat {
    /// How far a point is before the plane.
    #[inline(always)]
    pub fn height(&self, p: &[f64; 3]) -> f64 {
        let (n, b) = (&self.normal, &self.base);
        n[0] * (p[0] - b[0]) + n[1] * (p[1] - b[1]) + n[2] * (p[2] - b[2])
    }
}

fn difference(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| b[k] - a[k])
}

fn cross(u: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(u: &[f64; 3], v: &[f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// The plane of a polygon through the three of its corners that span the largest triangle, found by changing one corner
/// at a time: the same rule as on the screen (`plane::widest`). Its normal is on the side of Newell's sum, from which
/// the loops run counter-clockwise. None where all corners lie on one line.
pub fn plane_of(scene: &Scene, polygon: usize) -> Option<Flat> {
    let size = size_of_polygon(scene, polygon);
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let base = scene.points[*scene.loops_of(polygon).flatten().next()? as usize];
    // Scaled to size 1, so that neither squares nor their squares overflow or underflow.
    let at = |i: i32| difference(&base, &scene.points[i as usize]).map(|c| c / size);
    let corners: Vec<[f64; 3]> = scene.loops_of(polygon).flatten().map(|&i| at(i)).collect();
    let normal = |t: &[usize; 3]| {
        let [p, q, r] = t.map(|k| &corners[k]);
        cross(&difference(p, q), &difference(p, r))
    };
    let square = |n: [f64; 3]| dot(&n, &n);
    let far = (0..corners.len()).max_by(|&i, &k| square(corners[i]).total_cmp(&square(corners[k])))?;
    let (mut best, mut largest, mut idle) = ([0, far, 0], 0.0, 0);
    for k in (0..3).rev().cycle().take(3 * 16) {
        let changed = |i: usize| {
            let mut t = best;
            t[k] = i;
            t
        };
        let area = |i: usize| square(normal(&changed(i)));
        let next = (0..corners.len()).max_by(|&i, &j| area(i).total_cmp(&area(j)))?;
        if area(next) > largest {
            (largest, best, idle) = (area(next), changed(next), 0);
        } else {
            idle += 1;
        }
        if idle == 3 {
            break;
        }
    }
    if largest <= 0.0 {
        return None;
    }
    let newell = scene.loops_of(polygon).fold([0.0f64; 3], |mut sum, l| {
        let mut p = at(l[l.len() - 1]);
        for &i in l {
            let q = at(i);
            let term = cross(&p, &q);
            (0..3).for_each(|k| sum[k] += term[k]);
            p = q;
        }
        sum
    });
    let n = normal(&best);
    let sign = if dot(&n, &newell) < 0.0 { -1.0 } else { 1.0 };
    let base = scene.points[*scene.loops_of(polygon).flatten().nth(best[0])? as usize];
    Some(Flat { base, normal: n.map(|c| sign * c / largest.sqrt()) })
}

fn is_warped(scene: &Scene, polygon: usize) -> bool {
    let mut corners = scene.loops_of(polygon).flatten();
    if corners.clone().count() <= 3 {
        return false;
    }
    let Some(plane) = plane_of(scene, polygon) else { return false };
    let size = size_of_polygon(scene, polygon);
    corners.any(|&i| plane.height(&scene.points[i as usize]).abs() > FLAT * size)
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
fn triangles(scene: &Scene, polygon: usize, watch: &Watch) -> Option<Vec<[i32; 3]>> {
    let normal = plane_of(scene, polygon)?.normal;
    let axis = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
    let size = size_of_polygon(scene, polygon);
    let (mut points, mut number, mut loops): (Vec<Point>, Vec<i32>, Vec<_>) = (vec![], vec![], vec![]);
    let base = scene.points[*scene.loops_of(polygon).flatten().next()? as usize];
    for l in scene.loops_of(polygon) {
        let start = points.len();
        for &i in l {
            let p = &scene.points[i as usize];
            let at = |k: usize| ((p[k] - base[k]) / size * GRID).round() as i64;
            points.push([at((axis + 1) % 3), at((axis + 2) % 3), 0]);
            number.push(i);
        }
        loops.push(start..points.len());
    }
    let found = triangulate(&points, &loops, scene.rule, watch)?;
    Some(found.into_iter().map(|t| t.map(|i| number[i])).collect())
}
