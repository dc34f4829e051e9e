//! The paint of each face: one colour, a gradient along a straight line, or bands of equal light.
//!
//! A cylinder or a swept face in a parallel view is equally light along its straight lines, so its light is a function
//! of one coordinate of the picture. The direction of that coordinate is found by a search: along it, points at equal
//! positions differ least.

use std::ops::Range;

use hlr_exact::elementary::sin_cos;
use rayon::prelude::*;

use super::conical::{Fan, place};
use super::samples::Grid;

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
/// Number of points on which directions, and centres of fans, are tried.
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

/// `faces`: face of each run of the grid; `fine`: least width of a band, in points. The tone of each point of a fan is
/// replaced by that of its angle, so that bands of the fan have straight borders.
pub fn tones(grid: &mut Grid, faces: &[u32], fine: f64) -> Tones {
    let mut own: Vec<Vec<Range<usize>>> = vec![Vec::new(); grid.first.len()];
    for (k, &f) in faces.iter().enumerate() {
        // A run that a speck has left to its neighbour has another face's colour: it does not count.
        if f != 0 && grid.faces[k] == f {
            own[f as usize].push(grid.runs.places(k));
        }
    }
    let shown: &Grid = grid;
    let painted: Vec<(Paint, Option<Fan>)> =
        own.par_iter().enumerate().map(|(f, own)| paint(shown, own, f as u32, fine)).collect();
    for (own, (_, fan)) in own.iter().zip(&painted) {
        if let Some(fan) = fan {
            for p in places(own) {
                grid.samples[p].tone = fan.tone(place(grid, p));
            }
        }
    }
    let shown: &Grid = grid;
    let sums = own.par_iter().zip(&painted).map(|(own, (paint, fan))| sums(shown, own, paint, fan.is_some()));
    let sums: Vec<Vec<Sum>> = sums.collect();
    let mut out = Tones { face: vec![], band: vec![], colour: vec![], gradient: vec![], begins: vec![] };
    for (f, ((paint, _), sums)) in painted.into_iter().zip(sums).enumerate() {
        let (gradient, begins) = match paint {
            Paint::Even => (None, vec![]),
            Paint::Gradient(g) => (Some(g), vec![]),
            Paint::Bands(begins) => (None, begins),
        };
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

fn sums(grid: &Grid, own: &[Range<usize>], paint: &Paint, is_fan: bool) -> Vec<Sum> {
    let begins: &[f32] = if let Paint::Bands(begins) = paint { begins } else { &[] };
    let mut sums = vec![([0.0f64; 4], 0.0f64); begins.len() + 1];
    for run in own {
        for s in &grid.samples[run.clone()] {
            let (sum, count) = &mut sums[band(begins, s.tone)];
            (0..4).for_each(|k| sum[k] += f64::from(s.colour[k]));
            *count += 1.0;
        }
    }
    if is_fan { smoothed(&sums) } else { sums }
}

/// Sums of colours and numbers of points by band, each smoothed by a line through the neighbouring bands: bands of a
/// fan are so narrow that facets would show.
fn smoothed(sums: &[Sum]) -> Vec<Sum> {
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
    let mut out = vec![0; grid.samples.len()];
    out.par_chunks_mut(grid.size[0]).enumerate().for_each(|(y, row)| {
        for k in grid.runs.row(y).filter(|&k| faces[k] != 0) {
            let (cell, places) = (first[faces[k] as usize], grid.runs.places(k));
            let begins = &tones.begins[cell + 1..first[faces[k] as usize + 1]];
            let left = places.start - y * grid.size[0];
            for (out, s) in row[left..].iter_mut().zip(&grid.samples[places]) {
                *out = (cell + band(begins, s.tone)) as u32;
            }
        }
    });
    out
}

fn band(begins: &[f32], tone: f32) -> usize {
    begins.partition_point(|&b| b <= tone)
}

/// The places of runs, one after another.
fn places(runs: &[Range<usize>]) -> impl Iterator<Item = usize> {
    runs.iter().cloned().flatten()
}

fn paint(grid: &Grid, own: &[Range<usize>], face: u32, fine: f64) -> (Paint, Option<Fan>) {
    let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
    for run in own {
        for s in &grid.samples[run.clone()] {
            (low, high) = (low.min(s.tone), high.max(s.tone));
        }
    }
    if own.is_empty() || high - low <= EVEN {
        return (Paint::Even, None);
    }
    let count: usize = own.iter().map(Range::len).sum();
    // An odd step: with a divisor in common with the rows, points would all lie in a few columns.
    let tried: Vec<usize> = places(own).step_by((count / TRIED).max(1) | 1).collect();
    if let Some(gradient) = gradient(grid, middle(grid, own), &tried) {
        return (Paint::Gradient(gradient), None);
    }
    let fan = Fan::find(grid, &tried, face);
    let (step, most) = if fan.is_some() { (FAN_STEP, MOST_IN_FAN) } else { (STEP, MOST_BANDS) };
    let wide = ((count as f64).sqrt() / fine) as f32;
    let bands = ((high - low) / step).min(most).min(wide).max(1.0) as usize;
    if bands < 2 {
        return (Paint::Even, None);
    }
    (Paint::Bands((1..bands).map(|k| low + (high - low) * k as f32 / bands as f32).collect()), fan)
}

/// Of the points of a band: the sum of their colours, and their number.
type Sum = ([f64; 4], f64);

/// Some points of a face: position relative to their middle, tone, colour.
struct Tried {
    middle: [f64; 2],
    points: Vec<([f64; 2], f32, [u8; 4])>,
}

fn gradient(grid: &Grid, middle: [f64; 2], tried: &[usize]) -> Option<Gradient> {
    let relative = |&p: &usize| {
        let (s, at) = (&grid.samples[p], place(grid, p));
        ([at[0] - middle[0], at[1] - middle[1]], s.tone, s.colour)
    };
    let tried = Tried { middle, points: tried.iter().map(relative).collect() };
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

/// The middle of all points of a face.
fn middle(grid: &Grid, own: &[Range<usize>]) -> [f64; 2] {
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    for run in own {
        let (first, last, long) = (place(grid, run.start), place(grid, run.end - 1), run.len() as f64);
        sum = [0, 1].map(|k: usize| sum[k] + 0.5 * (first[k] + last[k]) * long);
        count += long;
    }
    sum.map(|s| s / count)
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
