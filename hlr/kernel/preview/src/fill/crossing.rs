//! Locates the border between two areas between two neighbouring points of the grid, from the triangles visible there.
//!
//! ```text
//!      p ----------|----- q       p is on triangle A, q on B, different faces.
//!      A A A A A A A              Where A reaches over B, the nearer one is seen: the border is where A ends, or B begins,
//!              B B B B B B        or where they pass through one another.
//! ```

use super::chains::Crack;
use super::samples::{Grid, Sample};
use super::tone::Tones;
use crate::NOTHING;
use crate::shade::Scene;

pub struct Crossing<'a> {
    pub scene: &'a Scene<'a>,
    pub label: &'a [i32],
    pub grid: &'a Grid,
    pub cells: &'a [u32],
    pub tones: &'a Tones,
}

/// Corners of a triangle in the picture: x, y, depth.
type Corners = [[f64; 3]; 3];

impl Crossing<'_> {
    /// The place in pixels, and whether it is known exactly.
    pub fn find(&self, crack: &Crack) -> ([f64; 2], bool) {
        let centre = crack.map(|p| p.map(|c| f64::from(c) + 0.5));
        let [p, q] = centre;
        let share = self.share(crack, p, q);
        let t = share.unwrap_or(0.5).clamp(0.0, 1.0);
        ([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])], share.is_some())
    }

    /// Share of the way from p to q, 0 to 1; None where it is known no better than by the grid.
    fn share(&self, crack: &Crack, p: [f64; 2], q: [f64; 2]) -> Option<f64> {
        let [width, height] = self.grid.size.map(|s| s as i32);
        let mut at = [0usize; 2];
        for (k, &[x, y]) in crack.iter().enumerate() {
            if !(0..width).contains(&x) || !(0..height).contains(&y) {
                return Some(0.5); // the border of the picture
            }
            at[k] = (y * width + x) as usize;
        }
        let cell = at.map(|i| self.cells[i] as usize);
        let face = cell.map(|c| self.tones.face[c]);
        let one = at.map(|i| &self.grid.samples[i]);
        if at.iter().zip(face).any(|(&i, f)| !self.grid.shows(i, f)) {
            return None; // a speck was here
        }
        if face[0] == face[1] {
            let level = self.tones.between(cell[0], cell[1]);
            let t = f64::from((level - one[0].tone) / (one[1].tone - one[0].tone));
            return t.is_finite().then_some(t.clamp(0.02, 0.98));
        }
        let pair = self.pair(one)?;
        let [a, b] = pair.map(|t| if t == NOTHING { None } else { self.corners(t) });
        let (ends, begins) = (a.map(|a| leaves(&a, p, q)), b.map(|b| 1.0 - leaves(&b, q, p)));
        match (ends, begins) {
            (Some(t), None) if pair[1] == NOTHING => Some(t),
            (None, Some(t)) if pair[0] == NOTHING => Some(t),
            (Some(ends), Some(begins)) => {
                if ends <= begins + 1e-9 {
                    // Between them may lie something too narrow to be visible.
                    return (begins - ends < 0.2).then_some(0.5 * (ends + begins));
                }
                let (a, b) = (a?, b?);
                let nearer = |t: f64| depth(&b, along(p, q, t)) - depth(&a, along(p, q, t));
                let (first, last) = (nearer(begins), nearer(ends));
                Some(if first >= 0.0 && last >= 0.0 {
                    ends
                } else if first <= 0.0 && last <= 0.0 {
                    begins
                } else if first > 0.0 {
                    begins + (ends - begins) * first / (first - last)
                } else {
                    0.5 * (ends + begins)
                })
            }
            _ => None,
        }
    }

    /// The two triangles between which the border lies.
    fn pair(&self, [a, b]: [&Sample; 2]) -> Option<[u32; 2]> {
        let label = |t: u32| if t == NOTHING { -1 } else { self.label[t as usize] };
        [[a.front, b.front], [a.solid, b.solid]].into_iter().find(|[one, two]| label(*one) != label(*two))
    }

    /// None where the triangle reaches behind the eye.
    fn corners(&self, triangle: u32) -> Option<Corners> {
        let lens = self.scene.lens;
        let projector = lens.projector();
        let corners = self.scene.model.triangles[triangle as usize].map(|i| {
            let [x, y, depth, z] = projector.project(&self.scene.model.points[i as usize]);
            (z >= lens.near()).then_some([x, y, depth])
        });
        Some([corners[0]?, corners[1]?, corners[2]?])
    }
}

fn along(p: [f64; 2], q: [f64; 2], t: f64) -> [f64; 2] {
    [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]
}

/// Twice the area of a, b, p.
fn turn(a: &[f64; 3], b: &[f64; 3], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The share of the way from p, which is on the triangle, to q at which it leaves the triangle; 1 where it does not.
fn leaves(t: &Corners, p: [f64; 2], q: [f64; 2]) -> f64 {
    let side = turn(&t[0], &t[1], [t[2][0], t[2][1]]).signum();
    let mut out = 1.0f64;
    for k in 0..3 {
        let (a, b) = (&t[k], &t[(k + 1) % 3]);
        let (here, there) = (side * turn(a, b, p), side * turn(a, b, q));
        if there < 0.0 {
            // p may lie outside by the rounding of the raster's grid.
            out = out.min(if here > 0.0 { here / (here - there) } else { 0.0 });
        }
    }
    out
}

/// Depth of the triangle's plane at p.
fn depth(t: &Corners, p: [f64; 2]) -> f64 {
    let area = turn(&t[0], &t[1], [t[2][0], t[2][1]]);
    let w = [turn(&t[1], &t[2], p) / area, turn(&t[2], &t[0], p) / area];
    w[0] * t[0][2] + w[1] * t[1][2] + (1.0 - w[0] - w[1]) * t[2][2]
}
