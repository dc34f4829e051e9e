//! The paint of each face: one colour, a gradient along a straight line, or bands of equal light.
//!
//! A cylinder or a swept face in a parallel view is equally light along its straight lines, so its light is a function
//! of one coordinate of the picture. The direction of that coordinate is found by a search: along it, points at equal
//! positions differ least.

use hlr_exact::elementary::sin_cos;
use rayon::prelude::*;

use super::conical::{Fan, place};
use super::samples::{Grid, Sample};

/// Of 255: tones that differ by less are painted in one colour.
const EVEN: f32 = 1.5;
/// Of 255: steps between bands.
const STEP: f32 = 3.0;
const MOST_BANDS: f32 = 64.0;
/// Of 255: steps between bands of a fan. They are as fine as a screen shows, because straight borders cost next to
/// nothing.
const FAN_STEP: f32 = 1.0;
const MOST_IN_FAN: f32 = 256.0;
/// Bands of a fan to either side that smooth the colour of one.
const BESIDE: usize = 4;
/// Number of points on which directions are tried.
const TRIED: usize = 1500;
/// Number of slices across a gradient.
const SLICES: usize = 64;
/// Of 255: the greatest error of a gradient, on the whole and nearly everywhere.
const OFF: [f32; 2] = [0.8, 2.5];

/// A gradient along a line: places in pixels, colours in sRGB at shares of the way.
#[derive(Clone, Debug)]
pub struct Gradient {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub stops: Vec<(f64, [u8; 4])>,
}

#[derive(Clone, Debug)]
enum Paint {
    Even,
    Gradient(Gradient),
    /// Tones at which the bands begin, without the first.
    Bands(Vec<f32>),
}

/// Cells: the bands of all faces, face after face; 0 is nothing.
pub struct Tones {
    /// Per cell: its face, and its number among that face's bands.
    pub face: Vec<u32>,
    pub band: Vec<u32>,
    pub colour: Vec<[u8; 4]>,
    pub gradient: Vec<Option<Gradient>>,
    begins: Vec<f32>,
}

impl Tones {
    /// How alike two cells are: 0 for cells of two faces, else the more, the nearer their bands are.
    pub fn alike(&self, a: usize, b: usize) -> u32 {
        if self.face[a] == self.face[b] { u32::MAX - self.band[a].abs_diff(self.band[b]) } else { 0 }
    }

    /// The tone at which a border between two bands of one face runs.
    pub fn between(&self, a: usize, b: usize) -> f32 {
        let (low, high) = (a.min(b), a.max(b));
        0.5 * (self.begins[low + 1] + self.begins[high])
    }
}

/// `faces`: face of each point; `fine`: least width of a band, in points. The tone of each point of a fan is replaced
/// by that of its angle, so that bands of the fan have straight borders.
pub fn tones(grid: &mut Grid, faces: &[u32], fine: f64) -> Tones {
    let count = grid.first.len();
    let mut starts = vec![0usize; count + 1];
    // A point that a speck has left to its neighbour has another face's colour: it does not count.
    let own = |p: usize| grid.faces[p] == faces[p];
    for (p, &f) in faces.iter().enumerate() {
        starts[f as usize + 1] += usize::from(own(p));
    }
    for f in 0..count {
        starts[f + 1] += starts[f];
    }
    let mut points = vec![0u32; starts[count]];
    let mut next = starts.clone();
    for (p, &f) in faces.iter().enumerate() {
        if own(p) {
            points[next[f as usize]] = p as u32;
            next[f as usize] += 1;
        }
    }
    let shown: &Grid = grid;
    let painted: Vec<(Paint, Option<Fan>)> =
        (0..count).into_par_iter().map(|f| paint(shown, &points[starts[f]..starts[f + 1]], f, fine)).collect();
    let mut out = Tones { face: vec![], band: vec![], colour: vec![], gradient: vec![], begins: vec![] };
    for (f, (paint, fan)) in painted.into_iter().enumerate() {
        let own = &points[starts[f]..starts[f + 1]];
        let is_fan = fan.is_some();
        if let Some(fan) = fan {
            for &p in own {
                grid.samples[p as usize].tone = fan.tone(place(grid, p));
            }
        }
        let (gradient, begins) = match paint {
            Paint::Even => (None, vec![]),
            Paint::Gradient(g) => (Some(g), vec![]),
            Paint::Bands(begins) => (None, begins),
        };
        let mut sums = vec![([0.0f64; 4], 0.0f64); begins.len() + 1];
        for &p in own {
            let s = &grid.samples[p as usize];
            let (sum, count) = &mut sums[band(&begins, s.tone)];
            (0..4).for_each(|k| sum[k] += f64::from(s.colour[k]));
            *count += 1.0;
        }
        if is_fan {
            sums = smoothed(&sums);
        }
        let mut last = [0u8; 4];
        for (b, (sum, count)) in sums.into_iter().enumerate() {
            if count > 0.0 {
                last = sum.map(|s| (s / count).round() as u8);
            }
            out.face.push(f as u32);
            out.band.push(b as u32);
            out.colour.push(last);
            out.gradient.push(if b == 0 { gradient.clone() } else { None });
            out.begins.push(if b == 0 { f32::NEG_INFINITY } else { begins[b - 1] });
        }
    }
    out
}

