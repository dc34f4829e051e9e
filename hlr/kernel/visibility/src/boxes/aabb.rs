//! Axis-aligned boxes of integers.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aabb {
    pub low: [i32; 3],
    pub high: [i32; 3],
}

impl Aabb {
    pub const EMPTY: Aabb = Aabb { low: [i32::MAX; 3], high: [i32::MIN; 3] };

    pub fn of(points: &[&[i32; 3]]) -> Aabb {
        points.iter().fold(Aabb::EMPTY, |b, p| b.union(&Aabb { low: **p, high: **p }))
    }

    #[inline]
    pub fn union(&self, other: &Aabb) -> Aabb {
        let mut out = *self;
        for k in 0..3 {
            out.low[k] = out.low[k].min(other.low[k]);
            out.high[k] = out.high[k].max(other.high[k]);
        }
        out
    }

    #[inline(always)]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        // Without a branch per comparison: which of them fails cannot be foretold.
        (0..3).fold(true, |all, k| all & (self.low[k] <= other.high[k]) & (other.low[k] <= self.high[k]))
    }

    /// Whether the boxes overlap in more than their borders. A box without thickness may lie inside another.
    pub fn enters(&self, other: &Aabb) -> bool {
        (0..3).all(|k| self.low[k] < other.high[k] && other.low[k] < self.high[k])
    }

    pub fn common(&self, other: &Aabb) -> Aabb {
        let mut out = *self;
        for k in 0..3 {
            out.low[k] = out.low[k].max(other.low[k]);
            out.high[k] = out.high[k].min(other.high[k]);
        }
        out
    }

    /// The box extended toward the viewer by `depth`.
    pub fn toward_viewer(mut self, depth: i64) -> Aabb {
        self.low[2] = (i64::from(self.low[2]) - depth).max(i64::from(i32::MIN)) as i32;
        self
    }
}

/// A box, and the number of what it is around.
pub type Item = (Aabb, u32);

/// The box around all of these.
pub fn around(items: &[Item]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |b, (a, _)| b.union(a))
}

/// The middle of a box, doubled.
pub fn middle(of: &Aabb) -> [i64; 3] {
    [0, 1, 2].map(|k| i64::from(of.low[k]) + i64::from(of.high[k]))
}
