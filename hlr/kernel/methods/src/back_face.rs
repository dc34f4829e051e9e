//! Back-face culling: the sign of C, which is that of the area in the image.
//!
//! With depth away from the viewer, the outward normal (A, B, C) of a face turned toward the viewer has C < 0. In
//! perspective the sign of the plane at the eye decides; the projective map has moved the eye to infinity, before z =
//! -inf, where that sign is the sign of -C again: one test for both.
//!
//! The test is right for closed, consistently oriented solids only; the scene says which polygons belong to one. C = 0
//! is edge-on: such a polygon is never painted, and nothing is divided by its C. A polygon whose lobes cancel because
//! it crosses itself faces neither way, and is kept.

use super::plane::Point;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    Front,
    Back,
    Neither,
}

/// The facing by the total area of all loops; `widest`: twice the area of the largest triangle of three corners.
pub fn facing<'a>(loops: impl Iterator<Item = &'a [Point]>, widest: i64) -> Facing {
    let (mut area, mut around) = (0i128, 0i128);
    let mut corners = 0;
    for l in loops {
        let mut p = &l[l.len() - 1];
        for q in l {
            area += i128::from(p[0]) * i128::from(q[1]) - i128::from(q[0]) * i128::from(p[1]);
            around += i128::from((p[0] - q[0]).abs() + (p[1] - q[1]).abs());
            corners += 1;
            p = q;
        }
    }
    // Rounding moves each corner by half a step at most, so it changes the area by the length of the outline at most.
    let cancels = corners > 3 && area.abs() <= around && 2 * area.abs() < i128::from(widest).abs();
    match area.signum() {
        -1 if !cancels => Facing::Front,
        1 if !cancels => Facing::Back,
        _ => Facing::Neither,
    }
}
