//! The query points of the seeds, and which of them a polygon lies in front of.
//!
//! Within one band the query points are sorted into columns, and each polygon is compared with those between its left
//! and right end in this band, several in one go; depth is compared only where it covers the point.
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

use super::bands::{Bands, MOST_BANDS, Slanted};
use super::mesh::Mesh;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::Cover;

/// With more columns than this per query point, most would be empty.
const COLUMNS_A_POINT: usize = 8;
/// Columns beyond the first up to which a polygon is looked for in all of them, in each of its bands.
const NARROW: usize = 3;
/// Query points that are compared with a polygon in one go.
const AT_ONCE: usize = 8;
/// No query point.
pub const NONE: u32 = u32::MAX;

/// Numbers of polygons in front of a drawn edge's end: at its place, and moved toward the viewer by the contact
/// tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub plain: i32,
    pub moved: i32,
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

pub fn unpacked(both: u64) -> Count {
    Count { plain: both as u32 as i32, moved: (both >> 32) as i32 }
}

/// A query point.
#[derive(Clone, Copy)]
pub struct Stop {
    pub at: Point,
    pub slot: u32,
    pub group: i32,
}

/// The query points by band, and in each band by column.
pub struct Stops {
    bands: Bands,
    low: [i32; 2],
    high: [i32; 2],
    columns: usize,
    /// Where each column of each band begins in the lists below.
    first: Vec<u32>,
    /// Of each query point; after the last there are more, so that AT_ONCE can be read from any.
    at: [Vec<i32>; 3],
    slot: Vec<u32>,
    group: Vec<i32>,
}

impl Stops {
    /// height: that bands should have, in grid units
    pub fn new(asked: &[Stop], height: f64) -> Stops {
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
        let length = asked.len() + AT_ONCE - 1;
        let mut out = Stops {
            bands,
            low,
            high,
            columns: (size[0] >> shift) + 1,
            first: Vec::new(),
            at: [0; 3].map(|_| vec![0; length]),
            slot: vec![NONE; length],
            group: vec![0; length],
        };
        let place = |s: &Stop| out.bands.of(s.at[1]) * out.columns + out.column(s.at[0]);
        let places: Vec<u32> = asked.iter().map(|s| place(s) as u32).collect();
        let mut first = vec![0u32; out.bands.count * out.columns + 1];
        places.iter().for_each(|&p| first[p as usize + 1] += 1);
        for k in 1..first.len() {
            first[k] += first[k - 1];
        }
        let mut next = first.clone();
        for (stop, &p) in asked.iter().zip(&places) {
            let k = next[p as usize] as usize;
            next[p as usize] += 1;
            for (list, c) in out.at.iter_mut().zip(stop.at) {
                list[k] = c;
            }
            (out.slot[k], out.group[k]) = (stop.slot, stop.group);
        }
        out.first = first;
        out
    }

    fn column(&self, x: i32) -> usize {
        let k = ((i64::from(x) - i64::from(self.low[0])) >> self.bands.shift).max(0) as usize;
        k.min(self.columns - 1)
    }

    /// The query points of a band between two places; others may be among them.
    fn between(&self, band: usize, left: usize, right: usize) -> Range<usize> {
        let row = band * self.columns;
        self.first[row + left] as usize..self.first[row + right + 1] as usize
    }

    /// Which of the AT_ONCE query points from `first` on lie within a box, and not before it, as bits; those in the
    /// slots `own` do not count.
    #[inline(always)]
    fn within(&self, first: usize, least: &Point, most: &Point, own: &[u32; 3]) -> u32 {
        let of = |k: usize| -> &[i32; AT_ONCE] { (&self.at[k][first..first + AT_ONCE]).try_into().expect("as many") };
        let ([x, y, z], slot) = ([of(0), of(1), of(2)], &self.slot[first..first + AT_ONCE]);
        // Without a branch per comparison: which of them fails cannot be foretold.
        let mut bits = [0u32; AT_ONCE];
        for k in 0..AT_ONCE {
            let inside = (x[k] >= least[0])
                & (x[k] <= most[0])
                & (y[k] >= least[1])
                & (y[k] <= most[1])
                & (z[k] >= least[2])
                & (slot[k] != own[0])
                & (slot[k] != own[1])
                & (slot[k] != own[2]);
            bits[k] = u32::from(inside) << k;
        }
        bits.iter().fold(0, |all, bit| all | bit)
    }

