//! Simplifies each border to straight runs; its corners are the points where these meet.
//!
//! The algorithm of D. H. Douglas, T. K. Peucker, "Algorithms for the reduction of the number of points required to
//! represent a digitized line", Cartographica 10, 1973, finds which points belong to one run. The line of a run is
//! fitted to its points by least squares. A corner is where two of these lines meet; a node is where the lines of all
//! borders that end there meet. So corners between the points of the grid are as exact as the runs.

use hlr_exact::elementary::{atan2, cos, hypot, sin};
use std::collections::BTreeMap;

use rayon::prelude::*;

use super::chains::Chain;
use super::crossing::Crossing;

/// Pixels: the greatest distance of a border from its points, where these are exact, and where they are only the
/// grid's.
const OFF: [f64; 2] = [0.3, 1.0];
/// Pixels: the greatest distance of a corner from its points.
const NEAR: f64 = 1.6;
/// Sine of the least angle at which two lines meet.
const ANGLE: f64 = 0.05;

type Point = [f64; 2];

#[derive(Clone, Copy, Debug)]
struct Line {
    at: Point,
    way: Point,
    /// Whether its points are exact and lie on it.
    exact: bool,
}

/// A border between two corners of the grid, or a closed one.
struct Runs {
    points: Vec<Point>,
    /// First and last point of each run.
    ranges: Vec<[usize; 2]>,
    lines: Vec<Line>,
}

/// Corners per chain; those of an open one run from node to node. None when stopped.
pub fn borders(
    chains: &[Chain],
    at: &Crossing,
    size: [usize; 2],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Vec<Point>>> {
    let runs: Vec<Runs> =
        chains.par_iter().map(|c| if stopped() { runs_of(&[], false) } else { runs(c, at) }).collect();
    let mut nodes: BTreeMap<u32, Vec<Line>> = BTreeMap::new();
    for (chain, runs) in chains.iter().zip(&runs) {
        if let Some([a, b]) = chain.ends {
            let own = [(a, runs.lines.first()), (b, runs.lines.last())];
            for (node, line) in own {
                nodes.entry(node).or_default().extend(line);
            }
        }
    }
    let nodes: BTreeMap<u32, Point> = nodes.into_iter().map(|(n, lines)| (n, meeting(n, &lines, size))).collect();
    let out = chains.par_iter().zip(&runs).map(|(chain, runs)| match chain.ends {
        Some(ends) => {
            let mut out = vec![nodes[&ends[0]]];
            out.extend((1..runs.lines.len()).map(|k| corner(runs, k - 1, k)));
            out.push(nodes[&ends[1]]);
            out
        }
        None => (0..runs.lines.len()).map(|k| corner(runs, (k + runs.lines.len() - 1) % runs.lines.len(), k)).collect(),
    });
    let out = out.collect();
    (!stopped()).then_some(out)
}

fn runs(chain: &Chain, at: &Crossing) -> Runs {
    let found: Vec<(Point, bool)> = chain.cracks.iter().map(|c| at.find(c)).collect();
    // Near a corner a third face may lie between two points: points without an exact place are left out there.
    let known = found.iter().filter(|f| f.1).count();
    let exact = known > 2 && known + 2.max(found.len() / 10) >= found.len();
    let mut points: Vec<Point> = found.into_iter().filter(|f| f.1 || !exact).map(|f| f.0).collect();
    if chain.ends.is_none() {
        // Begins at the point farthest out: a corner, if there is one.
        let n = points.len() as f64;
        let middle = points.iter().fold([0.0; 2], |s, p| [s[0] + p[0] / n, s[1] + p[1] / n]);
        let far = (0..points.len()).max_by(|&a, &b| apart(points[a], middle).total_cmp(&apart(points[b], middle)));
        points.rotate_left(far.unwrap_or(0));
        points.push(points[0]);
    }
    let mut out = runs_of(&points, exact);
    out.points = points;
    out
}

fn runs_of(points: &[Point], exact: bool) -> Runs {
    let mut ranges = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        let mut kept = vec![0, last];
        let mut open = vec![[0, last]];
        while let Some([a, b]) = open.pop() {
            let far = (a + 1..b).map(|k| (beside(points[a], points[b], points[k]), k));
            let worst = far.fold((OFF[usize::from(!exact)], 0), |w, f| if f.0 > w.0 { f } else { w });
            if worst.1 > 0 {
                kept.push(worst.1);
                open.extend([[a, worst.1], [worst.1, b]]);
            }
        }
        kept.sort_unstable();
        kept.dedup();
        ranges = kept.windows(2).map(|w| [w[0], w[1]]).collect();
        if ranges.is_empty() {
            ranges.push([0, 0]);
        }
        // A single step around a corner, from one run to the next, is not a run.
        let short = |r: &[usize; 2]| r[1] - r[0] <= 1 || apart(points[r[0]], points[r[1]]) < 1.5;
        let inner = ranges.len().saturating_sub(1);
        let kept: Vec<bool> = (0..ranges.len())
            .map(|k| {
                let between = k > 0 && k < inner && !short(&ranges[k - 1]) && !short(&ranges[k + 1]);
                !(between && short(&ranges[k]))
            })
            .collect();
        let mut keep = kept.iter();
        ranges.retain(|_| *keep.next().unwrap_or(&true));
    }
    let lines = ranges.iter().map(|r| fitted(&points[r[0]..=r[1]], exact)).collect();
    Runs { points: Vec::new(), ranges, lines }
}

