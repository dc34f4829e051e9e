//! The points of edges that are copies of one another: both have the same, however they are divided.

use std::collections::BTreeSet;

use crate::edges::Polyline;
use crate::shapes::Edge;

/// Chords, edge and number along the edge, with those of originals instead of those of their copies.
pub fn of_originals(chords: BTreeSet<(u32, u32)>, edges: &[Edge], lines: &[Option<Polyline>]) -> BTreeSet<(u32, u32)> {
    let of_original = |(edge, chord): (u32, u32)| match edges[edge as usize].original {
        Some((original, true)) => {
            let count = lines[edge as usize].as_ref().map_or(1, |line| line.points.len() as u32 - 1);
            (original, count - 1 - chord)
        }
        Some((original, false)) => (original, chord),
        None => (edge, chord),
    };
    chords.into_iter().map(of_original).collect()
}

/// Gives the copies of these originals their points. Returns the numbers of the copies.
pub fn copy_points(edges: &[Edge], lines: &mut [Option<Polyline>], originals: impl Fn(u32) -> bool) -> Vec<u32> {
    let mut changed = Vec::new();
    for (number, edge) in (0..).zip(edges) {
        let Some((original, reversed)) = edge.original.filter(|(original, _)| originals(*original)) else { continue };
        lines[number as usize] = lines[original as usize].as_ref().map(|line| {
            let ([from, to], [first, last]) = (edges[original as usize].range, edge.range);
            let own = |t: &f64| {
                let way = if reversed { to - t } else { t - from };
                first + (way / (to - from)).clamp(0.0, 1.0) * (last - first)
            };
            let mut made =
                Polyline { parameters: line.parameters.iter().map(own).collect(), points: line.points.clone() };
            if reversed {
                made.parameters.reverse();
                made.points.reverse();
            }
            made
        });
        changed.push(number);
    }
    changed
}
