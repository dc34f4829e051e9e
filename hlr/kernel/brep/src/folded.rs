//! Faces that lie on one another beside their common edge, on one surface: between them there is no material.
//!
//! ```text
//!    as it should be                   folded
//!  +--------+-------+            +--------=======+
//!  |  one   | other |            |  other   both |
//!  +--------+-------+            +--------=======+
//!         edge                                 edge
//! ```
//!
//! No modeller makes them. Readers do: a loop around a sphere or a cylinder bounds a face on either side of it, and the
//! wrong side was taken, the rest of the surface.

use crate::classes::{Classes, EdgeClass, beside, side};
use crate::continued::one_surface;
use crate::geometry::surface::Surface;
use crate::part_topology::PartTopology;
use crate::shapes::Shapes;
use crate::tangency::{Fixed, TANGENT, angle};
use std::f64::consts::PI;

/// The faces of a part that lie on another, by the numbers of their underlying faces; a face may be named twice.
pub fn folded(shapes: Shapes, part: &PartTopology, classes: &[Classes]) -> Vec<u32> {
    let sharp = |edge: &u32| classes[*edge as usize].first == EdgeClass::Sharp;
    let found = (0..part.edges.len() as u32).filter(|edge| sharp(edge) && is_folded(shapes, part, *edge));
    let faces = found.flat_map(|edge| &part.edges[edge as usize].faces);
    faces.map(|face| part.faces[*face as usize].face).collect()
}

fn is_folded(shapes: Shapes, part: &PartTopology, number: u32) -> bool {
    let [one, two] = part.edges[number as usize].faces[..] else { return false };
    // A loop in a plane bounds a face on one side only.
    let surface = |face: u32| &shapes.faces[part.faces[face as usize].face as usize].surface;
    if [one, two].iter().any(|&face| matches!(surface(face), Some(Surface::Plane(_)) | None)) {
        return false;
    }
    let sides = [one, two].map(|face| side(shapes, part, face, number));
    let [Some(here), Some(there)] = &sides else { return false };
    let opposed = angle(&[Fixed::new(here), Fixed::new(there)], 0.5).is_some_and(|angle| angle >= PI - TANGENT);
    // Where both have the edge in the same sense, one of them is merely turned around.
    let [Some(one), Some(two)] = [one, two].map(|face| beside(shapes, part, (face, number))) else { return false };
    let senses = [one, two].map(|face| face.used.orientation.sense(face.placed.reversed));
    let tolerance = shapes.edges[part.edges[number as usize].edge as usize].tolerance;
    opposed && senses[0] * senses[1] < 0 && one_surface(shapes, one, two, tolerance)
}
