//! A grid of squares over the chords of an outline: tells which points are inside, and how near the border is.

use super::outline::Outline;
use super::plane::distance2;

/// Limit on the number of squares along one side.
const MOST: f64 = 2048.0;

pub struct BorderGrid<'a> {
    outline: &'a Outline,
    low: [f64; 2],
    /// Width and height of a square.
    step: [f64; 2],
    counts: [usize; 2],
    /// Chords of each square, row by row.
    first: Vec<u32>,
    chords: Vec<u32>,
}

impl<'a> BorderGrid<'a> {
    pub fn new(outline: &'a Outline) -> BorderGrid<'a> {
        let [low, high] = outline.bounds();
        let size = [0, 1].map(|k| (high[k] - low[k]).max(f64::MIN_POSITIVE));
        // About two squares per chord, as nearly square as possible.
        let side = (size[0] * size[1] / (2.0 * outline.len() as f64)).sqrt();
        let counts = size.map(|s| (s / side).clamp(1.0, MOST).ceil() as usize);
        let step = [0, 1].map(|k| size[k] / counts[k] as f64);
        let mut border = BorderGrid { outline, low, step, counts, first: Vec::new(), chords: Vec::new() };
        let squares = counts[0] * counts[1];
        let mut first = vec![0u32; squares + 1];
        for c in outline.chords() {
            border.squares(c, |s| first[s + 1] += 1);
        }
        for s in 0..squares {
            first[s + 1] += first[s];
        }
        let mut next = first.clone();
        let mut chords = vec![0; first[squares] as usize];
        for c in outline.chords() {
            border.squares(c, |s| {
                chords[next[s] as usize] = c;
                next[s] += 1;
            });
        }
        border.first = first;
        border.chords = chords;
        border
    }

    fn cell(&self, k: usize, x: f64) -> usize {
        (((x - self.low[k]) / self.step[k]).max(0.0) as usize).min(self.counts[k] - 1)
    }

    fn ends(&self, chord: u32) -> [[f64; 2]; 2] {
        [self.outline.uv[chord as usize], self.outline.uv[self.outline.after(chord) as usize]]
    }

    /// The squares that a chord passes through, and perhaps one more to either side in each row.
    fn squares(&self, chord: u32, mut visit: impl FnMut(usize)) {
        let [a, b] = self.ends(chord);
        let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let (from, to) = (self.cell(1, low[1]), self.cell(1, high[1]));
        for row in from..=to {
            let height = |k: usize| self.low[1] + self.step[1] * k as f64;
            let (mut left, mut right) = (low[0], high[0]);
            if from != to {
                let x = |y: f64| low[0] + (high[0] - low[0]) * ((y - low[1]) / (high[1] - low[1])).clamp(0.0, 1.0);
                (left, right) = (x(height(row)), x(height(row + 1)));
            }
            let spare = 1e-6 * self.step[0];
            let (left, right) = (left.min(right) - spare, left.max(right) + spare);
            for column in self.cell(0, left)..=self.cell(0, right) {
                visit(row * self.counts[0] + column);
            }
        }
    }

    fn in_square(&self, square: usize) -> &[u32] {
        &self.chords[self.first[square] as usize..self.first[square + 1] as usize]
    }

    /// Where the line at the height y crosses the loops, in ascending order.
    pub fn crossed(&self, y: f64, out: &mut Vec<f64>) {
        out.clear();
        let row = self.cell(1, y);
        for column in 0..self.counts[0] {
            for &chord in self.in_square(row * self.counts[0] + column) {
                let [a, b] = self.ends(chord);
                if (a[1] <= y) != (b[1] <= y) {
                    let x = a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
                    // A chord in several squares is counted once.
                    if self.cell(0, x) == column {
                        out.push(x);
                    }
                }
            }
        }
        out.sort_unstable_by(f64::total_cmp);
    }

    /// Whether any chord is closer to the point than the distance.
    pub fn is_near(&self, p: [f64; 2], distance: f64) -> bool {
        let range = |k: usize| self.cell(k, p[k] - distance)..=self.cell(k, p[k] + distance);
        range(1).any(|row| {
            range(0).any(|column| {
                self.in_square(row * self.counts[0] + column).iter().any(|&chord| {
                    let [a, b] = self.ends(chord);
                    distance2(&p, &a, &b) < distance * distance
                })
            })
        })
    }
}
