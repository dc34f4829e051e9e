//! Triangulates loops without inner points, by a sweep from left to right.
//!
//! Each trapezoid between the chords above and below is cut by a diagonal from the point at its left end to the point
//! at its right end, unless both are on one chord. What remains is a mountain over each chord: a polygon between the
//! chord and a chain from its left end to its right end on its inner side. Each mountain is triangulated with a stack.
//! (A. Fournier, D. Montuno, "Triangulating simple polygons and equivalent problems", ACM ToG 3, 1984.)
//!
//! ```text
//!              .--------.
//!         .---'    |     '--.        No triangle reaches farther to the side than the chord whose mountain it is in:
//!        '-.       |     .---'       on a cylinder whose rulings are vertical here, the chords' error is the
//!           '------+----'            triangles' error.
//! ```
//!
//! All decisions are signs of exact determinants. The time is O(n log n), plus O(k) for each point with k chords above
//! it.

use super::outline::Outline;
use super::plane::{precedes, side};
use super::progress::Progress;

/// Triangles, counterclockwise. None where chords meet outside their ends, lie upon one another, or have no length; and
/// where loops touch, since two points of them are at one place.
pub fn triangulate(outline: &Outline, steps: &Progress) -> Option<Vec<[u32; 3]>> {
    let points = &outline.uv;
    let mut order = Vec::with_capacity(points.len());
    for i in outline.chords() {
        let [a, p, b] = [outline.before(i), i, outline.after(i)].map(|k| points[k as usize]);
        if a == p || b == p {
            return None;
        }
        let kind = match (precedes(&a, &p), precedes(&b, &p)) {
            (true, true) => Kind::End,
            (false, false) => Kind::Begin,
            _ => Kind::Pass,
        };
        order.push((p, kind, i));
    }
    order.sort_unstable_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])));
    if order.windows(2).any(|pair| pair[0].0 == pair[1].0) {
        return None;
    }
    let mut sweep = Sweep::new(outline);
    for (_, kind, i) in order {
        steps.step();
        match kind {
            Kind::Begin => sweep.begin(i)?,
            Kind::Pass => sweep.pass(i)?,
            Kind::End => sweep.end(i)?,
        }
    }
    sweep.active.is_empty().then_some(sweep.triangles)
}

#[derive(Clone, Copy)]
enum Kind {
    End,
    Pass,
    Begin,
}

const NONE: u32 = u32::MAX;

struct Sweep<'a> {
    outline: &'a Outline,
    /// Chords that cross the sweep line, from bottom to top. Those at even indices have the inside above them. A chord
    /// has the number of the point at which it begins in its loop.
    active: Vec<u32>,
    /// For each chord the last point of its mountain's chain.
    last: Vec<u32>,
    /// Points of chains, each with the point before it.
    chains: Vec<(u32, u32)>,
    triangles: Vec<[u32; 3]>,
}

impl<'a> Sweep<'a> {
    fn new(outline: &'a Outline) -> Sweep<'a> {
        let count = outline.uv.len();
        Sweep {
            outline,
            active: Vec::new(),
            last: vec![NONE; count],
            chains: Vec::with_capacity(3 * count),
            triangles: Vec::with_capacity(count),
        }
    }

    fn at(&self, point: u32) -> [f64; 2] {
        self.outline.uv[point as usize]
    }

    /// The left and the right end of a chord.
    fn ends(&self, chord: u32) -> (u32, u32) {
        let other = self.outline.after(chord);
        if precedes(&self.at(chord), &self.at(other)) { (chord, other) } else { (other, chord) }
    }

    /// Positive where the point is above the chord.
    fn above(&self, chord: u32, point: u32) -> f64 {
        let (left, right) = self.ends(chord);
        side(&self.at(left), &self.at(right), &self.at(point))
    }

    fn begin(&mut self, p: u32) -> Option<()> {
        let (a, b) = (self.outline.before(p), self.outline.after(p));
        let turn = side(&self.at(p), &self.at(a), &self.at(b));
        // The chord between `a` and p begins at `a`, so `a` is its number.
        let (low, high) = match turn {
            t if t > 0.0 => (a, p),
            t if t < 0.0 => (p, a),
            _ => return None,
        };
        let mut on_chord = false;
        let place = self.active.partition_point(|&chord| {
            let above = self.above(chord, p);
            on_chord |= above == 0.0;
            above > 0.0
        });
        if on_chord {
            return None;
        }
        if place % 2 == 1 {
            let (below, above) = self.around(place)?;
            self.push(below, p, true);
            self.push(above, p, false);
        }
        self.active.splice(place..place, [low, high]);
        self.open(low, p);
        self.open(high, p);
        Some(())
    }

    fn pass(&mut self, p: u32) -> Option<()> {
        let before = self.outline.before(p);
        let (old, new) = if precedes(&self.at(before), &self.at(p)) { (before, p) } else { (p, before) };
        let place = self.find(old, p)?;
        self.close(place, p)?;
        self.active[place] = new;
        self.open(new, p);
        Some(())
    }

    fn end(&mut self, p: u32) -> Option<()> {
        let (a, b) = (self.outline.before(p), p);
        let (one, other) = (self.find(a, p)?, self.find(b, p)?);
        let place = one.min(other);
        if one.abs_diff(other) != 1 {
            return None;
        }
        self.close(place, p)?;
        if place % 2 == 1 {
            self.close(place + 1, p)?;
        }
        self.active.drain(place..place + 2);
        Some(())
    }

    /// The index of a chord that ends at p among the active chords.
    fn find(&self, chord: u32, p: u32) -> Option<usize> {
        let from = self.active.partition_point(|&c| c != chord && self.above(c, p) > 0.0);
        let found = self.active[from..].iter().position(|&c| c == chord);
        found.map(|k| from + k).or_else(|| self.active.iter().position(|&c| c == chord))
    }

    /// The chords below and above an interval of the inside.
    fn around(&self, place: usize) -> Option<(u32, u32)> {
        Some((*self.active.get(place.checked_sub(1)?)?, *self.active.get(place)?))
    }

    /// Ends the trapezoid on the inner side of an active chord at p.
    fn close(&mut self, place: usize, p: u32) -> Option<()> {
        let (below, above) = self.around(place | 1)?;
        self.push(below, p, true);
        self.push(above, p, false);
        Some(())
    }

    fn open(&mut self, chord: u32, p: u32) {
        self.chains.push((p, NONE));
        self.last[chord as usize] = self.chains.len() as u32 - 1;
    }

    /// Adds a point to a chord's chain, and cuts off triangles where the chain bulges away from the chord.
    fn push(&mut self, chord: u32, p: u32, inside_above: bool) {
        let mut top = self.last[chord as usize];
        while let Some(&(b, below)) = self.chains.get(top as usize)
            && let Some(&(a, _)) = self.chains.get(below as usize)
        {
            let turn = side(&self.at(a), &self.at(b), &self.at(p));
            if inside_above && turn < 0.0 {
                self.triangles.push([a, p, b]);
            } else if !inside_above && turn > 0.0 {
                self.triangles.push([a, b, p]);
            } else {
                break;
            }
            top = below;
        }
        self.chains.push((p, top));
        self.last[chord as usize] = self.chains.len() as u32 - 1;
    }
}
