//! Cylinders, cones, extrusions: straight along v, so that no inner points are needed.
//!
//! The sweep goes along u; no triangle reaches farther in u than the chord whose mountain it is in. On a surface that can be
//! unrolled the gap between surface and triangle is greatest at the triangle's edges: what holds for them holds everywhere.

use super::delaunay::Delaunay;
use super::flip::flip;
use super::outline::Outline;
use super::sweep;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{along, dot, from_line};

/// Where the sweep does not get through, v is made so short that Delaunay's triangles are as narrow in u as they can be.
const FLAT: f64 = 1e-3;
/// What three samples of a curve may miss.
const MARGIN: f64 = 1.1;

/// Triangles and the error that is shown for them.
pub fn triangulate(surface: &Surface, outline: &Outline, deflection: f64) -> Option<(Vec<[u32; 3]>, Vec<u32>, f64)> {
    let (mut triangles, stand_in) = match sweep::triangulate(outline) {
        Some(triangles) => (triangles, (0..outline.len() as u32).collect()),
        None => {
            let [low, high] = outline.bounds();
            let size = [0, 1].map(|k| (high[k] - low[k]).max(f64::MIN_POSITIVE));
            let flat = outline.mapped(|p| [(p[0] - low[0]) / size[0], FLAT * (p[1] - low[1]) / size[1]]);
            let mesh = Delaunay::new(&flat, &[])?;
            (mesh.inside(), mesh.stand_in)
        }
    };
    let error = |a: u32, b: u32| edge_error(surface, outline.uv[a as usize], outline.uv[b as usize]);
    let worst = |triangles: &[[u32; 3]]| {
        let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        // A square root of a comparison: most edges are no wider than one that was measured.
        edges.fold(0.0f64, |most, [a, b]| if a < b { most.max(error(a, b)) } else { most })
    };
    let mut most = worst(&triangles);
    if most > deflection && flip(&outline.uv, &mut triangles, &error, deflection) {
        most = worst(&triangles);
    }
    Some((triangles, stand_in, most))
}

/// How far the surface is from the straight line between two of its points, on the shortest way along it.
fn edge_error(surface: &Surface, a: [f64; 2], b: [f64; 2]) -> f64 {
    let turn = (a[0] - b[0]).abs();
    if turn == 0.0 {
        return 0.0;
    }
    let arc = |angle: f64| 1.0 - (0.5 * angle.min(std::f64::consts::TAU)).cos();
    match surface {
        Surface::Cylinder(_, r) => r.abs() * arc(turn),
        // Unrolled, the line between two generators has the curvature c / x^3 at the distance x from the apex, where it is
        // at right angles to neither; twice integrated, its height is that of 1 / x above its chord.
        Surface::Cone(_, r, sin, cos) => {
            let [one, other] = [a, b].map(|p| (r + p[1] * sin).abs());
            let roots = one.sqrt() + other.sqrt();
            if roots == 0.0 { 0.0 } else { 4.0 * cos.abs() * arc(turn) * one * other / (roots * roots) }
        }
        Surface::Extrusion(way, curve) => {
            let size = dot(way, way);
            let flat = |u: f64| {
                let p = curve.point(u);
                along(&p, way, -dot(&p, way) / size)
            };
            let (from, to) = (flat(a[0]), flat(b[0]));
            let height = |t: f64| from_line(&flat(a[0] + t * (b[0] - a[0])), &from, &to);
            MARGIN * [0.25, 0.5, 0.75].map(height).into_iter().fold(0.0, f64::max)
        }
        _ => 0.0,
    }
}
