//! Counts how many polygons lie in front of each end point of a drawn edge: the seeds of the counts along the edges.
//!
//! Within one band the query points are sorted into columns, and each polygon is compared with those between its left
//! and right end in this band; depth is compared only where it covers the point. A point is queried once, however many
//! edges end there: strict answers hold for all of them. Only ties (mostly the faces around the vertex itself) are
//! decided per edge, by the direction in which it leaves.
//!
//! ```text
//!   band ________________________________________________
//!         |--- polygon 3 ---|    :   . asked point
//!      :       |--------- polygon 7 -.------|    :
//!   ___:_________:_________:_________.____:______:________
//! ```
//!
//! Only few corners of a fine mesh are query points: most polygons meet only columns without any.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::bands::{Bands, MOST_BANDS, Slanted};
use super::mesh::Mesh;
use super::polygon_table::{PolygonTable, is_left_out};
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::Cover;

/// Height of a band, and width of a column, in heights of an average polygon.
const POLYGONS_A_BAND: f64 = 0.5;
/// With more columns than this per query point, most would be empty.
const COLUMNS_A_POINT: usize = 8;
/// Polygons that one thread looks at in one go.
const POLYGONS_AT_ONCE: usize = 1 << 12;

/// Numbers of polygons in front of a drawn edge's end: at its place, and moved toward the viewer by the contact
/// tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub plain: i32,
    pub moved: i32,
}

pub struct Seeds {
    slot: Vec<u32>,
    strict: Vec<Count>,
    tie_offsets: Vec<u32>,
    ties: Vec<u32>,
    pub asked: usize,
}

impl Seeds {
    /// Counts for every end of the given edges. behind: per group, whether its polygons are left out; empty: of none.
    pub fn new<A: Arithmetic>(
        mesh: &Mesh,
        table: &PolygonTable,
        edges: &[u32],
        behind: &[bool],
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Seeds {
        let mut slot = vec![u32::MAX; mesh.points.len()];
        let mut asked: Vec<Stop> = Vec::new();
        for &e in edges {
            for v in mesh.edges[e as usize] {
                if slot[v as usize] == u32::MAX {
                    slot[v as usize] = asked.len() as u32;
                    let (at, group) = (mesh.points[v as usize], mesh.edge_group[e as usize]);
                    asked.push(Stop { at, slot: asked.len() as u32, group });
                }
            }
        }
        let stops = Stops::new(&asked, POLYGONS_A_BAND * table.mean_height(mesh));
        // Sums do not depend on the order in which threads add to them.
        let strict: Vec<AtomicU64> = asked.iter().map(|_| AtomicU64::new(0)).collect();
        let chunks: Vec<usize> = (0..mesh.triangles.len()).step_by(POLYGONS_AT_ONCE).collect();
        let ties: Vec<Vec<(u32, u32)>> = chunks
            .into_par_iter()
            .map(|first| {
                let mut ties = Vec::new();
                if !stopped() {
                    let chunk = first..(first + POLYGONS_AT_ONCE).min(mesh.triangles.len());
                    let asked = |&t: &usize| table.counted(t) && !is_left_out(behind, mesh.triangle_group[t]);
                    for t in chunk.filter(asked) {
                        stops.count::<A>(mesh, t, &strict, &mut ties);
                    }
                }
                ties
            })
            .collect();
        let strict = strict.into_iter().map(|both| unpacked(both.into_inner())).collect();
        let (tie_offsets, ties) = by_slot(asked.len(), &ties);
        Seeds { slot, strict, tie_offsets, ties, asked: asked.len() }
    }

    /// The count at the inward-moved end `here` of the drawn edge here -> there.
    pub fn at<A: Arithmetic>(&self, mesh: &Mesh, group: i32, here: i32, there: i32) -> Count {
        let s = self.slot[here as usize] as usize;
        let mut count = self.strict[s];
        let (h, o) = (&mesh.points[here as usize], &mesh.points[there as usize]);
        for &t in &self.ties[self.tie_offsets[s] as usize..self.tie_offsets[s + 1] as usize] {
            let t = t as usize;
            // The edge is a side of this polygon: nowhere behind it, even less if moved toward the viewer.
            if mesh.triangles[t].contains(&here) && mesh.triangles[t].contains(&there) {
                continue;
            }
            let Some(cover) = mesh.cover::<A>(t) else { continue };
            let (plain, moved) = cover.hides_end(h, o, mesh.delta(group, mesh.triangle_group[t]));
            count.plain += i32::from(plain);
            count.moved += i32::from(moved);
        }
        count
    }
}

/// x range of the part of a triangle between y0 and y1; conservative, never too small.
fn within(sides: &[Slanted; 3], y0: i64, y1: i64) -> (i32, i32) {
    let (mut left, mut right) = (i32::MAX, i32::MIN);
    for side in sides.iter().filter(|side| side.meets(y0, y1)) {
        let (from, to) = side.between(y0, y1);
        left = left.min(from);
        right = right.max(to);
    }
    (left, right)
}

/// Both counts in one number, so that one addition changes both.
fn packed(plain: bool, moved: bool) -> u64 {
    u64::from(plain) | u64::from(moved) << 32
}

fn unpacked(both: u64) -> Count {
    Count { plain: both as u32 as i32, moved: (both >> 32) as i32 }
}

/// A query point.
#[derive(Clone, Copy)]
struct Stop {
    at: Point,
    slot: u32,
    group: i32,
}

/// The query points by band, and in each band by column.
struct Stops {
    bands: Bands,
    low: [i32; 2],
    high: [i32; 2],
    columns: usize,
    /// Where each column of each band begins in `stops`.
    first: Vec<u32>,
    stops: Vec<Stop>,
}

impl Stops {
    /// height: that bands should have, in grid units
    fn new(asked: &[Stop], height: f64) -> Stops {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for k in [0, 1] {
            low[k] = asked.iter().map(|s| s.at[k]).min().unwrap_or(0);
            high[k] = asked.iter().map(|s| s.at[k]).max().unwrap_or(0);
        }
        let size = [0, 1].map(|k| (i64::from(high[k]) - i64::from(low[k])) as usize);
        let most = COLUMNS_A_POINT * asked.len() + 1;
        let mut shift = 0;
        while ((1i64 << shift) as f64) < height
            || size[1] >> shift >= MOST_BANDS
            || ((size[0] >> shift) + 1).saturating_mul((size[1] >> shift) + 1) > most
        {
            shift += 1;
        }
        let bands = Bands { y0: i64::from(low[1]), shift, count: (size[1] >> shift) + 1 };
        let mut out = Stops { bands, low, high, columns: (size[0] >> shift) + 1, first: Vec::new(), stops: Vec::new() };
        let place = |s: &Stop| out.bands.of(s.at[1]) * out.columns + out.column(s.at[0]);
        let places: Vec<u32> = asked.iter().map(|s| place(s) as u32).collect();
        let mut first = vec![0u32; out.bands.count * out.columns + 1];
        places.iter().for_each(|&p| first[p as usize + 1] += 1);
        for k in 1..first.len() {
            first[k] += first[k - 1];
        }
        let mut next = first.clone();
        out.stops = asked.to_vec();
        for (stop, &p) in asked.iter().zip(&places) {
            out.stops[next[p as usize] as usize] = *stop;
            next[p as usize] += 1;
        }
        out.first = first;
        out
    }

