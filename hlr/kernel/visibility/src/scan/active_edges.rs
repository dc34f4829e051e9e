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
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::crossing;

pub struct Crossings<P> {
    pub events: Vec<Vec<Event<P>>>,
    pub tests: u64,
    pub bands: usize,
}

#[derive(Clone, Copy)]
struct Entry {
    xmin: i32,
    xmax: i32,
    ymin: i32,
    ymax: i32,
    /// Contours: nearest depth. Drawn edges: farthest depth.
    z: i32,
    item: u32,
}

pub fn crossings<A: Arithmetic>(
    mesh: &Mesh,
    drawn: &[u32],
    contours: &[Contour],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Crossings<A::Parameter> {
    let range = |e: u32| {
        let (a, b) = mesh.ends(e as usize);
        y_range(a, b)
    };
    // Contours first, then drawn edges: one edge table for both.
    let ranges: Vec<(i32, i32)> =
        contours.par_iter().map(|c| range(c.edge)).chain(drawn.par_iter().map(|&e| range(e))).collect();
    let bands = Bands::choose(&ranges, 0.75);
    let (offsets, items) = bands.bucket(&ranges);
    let first_drawn = contours.len() as u32;
    let found: Vec<(Vec<Event<A::Parameter>>, u64)> = (0..bands.count)
        .into_par_iter()
        .map(|k| {
            let bucket = &items[offsets[k] as usize..offsets[k + 1] as usize];
            let split = bucket.partition_point(|&i| i < first_drawn);
            if split == 0 || split == bucket.len() || stopped() {
                return (Vec::new(), 0);
            }
            let (y0, y1) = bands.limits(k);
            let entry = |e: u32, item: u32, near: bool| {
                let (a, b) = mesh.ends(e as usize);
                let (xmin, xmax) = clipped_x(a, b, y0, y1);
                let (ymin, ymax) = y_range(a, b);
                let z = if near { a[2].min(b[2]) } else { a[2].max(b[2]) };
                Entry { xmin, xmax, ymin, ymax, z, item }
            };
            let by_x = |e: &Entry| (e.xmin, e.item);
            let mut cs: Vec<Entry> =
                bucket[..split].iter().map(|&i| entry(contours[i as usize].edge, i, true)).collect();
            let mut fs: Vec<Entry> =
                bucket[split..].iter().map(|&i| i - first_drawn).map(|i| entry(drawn[i as usize], i, false)).collect();
            cs.sort_unstable_by_key(by_x);
            fs.sort_unstable_by_key(by_x);
            Sweep::<A> { mesh, drawn, contours, bands: &bands, band: k, events: Vec::new(), tests: 0 }.run(&cs, &fs)
        })
        .collect();
    let tests = found.iter().map(|f| f.1).sum();
    Crossings { events: found.into_iter().map(|f| f.0).collect(), tests, bands: bands.count }
}

struct Sweep<'a, A: Arithmetic> {
    mesh: &'a Mesh<'a>,
    drawn: &'a [u32],
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
        let contour = &self.contours[c.item as usize];
        let drawn = self.drawn[f.item as usize] as usize;
        let (a, b) = self.mesh.ends(drawn);
        let (p, q) = self.mesh.ends(contour.edge as usize);
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
        let delta = self.mesh.delta(self.mesh.edge_group[drawn], self.mesh.edge_group[contour.edge as usize]);
        let jump = contour.jump * hit.to_left;
        self.events.push(Event {
            drawn: f.item,
            at: A::crossing(hit.n, hit.d),
            plain: jump,
            moved: if hit.beneath > A::depth(delta) * A::raise(hit.d) { jump } else { 0 },
        });
    }
}
