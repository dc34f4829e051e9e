//! The point of a triangle that is visible at a sample, found on the unrounded triangle.
//!
//! M. Olano, T. Greer, "Triangle scan conversion using 2D homogeneous coordinates", Graphics Hardware 1997: with the
//! corners' homogeneous coordinates h_i = (x w, y w, w) as columns of H, the place p = (x, y, 1) is H m, and m / sum(m)
//! are the barycentric coordinates in the model: perspective-correct, also where a corner lies behind the eye, so that
//! what was cut by the near plane is interpolated between its true corners.

use super::Model;
use super::lens::Lens;
use hlr_brep::geometry::vector::{Vector, cross, dot, sub, unit};

#[derive(Clone, Debug)]
pub struct Surface {
    /// Barycentric coordinates, up to a common factor, as functions of (x, y, 1) in pixels from the lens's centre.
    pub rows: [Vector; 3],
    corners: [Vector; 3],
    pub normals: [[f32; 3]; 3],
    /// Whether the triangle is seen from outside.
    pub front: bool,
}

/// The unit normals at the corners of a triangle, all equal where it is flat.
#[inline(always)]
pub fn normals(model: &Model, triangle: u32) -> [[f32; 3]; 3] {
    let ids = model.corner[triangle as usize];
    if ids[0] >= 0 {
        return [model.normals[ids[0] as usize], model.normals[ids[1] as usize], model.normals[ids[2] as usize]];
    }
    let [a, b, c] = model.triangles[triangle as usize].map(|i| &model.points[i as usize]);
    let n = unit(&cross(&sub(b, a), &sub(c, a))).unwrap_or([0.0; 3]);
    [[n[0] as f32, n[1] as f32, n[2] as f32]; 3]
}

impl Surface {
    pub fn new(model: &Model, lens: &Lens, triangle: u32) -> Surface {
        let corners = model.triangles[triangle as usize].map(|i| model.points[i as usize]);
        let h = corners.map(|p| lens.homogeneous(&lens.view(&p)));
        let rows = [cross(&h[1], &h[2]), cross(&h[2], &h[0]), cross(&h[0], &h[1])];
        // With y down, a triangle that is counter-clockwise to the viewer has a negative determinant.
        let turn = dot(&h[0], &rows[0]);
        // Scaled to about one where possible, so that single precision holds their products.
        let share = if turn == 0.0 { 1.0 } else { 1.0 / turn };
        let normals = normals(model, triangle);
        Surface { rows: rows.map(|r| r.map(|c| c * share)), corners, normals, front: turn < 0.0 }
    }

    /// The barycentric coordinates up to a common factor.
    #[inline(always)]
    fn shares(&self, place: [f64; 2]) -> [f64; 3] {
        // Clamped at zero: the snapped triangle owns the sample, so only rounding makes one negative.
        let at = |r: &Vector| {
            let v = r[0] * place[0] + r[1] * place[1] + r[2];
            if v > 0.0 { v } else { 0.0 }
        };
        [at(&self.rows[0]), at(&self.rows[1]), at(&self.rows[2])]
    }

    /// Barycentric coordinates of the visible point at a position, in pixels from the lens's centre.
    #[inline(always)]
    pub fn weights(&self, place: [f64; 2]) -> [f32; 3] {
        let [a, b, c] = self.shares(place);
        let sum = a + b + c;
        if sum > 0.0 {
            let share = 1.0 / sum;
            [(a * share) as f32, (b * share) as f32, (c * share) as f32]
        } else {
            [1.0 / 3.0; 3]
        }
    }

    /// The unit normal, on the side from which the triangle is seen.
    #[inline(always)]
    pub fn normal(&self, w: [f32; 3]) -> [f32; 3] {
        let n = &self.normals;
        let at = |k: usize| w[0] * n[0][k] + w[1] * n[1][k] + w[2] * n[2][k];
        let (x, y, z) = (at(0), at(1), at(2));
        let length = (x * x + y * y + z * z).sqrt();
        if length == 0.0 {
            return [0.0; 3];
        }
        let share = if self.front { 1.0 / length } else { -1.0 / length };
        [x * share, y * share, z * share]
    }

    pub fn point(&self, w: [f32; 3]) -> Vector {
        let [a, b, c] = &self.corners;
        let w = w.map(f64::from);
        [0, 1, 2].map(|k| w[0] * a[k] + w[1] * b[k] + w[2] * c[k])
    }
}
