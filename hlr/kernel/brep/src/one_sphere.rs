//! Whether a model is one whole sphere: it shows nothing but its outline, and nothing hides it.

use crate::classes::{Classes, EdgeClass};
use crate::geometry::surface::Surface;
use crate::geometry::vector::{dot, sub};
use crate::model::Model;

/// Whether the model is one part of one face, which is a whole sphere turned outward. True only where it is certain:
/// every edge is a seam at which the face continues on both sides, or shrinks to a point.
pub fn is_one_sphere(model: &Model) -> bool {
    let ([topology], [classes]) = (&model.topology[..], &model.classes[..]) else { return false };
    let [placed] = &topology.faces[..] else { return false };
    let Some(sphere @ Surface::Sphere(..)) = &model.faces[placed.face as usize].surface else { return false };
    let seam = |classes: &Classes| classes.first == EdgeClass::Seam && classes.more.is_empty();
    let mut edges = topology.edges.iter().zip(classes);
    let borderless = edges.all(|(edge, classes)| model.edges[edge.edge as usize].degenerate || seam(classes));
    borderless && points_outward(sphere) == Some(!placed.reversed)
}

/// Whether the normal of a sphere's parameters points away from its centre.
fn points_outward(sphere: &Surface) -> Option<bool> {
    let (point, normal) = sphere.placed([0.0; 2]);
    Some(dot(&normal?, &sub(&point, &sphere.centre()?)) > 0.0)
}
