//! Faces that are straight along u or v (planes, cylinders, cones, extrusions, and splines like these): no inner
//! points.
//!
//! The sweep goes along the other parameter. Along it no triangle extends beyond the chord over which it lies (its
//! mountain, see `sweep`). On a developable surface the gap between surface and triangle is greatest at the triangle's
//! edges, so a bound for the edges holds everywhere.

use super::delaunay::Delaunay;
use super::flip::{flip, slim_in_plane, without_needles};
use super::outline::Outline;
use super::progress::Progress;
use super::sweep;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{along, cross, dot, from_line, sub, unit};
use hlr_exact::elementary::cos;

/// Factor on v for Delaunay triangulation, where the sweep fails: triangles become as narrow in u as possible.
const FLAT: f64 = 1e-3;
/// Factor on the largest value of a parabola through three gaps along an edge: the true largest gap may exceed it.
const MARGIN: f64 = 1.02;

/// The parameter, u (0) or v (1), along which a surface is straight with a constant normal. On a plane it is v.
pub fn straight_along(surface: &Surface) -> Option<usize> {
    match surface {
        Surface::Plane(_) | Surface::Cylinder(..) | Surface::Cone(..) | Surface::Extrusion(..) => Some(1),
        Surface::Spline(s) => s.unrolls_along(),
        _ => None,
    }
}

/// Triangles, stand-ins of the outline's points, and a bound of the error.
pub fn triangulate(surface: &Surface, outline: &Outline, deflection: f64, steps: &Progress) -> Option<Triangles> {
    if straight_along(surface) == Some(0) {
        let (mut triangles, stand_in, error) =
            upright(surface, &outline.mapped(|[u, v]| [v, u]), true, deflection, steps)?;
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
        return Some((triangles, stand_in, error));
    }
    upright(surface, outline, false, deflection, steps)
}

type Triangles = (Vec<[u32; 3]>, Vec<u32>, f64);

/// Steps for which looking at one edge on a spline surface counts: eight points of the surface.
const SPLINE_STEPS: u64 = 256;

/// `swapped`: the outline has (v, u) in place of (u, v).
fn upright(
    surface: &Surface,
    outline: &Outline,
    swapped: bool,
    deflection: f64,
    steps: &Progress,
) -> Option<Triangles> {
    let (mut triangles, stand_in) = match sweep::triangulate(outline, steps) {
        Some(triangles) => (triangles, (0..outline.len() as u32).collect()),
        None => {
            let [low, high] = outline.bounds();
            let size = [0, 1].map(|k| (high[k] - low[k]).max(f64::MIN_POSITIVE));
            let flat = outline.mapped(|p| [(p[0] - low[0]) / size[0], FLAT * (p[1] - low[1]) / size[1]]);
            let mesh = Delaunay::new(&flat, &[], steps)?;
            (mesh.triangles, mesh.stand_in)
        }
    };
    if let Surface::Plane(_) = surface {
        without_needles(&mut triangles, slim_in_plane(&outline.uv), |_| true);
        return Some((triangles, stand_in, 0.0));
    }
    let cost = if let Surface::Spline(_) = surface { SPLINE_STEPS } else { 1 };
    let error = |a: u32, b: u32| {
        steps.steps(cost);
        edge_error(surface, outline.uv[a as usize], outline.uv[b as usize], swapped)
    };
    let worst = |triangles: &[[u32; 3]]| {
        let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        edges.fold(0.0f64, |most, [a, b]| if a < b { most.max(error(a, b)) } else { most })
    };
    // The parameters of a spline are no lengths: its needles are looked for in space, when the mesh is done.
    if !matches!(surface, Surface::Spline(_)) {
        // Both new triangles begin with the new edge.
        without_needles(&mut triangles, slim_in_plane(&outline.uv), |[[a, b, _], _]| error(a, b) <= deflection);
    }
    let mut most = worst(&triangles);
    if most > deflection && flip(&outline.uv, &mut triangles, &error, deflection) {
        most = worst(&triangles);
    }
    Some((triangles, stand_in, most))
}

/// Largest distance of the surface from the straight line between two of its points, measured along the shortest path
/// between them on the surface.
fn edge_error(surface: &Surface, a: [f64; 2], b: [f64; 2], swapped: bool) -> f64 {
    let turn = (a[0] - b[0]).abs();
    if turn == 0.0 {
        return 0.0;
    }
    let arc = |angle: f64| 1.0 - cos(0.5 * angle.min(std::f64::consts::TAU));
    match surface {
        Surface::Cylinder(_, r) => r.abs() * arc(turn),
        // Unrolled, the line between two generators has the curvature c / x^3 at the distance x from the apex, where it
        // is at right angles to neither; twice integrated, its height is that of 1 / x above its chord.
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
            MARGIN * peak([0.25, 0.5, 0.75].map(height))
        }
        // The distance between the edge and the rulings of the surface that it passes.
        Surface::Spline(s) => {
            let at = |[x, y]: [f64; 2]| surface.point(if swapped { [y, x] } else { [x, y] });
            let (_, [low, high], _) = s.knots(usize::from(!swapped));
            let (from, to) = (at(a), at(b));
            let edge = sub(&to, &from);
            let apart = |t: f64| {
                let x = a[0] + t * (b[0] - a[0]);
                let (p, q) = (at([x, low]), at([x, high]));
                let line = sub(&q, &p);
                if dot(&edge, &edge) <= 1e-24 * dot(&line, &line) {
                    return 0.0; // within an apex
                }
                let n = cross(&edge, &line);
                let parallel = dot(&n, &n) <= 1e-18 * dot(&edge, &edge) * dot(&line, &line);
                let n = if parallel { None } else { unit(&n) };
                n.map_or_else(|| from_line(&p, &from, &to), |n| dot(&n, &sub(&p, &from)).abs())
            };
            MARGIN * peak([0.25, 0.5, 0.75].map(apart))
        }
        _ => 0.0,
    }
}

/// Greatest of three values at equal distances and of the parabola through them.
fn peak([a, b, c]: [f64; 3]) -> f64 {
    let (most, bend) = (a.max(b).max(c), 2.0 * b - a - c);
    if bend > 0.0 && (c - a).abs() < 2.0 * bend { most.max(b + (c - a) * (c - a) / (8.0 * bend)) } else { most }
}
