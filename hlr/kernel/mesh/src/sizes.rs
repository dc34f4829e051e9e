//! Bounding boxes, volumes and areas of groups of triangles.

use rayon::prelude::*;

#[derive(Debug, Default)]
pub struct Sizes {
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
pub fn sizes(points: &[[f64; 3]], triangles: &[[i32; 3]], group: &[i32], count: usize) -> Sizes {
    let (low, high) = boxes(points, triangles, group, count);
    let mut out = Sizes { count: vec![0; count], volume: vec![0.0; count], area: vec![0.0; count], low, high };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_and_an_empty_group() {
        let points = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]];
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let found = pool.install(|| sizes(&points, &triangles, &[1; 4], 2));
            assert_eq!((found.low[1], found.high[1]), ([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
            assert_eq!((found.count, found.volume), (vec![0, 4], vec![0.0, 1.0]));
            assert_eq!(found.area[1], 3.0 + 3f64.sqrt());
            assert!(found.low[0][0] > found.high[0][0]);
        }
    }
}
