//! Area subdivision: an area that is too complicated is decided in its quarters.
//!
//! J. Warnock, "A hidden surface algorithm for computer generated halftone pictures", 1969.
//!
//! Relative to an area of the screen a polygon is
//!
//! ```text
//!    surrounding      intersecting      contained       disjoint
//!    +---------+         +---+
//!    | +-----+ |      +--+-+ |          +-----+         +-----+  +--+
//!    | |     | |      |  +-+-+          | +-+ |         |     |  |  |
//!    | +-----+ |      |    |            | +-+ |         |     |  +--+
//!    +---------+      +----+            +-----+         +-----+
//! ```
//!
//! An area is done where (a) all are disjoint, (b) one remains, intersecting or contained, (c) one remains,
//! surrounding, (d) a surrounding one is nearer than all others everywhere in the area. Otherwise each quarter inherits
//! the list without disjoint polygons and without those that a surrounding polygon hides; a single pixel is decided at
//! its centre. Polygons that pass through one another need no special case.
//!
//! The list is sorted by nearest depth, once, and so is every list that is inherited. It need not be read to its end:
//!
//! ```text
//!    z |          . d                 s surrounds, and is nowhere in the area farther than the line;
//!      |      c--.                    c and d begin behind that line, and so does all that follows
//!      |- - - - - - - - - - - - -     in the list: they are passed over unseen
//!      |   s-------------------s
//!      |       b----.
//!      +------------------------- x
//! ```

use super::canvas::{Canvas, Ending, Visit};
use super::coverage::{Scratch, owns, runs};
use super::limits::Watch;
use super::plane::{Point, centre};
use super::screen::{FAR, NONE, Screen};
use super::statistics::{Statistics, bytes_of};
use std::cmp::Ordering;

/// Columns and rows, end exclusive.
#[derive(Clone, Copy, Debug)]
struct Area {
    columns: [i32; 2],
    rows: [i32; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    Surrounding,
    Intersecting,
    Contained,
    Disjoint,
}

pub fn render(screen: &Screen, canvas: &mut Canvas, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
    let mut all: Vec<(u32, Relation)> = (0..screen.facets.len() as u32).map(|f| (f, Relation::Intersecting)).collect();
    all.sort_by_key(|&(f, _)| screen.facets[f as usize].depth[0]);
    let mut subdivision = Subdivision { screen, canvas, list: all, scratch: Scratch::default() };
    let whole = Area { columns: [0, screen.width as i32], rows: [0, screen.height as i32] };
    let end = subdivision.list.len();
    subdivision.area(whole, 0..end, 0, watch, statistics)
}

struct Subdivision<'a> {
    screen: &'a Screen,
    canvas: &'a mut Canvas,
    /// The lists of the current area and of all areas that enclose it, one after another.
    list: Vec<(u32, Relation)>,
    scratch: Scratch,
}

