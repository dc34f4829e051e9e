//! Where the coarse mesh may miss the plane: a surface or an edge that bulges through it between corners of the mesh.
//!
//! ```text
//!         .--.
//!  ------/----\------   the plane
//!   x---'      '---x    corners of the mesh
//! ```

use super::edge_pieces::Pieces;
use super::plane::Plane;
use crate::edges::Polyline;
use crate::geometry::surface::Surface;
use crate::geometry::vector::Vector;
use crate::mesh::area;
use crate::shapes::{Edge, Face};
use crate::tessellate::MeshedFace;

/// Places in a triangle that are looked at, and along a chord.
const IN_TRIANGLE: [[f64; 3]; 7] = {
    let (third, half, far, near) = (1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0 / 6.0);
    [
        [third, third, third],
        [half, half, 0.0],
        [0.0, half, half],
        [half, 0.0, half],
        [far, near, near],
        [near, far, near],
        [near, near, far],
    ]
};
const ALONG_CHORD: [f64; 7] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];
/// Of the extent of a triangle in (u, v), and how many.
const FIRST_STEP: f64 = 0.2;
const STEPS: usize = 24;

/// Whether the mesh of a face misses the plane somewhere. Beside lines at which it passes the plane, the surface may lie on
/// the other side of it than the mesh: there, nothing is missed.
pub fn misses(face: &Face, found: &MeshedFace, plane: &Plane, deflection: f64) -> bool {
    let Some(surface) = face.surface.as_ref().filter(|surface| !matches!(surface, Surface::Plane(_))) else {
        return false;
    };
    let mesh = &found.mesh;
    let heights: Vec<f64> = mesh.points.iter().map(|p| plane.height(p)).collect();
    let beyond = |i: &u32| heights[*i as usize] > plane.near;
    let passes = |t: &[u32; 3]| t.iter().any(beyond) && !t.iter().all(beyond);
    let mut beside = vec![false; heights.len()];
    mesh.triangles.iter().filter(|t| passes(t)).flatten().for_each(|&i| beside[i as usize] = true);
    mesh.triangles.iter().any(|t| {
        let far = t.iter().all(|&i| heights[i as usize].abs() > deflection);
        if far || t.iter().any(|&i| beside[i as usize]) {
            return false;
        }
        reaches_across(surface, t.map(|i| mesh.uv[i as usize]), beyond(&t[0]), plane)
    })
}

/// Whether a surface reaches across the plane within a triangle: from the place that comes closest of those looked at, a
/// search goes on in ever smaller steps.
fn reaches_across(surface: &Surface, corners: [[f64; 2]; 3], beyond: bool, plane: &Plane) -> bool {
    let rise = |uv: [f64; 2]| plane.height(&surface.point(uv)) * if beyond { -1.0 } else { 1.0 };
    let places = IN_TRIANGLE.iter().map(|share| [0, 1].map(|k| (0..3).map(|c| share[c] * corners[c][k]).sum()));
    let mut best = ([0.0; 2], f64::NEG_INFINITY);
    for uv in places {
        let height = rise(uv);
        if height > best.1 {
            best = (uv, height);
        }
    }
    let is_within = |uv: [f64; 2]| (0..3).all(|k| area(&[corners[k], corners[(k + 1) % 3], uv]) >= 0.0);
    let extent = |k: usize| {
        let (low, high) = corners.iter().fold((f64::MAX, f64::MIN), |(l, h), uv| (l.min(uv[k]), h.max(uv[k])));
        high - low
    };
    let mut step = [extent(0), extent(1)].map(|extent| FIRST_STEP * extent);
    for _ in 0..STEPS {
        if best.1 > plane.near {
            return true;
        }
        let before = best.1;
        for (k, sense) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            let mut uv = best.0;
            uv[k] += sense * step[k];
            let height = if is_within(uv) { rise(uv) } else { f64::NEG_INFINITY };
            if height > best.1 {
                best = (uv, height);
            }
        }
        if best.1 <= before {
            step = step.map(|step| 0.5 * step);
        }
    }
    best.1 > plane.near
}

/// The same of the polyline of an edge.
pub fn edge_misses(edge: &Edge, line: &Polyline, pieces: &Pieces, plane: &Plane, deflection: f64) -> bool {
    let Some(curve) = &edge.curve else { return false };
    let beside = |chord: usize| pieces.breaks.iter().any(|b| b.chord.abs_diff(chord) <= 1);
    (0..line.points.len() - 1).filter(|&chord| !beside(chord)).any(|chord| {
        let heights = [chord, chord + 1].map(|k| plane.height(&line.points[k]));
        let [from, to] = [line.parameters[chord], line.parameters[chord + 1]];
        let near = heights.iter().any(|height| height.abs() <= deflection);
        let side = heights[0] > plane.near;
        near && ALONG_CHORD.iter().any(|share| is_across(side, &curve.point(from + share * (to - from)), plane))
    })
}

/// Whether a point lies on the other side of the plane, and not upon it.
fn is_across(beyond: bool, point: &Vector, plane: &Plane) -> bool {
    let height = plane.height(point);
    if beyond { height < -plane.near } else { height > plane.near }
}
