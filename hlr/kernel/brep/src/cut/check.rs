//! Whether the pieces of a body are what a plane leaves of it: closed, and of the right volume.

use std::collections::HashSet;

use super::divided_body::DividedBody;
use super::enclosed::Enclosed;
use super::joined::is_joined;
use super::plane::Plane;
use crate::body::{Body, model_of};
use crate::explore::Part;
use crate::geometry::vector::length;
use crate::tessellate::{ChordErrors, LIMITS, MeshedFace, Watch, tessellate};
use hlr_accuracy::CUT_DISPLACED;

/// Of the area of a closed mesh: how far its area, as a vector, may be from zero.
const OPEN: f64 = 1e-7;

/// A piece may be so thin that its coarse mesh lies on itself, as a slice of a ball. `films`: whether that is accepted.
///
/// # Errors
/// What is wrong with the pieces.
pub fn check(
    divided: &DividedBody,
    pieces: &[Body],
    plane: &Plane,
    films: bool,
    deflection: f64,
    angle: f64,
    watch: &Watch,
) -> Result<(), &'static str> {
    // Seen from a point of the plane, the faces on it enclose nothing with it.
    let from = plane.foot(divided.vertices.first().unwrap_or(&[0.0; 3]));
    let mut below = Enclosed::seen_from(from);
    for (own, found) in divided.body.faces.iter().zip(&divided.coarse.faces) {
        below.add_below(found, own.reversed, &plane.normal);
    }
    let model = model_of(pieces.to_vec(), false);
    let errors = ChordErrors::same(&model, deflection);
    let meshed = tessellate(&model, &errors, angle, LIMITS, watch).map_err(|_| "it was stopped")?;
    if meshed.faces.iter().any(|face| face.fault.is_some()) {
        return Err("a face that is cut has no mesh");
    }
    let mut whole = Enclosed::seen_from(from);
    for part in &model.parts {
        let mut piece = Enclosed::seen_from(from);
        for placed in &part.faces {
            piece.add(&meshed.faces[placed.face as usize], placed.reversed);
        }
        if length(&piece.area) > OPEN * piece.size || !is_joined(part, &meshed.faces, plane, deflection) {
            return Err("a piece does not close");
        }
        if !films && has_film(part, &meshed.faces) {
            return Err("a piece is so thin that it lies on itself");
        }
        whole.volume += piece.volume;
        whole.size += piece.size;
    }
    let most = 6.0 * CUT_DISPLACED * deflection * (below.size + whole.size);
    if (whole.volume - below.volume).abs() > most { Err("what is left has another volume") } else { Ok(()) }
}

/// Whether some triangle of a piece lies on another one, as between a plane and a seam that runs right beside it.
fn has_film(part: &Part, faces: &[MeshedFace]) -> bool {
    let meshes = || part.faces.iter().map(|placed| &faces[placed.face as usize].mesh);
    let mut seen = HashSet::with_capacity(meshes().map(|mesh| mesh.triangles.len()).sum());
    meshes().any(|mesh| {
        mesh.triangles.iter().any(|triangle| {
            let mut corners = triangle.map(|i| mesh.points[i as usize].map(f64::to_bits));
            corners.sort_unstable();
            !seen.insert(corners)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use std::sync::atomic::AtomicUsize;

    const CYLINDER: &[u8] = include_bytes!("../../tests/cylinder_4.bin");

    #[test]
    fn pieces_that_are_open_or_have_another_volume_are_found() {
        let model = Model::read(CYLINDER, None).unwrap();
        let body = Body::of_part(&model, 0).unwrap();
        let watch = Watch { stopped: &|| false, done: &AtomicUsize::new(0) };
        let deflection = 1e-3 * body.size();
        let ends: Vec<f64> = body.edges.iter().flat_map(|edge| edge.end_points).flatten().map(|p| p[2]).collect();
        let middle = ends.iter().sum::<f64>() / ends.len() as f64;
        // The first plane leaves all of the body, the second one a part of it.
        for (level, whole) in [(1e3, Ok(())), (middle, Err("what is left has another volume"))] {
            let plane = Plane { normal: [0.0, 0.0, 1.0], level, near: 1e-7 };
            let model = model_of(vec![body.clone()], false);
            let errors = ChordErrors::same(&model, deflection);
            let coarse = tessellate(&model, &errors, 0.2, LIMITS, &watch).unwrap();
            let divided = DividedBody::new(body.clone(), coarse, &plane, 0.0, true).unwrap();
            let checked = |films, pieces: &[Body]| check(&divided, pieces, &plane, films, deflection, 0.2, &watch);
            assert_eq!(checked(false, std::slice::from_ref(&body)), whole);
            let open = Body { faces: body.faces[..2].to_vec(), ..body.clone() };
            assert_eq!(checked(false, &[open]), Err("a piece does not close"));
            let mut film = body.clone();
            film.faces.extend([body.faces[0].clone(), body.faces[0].clone()]);
            film.faces[body.faces.len()].reversed = !body.faces[0].reversed;
            assert_eq!(checked(false, std::slice::from_ref(&film)), Err("a piece is so thin that it lies on itself"));
            assert_eq!(checked(true, &[film]), whole);
        }
    }
}
