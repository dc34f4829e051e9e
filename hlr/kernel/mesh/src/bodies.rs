//! Divides the triangles into groups, each a connected surface or a closed part, and finds the properties of each
//! group.

use std::sync::Arc;

use super::facts::Facts;
use super::groups::Groups;
use super::sizes::{Sizes, sizes};
use super::tables::Tables;
use crate::topology::components;

#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Group of each triangle; part of each group.
    pub group_of: Vec<i32>,
    pub part_of: Vec<i32>,
    pub groups: Arc<Groups>,
    /// Per group: the source had it inside out, and it was turned; such groups are culled and no longer inward.
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
    let (group_of, part_of) = grouped(&whole, triangles, part_of, points.len());
    let brep: Vec<bool> = part_of.iter().map(|&part| tables.brep[part as usize]).collect();
    let count = part_of.len();
    let found = sizes(points, triangles, &group_of, count);
    let mut closed: Vec<bool> = found.count.iter().map(|&n| n > 0).collect();
    odd.iter().for_each(|&t| closed[group_of[t] as usize] = false);
    let mut planar = vec![true; count];
    group_of.iter().zip(curved).filter(|(_, curved)| **curved).for_each(|(&g, _)| planar[g as usize] = false);
    let mut welded = vec![false; count];
    for e in (0..facts.edges.len()).filter(|&e| facts.around(e).len() > 2) {
        let g = group_of[facts.around(e)[0] as usize] as usize;
        welded[g] |= !brep[g];
    }
    let mut cull: Vec<bool> = (0..count).map(|g| closed[g] && found.volume[g] > 0.0).collect();
    let mut inward: Vec<bool> = (0..count).map(|g| closed[g] && found.volume[g] < 0.0).collect();
    let turned = inside_out(&cull, &inward, &part_of, &found.low, &found.high);
    for g in 0..count {
        cull[g] |= turned[g];
        inward[g] &= !turned[g];
    }
    let groups = Groups {
        cull,
        inward,
        sound: (0..count).map(|g| closed[g] && brep[g]).collect(),
        without_brep: brep.iter().map(|brep| !brep).collect(),
        tight: vec![false; count],
        planar,
        extent: (0..count).map(|g| extent(&found, g, closed[g])).collect(),
        closed,
        low: found.low,
        high: found.high,
        crossing: Vec::new(),
    };
    Bodies { group_of, part_of, groups: Arc::new(groups), turned, welded }
}

/// Thickness of a group, or the smallest side of its box where that is less or the group is open. Model units.
fn extent(sizes: &Sizes, g: usize, closed: bool) -> f64 {
    let (low, high) = (&sizes.low[g], &sizes.high[g]);
    let least = (0..3).map(|k| high[k] - low[k]).fold(f64::INFINITY, f64::min);
    // 2 V / A is the wall thickness of a plate, a tube or a housing, in any direction, and a third of the diameter of a
    // ball or a cube. The contact tolerance may take half of the extent, so an extent of nearly twice the thickness
    // still lets a wall hide what is behind it.
    let thick = if closed { 3.6 * (sizes.volume[g] / 6.0).abs() / (sizes.area[g] / 2.0) } else { f64::INFINITY };
    (if sizes.count[g] > 0 { least } else { 0.0 }).min(thick)
}

/// Per group: closed and turned inward, and no cavity (a cavity lies within an outer surface of its part).
fn inside_out(cull: &[bool], inward: &[bool], part: &[i32], low: &[[f64; 3]], high: &[[f64; 3]]) -> Vec<bool> {
    let within = |g: usize, other: usize| {
        part[other] == part[g] && (0..3).all(|k| low[other][k] < low[g][k] && high[other][k] > high[g][k])
    };
    let outer: Vec<usize> = (0..cull.len()).filter(|&g| cull[g]).collect();
    (0..inward.len()).map(|g| inward[g] && !outer.iter().any(|&other| within(g, other))).collect()
}
