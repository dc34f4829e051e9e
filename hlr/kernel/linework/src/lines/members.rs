//! Sides as cells of the paper hold them: small, with boxes and directions that tell of most that none covers the other.

use super::cells::Cells;
use super::gaps::{Side, Widths};
use super::stretches::PARALLEL;

/// How far off the sine of an angle may be that is computed with f32.
const ROUNDED: f32 = 1e-5;

/// How near boxes of sides come where the one may cover the other, mm: of one visibility, of two.
pub(super) struct Gaps([f32; 2]);

impl Gaps {
    pub fn of(cells: &Cells, widths: Widths) -> Gaps {
        // Of one visibility only what coincides is covered.
        let Widths { same, under } = widths;
        Gaps([same, same.max(under)].map(|width| (1.5 * width + 2.0 * cells.rounding()) as f32))
    }
}

/// A side in a cell: its direction, of length 1, and its box, from the lower left corner of all.
#[derive(Clone, Copy, Default)]
pub(super) struct Member {
    low: [f32; 2],
    high: [f32; 2],
    direction: [f32; 2],
    pub side: u32,
    visible: bool,
}

impl Member {
    pub fn of(number: u32, side: &Side, low: &[f64; 2]) -> Member {
        let [from, to] = [side.from, side.to].map(|p| [0, 1].map(|k| (p[k] - low[k]) as f32));
        // Without a length there is no direction, and zero is parallel to all.
        let length = side.length().max(f64::MIN_POSITIVE);
        Member {
            low: [0, 1].map(|k| from[k].min(to[k])),
            high: [0, 1].map(|k| from[k].max(to[k])),
            direction: [0, 1].map(|k| ((side.to[k] - side.from[k]) / length) as f32),
            side: number,
            visible: side.visible,
        }
    }

    /// Whether one may cover a stretch of the other: the boxes come as near as the gap, and directions differ little.
    pub fn may_cover(&self, other: &Member, gaps: &Gaps) -> bool {
        let gap = gaps.0[usize::from(self.visible != other.visible)];
        let near = |k: usize| (self.low[k] <= other.high[k] + gap) & (other.low[k] <= self.high[k] + gap);
        let ([ux, uy], [vx, vy]) = (self.direction, other.direction);
        near(0) && near(1) && (ux * vy - uy * vx).abs() <= PARALLEL as f32 + ROUNDED
    }
}
