//! The lines of a drawing as ink: their segments in whole steps, in one grid for each visibility.

use rayon::prelude::*;

use super::grid::{Grid, NOWHERE, STEPS, Segment, measurable, rounded};
use crate::fit::arc::grow;
use crate::fit::plane::Vec2;
use crate::lines::drawing::{Line, Lines};

/// Lines that one thread looks at together.
const TOGETHER: usize = 256;

/// What the questions about a drawing's ink have in common.
pub struct Ink {
    /// Of each line; steps.
    pub boxes: Vec<[Vec2; 2]>,
    /// The side of the smallest square that holds one of the hidden, and one of the visible lines; millimetres.
    pub smallest: [f64; 2],
    /// Of hidden and of visible lines. None where there is too much ink to be looked at.
    pub grids: [Option<Grid>; 2],
}

impl Ink {
    /// reaches: how far is looked beside hidden and beside visible lines, millimetres.
    pub fn of(lines: &Lines, reaches: [f64; 2]) -> Ink {
        let chunks: Vec<Chunk> =
            lines.0.par_chunks(TOGETHER).enumerate().map(|(k, some)| Chunk::of(k * TOGETHER, some)).collect();
        let boxes = chunks.iter().flat_map(|chunk| &chunk.boxes).copied().collect();
        let smallest = [0, 1].map(|of| chunks.iter().map(|chunk| chunk.smallest[of]).fold(f64::INFINITY, f64::min));
        let grid = |visible: usize| {
            let segments: Vec<Segment> = chunks.iter().flat_map(|chunk| &chunk.segments[visible]).copied().collect();
            measurable(&segments).then(|| Grid::new(segments, reaches[visible] * STEPS))
        };
        let (hidden, visible) = rayon::join(|| grid(0), || grid(1));
        Ink { boxes, smallest, grids: [hidden, visible] }
    }
}

/// Of some lines, one after another.
struct Chunk {
    boxes: Vec<[Vec2; 2]>,
    /// Of hidden and of visible lines.
    smallest: [f64; 2],
    segments: [Vec<Segment>; 2],
}

impl Chunk {
    /// first: the number of the first line.
    fn of(first: usize, lines: &[Line]) -> Chunk {
        let (mut boxes, mut smallest) = (Vec::with_capacity(lines.len()), [f64::INFINITY; 2]);
        let mut segments = [Vec::new(), Vec::new()];
        for (number, line) in (first as u32..).zip(lines) {
            let mut around = NOWHERE;
            let mut before: Option<Vec2> = None;
            for p in line.flat.iter().map(rounded) {
                grow(&mut around, &p);
                if let Some(a) = before.replace(p).filter(|a| *a != p) {
                    segments[usize::from(line.visible)].push(Segment { a, b: p, line: number });
                }
            }
            let [low, high] = around;
            let side = (high[0] - low[0]).max(high[1] - low[1]) / STEPS;
            let of = usize::from(line.visible);
            smallest[of] = side.min(smallest[of]);
            boxes.push(around);
        }
        Chunk { boxes, smallest, segments }
    }
}
