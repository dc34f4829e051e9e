//! Shading of cones: it is constant along straight lines that meet in one point, so it is a function of the angle about
//! that point.
//!
//! A line of equal light runs through that point: (centre - p) . slope = 0, where slope is the gradient of the light at
//! p. Least squares over these equations find the centre roughly; a search for the least spread within slices refines
//! it.

use super::samples::Grid;
use hlr_exact::elementary::{atan2, hypot};

/// Of 255: the greatest error of a fan, on the whole and nearly everywhere. The facets of a cone's mesh cause as much.
const OFF: [f32; 2] = [1.5, 5.0];
/// Number of slices around the centre.
const SLICES: usize = 128;
/// Share of a slice's mean number of points: slices with fewer are ignored.
const FEW: f64 = 0.1;
/// Share of the extent: points nearer to the centre are ignored.
const CLOSE: f64 = 0.1;
/// Number of points to either side from which a slope is taken.
const REACH: usize = 5;

pub struct Fan {
    centre: [f64; 2],
    /// The angle at which counting begins, in the middle of the widest gap without points.
    cut: f64,
    /// Angles from the cut on, ascending, and the tone there.
    pub known: Vec<(f64, f32)>,
}

type Tone = ([f64; 2], f32);

impl Fan {
    /// The fan of a face, from some of its points; None where their light does not form one.
    pub fn find(grid: &Grid, tried: &[usize], face: u32) -> Option<Fan> {
        let points: Vec<Tone> = tried.iter().map(|&p| (place(grid, p), grid.samples[p].tone)).collect();
        if points.len() < 64 {
            return None;
        }
        let mut centre = rough(grid, tried, face)?;
        let (low, high) = points.iter().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(l, h), (p, _)| {
            ([l[0].min(p[0]), l[1].min(p[1])], [h[0].max(p[0]), h[1].max(p[1])])
        });
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let mut best = spread(&points, centre);
        let mut step = 0.1 * extent;
        while step > 0.05 {
            let around = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]];
            let found = around.map(|d| [centre[0] + d[0], centre[1] + d[1]]).map(|c| (spread(&points, c), c));
            match found.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).filter(|f| f.0 < best) {
                Some((least, there)) => (best, centre) = (least, there),
                None => step *= 0.5,
            }
        }
        // Close to the centre the light shows the facets of the mesh, not the surface.
        let far = |p: &[f64; 2]| hypot(p[0] - centre[0], p[1] - centre[1]) > CLOSE * extent;
        let points: Vec<Tone> = points.into_iter().filter(|(p, _)| far(p)).collect();
        let (cut, slices) = slices(&points, centre);
        let least = FEW * points.len() as f64 / SLICES as f64;
        let known: Vec<_> = slices.iter().filter(|s| s.2 >= least).map(|s| (s.0 / s.2, (s.1 / s.2) as f32)).collect();
        if known.len() < 2 {
            return None;
        }
        let fan = Fan { centre, cut, known };
        let mut off: Vec<f32> = points.iter().map(|(p, tone)| (fan.tone(*p) - tone).abs()).collect();
        off.sort_unstable_by(f32::total_cmp);
        let square = off.iter().map(|o| o * o).sum::<f32>() / off.len() as f32;
        (square.sqrt() <= OFF[0] && off[off.len() * 99 / 100] <= OFF[1]).then_some(fan)
    }

    /// The tone at a place in the picture.
    pub fn tone(&self, at: [f64; 2]) -> f32 {
        let angle = from(self.cut, angle(at, self.centre));
        let k = self.known.partition_point(|m| m.0 < angle).clamp(1, self.known.len().max(2) - 1);
        let (a, b) = (self.known[k - 1], self.known[k.min(self.known.len() - 1)]);
        let t = if b.0 > a.0 { ((angle - a.0) / (b.0 - a.0)).clamp(0.0, 1.0) } else { 0.0 };
        a.1 + (b.1 - a.1) * t as f32
    }
}

