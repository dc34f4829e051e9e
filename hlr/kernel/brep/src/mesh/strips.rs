//! Faces whose border is a rectangle in the chart: rows of inner points, triangulated directly from row to row.
//!
//! ```text
//!    o--o---o---o--o        o  border     .  rows
//!    |/ .   .   .  \o
//!    o .  .   .   . |       From the ends of the rows to the border goes a ring of four strips.
//!    |\ .   .   .  /o
//!    o--o-o---o-o--o
//! ```

use super::lattice::{self, Level};
use super::outline::Outline;
use super::plane::area;
use super::progress::Progress;
use super::spacing::Field;

/// Share of the smallest spacing by which points of the border may be off the rectangle's sides.
const OFF: f64 = 0.02;

pub struct Strips {
    /// Points of the rows, numbered after those of the outline.
    pub inner: Vec<[f64; 2]>,
    /// Counterclockwise in the chart.
    pub triangles: Vec<[u32; 3]>,
    /// The first `loose` triangles may violate the Delaunay condition.
    pub loose: usize,
}

/// The mesh of such a face. None where the border is no rectangle, the spacing changes along rows, or something lies in
/// a strip.
pub fn strips(field: &Field, chart: &Outline, most: usize, steps: &Progress) -> Option<Strips> {
    let counts = field.counts();
    let (i, j) = ([0, counts[0]], [0, counts[1]]);
    if lattice::is_uneven(field, i, j) {
        return None;
    }
    let [bottom, right, top, left] = sides(chart, OFF * field.least())?;
    let levels = lattice::levels(field, i, j)?;
    let mut places = chart.uv.clone();
    let mut rows: Vec<Vec<u32>> = Vec::with_capacity(levels.len());
    for level in &levels {
        let row = row(chart.bounds(), level, places.len(), &mut places);
        if !row.is_empty() {
            rows.push(row);
        }
        if places.len() > most {
            return None;
        }
    }
    let mut strip = Strip { places: &places, steps, triangles: Vec::with_capacity(2 * places.len()) };
    let reversed = |side: &[u32]| side.iter().rev().copied().collect::<Vec<_>>();
    let mut loose = usize::MAX;
    match (rows.first(), rows.last()) {
        (Some(first), Some(last)) => {
            let starts: Vec<u32> = rows.iter().map(|row| row[0]).collect();
            let ends: Vec<u32> = rows.iter().map(|row| row[row.len() - 1]).collect();
            strip.zip(&bottom, first)?;
            strip.zip(&right, &ends)?;
            strip.zip(&top, &reversed(last))?;
            strip.zip(&left, &reversed(&starts))?;
            let even = |pair: &[Vec<u32>]| pair[0].len().abs_diff(pair[1].len()) <= 1;
            for pair in rows.windows(2).filter(|pair| !even(pair)) {
                strip.zip(&pair[0], &pair[1])?;
            }
            loose = strip.triangles.len();
            for pair in rows.windows(2).filter(|pair| even(pair)) {
                strip.zip(&pair[0], &pair[1])?;
            }
        }
        _ if left.len() == 2 && right.len() == 2 => strip.zip(&bottom, &reversed(&top))?,
        _ if bottom.len() == 2 && top.len() == 2 => strip.zip(&right, &reversed(&left))?,
        _ => return None,
    }
    let triangles = strip.triangles;
    Some(Strips { inner: places.split_off(chart.len()), loose: loose.min(triangles.len()), triangles })
}

/// Appends the points of a row to `places` and returns their numbers.
fn row([low, high]: [[f64; 2]; 2], level: &Level, first: usize, places: &mut Vec<[f64; 2]>) -> Vec<u32> {
    let margin = lattice::MARGIN * level.spacing;
    if level.y - low[1] < margin || high[1] - level.y < margin {
        return Vec::new();
    }
    let xs = lattice::across([low[0], high[0]], false, level);
    let free = |x: &f64| x - low[0] >= margin && high[0] - x >= margin;
    places.extend(xs.filter(free).map(|x| [x, level.y]));
    (first as u32..places.len() as u32).collect()
}

/// The border's points on the lower, right, upper and left side, each from corner to corner, counterclockwise.
fn sides(chart: &Outline, off: f64) -> Option<[Vec<u32>; 4]> {
    let [low, high] = chart.bounds();
    let at = |i: u32| chart.uv[i as usize];
    let ends = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let mut corners = [(f64::INFINITY, 0u32); 4];
    let mut count = 0;
    for i in chart.chords() {
        count += 1;
        let p = at(i);
        for (corner, end) in corners.iter_mut().zip(&ends) {
            let apart = (p[0] - end[0]).abs().max((p[1] - end[1]).abs());
            if apart < corner.0 {
                *corner = (apart, i);
            }
        }
    }
    if corners.iter().any(|c| c.0 > off) {
        return None;
    }
    let mut found = [const { Vec::new() }; 4];
    let mut passed = 0;
    for (k, side) in found.iter_mut().enumerate() {
        let (start, stop) = (corners[k].1, corners[(k + 1) % 4].1);
        // Coordinates along the side and across it.
        let (along, across) = (k % 2, 1 - k % 2);
        let sense = if k < 2 { 1.0 } else { -1.0 };
        let mut last = start;
        side.push(last);
        while last != stop {
            let next = chart.after(last);
            passed += 1;
            let (p, q) = (at(last), at(next));
            if passed > count || sense * (q[along] - p[along]) <= 0.0 || (q[across] - ends[k][across]).abs() > off {
                return None;
            }
            side.push(next);
            last = next;
        }
    }
    (passed == count).then_some(found)
}

