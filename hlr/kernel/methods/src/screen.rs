//! Facets on the screen, which `prepare` makes and every method starts from, and exact comparison of their depths.

use super::depth_grid::DepthGrid;
use super::patch::Patch;
use super::plane::{Plane, Point, centre};
use super::scene::Rule;
use super::statistics::Statistics;
use hlr_exact::wide::cmp_products;
use std::cmp::Ordering;
use std::ops::Range;

/// No facet: the background.
pub const NONE: u32 = u32::MAX;

/// Largest depth in steps that is reported: planes of polygons that are nearly edge-on lead farther.
pub const FAR: i128 = 1 << 52;

/// Two depths closer than this many steps are compared in integers. The floating-point error is less: below `STEEP`
/// steps each of its six operations is off by at most a quarter of a step.
pub const NEAR_TIE: f64 = 16.0;
/// Facets so steep that floating point might be off by more have no depth in floating point.
pub const STEEP: f64 = (1u64 << 51) as f64;
/// Floating-point error of a sum, as a share of its terms.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

/// A planar polygon on the screen.
#[derive(Clone, Debug)]
pub struct Facet {
    /// The polygon that the facet belongs to.
    pub id: u32,
    /// Its loops: range into `Screen::loops`.
    pub loops: Range<u32>,
    /// Its plane, with C > 0.
    pub plane: Plane,
    /// Pixels whose centres may lie inside: columns and rows, end exclusive, within the frame.
    pub columns: [i32; 2],
    pub rows: [i32; 2],
    /// Least and greatest depth.
    pub depth: [i64; 2],
    /// Depth in floating point: at pixel (columns[0], rows[0]), and per pixel right and down. NaN where it is steep.
    pub start: f64,
    pub right: f64,
    pub down: f64,
    /// Steps of depth by which rounding may have moved the plane: nearer depths are compared, whatever the painter's
    /// order.
    pub slack: f64,
    /// Number of its patch where it is curved; NONE where it is flat. A patch has no plane of its own.
    pub patch: u32,
}

impl Facet {
    /// A plane with C > 0 over columns and rows, for tests.
    #[cfg(test)]
    pub fn flat(plane: Plane, columns: [i32; 2], rows: [i32; 2]) -> Facet {
        let over = |n: i128| n as f64 / plane.c as f64;
        let start = over(plane.depth(centre(columns[0].into()), centre(rows[0].into())));
        use super::plane::STEPS;
        let (right, down) = (over(-plane.a) * STEPS as f64, over(-plane.b) * STEPS as f64);
        Facet { id: 0, loops: 0..0, plane, columns, rows, depth: [0, 0], start, right, down, slack: 0.0, patch: NONE }
    }

    /// Depth at a pixel's centre within `NEAR_TIE` / 2, or NaN. Not valid beyond `columns` and `rows`.
    #[inline(always)]
    pub fn depth_at(&self, column: i64, row: i64) -> f64 {
        self.start
            + self.right * (column - i64::from(self.columns[0])) as f64
            + self.down * (row - i64::from(self.rows[0])) as f64
    }
}

/// Facets in the order of their polygons: of two at the same depth the one with the lower number is in front.
pub struct Screen {
    pub width: i64,
    pub height: i64,
    pub rule: Rule,
    pub points: Vec<Point>,
    /// Per point: the value to interpolate, and 1 / w of the perspective; empty unless values were given.
    pub values: Vec<[f64; 4]>,
    /// Runs of `points`.
    pub loops: Vec<Range<u32>>,
    pub facets: Vec<Facet>,
    pub patches: Vec<Patch>,
    pub depths: DepthGrid,
}

impl Screen {
    pub fn loops_of<'a>(&'a self, facet: &'a Facet) -> impl Iterator<Item = &'a [Point]> + Clone {
        self.loops[facet.loops.start as usize..facet.loops.end as usize]
            .iter()
            .map(|l| &self.points[l.start as usize..l.end as usize])
    }

    /// The corners, as indices into `points`, at the ends of an edge of a facet; edges are numbered loop after loop.
    pub fn ends(&self, facet: u32, edge: u32) -> (usize, usize) {
        let facet = &self.facets[facet as usize];
        let mut number = edge;
        for l in &self.loops[facet.loops.start as usize..facet.loops.end as usize] {
            let count = l.end - l.start;
            if number < count {
                let next = if number + 1 == count { 0 } else { number + 1 };
                return ((l.start + number) as usize, (l.start + next) as usize);
            }
            number -= count;
        }
        unreachable!("a facet has no edge {edge}")
    }

