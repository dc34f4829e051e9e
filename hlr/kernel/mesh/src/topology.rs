//! Every mesh edge with its triangles: once per model, whatever the view.

use std::ops::Range;

use rayon::prelude::*;

pub struct Topology {
    pub edges: Vec<[i32; 2]>,
    pub offsets: Vec<i32>,
    pub incident: Vec<i32>,
}

/// Edges (lo < hi, ascending) and the triangles incident to each, ascending. Triangles with a repeated corner
/// contribute their remaining edge twice, which cancels in every jump.
///
/// Bucketed by the lower vertex first: what is left to sort are the few edges around one vertex. Each thread has a
/// range of vertices of its own and goes through all triangles for them.
pub fn topology(triangles: &[[i32; 3]], n_points: usize) -> Topology {
    let mut first = vec![0u32; n_points + 1];
    for t in triangles {
        for (low, _, proper) in sides(t) {
            first[low + 1] += u32::from(proper);
        }
    }
    for v in 0..n_points {
        first[v + 1] += first[v];
    }
    let total = first[n_points] as usize;
    let ranges = ranges(&first, if total < FEW { 1 } else { rayon::current_num_threads() });
    let mut around = vec![0u64; total];
    let counts: Vec<usize> = parted(&mut around, ranges.iter().map(|r| (first[r.end] - first[r.start]) as usize))
        .into_par_iter()
        .zip(&ranges)
        .map(|(around, range)| fans(triangles, &first, range, around))
        .collect();
    let count: usize = counts.iter().sum();
    let (mut edges, mut offsets, mut incident) = (vec![[0; 2]; count], vec![0; count + 1], vec![0; total]);
    offsets[count] = total as i32;
    let rows = parted(&mut edges, counts.iter().copied()).into_iter().zip(parted(&mut offsets, counts.iter().copied()));
    incident.par_iter_mut().zip(&around).for_each(|(t, side)| *t = (side & 0xffff_ffff) as i32);
    rows.zip(&ranges).par_bridge().for_each(|((edges, offsets), range)| {
        let mut next = 0;
        for v in range.clone() {
            let mut last = u64::MAX;
            for (at, side) in (first[v]..).zip(&around[first[v] as usize..first[v + 1] as usize]) {
                let high = side >> 32;
                if high != last {
                    (edges[next], offsets[next]) = ([v as i32, high as i32], at as i32);
                    (last, next) = (high, next + 1);
                }
            }
        }
    });
    Topology { edges, offsets, incident }
}

/// Sides below which one thread does all.
const FEW: usize = 1 << 14;

/// Per side: the lower and the higher corner, and whether they differ.
fn sides(t: &[i32; 3]) -> [(usize, u64, bool); 3] {
    let [p, q, r] = *t;
    [(p, q), (q, r), (r, p)].map(|(a, b)| (a.min(b) as usize, a.max(b) as u64, a != b))
}

/// Divides the vertices into `count` ranges of about as many sides each.
fn ranges(first: &[u32], count: usize) -> Vec<Range<usize>> {
    let total = u64::from(first[first.len() - 1]);
    let end =
        |k: usize| first.partition_point(|&f| u64::from(f) * (count as u64) < total * k as u64).min(first.len() - 1);
    let mut out = Vec::with_capacity(count);
    let mut start = 0;
    for k in 1..=count {
        let end = if k == count { first.len() - 1 } else { end(k).max(start) };
        out.push(start..end);
        start = end;
    }
    out
}

/// Divides a slice into pieces of these lengths, one after another.
fn parted<T>(mut rest: &mut [T], lengths: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    lengths
        .map(|length| {
            let (piece, after) = std::mem::take(&mut rest).split_at_mut(length);
            rest = after;
            piece
        })
        .collect()
}

/// The sides whose lower corner is in `range`, as higher corner and triangle, sorted around each vertex; and how many
/// edges they make.
fn fans(triangles: &[[i32; 3]], first: &[u32], range: &Range<usize>, around: &mut [u64]) -> usize {
    let base = first[range.start];
    let mut next: Vec<u32> = first[range.clone()].iter().map(|f| f - base).collect();
    for (t, corners) in triangles.iter().enumerate() {
        for (low, high, proper) in sides(corners) {
            if proper && range.contains(&low) {
                let place = &mut next[low - range.start];
                around[*place as usize] = (high << 32) | t as u64;
                *place += 1;
            }
        }
    }
    let mut count = 0;
    for v in range.clone() {
        let fan = &mut around[(first[v] - base) as usize..(first[v + 1] - base) as usize];
        fan.sort_unstable();
        count += fan.chunk_by(|a, b| a >> 32 == b >> 32).count();
    }
    count
}

