//! Walls seen edge-on that end in a bend which is turned away from the viewer, behind another that is, too.
//!
//! A wall counts as turned away, so that it has an outline along its nearer border. Where what lies before it is turned
//! away as well, it has none there: the surface comes toward the viewer by steps. The wall is a line in the image all the
//! same, as it is from the other side. That line is its farther border, and it is hidden by what lies before.
//!
//! ```text
//!                           ___
//!     viewer >-   near     (   |
//!                           )__|____ wall         the bend where the wall begins hides the one where it ends: f
//!                                   \f
//!                                    |___
//! ```

use rayon::prelude::*;

use super::contour::{Fold, Node};
use super::face::mean;
use super::refine::{STRAIGHT, rise};
use super::side::{Side, side};
use super::{Model, TIE};
use hlr_accuracy::OUTLINE_BEHIND;
use hlr_brep::geometry::vector::{Vector, along, cross, dot, sub, unit};
use hlr_brep::sets::Sets;
use hlr_exact::snap::Grid;
use hlr_visibility::boxes::aabb::{Aabb, Item};
use hlr_visibility::boxes::tree::Tree;

/// Sine of the angle between an edge and the line of sight; with less it is a point in the image.
const POINT: f64 = 1e-3;

/// What a smooth edge is to the wall at it.
enum Border {
    /// The wall goes on in another face.
    Within(i32),
    /// What lies beyond is turned toward the viewer: an outline runs there.
    Outline,
    /// What lies before it is turned away.
    Near,
    /// What lies behind it is turned away.
    Far(Fold),
}

/// An edge in the image: its ends, and how far chords are off their curves there.
#[derive(Clone, Copy)]
struct Chord {
    ends: [[f64; 2]; 2],
    off: f64,
}

/// The farther borders of walls, where what lies before the wall is turned away and no outline runs along it.
pub fn behind(model: &Model, values: &[f64], stopped: &(dyn Fn() -> bool + Sync)) -> Vec<Fold> {
    let found: Vec<(u32, i32, Border, Chord)> = (0..model.offsets.len() - 1)
        .into_par_iter()
        .filter(|&e| model.smooth[e] && !stopped())
        .filter_map(|e| {
            let (wall, border) = border(model, values, e)?;
            Some((e as u32, wall, border, in_image(model, e)?))
        })
        .collect();
    let ends: Vec<Vector> = found.iter().flat_map(|(.., place)| place.ends.map(|[x, y]| [x, y, 0.0])).collect();
    let Some(grid) = Grid::uniform_around(&ends) else { return Vec::new() };
    let mut walls = Sets::new(model.faces.len());
    for (_, wall, border, _) in &found {
        if let Border::Within(other) = border {
            walls.unite(*wall as usize, *other as usize);
        }
    }
    let wall_of: Vec<usize> = found.iter().map(|(_, wall, ..)| walls.first(*wall as usize)).collect();
    let (mut near, mut outlines) = (Vec::new(), Vec::new());
    for ((.., border, place), wall) in found.iter().zip(&wall_of) {
        match border {
            Border::Near => near.push((*wall, *place)),
            Border::Outline => outlines.push((*wall, *place)),
            _ => {}
        }
    }
    let (near, outlines) = (Chords::new(near, &grid), Chords::new(outlines, &grid));
    let stretches = |e: u32, border: &Border, place: &Chord, wall: usize| -> Vec<Fold> {
        let Border::Far(fold) = border else { return Vec::new() };
        let before = if stopped() { Vec::new() } else { near.covering(wall, place, &grid) };
        if before.is_empty() {
            return Vec::new();
        }
        let least = place.off / place.long();
        let left = without(united(before, least), united(outlines.covering(wall, place, &grid), least));
        left.into_iter().filter(|[from, to]| to - from > least).map(|range| part_of(fold, e, range)).collect()
    };
    let all = found.par_iter().zip(&wall_of);
    all.flat_map_iter(|((e, _, border, place), wall)| stretches(*e, border, place, *wall)).collect()
}

/// Chords, the wall of each, and the hierarchy of their boxes.
struct Chords {
    all: Vec<(usize, Chord)>,
    tree: Tree,
}

impl Chords {
    fn new(all: Vec<(usize, Chord)>, grid: &Grid) -> Chords {
        let items: Vec<Item> = all.iter().zip(0..).map(|((_, chord), k)| (chord.reach(grid), k)).collect();
        Chords { all, tree: Tree::new(&items) }
    }

