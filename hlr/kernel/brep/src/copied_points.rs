//! The points of edges that are copies of one another: both have the same, however they are divided.

use std::collections::BTreeSet;

use crate::edges::Polyline;
use crate::shapes::{Copies, Edge};

impl Copies {
    /// Adds to chords, edge and number along the edge, those of the other edge that are copies of them.
    pub fn mirror(&self, chords: &mut BTreeSet<(u32, u32)>, lines: &[Option<Polyline>]) {
        let [one, two] = self.edges;
        for (from, to) in [(one, two), (two, one)] {
            let Some(last) = lines[from as usize].as_ref().and_then(|l| l.points.len().checked_sub(2)) else { return };
            let of: Vec<u32> = chords.range((from, 0)..=(from, u32::MAX)).map(|&(_, k)| k).collect();
            chords.extend(of.into_iter().map(|k| (to, if self.reversed { last as u32 - k } else { k })));
        }
    }

    /// Gives the second edge the points of the first.
    pub fn copy(&self, edges: &[Edge], lines: &mut [Option<Polyline>]) {
        let [one, two] = self.edges.map(|e| e as usize);
        let Some(line) = &lines[one] else { return };
        let ([from, to], [first, last]) = (edges[one].range, edges[two].range);
        let share = |t: &f64| if self.reversed { (to - t) / (to - from) } else { (t - from) / (to - from) };
        let mut made = Polyline {
            parameters: line.parameters.iter().map(|t| first + share(t).clamp(0.0, 1.0) * (last - first)).collect(),
            points: line.points.clone(),
        };
        if self.reversed {
            made.parameters.reverse();
            made.points.reverse();
        }
        lines[two] = Some(made);
    }
}
