//! Finds where drawn edges pass behind contour edges.
//!
//! Within one band the active edge list moves right: an edge enters at the left end of its part in this band and leaves
//! at the right end; an entering drawn edge meets the active contours, an entering contour the active drawn edges.
//! A pair that shares several bands is recorded in the one band that holds its crossing (decided exactly).

use rayon::prelude::*;

use super::bands::{Bands, clipped_x, y_range};
use super::edge_table::Contour;
use super::invisibility::Event;
use super::mesh::Mesh;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::crossing;

pub struct Crossings<P> {
    pub events: Vec<Vec<Event<P>>>,
    pub tests: u64,
    pub bands: usize,
}

/// An edge that is a contour, drawn, or both: it comes into a band once.
#[derive(Clone, Copy)]
struct BandEdge {
    edge: u32,
    /// Its number among the contours, or NONE.
    contour: u32,
    /// Its number among the drawn edges, or NONE.
    drawn: u32,
}

const NONE: u32 = u32::MAX;

/// The edges of both lists, which ascend, each once.
fn each_once(contours: &[Contour], drawn: &[u32]) -> Vec<BandEdge> {
    let mut out = Vec::with_capacity(contours.len().max(drawn.len()));
    let (mut i, mut j) = (0, 0);
    while i < contours.len() || j < drawn.len() {
        let (c, f) = (contours.get(i).map_or(NONE, |c| c.edge), drawn.get(j).map_or(NONE, |&e| e));
        let edge = c.min(f);
        let number = |here: bool, number: usize| if here { number as u32 } else { NONE };
        out.push(BandEdge { edge, contour: number(c == edge, i), drawn: number(f == edge, j) });
        i += usize::from(c == edge);
        j += usize::from(f == edge);
    }
    out
}

/// The part of an edge in a band.
#[derive(Clone, Copy)]
struct Part {
    a: Point,
    b: Point,
    xmin: i32,
    xmax: i32,
    group: i32,
    /// Numbers of `BandEdge`.
    contour: u32,
    drawn: u32,
}

/// What decides whether two parts may cross.
#[derive(Clone, Copy)]
struct Entry {
    xmin: i32,
    xmax: i32,
    ymin: i32,
    ymax: i32,
    /// Contours: nearest depth. Drawn edges: farthest depth.
    z: i32,
    /// Number among the parts of the band.
    part: u32,
}

/// From left to right, and by number where they begin at the same place.
fn from_left(order: &mut [u64], parts: &[Part], depth: impl Fn(i32, i32) -> i32) -> Vec<Entry> {
    order.sort_unstable();
    let entry = |&key: &u64| {
        let part = &parts[(key & 0xffff_ffff) as usize];
        let (ymin, ymax) = y_range(&part.a, &part.b);
        let z = depth(part.a[2], part.b[2]);
        Entry { xmin: part.xmin, xmax: part.xmax, ymin, ymax, z, part: key as u32 }
    };
    order.iter().map(entry).collect()
}

/// Orders by place first, then by number.
fn key(x: i32, number: usize) -> u64 {
    u64::from(x as u32 ^ 1 << 31) << 32 | number as u64
}

pub fn crossings<A: Arithmetic>(
    mesh: &Mesh,
    drawn: &[u32],
    contours: &[Contour],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Crossings<A::Parameter> {
    let items = each_once(contours, drawn);
    let range = |of: &BandEdge| {
        let (a, b) = mesh.ends(of.edge as usize);
        y_range(a, b)
    };
    let ranges: Vec<(i32, i32)> = items.par_iter().with_min_len(1 << 12).map(range).collect();
    let as_both = |k: usize| 1 + usize::from(items[k].contour != NONE && items[k].drawn != NONE);
    let bands = Bands::choose(&ranges, as_both, 0.75);
    let (offsets, bucketed) = bands.bucket(&ranges);
    let found: Vec<(Vec<Event<A::Parameter>>, u64)> = (0..bands.count)
        .into_par_iter()
        .map(|k| {
            let bucket = &bucketed[offsets[k] as usize..offsets[k + 1] as usize];
            if stopped() {
                return (Vec::new(), 0);
            }
            let (y0, y1) = bands.limits(k);
            let (mut parts, mut cs, mut fs) = (Vec::with_capacity(bucket.len()), Vec::new(), Vec::new());
            for &i in bucket {
                let BandEdge { edge, contour, drawn } = items[i as usize];
                let (a, b) = mesh.ends(edge as usize);
                let (xmin, xmax) = clipped_x(a, b, y0, y1);
                let key = key(xmin, parts.len());
                if contour != NONE {
                    cs.push(key);
                }
                if drawn != NONE {
                    fs.push(key);
                }
                let group = mesh.edge_group[edge as usize];
                parts.push(Part { a: *a, b: *b, xmin, xmax, group, contour, drawn });
            }
            if cs.is_empty() || fs.is_empty() {
                return (Vec::new(), 0);
            }
            let (cs, fs) = (from_left(&mut cs, &parts, i32::min), from_left(&mut fs, &parts, i32::max));
            Sweep::<A> { mesh, parts, contours, bands: &bands, band: k, events: Vec::new(), tests: 0 }.run(&cs, &fs)
        })
        .collect();
    let tests = found.iter().map(|f| f.1).sum();
    Crossings { events: found.into_iter().map(|f| f.0).collect(), tests, bands: bands.count }
}

struct Sweep<'a, A: Arithmetic> {
    mesh: &'a Mesh<'a>,
    parts: Vec<Part>,
    contours: &'a [Contour],
    bands: &'a Bands,
    band: usize,
    events: Vec<Event<A::Parameter>>,
    tests: u64,
}

