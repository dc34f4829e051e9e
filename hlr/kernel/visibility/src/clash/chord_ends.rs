//! Planar faces that cross only because their curved borders are chords, or hardly at all.
//!
//! ```text
//!        rim of a bore      The planar face around a bore ends in chords, which cut into the bore by up to the
//!       ____                deflection. A planar face that ends at the bore's wall, as that of a half sleeve, then
//!           \____           crosses it over a short stretch (+---+). Both faces go far beyond each other's plane, so
//!       face +---+======    their depth does not tell this from a real intersection. The stretch does: moved by its
//!           /     half      width across the border, the two faces would no longer meet.
//!       ___/      sleeve
//! ```

use super::depth::{Bodies, Depth};
use super::planar_faces::NO_PLANE;
use super::reach::Vec3;
use super::search::Clash;
use hlr_accuracy::{CONTACT_POINT, FLUSH};
use hlr_mesh::topology::components;
use hlr_mesh::vector::{cross, dot, sub};

/// Limits `beyond` of crossings of two planar faces to the width of their stretches, less the chord errors of their ends.
/// `ends`, `depth`: per clash. `points`: the points that `ends` are indices of.
pub fn limit(bodies: &Bodies, found: &[Clash], ends: &[[i32; 2]], points: &[Vec3], depth: &mut [Depth]) {
    let faces = |i: usize| found[i].triangles.map(|t| bodies.face[t as usize]);
    let planar = |&i: &usize| bodies.of_breps(&found[i]) && !faces(i).contains(&NO_PLANE);
    let mut all: Vec<usize> = (0..found.len()).filter(planar).collect();
    all.sort_by_key(|&i| faces(i));
    for of_pair in all.chunk_by(|&a, &b| faces(a) == faces(b)) {
        if !of_pair.iter().any(|&i| depth[i].beyond >= 0.0) {
            continue;
        }
        for stretch in stretches(of_pair, ends) {
            let Some(width) = width(bodies, found, ends, points, &stretch) else { continue };
            for i in stretch {
                depth[i].beyond = depth[i].beyond.min(width);
                depth[i].certain = depth[i].certain.min(width);
            }
        }
    }
}

/// The connected stretches among segments of one line.
fn stretches(of_pair: &[usize], ends: &[[i32; 2]]) -> Vec<Vec<usize>> {
    let mut nodes: Vec<i32> = of_pair.iter().flat_map(|&i| ends[i]).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |end: i32| nodes.partition_point(|&n| n < end) as i32;
    let edges: Vec<[i32; 2]> = of_pair.iter().map(|&i| ends[i].map(number)).collect();
    let mut out: Vec<Vec<usize>> = Vec::new();
    for (&i, stretch) in of_pair.iter().zip(components(&edges, nodes.len())) {
        let stretch = stretch as usize;
        out.resize_with(out.len().max(stretch + 1), Vec::new);
        out[stretch].push(i);
    }
    out
}

/// How wide a stretch is across the borders at its ends, less the chord errors of curved ones, in model units; None where
/// no end is at a border.
fn width(bodies: &Bodies, found: &[Clash], ends: &[[i32; 2]], points: &[Vec3], stretch: &[usize]) -> Option<f64> {
    let at = |end: i32| &points[end as usize];
    // The end farthest from any end is an outer one, and the one farthest from that the other.
    let farthest = |from: i32| {
        let away = |end: &i32| sub(at(*end), at(from));
        let every = stretch.iter().flat_map(|&i| ends[i]);
        every.max_by(|a, b| dot(&away(a), &away(a)).total_cmp(&dot(&away(b), &away(b))))
    };
    let one = farthest(ends[stretch[0]][0])?;
    let outer = [one, farthest(one)?];
    let whole = sub(at(outer[1]), at(outer[0]));
    let across: Vec<Across> = outer
        .into_iter()
        .filter_map(|end| {
            let there = stretch.iter().filter(|&&i| ends[i].contains(&end)).map(|&i| &found[i]);
            across(&borders(bodies, there, at(end)), &whole, bodies.deflection)
        })
        .collect();
    let least = across.iter().map(|across| across.width).reduce(f64::min)?;
    let chords = across.iter().filter(|across| across.chord).count() as f64;
    Some(least - chords.max(FLUSH) * bodies.deflection)
}

/// A crossing at one of its ends: how wide it is across the border, and whether that is a chord.
struct Across {
    width: f64,
    chord: bool,
}

/// A side of a triangle at which its face ends.
struct Border {
    /// From a point.
    distance: f64,
    along: Vec3,
    /// The face beyond is curved, so this may be a chord.
    curved: bool,
}

