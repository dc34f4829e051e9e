//! Seeds: how many polygons lie in front of an end point of a drawn edge.
//!
//! Within one band the polygons are sorted by where they begin and the end points by x; the sweep moves right, a
//! polygon is "in" from its left to its right end in this band (the active spans), and depth is compared only for
//! polygons that are in and cover the point. A point is asked once, however many edges end there: what is strictly
//! decided holds for all of them, and only the ties (the faces around the vertex itself, mostly) are decided per
//! edge, by the direction in which it leaves.
//!
//! ```text
//!   band ________________________________________________
//!         |--- polygon 3 ---|        . asked point
//!              |--------- polygon 7 -.------|
//!   _________________________________.____________________
//! ```

use rayon::prelude::*;

use super::bands::{Bands, clipped_x, y_range};
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::Cover;

/// Polygons in front of a drawn edge's end: as it lies, and moved toward the viewer by the contact tolerance.
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

struct Span {
    xmin: i32,
    xmax: i32,
    triangle: u32,
}

struct Active<A: Arithmetic> {
    xmax: i32,
    ymin: i32,
    ymax: i32,
    zmin: i32,
    zmax: i32,
    triangle: u32,
    cover: Cover<A>,
}

#[derive(Default)]
struct Found {
    strict: Vec<(u32, Count)>,
    ties: Vec<(u32, u32)>,
}

impl Seeds {
    /// Ask for every end of the given edges.
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
                    asked.push((v as u32, mesh.edge_part[e as usize]));
                }
            }
        }
        let counted: Vec<u32> =
            (0..mesh.triangles.len()).filter(|&t| table.counted(mesh, t)).map(|t| t as u32).collect();
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
    pub fn at<A: Arithmetic>(&self, mesh: &Mesh, part: i32, here: i32, there: i32) -> Count {
        let s = self.slot[here as usize] as usize;
        let mut count = self.strict[s];
        let (h, o) = (&mesh.points[here as usize], &mesh.points[there as usize]);
        for &t in &self.ties[self.tie_offsets[s] as usize..self.tie_offsets[s + 1] as usize] {
            let t = t as usize;
            let Some(cover) = mesh.cover::<A>(t) else { continue };
            let (plain, moved) = cover.hides_end(h, o, mesh.delta(part, mesh.triangle_part[t]));
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
    let mut spans: Vec<Span> = polygons.iter().map(|&i| span(mesh, counted[i as usize], y0, y1)).collect();
    spans.sort_unstable_by_key(|s| (s.xmin, s.triangle));
    let mut stops: Vec<(i32, u32)> = here.iter().map(|&s| (mesh.points[asked[s as usize].0 as usize][0], s)).collect();
    stops.sort_unstable();
    let mut active: Vec<Active<A>> = Vec::new();
    let mut next = 0;
    let mut found = Found::default();
    for &(x, slot) in &stops {
        while next < spans.len() && spans[next].xmin <= x {
            if spans[next].xmax >= x {
                enter(mesh, &spans[next], &mut active);
            }
            next += 1;
        }
        let (vertex, part) = asked[slot as usize];
        let v = &mesh.points[vertex as usize];
        let mut count = Count::default();
        let mut i = 0;
        while i < active.len() {
            let a = &active[i];
            if a.xmax < x {
                active.swap_remove(i);
                continue;
            }
            i += 1;
            if v[1] < a.ymin || v[1] > a.ymax || v[2] < a.zmin {
                continue;
            }
            let sides = a.cover.sides(v);
            let zero = A::Area::ZERO;
            if sides[0] < zero || sides[1] < zero || sides[2] < zero {
                continue;
            }
            if sides[0] == zero || sides[1] == zero || sides[2] == zero {
                found.ties.push((slot, a.triangle));
                continue;
            }
            let delta = mesh.delta(part, mesh.triangle_part[a.triangle as usize]);
            if i64::from(a.zmax) + delta < i64::from(v[2]) {
                count.plain += 1;
                count.moved += 1;
                continue;
            }
            let beneath = a.cover.beneath(v, &sides);
            let shift = a.cover.shift(delta);
            if beneath == A::Volume::ZERO || beneath == shift {
                found.ties.push((slot, a.triangle));
                continue;
            }
            count.plain += i32::from(beneath > A::Volume::ZERO);
            count.moved += i32::from(beneath > shift);
        }
        if count != Count::default() {
            found.strict.push((slot, count));
        }
    }
    found
}

fn span(mesh: &Mesh, triangle: u32, y0: i64, y1: i64) -> Span {
    let (p, q, r) = mesh.corners(triangle as usize);
    let (mut xmin, mut xmax) = (i32::MAX, i32::MIN);
    for (a, b) in [(p, q), (q, r), (r, p)] {
        let (low, high) = y_range(a, b);
        if i64::from(low) <= y1 && i64::from(high) >= y0 {
            let (left, right) = clipped_x(a, b, y0, y1);
            xmin = xmin.min(left);
            xmax = xmax.max(right);
        }
    }
    Span { xmin, xmax, triangle }
}

fn enter<A: Arithmetic>(mesh: &Mesh, span: &Span, active: &mut Vec<Active<A>>) {
    let (p, q, r) = mesh.corners(span.triangle as usize);
    if let Some(cover) = Cover::new(p, q, r) {
        active.push(Active {
            xmax: span.xmax,
            ymin: p[1].min(q[1]).min(r[1]),
            ymax: p[1].max(q[1]).max(r[1]),
            zmin: p[2].min(q[2]).min(r[2]),
            zmax: p[2].max(q[2]).max(r[2]),
            triangle: span.triangle,
            cover,
        });
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