impl Subdivision<'_> {
    fn area(
        &mut self,
        area: Area,
        inherited: std::ops::Range<usize>,
        depth: usize,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        statistics.at_depth(depth);
        let start = self.list.len();
        let mut passed = 0;
        // The depth beyond which the surrounding polygons hide everything.
        let mut limit = i64::MAX;
        for k in inherited.clone() {
            if watch.over() {
                return None;
            }
            let (f, before) = self.list[k];
            if self.screen.facets[f as usize].depth[0] > limit {
                passed = inherited.end - k;
                statistics.early_stops += 1;
                statistics.passed_over += passed as u64;
                break;
            }
            let relation = match before {
                Relation::Surrounding => before,
                _ => relation(self.screen, f, area.columns, area.rows, statistics),
            };
            if relation == Relation::Surrounding {
                limit = limit.min(self.farthest(f, area));
            }
            if relation != Relation::Disjoint {
                self.list.push((f, relation));
            }
        }
        statistics.holds(bytes_of(&self.list) + self.canvas.bytes());
        let polygons = (self.list.len() - start) as u32;
        let (ending, facet) = self.decide(area, start, passed > 0, watch, statistics)?;
        let Area { columns, rows } = area;
        let passed = passed as u32;
        self.canvas.visited(|| Visit { columns, rows, level: depth as u32, polygons, passed, ending, facet });
        if ending == Ending::Quartered {
            let end = self.list.len();
            for quarter in quarters(area) {
                self.area(quarter, start..end, depth + 1, watch, statistics)?;
            }
        }
        self.list.truncate(start);
        Some(())
    }

    /// The farthest depth of a polygon's plane in an area, rounded up. It is at one of the corners, because a plane is
    /// monotonic along rows and along columns.
    fn farthest(&self, f: u32, area: Area) -> i64 {
        let plane = &self.screen.facets[f as usize].plane;
        let corner = |falls: bool, [low, high]: [i32; 2]| centre(i64::from(if falls { low } else { high - 1 }));
        let z = plane.depth(corner(plane.a > 0, area.columns), corner(plane.b > 0, area.rows));
        -(-z).div_euclid(plane.c.into()).clamp(-FAR, FAR) as i64
    }

    /// Cases (a) to (d), and the single pixel; and the polygon that is visible in all of the area or in part of it.
    /// `behind`: the list was not read to its end.
    fn decide(
        &mut self,
        area: Area,
        start: usize,
        behind: bool,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<(Ending, u32)> {
        let before = self.list.len();
        if let Some(front) = self.front(area, start, statistics) {
            // Polygons that the front one hides everywhere in the area are dropped.
            let mut kept = start;
            for k in start..self.list.len() {
                if watch.over() {
                    return None;
                }
                let other = self.list[k];
                if other.0 == front || !self.hides(front, other.0, area, statistics) {
                    self.list[kept] = other;
                    kept += 1;
                }
            }
            self.list.truncate(kept);
        }
        let hidden = behind || self.list.len() < before;
        Some(match self.list[start..] {
            [] => (Ending::Disjoint, NONE),
            [(f, Relation::Surrounding)] => {
                statistics.spans += (area.rows[1] - area.rows[0]) as u64;
                for row in area.rows[0]..area.rows[1] {
                    self.canvas.write(row.into(), area.columns[0].into(), area.columns[1].into(), f, statistics);
                }
                (if hidden { Ending::InFront } else { Ending::Surrounded }, f)
            }
            [(f, _)] => {
                let canvas = &mut *self.canvas;
                runs(self.screen, f, area.columns, area.rows, &mut self.scratch, |row, from, to| {
                    statistics.spans += 1;
                    canvas.write(row, from, to, f, statistics);
                    true
                });
                (Ending::Single, f)
            }
            _ if area.columns[1] - area.columns[0] == 1 && area.rows[1] - area.rows[0] == 1 => {
                let (column, row) = (i64::from(area.columns[0]), i64::from(area.rows[0]));
                // At a single centre a polygon either surrounds it or does not own it, unless an edge runs through it.
                let mut best = None;
                for &(f, relation) in &self.list[start..] {
                    let facet = &self.screen.facets[f as usize];
                    if relation != Relation::Surrounding && !owns(self.screen, facet, column, row) {
                        continue;
                    }
                    best = match best {
                        Some(b) if self.screen.compare(b, f, column, row, statistics) == Ordering::Less => Some(b),
                        _ => Some(f),
                    };
                }
                if let Some(f) = best {
                    statistics.spans += 1;
                    self.canvas.write(row, column, column + 1, f, statistics);
                }
                (Ending::Pixel, best.unwrap_or(NONE))
            }
            _ => (Ending::Quartered, NONE),
        })
    }

    /// The surrounding polygon that is nearest at the area's first corner.
    fn front(&self, area: Area, start: usize, statistics: &mut Statistics) -> Option<u32> {
        let surrounding = self.list[start..].iter().filter(|(_, r)| *r == Relation::Surrounding).map(|&(f, _)| f);
        let (column, row) = (i64::from(area.columns[0]), i64::from(area.rows[0]));
        surrounding
            .reduce(|a, b| if self.screen.compare(a, b, column, row, statistics) == Ordering::Less { a } else { b })
    }

    /// Whether the planes leave `front` before `other` at all four corners, and so everywhere.
    fn hides(&self, front: u32, other: u32, area: Area, statistics: &mut Statistics) -> bool {
        let [left, right] = [area.columns[0], area.columns[1] - 1].map(i64::from);
        let [top, bottom] = [area.rows[0], area.rows[1] - 1].map(i64::from);
        [(left, top), (right, top), (left, bottom), (right, bottom)].iter().all(|&(c, r)| {
            statistics.comparisons += 1;
            // The planes reach beyond their polygons here.
            self.screen.compare_planes(front, other, c, r) == Ordering::Less
        })
    }
}