    fn column(&self, x: i32) -> usize {
        let k = ((i64::from(x) - i64::from(self.low[0])) >> self.bands.shift).max(0) as usize;
        k.min(self.columns - 1)
    }

    /// The query points of a band between two places; others may be among them.
    fn between(&self, band: usize, left: i32, right: i32) -> &[Stop] {
        let row = band * self.columns;
        let (from, to) = (self.first[row + self.column(left)], self.first[row + self.column(right) + 1]);
        &self.stops[from as usize..to as usize]
    }

    /// Adds one to the counts of the query points that a polygon lies in front of; names those where that is a tie.
    #[inline(always)]
    fn count<A: Arithmetic>(&self, mesh: &Mesh, triangle: usize, strict: &[AtomicU64], ties: &mut Vec<(u32, u32)>) {
        let (p, q, r) = mesh.corners(triangle);
        let least = [0, 1, 2].map(|k| p[k].min(q[k]).min(r[k]));
        let most = [0, 1, 2].map(|k| p[k].max(q[k]).max(r[k]));
        if (0..2).any(|k| most[k] < self.low[k] || least[k] > self.high[k]) {
            return;
        }
        let bands: Range<usize> = self.bands.of(least[1])..self.bands.of(most[1]) + 1;
        // A low polygon is as wide in all its bands, or nearly so.
        let slanted = (bands.len() > 2).then(|| [(p, q), (q, r), (r, p)].map(|(a, b)| Slanted::new(a, b)));
        let mut cover = None;
        for band in bands {
            let (left, right) = match &slanted {
                Some(sides) => {
                    let (y0, y1) = self.bands.limits(band);
                    within(sides, y0, y1)
                }
                None => (least[0], most[0]),
            };
            if left > right {
                continue;
            }
            for stop in self.between(band, left, right) {
                let v = &stop.at;
                if v[2] < least[2] || v[1] < least[1] || v[1] > most[1] || v[0] < least[0] || v[0] > most[0] {
                    continue;
                }
                let Some(cover) = cover.get_or_insert_with(|| Cover::<A>::new(p, q, r)) else { return };
                let Some(sides) = cover.sides_within(v) else { continue };
                if sides.contains(&A::Area::ZERO) {
                    ties.push((stop.slot, triangle as u32));
                    continue;
                }
                let delta = mesh.delta(stop.group, mesh.triangle_group[triangle]);
                let (plain, moved) = if i64::from(most[2]) + delta < i64::from(v[2]) {
                    (true, true)
                } else {
                    let (beneath, shift) = (cover.beneath(v, &sides), cover.shift(delta));
                    if beneath == A::Volume::ZERO || beneath == shift {
                        ties.push((stop.slot, triangle as u32));
                        continue;
                    }
                    (beneath > A::Volume::ZERO, beneath > shift)
                };
                if plain || moved {
                    strict[stop.slot as usize].fetch_add(packed(plain, moved), Ordering::Relaxed);
                }
            }
        }
    }
}

/// Counting sort of pairs of a slot and a polygon: where each slot's polygons begin, and the polygons.
fn by_slot(slots: usize, found: &[Vec<(u32, u32)>]) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0u32; slots + 1];
    for &(s, _) in found.iter().flatten() {
        offsets[s as usize + 1] += 1;
    }
    for s in 0..slots {
        offsets[s + 1] += offsets[s];
    }
    let mut next = offsets.clone();
    let mut out = vec![0u32; offsets[slots] as usize];
    for &(s, t) in found.iter().flatten() {
        out[next[s as usize] as usize] = t;
        next[s as usize] += 1;
    }
    (offsets, out)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::SnappedGroup;
    use super::*;
    use crate::random::below;
    use hlr_exact::arithmetic::Exact;

    const DELTA: i64 = 5;

    /// What `Stops::count` finds, by comparing every polygon with every query point.
    fn one_by_one(mesh: &Mesh, asked: &[Stop]) -> (Vec<Count>, Vec<(u32, u32)>) {
        let (mut counts, mut ties) = (vec![Count::default(); asked.len()], Vec::new());
        for t in 0..mesh.triangles.len() {
            let Some(cover) = mesh.cover::<Exact>(t) else { continue };
            let nearest = mesh.triangles[t].iter().map(|&v| mesh.points[v as usize][2]).min().unwrap();
            for stop in asked.iter().filter(|stop| stop.at[2] >= nearest) {
                let sides = cover.sides(&stop.at);
                let (beneath, shift) = (cover.beneath(&stop.at, &sides), cover.shift(DELTA));
                if sides.iter().any(|&side| side < 0) {
                } else if sides.contains(&0) || beneath == 0 || beneath == shift {
                    ties.push((stop.slot, t as u32));
                } else {
                    counts[stop.slot as usize].plain += i32::from(beneath > 0);
                    counts[stop.slot as usize].moved += i32::from(beneath > shift);
                }
            }
        }
        ties.sort_unstable();
        (counts, ties)
    }

    #[test]
    fn no_point_behind_a_polygon_is_overlooked() {
        let mut random = below(1);
        let (mut behind, mut tied) = (0, 0);
        for round in 0..300 {
            let size = [3, 20, 400][round % 3];
            let mut points = Vec::new();
            for polygon in 0..40 {
                // Some are seen at a right angle, so that points lie at exactly the tolerance behind them.
                let depth = [1, 20][polygon % 2];
                let at = [random(1200) - 600, random(600) - 100, random(99)];
                points.extend([0; 3].map(|_| [at[0] + random(size), at[1] + random(size), at[2] + random(depth)]));
            }
            // Every third query point is a corner of a polygon.
            let mut place = |slot: u32| match slot % 3 {
                0 => points[random(120) as usize],
                _ => [random(900) - 400, random(400), random(99)],
            };
            let asked: Vec<Stop> =
                (0..round as u32 % 50).map(|slot| Stop { at: place(slot), slot, group: 0 }).collect();
            let triangles: Vec<[i32; 3]> = (0..40).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
            let open = SnappedGroup { cull: false, sound: true, delta: DELTA, cap: DELTA, tight: false };
            let mesh = Mesh {
                points,
                triangles: &triangles,
                triangle_group: &[1; 40],
                edges: &[],
                offsets: &[0],
                incident: &[],
                edge_group: &[],
                role: &[],
                groups: vec![open; 2],
            };
            // Low bands, high ones, and one of all.
            for height in [1.0, 30.0, 5000.0] {
                let stops = Stops::new(&asked, height);
                let strict: Vec<AtomicU64> = asked.iter().map(|_| AtomicU64::new(0)).collect();
                let mut ties = Vec::new();
                (0..40).for_each(|t| stops.count::<Exact>(&mesh, t, &strict, &mut ties));
                ties.sort_unstable();
                let counts: Vec<Count> = strict.into_iter().map(|both| unpacked(both.into_inner())).collect();
                behind += counts.iter().map(|count| count.plain).sum::<i32>();
                tied += ties.len();
                assert_eq!((counts, ties), one_by_one(&mesh, &asked), "round {round}, bands of {height}");
            }
        }
        assert!(behind > 1000 && tied > 30, "{behind} {tied}");
    }
}
