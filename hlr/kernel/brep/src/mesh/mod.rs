//! The mesh of one face from its loops, in the parameter plane of its surface.

mod check;
mod crossing;
#[allow(dead_code)]
mod delaunay;
mod flip;
mod outline;
#[allow(dead_code)]
mod plane;
mod ruled;
mod sweep;

use crate::geometry::surface::Surface;
use outline::Outline;

/// A point of a loop: a corner of an edge's polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// On the surface. Of a periodic surface the loop goes on without a jump; its last point may be a period away from
    /// its first one.
    ///
    /// Neighbours with one node are a pole: they differ in (u, v) only, and the mesh may have points between them.
    pub uv: [f64; 2],
    /// In space, in the surface's frame.
    pub point: [f64; 3],
    /// Its number among the points of all edges: one place, one node, whatever face it is seen from.
    pub node: u32,
}

/// The border of a face: closed loops, the first point not repeated at the end. The inside is to the left in (u, v).
#[derive(Clone, Debug, PartialEq)]
pub struct FaceLoops {
    pub loops: Vec<Vec<LoopPoint>>,
    /// Of u and v; 0 where the surface is not periodic.
    pub periods: [f64; 2],
}

/// Triangles of a face. The loops' points come first, in their order; inner points follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceMesh {
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<[f64; 3]>,
    /// Of the loops' points; and of points that were added on poles, which follow these.
    pub nodes: Vec<u32>,
    /// Counterclockwise in (u, v).
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals du x dv.
    pub normals: Vec<[f64; 3]>,
}

/// Why a face has no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// Chords that cross: loop, chord, loop, chord.
    Crossing(Vec<[usize; 4]>),
    /// A loop that does not close in (u, v), or encloses nothing.
    Open,
    /// The surface has no normal, or no size, where one is needed.
    Degenerate,
    /// The chord error that could be shown, where that is above what was asked.
    NotCertified(f64),
}

/// The mesh of a face: chord error at most `deflection` in the surface's unit, at most `angle` radians between
/// neighbouring normals.
pub fn mesh_face(surface: &Surface, loops: &FaceLoops, deflection: f64, angle: f64) -> Result<FaceMesh, Fault> {
    let _ = angle;
    let (outline, made) = match surface {
        Surface::Plane(_) => {
            let outline = Outline::new(loops, |_, _, _| ())?;
            let made = ruled::triangulate(surface, &outline, deflection);
            (outline, made)
        }
        Surface::Cylinder(..) | Surface::Cone(..) | Surface::Extrusion(..) => {
            let mut turns: Vec<f64> = loops.loops.iter().flatten().map(|p| p.uv[0]).collect();
            turns.sort_unstable_by(f64::total_cmp);
            turns.dedup();
            let outline = Outline::new(loops, |from, to, shares| {
                let share = |u: &f64| (u - from[0]) / (to[0] - from[0]);
                shares.extend(turns.iter().map(share).filter(|t| *t > 0.0 && *t < 1.0));
                shares.sort_unstable_by(f64::total_cmp);
            })?;
            let made = ruled::triangulate(surface, &outline, deflection);
            (outline, made)
        }
        _ => return Err(Fault::Degenerate),
    };
    let sound = made.filter(|(triangles, stand_in, _)| check::is_sound(&outline, &outline.uv, stand_in, triangles));
    let Some((triangles, stand_in, error)) = sound else { return Err(why(&outline)) };
    if stand_in.iter().zip(&outline.nodes).any(|(&i, &node)| outline.nodes[i as usize] != node) {
        return Err(Fault::Degenerate);
    }
    if error > deflection * (1.0 + ROUNDING) {
        return Err(Fault::NotCertified(error));
    }
    Ok(finish(surface, &outline, triangles))
}

const ROUNDING: f64 = 1e-9;

/// Why loops could not be filled.
fn why(outline: &Outline) -> Fault {
    let crossed = crossing::crossings(outline);
    if crossed.is_empty() {
        return Fault::Open;
    }
    // Of a pole no chord can be refined by anybody else.
    let named = |c: u32| outline.origin.get(c as usize).copied().unwrap_or_default();
    let pairs = crossed.iter().map(|&[a, b]| {
        let ((loop_a, a), (loop_b, b)) = (named(a), named(b));
        [loop_a, a, loop_b, b]
    });
    Fault::Crossing(pairs.collect())
}

fn finish(surface: &Surface, outline: &Outline, mut triangles: Vec<[u32; 3]>) -> FaceMesh {
    // At poles triangles may have two corners in one place.
    let node = |i: u32| outline.nodes.get(i as usize);
    let apart = |a: u32, b: u32| node(a).is_none() || node(a) != node(b);
    triangles.retain(|&[a, b, c]| apart(a, b) && apart(b, c) && apart(c, a));
    let mut normals: Vec<_> = match surface {
        Surface::Plane(_) => vec![surface.normal(outline.uv[0]).unwrap_or([0.0; 3]); outline.len()],
        _ => outline.uv.iter().map(|&uv| surface.normal(uv).unwrap_or([0.0; 3])).collect(),
    };
    for t in &triangles {
        for k in 0..3 {
            let i = t[k] as usize;
            if normals[i] == [0.0; 3] {
                let [p, q] = [t[(k + 1) % 3], t[(k + 2) % 3]].map(|j| outline.uv[j as usize]);
                let beside = [0, 1].map(|c| 0.5 * (p[c] + q[c]));
                normals[i] = surface.normal_toward(outline.uv[i], beside).unwrap_or([0.0; 3]);
            }
        }
    }
    // Corners of nothing but such triangles.
    let middle = 0.5 * (outline.bounds()[0][1] + outline.bounds()[1][1]);
    for (n, uv) in normals.iter_mut().zip(&outline.uv).filter(|(n, _)| **n == [0.0; 3]) {
        *n = surface.normal_toward(*uv, [uv[0], middle]).unwrap_or([0.0; 3]);
    }
    FaceMesh {
        uv: outline.uv.clone(),
        points: outline.points.clone(),
        nodes: outline.nodes.clone(),
        triangles,
        normals,
    }
}

#[cfg(test)]
mod tests;
