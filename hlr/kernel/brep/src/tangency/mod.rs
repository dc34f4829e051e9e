//! Decides where two faces are tangent along their common edge, from their true surfaces along the whole edge.
//!
//! The corners of an edge's polyline are too few samples: a straight edge has two, even where its free-form faces twist
//! along it. And a line must not come or go with the tessellation. So the surfaces at every edge of a free-form face
//! are compared at places of their own, close enough together to be sure:
//!
//! ```text
//! knots of the curve in (u, v)   |               |               |
//! knots of either surface          |    |    |      |    |    |
//! places compared                ........................... ...
//! ```
//!
//! Between two breaks the surfaces and the curve are smooth, and each span has several places. Where the faces are
//! tangent along one stretch and meet at an angle along another, the edge is divided into pieces, each with its own
//! class.
//!
//! Most edges need none of this: `clear_cases` decides them in closed form, or from a few places far from every limit.

mod clear_cases;
mod side;

use hlr_exact::elementary::sin;
use std::f64::consts::PI;

use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, length, sub};
use clear_cases::{clear_case, is_even};
pub use side::{Fixed, NEARLY_TANGENT, Side, TANGENT, angle};
use side::{ascending, crossed, divided, spans};

/// Radians. The angle between surfaces that were fitted to one another wavers about TANGENT along an edge. They count
/// as tangent if no angle exceeds WAVERING and the root mean square does not exceed MOSTLY_TANGENT.
const WAVERING: f64 = 0.02;
const MOSTLY_TANGENT: f64 = 0.008;
/// Least number of parts of an edge (STEPS), and of a span of its curves in (u, v) (STEPS_OF_SPAN), in which crossed
/// knots are sought. Every end of a part is a break.
const STEPS: usize = 16;
const STEPS_OF_SPAN: usize = 2;
/// Number of parts of an edge between elementary surfaces: their angle cannot oscillate between the places.
const STEPS_SIMPLE: usize = 3;
/// Number of parts of any other edge, for a first look.
const STEPS_AT_A_GLANCE: usize = 8;
/// Places between two breaks at which the faces are compared, as shares of the way. At a knot this compares either side
/// of it.
const PLACES: [f64; 3] = [1e-6, 0.5, 1.0 - 1e-6];
/// Limit on the breaks of one edge. Where surfaces have more knots across it, breaks are skipped evenly.
const MOST_BREAKS: usize = 1000;
/// Share of an edge's length: an angle along a shorter stretch is ignored. Where a face runs out to a point, the normal
/// of its surface is unreliable.
const SHORT_FOLD: f64 = 0.02;
/// Share of an edge's length. Where faces meet at an angle elsewhere, a shorter tangent stretch does not interrupt the
/// line, as where two pipes of the same diameter cross.
const LONG_REST: f64 = 0.1;
/// Bisections between two places, to find where a piece ends.
const HALVINGS: u32 = 24;

/// How two faces meet at an edge.
#[derive(Clone, Debug, PartialEq)]
pub enum Meeting {
    /// The surfaces give no answer.
    Unknown,
    Whole(bool),
    /// Whether each piece is smooth, and the shares of the edge's length at which the pieces join.
    Pieces(Vec<bool>, Vec<f64>),
}

/// How two faces meet at their common edge. `recorded`: a file or a modeller states that they are tangent there.
pub fn meeting(sides: &[Side; 2], recorded: bool) -> Meeting {
    if sides.iter().any(|s| s.curve.is_none() && !matches!(s.surface, Surface::Plane(_))) {
        return Meeting::Unknown;
    }
    let sides = &sides.each_ref().map(Fixed::new);
    if is_even(sides)
        && let Some(angle) = angle(sides, 0.5)
    {
        return Meeting::Whole(angle <= TANGENT || (angle <= NEARLY_TANGENT && recorded));
    }
    if sides.iter().any(|s| s.side.free) { free_meeting(sides, recorded) } else { plain_meeting(sides, recorded) }
}

/// How two elementary surfaces meet.
fn plain_meeting(sides: &[Fixed; 2], recorded: bool) -> Meeting {
    if !recorded && angle(sides, 0.5).is_some_and(|angle| angle > WAVERING) {
        return Meeting::Whole(false);
    }
    if let Some(smooth) = clear_case(sides, STEPS_SIMPLE) {
        return Meeting::Whole(smooth);
    }
    let (mut count, mut squares, mut least, mut most) = (0, 0.0, f64::INFINITY, 0.0f64);
    for angle in places(sides, false).into_iter().filter_map(|share| angle(sides, share)) {
        (least, most) = (least.min(angle), most.max(angle));
        (count, squares) = (count + 1, squares + sin(angle).powi(2));
        // The remaining places cannot change the answer.
        if most > WAVERING && (!recorded || least <= NEARLY_TANGENT) {
            return Meeting::Whole(recorded);
        }
    }
    if count == 0 {
        return Meeting::Unknown;
    }
    let wavers = most <= WAVERING && squares / f64::from(count) <= sin(MOSTLY_TANGENT).powi(2);
    Meeting::Whole(most <= TANGENT || (least <= NEARLY_TANGENT && (recorded || wavers)))
}

/// How two surfaces meet of which at least one is not elementary.
fn free_meeting(sides: &[Fixed; 2], recorded: bool) -> Meeting {
    if let Some(smooth) = clear_case(sides, STEPS_AT_A_GLANCE) {
        return Meeting::Whole(smooth);
    }
    let found: Vec<(f64, f64)> =
        places(sides, true).into_iter().filter_map(|share| Some((share, angle(sides, share)?))).collect();
    if found.is_empty() {
        return Meeting::Unknown;
    }
    if found.iter().all(|f| f.1 <= TANGENT) {
        return Meeting::Whole(true);
    }
    if found.iter().all(|f| f.1 > NEARLY_TANGENT) {
        return Meeting::Whole(false);
    }
    let at = if sides[0].side.curve.is_some() { &sides[0] } else { &sides[1] };
    let placed: Vec<_> = found.into_iter().map(|(share, angle)| (share, angle, at.side.point(share))).collect();
    pieces(&placed, recorded, &|share| angle(sides, share))
}

