//! Segments in a grid of square cells. A place asks which segments the perpendicular through it meets.

use rayon::prelude::*;

use crate::fit::arc::grow;
use crate::fit::plane::{Vec2, dot, length, minus};

/// Steps per millimetre to which points are rounded.
pub const STEPS: f64 = 1024.0;

/// Most cells of a grid: beyond, they grow.
const MOST_CELLS: f64 = 4.0e6;

/// Cells for each segment: few segments need few cells.
const CELLS_EACH: f64 = 2.0;

/// More ink than this, 2 km, has no room on a page, and is not looked at.
const MOST_INK: f64 = 2.0e6;

/// Segments that are put into cells by one thread at a time.
const CHUNK: usize = 4096;

/// Half the width of what counts as the line itself, steps: nothing lies beside a place that is nearer.
const ON_LINE: f64 = 2.0;

/// A line runs alongside where its direction differs by at most 30 degrees: the squared sine. Crossings do not count.
const SINE_2: f64 = 0.25;

/// The box of no points.
pub const NOWHERE: [Vec2; 2] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];

/// The segment from a to b of a line; steps.
#[derive(Clone, Copy)]
pub struct Segment {
    pub a: Vec2,
    pub b: Vec2,
    pub line: u32,
}

impl Segment {
    pub fn way(&self) -> Vec2 {
        minus(&self.b, &self.a)
    }

    /// Places in the middle of equal pieces, each at most `step` long.
    pub fn places(&self, step: f64) -> impl Iterator<Item = Vec2> + use<> {
        let (a, way) = (self.a, self.way());
        let count = (length(&way) / step).ceil().max(1.0);
        (0..count as usize).map(move |k| [0, 1].map(|i| a[i] + way[i] * ((k as f64 + 0.5) / count)))
    }
}

/// A point of a drawing in whole steps.
pub fn rounded(p: &Vec2) -> Vec2 {
    p.map(|c| (c * STEPS).round_ties_even())
}

/// The length of all segments, each in whole steps.
pub fn ink(segments: &[Segment]) -> f64 {
    segments.iter().map(|s| length(&s.way()).round()).sum()
}

/// Whether there is so little ink that looking along all of it takes no time to speak of.
pub fn measurable(segments: &[Segment]) -> bool {
    // Points that are no numbers fail every comparison.
    ink(segments) <= MOST_INK * STEPS
}

