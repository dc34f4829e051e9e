//! Depth sort, the painter's algorithm: far polygons first, near ones over them.
//!
//! M. Newell, R. Newell, T. Sancha, "A solution to the hidden surface problem", 1972.
//!
//! The list is sorted by the farthest depth. Its farthest, P, may be drawn when each Q whose depths overlap those of P
//! passes one of five tests:
//!
//! 1. the x extents are disjoint
//! 2. the y extents are disjoint
//! 3. P is wholly on the far side of Q's plane
//! 4. Q is wholly on the near side of P's plane
//! 5. the projections are disjoint
//!
//! Otherwise 3 and 4 are tried with P and Q swapped, and Q is the new P, which is tested against all that overlap *it*.
//! A polygon is moved up only once and then marked: a marked one met again means a cycle. Then one is split by the
//! plane of the other,
//!
//! ```text
//!      P\   /Q         P is cut where the plane of Q passes through it;
//!        \ /           both parts re-enter the list by their own farthest depth
//!         X
//!        / \
//! ```
//!
//! In a cycle of polygons in which each pair lies on one side of each other, the plane of some polygon cuts another
//! one: otherwise that plane would order them.
//!
//! The result is a list of polygons in drawing order, suited for a filled vector drawing.

use super::canvas::Canvas;
use super::limits::Watch;
use super::pieces::{Half, Painter};
use super::plane::{STEPS, first_centre};
use super::screen::Screen;
use super::statistics::Statistics;
use super::stopwatch::Stopwatch;

/// A facet, or the part of it that cuts have left. Corners in 256ths of a pixel and steps of depth.
#[derive(Clone, Debug)]
pub struct Piece {
    pub facet: u32,
    pub loops: Vec<Vec<[f64; 3]>>,
    pub halves: Vec<Half>,
    columns: [i32; 2],
    rows: [i32; 2],
    near: f64,
    far: f64,
}

/// A facet's plane as depth over the image: one of its corners, and the change of depth per step right and down.
struct Slope {
    corner: [f64; 3],
    right: f64,
    down: f64,
    slack: f64,
}

impl Slope {
    /// How far a point is behind the plane.
    fn beyond(&self, p: &[f64; 3]) -> f64 {
        let c = &self.corner;
        (p[2] - c[2]) - (self.right * (p[0] - c[0]) + self.down * (p[1] - c[1]))
    }
}

pub fn render(screen: &Screen, canvas: &mut Canvas, watch: &Watch, statistics: &mut Statistics) -> Option<()> {
    let started = Stopwatch::start();
    let ordered = order(screen, watch, statistics)?;
    statistics.setup = started.seconds();
    let bytes: usize = ordered.pieces.iter().map(Piece::bytes).sum();
    statistics.holds(bytes + ordered.wary.len() + canvas.bytes());
    let mut painter = Painter::new(screen, canvas, &ordered.wary, false);
    for piece in &ordered.pieces {
        painter.paint(piece.facet, &piece.halves, watch, statistics)?;
    }
    Some(())
}

/// Pieces in drawing order, and the facets whose place in it could not be found.
pub struct Ordered {
    pub pieces: Vec<Piece>,
    pub wary: Vec<bool>,
}

/// Finds the drawing order; None where time ran out.
pub fn order(screen: &Screen, watch: &Watch, statistics: &mut Statistics) -> Option<Ordered> {
    let mut sort = Sort::new(screen);
    let mut out = Ordered { pieces: Vec::with_capacity(sort.pieces.len()), wary: vec![false; screen.facets.len()] };
    while let Some(&last) = sort.list.last() {
        let next = sort.next(last, &mut out.wary, watch, statistics)?;
        sort.list.remove(sort.place(next));
        out.pieces.push(std::mem::replace(&mut sort.pieces[next as usize], Piece::gone()));
    }
    Some(out)
}

struct Sort<'a> {
    screen: &'a Screen,
    slopes: Vec<Slope>,
    pieces: Vec<Piece>,
    /// Pieces by farthest depth, the farthest at the end.
    list: Vec<u32>,
}

