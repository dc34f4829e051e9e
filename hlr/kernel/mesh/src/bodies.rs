//! Divides the triangles into groups, each a connected surface or a closed part, and finds the properties of each
//! group.

use super::facts::Facts;
use super::groups::{self, Edges};
use super::ray_count::passes;
use super::tables::Tables;
use crate::topology::components;

/// Planar faces are flat within this share of their group's size.
const ROUNDING: f64 = 1e-9;

#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Group of each triangle; part of each group.
    pub group_of: Vec<i32>,
    pub part_of: Vec<i32>,
    /// Per group: every edge is used as often in one direction as in the other.
    pub closed: Vec<bool>,
    /// Per group: closed and turned outward; closed and turned inward.
    pub cull: Vec<bool>,
    pub inward: Vec<bool>,
    /// Per group: all faces are planar.
    pub planar: Vec<bool>,
    /// Per group, in model units: thickness, or the smallest side of the box where that is less or the group is open.
    pub extent: Vec<f64>,
    pub low: Vec<[f64; 3]>,
    pub high: Vec<[f64; 3]>,
    /// Per group: the source had it inside out, and it was turned; such groups are `cull` and no longer `inward`.
    pub turned: Vec<bool>,
    /// Per group of a mesh without B-rep: an edge has more than two triangles. Bodies that were welded there are one
    /// connected piece, and still touch one another as separate bodies do.
    pub welded: Vec<bool>,
}

/// Returns the group of each triangle and the part of each group. A closed B-rep part is one group; everything else is
/// grouped by connected piece.
///
/// Unsewn faces of an IGES file touch as separate parts do, and need the same contact tolerance.
fn grouped(whole: &[bool], triangles: &[[i32; 3]], part_of: &[i32], n_points: usize) -> (Vec<i32>, Vec<i32>) {
    if whole.iter().all(|&w| w) {
        return (part_of.to_vec(), (0..whole.len() as i32).collect());
    }
    // Whole parts first, numbered as they are; then the pieces of the others, in order of appearance.
    let mut label = components(triangles, n_points);
    let pieces = label.iter().max().map_or(0, |&m| m as usize + 1);
    let mut owner = vec![-1; whole.len() + pieces];
    for (label, &part) in label.iter_mut().zip(part_of) {
        *label = if whole[part as usize] { part } else { *label + whole.len() as i32 };
        owner[*label as usize] = part;
    }
    let mut number = vec![0; owner.len()];
    let mut parts = Vec::new();
    for (number, &part) in number.iter_mut().zip(&owner).filter(|(_, part)| **part >= 0) {
        *number = parts.len() as i32;
        parts.push(part);
    }
    label.iter_mut().for_each(|label| *label = number[*label as usize]);
    (label, parts)
}

/// `curved`: per triangle, its face may show an outline.
pub fn bodies(tables: &Tables, facts: &Facts, part_of: &[i32], curved: &[bool]) -> Bodies {
    let (points, triangles) = (&tables.points, &tables.triangles);
    let unbalanced = facts.balance.iter().enumerate().filter(|(_, b)| **b != 0);
    let odd: Vec<usize> = unbalanced.map(|(e, _)| facts.around(e)[0] as usize).collect();
    let mut whole = tables.brep.clone();
    odd.iter().for_each(|&t| whole[part_of[t] as usize] = false);
    let (group_of, group_part) = grouped(&whole, triangles, part_of, points.len());
    let count = group_part.len();
    let found = groups::groups(points, triangles, &group_of, count);
    let mut out = Bodies { closed: found.count.iter().map(|&n| n > 0).collect(), ..Bodies::default() };
    odd.iter().for_each(|&t| out.closed[group_of[t] as usize] = false);
    out.planar = vec![true; count];
    group_of.iter().zip(curved).filter(|(_, curved)| **curved).for_each(|(&g, _)| out.planar[g as usize] = false);
    out.welded = vec![false; count];
    for e in (0..facts.edges.len()).filter(|&e| facts.around(e).len() > 2) {
        let g = group_of[facts.around(e)[0] as usize] as usize;
        out.welded[g] |= !tables.brep[group_part[g] as usize];
    }
    for g in 0..count {
        let (low, high, six) = (&found.low[g], &found.high[g], found.volume[g]);
        let least = (0..3).map(|k| high[k] - low[k]).fold(f64::INFINITY, f64::min);
        // 2 V / A is the wall thickness of a plate, a tube or a housing, in any direction, and a third of the diameter
        // of a ball or a cube. The contact tolerance may take half of the extent, so an extent of nearly twice the
        // thickness still lets a wall hide what is behind it.
        let thick = if out.closed[g] { 3.6 * (six / 6.0).abs() / (found.area[g] / 2.0) } else { f64::INFINITY };
        out.extent.push((if found.count[g] > 0 { least } else { 0.0 }).min(thick));
        out.cull.push(out.closed[g] && six > 0.0);
        out.inward.push(out.closed[g] && six < 0.0);
    }
    out.turned = inside_out(&out.cull, &out.inward, &group_part, &found.low, &found.high);
    for g in 0..count {
        out.cull[g] |= out.turned[g];
        out.inward[g] &= !out.turned[g];
    }
    (out.low, out.high, out.group_of, out.part_of) = (found.low, found.high, group_of, group_part);
    out
}

/// Per group: closed and turned inward, and no cavity (a cavity lies within an outer surface of its part).
fn inside_out(cull: &[bool], inward: &[bool], part: &[i32], low: &[[f64; 3]], high: &[[f64; 3]]) -> Vec<bool> {
    let within = |g: usize, other: usize| {
        part[other] == part[g] && (0..3).all(|k| low[other][k] < low[g][k] && high[other][k] > high[g][k])
    };
    let outer: Vec<usize> = (0..cull.len()).filter(|&g| cull[g]).collect();
    (0..inward.len()).map(|g| inward[g] && !outer.iter().any(|&other| within(g, other))).collect()
}

/// Per group: it is not certainly one convex body, so it may pass through itself.
///
/// A group is convex if it is closed, in one piece, nowhere bent inward, and winds around its middle once.
pub fn may_fold(bodies: &Bodies, points: &[[f64; 3]], triangles: &[[i32; 3]], facts: &Facts) -> Vec<bool> {
    let count = bodies.closed.len();
    let size = |g: usize| (0..3).map(|k| bodies.high[g][k] - bodies.low[g][k]).fold(f64::NEG_INFINITY, f64::max);
    let least: Vec<f64> =
        (0..count).map(|g| if bodies.low[g][0].is_finite() { ROUNDING * size(g) } else { 0.0 }).collect();
    let mesh =
        Edges { edges: &facts.edges, offsets: &facts.offsets, incident: &facts.incident, normals: &facts.normals };
    let mut bent = groups::bent(points, triangles, mesh, &bodies.group_of, &least);
    bent.iter_mut().zip(&bodies.cull).for_each(|(bent, cull)| *bent |= !cull);
    if bent.iter().all(|&b| b) {
        return bent;
    }
    let pieces = groups::pieces(&bodies.group_of, &components(triangles, points.len()), count);
    bent.iter_mut().zip(pieces).for_each(|(bent, n)| *bent |= n != 1);
    let asked: Vec<bool> = bent.iter().map(|bent| !bent).collect();
    let passed = passes(points, triangles, &bodies.group_of, &asked);
    bent.iter_mut().zip(passed).for_each(|(bent, n)| *bent |= n != 1);
    bent
}
