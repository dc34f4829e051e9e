//! Joins ends of segments that fall on one grid point.

use super::search::Clash;
use hlr_exact::Point;

/// Distinct ends, ascending, and per clash the numbers of its two.
pub fn weld(found: &[Clash]) -> (Vec<Point>, Vec<[i32; 2]>) {
    let mut points: Vec<Point> = found.iter().flat_map(|c| c.meeting.ends).collect();
    points.sort_unstable();
    points.dedup();
    let number = |p: &Point| points.partition_point(|q| q < p) as i32;
    let edges = found.iter().map(|c| [number(&c.meeting.ends[0]), number(&c.meeting.ends[1])]).collect();
    (points, edges)
}
