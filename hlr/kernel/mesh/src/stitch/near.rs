//! Decides which corners of borders become one node, and which nodes lie on which border.

use std::collections::{HashMap, HashSet};

use super::border::{Border, Vec3, along, before, distance2};
use crate::measure::boxes::{Bounds, Tree};

pub struct Near {
    /// Per corner of a border: its node, the corner that stands for all corners there.
    pub node: HashMap<u32, u32>,
    /// Per border: the nodes on it, in its direction, from its own first to its own last.
    pub chains: Vec<Vec<u32>>,
}

impl Near {
    pub fn find(points: &[Vec3], triangles: &[[i32; 3]], borders: &[Border], reach: f64) -> Near {
        let mut corners: Vec<u32> = borders.iter().flat_map(|b| b.ends).collect();
        corners.sort_unstable();
        corners.dedup();
        let place = |v: u32| &points[v as usize];
        let boxes: Vec<Bounds<3>> = borders.iter().map(|b| Bounds::of(&b.ends.map(|v| *place(v)))).collect();
        let tree = Tree::new(&boxes);
        // (corner, border) within reach, of borders that do not end there
        let mut on: Vec<(u32, u32)> = Vec::new();
        for &v in &corners {
            let p = place(v);
            tree.walk(
                |bounds, _| Some(bounds.distance2(p)).filter(|&d| d <= reach * reach),
                |i| {
                    let [a, b] = borders[i as usize].ends;
                    if v != a && v != b && along(p, place(a), place(b)).1 <= reach * reach {
                        on.push((v, i));
                    }
                    false
                },
            );
        }
        let node = nodes(points, triangles, borders, &on, reach);
        let chains = chains(points, triangles, borders, &on, &node);
        Near { node, chains }
    }
}

/// Corners that lie together, the nearest pairs first: all corners of a node are within reach of one another, and no
/// side of a triangle runs between two of them, so that no triangle falls flat.
fn nodes(
    points: &[Vec3],
    triangles: &[[i32; 3]],
    borders: &[Border],
    on: &[(u32, u32)],
    reach: f64,
) -> HashMap<u32, u32> {
    let place = |v: u32| &points[v as usize];
    let mut pairs: Vec<(f64, [u32; 2])> = Vec::new();
    for &(v, i) in on {
        for w in borders[i as usize].ends {
            let d = distance2(place(v), place(w));
            if d <= reach * reach {
                let pair = if before(place(v), place(w)).is_lt() { [v, w] } else { [w, v] };
                pairs.push((d, pair));
            }
        }
    }
    // Sorted by distance, then by position: the numbering of the corners must not matter.
    pairs.sort_unstable_by(|(d, [p, q]), (e, [r, s])| {
        d.total_cmp(e).then(before(place(*p), place(*r))).then(before(place(*q), place(*s)))
    });
    pairs.dedup();
    let sides = short_sides(points, triangles, &pairs, reach);
    let mut node: HashMap<u32, u32> = HashMap::new();
    let mut members: HashMap<u32, Vec<u32>> = HashMap::new();
    for &(_, [v, w]) in &pairs {
        let (a, b) = (*node.get(&v).unwrap_or(&v), *node.get(&w).unwrap_or(&w));
        if a == b {
            continue;
        }
        let (left, right) = (members.get(&a).cloned().unwrap_or(vec![a]), members.get(&b).cloned().unwrap_or(vec![b]));
        let fits = |&x: &u32, &y: &u32| {
            distance2(place(x), place(y)) <= reach * reach && !sides.contains(&[x.min(y), x.max(y)])
        };
        if left.iter().all(|x| right.iter().all(|y| fits(x, y))) {
            let mut all = [left, right].concat();
            all.sort_unstable_by(|&x, &y| before(place(x), place(y)));
            members.remove(&a);
            members.remove(&b);
            for &x in &all {
                node.insert(x, all[0]);
            }
            members.insert(all[0], all);
        }
    }
    node
}

/// Sides of triangles no longer than the reach, between corners that are candidates, lower number first.
fn short_sides(points: &[Vec3], triangles: &[[i32; 3]], pairs: &[(f64, [u32; 2])], reach: f64) -> HashSet<[u32; 2]> {
    let candidates: HashSet<u32> = pairs.iter().flat_map(|p| p.1).collect();
    if candidates.is_empty() {
        return HashSet::new();
    }
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).map(|s| s.map(|v| v as u32));
    let short = |[a, b]: &[u32; 2]| distance2(&points[*a as usize], &points[*b as usize]) <= reach * reach;
    sides.filter(|s| s.iter().all(|v| candidates.contains(v)) && short(s)).map(|[a, b]| [a.min(b), a.max(b)]).collect()
}

/// Per border: its nodes in order. A node at one of its own triangle's corners does not count.
fn chains(
    points: &[Vec3],
    triangles: &[[i32; 3]],
    borders: &[Border],
    on: &[(u32, u32)],
    node: &HashMap<u32, u32>,
) -> Vec<Vec<u32>> {
    let of = |v: u32| *node.get(&v).unwrap_or(&v);
    let mut between: Vec<Vec<(f64, u32)>> = vec![Vec::new(); borders.len()];
    for &(v, i) in on {
        let (border, n) = (&borders[i as usize], of(v));
        let own = triangles[border.triangle as usize].map(|c| of(c as u32));
        if !own.contains(&n) && between[i as usize].iter().all(|&(_, m)| m != n) {
            let (t, _) = along(&points[n as usize], &points[border.ends[0] as usize], &points[border.ends[1] as usize]);
            if t > 0.0 && t < 1.0 {
                between[i as usize].push((t, n));
            }
        }
    }
    let mut out = Vec::with_capacity(borders.len());
    for (border, mut inner) in borders.iter().zip(between) {
        inner.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(before(&points[a.1 as usize], &points[b.1 as usize])));
        let [a, b] = border.ends.map(of);
        out.push([a].into_iter().chain(inner.into_iter().map(|(_, n)| n)).chain([b]).collect());
    }
    out
}