struct Strip<'a> {
    places: &'a [[f64; 2]],
    steps: &'a Progress<'a>,
    triangles: Vec<[u32; 3]>,
}

impl Strip<'_> {
    /// Triangles between two chains; the strip is to the left of a and to the right of b. Of the two triangles that can
    /// come next, the one is taken whose circumcircle does not contain the other's corner. None where a triangle would
    /// be turned over.
    fn zip(&mut self, a: &[u32], b: &[u32]) -> Option<()> {
        let at = |i: u32| &self.places[i as usize];
        let (mut i, mut j) = (0, 0);
        while i + 1 < a.len() || j + 1 < b.len() {
            self.steps.step();
            let (p, q) = (at(a[i]), at(b[j]));
            let along = |k: usize| a.get(k).map(|&k| at(k));
            let (r, s) = (along(i + 1), b.get(j + 1).map(|&k| at(k)));
            let free = [r.is_some_and(|r| area(p, r, q) > 0.0), s.is_some_and(|s| area(p, s, q) > 0.0)];
            let first = match (free, r, s) {
                ([true, true], Some(r), Some(s)) => !within(p, r, q, s),
                ([true, _], ..) => true,
                ([_, true], ..) => false,
                _ => return None,
            };
            if first {
                self.triangles.push([a[i], a[i + 1], b[j]]);
                i += 1;
            } else {
                self.triangles.push([a[i], b[j + 1], b[j]]);
                j += 1;
            }
        }
        Some(())
    }
}

/// Whether s is inside the circle through p, r and q, which are counterclockwise; rounded.
fn within(p: &[f64; 2], r: &[f64; 2], q: &[f64; 2], s: &[f64; 2]) -> bool {
    let [a, b, c] = [p, r, q].map(|x| [x[0] - s[0], x[1] - s[1]]);
    let square = |x: [f64; 2]| x[0] * x[0] + x[1] * x[1];
    let cross = |x: [f64; 2], y: [f64; 2]| x[0] * y[1] - x[1] * y[0];
    square(a) * cross(b, c) + square(b) * cross(c, a) + square(c) * cross(a, b) > 0.0
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use super::*;
    use crate::geometry::surface::Surface;
    use crate::mesh::tests::shapes::{circle, frame, loops, surface};

    /// The chart of a loop, and the strips made in it.
    fn made(surface: &Surface, places: Vec<[f64; 2]>) -> (Outline, Option<Strips>) {
        let face = loops(surface, &[places]);
        let outline = Outline::new(&face, |_, _, _| ()).unwrap();
        let steps = Progress::free();
        let field = Field::new(surface, outline.bounds(), 0.01, 0.5, false, &steps).unwrap();
        let chart = outline.mapped(|uv| field.to_chart(uv));
        let strips = strips(&field, &chart, 1_000_000, &steps);
        (chart, strips)
    }

    #[test]
    fn strips_fill_a_rectangle() {
        let torus = surface(5, &[10.0, 3.0]);
        let sphere = surface(4, &[10.0]);
        for (surface, places) in [
            (&torus, frame([0.0, 0.0], [TAU, TAU], 90, 40)),
            (&torus, frame([0.1, 0.2], [0.5, FRAC_PI_2], 7, 13)),
            // A narrow face: strips without rows.
            (&torus, frame([0.0, 0.0], [TAU, 0.01], 90, 1)),
            (&torus, frame([0.0, 0.0], [0.01, TAU], 1, 40)),
            (&sphere, frame([0.3, -1.2], [1.8, 1.3], 30, 40)),
        ] {
            let (chart, strips) = made(surface, places);
            let Strips { inner, triangles, loose } = strips.unwrap();
            assert!(loose <= triangles.len());
            assert_eq!(triangles.len(), 2 * inner.len() + chart.len() - 2);
            let at = |i: u32| chart.uv.iter().chain(&inner).nth(i as usize).copied().unwrap();
            let areas: Vec<f64> = triangles.iter().map(|t| area(&at(t[0]), &at(t[1]), &at(t[2]))).collect();
            let [low, high] = chart.bounds();
            let whole = 2.0 * (high[0] - low[0]) * (high[1] - low[1]);
            assert!(areas.iter().all(|a| *a > 0.0));
            assert!((areas.iter().sum::<f64>() / whole - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_is_no_rectangle_has_no_strips() {
        let torus = surface(5, &[10.0, 3.0]);
        assert!(made(&torus, circle([1.0, 1.0], 0.5, 40, true)).1.is_none());
        let mut dented = frame([0.0, 0.0], [1.0, 1.0], 10, 10);
        dented[5][1] += 0.1;
        assert!(made(&torus, dented).1.is_none());
    }
}