/// The line that fits the points best.
fn fitted(points: &[Point], exact: bool) -> Line {
    // The ends of a run may already lie around the corner.
    let inner = if points.len() > 4 { &points[1..points.len() - 1] } else { points };
    let n = inner.len() as f64;
    let at = inner.iter().fold([0.0; 2], |s, p| [s[0] + p[0] / n, s[1] + p[1] / n]);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in inner {
        let (x, y) = (p[0] - at[0], p[1] - at[1]);
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    let angle = 0.5 * atan2(2.0 * xy, xx - yy);
    Line { at, way: [cos(angle), sin(angle)], exact: exact && inner.len() > 2 }
}

/// The corner between two runs.
fn corner(runs: &Runs, one: usize, two: usize) -> Point {
    let (end, start) = (runs.points[runs.ranges[one][1]], runs.points[runs.ranges[two][0]]);
    let between = [0.5 * (end[0] + start[0]), 0.5 * (end[1] + start[1])];
    let (a, b) = (&runs.lines[one], &runs.lines[two]);
    let turn = a.way[0] * b.way[1] - a.way[1] * b.way[0];
    if turn.abs() < ANGLE {
        return between;
    }
    let off = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
    let t = (off[0] * b.way[1] - off[1] * b.way[0]) / turn;
    let found = [a.at[0] + t * a.way[0], a.at[1] + t * a.way[1]];
    if apart(found, between) <= NEAR { found } else { between }
}

/// The place nearest to all lines that end at a node, near the node's place on the grid.
fn meeting(node: u32, lines: &[Line], size: [usize; 2]) -> Point {
    let wide = size[0] as u32 + 1;
    let corner = [f64::from(node % wide), f64::from(node / wide)];
    // A weak pull toward the node's place on the grid decides where all lines are parallel.
    let (mut xx, mut xy, mut yy, mut x, mut y) = (1e-6, 0.0, 1e-6, 0.0, 0.0);
    for line in lines {
        let weight = if line.exact { 1.0 } else { 1e-3 };
        let n = [-line.way[1], line.way[0]];
        let off = n[0] * (line.at[0] - corner[0]) + n[1] * (line.at[1] - corner[1]);
        xx += weight * n[0] * n[0];
        xy += weight * n[0] * n[1];
        yy += weight * n[1] * n[1];
        x += weight * n[0] * off;
        y += weight * n[1] * off;
    }
    let over = 1.0 / (xx * yy - xy * xy);
    let found = [corner[0] + (x * yy - y * xy) * over, corner[1] + (y * xx - x * xy) * over];
    // A node on the border of the picture stays on it.
    let found = [found[0].clamp(0.0, size[0] as f64), found[1].clamp(0.0, size[1] as f64)];
    if apart(found, corner) <= NEAR { found } else { corner }
}

fn apart(a: Point, b: Point) -> f64 {
    hypot(a[0] - b[0], a[1] - b[1])
}

/// Distance of p from the segment a to b.
fn beside(a: Point, b: Point, p: Point) -> f64 {
    let (w, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = w[0] * w[0] + w[1] * w[1];
    let t = if square > 0.0 { ((w[0] * v[0] + w[1] * v[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    hypot(v[0] - t * w[0], v[1] - t * w[1])
}