/// Sums of colours and numbers of points by band, each smoothed by a line through the neighbouring bands: bands of a
/// fan are so narrow that facets would show.
fn smoothed(sums: &[([f64; 4], f64)]) -> Vec<([f64; 4], f64)> {
    let at = |b: usize| {
        let beside = b.saturating_sub(BESIDE)..(b + BESIDE + 1).min(sums.len());
        let (mut n, mut x, mut xx, mut y, mut xy) = (0.0, 0.0, 0.0, [0.0; 4], [0.0; 4]);
        for i in beside {
            let ((sum, count), off) = (&sums[i], i as f64 - b as f64);
            (n, x, xx) = (n + count, x + count * off, xx + count * off * off);
            (0..4).for_each(|k| (y[k], xy[k]) = (y[k] + sum[k], xy[k] + sum[k] * off));
        }
        let turn = n * xx - x * x;
        let level = |k: usize| if turn > 1e-9 * n * xx { (y[k] * xx - xy[k] * x) / turn } else { y[k] / n };
        let count = sums[b].1;
        ([0, 1, 2, 3].map(|k| if n > 0.0 { level(k).clamp(0.0, 255.0) * count } else { 0.0 }), count)
    };
    (0..sums.len()).map(at).collect()
}

/// The cell of each point.
pub fn cells(grid: &Grid, faces: &[u32], tones: &Tones) -> Vec<u32> {
    let mut first = vec![0usize; grid.first.len() + 1];
    for &f in &tones.face {
        first[f as usize + 1] += 1;
    }
    for f in 0..grid.first.len() {
        first[f + 1] += first[f];
    }
    let of = |(&f, s): (&u32, &Sample)| {
        let range = first[f as usize] + 1..first[f as usize + 1];
        (first[f as usize] + band(&tones.begins[range], s.tone)) as u32
    };
    faces.par_iter().zip(&grid.samples).map(of).collect()
}

fn band(begins: &[f32], tone: f32) -> usize {
    begins.partition_point(|&b| b <= tone)
}

fn paint(grid: &Grid, points: &[u32], face: usize, fine: f64) -> (Paint, Option<Fan>) {
    let tone = |p: &u32| grid.samples[*p as usize].tone;
    let low = points.iter().map(tone).fold(f32::INFINITY, f32::min);
    let high = points.iter().map(tone).fold(f32::NEG_INFINITY, f32::max);
    if face == 0 || points.is_empty() || high - low <= EVEN {
        return (Paint::Even, None);
    }
    if let Some(gradient) = gradient(grid, points) {
        return (Paint::Gradient(gradient), None);
    }
    let fan = Fan::find(grid, points, face as u32);
    let (step, most) = if fan.is_some() { (FAN_STEP, MOST_IN_FAN) } else { (STEP, MOST_BANDS) };
    let wide = ((points.len() as f64).sqrt() / fine) as f32;
    let count = ((high - low) / step).min(most).min(wide).max(1.0) as usize;
    if count < 2 {
        return (Paint::Even, None);
    }
    (Paint::Bands((1..count).map(|k| low + (high - low) * k as f32 / count as f32).collect()), fan)
}

/// Some points of a face: position relative to their middle, tone, colour.
struct Tried {
    middle: [f64; 2],
    points: Vec<([f64; 2], f32, [u8; 4])>,
}

fn gradient(grid: &Grid, points: &[u32]) -> Option<Gradient> {
    let tried = chosen(grid, points);
    if tried.points.len() < 12 {
        return None;
    }
    let spread = |angle: f64| slices(&tried, angle).1;
    let mut best = (f64::INFINITY, 0.0);
    let mut step = std::f64::consts::PI / 36.0;
    for k in 0..36 {
        let angle = f64::from(k) * step;
        let found = spread(angle);
        if found < best.0 {
            best = (found, angle);
        }
    }
    for _ in 0..12 {
        step *= 0.5;
        for angle in [best.1 - step, best.1 + step] {
            let found = spread(angle);
            if found < best.0 {
                best = (found, angle);
            }
        }
    }
    let (slices, _) = slices(&tried, best.1);
    // Differences between the points and the gradient.
    let known: Vec<(f64, f32, [f64; 4])> = slices.means();
    let mut off: Vec<f32> = tried.points.iter().map(|(at, tone, _)| (slices.at(&known, at) - tone).abs()).collect();
    off.sort_unstable_by(f32::total_cmp);
    let square = off.iter().map(|o| o * o).sum::<f32>() / off.len() as f32;
    if square.sqrt() > OFF[0] || off[off.len() * 99 / 100] > OFF[1] {
        return None;
    }
    let along = |u: f64| [tried.middle[0] + u * slices.way[0], tried.middle[1] + u * slices.way[1]];
    let kept = few(&known);
    let (first, last) = (known[kept[0]].0, known[kept[kept.len() - 1]].0);
    if kept.len() < 2 || last - first <= 0.0 {
        return None;
    }
    let stops = kept.iter().map(|&k| ((known[k].0 - first) / (last - first), known[k].2.map(|c| c.round() as u8)));
    Some(Gradient { from: along(first), to: along(last), stops: stops.collect() })
}