impl<A: Arithmetic> Sweep<'_, A> {
    fn run(mut self, cs: &[Entry], fs: &[Entry]) -> (Vec<Event<A::Parameter>>, u64) {
        let mut active_c: Vec<Entry> = Vec::new();
        let mut active_f: Vec<Entry> = Vec::new();
        let (mut i, mut j) = (0, 0);
        while i < cs.len() || j < fs.len() {
            let contour_next = j == fs.len() || (i < cs.len() && cs[i].xmin <= fs[j].xmin);
            if contour_next {
                let c = cs[i];
                i += 1;
                self.meet(&c, &mut active_f, |sweep, f| sweep.test(f, &c));
                active_c.push(c);
            } else {
                let f = fs[j];
                j += 1;
                self.meet(&f, &mut active_c, |sweep, c| sweep.test(&f, c));
                active_f.push(f);
            }
        }
        (self.events, self.tests)
    }

    /// Drops the active edges that ended before `entering`, and tests it against the others.
    #[inline(always)]
    fn meet(&mut self, entering: &Entry, active: &mut Vec<Entry>, mut test: impl FnMut(&mut Self, &Entry)) {
        let mut k = 0;
        while k < active.len() {
            if active[k].xmax < entering.xmin {
                active.swap_remove(k);
                continue;
            }
            test(self, &active[k]);
            k += 1;
        }
    }

    #[inline(always)]
    fn test(&mut self, f: &Entry, c: &Entry) {
        if f.ymin > c.ymax || c.ymin > f.ymax || c.z >= f.z {
            return;
        }
        self.tests += 1;
        let (front, own) = (&self.parts[c.part as usize], &self.parts[f.part as usize]);
        let (a, b, p, q) = (&own.a, &own.b, &front.a, &front.b);
        let Some(hit) = crossing::<A>(a, b, p, q) else { return };
        if hit.beneath <= A::Volume::ZERO {
            return;
        }
        let first = self.bands.of(f.ymin.max(c.ymin));
        let last = self.bands.of(f.ymax.min(c.ymax));
        if first != last {
            // y of the crossing against the band's limits: (y_a - y) d + n (y_b - y_a), degree 3.
            let at = |y: i64| {
                let (ya, yb) = (i64::from(a[1]), i64::from(b[1]));
                A::depth(ya - y) * A::raise(hit.d) + A::raise(hit.n) * A::depth(yb - ya)
            };
            let (y0, y1) = self.bands.limits(self.band);
            if (self.band > first && at(y0) < A::Volume::ZERO) || (self.band < last && at(y1) >= A::Volume::ZERO) {
                return;
            }
        }
        let delta = self.mesh.delta(own.group, front.group);
        let jump = self.contours[front.contour as usize].jump * hit.to_left;
        self.events.push(Event {
            drawn: own.drawn,
            at: A::crossing(hit.n, hit.d),
            plain: jump,
            moved: if hit.beneath > A::depth(delta) * A::raise(hit.d) { jump } else { 0 },
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_of_both_lists_comes_once() {
        let contours = [1, 3, 7].map(|edge| Contour { edge, jump: 1 });
        let found = each_once(&contours, &[0, 3, 4, 7, 8]).into_iter().map(|of| (of.edge, of.contour, of.drawn));
        let wanted = [(0, NONE, 0), (1, 0, NONE), (3, 1, 1), (4, NONE, 2), (7, 2, 3), (8, NONE, 4)];
        assert_eq!(found.collect::<Vec<_>>(), wanted);
        assert!(each_once(&[], &[]).is_empty());
    }

    #[test]
    fn keys_ascend_from_left_to_right_and_then_by_number() {
        let keys = [(i32::MIN, 5), (-1, 0), (-1, 9), (0, 3), (1, 1), (i32::MAX, 0)].map(|(x, number)| key(x, number));
        assert!(keys.is_sorted());
    }
}
