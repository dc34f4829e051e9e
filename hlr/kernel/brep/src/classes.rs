//! The class of each edge of a part: sharp, smooth, seam or boundary. An edge along which the class changes is divided
//! into pieces.

use crate::continued::{Beside, one_surface};
use crate::format::Orientation;
use crate::part_topology::{PartFace, PartTopology};
use crate::shapes::{Shapes, Use};
use crate::tangency::{Meeting, NEARLY_TANGENT, Side, meeting, worst};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum EdgeClass {
    Sharp = 0,
    Smooth = 1,
    Seam = 2,
    Boundary = 3,
}

/// The classes along one edge of a part: the class at its start, then the parameter on the edge's curve at which each
/// further piece begins, with the class of that piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Classes {
    pub first: EdgeClass,
    pub more: Vec<(f64, EdgeClass)>,
}

/// The classes of an edge. An edge of two faces is smooth where the surface normals agree along it, and a seam if both
/// faces lie on one surface. A seam whose normals do not agree is sharp. Edges of more than two faces, and edges of
/// none, are sharp. An edge of one face is a boundary.
pub fn classes(shapes: Shapes, part: &PartTopology, number: usize) -> Classes {
    let placed = &part.edges[number];
    let edge = &shapes.edges[placed.edge as usize];
    let whole = |first| Classes { first, more: Vec::new() };
    let sharp_or = |smooth: bool, class| if smooth { class } else { EdgeClass::Sharp };
    match placed.faces[..] {
        [one] if placed.twice => {
            let sides = sides_of_seam(shapes, part, one, number as u32);
            let agree = match sides.as_ref().map(|sides| (sides.iter().any(|s| s.free), worst(sides))) {
                Some((false, _)) => true,
                Some((true, Some(angle))) => angle <= NEARLY_TANGENT,
                Some((true, None)) | None => edge.tangent,
            };
            whole(sharp_or(agree, EdgeClass::Seam))
        }
        [_] if !placed.inner => whole(EdgeClass::Boundary),
        [one, two] => {
            let beside = [one, two].map(|face| across(shapes, part, face, number as u32));
            let found = beside.map(|beside| side_along(shapes, part, beside, number as u32));
            let met = match found {
                [Some(one), Some(two)] => meeting(&[one, two], edge.tangent),
                _ => Meeting::Unknown,
            };
            match met {
                Meeting::Unknown => whole(sharp_or(edge.tangent, EdgeClass::Smooth)),
                Meeting::Whole(true) if divides(shapes, part, beside, number as u32) => whole(EdgeClass::Seam),
                Meeting::Whole(smooth) => whole(sharp_or(smooth, EdgeClass::Smooth)),
                Meeting::Pieces(smooth, shares) => {
                    let [first, last] = edge.range;
                    let class = |smooth: bool| sharp_or(smooth, EdgeClass::Smooth);
                    let more = shares.iter().zip(&smooth[1..]);
                    Classes {
                        first: class(smooth[0]),
                        more: more.map(|(share, smooth)| (first + share * (last - first), class(*smooth))).collect(),
                    }
                }
            }
        }
        _ => whole(EdgeClass::Sharp),
    }
}

fn uses<'a>(shapes: Shapes<'a>, part: &'a PartTopology, face: u32, number: u32) -> impl Iterator<Item = &'a Use> {
    let wires = &shapes.faces[part.faces[face as usize].face as usize].wires;
    part.places(number, face).map(|[wire, k]| &wires[wire][k])
}

/// A face at an edge, and the edge; where the face has no area, the first beyond it that has one, and its edge.
fn across(shapes: Shapes, part: &PartTopology, mut face: u32, mut number: u32) -> (u32, u32) {
    // Each step leads to another face, or around to the first.
    for _ in 0..part.faces.len() {
        let placed = &part.faces[face as usize];
        let &[one, two] = &placed.uses[..] else { break };
        let other = if one == number { two } else { one };
        let beyond = part.edges.get(other as usize).and_then(|edge| edge.faces.iter().find(|&&f| f != face));
        let (true, Some(&beyond)) = (shapes.faces[placed.face as usize].no_area, beyond) else { break };
        (face, number) = (beyond, other);
    }
    (face, number)
}

/// A face at an edge, or at a copy of it, which may run the other way.
fn side_along<'a>(
    shapes: Shapes<'a>,
    part: &'a PartTopology,
    (face, edge): (u32, u32),
    number: u32,
) -> Option<Side<'a>> {
    let mut found = side(shapes, part, face, edge)?;
    let [own, other] = [number, edge].map(|e| shapes.edges[part.edges[e as usize].edge as usize].original);
    if own.is_some_and(|(_, back)| back) != other.is_some_and(|(_, back)| back) {
        found.curve = found.curve.map(|(curve, [first, last])| (curve, [last, first]));
    }
    Some(found)
}

pub fn side<'a>(shapes: Shapes<'a>, part: &'a PartTopology, face: u32, number: u32) -> Option<Side<'a>> {
    one_side(shapes, &part.faces[face as usize], uses(shapes, part, face, number).next()?)
}

fn one_side<'a>(shapes: Shapes<'a>, placed: &'a PartFace, used: &Use) -> Option<Side<'a>> {
    let face = &shapes.faces[placed.face as usize];
    let curve = used.curve2.and_then(|(curve, range)| Some((shapes.curves2[curve].as_ref()?, range)));
    let free = face.record.as_ref().is_some_and(|r| r.kind > LAST_ELEMENTARY);
    Some(Side { surface: face.surface.as_ref()?, curve, place: placed.place.as_ref(), reversed: placed.reversed, free })
}

/// Whether a tangent edge only divides one surface into two faces.
fn divides(shapes: Shapes, part: &PartTopology, faces: [(u32, u32); 2], number: u32) -> bool {
    let of_faces = faces.map(|(face, _)| shapes.faces[part.faces[face as usize].face as usize].tolerance);
    let tolerance = shapes.edges[part.edges[number as usize].edge as usize].tolerance + of_faces[0] + of_faces[1];
    matches!(faces.map(|face| beside(shapes, part, face)), [Some(one), Some(other)] if one_surface(shapes, one, other, tolerance))
}

/// A face of a part, and its first use of the edge with this number.
pub fn beside<'a>(shapes: Shapes<'a>, part: &'a PartTopology, (face, edge): (u32, u32)) -> Option<Beside<'a>> {
    let placed = &part.faces[face as usize];
    uses(shapes, part, face, edge).next().map(|used| Beside { placed, used })
}

/// The highest kind of an elementary surface: plane, cylinder, cone, sphere, torus.
const LAST_ELEMENTARY: u8 = 5;

/// The seam's side in each sense; None unless the face has the edge once in each sense.
fn sides_of_seam<'a>(shapes: Shapes<'a>, part: &'a PartTopology, face: u32, number: u32) -> Option<[Side<'a>; 2]> {
    let placed = &part.faces[face as usize];
    let both: Vec<&Use> = uses(shapes, part, face, number).collect();
    match both[..] {
        [one, two] if one.orientation != two.orientation && two.orientation != Orientation::Internal => {
            Some([one_side(shapes, placed, one)?, one_side(shapes, placed, two)?])
        }
        _ => None,
    }
}
