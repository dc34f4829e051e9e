//! Joins chains to closed loops: the areas to be painted, in the order of painting.
//!
//! Large faces come first, transparent ones with nothing behind them last. Bands of equal light lie on one another: the
//! darkest covers the whole face, and each that follows covers what is at least as light. So nothing shines through
//! between bands.

use super::chains::Chain;
use super::runs::Runs;
use super::samples::Grid;
use super::tone::{Gradient, Tones};

type Point = [f64; 2];

/// What is painted, in the order of painting; places in pixels, y down; filled by the even-odd rule.
pub struct Areas {
    pub loops: Vec<Vec<Point>>,
    /// Per area: how many loops there are before it; one more for the end.
    pub starts: Vec<usize>,
    pub colours: Vec<[u8; 4]>,
    pub gradients: Vec<Option<Gradient>>,
    /// A triangle of the face.
    pub triangle: Vec<u32>,
}

/// `parts`: the runs of the cells.
pub fn collect(
    grid: &Grid,
    tones: &Tones,
    (cells, parts): (&[u32], &Runs),
    chains: &[Chain],
    borders: Vec<Vec<Point>>,
) -> Areas {
    let count = grid.first.len();
    let mut large = vec![0usize; count];
    for places in (0..parts.count()).map(|k| parts.places(k)) {
        large[tones.face[cells[places.start] as usize] as usize] += places.len();
    }
    let mut of_face: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (k, chain) in chains.iter().enumerate() {
        let [a, b] = chain.cells.map(|c| tones.face[c as usize] as usize);
        of_face[a].push(k as u32);
        if b != a {
            of_face[b].push(k as u32);
        }
    }
    let mut first = vec![0usize; count + 1];
    for &f in &tones.face {
        first[f as usize + 1] += 1;
    }
    for f in 0..count {
        first[f + 1] += first[f];
    }
    let clear = |f: usize| tones.colour[first[f]][3] < 255;
    let mut order: Vec<usize> = (1..count).filter(|&f| large[f] > 0).collect();
    order.sort_by_key(|&f| (clear(f), usize::MAX - large[f], f));
    let mut out = Areas { loops: vec![], starts: vec![0], colours: vec![], gradients: vec![], triangle: vec![] };
    for f in order {
        for cell in first[f]..first[f + 1] {
            // Bands of a transparent face lie side by side: on top of one another they would be denser.
            let inside = |c: u32| {
                let c = c as usize;
                if clear(f) { c == cell } else { c >= cell && c < first[f + 1] }
            };
            let own = of_face[f].iter().filter_map(|&k| {
                let [left, right] = chains[k as usize].cells.map(inside);
                (left != right).then_some((k, right))
            });
            let loops = closed(&own.collect::<Vec<_>>(), chains, &borders);
            if loops.is_empty() {
                continue;
            }
            out.loops.extend(loops);
            out.starts.push(out.loops.len());
            out.colours.push(tones.colour[cell]);
            out.gradients.push(tones.gradient[cell].clone());
            out.triangle.push(grid.first[f]);
        }
    }
    out
}

/// Joins chains at their nodes into loops, each with the area to its left; `own`: chains, and whether each runs
/// backward.
fn closed(own: &[(u32, bool)], chains: &[Chain], borders: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let way = |&(k, back): &(u32, bool)| {
        let mut border = borders[k as usize].clone();
        if back {
            border.reverse();
        }
        border
    };
    let mut out = Vec::new();
    // From node to node.
    let mut open: Vec<([u32; 2], (u32, bool))> = Vec::new();
    for one in own {
        match chains[one.0 as usize].ends {
            Some([a, b]) => open.push((if one.1 { [b, a] } else { [a, b] }, *one)),
            None => out.push(way(one)),
        }
    }
    open.sort_unstable();
    let mut used = vec![false; open.len()];
    for start in 0..open.len() {
        let (mut points, mut next) = (Vec::new(), (!used[start]).then_some(start));
        while let Some(at) = next {
            used[at] = true;
            let ([_, node], one) = &open[at];
            let border = way(one);
            points.extend_from_slice(&border[..border.len() - 1]);
            let from = open.partition_point(|o| o.0[0] < *node);
            next = (from..open.len()).take_while(|&o| open[o].0[0] == *node).find(|&o| !used[o]);
        }
        if points.len() > 2 {
            out.push(points);
        }
    }
    out.retain(|l| l.len() > 2);
    out
}