/// The relation of a facet to an area of pixel centres; touching counts as intersecting.
pub fn relation(
    screen: &Screen,
    number: u32,
    columns: [i32; 2],
    rows: [i32; 2],
    statistics: &mut Statistics,
) -> Relation {
    statistics.box_tests += 1;
    let facet = &screen.facets[number as usize];
    let apart = |a: [i32; 2], b: [i32; 2]| a[1] <= b[0] || b[1] <= a[0];
    if apart(facet.columns, columns) || apart(facet.rows, rows) {
        return Relation::Disjoint;
    }
    let within = |a: [i32; 2], b: [i32; 2]| b[0] <= a[0] && a[1] <= b[1];
    // A box as large as the area may belong to a polygon that covers all of its centres: that one surrounds.
    if within(facet.columns, columns) && within(facet.rows, rows) && (facet.columns, facet.rows) != (columns, rows) {
        return Relation::Contained;
    }
    statistics.polygon_tests += 1;
    let low = [centre(columns[0].into()), centre(rows[0].into())];
    let high = [centre(i64::from(columns[1]) - 1), centre(i64::from(rows[1]) - 1)];
    for l in screen.loops_of(facet) {
        let mut p = &l[l.len() - 1];
        for q in l {
            if meets(p, q, low, high) {
                return Relation::Intersecting;
            }
            p = q;
        }
    }
    // No edge passes through the area: its first pixel decides for all.
    if owns(screen, facet, columns[0].into(), rows[0].into()) { Relation::Surrounding } else { Relation::Disjoint }
}

/// Whether a segment meets a closed rectangle.
fn meets(p: &Point, q: &Point, low: [i64; 2], high: [i64; 2]) -> bool {
    let ([px, py, _], [qx, qy, _]) = (*p, *q);
    if px.max(qx) < low[0] || px.min(qx) > high[0] || py.max(qy) < low[1] || py.min(qy) > high[1] {
        return false;
    }
    let side = |x: i64, y: i64| ((qx - px) * (y - py) - (qy - py) * (x - px)).signum();
    let sides = [side(low[0], low[1]), side(high[0], low[1]), side(low[0], high[1]), side(high[0], high[1])];
    !(sides.iter().all(|&s| s > 0) || sides.iter().all(|&s| s < 0))
}

/// The quarters of an area; of one that is a single row or column, its halves.
fn quarters(area: Area) -> impl Iterator<Item = Area> {
    let halves = |[low, high]: [i32; 2]| {
        let middle = low + (high - low + 1) / 2;
        [[low, middle], [middle, high]]
    };
    let (columns, rows) = (halves(area.columns), halves(area.rows));
    rows.into_iter()
        .flat_map(move |rows| columns.into_iter().map(move |columns| Area { columns, rows }))
        .filter(|a| a.columns[0] < a.columns[1] && a.rows[0] < a.rows[1])
}