    /// Adds one to the counts of the query points that a polygon lies in front of; names those where that is a tie.
    /// own: the slots of its corners, which are ties by themselves; NONE where a corner is no query point.
    #[inline(always)]
    pub fn count<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        triangle: usize,
        own: [u32; 3],
        strict: &[AtomicU64],
        ties: &mut Vec<(u32, u32)>,
    ) {
        ties.extend(own.iter().filter(|&&slot| slot != NONE).map(|&slot| (slot, triangle as u32)));
        let (p, q, r) = mesh.corners(triangle);
        let least = [0, 1, 2].map(|k| p[k].min(q[k]).min(r[k]));
        let most = [0, 1, 2].map(|k| p[k].max(q[k]).max(r[k]));
        if (0..2).any(|k| most[k] < self.low[k] || least[k] > self.high[k]) {
            return;
        }
        let bands: Range<usize> = self.bands.of(least[1])..self.bands.of(most[1]) + 1;
        let columns = (self.column(least[0]), self.column(most[0]));
        // A low polygon is as wide in all its bands, or nearly so, and of a narrow one little is gained.
        let slanted = (bands.len() > 2 && columns.1 - columns.0 > NARROW)
            .then(|| [(p, q), (q, r), (r, p)].map(|(a, b)| Slanted::new(a, b)));
        let mut cover = None;
        for band in bands {
            let (left, right) = match &slanted {
                Some(sides) => {
                    let (y0, y1) = self.bands.limits(band);
                    let (left, right) = within(sides, y0, y1);
                    if left > right {
                        continue;
                    }
                    (self.column(left), self.column(right))
                }
                None => columns,
            };
            let run = self.between(band, left, right);
            for first in run.clone().step_by(AT_ONCE) {
                let mut hits = self.within(first, &least, &most, &own);
                if run.end - first < AT_ONCE {
                    hits &= (1 << (run.end - first)) - 1;
                }
                while hits != 0 {
                    let k = first + hits.trailing_zeros() as usize;
                    hits &= hits - 1;
                    let v = &[self.at[0][k], self.at[1][k], self.at[2][k]];
                    let Some(cover) = cover.get_or_insert_with(|| Cover::<A>::new(p, q, r)) else { return };
                    let Some(sides) = cover.sides_within(v) else { continue };
                    if sides.contains(&A::Area::ZERO) {
                        ties.push((self.slot[k], triangle as u32));
                        continue;
                    }
                    let delta = mesh.delta(self.group[k], mesh.triangle_group[triangle]);
                    let (plain, moved) = if i64::from(most[2]) + delta < i64::from(v[2]) {
                        (true, true)
                    } else {
                        let (beneath, shift) = (cover.beneath(v, &sides), cover.shift(delta));
                        if beneath == A::Volume::ZERO || beneath == shift {
                            ties.push((self.slot[k], triangle as u32));
                            continue;
                        }
                        (beneath > A::Volume::ZERO, beneath > shift)
                    };
                    if plain || moved {
                        strict[self.slot[k] as usize].fetch_add(packed(plain, moved), Ordering::Relaxed);
                    }
                }
            }
        }
    }
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
            // Every third query point is a corner of a polygon, and known as that unless another one is as well.
            let mut slots = vec![NONE; points.len()];
            let mut place = |slot: u32| match slot % 3 {
                0 => {
                    let corner = random(120) as usize;
                    slots[corner] = slot;
                    points[corner]
                }
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
                crossing: &[],
                role: &[],
                groups: vec![open; 2],
            };
            // Low bands, high ones, and one of all.
            for height in [1.0, 30.0, 5000.0] {
                let stops = Stops::new(&asked, height);
                let strict: Vec<AtomicU64> = asked.iter().map(|_| AtomicU64::new(0)).collect();
                let mut ties = Vec::new();
                for t in (0..40).filter(|&t| mesh.cover::<Exact>(t).is_some()) {
                    let own = triangles[t].map(|v| if round % 2 == 0 { slots[v as usize] } else { NONE });
                    stops.count::<Exact>(&mesh, t, own, &strict, &mut ties);
                }
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
