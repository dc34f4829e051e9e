//! Which groups are certainly one convex body.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::bodies::Bodies;
use super::facts::Facts;
use super::ray_count::passes;
use crate::topology::components;

/// Planar faces are flat within this share of their group's size.
const ROUNDING: f64 = 1e-9;

/// Per group: it is not certainly one convex body, so it may pass through itself.
///
/// A group is convex if it is closed, in one piece, nowhere bent inward, and winds around its middle once.
pub fn may_fold(bodies: &Bodies, points: &[[f64; 3]], triangles: &[[i32; 3]], facts: &Facts) -> Vec<bool> {
    let (groups, count) = (&bodies.groups, bodies.groups.len());
    let size = |g: usize| (0..3).map(|k| groups.high[g][k] - groups.low[g][k]).fold(f64::NEG_INFINITY, f64::max);
    let least: Vec<f64> = (0..count).map(|g| if groups.used(g) { ROUNDING * size(g) } else { 0.0 }).collect();
    let mut bent = bent(points, triangles, facts, &bodies.group_of, &least);
    bent.iter_mut().zip(&groups.cull).for_each(|(bent, cull)| *bent |= !cull);
    if bent.iter().all(|&b| b) {
        return bent;
    }
    let pieces = pieces(&bodies.group_of, &components(triangles, points.len()), count);
    bent.iter_mut().zip(pieces).for_each(|(bent, n)| *bent |= n != 1);
    let asked: Vec<bool> = bent.iter().map(|bent| !bent).collect();
    let passed = passes(points, triangles, &bodies.group_of, &asked);
    bent.iter_mut().zip(passed).for_each(|(bent, n)| *bent |= n != 1);
    bent
}

/// Per group: an edge bends inward by more than the group's `least`, or has other than two triangles.
fn bent(points: &[[f64; 3]], triangles: &[[i32; 3]], facts: &Facts, group: &[i32], least: &[f64]) -> Vec<bool> {
    let bent: Vec<AtomicBool> = least.iter().map(|_| AtomicBool::new(false)).collect();
    facts.edges.par_iter().enumerate().with_min_len(1 << 10).for_each(|(e, &[a, b])| {
        let around = facts.around(e);
        let Some(&s) = around.first() else { return };
        let own = group[s as usize] as usize;
        if bent[own].load(Ordering::Relaxed) {
            return;
        }
        let hollow = |t: i32| {
            let apex = triangles[t as usize].iter().map(|&v| i64::from(v)).sum::<i64>() - i64::from(a) - i64::from(b);
            // An edge that is none of the triangle's sides has no such point.
            let Some(apex) = usize::try_from(apex).ok().and_then(|v| points.get(v)) else { return true };
            let (foot, n) = (&points[a as usize], &facts.normals[s as usize]);
            (0..3).map(|k| n[k] * (apex[k] - foot[k])).sum::<f64>() > least[own]
        };
        if around.len() != 2 || hollow(around[1]) {
            bent[own].store(true, Ordering::Relaxed);
        }
    });
    bent.into_iter().map(AtomicBool::into_inner).collect()
}

/// Number of connected pieces of each group; `piece`: per triangle, numbered in order of appearance.
fn pieces(group: &[i32], piece: &[i32], count: usize) -> Vec<u32> {
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

    #[test]
    fn what_is_open_or_hollow_is_bent() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let told = |triangles: &[[i32; 3]]| {
            let facts = Facts::of(&points, triangles);
            bent(&points, triangles, &facts, &vec![0; triangles.len()], &[1e-9])[0]
        };
        assert!(!told(&triangles) && told(&triangles[1..]));
        assert!(told(&triangles.map(|[a, b, c]| [a, c, b])));
    }

    #[test]
    fn pieces_of_groups() {
        assert_eq!(pieces(&[0, 0, 1, 0], &[0, 1, 2, 0], 3), [2, 1, 0]);
    }
}