pub fn place(grid: &Grid, p: usize) -> [f64; 2] {
    let width = grid.size[0];
    [(p % width) as f64 + 0.5, (p / width) as f64 + 0.5]
}

/// Where lines of equal light meet, by least squares; None where they run side by side.
fn rough(grid: &Grid, tried: &[usize], face: u32) -> Option<[f64; 2]> {
    let [width, height] = grid.size;
    let (mut xx, mut xy, mut yy, mut x, mut y) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for &p in tried {
        let (i, j) = (p % width, p / width);
        if i < REACH || j < REACH || i + REACH >= width || j + REACH >= height {
            continue;
        }
        let around = [[i - REACH, j], [i + REACH, j], [i, j - REACH], [i, j + REACH]].map(|[i, j]| j * width + i);
        if around.iter().any(|&q| !grid.shows(q, face)) {
            continue;
        }
        let tone = around.map(|q| f64::from(grid.samples[q].tone));
        let slope = [tone[1] - tone[0], tone[3] - tone[2]];
        let size = hypot(slope[0], slope[1]);
        if size > 0.05 {
            let (n, at) = (slope.map(|s| s / size), place(grid, p));
            let off = n[0] * at[0] + n[1] * at[1];
            xx += n[0] * n[0];
            xy += n[0] * n[1];
            yy += n[1] * n[1];
            x += n[0] * off;
            y += n[1] * off;
        }
    }
    let turn = xx * yy - xy * xy;
    (turn > 1e-6 * (xx + yy) * (xx + yy)).then(|| [(x * yy - y * xy) / turn, (y * xx - x * xy) / turn])
}

fn angle(at: [f64; 2], centre: [f64; 2]) -> f64 {
    atan2(at[1] - centre[1], at[0] - centre[0])
}

/// The turn from one angle to another, 0 to a full turn.
fn from(cut: f64, angle: f64) -> f64 {
    (angle - cut).rem_euclid(std::f64::consts::TAU)
}

/// Sums of angle, tone, number, angle squared, angle times tone, tone squared.
type Slice = (f64, f64, f64, f64, f64, f64);

/// The angle of the cut, and all slices.
fn slices(points: &[Tone], centre: [f64; 2]) -> (f64, Vec<Slice>) {
    let mut angles: Vec<f64> = points.iter().map(|(p, _)| angle(*p, centre)).collect();
    angles.sort_unstable_by(f64::total_cmp);
    let around = [angles[0] + std::f64::consts::TAU];
    let ends = angles.iter().skip(1).chain(&around);
    let widest = angles
        .iter()
        .zip(ends)
        .map(|(a, b)| (b - a, 0.5 * (a + b)))
        .fold((0.0, 0.0), |w, g| if g.0 > w.0 { g } else { w });
    let cut = widest.1;
    let (first, turn) = (0.5 * widest.0, std::f64::consts::TAU - widest.0);
    let mut out = vec![(0.0, 0.0, 0.0, 0.0, 0.0, 0.0); SLICES];
    for (p, tone) in points {
        let (u, tone) = (from(cut, angle(*p, centre)), f64::from(*tone));
        let k = (((u - first) / turn.max(1e-9) * SLICES as f64) as usize).min(SLICES - 1);
        let s = &mut out[k];
        *s = (s.0 + u, s.1 + tone, s.2 + 1.0, s.3 + u * u, s.4 + u * tone, s.5 + tone * tone);
    }
    (cut, out)
}

/// The sum of squared differences between points and the fitted line of their slice.
fn spread(points: &[Tone], centre: [f64; 2]) -> f64 {
    let of = |&(u, t, n, uu, ut, tt): &Slice| {
        if n < 1.0 {
            return 0.0;
        }
        let (uu, ut, tt) = (uu - u * u / n, ut - u * t / n, tt - t * t / n);
        tt - if uu > 1e-12 { ut * ut / uu } else { 0.0 }
    };
    slices(points, centre).1.iter().map(of).sum()
}
