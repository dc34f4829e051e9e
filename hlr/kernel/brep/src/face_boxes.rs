//! The box around each face of a part, from its geometry: which faces come near those of other parts is known before
//! anything is meshed.
//!
//! A mesh of the face lies within its box, because its corners do: on edges, or on the surface between them. Splines
//! count by their control points.

use rayon::prelude::*;

use crate::bounds::{
    Box3, EMPTY, add_edge, add_ends, add_point, add_poles, add_surface, reaches_on_edges, stands, union, uv_range,
};
use crate::format::{Matrix, moved};
use crate::geometry::curve::Curve;
use crate::geometry::nurbs::used_poles;
use crate::geometry::vector::Vector;
use crate::model::Model;
use crate::part_topology::PartFace;
use crate::shapes::Edge;

/// The boxes of the faces of parts, given by their numbers, which stand in these places. Each part is looked at once, in
/// its own frame, however often it is placed.
pub fn placed_face_boxes(model: &Model, parts: &[i32], places: &[Matrix]) -> Vec<Vec<Box3>> {
    let mut used = vec![false; model.parts.len()];
    parts.iter().for_each(|&part| used[part as usize] = true);
    let of_part = |(part, used): (usize, bool)| if used { face_boxes(model, part) } else { Vec::new() };
    let own: Vec<Vec<Box3>> = used.into_par_iter().enumerate().map(of_part).collect();
    let placed = parts.par_iter().zip(places).with_min_len(FEW);
    placed.map(|(&part, place)| own[part as usize].iter().map(|found| placed_box(place, found)).collect()).collect()
}

/// With fewer parts a second thread gains nothing.
const FEW: usize = 64;

/// The box around the eight corners of a box that stands in a place.
fn placed_box(place: &Matrix, [low, high]: &Box3) -> Box3 {
    let middle = moved(place, &[0, 1, 2].map(|k| 0.5 * (low[k] + high[k])));
    let half: Vector = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]));
    let reach = place.map(|row| (0..3).map(|k| row[k].abs() * half[k]).sum::<f64>());
    [[0, 1, 2].map(|k| middle[k] - reach[k]), [0, 1, 2].map(|k| middle[k] + reach[k])]
}

/// The box of each face of a part, in the part's frame. A face of which the surface or the border is not known gets the
/// box around all that is known of the part.
fn face_boxes(model: &Model, part: usize) -> Vec<Box3> {
    let part = &model.topology[part];
    let edges: Vec<Box3> = (part.edges.par_iter().with_min_len(FEW))
        .map(|edge| edge_box(model, &model.edges[edge.edge as usize], &stands(None, edge.place)))
        .collect();
    let found: Vec<Option<Box3>> =
        part.faces.par_iter().with_min_len(FEW).map(|face| face_box(model, face, &edges)).collect();
    let whole = edges.iter().chain(found.iter().flatten()).fold(EMPTY, |all, &own| union(all, own));
    found.into_iter().map(|own| own.unwrap_or(whole)).collect()
}

fn face_box(model: &Model, placed: &PartFace, edges: &[Box3]) -> Option<Box3> {
    let (face, place) = (&model.faces[placed.face as usize], stands(None, placed.place));
    let mut found = EMPTY;
    for &edge in &placed.uses {
        found = union(found, *edges.get(edge as usize)?);
    }
    match (&face.surface, &face.own) {
        (Some(surface), _) if !reaches_on_edges(surface) => {
            add_surface(surface, uv_range(model, face, surface, add_poles), &place, &mut found);
        }
        (Some(_), _) => {}
        (None, Some(own)) => own.points.iter().for_each(|point| add_point(&moved(&place, point), &mut found)),
        (None, None) => return None,
    }
    found.as_flattened().iter().all(|c| c.is_finite()).then_some(found)
}

fn edge_box(model: &Model, edge: &Edge, place: &Matrix) -> Box3 {
    let mut found = EMPTY;
    add_ends(edge, place, &mut found);
    match &edge.curve {
        Some(Curve::Spline(n)) => {
            let (first, last) = n.domain();
            // Where it is continued, its ends lie beyond the control points.
            edge.range.iter().for_each(|t| add_point(&moved(place, &n.point(*t)), &mut found));
            let within = [edge.range[0].max(first), edge.range[1].min(last)];
            for [x, y, z, w] in &n.poles[used_poles(&n.knots, n.degree, n.poles.len(), within)] {
                add_point(&moved(place, &[x / w, y / w, z / w]), &mut found);
            }
        }
        _ => add_edge(model, edge, place, &mut found),
    }
    found
}
