//! The mesh of one face, made from its loops in the parameter plane of its surface.
//!
//! Planes and surfaces that are straight in one direction (`ruled`) need no inner points: a sweep (`sweep`) or Delaunay
//! triangulation of the border is enough. All others (`doubly_curved`) get a lattice of inner points. Every mesh is
//! proved to fill the loops (`check`) before it is returned.

mod border_grid;
mod check;
mod coarse;
mod crossing;
mod delaunay;
mod doubly_curved;
mod draft;
mod face;
mod flip;
mod gap;
mod lattice;
mod long_chord;
mod outline;
mod plane;
mod progress;
mod ruled;
mod spacing;
mod straighten;
mod strips;
mod sweep;
mod triangulation;
mod untangle;

use std::f64::consts::PI;

use crate::geometry::surface::Surface;
pub use crossing::upon_one_another;
use draft::Draft;
pub use face::{FaceLoops, FaceMesh, Fault, LoopPoint};
use gap::Corner;
use hlr_accuracy::MESH_BORDER;
pub use long_chord::long_chords;
use outline::Outline;
pub use progress::{Done, Interrupted, OF_A_FACE, Progress};
pub use untangle::mesh_crossed;

/// Twice the area of a triangle in (u, v), rounded.
pub fn area([a, b, c]: &[[f64; 2]; 3]) -> f64 {
    plane::area(a, b, c)
}