    /// Between which of its parameters, from 0 to 1, chords of its wall lie on another.
    fn covering(&self, wall: usize, chord: &Chord, grid: &Grid) -> Vec<[f64; 2]> {
        let mut found = Vec::new();
        self.tree.query(&chord.reach(grid), |k| {
            let (other, covering) = &self.all[k as usize];
            if *other == wall {
                found.extend(chord.covered_by(covering));
            }
        });
        found
    }
}

/// The stretch of a fold between two of its parameters, from 0 to 1.
fn part_of(fold: &Fold, e: u32, range: [f64; 2]) -> Fold {
    let way = sub(&fold.points[1], &fold.points[0]);
    let end = |k: usize| {
        if range[k] == k as f64 {
            (fold.ends[k], fold.points[k])
        } else {
            (Node::Cut(e, range[k].to_bits()), along(&fold.points[0], &way, range[k]))
        }
    };
    let [(from, a), (to, b)] = [0, 1].map(end);
    Fold { ends: [from, to], points: [a, b], ..*fold }
}

/// Ranges that are no farther apart than a gap as one, ascending. Where no more than the gap is left of 0 to 1, they reach
/// its end.
fn united(mut ranges: Vec<[f64; 2]>, gap: f64) -> Vec<[f64; 2]> {
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut out: Vec<[f64; 2]> = Vec::with_capacity(ranges.len());
    for [from, to] in ranges {
        let range = [if from <= gap { 0.0 } else { from }, if to >= 1.0 - gap { 1.0 } else { to }];
        match out.last_mut() {
            Some(last) if range[0] <= last[1] + gap => last[1] = last[1].max(range[1]),
            _ => out.push(range),
        }
    }
    out
}

/// What is left of ranges without others, both as `united` has them.
fn without(ranges: Vec<[f64; 2]>, gone: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut out = Vec::new();
    for [mut from, to] in ranges {
        for [low, high] in gone.iter().filter(|gap| gap[0] < to) {
            if *low > from {
                out.push([from, *low]);
            }
            from = from.max(*high);
        }
        if from < to {
            out.push([from, to]);
        }
    }
    out
}

/// The wall at an edge between two faces, and what this edge is to it; None where there is no wall or nothing of that kind.
fn border(model: &Model, values: &[f64], e: usize) -> Option<(i32, Border)> {
    let &[s, t] = &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize] else { return None };
    if model.triangle_face[s as usize] == model.triangle_face[t as usize] {
        return None;
    }
    let sides = [side(model, values, e, s)?, side(model, values, e, t)?];
    let edge_on = |side: &Side| side.f.iter().all(|f| f.abs() <= TIE);
    if !sides.iter().any(edge_on) {
        return None;
    }
    let bend = [0, 1].map(|k| bend(&sides[k]) * model.chord);
    let wall = |k: usize| edge_on(&sides[k]) && bend[k].abs() <= STRAIGHT;
    let own = match [wall(0), wall(1)] {
        [true, true] => return Some((sides[0].number, Border::Within(sides[1].number))),
        [true, false] => 0,
        [false, true] => 1,
        [false, false] => return None,
    };
    let other = 1 - own;
    let number = sides[own].number;
    let ends = sides[own].corners.map(|v| model.points[v as usize]);
    // From the edge into the wall.
    let corners = model.triangles[sides[own].triangle as usize];
    let forward = (0..3).any(|k| [corners[k], corners[(k + 1) % 3]] == model.edges[e]);
    let way = if forward { sub(&ends[1], &ends[0]) } else { sub(&ends[0], &ends[1]) };
    let inward = unit(&cross(&sides[own].normal, &way))?;
    let toward = dot(&inward, &model.sight(&along(&ends[0], &sub(&ends[1], &ends[0]), 0.5)));
    if toward.abs() < POINT {
        return None;
    }
    match (toward > 0.0, bend[other] > 0.0) {
        (true, true) | (false, false) => Some((number, Border::Outline)),
        (true, false) => Some((number, Border::Near)),
        (false, true) => {
            let normal = mean(&sides[own].normal, &sides[other].normal);
            let triangles = [s, t];
            let fold = Fold {
                ends: sides[own].corners.map(|v| Node::Vertex(v as u32)),
                points: ends,
                normal,
                face: sides[other].number,
                source: model.source[e],
                concave: false,
                rise: ends.map(|p| rise(model, &triangles, &p, &normal)),
            };
            Some((number, Border::Far(fold)))
        }
    }
}