impl Sort<'_> {
    fn new(screen: &Screen) -> Sort<'_> {
        let slopes = screen.facets.iter().map(|f| {
            let corner = screen.points[screen.loops[f.loops.start as usize].start as usize];
            // The depth of the plane there, in case the corners lie in no plane.
            let z = f.plane.depth(corner[0], corner[1]) as f64 / f.plane.c as f64;
            let per = |a: i128| -(a as f64) / f.plane.c as f64;
            let corner = [corner[0] as f64, corner[1] as f64, z];
            Slope { corner, right: per(f.plane.a), down: per(f.plane.b), slack: f.slack }
        });
        let slopes: Vec<_> = slopes.collect();
        let pieces: Vec<Piece> = (0..screen.facets.len() as u32).map(|f| Piece::whole(screen, f)).collect();
        let mut list: Vec<u32> = (0..pieces.len() as u32).collect();
        list.sort_by(|&p, &q| pieces[p as usize].key(p).partial_cmp(&pieces[q as usize].key(q)).unwrap());
        Sort { screen, slopes, pieces, list }
    }

    /// The next piece that may be drawn. Starts with the farthest; splits pieces that overlap in a cycle.
    fn next(&mut self, farthest: u32, wary: &mut [bool], watch: &Watch, statistics: &mut Statistics) -> Option<u32> {
        let mut marked: Vec<u32> = Vec::new();
        let mut p = farthest;
        'candidate: loop {
            let near = self.pieces[p as usize].near;
            let mut k = self.list.len();
            while k > 0 {
                k -= 1;
                if watch.over() {
                    return None;
                }
                let q = self.list[k];
                if self.pieces[q as usize].far <= near {
                    break;
                }
                if q == p || self.may_precede(p, q, statistics) {
                    continue;
                }
                let swapped = self.beyond(q, p, statistics) || self.before(p, q, statistics);
                if swapped && !marked.contains(&q) {
                    statistics.swaps += 1;
                    marked.push(q);
                    p = q;
                    continue 'candidate;
                }
                if !self.split_some(p, q, &marked, statistics) {
                    // Because of rounding no plane separates them. Their pixels will be compared one by one.
                    wary[self.pieces[p as usize].facet as usize] = true;
                    wary[self.pieces[q as usize].facet as usize] = true;
                    continue;
                }
                marked.clear();
                p = *self.list.last()?;
                continue 'candidate;
            }
            return Some(p);
        }
    }

    /// Tests 1 to 5: whether P may be drawn before Q.
    fn may_precede(&self, p: u32, q: u32, statistics: &mut Statistics) -> bool {
        let (a, b) = (&self.pieces[p as usize], &self.pieces[q as usize]);
        let apart = |a: [i32; 2], b: [i32; 2]| a[1] <= b[0] || b[1] <= a[0];
        statistics.box_tests += 1;
        apart(a.columns, b.columns)
            || apart(a.rows, b.rows)
            || self.beyond(p, q, statistics)
            || self.before(q, p, statistics)
            || disjoint(&a.loops, &b.loops)
    }

    /// Test 3: P is wholly on the far side of Q's plane, up to rounding.
    fn beyond(&self, p: u32, q: u32, statistics: &mut Statistics) -> bool {
        self.side(p, q, statistics).0 >= -self.unsure(p, q)
    }

    /// Test 4: Q is wholly on the near side of P's plane.
    fn before(&self, q: u32, p: u32, statistics: &mut Statistics) -> bool {
        self.side(q, p, statistics).1 <= self.unsure(p, q)
    }

    /// Least and greatest depth of a piece's corners behind the plane of another.
    fn side(&self, piece: u32, of: u32, statistics: &mut Statistics) -> (f64, f64) {
        statistics.comparisons += 1;
        let slope = &self.slopes[self.pieces[of as usize].facet as usize];
        let behind = self.pieces[piece as usize].loops.iter().flatten().map(|p| slope.beyond(p));
        behind.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)))
    }

    /// Half of the window of depth in which the painter compares pixels.
    fn unsure(&self, p: u32, q: u32) -> f64 {
        let slack = |piece: u32| self.slopes[self.pieces[piece as usize].facet as usize].slack;
        0.5 * (slack(p) + slack(q))
    }

    /// Splits P or Q by the plane of the other; where neither passes through the other, by the plane of a marked piece.
    fn split_some(&mut self, p: u32, q: u32, marked: &[u32], statistics: &mut Statistics) -> bool {
        if self.split(p, q, statistics) || self.split(q, p, statistics) {
            return true;
        }
        let cycle: Vec<u32> = [p, q].into_iter().chain(marked.iter().copied()).collect();
        cycle.iter().any(|&piece| cycle.iter().any(|&by| piece != by && self.split(piece, by, statistics)))
    }

    fn split(&mut self, piece: u32, by: u32, statistics: &mut Statistics) -> bool {
        let (low, high) = self.side(piece, by, statistics);
        let unsure = self.unsure(piece, by);
        if low >= -unsure || high <= unsure {
            return false;
        }
        statistics.splits += 1;
        let at = self.place(piece);
        self.list.remove(at);
        let whole = std::mem::replace(&mut self.pieces[piece as usize], Piece::gone());
        let (own, its) = (&self.slopes[whole.facet as usize], &self.slopes[self.pieces[by as usize].facet as usize]);
        let line = meeting(own, its);
        for positive in [true, false] {
            let sign = if positive { 1.0 } else { -1.0 };
            let loops = whole.loops.iter().map(|l| clip(l, |p| sign * its.beyond(p))).filter(|l| l.len() > 2).collect();
            let mut halves = whole.halves.clone();
            halves.push(Half { line, positive });
            let part = Piece::new(self.screen, whole.facet, loops, halves);
            if part.loops.is_empty() || part.columns[0] >= part.columns[1] || part.rows[0] >= part.rows[1] {
                continue;
            }
            let number = self.pieces.len() as u32;
            let key = part.key(number);
            self.pieces.push(part);
            let at = self.list.partition_point(|&q| self.pieces[q as usize].key(q) < key);
            self.list.insert(at, number);
        }
        true
    }

    fn place(&self, piece: u32) -> usize {
        let key = self.pieces[piece as usize].key(piece);
        self.list.partition_point(|&q| self.pieces[q as usize].key(q) < key)
    }
}

