//! Joins ends of segments that fall on one grid point.

use rayon::prelude::*;

use super::search::Clash;
use hlr_exact::Point;

/// With fewer segments a second thread gains nothing.
const ALONE: usize = 1 << 10;

/// Distinct ends, ascending, and per clash the numbers of its two.
pub fn weld(found: &[Clash]) -> (Vec<Point>, Vec<[i32; 2]>) {
    let mut points: Vec<Point> = found.iter().flat_map(|c| c.meeting.ends).collect();
    points.par_sort_unstable();
    points.dedup();
    let number = |p: &Point| points.partition_point(|q| q < p) as i32;
    let edges = found
        .par_iter()
        .with_min_len(ALONE)
        .map(|c| [number(&c.meeting.ends[0]), number(&c.meeting.ends[1])])
        .collect();
    (points, edges)
}
