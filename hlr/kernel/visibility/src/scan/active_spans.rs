//! Counts how many polygons lie in front of each end point of a drawn edge: the seeds of the counts along the edges.
//!
//! Within one band the query points are sorted by x, and each polygon is compared with those between its left and right
//! end in this band; depth is compared only where it covers the point. A point is queried once, however many edges end
//! there: strict answers hold for all of them. Only ties (mostly the faces around the vertex itself) are decided per
//! edge, by the direction in which it leaves.
//!
//! ```text
//!   band ________________________________________________
//!         |--- polygon 3 ---|        . asked point
//!              |--------- polygon 7 -.------|
//!   _________________________________.____________________
//! ```
//!
//! Only few corners of a fine mesh are query points: a coarse grid tells at once where none lies behind a polygon.

use rayon::prelude::*;

use super::bands::{Bands, clipped_x, y_range};
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::Cover;

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

#[derive(Default)]
struct Found {
    strict: Vec<(u32, Count)>,
    ties: Vec<(u32, u32)>,
}

impl Seeds {
    /// Counts for every end of the given edges.
    pub fn new<A: Arithmetic>(
        mesh: &Mesh,
        table: &PolygonTable,
        edges: &[u32],
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Seeds {
        let mut slot = vec![u32::MAX; mesh.points.len()];
        let mut asked: Vec<(u32, i32)> = Vec::new();
        for &e in edges {
            for v in mesh.edges[e as usize] {
                if slot[v as usize] == u32::MAX {
                    slot[v as usize] = asked.len() as u32;
                    asked.push((v as u32, mesh.edge_group[e as usize]));
                }
            }
        }
        let places = Places::new(asked.iter().map(|&(v, _)| &mesh.points[v as usize]));
        let counted: Vec<u32> = (0..mesh.triangles.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 10)
            .filter(|&t| table.counted(mesh, t as usize) && places.any_behind(mesh.corners(t as usize)))
            .collect();
        let ranges: Vec<(i32, i32)> = counted
            .par_iter()
            .map(|&t| {
                let (p, q, r) = mesh.corners(t as usize);
                (p[1].min(q[1]).min(r[1]), p[1].max(q[1]).max(r[1]))
            })
            .collect();
        let bands = Bands::choose(&ranges, 0.5);
        let (offsets, items) = bands.bucket(&ranges);
        let points: Vec<(i32, i32)> = asked
            .iter()
            .map(|&(v, _)| {
                let y = mesh.points[v as usize][1];
                (y, y)
            })
            .collect();
        let (point_offsets, point_items) = bands.bucket(&points);
        let found: Vec<Found> = (0..bands.count)
            .into_par_iter()
            .map(|k| {
                let here = &point_items[point_offsets[k] as usize..point_offsets[k + 1] as usize];
                let polygons = &items[offsets[k] as usize..offsets[k + 1] as usize];
                if here.is_empty() || polygons.is_empty() || stopped() {
                    return Found::default();
                }
                sweep_band::<A>(mesh, &bands, k, here, &asked, polygons, &counted)
            })
            .collect();
        gather(slot, asked.len(), &found)
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

fn sweep_band<A: Arithmetic>(
    mesh: &Mesh,
    bands: &Bands,
    band: usize,
    here: &[u32],
    asked: &[(u32, i32)],
    polygons: &[u32],
    counted: &[u32],
) -> Found {
    let (y0, y1) = bands.limits(band);
    let mut stops: Vec<Stop> = here.iter().map(|&slot| Stop::new(mesh, slot, asked[slot as usize])).collect();
    stops.sort_unstable_by_key(|s| (s.at[0], s.slot));
    let xs: Vec<i32> = stops.iter().map(|s| s.at[0]).collect();
    let mut counts = vec![Count::default(); stops.len()];
    let mut found = Found::default();
    for &i in polygons {
        let triangle = counted[i as usize];
        let (p, q, r) = mesh.corners(triangle as usize);
        let least = |k: usize| p[k].min(q[k]).min(r[k]);
        let most = |k: usize| p[k].max(q[k]).max(r[k]);
        let first = xs.partition_point(|&x| x < least(0));
        if first == xs.len() || xs[first] > most(0) {
            continue;
        }
        let (left, right) = within([p, q, r], y0, y1);
        let first = first + xs[first..].partition_point(|&x| x < left);
        let (ymin, ymax, zmin, zmax) = (least(1), most(1), least(2), most(2));
        let mut cover = None;
        for (stop, count) in stops[first..].iter().zip(&mut counts[first..]) {
            let v = &stop.at;
            if v[0] > right {
                break;
            }
            if v[1] < ymin || v[1] > ymax || v[2] < zmin {
                continue;
            }
            let Some(cover) = cover.get_or_insert_with(|| Cover::<A>::new(p, q, r)) else { break };
            let sides = cover.sides(v);
            let zero = A::Area::ZERO;
            if sides[0] < zero || sides[1] < zero || sides[2] < zero {
                continue;
            }
            if sides[0] == zero || sides[1] == zero || sides[2] == zero {
                found.ties.push((stop.slot, triangle));
                continue;
            }
            let delta = mesh.delta(stop.group, mesh.triangle_group[triangle as usize]);
            if i64::from(zmax) + delta < i64::from(v[2]) {
                count.plain += 1;
                count.moved += 1;
                continue;
            }
            let beneath = cover.beneath(v, &sides);
            let shift = cover.shift(delta);
            if beneath == A::Volume::ZERO || beneath == shift {
                found.ties.push((stop.slot, triangle));
                continue;
            }
            count.plain += i32::from(beneath > A::Volume::ZERO);
            count.moved += i32::from(beneath > shift);
        }
    }
    let strict = stops.iter().zip(counts).filter(|(_, count)| *count != Count::default());
    found.strict.extend(strict.map(|(stop, count)| (stop.slot, count)));
    found
}

/// x range of the part of a triangle between y0 and y1; conservative, never too small.
fn within([p, q, r]: [&Point; 3], y0: i64, y1: i64) -> (i32, i32) {
    let (mut left, mut right) = (i32::MAX, i32::MIN);
    for (a, b) in [(p, q), (q, r), (r, p)] {
        let (low, high) = y_range(a, b);
        if i64::from(low) <= y1 && i64::from(high) >= y0 {
            let (from, to) = clipped_x(a, b, y0, y1);
            left = left.min(from);
            right = right.max(to);
        }
    }
    (left, right)
}

/// A query point in its band.
struct Stop {
    at: Point,
    slot: u32,
    group: i32,
}

impl Stop {
    fn new(mesh: &Mesh, slot: u32, (vertex, group): (u32, i32)) -> Stop {
        Stop { at: mesh.points[vertex as usize], slot, group }
    }
}

/// A coarse grid of query points: per cell of the image the depth of the farthest.
struct Places {
    low: [i64; 2],
    shift: u32,
    columns: usize,
    rows: usize,
    farthest: Vec<i32>,
}

/// A polygon that covers more cells than this is not tested: it is large, and probably covers a query point.
const MANY_CELLS: usize = 16;

impl Places {
    fn new<'p>(points: impl Iterator<Item = &'p Point> + Clone) -> Places {
        let (mut low, mut high, mut count) = ([i64::MAX; 2], [i64::MIN; 2], 0usize);
        for p in points.clone() {
            count += 1;
            for k in [0, 1] {
                low[k] = low[k].min(i64::from(p[k]));
                high[k] = high[k].max(i64::from(p[k]));
            }
        }
        if count == 0 {
            return Places { low: [0; 2], shift: 0, columns: 0, rows: 0, farthest: Vec::new() };
        }
        let size = [0, 1].map(|k| high[k] - low[k] + 1);
        // Four cells per point, and at most a few million in all.
        let wanted = (4.0 * count as f64).sqrt().clamp(1.0, 2048.0);
        let mut shift = 0;
        while (size[0].max(size[1]) >> shift) as f64 >= wanted {
            shift += 1;
        }
        let [columns, rows] = size.map(|s| (s >> shift) as usize + 1);
        let mut farthest = vec![i32::MIN; columns * rows];
        for p in points {
            let [column, row] = [0, 1].map(|k| ((i64::from(p[k]) - low[k]) >> shift) as usize);
            let cell = &mut farthest[row * columns + column];
            *cell = p[2].max(*cell);
        }
        Places { low, shift, columns, rows, farthest }
    }

    /// Whether a query point in the triangle's box may lie behind its nearest corner. False only where that is certain.
    #[inline]
    fn any_behind(&self, (p, q, r): (&Point, &Point, &Point)) -> bool {
        let cells = |k: usize, count: usize| {
            let (least, most) = (p[k].min(q[k]).min(r[k]), p[k].max(q[k]).max(r[k]));
            let from = ((i64::from(least) - self.low[k]) >> self.shift).max(0) as usize;
            let to = (i64::from(most) - self.low[k]) >> self.shift;
            from..((to + 1).max(0) as usize).min(count)
        };
        let (columns, rows) = (cells(0, self.columns), cells(1, self.rows));
        if columns.is_empty() || rows.is_empty() {
            return false;
        }
        let nearest = p[2].min(q[2]).min(r[2]);
        columns.len() * rows.len() > MANY_CELLS
            || rows.into_iter().any(|row| {
                let line = &self.farthest[row * self.columns..(row + 1) * self.columns];
                line[columns.clone()].iter().any(|&farthest| farthest >= nearest)
            })
    }
}

fn gather(slot: Vec<u32>, slots: usize, found: &[Found]) -> Seeds {
    let mut strict = vec![Count::default(); slots];
    let mut tie_offsets = vec![0u32; slots + 1];
    for f in found {
        for &(s, count) in &f.strict {
            strict[s as usize] = count;
        }
        for &(s, _) in &f.ties {
            tie_offsets[s as usize + 1] += 1;
        }
    }
    for s in 0..slots {
        tie_offsets[s + 1] += tie_offsets[s];
    }
    let mut next = tie_offsets.clone();
    let mut ties = vec![0u32; tie_offsets[slots] as usize];
    for f in found {
        for &(s, t) in &f.ties {
            ties[next[s as usize] as usize] = t;
            next[s as usize] += 1;
        }
    }
    Seeds { slot, strict, tie_offsets, ties, asked: slots }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_behind_a_triangle_is_overlooked() {
        let mut state = 1u64;
        let mut random = |n: i32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 33) as i32).rem_euclid(n)
        };
        let mut none = 0;
        for round in 0..400 {
            let points: Vec<Point> = (0..round % 50).map(|_| [random(2000) - 900, random(900), random(99)]).collect();
            let places = Places::new(points.iter());
            let at = [random(4000) - 2000, random(3000) - 1500, random(99)];
            let corner = |_| [at[0] + random(150), at[1] + random(150), at[2] + random(20)];
            let [p, q, r] = [0, 1, 2].map(corner);
            let inside =
                |v: &Point| (0..2).all(|k| (p[k].min(q[k]).min(r[k])..=p[k].max(q[k]).max(r[k])).contains(&v[k]));
            let behind = points.iter().any(|v| inside(v) && v[2] >= p[2].min(q[2]).min(r[2]));
            let told = places.any_behind((&p, &q, &r));
            assert!(told || !behind);
            none += i32::from(!told);
        }
        assert!(none > 200, "{none}");
    }
}