/// The largest angle between the two sides of a seam; None where it cannot be told.
pub fn worst(sides: &[Side; 2]) -> Option<f64> {
    let sides = &sides.each_ref().map(Fixed::new);
    let free = sides.iter().any(|s| s.side.free);
    let found = if is_even(sides) { angle(sides, 0.5) } else { None };
    found.or_else(|| places(sides, free).into_iter().filter_map(|share| angle(sides, share)).reduce(f64::max))
}

fn places(sides: &[Fixed; 2], free: bool) -> Vec<f64> {
    if sides.iter().all(|s| matches!(s.side.surface, Surface::Plane(_))) {
        return vec![0.5];
    }
    let spans = spans(sides);
    let parts = if free { STEPS.div_ceil(spans.len() - 1).max(STEPS_OF_SPAN) } else { STEPS_SIMPLE };
    let mut breaks = divided(&spans, parts);
    if free {
        breaks.extend(crossed(sides, &breaks));
        ascending(&mut breaks);
        let every = breaks.len() / MOST_BREAKS + 1;
        let last = breaks.len() - 1;
        let mut at = 0;
        breaks.retain(|_| {
            at += 1;
            at - 1 == last || (at - 1) % every == 0
        });
    }
    breaks.windows(2).flat_map(|w| PLACES.map(|p| w[0] + p * (w[1] - w[0]))).collect()
}

/// The pieces of one edge. `found`: shares of its length, each with the angle between the faces and the point there.
/// `closer`: the angle at any other share.
fn pieces(found: &[(f64, f64, Vector)], recorded: bool, closer: &dyn Fn(f64) -> Option<f64>) -> Meeting {
    let n = found.len();
    let mut long = vec![0.0; n];
    for i in 1..n {
        let half = 0.5 * length(&sub(&found[i].2, &found[i - 1].2));
        long[i - 1] += half;
        long[i] += half;
    }
    let total: f64 = long.iter().sum();
    long.iter_mut().for_each(|l| *l = if total > 0.0 { *l / total } else { 1.0 / n as f64 });
    let mut angle: Vec<f64> = found.iter().map(|f| f.1).collect();
    let of = |angle: &[f64], keep: &dyn Fn(usize) -> bool| -> f64 {
        (0..angle.len()).filter(|&i| keep(i)).map(|i| long[i]).sum()
    };
    if of(&angle, &|i| angle[i] <= TANGENT) >= LONG_REST {
        // Where the parameters of a surface run backwards for a stretch, its normal is reversed, and the angle is
        // ignored.
        angle.iter_mut().for_each(|a| *a = if *a > PI - NEARLY_TANGENT { 0.0 } else { *a });
    }
    let mut smooth: Vec<bool> = angle.iter().map(|a| *a <= TANGENT).collect();
    let sums = run_sums(&smooth, &long);
    let short: Vec<bool> = (0..n).map(|i| !smooth[i] && sums[i] < SHORT_FOLD).collect();
    if of(&angle, &|i| short[i]) < 2.0 * SHORT_FOLD {
        for i in (0..n).filter(|&i| short[i]) {
            (smooth[i], angle[i]) = (true, 0.0);
        }
    }
    // Where no angle is clear there are no pieces: the angle only wavers, and the whole edge is tangent or is not.
    let peaks = by_run(&smooth, &angle, 0.0, f64::max);
    let clear: Vec<bool> = (0..n).map(|i| !smooth[i] && peaks[i] > NEARLY_TANGENT).collect();
    if !clear.contains(&true) {
        let most = angle.iter().copied().fold(0.0, f64::max);
        let square: f64 = (0..n).map(|i| long[i] * angle[i] * angle[i]).sum();
        let wavering = most <= WAVERING && square.sqrt() <= MOSTLY_TANGENT;
        return Meeting::Whole(most <= TANGENT || wavering || recorded);
    }
    let sums = run_sums(&smooth, &long);
    for i in 0..n {
        smooth[i] &= sums[i] >= LONG_REST;
    }
    let changes: Vec<usize> = (1..n).filter(|&i| smooth[i] != smooth[i - 1]).collect();
    if changes.is_empty() {
        return Meeting::Whole(smooth[0]);
    }
    let mut kinds = vec![smooth[0]];
    let mut at = Vec::new();
    for i in changes {
        kinds.push(smooth[i]);
        let (mut low, mut high) = (found[i - 1].0, found[i].0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let same = closer(middle).is_some_and(|a| a <= TANGENT) == smooth[i - 1];
            if same { low = middle } else { high = middle }
        }
        at.push(0.5 * (low + high));
    }
    Meeting::Pieces(kinds, at)
}

fn run_sums(flag: &[bool], long: &[f64]) -> Vec<f64> {
    by_run(flag, long, 0.0, |a, b| a + b)
}

/// For each place the values of its run of equal flags, joined.
fn by_run(flag: &[bool], values: &[f64], zero: f64, join: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(flag.len());
    for run in flag.chunk_by(|a, b| a == b) {
        let here = &values[out.len()..out.len() + run.len()];
        let all = here.iter().fold(zero, |a, b| join(a, *b));
        out.extend(std::iter::repeat_n(all, run.len()));
    }
    out
}

#[cfg(test)]
mod tests;