impl Piece {
    fn new(screen: &Screen, facet: u32, loops: Vec<Vec<[f64; 3]>>, halves: Vec<Half>) -> Piece {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in loops.iter().flatten() {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        // A cut may be slightly off: the piece is wider by a pixel on each side, which does no harm.
        let wider = if halves.is_empty() { 0 } else { STEPS };
        let whole = &screen.facets[facet as usize];
        let range = |k: usize, whole: [i32; 2]| {
            let from = first_centre(low[k].floor() as i64 - wider).max(whole[0]);
            let to = first_centre(high[k].ceil() as i64 + wider).min(whole[1]);
            [from, to]
        };
        let (columns, rows) = (range(0, whole.columns), range(1, whole.rows));
        Piece { facet, loops, halves, columns, rows, near: low[2], far: high[2] }
    }

    fn whole(screen: &Screen, number: u32) -> Piece {
        let facet = &screen.facets[number as usize];
        let loops = screen.loops_of(facet).map(|l| l.iter().map(|p| p.map(|c| c as f64)).collect()).collect();
        let mut piece = Piece::new(screen, number, loops, Vec::new());
        (piece.near, piece.far) = (facet.depth[0] as f64, facet.depth[1] as f64);
        piece
    }

    fn gone() -> Piece {
        Piece { facet: 0, loops: Vec::new(), halves: Vec::new(), columns: [0; 2], rows: [0; 2], near: 0.0, far: 0.0 }
    }

    /// Sort key; of equally far pieces the one with the higher id is drawn first.
    fn key(&self, number: u32) -> (f64, u32, u32) {
        (self.far, self.facet, number)
    }

    fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        size_of::<Piece>() + bytes_of(&self.halves) + self.loops.iter().map(|l| bytes_of(l) + 24).sum::<usize>()
    }
}

