//! Clips a triangle by the view volume before it is projected.
//!
//! I. E. Sutherland, G. W. Hodgman, "Reentrant polygon clipping", CACM 17, 1974: one plane after another, each keeping
//! the side where its height is not negative. Only triangles that cross the near plane or leave the range of the
//! integer grid must be cut; the raster cuts the rest at the picture's border at no cost.
//!
//! ```text
//!      inside   a ---- x   b outside        x = a + t (b - a), t = h(a) / (h(a) - h(b))
//! ```
//!
//! A new point is always computed from the inner to the outer point: two triangles with a common edge get the same
//! bits.

use super::lens::Lens;
use hlr_brep::geometry::vector::{Vector, along, sub};

/// How far beyond the border, in widths and heights of the picture, faces may reach uncut.
const BEYOND: f64 = 0.25;

/// The part of a triangle, in view coordinates, that may be visible: a convex polygon, empty where there is none.
pub fn cut(corners: &[Vector; 3], lens: &Lens) -> Vec<Vector> {
    let mut polygon = corners.to_vec();
    let near = lens.near();
    if near.is_finite() {
        polygon = half(&polygon, |v| v[2] - near);
    }
    for axis in 0..2 {
        let extent = lens.size[axis] as f64;
        let low = -BEYOND * extent - lens.centre[axis];
        let high = (1.0 + BEYOND) * extent - lens.centre[axis];
        // On the plane x = low: homogeneous x - low w is nought.
        let height = |v: &Vector, bound: f64| {
            let h = lens.homogeneous(v);
            h[axis] - bound * h[2]
        };
        polygon = half(&polygon, |v| height(v, low));
        polygon = half(&polygon, |v| -height(v, high));
    }
    polygon
}

fn half(polygon: &[Vector], height: impl Fn(&Vector) -> f64) -> Vec<Vector> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (ha, hb) = (height(a), height(b));
        if ha >= 0.0 {
            out.push(*a);
        }
        if (ha >= 0.0) != (hb >= 0.0) {
            let (inner, outer, hi, ho) = if ha >= 0.0 { (a, b, ha, hb) } else { (b, a, hb, ha) };
            out.push(along(inner, &sub(outer, inner), hi / (hi - ho)));
        }
    }
    if out.len() < 3 { Vec::new() } else { out }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lens() -> Lens {
        Lens {
            right: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            ahead: [0.0, 0.0, 1.0],
            origin: [0.0; 3],
            scale: 1.0,
            centre: [50.0, 50.0],
            distance: Some(100.0),
            range: [1.0, 1000.0],
            size: [100, 100],
        }
    }

    #[test]
    fn one_corner_behind_the_near_plane_leaves_four() {
        let kept = cut(&[[0.0, 0.0, 10.0], [1.0, 0.0, 10.0], [0.0, 1.0, -5.0]], &lens());
        assert_eq!(kept.len(), 4);
        assert!(kept.iter().all(|v| v[2] >= 1.0 - 1e-12));
    }

    #[test]
    fn nothing_is_left_of_what_lies_behind() {
        assert!(cut(&[[0.0, 0.0, 0.5], [1.0, 0.0, -1.0], [0.0, 1.0, 0.9]], &lens()).is_empty());
    }

    #[test]
    fn what_is_far_beside_the_picture_is_cut_to_its_surroundings() {
        let l = lens();
        let kept = cut(&[[-1e9, -1e9, 50.0], [1e9, -1e9, 50.0], [0.0, 1e9, 50.0]], &l);
        for v in &kept {
            let p = l.place(v);
            assert!(p.iter().all(|c| (-25.1..125.1).contains(c)), "{p:?}");
        }
    }
}