/// How the surface bends along the line of sight, as `Face::radial` has it: on planes not at all.
fn bend(side: &Side) -> f64 {
    let half = [0, 1].map(|k| 0.5 * (side.uv[0][k] + side.uv[1][k]));
    side.face.as_ref().map_or(0.0, |face| face.radial(half))
}

impl Chord {
    fn long(&self) -> f64 {
        let [a, b] = self.ends;
        let way = [b[0] - a[0], b[1] - a[1]];
        (way[0] * way[0] + way[1] * way[1]).sqrt()
    }

    /// Between which of its parameters, from 0 to 1, another lies on it.
    fn covered_by(&self, other: &Chord) -> Option<[f64; 2]> {
        let (long, off) = (self.long(), self.off.max(other.off));
        if long == 0.0 {
            return None;
        }
        let [a, b] = self.ends;
        let way = [(b[0] - a[0]) / long, (b[1] - a[1]) / long];
        let from = other.ends.map(|p| [p[0] - a[0], p[1] - a[1]]);
        let aside = from.map(|q| way[0] * q[1] - way[1] * q[0]);
        let at = from.map(|q| (way[0] * q[0] + way[1] * q[1]) / long);
        // The stretch of the other that is near enough.
        let turn = aside[1] - aside[0];
        let near = if turn.abs() <= 1e-9 * off {
            if aside[0].abs() > off { return None } else { [0.0, 1.0] }
        } else {
            let [p, q] = [-off, off].map(|side| (side - aside[0]) / turn);
            [p.min(q).max(0.0), p.max(q).min(1.0)]
        };
        let [p, q] = near.map(|s| (at[0] + (at[1] - at[0]) * s).clamp(0.0, 1.0));
        (near[0] < near[1] && p != q).then(|| [p.min(q), p.max(q)])
    }

    /// A box on the grid around all that may lie on it.
    fn reach(&self, grid: &Grid) -> Aabb {
        let [a, b] = self.ends;
        let low = [0, 1].map(|k| a[k].min(b[k]) - self.off);
        let high = [0, 1].map(|k| a[k].max(b[k]) + self.off);
        // One step wider on each side, to cover the rounding.
        let [low, high] =
            [(low, -1), (high, 1)].map(|([x, y], step)| grid.snap(&[x, y, 0.0]).map(|c| c.saturating_add(step)));
        Aabb { low, high }
    }
}

/// None where an end lies beside the eye or behind it.
fn in_image(model: &Model, e: usize) -> Option<Chord> {
    let across = model.view.across();
    let seen = |v: i32| -> Option<([f64; 2], f64)> {
        let (place, shorter) = model.view.seen(&model.points[v as usize], &across)?;
        Some((place, OUTLINE_BEHIND * model.chord / shorter))
    };
    let [a, b] = model.edges[e];
    let ((a, off), (b, other)) = (seen(a)?, seen(b)?);
    Some(Chord { ends: [a, b], off: off.max(other) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_less_than_a_gap_apart_are_one() {
        assert_eq!(united(vec![[0.5, 0.75], [0.25, 0.45], [0.3, 0.4]], 0.1), [[0.25, 0.75]]);
        assert_eq!(united(vec![[0.05, 0.25], [0.5, 0.95]], 0.1), [[0.0, 0.25], [0.5, 1.0]]);
    }

    #[test]
    fn what_others_cover_is_cut_out() {
        assert_eq!(without(vec![[0.0, 1.0]], vec![[0.25, 0.5], [0.75, 1.0]]), [[0.0, 0.25], [0.5, 0.75]]);
        assert_eq!(without(vec![[0.0, 0.25], [0.5, 1.0]], vec![[0.125, 0.75]]), [[0.0, 0.125], [0.75, 1.0]]);
        assert!(without(vec![[0.25, 0.5]], vec![[0.0, 1.0]]).is_empty());
    }

    #[test]
    fn a_chord_covers_where_it_is_near() {
        let chord = |ends| Chord { ends, off: 0.125 };
        let own = chord([[0.0, 0.0], [4.0, 0.0]]);
        assert_eq!(own.covered_by(&chord([[5.0, 0.0625], [1.0, 0.0625]])), Some([0.25, 1.0]));
        // It rises by a quarter: after half a unit it is too far away.
        assert_eq!(own.covered_by(&chord([[1.0, 0.0], [5.0, 1.0]])), Some([0.25, 0.375]));
        assert_eq!(own.covered_by(&chord([[1.0, 0.25], [3.0, 0.25]])), None);
        assert_eq!(own.covered_by(&chord([[5.0, 0.0], [6.0, 0.0]])), None);
    }
}
