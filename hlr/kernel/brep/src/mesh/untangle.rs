//! Loops that cross themselves or one another, or lie upon one another, and the mesh of what they enclose.
//!
//! Boolean operations leave such loops: an edge runs to and fro along another one, or two holes share a side but have
//! edges of their own there. The chords are divided where they meet. Inside is what the loops run around more often to
//! the left than to the right: two holes that overlap are one. The pieces around that form loops that meet in points at
//! most.
//!
//! The mesh of these is joined to the old chords by caps: polygons without area between a chord and its pieces.
//!
//! ```text
//!   a---------------b    a chord, as the faces beside it have it
//!   |      cap      |
//!   p------x--------q    its pieces: p and q stand for a and b, x is a point of another chord
//!    \    / \      /
//!     \  /   \    /      triangles
//! ```

use rustc_hash::{FxHashMap, FxHashSet};

use super::delaunay::winding;
use super::face::{FaceLoops, FaceMesh, LoopPoint};
use super::mesh_face;
use super::plane::{distance2, side};
use super::progress::Progress;
use crate::geometry::surface::Surface;

/// What is tried, one after another: the share of the loops' extent within which a point lies on a chord, or on another
/// point, and a factor on the deflection. Edges that nearly lie upon one another leave slivers that are too thin to mesh,
/// and pieces of chords may be too coarse for the deflection.
const TRIED: [[f64; 2]; 5] = [[1e-9, 1.0], [1e-7, 1.0], [1e-6, 4.0], [1e-5, 16.0], [1e-4, 64.0]];
/// Limits on the rounds in which chords are divided, and on the points that this adds: with more, there is no outline.
const MOST_ROUNDS: usize = 20;
const MOST_NEW: usize = 200_000;

