//! Triangles that overlap in (u, v), though they do not in the bent chart in which they were made.
//!
//! The chart stretches u and v, so a straight edge of the chart is bent in (u, v), and may pass a point on the other
//! side. One flip puts most of these right (`flip::upright`). Where the chart changes much within one edge, as at the
//! neck of a torus whose hole is nearly closed, several edges pass the same point.
//!
//! The points are moved from the chart to (u, v) in steps. Wherever a point comes to an edge on its way, that edge is
//! flipped, so the triangles never overlap: a kinetic triangulation.

use super::flip;
use super::plane::{area, side};
use super::progress::Progress;

/// Share of the way in one step: the largest, and the least. A step after which triangles overlap is halved; the next is
/// twice as long again.
const STEPS: [f64; 2] = [0.125, 1.0 / 4096.0];

/// Steps that are tried, so that the time is that of so many looks at each triangle.
const MOST_TRIES: usize = 256;

/// Flips edges so that no triangle is turned over in (u, v). False where that needs steps below the least, or too many.
///
/// `chart`: the same points in the chart, where no triangle is turned over.
pub fn straighten(chart: &[[f64; 2]], uv: &[[f64; 2]], triangles: &mut Vec<[u32; 3]>, steps: &Progress) -> bool {
    let mut twins = flip::twins(triangles);
    let fit = [0, 1].map(|k| onto(range(chart, k), range(uv, k)));
    let mut places = chart.to_vec();
    let (mut passed, [mut step, least]) = (0.0, STEPS);
    for _ in 0..MOST_TRIES {
        let next = f64::min(passed + step, 1.0);
        for ((place, from), to) in places.iter_mut().zip(chart).zip(uv) {
            *place = if next < 1.0 { [0, 1].map(|k| (1.0 - next) * fit[k](from[k]) + next * to[k]) } else { *to };
        }
        steps.steps(triangles.len() as u64);
        let (mut flipped, mut flipped_twins) = (triangles.clone(), twins.clone());
        flip::upright_of_twins(&places, &mut flipped, &mut flipped_twins);
        let at = |i: u32| &places[i as usize];
        let over = |&[a, b, c]: &[u32; 3]| area(at(a), at(b), at(c)) <= 0.0 && side(at(a), at(b), at(c)) < 0.0;
        if !flipped.iter().any(over) {
            (*triangles, twins, passed) = (flipped, flipped_twins, next);
            if passed >= 1.0 {
                return true;
            }
            step = f64::min(2.0 * step, STEPS[0]);
        } else if step > least {
            step *= 0.5;
        } else {
            return false;
        }
    }
    false
}

/// The least and the greatest of one coordinate.
fn range(places: &[[f64; 2]], k: usize) -> [f64; 2] {
    places.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[k]), high.max(p[k])])
}

/// The linear map of one range onto another.
fn onto([low, high]: [f64; 2], [first, last]: [f64; 2]) -> impl Fn(f64) -> f64 {
    let scale = (last - first) / (high - low);
    move |x| first + scale * (x - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_that_passes_several_edges_is_free_again() {
        passes_edges(8);
    }

    #[test]
    fn a_point_that_passes_many_edges_is_free_again() {
        passes_edges(120);
    }

    fn passes_edges(row: u32) {
        // A fan from the lower left corner to a row of points on the right side, and a point below the fan, which
        // rises into it.
        let mut chart = vec![[0.0, 0.0], [1.0, 0.0]];
        chart.extend((0..row).map(|k| [1.0, 0.3 + 0.7 * f64::from(k) / f64::from(row - 1)]));
        chart.extend([[0.0, 1.0], [0.5, 0.1]]);
        // 0 and 1 are the lower corners, then comes the row up to the upper right corner, then the upper left one.
        let (last, left, point) = (row + 1, row + 2, row + 3);
        let mut triangles: Vec<[u32; 3]> = (2..last).map(|k| [0, k, k + 1]).collect();
        triangles.extend([[0, last, left], [0, 1, point], [1, 2, point], [2, 0, point]]);
        let mut uv = chart.clone();
        uv[point as usize] = [0.5, 0.42];
        let area_of = |t: &[u32; 3], at: &[[f64; 2]]| area(&at[t[0] as usize], &at[t[1] as usize], &at[t[2] as usize]);
        assert!(triangles.iter().all(|t| area_of(t, &chart) > 0.0));
        let mut once = triangles.clone();
        flip::upright(&uv, &mut once);
        assert!(once.iter().any(|t| area_of(t, &uv) < 0.0));
        assert!(straighten(&chart, &uv, &mut triangles, &Progress::free()));
        assert!(triangles.iter().all(|t| area_of(t, &uv) >= 0.0));
        assert_eq!(triangles.len(), row as usize + 3);
        let whole: f64 = triangles.iter().map(|t| area_of(t, &uv)).sum();
        assert!((whole - 2.0).abs() < 1e-12);
    }
}