/// The line in which two planes meet, in columns and rows; positive where `own` is farther.
fn meeting(own: &Slope, its: &Slope) -> [f64; 3] {
    let (a, b) = (own.right - its.right, own.down - its.down);
    // Computed around a corner of the piece, where the difference is small.
    let c = own.corner;
    let there = its.beyond(&c);
    let half = STEPS as f64 / 2.0;
    [a * STEPS as f64, b * STEPS as f64, there + a * (half - c[0]) + b * (half - c[1])]
}

/// Clips one loop to where `height` is not negative (Sutherland, Hodgman).
pub fn clip(corners: &[[f64; 3]], height: impl Fn(&[f64; 3]) -> f64) -> Vec<[f64; 3]> {
    let mut out = Vec::with_capacity(corners.len() + 2);
    let Some(mut p) = corners.last() else { return out };
    let mut hp = height(p);
    for q in corners {
        let hq = height(q);
        if (hp >= 0.0) != (hq >= 0.0) {
            let t = hp / (hp - hq);
            out.push(std::array::from_fn(|k| p[k] + (q[k] - p[k]) * t));
        }
        if hq >= 0.0 {
            out.push(*q);
        }
        (p, hp) = (q, hq);
    }
    out
}

/// Test 5: the projections share no area. False where that is in doubt.
fn disjoint(a: &[Vec<[f64; 3]>], b: &[Vec<[f64; 3]>]) -> bool {
    if separated(a, b) || separated(b, a) {
        return true;
    }
    let convex = |l: &[Vec<[f64; 3]>]| l.len() == 1 && l[0].len() == 3;
    if convex(a) && convex(b) {
        return false;
    }
    let crossing = edges(a).any(|(p, q)| {
        edges(b).any(|(r, s)| turn(p, q, r) * turn(p, q, s) < 0.0 && turn(r, s, p) * turn(r, s, q) < 0.0)
    });
    !crossing && !a.iter().flatten().any(|p| touches(p, b)) && !b.iter().flatten().any(|p| touches(p, a))
}

fn turn(p: &[f64; 3], q: &[f64; 3], r: &[f64; 3]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

fn edges(loops: &[Vec<[f64; 3]>]) -> impl Iterator<Item = (&[f64; 3], &[f64; 3])> {
    loops.iter().flat_map(|l| (0..l.len()).map(move |i| (&l[i], &l[if i + 1 == l.len() { 0 } else { i + 1 }])))
}

/// Whether the line through an edge of `a` has all of `a` on one side and all of `b` on the other.
fn separated(a: &[Vec<[f64; 3]>], b: &[Vec<[f64; 3]>]) -> bool {
    edges(a).any(|(p, q)| {
        let range = |loops: &[Vec<[f64; 3]>]| {
            let sides = loops.iter().flatten().map(|r| turn(p, q, r));
            sides.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)))
        };
        let (own, its) = (range(a), range(b));
        (own.0 >= 0.0 && its.1 <= 0.0 && own.1 > 0.0) || (own.1 <= 0.0 && its.0 >= 0.0 && own.0 < 0.0)
    })
}

/// Whether a point is on the loops or inside by the even-odd or the non-zero rule: what is inside by the former is so
/// by the latter.
fn touches(v: &[f64; 3], loops: &[Vec<[f64; 3]>]) -> bool {
    let mut winding = 0;
    for (p, q) in edges(loops) {
        let side = turn(p, q, v);
        let within = |k: usize| p[k].min(q[k]) <= v[k] && v[k] <= p[k].max(q[k]);
        if side == 0.0 && within(0) && within(1) {
            return true;
        }
        match (p[1] <= v[1], q[1] <= v[1]) {
            (true, false) if side > 0.0 => winding += 1,
            (false, true) if side < 0.0 => winding -= 1,
            _ => {}
        }
    }
    winding != 0
}