/// Triangles that have the three corners of another one, in whatever order: of each set at least one, ascending.
pub fn repeated(triangles: &[[i32; 3]], topology: &Topology) -> Vec<i32> {
    let Topology { edges, offsets, incident } = topology;
    let at_edge = |e: usize| {
        let around = &incident[offsets[e] as usize..offsets[e + 1] as usize];
        let third = |t: i32| triangles[t as usize].iter().map(|&v| i64::from(v)).sum::<i64>();
        match around {
            [] | [_] => None,
            [s, t] => (s != t && third(*s) == third(*t)).then(|| vec![*t]),
            _ => {
                // A triangle with a repeated corner is listed twice itself.
                let mut all: Vec<(i64, i32)> = around.iter().map(|&t| (third(t), t)).collect();
                all.sort_unstable();
                all.dedup();
                Some(all.windows(2).filter(|w| w[0].0 == w[1].0).map(|w| w[1].1).collect())
            }
        }
    };
    let mut found: Vec<i32> = (0..edges.len()).into_par_iter().filter_map(at_edge).flatten_iter().collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Per edge, triangles that run along it minus triangles that run against it: zero everywhere on a closed, consistently
/// oriented surface.
pub fn balance(triangles: &[[i32; 3]], edges: &[[i32; 2]], offsets: &[i32], incident: &[i32]) -> Vec<i32> {
    edges
        .par_iter()
        .enumerate()
        .map(|(e, &[lo, hi])| {
            let around = &incident[offsets[e] as usize..offsets[e + 1] as usize];
            let along = |&t: &i32| {
                let [p, q, r] = triangles[t as usize];
                if (p == lo && q == hi) || (q == lo && r == hi) || (r == lo && p == hi) { 1 } else { -1 }
            };
            around.iter().map(along).sum()
        })
        .collect()
}

/// Unit normals; zero for triangles without area.
pub fn normals(points: &[[f64; 3]], triangles: &[[i32; 3]]) -> Vec<[f64; 3]> {
    triangles
        .par_iter()
        .map(|t| {
            let [p, q, r] = t.map(|v| points[v as usize]);
            let (u, v) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
            let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
        })
        .collect()
}

/// Cosine of the fold at every edge of two triangles: 1 flat, -1 lapped over. NaN where there are not two, or where one
/// has no area. Triangles oriented against each other fold by the supplement.
pub fn folds(normals: &[[f64; 3]], offsets: &[i32], incident: &[i32], balance: &[i32]) -> Vec<f64> {
    (0..balance.len())
        .into_par_iter()
        .map(|e| {
            let &[s, t] = &incident[offsets[e] as usize..offsets[e + 1] as usize] else { return f64::NAN };
            let (m, n) = (&normals[s as usize], &normals[t as usize]);
            if m == &[0.0; 3] || n == &[0.0; 3] {
                return f64::NAN;
            }
            let cosine = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
            if balance[e] == 0 { cosine } else { -cosine }
        })
        .collect()
}

/// A label per cell (edge or triangle): cells that share vertices have the same; labels count up in order of
/// appearance.
pub fn components<const N: usize>(cells: &[[i32; N]], n_points: usize) -> Vec<i32> {
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    let mut parent: Vec<u32> = (0..n_points as u32).collect();
    for t in cells {
        let a = root(&mut parent, t[0] as u32);
        for &v in &t[1..] {
            let b = root(&mut parent, v as u32);
            parent[b as usize] = a;
        }
    }
    let mut label = vec![-1; n_points];
    let mut next = 0;
    cells
        .iter()
        .map(|t| {
            let r = root(&mut parent, t[0] as u32) as usize;
            if label[r] < 0 {
                label[r] = next;
                next += 1;
            }
            label[r]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_has_six_edges_of_two_triangles() {
        let t = topology(&[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], 4);
        assert_eq!(t.edges, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]);
        assert!(t.offsets.windows(2).all(|w| w[1] - w[0] == 2));
    }

    #[test]
    fn several_threads_find_the_same_edges() {
        // A grid of 100 x 100 squares, its vertices in no order.
        let number = |i: usize, j: usize| ((i * 101 + j) * 7919 % 10201) as i32;
        let squares = (0..100).flat_map(|i| (0..100).map(move |j| (i, j)));
        let mut triangles: Vec<[i32; 3]> = squares
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        let one = pool(1).install(|| topology(&triangles, 10201));
        assert_eq!(one.edges.len(), 2 * 100 * 101 + 100 * 100);
        assert!(one.edges.is_sorted() && repeated(&triangles, &one).is_empty());
        for threads in [2, 3, 7] {
            let many = pool(threads).install(|| topology(&triangles, 10201));
            assert!(many.edges == one.edges && many.offsets == one.offsets && many.incident == one.incident);
        }
        triangles[500] = [2, 0, 1].map(|k| triangles[19_000][k]);
        assert_eq!(repeated(&triangles, &topology(&triangles, 10201)), [19_000]);
    }

    #[test]
    fn folds_of_a_roof_and_of_a_sliver() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [2.0, 0.0, 0.0]];
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 4, 1]];
        let t = topology(&triangles, 5);
        let balance = balance(&triangles, &t.edges, &t.offsets, &t.incident);
        let normals = normals(&points, &triangles);
        assert_eq!((normals[0], normals[2]), ([0.0, 0.0, 1.0], [0.0; 3]));
        let roof = topology(&triangles[..2], 5);
        let folds = folds(&normals[..2], &roof.offsets, &roof.incident, &balance[..roof.edges.len()]);
        assert_eq!(folds[0], 0.0);
        assert!(folds[1..].iter().all(|f| f.is_nan()));
    }

    #[test]
    fn two_tetrahedra_are_two_components_and_balanced() {
        let one = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let two: Vec<[i32; 3]> = one.iter().chain(&one.map(|t| t.map(|v| v + 4))).copied().collect();
        assert_eq!(components(&two, 8), [0, 0, 0, 0, 1, 1, 1, 1]);
        let t = topology(&two, 8);
        assert!(balance(&two, &t.edges, &t.offsets, &t.incident).iter().all(|&b| b == 0));
        let open = topology(&two[1..], 8);
        assert_eq!(
            balance(&two[1..], &open.edges, &open.offsets, &open.incident).iter().filter(|&&b| b != 0).count(),
            3
        );
    }
}
