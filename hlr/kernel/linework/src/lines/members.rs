//! Sides as cells of the paper hold them: small, with boxes and directions that tell of most that none covers the other.

use super::cells::Cells;
use super::gaps::{Side, Widths};
use super::stretches::PARALLEL;

/// How far off the sine of an angle may be that is computed with f32.
const ROUNDED: f32 = 1e-5;

/// How near boxes of sides come where the one may cover the other, mm: of one visibility, and of two or where one is of a
/// shallow intersection line.
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
    /// How far the box goes to the right, up, to the left and down.
    out: [f32; 4],
    direction: [f32; 2],
    pub side: u32,
    line: u32,
    visible: bool,
    shallow: bool,
}

impl Member {
    pub fn of(number: u32, side: &Side, low: &[f64; 2]) -> Member {
        let [[ax, ay], [bx, by]] = [side.from, side.to].map(|p| [0, 1].map(|k| (p[k] - low[k]) as f32));
        // Without a length there is no direction, and zero is parallel to all.
        let length = side.length().max(f64::MIN_POSITIVE);
        Member {
            out: [ax.max(bx), ay.max(by), -ax.min(bx), -ay.min(by)],
            direction: [0, 1].map(|k| ((side.to[k] - side.from[k]) / length) as f32),
            side: number,
            line: side.line,
            visible: side.visible,
            shallow: side.shallow,
        }
    }

    /// Whether one may cover a stretch of the other: the boxes come as near as the gap, directions differ little, and
    /// each comes as near to the straight line through the other. Within one line only what runs back is covered, or
    /// around: that takes two sides between them.
    pub fn may_cover(&self, other: &Member, gaps: &Gaps) -> bool {
        let gap = gaps.0[usize::from(self.visible != other.visible || self.shallow || other.shallow)];
        // All four at once: most are far apart, and it cannot be foretold on which side.
        let [right, up, left, down] = self.out;
        let [a, b, c, d] = other.out;
        let near = (right + c >= -gap) & (up + d >= -gap) & (left + a >= -gap) & (down + b >= -gap);
        let ([ux, uy], [vx, vy]) = (self.direction, other.direction);
        let sine = (ux * vy - uy * vx).abs();
        near && sine <= PARALLEL as f32 + ROUNDED
            && (self.line != other.line || self.side.abs_diff(other.side) > 2 || ux * vx + uy * vy < ROUNDED)
            && self.near_line(other, sine, gap)
            && other.near_line(self, sine, gap)
    }

    /// Whether the other comes as near to the straight line through this side as the gap. sine: of the angle between.
    fn near_line(&self, other: &Member, sine: f32, gap: f32) -> bool {
        let ([right, up, left, down], [a, b, c, d]) = (self.out, other.out);
        // Twice the way from middle to middle, and how much nearer than its middle an end is, twice and at most.
        let way = [(a - c) - (right - left), (b - d) - (up - down)];
        let nearer = (sine + ROUNDED) * ((a + c) + (b + d));
        (self.direction[0] * way[1] - self.direction[1] * way[0]).abs() <= 2.0 * gap + nearer
    }
}
