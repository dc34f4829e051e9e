//! Bounding boxes, volumes, areas and convexity of groups of triangles.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

#[derive(Debug, Default)]
pub struct Groups {
    /// Bounding boxes; infinite, with low above high, for groups without triangles.
    pub low: Vec<[f64; 3]>,
    pub high: Vec<[f64; 3]>,
    pub count: Vec<u32>,
    /// Six times the signed volume about the box's lower corner: small numbers, so that a far-away part keeps its sign.
    pub volume: Vec<f64>,
    /// Twice the area.
    pub area: Vec<f64>,
}

/// Number of triangles that are measured in parallel before they are added up.
const CHUNK: usize = 1 << 16;

/// `group`: per triangle, below `count`. Sums run in the order of the triangles, whatever the number of threads.
pub fn groups(points: &[[f64; 3]], triangles: &[[i32; 3]], group: &[i32], count: usize) -> Groups {
    let (low, high) = boxes(points, triangles, group, count);
    let mut out = Groups { count: vec![0; count], volume: vec![0.0; count], area: vec![0.0; count], low, high };
    for (triangles, group) in triangles.chunks(CHUNK).zip(group.chunks(CHUNK)) {
        let measured: Vec<[f64; 2]> = triangles
            .par_iter()
            .zip(group)
            .with_min_len(1 << 10)
            .map(|(t, &g)| measured(t.map(|v| &points[v as usize]), &out.low[g as usize]))
            .collect();
        for (&g, [volume, area]) in group.iter().zip(measured) {
            let g = g as usize;
            out.count[g] += 1;
            out.volume[g] += volume;
            out.area[g] += area;
        }
    }
    out
}

fn measured(corners: [&[f64; 3]; 3], origin: &[f64; 3]) -> [f64; 2] {
    let [p, q, r] = corners.map(|c| [0, 1, 2].map(|k| c[k] - origin[k]));
    let six =
        p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    let (u, v) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    [six, (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()]
}

type Corners = Vec<[f64; 3]>;

fn boxes(points: &[[f64; 3]], triangles: &[[i32; 3]], group: &[i32], count: usize) -> (Corners, Corners) {
    let empty = || (vec![[f64::INFINITY; 3]; count], vec![[f64::NEG_INFINITY; 3]; count]);
    let part = |triangles: &[[i32; 3]], group: &[i32]| {
        let (mut low, mut high) = empty();
        for (t, &g) in triangles.iter().zip(group) {
            let (low, high) = (&mut low[g as usize], &mut high[g as usize]);
            for p in t.map(|v| &points[v as usize]) {
                for k in 0..3 {
                    low[k] = low[k].min(p[k]);
                    high[k] = high[k].max(p[k]);
                }
            }
        }
        (low, high)
    };
    // A table of boxes for each thread, where there are few groups.
    let threads = rayon::current_num_threads();
    if threads == 1 || count.saturating_mul(4 * threads) > triangles.len() {
        return part(triangles, group);
    }
    let chunk = triangles.len().div_ceil(threads).max(1);
    let parts: Vec<(Corners, Corners)> =
        triangles.par_chunks(chunk).zip(group.par_chunks(chunk)).map(|(t, g)| part(t, g)).collect();
    parts.into_iter().fold(empty(), |(mut low, mut high), (l, h)| {
        low.as_flattened_mut().iter_mut().zip(l.as_flattened()).for_each(|(a, b)| *a = a.min(*b));
        high.as_flattened_mut().iter_mut().zip(h.as_flattened()).for_each(|(a, b)| *a = a.max(*b));
        (low, high)
    })
}

/// Edges with their triangles, and normals of these.
#[derive(Clone, Copy)]
pub struct Edges<'a> {
    pub edges: &'a [[i32; 2]],
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    pub normals: &'a [[f64; 3]],
}

/// Per group: an edge bends inward by more than the group's `least`, or has other than two triangles.
pub fn bent(points: &[[f64; 3]], triangles: &[[i32; 3]], mesh: Edges, group: &[i32], least: &[f64]) -> Vec<bool> {
    let bent: Vec<AtomicBool> = least.iter().map(|_| AtomicBool::new(false)).collect();
    mesh.edges.par_iter().enumerate().with_min_len(1 << 10).for_each(|(e, &[a, b])| {
        let around = &mesh.incident[mesh.offsets[e] as usize..mesh.offsets[e + 1] as usize];
        let Some(&s) = around.first() else { return };
        let own = group[s as usize] as usize;
        if bent[own].load(Ordering::Relaxed) {
            return;
        }
        let hollow = |t: i32| {
            let apex = triangles[t as usize].iter().map(|&v| i64::from(v)).sum::<i64>() - i64::from(a) - i64::from(b);
            // An edge that is none of the triangle's sides has no such point.
            let Some(apex) = usize::try_from(apex).ok().and_then(|v| points.get(v)) else { return true };
            let (foot, n) = (&points[a as usize], &mesh.normals[s as usize]);
            (0..3).map(|k| n[k] * (apex[k] - foot[k])).sum::<f64>() > least[own]
        };
        if around.len() != 2 || hollow(around[1]) {
            bent[own].store(true, Ordering::Relaxed);
        }
    });
    bent.into_iter().map(AtomicBool::into_inner).collect()
}

/// Number of connected pieces of each group; `piece`: per triangle, numbered in order of appearance.
pub fn pieces(group: &[i32], piece: &[i32], count: usize) -> Vec<u32> {
    let mut out = vec![0; count];
    let mut next = 0;
    for (&g, &p) in group.iter().zip(piece) {
        if p == next {
            out[g as usize] += 1;
            next += 1;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::{normals, topology};

    #[test]
    fn a_tetrahedron_and_an_empty_group() {
        let points = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]];
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let found = pool.install(|| groups(&points, &triangles, &[1; 4], 2));
            assert_eq!((found.low[1], found.high[1]), ([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
            assert_eq!((found.count, found.volume), (vec![0, 4], vec![0.0, 1.0]));
            assert_eq!(found.area[1], 3.0 + 3f64.sqrt());
            assert!(found.low[0][0] > found.high[0][0]);
        }
    }

    #[test]
    fn what_is_open_or_hollow_is_bent() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let told = |triangles: &[[i32; 3]]| {
            let t = topology(triangles, 4);
            let normals = normals(&points, triangles);
            let mesh = Edges { edges: &t.edges, offsets: &t.offsets, incident: &t.incident, normals: &normals };
            bent(&points, triangles, mesh, &vec![0; triangles.len()], &[1e-9])[0]
        };
        assert!(!told(&triangles) && told(&triangles[1..]));
        assert!(told(&triangles.map(|[a, b, c]| [a, c, b])));
    }

    #[test]
    fn pieces_of_groups() {
        assert_eq!(pieces(&[0, 0, 1, 0], &[0, 1, 2, 0], 3), [2, 1, 0]);
    }
}
