//! Puts the edges of a wire in order: each begins at the vertex where the previous one ends, and close to it in (u, v).
//!
//! Modellers write the edges of a wire in any order. Where seams, poles or several loops share a vertex, (u, v)
//! decides.

use super::uses::Run;
use crate::mesh::Fault;

/// Share of the face's extent in (u, v) below which two ends count as one.
pub const NEAR: f64 = 1e-3;

/// Numbers of runs in order, each with its shift in (u, v).
pub type Loop = Vec<(usize, [f64; 2])>;

/// Whether two runs are the two directions of one edge.
fn is_back(run: &Run, other: &Run) -> bool {
    run.edge == other.edge && run.location == other.location && run.backward != other.backward
}

/// Loops of the runs of one wire.
///
/// `extent`: extent of the face in u and v. `periods`: of u and v; 0 where there is none.
pub fn chained(runs: &[Run], extent: [f64; 2], periods: [f64; 2]) -> Result<Vec<Loop>, Fault> {
    let gap = |a: [f64; 2], b: [f64; 2]| {
        (0..2).map(|k| (b[k] - a[k]).abs() / extent[k].max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
    };
    let turns = |a: [f64; 2], b: [f64; 2]| {
        [0, 1].map(|k| if periods[k] > 0.0 { ((a[k] - b[k]) / periods[k]).round() * periods[k] } else { 0.0 })
    };
    let plus = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
    // On a closed surface, an edge that is walked in both directions is a seam.
    let is_slit = |i: usize| periods == [0.0; 2] && runs.iter().any(|other| is_back(&runs[i], other));
    let mut left: Vec<usize> = (0..runs.len()).collect();
    let mut loops = Vec::new();
    while !left.is_empty() {
        // From a slit, the loop would return to its start before it has walked around what the slit leads to.
        let outside = left.iter().position(|&i| !runs[i].degenerate && !is_slit(i));
        let begin = outside.or_else(|| left.iter().position(|&i| !runs[i].degenerate)).unwrap_or(0);
        let first = left.remove(begin);
        let [start, mut end] = runs[first].uv_ends();
        let (start_vertex, mut vertex) = (runs[first].ends[0], runs[first].ends[1]);
        let mut found: Loop = vec![(first, [0.0; 2])];
        // The edge after which (u, v) jump, at a pole that has no edge of its own.
        let mut pole = None;
        loop {
            let here = vertex == start_vertex;
            let before = &runs[found[found.len() - 1].0];
            // The same edge backwards is chosen only if nothing else continues; otherwise the nearest, up to whole
            // periods.
            let choice = left
                .iter()
                .enumerate()
                .filter(|&(_, &i)| runs[i].ends[0] == vertex)
                .map(|(k, &i)| {
                    let at = runs[i].uv_ends()[0];
                    let back = runs[i].edge == before.edge && runs[i].location == before.location;
                    let far = gap(end, at);
                    let (mut shift, mut near) = (turns(end, at), gap(end, plus(at, turns(end, at))));
                    if near > NEAR {
                        shift = found[found.len() - 1].1;
                        near = gap(end, plus(at, shift));
                    }
                    // Distances within the tolerance count as equal.
                    let step = |g: f64| if g <= NEAR { 0.0 } else { g };
                    ((step(near), back, step(far)), (k, i, shift))
                })
                .min_by(|(a, _), (b, _)| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
            let closed = here && gap(end, start) <= NEAR;
            let Some(((near, ..), (k, i, shift))) = choice else {
                if here {
                    break;
                }
                return Err(Fault::Open);
            };
            // Another loop of this wire may hang on this one by a slit.
            let closed = closed && !(near <= NEAR && is_slit(i));
            // A loop may return to its start shifted by whole periods: a band without a seam.
            if closed || (here && near > NEAR && gap(end, plus(start, turns(end, start))) <= NEAR) {
                break;
            }
            left.remove(k);
            if near > NEAR {
                pole = Some(found.len());
            }
            end = plus(runs[i].uv_ends()[1], shift);
            vertex = runs[i].ends[1];
            found.push((i, shift));
        }
        // At a jump of (u, v), whole periods may be added so that the loop closes.
        let over = turns(end, start);
        if let Some(pole) = pole
            && gap(end, plus(start, over)) <= NEAR
        {
            found[pole..].iter_mut().for_each(|(_, shift)| *shift = [shift[0] - over[0], shift[1] - over[1]]);
        }
        loops.push(found);
    }
    Ok(loops)
}