/// The mesh of a face, with a chord error of at most `deflection` in the surface's unit. Inner points are spaced so
/// that the surface turns by about `angle` radians from one to the next. Long triangles beside flat directions turn by
/// up to twice as much.
///
/// The loops' points are kept as they are. The chord error does not include their own distance from the surface, which
/// no mesh can reduce. They are off the surface where the file's edges and vertices are, since all faces around share
/// them: an edge may be off by its tolerance, which readers that sew faces raise to hundredths of a millimetre. (The
/// example `mesh_error` reports both separately. Of 28 models, at a deflection of 5e-5 of their size, 8 have such
/// faces, by up to 32 times the deflection; at 5e-4, one.)
///
/// The error is exact on a sphere, and in closed form on cylinders and cones. Elsewhere it follows from the second
/// derivatives at the corners, with a margin, and is measured where these change unevenly. `certificate` proves bounds
/// on the true error.
///
/// Where half of the steps are taken, the mesh is as it is by then: proved to fill the loops, but with the chord error
/// that it has (`FaceMesh::unfinished`). So it is where more points make it no better, as a point of the loops is too
/// far off the surface.
///
/// # Errors
/// The loops cross or do not close, or the deflection cannot be proved with chords as coarse as the border's.
pub fn mesh_face(
    surface: &Surface,
    loops: &FaceLoops,
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Result<FaceMesh, Fault> {
    let bent = |straight| doubly_curved::triangulate(surface, loops, deflection, angle, straight, steps);
    let proved = |made| proved(surface, made, deflection, steps);
    let made = match (surface, ruled::straight_along(surface)) {
        (Surface::Plane(_), _) => proved(flat(surface, Outline::new(loops, |_, _, _| ())?, deflection, steps)),
        (_, Some(straight)) => {
            let bent = 1 - straight;
            let mut turns: Vec<f64> = loops.loops.iter().flatten().map(|p| p.uv[bent]).collect();
            turns.sort_unstable_by(f64::total_cmp);
            turns.dedup();
            // A straight line from the apex to each point.
            let outline = Outline::new(loops, |from, to, shares| {
                let share = |x: &f64| (x - from[bent]) / (to[bent] - from[bent]);
                shares.extend(turns.iter().map(share).filter(|t| *t > 0.0 && *t < 1.0));
                shares.sort_unstable_by(f64::total_cmp);
            })?;
            proved(flat(surface, outline, deflection, steps))
        }
        _ => match proved(bent(false)?) {
            Ok(made) => Ok(made),
            Err(_) => proved(bent(true)?),
        },
    };
    let made = made.map_err(|outline| why(&outline))?;
    let named = |&chord: &u32| made.outline.origin.get(chord as usize).map(|&(number, chord)| [number, chord]);
    let nodes = &made.outline.nodes;
    if made.stand_in.iter().zip(nodes).any(|(&i, &node)| nodes[i as usize] != node) {
        return Err(Fault::Degenerate);
    }
    let kept = made.error <= deflection * (1.0 + ROUNDING);
    let unfinished = !kept && (made.stalled || steps.is_half_spent());
    if !kept && !made.torn && !unfinished {
        return Err(Fault::NotCertified(made.error, made.coarse.iter().filter_map(named).collect()));
    }
    let error = made.error;
    let torn = if !kept && made.torn { error } else { 0.0 };
    Ok(FaceMesh { torn, unfinished: if unfinished { error } else { 0.0 }, ..finish(surface, made) })
}

/// Share of the deflection that the chords of a face's border may use, so that the triangles beside them keep the
/// deflection.
pub fn border_share(surface: &Surface) -> f64 {
    if bends_both_ways(surface) { MESH_BORDER } else { 1.0 }
}

/// Whether the meshes of its faces have inner points.
fn bends_both_ways(surface: &Surface) -> bool {
    ruled::straight_along(surface).is_none()
}

/// About how many points the mesh of a face gets inside: none where the surface is straight along a parameter, and as
/// many as cover the whole of a sphere. None for surfaces of which nothing is known beforehand. `deflection`: the chord
/// error asked for, model units; `angle`: radians between neighbouring chords.
pub fn points_inside(surface: &Surface, deflection: f64, angle: f64) -> Option<usize> {
    match surface {
        Surface::Sphere(_, radius) => {
            let step = (8.0 * deflection / radius).sqrt().min(angle);
            Some((4.0 * PI / (step * step)) as usize)
        }
        _ => (!bends_both_ways(surface)).then_some(0),
    }
}

/// The mesh, proved to fill the loops and use all of their points; the outline where the proof fails.
fn proved(
    surface: &Surface,
    made: Result<Draft, Box<Outline>>,
    deflection: f64,
    steps: &Progress,
) -> Result<Draft, Box<Outline>> {
    let mut made = made?;
    made.outline.rejoin(&mut made.triangles, steps);
    let uv: Vec<_> = made.corners.iter().map(|c| c.uv).collect();
    let in_chart = made.bent_chart.as_ref().map(|_| made.triangles.clone());
    flip::upright(&uv, &mut made.triangles);
    if let Surface::Spline(_) = surface {
        let points: Vec<_> = made.corners.iter().map(|c| c.point).collect();
        let error = |new: [[u32; 3]; 2]| {
            doubly_curved::largest_error(surface, &made.outline, &made.corners, new.into_iter(), deflection)
        };
        let slim = flip::slim_in_space(&uv, &points);
        flip::without_needles(&mut made.triangles, slim, |new| error(new) <= deflection);
    }
    let mut proof = check::proof(&made.outline, &uv, &made.stand_in, &made.triangles);
    if proof.is_none() && straightened(surface, &mut made, &uv, in_chart, deflection, steps) {
        proof = check::proof(&made.outline, &uv, &made.stand_in, &made.triangles);
    }
    let Some(proof) = proof else {
        return Err(Box::new(made.outline));
    };
    if !proof.in_sense {
        made.turned = check::turned(&made.outline, &made.stand_in, &made.triangles);
    }
    Ok(made)
}

/// Replaces the triangles by those of the chart, straightened. Whether that succeeds, and the flipped ones keep the
/// deflection, or need not as half of the steps are taken or the mesh gets no better.
fn straightened(
    surface: &Surface,
    made: &mut Draft,
    uv: &[[f64; 2]],
    in_chart: Option<Vec<[u32; 3]>>,
    deflection: f64,
    steps: &Progress,
) -> bool {
    let (Some(chart), Some(in_chart)) = (&made.bent_chart, in_chart) else { return false };
    made.triangles.clone_from(&in_chart);
    if !straighten::straighten(chart, uv, &mut made.triangles, steps) {
        return false;
    }
    let flipped = made.triangles.iter().zip(&in_chart).filter(|(new, old)| new != old).map(|(new, _)| *new);
    let error = doubly_curved::largest_error(surface, &made.outline, &made.corners, flipped, deflection);
    made.error = made.error.max(error);
    error <= deflection || made.stalled || steps.is_half_spent()
}

/// The mesh without inner points; the outline where the loops cannot be filled.
fn flat(surface: &Surface, outline: Outline, deflection: f64, steps: &Progress) -> Result<Draft, Box<Outline>> {
    let Some((triangles, stand_in, error)) = ruled::triangulate(surface, &outline, deflection, steps) else {
        return Err(Box::new(outline));
    };
    // All triangles are between chords.
    let coarse = if error > deflection { outline.chords().collect() } else { Vec::new() };
    let corner = |(&uv, &point): (&[f64; 2], &[f64; 3])| match surface {
        Surface::Plane(_) => Corner { uv, point, normal: surface.normal([0.0; 2]).unwrap_or_default() },
        _ => Corner { uv, point, normal: surface.normal(uv).unwrap_or_default() },
    };
    let corners = outline.uv.iter().zip(&outline.points).map(corner).collect();
    Ok(Draft {
        outline,
        corners,
        triangles,
        stand_in,
        error,
        torn: false,
        stalled: false,
        coarse,
        bent_chart: None,
        turned: Vec::new(),
    })
}

const ROUNDING: f64 = 1e-9;

/// The reason why loops could not be filled.
fn why(outline: &Outline) -> Fault {
    let crossed = crossing::crossings(outline);
    if crossed.is_empty() {
        return Fault::Open;
    }
    // Points that were added on a pole are not in `origin`: no edge can be divided there.
    let named = |c: u32| outline.origin.get(c as usize).copied().unwrap_or_default();
    let pairs = crossed.iter().map(|&[a, b]| {
        let ((loop_a, a), (loop_b, b)) = (named(a), named(b));
        [loop_a, a, loop_b, b]
    });
    Fault::Crossing(pairs.collect())
}

fn finish(surface: &Surface, made: Draft) -> FaceMesh {
    let Draft { outline, mut corners, mut triangles, turned, .. } = made;
    // At poles, triangles may have two corners at the same place.
    let node = |i: u32| outline.nodes.get(i as usize);
    let apart = |a: u32, b: u32| node(a).is_none() || node(a) != node(b);
    triangles.retain(|&[a, b, c]| apart(a, b) && apart(b, c) && apart(c, a));
    without_folds(&outline.nodes, &mut triangles);
    let toward = |c: &mut Corner, beside: [f64; 2]| {
        if c.normal == [0.0; 3] {
            c.normal = surface.normal_toward(c.uv, beside).unwrap_or_default();
        }
    };
    for t in &triangles {
        for k in 0..3 {
            let [p, q] = [t[(k + 1) % 3], t[(k + 2) % 3]].map(|j| corners[j as usize].uv);
            toward(&mut corners[t[k] as usize], [0, 1].map(|c| 0.5 * (p[c] + q[c])));
        }
    }
    // Points that were corners of removed triangles only.
    let bounds = outline.bounds();
    for c in &mut corners {
        let middle = [c.uv[0], 0.5 * (bounds[0][1] + bounds[1][1])];
        toward(c, middle);
    }
    FaceMesh {
        uv: corners.iter().map(|c| c.uv).collect(),
        points: corners.iter().map(|c| c.point).collect(),
        nodes: outline.nodes,
        triangles,
        normals: corners.iter().map(|c| c.normal).collect(),
        turned,
        torn: 0.0,
        unfinished: 0.0,
    }
}

/// Removes pairs of triangles with the same nodes and opposite orientation, which enclose nothing. They arise where the
/// border passes twice through one node, at a tip or beside a seam, and a narrow face folds onto itself.
fn without_folds(nodes: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let mut sorted: Vec<(u32, u32)> = nodes.iter().copied().zip(0..).collect();
    sorted.sort_unstable();
    let mut twice = vec![false; nodes.len()];
    for group in sorted.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        group.iter().for_each(|&(_, point)| twice[point as usize] = true);
    }
    let Some(&(last, _)) = sorted.last().filter(|_| twice.contains(&true)) else { return };
    let place = |i: u32| nodes.get(i as usize).map_or_else(|| last + 1 + i, |&node| node);
    // Each triangle's nodes in ascending order, its number, and whether its own order is a rotation of the ascending
    // one.
    let mut found: Vec<([u32; 3], usize, bool)> = Vec::new();
    for (i, t) in triangles.iter().enumerate() {
        if t.iter().any(|&point| twice.get(point as usize) == Some(&true)) {
            let [a, b, c] = t.map(place);
            let mut corners = [a, b, c];
            corners.sort_unstable();
            found.push((corners, i, [[a, b, c], [b, c, a], [c, a, b]].contains(&corners)));
        }
    }
    found.sort_unstable();
    let mut kept = vec![true; triangles.len()];
    for same in found.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        // Triangles without a counterpart so far: all have the same orientation.
        let mut open: Vec<(usize, bool)> = Vec::new();
        for &(_, i, rising) in same {
            match open.pop_if(|(_, other)| *other != rising) {
                Some((other, _)) => (kept[i], kept[other]) = (false, false),
                None => open.push((i, rising)),
            }
        }
    }
    let mut kept = kept.into_iter();
    triangles.retain(|_| kept.next() == Some(true));
}

#[cfg(test)]
mod folds {
    use super::without_folds;

    fn left(nodes: &[u32], mut all: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
        without_folds(nodes, &mut all);
        all
    }

    #[test]
    fn triangles_that_lie_on_one_another_turned_over_go() {
        // Points 1 and 4 share a node; 5 and 6 are inside the face.
        let nodes = [0, 1, 2, 3, 1];
        assert_eq!(left(&nodes, vec![[0, 1, 3], [0, 3, 4], [2, 3, 4]]), [[2, 3, 4]]);
        assert_eq!(left(&nodes, vec![[1, 5, 6], [5, 4, 6], [2, 3, 4]]), [[2, 3, 4]]);
    }

    #[test]
    fn two_sheets_and_single_triangles_stay() {
        let nodes = [0, 1, 2, 3, 1];
        assert_eq!(left(&nodes, vec![[0, 1, 3], [3, 0, 4]]).len(), 2);
        assert_eq!(left(&nodes, vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]]).len(), 3);
        assert_eq!(left(&[0, 1, 2, 3], vec![[0, 1, 2], [2, 1, 0]]).len(), 2);
    }
}

#[cfg(test)]
pub(crate) mod tests;
