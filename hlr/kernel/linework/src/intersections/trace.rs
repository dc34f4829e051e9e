//! The curves of all lines, from the points where the meshes cross.

use rayon::prelude::*;

use super::common_point::{Near, common};
use super::line::curve;
use super::{Crossed, Found, Sheets};
use hlr_brep::geometry::vector::Vector;

/// The points on the true lines, and the curve of each line: None where one of its faces has no surface, where both are
/// planar, or where the surfaces are so nearly tangent that no line can be told. Lines of planar faces keep their points,
/// except for ends that they share with a curve. Incomplete if `stopped` returned true.
pub fn curves(
    sheets: &Sheets,
    crossed: &Crossed,
    stopped: &(dyn Fn() -> bool + Sync),
) -> (Vec<Vector>, Vec<Option<Found>>) {
    let moved = moved(sheets, crossed, stopped);
    let found: Vec<Option<Found>> = (0..crossed.offsets.len() - 1)
        .into_par_iter()
        .map(|i| if stopped() { None } else { curve(sheets, crossed, &moved, i) })
        .collect();
    let mut points = crossed.points.to_vec();
    for (i, found) in found.iter().enumerate() {
        let Some(found) = found else { continue };
        crossed.nodes(i).zip(&found.points).for_each(|(node, point)| points[node] = *point);
    }
    (points, found)
}

/// Each point moved onto all surfaces that meet there; None where it cannot be.
fn moved(sheets: &Sheets, crossed: &Crossed, stopped: &(dyn Fn() -> bool + Sync)) -> Vec<Option<Vector>> {
    let (first, around) = segments_of_points(crossed);
    let one = |p: usize| {
        if stopped() {
            return None;
        }
        let mut known: Vec<i32> = Vec::new();
        let mut near: Vec<Near> = Vec::new();
        for t in around[first[p]..first[p + 1]].iter().flat_map(|&s| crossed.triangles[s as usize]) {
            let face = sheets.triangle_face[t as usize];
            if known.contains(&face) {
                continue;
            }
            known.push(face);
            let Some((face, uv)) = sheets.place(t, &crossed.points[p]) else { continue };
            near.push(Near { face, uv });
        }
        common(&mut near, &crossed.points[p], sheets.deflection)
    };
    (0..crossed.points.len()).into_par_iter().map(one).collect()
}

/// Per point the segments that end there: where each point's begin, and the segments.
fn segments_of_points(crossed: &Crossed) -> (Vec<usize>, Vec<u32>) {
    let mut first = vec![0; crossed.points.len() + 1];
    crossed.segments.iter().flatten().for_each(|&p| first[p as usize + 1] += 1);
    for p in 0..crossed.points.len() {
        first[p + 1] += first[p];
    }
    let (mut next, mut around) = (first.clone(), vec![0; 2 * crossed.segments.len()]);
    for (s, ends) in (0..).zip(crossed.segments) {
        for &p in ends {
            around[next[p as usize]] = s;
            next[p as usize] += 1;
        }
    }
    (first, around)
}