pub struct Grid {
    /// Those of one line one after another.
    pub segments: Vec<Segment>,
    low: Vec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Where the members of each cell start.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Grid {
    /// reach: how far from a place will be looked mostly, steps.
    pub fn new(segments: Vec<Segment>, reach: f64) -> Grid {
        let mut around = NOWHERE;
        segments.iter().for_each(|s| [s.a, s.b].iter().for_each(|p| grow(&mut around, p)));
        let [low, high] = around;
        let size = if segments.is_empty() { [0.0; 2] } else { minus(&high, &low) };
        let most = (CELLS_EACH * segments.len() as f64).clamp(1.0, MOST_CELLS);
        let cell = reach.max((size[0] * size[1] / most).sqrt()).max(size[0].max(size[1]) / most);
        let [columns, rows] = size.map(|s| (s / cell) as usize + 1);
        let mut grid = Grid { segments, low, cell, columns, rows, starts: Vec::new(), members: Vec::new() };
        let touched: Vec<Vec<(u32, u32)>> = grid
            .segments
            .par_chunks(CHUNK)
            .enumerate()
            .map(|(chunk, some)| {
                let mut cells = Vec::with_capacity(4 * some.len());
                for (k, segment) in some.iter().enumerate() {
                    grid.each(segment, |cell| cells.push((cell as u32, (chunk * CHUNK + k) as u32)));
                }
                cells
            })
            .collect();
        let mut counts = vec![0u32; columns * rows + 1];
        touched.iter().flatten().for_each(|(cell, _)| counts[*cell as usize + 1] += 1);
        for i in 1..counts.len() {
            counts[i] += counts[i - 1];
        }
        let mut members = vec![0u32; counts[columns * rows] as usize];
        let mut next = counts.clone();
        for (cell, number) in touched.iter().flatten() {
            members[next[*cell as usize] as usize] = *number;
            next[*cell as usize] += 1;
        }
        (grid.starts, grid.members) = (counts, members);
        grid
    }

    /// Calls `add` with every cell that a segment touches, maybe more than once.
    fn each(&self, segment: &Segment, mut add: impl FnMut(usize)) {
        let way = segment.way();
        let pieces = (length(&way) / self.cell).ceil().max(1.0);
        let at = |k: f64| [0, 1].map(|i| segment.a[i] + way[i] * (k / pieces));
        for k in 0..pieces as usize {
            let (p, q) = (at(k as f64), at(k as f64 + 1.0));
            self.cells([0, 1].map(|i| p[i].min(q[i]) - 1.0), [0, 1].map(|i| p[i].max(q[i]) + 1.0), |cell| {
                add(cell);
                true
            });
        }
    }

    /// Calls `visit` with every cell of a rectangle, until it says false.
    fn cells(&self, low: Vec2, high: Vec2, mut visit: impl FnMut(usize) -> bool) {
        let column =
            |x: f64, i: usize, count: usize| (((x - self.low[i]) / self.cell).max(0.0) as usize).min(count - 1);
        let (x0, x1) = (column(low[0], 0, self.columns), column(high[0], 0, self.columns));
        for y in column(low[1], 1, self.rows)..=column(high[1], 1, self.rows) {
            if !(x0..=x1).all(|x| visit(y * self.columns + x)) {
                return;
            }
        }
    }

    fn members(&self, cell: usize) -> impl Iterator<Item = &Segment> {
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        self.members[range].iter().map(|&number| &self.segments[number as usize])
    }

    /// The segments of each line.
    pub fn lines(&self) -> Vec<&[Segment]> {
        self.segments.chunk_by(|a, b| a.line == b.line).collect()
    }

    /// Whether any segment may lie alongside segment `own` within `reach`, as `beside` would find at some place. All
    /// segments are looked through: that pays where a few are asked about many places.
    pub fn any_beside(&self, own: &Segment, reach: f64) -> bool {
        let way = own.way();
        let size = length(&way);
        let along = way.map(|c| c / size);
        let left = [-along[1], along[0]];
        self.segments.iter().any(|other| {
            let ends = [&other.a, &other.b].map(|p| minus(p, &own.a));
            let ([s, t], [p, q]) = (ends.map(|d| dot(&d, &along)), ends.map(|d| dot(&d, &left)));
            let on_line = p.abs().max(q.abs()) < ON_LINE - 1.0;
            let far = p.min(q) > reach + 1.0 || p.max(q) < -reach - 1.0;
            let beyond = s.max(t) < -1.0 || s.min(t) > size + 1.0;
            !(on_line || far || beyond) && alongside(&way, &other.way())
        })
    }

    /// Calls `visit` with the segments alongside that the perpendicular to segment `own` through `place` meets within
    /// `reach`: the distance, positive to the left, and the segment; until it says false. What meets the segment itself
    /// there is left out.
    pub fn beside(&self, own: &Segment, place: &Vec2, reach: f64, mut visit: impl FnMut(f64, &Segment) -> bool) {
        let way = own.way();
        let size = length(&way);
        let along = way.map(|c| c / size);
        let left = [-along[1], along[0]];
        // The box of the perpendicular, and a step more for what is rounded.
        let half = left.map(|c| c.abs() * reach + 1.0);
        self.cells(minus(place, &half), [place[0] + half[0], place[1] + half[1]], |cell| {
            for other in self.members(cell) {
                if alongside(&way, &other.way())
                    && let Some(offset) = met(other, place, &along, &left)
                    && (ON_LINE..=reach).contains(&offset.abs())
                    && !visit(offset, other)
                {
                    return false;
                }
            }
            true
        });
    }
}

fn alongside([ax, ay]: &Vec2, [bx, by]: &Vec2) -> bool {
    let cross = ax * by - ay * bx;
    cross * cross <= SINE_2 * (ax * ax + ay * ay) * (bx * bx + by * by)
}

/// How far to the left of a place a segment meets the perpendicular through it; None: it does not.
fn met(segment: &Segment, place: &Vec2, along: &Vec2, left: &Vec2) -> Option<f64> {
    let (p, q) = (minus(&segment.a, place), minus(&segment.b, place));
    let (before, after) = (dot(&p, along), dot(&q, along));
    if before.min(after) > 0.0 || before.max(after) < 0.0 {
        return None;
    }
    let (from, to) = (dot(&p, left), dot(&q, left));
    Some(from + (to - from) * (before / (before - after)))
}
