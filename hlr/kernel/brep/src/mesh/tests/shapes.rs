//! Loops and random numbers for tests.

use std::collections::HashMap;

use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, cross, dot, length, scaled, sub};
use crate::mesh::{FaceLoops, FaceMesh, LoopPoint};

const FRAME: [f64; 12] = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, -0.8, 0.6];

pub fn surface(kind: u8, more: &[f64]) -> Surface {
    Surface::read(kind, &[&FRAME, more].concat()).unwrap()
}

/// Loops on a surface; points at the same place in space get the same node.
pub fn loops(surface: &Surface, places: &[Vec<[f64; 2]>]) -> FaceLoops {
    let mut known: HashMap<[i64; 3], (u32, Vector)> = HashMap::new();
    let mut point = |&uv: &[f64; 2]| {
        let p = surface.d1(uv).0;
        let count = known.len() as u32;
        let &mut (node, point) = known.entry(p.map(|x| (x * 1e8).round() as i64)).or_insert((count, p));
        LoopPoint { uv, point, node }
    };
    FaceLoops { loops: places.iter().map(|l| l.iter().map(&mut point).collect()).collect(), periods: [0.0; 2] }
}

pub fn circle(centre: [f64; 2], radius: f64, count: usize, forward: bool) -> Vec<[f64; 2]> {
    let at = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / count as f64 * if forward { 1.0 } else { -1.0 };
        [centre[0] + radius * t.cos(), centre[1] + radius * t.sin()]
    };
    (0..count).map(at).collect()
}

/// The loop around a rectangle, with the given numbers of chords along u and along v.
pub fn frame(low: [f64; 2], high: [f64; 2], along_u: usize, along_v: usize) -> Vec<[f64; 2]> {
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let counts = [along_u, along_v, along_u, along_v];
    let mut out = Vec::new();
    for side in 0..4 {
        let (a, b) = (corners[side], corners[(side + 1) % 4]);
        for k in 0..counts[side] {
            let t = k as f64 / counts[side] as f64;
            // Exactly on the rectangle's sides.
            out.push([0, 1].map(|c| if a[c] == b[c] { a[c] } else { a[c] * (1.0 - t) + b[c] * t }));
        }
    }
    out
}

/// A small generator of random numbers, the same on all machines.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// Greatest distance from points of the surface, sampled within the triangles, to the mesh around them.
pub fn chord_error(surface: &Surface, mesh: &FaceMesh) -> f64 {
    const STEPS: usize = 8;
    let mut around = vec![Vec::new(); mesh.points.len()];
    for (k, t) in mesh.triangles.iter().enumerate() {
        t.iter().for_each(|&i| around[i as usize].push(k));
    }
    let corners = |k: usize| mesh.triangles[k].map(|i| mesh.points[i as usize]);
    let mut worst = 0.0f64;
    for (k, t) in mesh.triangles.iter().enumerate() {
        let uv = t.map(|i| mesh.uv[i as usize]);
        for i in 0..=STEPS {
            for j in 0..=STEPS - i {
                let (x, y) = (i as f64 / STEPS as f64, j as f64 / STEPS as f64);
                let z = 1.0 - x - y;
                let at = [0, 1].map(|k| x * uv[0][k] + y * uv[1][k] + z * uv[2][k]);
                let p = surface.d1(at).0;
                let own = from_triangle(&p, &corners(k));
                if own > worst {
                    let beside = t.iter().flat_map(|&i| &around[i as usize]);
                    worst = worst.max(beside.fold(own, |least, &k| least.min(from_triangle(&p, &corners(k)))));
                }
            }
        }
    }
    worst
}

fn from_triangle(p: &Vector, [a, b, c]: &[Vector; 3]) -> f64 {
    let n = cross(&sub(b, a), &sub(c, a));
    let square = dot(&n, &n);
    let inside = |from: &Vector, to: &Vector| dot(&cross(&sub(to, from), &sub(p, from)), &n) >= 0.0;
    if square > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return dot(&sub(p, a), &n).abs() / square.sqrt();
    }
    [(a, b), (b, c), (c, a)].iter().map(|(from, to)| from_segment(p, from, to)).fold(f64::INFINITY, f64::min)
}

fn from_segment(p: &Vector, a: &Vector, b: &Vector) -> f64 {
    let (d, q) = (sub(b, a), sub(p, a));
    let square = dot(&d, &d);
    let t = if square > 0.0 { (dot(&q, &d) / square).clamp(0.0, 1.0) } else { 0.0 };
    length(&sub(&q, &scaled(&d, t)))
}

/// Twice the total area of the triangles in (u, v).
pub fn area(mesh: &FaceMesh) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.uv[i as usize]);
        crate::mesh::plane::area(&a, &b, &c)
    };
    mesh.triangles.iter().map(of).sum()
}

/// Twice the area that the loops enclose.
pub fn enclosed(loops: &FaceLoops) -> f64 {
    let of = |l: &Vec<LoopPoint>| -> f64 {
        (0..l.len())
            .map(|k| {
                let (p, q) = (l[k].uv, l[(k + 1) % l.len()].uv);
                p[0] * q[1] - p[1] * q[0]
            })
            .sum()
    };
    loops.loops.iter().map(of).sum()
}
