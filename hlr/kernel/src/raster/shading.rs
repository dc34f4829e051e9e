//! Values along spans: colours (Gouraud 1971) or normals (Phong 1975), from the corners along the edges, from the edges along
//! the row.
//!
//! The textbook interpolates on the screen, where equal steps are not equal steps on the surface: in perspective the far half
//! of a polygon gets too little. Value / w and 1 / w are linear on the screen, so their quotient is right (Blinn 1992).
//!
//! ```text
//!        1 +                row y: left = between 1 and 3, right = between 1 and 2, then from left to right
//!         / \
//!    left/---\right         textbook: of the values;  correct: of value / w and of 1 / w
//!       /     \
//!    3 +-------+ 2
//! ```

use super::plane::centre;
use super::screen::{NONE, Screen};
use super::watch::Watch;

/// Per pixel of `frame`, the value at its centre; NaN for the background. None where there was no time.
pub fn shade(screen: &Screen, frame: &[u32], correct: bool, watch: &Watch) -> Option<Vec<[f64; 3]>> {
    let width = screen.width as usize;
    let mut out = vec![[f64::NAN; 3]; frame.len()];
    for (at, &number) in frame.iter().enumerate() {
        if watch.over() {
            return None;
        }
        if number != NONE {
            out[at] = value(screen, number, (at % width) as i64, (at / width) as i64, correct);
        }
    }
    Some(out)
}

/// The edges left and right of a pixel in its row, and the value between them.
fn value(screen: &Screen, number: u32, column: i64, row: i64, correct: bool) -> [f64; 3] {
    let facet = &screen.facets[number as usize];
    let (x, y) = (centre(column) as f64, centre(row) as f64);
    let mut left: Option<(f64, [f64; 4])> = None;
    let mut right: Option<(f64, [f64; 4])> = None;
    for l in &screen.loops[facet.loops.start as usize..facet.loops.end as usize] {
        for i in l.clone() {
            let next = if i + 1 == l.end { l.start } else { i + 1 };
            let (p, q) = (&screen.points[i as usize], &screen.points[next as usize]);
            let (py, qy) = (p[1] as f64, q[1] as f64);
            if (py <= y) == (qy <= y) {
                continue;
            }
            let t = (y - py) / (qy - py);
            let at = p[0] as f64 + t * (q[0] - p[0]) as f64;
            let value = between(&screen.values[i as usize], &screen.values[next as usize], t, correct);
            if at <= x && left.is_none_or(|(l, _)| at > l) {
                left = Some((at, value));
            }
            if at > x && right.is_none_or(|(r, _)| at < r) {
                right = Some((at, value));
            }
        }
    }
    let out = match (left, right) {
        (Some((l, from)), Some((r, to))) => between(&from, &to, (x - l) / (r - l), correct),
        (Some((_, only)), None) | (None, Some((_, only))) => only,
        (None, None) => [f64::NAN; 4],
    };
    [out[0], out[1], out[2]]
}

/// Between two values with their 1 / w: on the screen, or on the surface.
fn between(p: &[f64; 4], q: &[f64; 4], t: f64, correct: bool) -> [f64; 4] {
    let w = p[3] + (q[3] - p[3]) * t;
    let share = if correct { t * q[3] / w } else { t };
    let at = |k: usize| p[k] + (q[k] - p[k]) * share;
    [at(0), at(1), at(2), w]
}