fn chosen(grid: &Grid, points: &[u32]) -> Tried {
    let width = grid.size[0];
    let place = |p: u32| [(p as usize % width) as f64 + 0.5, (p as usize / width) as f64 + 0.5];
    let count = points.len() as f64;
    let sum = points.iter().fold([0.0; 2], |s, &p| [s[0] + place(p)[0], s[1] + place(p)[1]]);
    let middle = sum.map(|s| s / count);
    // An odd step: with a divisor in common with the rows, points would all lie in a few columns.
    let step = (points.len() / TRIED).max(1) | 1;
    let one = |&p: &u32| {
        let s = &grid.samples[p as usize];
        ([place(p)[0] - middle[0], place(p)[1] - middle[1]], s.tone, s.colour)
    };
    Tried { middle, points: points.iter().step_by(step).map(one).collect() }
}

struct Slices {
    way: [f64; 2],
    /// Per slice: sums of place, tone, its square, and colour; and the number of points.
    sums: Vec<([f64; 7], f64)>,
}

/// The slices across a direction, and the sum of squared differences between points and the fitted line of their slice.
fn slices(tried: &Tried, angle: f64) -> (Slices, f64) {
    let (sin, cos) = sin_cos(angle);
    let at = |p: &[f64; 2]| p[0] * cos + p[1] * sin;
    let (low, high) =
        tried.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), (p, ..)| (l.min(at(p)), h.max(at(p))));
    let over = SLICES as f64 / (high - low).max(1e-9);
    // place, tone, tone^2, colours; for the spread also place^2 and place * tone
    let mut sums = vec![([0.0f64; 7], 0.0f64); SLICES];
    let mut mixed = vec![[0.0f64; 2]; SLICES];
    for (p, tone, colour) in &tried.points {
        let (u, tone) = (at(p), f64::from(*tone));
        let k = (((u - low) * over) as usize).min(SLICES - 1);
        let (s, n) = &mut sums[k];
        s[0] += u;
        s[1] += tone;
        s[2] += tone * tone;
        (0..4).for_each(|c| s[3 + c] += f64::from(colour[c]));
        *n += 1.0;
        mixed[k][0] += u * u;
        mixed[k][1] += u * tone;
    }
    let spread = sums.iter().zip(&mixed).map(|((s, n), m)| {
        if *n < 1.0 {
            return 0.0;
        }
        let (uu, ut, tt) = (m[0] - s[0] * s[0] / n, m[1] - s[0] * s[1] / n, s[2] - s[1] * s[1] / n);
        tt - if uu > 1e-9 { ut * ut / uu } else { 0.0 }
    });
    let spread = spread.sum();
    (Slices { way: [cos, sin], sums }, spread)
}

impl Slices {
    /// For each slice with points: mean position, tone and colour.
    fn means(&self) -> Vec<(f64, f32, [f64; 4])> {
        let filled = self.sums.iter().filter(|(_, n)| *n > 0.0);
        filled.map(|(s, n)| (s[0] / n, (s[1] / n) as f32, [3, 4, 5, 6].map(|k: usize| s[k] / n))).collect()
    }

    /// The tone at a place, interpolated between the means.
    fn at(&self, known: &[(f64, f32, [f64; 4])], place: &[f64; 2]) -> f32 {
        let u = place[0] * self.way[0] + place[1] * self.way[1];
        let k = known.partition_point(|m| m.0 < u).clamp(1, known.len().max(2) - 1);
        let (a, b) = (&known[k - 1], &known[k.min(known.len() - 1)]);
        if b.0 - a.0 < 1e-9 {
            return a.1;
        }
        a.1 + (b.1 - a.1) * ((u - a.0) / (b.0 - a.0)) as f32
    }
}

/// The fewest stops with which no colour between them is off by a step of the picture.
fn few(known: &[(f64, f32, [f64; 4])]) -> Vec<usize> {
    let mut kept = vec![0, known.len() - 1];
    let mut open = vec![(0, known.len() - 1)];
    while let Some((a, b)) = open.pop() {
        let off = |k: usize| {
            let t = (known[k].0 - known[a].0) / (known[b].0 - known[a].0);
            let at = |c: usize| known[a].2[c] + t * (known[b].2[c] - known[a].2[c]);
            (0..3).map(|c| (at(c) - known[k].2[c]).abs()).fold(0.0, f64::max)
        };
        let worst = (a + 1..b).map(|k| (off(k), k)).fold((0.75, 0), |w, o| if o.0 > w.0 { o } else { w });
        if worst.1 > 0 {
            kept.push(worst.1);
            open.extend([(a, worst.1), (worst.1, b)]);
        }
    }
    kept.sort_unstable();
    kept
}