/// The mesh of a face whose loops cross. None where the loops are beyond repair.
pub fn mesh_crossed(
    surface: &Surface,
    loops: &FaceLoops,
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Option<FaceMesh> {
    TRIED.iter().find_map(|[near, coarser]| {
        let mut net = Net::new(loops, *near)?;
        net.divide(steps)?;
        let (outlines, place_of) = net.outlines(surface, loops, steps)?;
        let made = || mesh_face(surface, &outlines, coarser * deflection, angle, steps).ok();
        let filled = if outlines.loops.is_empty() { FaceMesh::default() } else { made()? };
        Some(net.joined(surface, loops, &filled, &place_of))
    })
}

/// A place in (u, v): where points of loops lie, or chords cross.
struct Place {
    /// As a share of the loops' extent.
    at: [f64; 2],
    uv: [f64; 2],
    /// The first point of the loops here, counted through all loops; None where chords cross.
    point: Option<u32>,
}

struct Net {
    near: f64,
    low: [f64; 2],
    size: [f64; 2],
    places: Vec<Place>,
    /// Places by the cell of a fine grid.
    cells: FxHashMap<[i64; 2], Vec<u32>>,
    /// For each chord of each loop, one loop after the other, the places that it passes, with its ends.
    paths: Vec<Vec<u32>>,
}

impl Net {
    fn new(loops: &FaceLoops, near: f64) -> Option<Net> {
        let all = || loops.loops.iter().flatten();
        if !all().flat_map(|p| p.uv.iter().chain(&p.point)).all(|x| x.is_finite()) {
            return None;
        }
        let low = [0, 1].map(|k| all().fold(f64::INFINITY, |low, p| low.min(p.uv[k])));
        let size = [0, 1].map(|k| all().fold(0.0f64, |most, p| most.max(p.uv[k] - low[k])));
        if size.contains(&0.0) {
            return None;
        }
        let mut net = Net { near, low, size, places: Vec::new(), cells: FxHashMap::default(), paths: Vec::new() };
        let here: Vec<u32> = all().zip(0..).map(|(p, number)| net.place(p.uv, Some(number))).collect();
        let mut start = 0;
        for points in &loops.loops {
            let count = points.len();
            net.paths.extend((0..count).map(|k| vec![here[start + k], here[start + (k + 1) % count]]));
            start += count;
        }
        Some(net)
    }

    /// The place at (u, v), which is that of an earlier point if one is near.
    fn place(&mut self, uv: [f64; 2], point: Option<u32>) -> u32 {
        let at = [0, 1].map(|k| (uv[k] - self.low[k]) / self.size[k]);
        let cell = at.map(|x| (x / self.near).floor() as i64);
        for x in -1..=1 {
            for y in -1..=1 {
                let held = self.cells.get(&[cell[0] + x, cell[1] + y]).into_iter().flatten();
                let near = |&&i: &&u32| (0..2).all(|k| (self.places[i as usize].at[k] - at[k]).abs() <= self.near);
                if let Some(&found) = held.clone().find(near) {
                    return found;
                }
            }
        }
        let new = self.places.len() as u32;
        self.places.push(Place { at, uv, point });
        self.cells.entry(cell).or_default().push(new);
        new
    }

    fn at(&self, place: u32) -> [f64; 2] {
        self.places[place as usize].at
    }

    /// Divides chords where they meet, until pieces share nothing but ends.
    fn divide(&mut self, steps: &Progress) -> Option<()> {
        let known = self.places.len();
        let mut passed = 0;
        for _ in 0..MOST_ROUNDS {
            let found = self.meetings(steps);
            if found.is_empty() {
                return Some(());
            }
            passed += found.len();
            if self.places.len() - known > MOST_NEW || passed > 2 * MOST_NEW {
                return None;
            }
            // From the last piece of a path to the first, so that the numbers before stay.
            let mut found: Vec<_> = found.into_iter().collect();
            let along = |&(path, piece, place): &(u32, u32, u32)| {
                let p = self.at(place);
                let from = self.at(self.paths[path as usize][piece as usize]);
                (p[0] - from[0]).powi(2) + (p[1] - from[1]).powi(2)
            };
            found.sort_by(|a, b| (b.0, b.1).cmp(&(a.0, a.1)).then(along(b).total_cmp(&along(a))).then(a.2.cmp(&b.2)));
            for (path, piece, place) in found {
                self.paths[path as usize].insert(piece as usize + 1, place);
            }
        }
        None
    }

    /// Where pieces meet outside their ends: path, piece and the place on it.
    fn meetings(&mut self, steps: &Progress) -> FxHashSet<(u32, u32, u32)> {
        struct Piece {
            of: (u32, u32),
            ends: [u32; 2],
            low: [f64; 2],
            high: [f64; 2],
        }
        let mut pieces = Vec::new();
        for (path, places) in (0..).zip(&self.paths) {
            for (piece, ends) in (0..).zip(places.windows(2)) {
                let [a, b] = [self.at(ends[0]), self.at(ends[1])];
                let (low, high) =
                    ([0, 1].map(|k| a[k].min(b[k]) - self.near), [0, 1].map(|k| a[k].max(b[k]) + self.near));
                pieces.push(Piece { of: (path, piece), ends: [ends[0], ends[1]], low, high });
            }
        }
        pieces.retain(|piece| piece.ends[0] != piece.ends[1]);
        pieces.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]).then(a.of.cmp(&b.of)));
        let (mut found, mut crossed) = (FxHashSet::default(), Vec::new());
        for (k, one) in pieces.iter().enumerate() {
            for other in pieces[k + 1..].iter().take_while(|other| other.low[0] <= one.high[0]) {
                steps.step();
                if other.low[1] > one.high[1] || one.low[1] > other.high[1] {
                    continue;
                }
                let [a, b, c, d] = [one.ends[0], one.ends[1], other.ends[0], other.ends[1]].map(|p| self.at(p));
                let mut touched = false;
                for (piece, [from, to], beyond) in [(one, [a, b], other), (other, [c, d], one)] {
                    for end in beyond.ends {
                        if piece.ends.contains(&end) {
                            touched = true;
                        } else if distance2(&self.at(end), &from, &to) <= self.near * self.near {
                            found.insert((piece.of.0, piece.of.1, end));
                            touched = true;
                        }
                    }
                }
                let opposite = |x: f64, y: f64| (x > 0.0) != (y > 0.0);
                if !touched
                    && opposite(side(&a, &b, &c), side(&a, &b, &d))
                    && opposite(side(&c, &d, &a), side(&c, &d, &b))
                {
                    let (r, s) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
                    let across = r[0] * s[1] - r[1] * s[0];
                    let share = ((c[0] - a[0]) * s[1] - (c[1] - a[1]) * s[0]) / across;
                    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
                    crossed.push((one.of, other.of, [0, 1].map(|k| a[k] + share * r[k])));
                }
            }
        }
        for (one, other, at) in crossed {
            let place = self.place([0, 1].map(|k| self.low[k] + at[k] * self.size[k]), None);
            for (path, piece) in [one, other] {
                let places = &self.paths[path as usize];
                if place != places[piece as usize] && place != places[piece as usize + 1] {
                    found.insert((path, piece, place));
                }
            }
        }
        found
    }

    /// Pieces with the inside to their left, and the outside to their right.
    fn border(&self, steps: &Progress) -> Option<Vec<[u32; 2]>> {
        // How many more pieces run from the lower to the upper place than back.
        let mut count: FxHashMap<[u32; 2], i32> = FxHashMap::default();
        let mut area = 0.0;
        for ends in self.paths.iter().flat_map(|path| path.windows(2)).filter(|ends| ends[0] != ends[1]) {
            let [p, q] = [self.at(ends[0]), self.at(ends[1])];
            area += p[0] * q[1] - p[1] * q[0];
            let rising = ends[0] < ends[1];
            *count.entry([ends[0].min(ends[1]), ends[0].max(ends[1])]).or_default() += if rising { 1 } else { -1 };
        }
        count.retain(|_, count| *count != 0);
        let mut pieces: Vec<([u32; 2], i32)> = count.into_iter().collect();
        pieces.sort_unstable();
        let places: Vec<[f64; 2]> = self.places.iter().map(|place| place.at).collect();
        let turns = winding(&places, &pieces, steps)?;
        let inside = |turns: i32| if area < 0.0 { turns < 0 } else { turns > 0 };
        let beside = |(&(ends, _), [left, right]): (&([u32; 2], i32), [i32; 2])| match (inside(left), inside(right)) {
            (true, false) => Some(ends),
            (false, true) => Some([ends[1], ends[0]]),
            _ => None,
        };
        Some(pieces.iter().zip(turns).filter_map(beside).collect())
    }

    /// Loops around what is inside, with the inside to the left, and the place of each of their points.
    fn outlines(&self, surface: &Surface, loops: &FaceLoops, steps: &Progress) -> Option<(FaceLoops, Vec<u32>)> {
        let kept = self.border(steps)?;
        let mut from: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
        kept.iter().enumerate().for_each(|(i, ends)| from.entry(ends[0]).or_default().push(i));
        let points: Vec<&LoopPoint> = loops.loops.iter().flatten().collect();
        let nodes = points.iter().map(|p| p.node + 1).max().unwrap_or(0);
        let point = |place: u32| {
            let Place { uv, point, .. } = self.places[place as usize];
            match point {
                Some(point) => LoopPoint { uv, ..*points[point as usize] },
                None => LoopPoint { uv, point: surface.point(uv), node: nodes + place },
            }
        };
        let mut used = vec![false; kept.len()];
        let mut out = FaceLoops { loops: Vec::new(), periods: loops.periods };
        let mut place_of = Vec::new();
        for first in 0..kept.len() {
            if used[first] {
                continue;
            }
            let [start, mut here] = kept[first];
            used[first] = true;
            let mut found = vec![start];
            while here != start {
                found.push(here);
                // As many pieces begin at a place as end there.
                let next = from[&here].iter().copied().find(|&i| !used[i])?;
                used[next] = true;
                here = kept[next][1];
            }
            out.loops.push(found.iter().map(|&place| point(place)).collect());
            place_of.extend(found);
        }
        Some((out, place_of))
    }

    /// The mesh with the points of the old loops first, and caps between the old chords and their pieces.
    fn joined(&self, surface: &Surface, loops: &FaceLoops, filled: &FaceMesh, place_of: &[u32]) -> FaceMesh {
        let points: Vec<&LoopPoint> = loops.loops.iter().flatten().collect();
        let mut out = FaceMesh {
            uv: points.iter().map(|p| p.uv).collect(),
            points: points.iter().map(|p| p.point).collect(),
            nodes: points.iter().map(|p| p.node).collect(),
            torn: filled.torn,
            unfinished: filled.unfinished,
            ..FaceMesh::default()
        };
        // Points on poles have nodes as well.
        let poles = place_of.len()..filled.nodes.len();
        let inner = filled.nodes.len()..filled.points.len();
        let (mut number, mut of_place) = (vec![0u32; filled.points.len()], FxHashMap::default());
        for i in poles.clone().chain(inner) {
            number[i] = out.points.len() as u32;
            out.uv.push(filled.uv[i]);
            out.points.push(filled.points[i]);
            if poles.contains(&i) {
                out.nodes.push(filled.nodes[i]);
            }
        }
        for (i, place) in self.places.iter().enumerate() {
            let here = place.point.unwrap_or_else(|| {
                out.uv.push(place.uv);
                out.points.push(surface.point(place.uv));
                out.points.len() as u32 - 1
            });
            of_place.insert(i as u32, here);
        }
        for (i, place) in place_of.iter().enumerate() {
            number[i] = of_place[place];
        }
        out.triangles = filled.triangles.iter().map(|t| t.map(|i| number[i as usize])).collect();
        let mut start = 0;
        for points in &loops.loops {
            let count = points.len();
            for k in 0..count {
                let path = &self.paths[start + k];
                let mut round = vec![(start + k) as u32, (start + (k + 1) % count) as u32];
                round.extend(path.iter().rev().map(|place| of_place[place]));
                fan(round, &mut out.triangles);
            }
            start += count;
        }
        out.normals = out.uv.iter().map(|&uv| surface.normal(uv).unwrap_or_default()).collect();
        out
    }
}

/// Triangles of a polygon; none where it is a chord that has itself as its only piece.
fn fan(mut round: Vec<u32>, triangles: &mut Vec<[u32; 3]>) {
    round.dedup();
    while round.len() > 1 && round[0] == round[round.len() - 1] {
        round.pop();
    }
    for pair in round.get(1..).unwrap_or_default().windows(2) {
        triangles.push([round[0], pair[0], pair[1]]);
    }
}
