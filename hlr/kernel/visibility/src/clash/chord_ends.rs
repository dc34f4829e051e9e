//! Planar faces that cross only because their curved borders are chords.
//!
//! ```text
//!        rim of a bore      The planar face around a bore ends in chords, which cut into the bore by up to the
//!       ____                deflection. A planar face that ends at the bore's wall, as that of a half sleeve, then
//!           \____           crosses it, for a short way: `way`. Both faces go far beyond each other's plane, so depth
//!       face +---+======    does not tell this from a real intersection. The way does: moved by as much, across the
//!           /way  half      border, the two faces would no longer meet.
//!       ___/      sleeve
//! ```

use super::depth::{Bodies, Depth};
use super::planar_faces::NO_PLANE;
use super::reach::{Vec3, cross, dot, minus};
use super::search::Clash;
use hlr_mesh::topology::components;

/// Lessens `beyond` of crossings of two planar faces to what their ways leave of it. `ends`, `depth`: per clash.
/// `points`: the points that `ends` are indices of.
pub fn lessen(bodies: &Bodies, found: &[Clash], ends: &[[i32; 2]], points: &[Vec3], depth: &mut [Depth]) {
    let faces = |i: usize| found[i].triangles.map(|t| bodies.face[t as usize]);
    let planar = |&i: &usize| {
        let brep = !bodies.groups(&found[i]).iter().any(|&g| bodies.without_brep[g]);
        brep && !faces(i).contains(&NO_PLANE)
    };
    let mut all: Vec<usize> = (0..found.len()).filter(planar).collect();
    all.sort_by_key(|&i| faces(i));
    for of_pair in all.chunk_by(|&a, &b| faces(a) == faces(b)) {
        if !of_pair.iter().any(|&i| depth[i].beyond >= 0.0) {
            continue;
        }
        for way in ways(of_pair, ends) {
            let Some(left) = left_over(bodies, found, ends, points, &way) else { continue };
            for i in way {
                depth[i].beyond = depth[i].beyond.min(left);
            }
        }
    }
}

/// The connected ways among segments of one line.
fn ways(of_pair: &[usize], ends: &[[i32; 2]]) -> Vec<Vec<usize>> {
    let mut nodes: Vec<i32> = of_pair.iter().flat_map(|&i| ends[i]).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |end: i32| nodes.partition_point(|&n| n < end) as i32;
    let edges: Vec<[i32; 2]> = of_pair.iter().map(|&i| ends[i].map(number)).collect();
    let mut ways: Vec<Vec<usize>> = Vec::new();
    for (&i, way) in of_pair.iter().zip(components(&edges, nodes.len())) {
        let way = way as usize;
        ways.resize_with(ways.len().max(way + 1), Vec::new);
        ways[way].push(i);
    }
    ways
}

/// How much of a way the chord errors of its ends do not explain, in model units; None where neither end has any.
fn left_over(bodies: &Bodies, found: &[Clash], ends: &[[i32; 2]], points: &[Vec3], way: &[usize]) -> Option<f64> {
    let at = |end: i32| &points[end as usize];
    let first = ends[way[0]];
    let along = minus(at(first[1]), at(first[0]));
    let place = |end: i32| dot(at(end), &along);
    let of_way = || way.iter().flat_map(|&i| ends[i].map(|end| (end, i)));
    let low = of_way().min_by(|a, b| place(a.0).total_cmp(&place(b.0)))?;
    let high = of_way().max_by(|a, b| place(a.0).total_cmp(&place(b.0)))?;
    let whole = minus(at(high.0), at(low.0));
    let across: Vec<f64> = [low, high]
        .into_iter()
        .filter_map(|(end, i)| curved_border(bodies, &found[i], at(end)))
        .map(|border| {
            let over = cross(&whole, &border);
            (dot(&over, &over) / dot(&border, &border)).sqrt()
        })
        .collect();
    let least = across.iter().copied().reduce(f64::min)?;
    Some(least - across.len() as f64 * bodies.deflection)
}

/// The side of one of two triangles on which an end of their common segment lies, if the face beyond it is curved.
fn curved_border(bodies: &Bodies, clash: &Clash, end: &Vec3) -> Option<Vec3> {
    let sheet = &bodies.sheet;
    let sides = clash.triangles.into_iter().flat_map(|t| {
        let corners = sheet.triangles[t as usize].map(|v| &sheet.points[v as usize]);
        [0, 1, 2].map(|k| {
            let (from, side) = (minus(end, corners[k]), minus(corners[(k + 1) % 3], corners[k]));
            let over = cross(&from, &side);
            (dot(&over, &over) / dot(&side, &side), t, k, side)
        })
    });
    let (_, t, k, side) = sides.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (beyond, _) = sheet.beyond(t, k)?;
    (bodies.face[beyond as usize] == NO_PLANE).then_some(side)
}

#[cfg(test)]
mod tests {
    use super::super::planes::Planes;
    use super::super::reach::Sheet;
    use super::super::triangle_pair::Meeting;
    use super::*;

    const DEFLECTION: f64 = 0.1;

    /// What is left of 5.0 where an upright planar face crosses a level one from x = 0 to x = `long`, where the level one
    /// ends in a border at 45 degrees. `beyond`: the face on the other side of that border.
    fn left(long: f64, beyond: i32) -> f64 {
        let (a, b, c) = ([long - 1.0, -1.0, 0.0], [long + 1.0, 1.0, 0.0], [-9.0, 0.0, 0.0]);
        let below = [0.0, 0.0, -9.0];
        let upright = [[0.0, 0.0, -5.0], [9.0, 0.0, 0.0], [0.0, 0.0, 5.0]];
        let points = [a, b, c, below, upright[0], upright[1], upright[2]];
        let bodies = Bodies {
            sheet: Sheet {
                points: &points,
                triangles: &[[0, 1, 2], [1, 0, 3], [4, 5, 6]],
                edges: &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [4, 5], [4, 6], [5, 6]],
                offsets: &[0, 2, 3, 4, 5, 6, 7, 8, 9],
                incident: &[0, 1, 0, 1, 0, 1, 2, 2, 2],
                normals: &[[0.0, 0.0, 1.0]; 3],
            },
            group: &[0, 0, 1],
            face: &[0, beyond, 1],
            planes: &Planes::default(),
            without_brep: &[false; 2],
            touch: &[1.0; 2],
            deflection: DEFLECTION,
        };
        let clash = Clash { triangles: [0, 2], meeting: Meeting { ends: [[0; 3]; 2], depth: 0.0, sine: 1.0 } };
        let mut depth = [Depth { touch: 1.0, level: 5.0, beyond: 5.0, reach: 5.0 }];
        lessen(&bodies, &[clash], &[[0, 1]], &[[0.0, 0.0, 0.0], [long, 0.0, 0.0]], &mut depth);
        depth[0].beyond
    }

    #[test]
    fn a_way_is_measured_across_a_curved_border_and_lessened_by_its_chord_error() {
        for long in [0.1, 0.5, 3.0] {
            assert!((left(long, NO_PLANE) - (long / 2.0f64.sqrt() - DEFLECTION)).abs() < 1e-12);
        }
        assert_eq!(left(20.0, NO_PLANE), 5.0);
    }

    #[test]
    fn between_planar_faces_a_border_is_exact() {
        assert_eq!(left(0.01, 2), 5.0);
    }
}