/// The borders of the faces that cross in these clashes.
fn borders<'a>(bodies: &Bodies, clashes: impl Iterator<Item = &'a Clash>, point: &Vec3) -> Vec<Border> {
    let sheet = &bodies.sheet;
    let border = |t: u32, k: usize| {
        // Where there is not one face beyond, nothing is known of the border.
        let beyond = sheet.beyond(t, k).map(|(beyond, _)| bodies.face[beyond as usize]);
        let [start, end] = [k, (k + 1) % 3].map(|k| &sheet.points[sheet.triangles[t as usize][k] as usize]);
        let along = sub(end, start);
        let over = cross(&sub(point, start), &along);
        let distance = (dot(&over, &over) / dot(&along, &along)).sqrt();
        let curved = beyond == Some(NO_PLANE);
        (beyond != Some(bodies.face[t as usize])).then_some(Border { distance, along, curved })
    };
    clashes.flat_map(|clash| clash.triangles).flat_map(|t| (0..3).filter_map(move |k| border(t, k))).collect()
}

/// Of several borders on which the crossing `whole` ends, the one across which it is widest; a chord only if all are.
fn across(borders: &[Border], whole: &Vec3, deflection: f64) -> Option<Across> {
    let nearest = borders.iter().map(|border| border.distance).fold(f64::INFINITY, f64::min);
    let here = || borders.iter().filter(|border| border.distance <= nearest + CONTACT_POINT * deflection);
    let width = |Border { along, .. }: &Border| {
        let over = cross(whole, along);
        (dot(&over, &over) / dot(along, along)).sqrt()
    };
    let width = here().map(width).reduce(f64::max)?;
    Some(Across { width, chord: here().all(|border| border.curved) })
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::Edges;
    use super::super::planes::Planes;
    use super::super::reach::Sheet;
    use super::super::triangle_pair::Meeting;
    use super::*;
    use hlr_mesh::kinds::INTERIOR;

    const DEFLECTION: f64 = 0.1;

    /// What becomes of a depth of 5.0 where an upright planar face crosses a level one from x = 0 to x = `long`, where the
    /// level one ends in a border at 45 degrees. `beyond`: the face on the other side of that border.
    fn limited(long: f64, beyond: i32) -> f64 {
        limited_in(&[0.0, long], &[[0, 1]], beyond)
    }

    /// The same where the stretch consists of these segments between these places.
    fn limited_in(places: &[f64], ends: &[[i32; 2]], beyond: i32) -> f64 {
        let long = places[places.len() - 1];
        let (a, b, c) = ([long - 1.0, -1.0, 0.0], [long + 1.0, 1.0, 0.0], [-9.0, 0.0, 0.0]);
        let below = [0.0, 0.0, -9.0];
        let upright = [[0.0, 0.0, -5.0], [9.0, 0.0, 0.0], [0.0, 0.0, 5.0]];
        let points = [a, b, c, below, upright[0], upright[1], upright[2]];
        let edges = Edges {
            edges: &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [4, 5], [4, 6], [5, 6]],
            offsets: &[0, 2, 3, 4, 5, 6, 7, 8, 9],
            incident: &[0, 1, 0, 1, 0, 1, 2, 2, 2],
        };
        let bodies = Bodies {
            sheet: Sheet::new(
                &points,
                (&[[0, 1, 2], [1, 0, 3], [4, 5, 6]], &[[0.0, 0.0, 1.0]; 3]),
                (edges, &[INTERIOR; 8]),
            ),
            group: &[0, 0, 1],
            face: &[0, beyond, 1],
            planes: &Planes::default(),
            without_brep: &[false; 2],
            touch: &[1.0; 2],
            deflection: DEFLECTION,
        };
        let clash = Clash { triangles: [0, 2], meeting: Meeting { ends: [[0; 3]; 2], depth: 0.0, sine: 1.0 } };
        let mut depth = vec![Depth { touch: 1.0, level: 5.0, beyond: 5.0, certain: 5.0, reach: 5.0 }; ends.len()];
        let at: Vec<Vec3> = places.iter().map(|&x| [x, 0.0, 0.0]).collect();
        limit(&bodies, &vec![clash; ends.len()], ends, &at, &mut depth);
        assert!(depth.iter().all(|each| each.beyond == depth[0].beyond));
        depth[0].beyond
    }

    #[test]
    fn a_stretch_is_measured_across_a_curved_border_and_lessened_by_its_chord_error() {
        for long in [0.1, 0.5, 3.0] {
            assert!((limited(long, NO_PLANE) - (long / 2.0f64.sqrt() - DEFLECTION)).abs() < 1e-12);
        }
        assert_eq!(limited(20.0, NO_PLANE), 5.0);
    }

    #[test]
    fn a_stretch_may_consist_of_several_segments_and_of_points() {
        for ends in [&[[1, 1], [0, 1], [1, 2]][..], &[[2, 1], [0, 1]], &[[2, 2], [1, 2], [1, 1], [1, 0]]] {
            assert_eq!(limited_in(&[0.0, 1e-9, 3.0], ends, NO_PLANE), limited(3.0, NO_PLANE));
        }
    }

    #[test]
    fn between_planar_faces_a_border_is_exact() {
        assert!((limited(0.5, 2) - (0.5 / 2.0f64.sqrt() - FLUSH * DEFLECTION)).abs() < 1e-12);
    }
}
