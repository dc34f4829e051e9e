//! The nearest of many segments in the plane, for many points.

use super::boxes::{Bounds, Tree};

pub type Segment = [[f64; 2]; 2];

pub struct Segments<'a> {
    segments: &'a [Segment],
    tree: Tree<2>,
}

impl<'a> Segments<'a> {
    pub fn new(segments: &'a [Segment]) -> Self {
        let boxes: Vec<Bounds<2>> = segments.iter().map(|s| Bounds::of(s)).collect();
        Segments { segments, tree: Tree::new(&boxes) }
    }

    /// Distance and number of the segment nearest to a point; of equally near ones the first. Infinity where none is
    /// nearer than `most`.
    pub fn nearest(&self, p: &[f64; 2], most: f64) -> (f64, u32) {
        let best = std::cell::Cell::new((most * most, u32::MAX));
        self.tree.walk(
            |bounds, _| {
                let d = bounds.distance2(p);
                (d <= best.get().0).then_some(d)
            },
            |i| {
                let d = distance2(p, &self.segments[i as usize]);
                let (least, first) = best.get();
                if d < least || (d == least && i < first) {
                    best.set((d, i));
                }
                false
            },
        );
        let (d, i) = best.get();
        (if i == u32::MAX { f64::INFINITY } else { d.sqrt() }, i)
    }
}

fn distance2(p: &[f64; 2], [a, b]: &Segment) -> f64 {
    let (way, d) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let size = way[0] * way[0] + way[1] * way[1];
    let t = if size > 0.0 { ((d[0] * way[0] + d[1] * way[1]) / size).clamp(0.0, 1.0) } else { 0.0 };
    let off = [d[0] - t * way[0], d[1] - t * way[1]];
    off[0] * off[0] + off[1] * off[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_a_plain_search_finds() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let segments: Vec<Segment> = (0..300)
            .map(|_| {
                let a = [random(), random()];
                [a, [a[0] + 0.1 * random(), a[1] + 0.1 * random()]]
            })
            .collect();
        let tree = Segments::new(&segments);
        for _ in 0..300 {
            let p = [random(), random()];
            let plain = segments.iter().map(|s| distance2(&p, s)).fold(f64::INFINITY, f64::min).sqrt();
            assert_eq!(tree.nearest(&p, f64::INFINITY).0, plain);
            assert_eq!(tree.nearest(&p, 0.5 * plain), (f64::INFINITY, u32::MAX));
        }
    }
}
