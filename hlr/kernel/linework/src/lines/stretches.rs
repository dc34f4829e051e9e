//! What stretch of a side of one line a side of another covers.

use super::gaps::{Side, Widths};
use super::owners::Order;

/// Sine of the angle beyond which two lines cross rather than coincide. It is large because the chords of a circle that
/// was divided in two ways differ in direction. Crossings at smaller angles are recognised by the length they cover.
pub(super) const PARALLEL: f64 = 0.5;

/// Widths of coincidence along a line, beyond which a side in the same direction as an earlier one does not merely follow
/// it: the line has run around.
const AROUND: f64 = 16.0;

/// A little more than one, for what is rounded.
const SURELY: f64 = 1.0 + 1e-6;

/// What side covers what stretch of which other one.
pub(super) struct Stretches<'a> {
    pub order: Order<'a>,
    pub widths: Widths,
    /// The larger of the widths, mm.
    pub reach: f64,
}

impl Stretches<'_> {
    /// Two sides as (worse, better); None where the one can never cover the other.
    pub fn order(&self, sides: &[Side], a: u32, b: u32) -> Option<(u32, u32)> {
        let (s, t) = (&sides[a as usize], &sides[b as usize]);
        if s.line == t.line {
            // A line that runs back over itself (a rim seen edge-on) is drawn once, and so is one that runs around over
            // itself (a thread seen along its axis): its earlier sides stay.
            let (earlier, later) = if s.start <= t.start { (s, t) } else { (t, s) };
            let way = later.start - earlier.start - earlier.length();
            let again = !same_way(s, t) || way >= AROUND * self.widths.same;
            return again.then_some((a.max(b), a.min(b)));
        }
        Some(if self.order.rank[s.line as usize] < self.order.rank[t.line as usize] { (b, a) } else { (a, b) })
    }

    /// The stretch of a worse side that a better one covers, as parameters on the worse.
    pub fn covered(&self, worse: &Side, better: &Side) -> Option<(f64, f64)> {
        let one = worse.visible == better.visible && !self.beside(worse, better);
        let width = if one { self.widths.same } else { self.widths.under };
        covered(worse, better, width, self.widths.same)
    }

    /// Whether one of two lines is a shallow intersection line, and the other a line of its parts.
    fn beside(&self, a: &Side, b: &Side) -> bool {
        let owners = |side: &Side| &self.order.owners[side.line as usize];
        a.line != b.line && (a.shallow || b.shallow) && owners(a).is_sunk_in(owners(b))
    }
}

/// Whether two sides run the same way, not back.
pub(super) fn same_way(s: &Side, t: &Side) -> bool {
    (s.to[0] - s.from[0]) * (t.to[0] - t.from[0]) + (s.to[1] - s.from[1]) * (t.to[1] - t.from[1]) >= 0.0
}

/// The stretch of `worse` within `width` beside `better` and `over` beyond its ends (mm), as parameters on `worse`.
///
/// ```text
///              _______________________          the width of a line covers lines beside it,
///   - - - - - |=======================|- - -    but not lines that continue beyond its end
///              ‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾
/// ```
pub(super) fn covered(worse: &Side, better: &Side, width: f64, over: f64) -> Option<(f64, f64)> {
    let (a, b, p, q) = (&worse.from, &worse.to, &better.from, &better.to);
    let (vx, vy) = (q[0] - p[0], q[1] - p[1]);
    let (ux, uy) = (b[0] - a[0], b[1] - a[1]);
    let (m2, l2, cross) = (vx * vx + vy * vy, ux * ux + uy * uy, vx * uy - vy * ux);
    if m2 == 0.0 || l2 == 0.0 || cross * cross > PARALLEL * PARALLEL * m2 * l2 {
        return None;
    }
    // Most lie on one side and farther away than the width: that is told without a root.
    let [before, after] = [a, b].map(|x| vx * (x[1] - p[1]) - vy * (x[0] - p[0]));
    let apart = if before > 0.0 { before.min(after) } else { -before.max(after) };
    if apart > 0.0 && apart * apart > SURELY * width * width * m2 {
        return None;
    }
    let m = m2.sqrt();
    let along = |x: &[f64; 2]| (vx * (x[0] - p[0]) + vy * (x[1] - p[1])) / m;
    let (mut u0, mut u1) = (0.0f64, 1.0f64);
    for (start, end, low, high) in [(before / m, after / m, -width, width), (along(a), along(b), -over, m + over)] {
        let slope = end - start;
        if slope == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let (s, t) = ((low - start) / slope, (high - start) / slope);
        u0 = u0.max(s.min(t));
        u1 = u1.min(s.max(t));
    }
    (u1 > u0).then_some((u0, u1))
}