    /// Order by depth, nearer first; at equal depth the lower facet. Exact: integers decide where floating point
    /// cannot.
    #[inline(always)]
    pub fn compare(&self, f: u32, g: u32, column: i64, row: i64, statistics: &mut Statistics) -> Ordering {
        let (a, b) = (&self.facets[f as usize], &self.facets[g as usize]);
        statistics.comparisons += 1;
        let difference = a.depth_at(column, row) - b.depth_at(column, row);
        if difference > NEAR_TIE {
            return Ordering::Greater;
        }
        if difference < -NEAR_TIE {
            return Ordering::Less;
        }
        self.compare_exactly(f, g, column, row, statistics)
    }

    #[cold]
    pub fn compare_exactly(&self, f: u32, g: u32, column: i64, row: i64, statistics: &mut Statistics) -> Ordering {
        statistics.exact += 1;
        let (a, b) = (&self.facets[f as usize], &self.facets[g as usize]);
        if self.patches.is_empty() {
            return a.plane.compare(&b.plane, centre(column), centre(row)).then(f.cmp(&g));
        }
        let ((n, c), (m, d)) = (self.fraction(a, column, row), self.fraction(b, column, row));
        cmp_products(n, d, m, c).then(f.cmp(&g))
    }

    /// The patch of a facet, if it is curved.
    #[inline(always)]
    pub fn patch_of(&self, facet: &Facet) -> Option<&Patch> {
        if facet.patch == NONE { None } else { Some(&self.patches[facet.patch as usize]) }
    }

    /// Depth at a pixel's centre: numerator and denominator.
    fn fraction(&self, facet: &Facet, column: i64, row: i64) -> (i128, i128) {
        match self.patch_of(facet) {
            Some(patch) => (patch.numerator(column, row), patch.over()),
            None => (facet.plane.depth(centre(column), centre(row)), facet.plane.c.into()),
        }
    }

    /// The same for the planes at any pixel of the frame, also beyond the facets: floating point decides where it can.
    pub fn compare_planes(&self, f: u32, g: u32, column: i64, row: i64) -> Ordering {
        let (a, b) = (&self.facets[f as usize], &self.facets[g as usize]);
        let terms = |f: &Facet| {
            let (x, y) = (column - i64::from(f.columns[0]), row - i64::from(f.rows[0]));
            [f.start, f.right * x as f64, f.down * y as f64]
        };
        let (za, zb) = (terms(a), terms(b));
        let unsure = NEAR_TIE + za.iter().chain(&zb).map(|t| t.abs()).sum::<f64>() * ROUNDING;
        let difference = za.iter().sum::<f64>() - zb.iter().sum::<f64>();
        if difference > unsure {
            return Ordering::Greater;
        }
        if difference < -unsure {
            return Ordering::Less;
        }
        a.plane.compare(&b.plane, centre(column), centre(row)).then(f.cmp(&g))
    }

    /// The first column after `from` at which `then` is in front of `first`, which is in front at `from`; i64::MAX
    /// where there is none in the row.
    pub fn takes_over(&self, first: u32, then: u32, from: i64, row: i64) -> i64 {
        let (p, q) = (&self.facets[first as usize], &self.facets[then as usize]);
        if !p.plane.falls_behind(&q.plane) {
            return i64::MAX;
        }
        let leads = |column: i64| self.compare_planes(then, first, column, row) == Ordering::Less;
        let (mut low, mut high) = (from, self.width);
        // The floating-point guess and the column before it are tried first; bisection does the rest.
        let guess = from as f64 + (q.depth_at(from, row) - p.depth_at(from, row)) / (p.right - q.right);
        let guess = if guess.is_finite() { (guess.ceil() as i64).clamp(from + 1, self.width) } else { from + 1 };
        for column in [guess, guess - 1, guess + 1] {
            if low < column && column < high {
                if leads(column) { high = column } else { low = column }
            }
        }
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if leads(middle) { high = middle } else { low = middle }
        }
        if high < self.width { high } else { i64::MAX }
    }

    /// Depth of a facet at a pixel's centre, in the units of the camera.
    pub fn true_depth(&self, f: u32, column: i64, row: i64) -> f64 {
        let (n, c) = self.fraction(&self.facets[f as usize], column, row);
        // Whole steps and the remainder separately: exact for whole numbers, otherwise correct to the last bits.
        let (whole, rest) = (n.div_euclid(c), n.rem_euclid(c));
        self.depths.depth(whole as f64 + rest as f64 / c as f64)
    }

    pub fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        bytes_of(&self.points) + bytes_of(&self.loops) + bytes_of(&self.facets)
    }
}
