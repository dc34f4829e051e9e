//! Whether two faces that are tangent along their common edge lie on one surface, as the halves of a cylinder do, or
//! the pieces of a divided plane.
//!
//! From the middle of the edge points of one face are compared, on straight ways in (u, v) toward each corner of its
//! extent. Each is sought on the surface of the other face, which goes on beyond its face as its formula does, beginning
//! where the point before it was found:
//!
//! ```text
//!    other face       edge           one face            corner
//!  +-------------------x---o---o---o---o--------------------+      o: points compared, in space
//! ```
//!
//! So surfaces of any kind can be compared: the half of a cylinder with an extruded arc or a spline, too. Both faces are
//! sought on the other's surface, since a narrow face is near many surfaces.

use crate::faces::near;
use crate::format::{chained, inverted, moved};
use crate::geometry::surface::Surface;
use crate::geometry::vector::{dot, length, sub};
use crate::part_topology::PartFace;
use crate::shapes::{Shapes, Use};

/// Points compared on the way to each corner of a face, and the share of the way on which they lie. Surfaces that agree
/// there agree everywhere, and a spline cannot be followed much farther: its quarter of a circle goes on for 135 degrees.
const POINTS: usize = 4;
const REACH: f64 = 0.3;
/// Shares of an edge at which the extent of its face is measured.
const PLACES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Shares of the distance from the edge. Files round what they write: surfaces closer together than NEAR of the distance
/// are the same. Surfaces farther apart than FAR are two, whatever tolerance a file states.
const NEAR: f64 = 1e-5;
const FAR: f64 = 1e-3;

/// A face that has the edge, and its use of the edge.
#[derive(Clone, Copy)]
pub struct Beside<'a> {
    pub placed: &'a PartFace,
    pub used: &'a Use,
}

/// Whether two faces that are tangent along an edge lie on one surface. `tolerance`: of the edge and both faces.
pub fn one_surface(shapes: Shapes, one: Beside, other: Beside, tolerance: f64) -> bool {
    let lies_on = |one, other| lies_on(shapes, one, other, tolerance).unwrap_or(false);
    lies_on(one, other) && lies_on(other, one)
}

/// Whether a face lies on the surface of its neighbour; None where that cannot be told.
fn lies_on(shapes: Shapes, one: Beside, other: Beside, tolerance: f64) -> Option<bool> {
    let [surface, beyond] = [one, other].map(|b| shapes.faces[b.placed.face as usize].surface.as_ref());
    let (surface, beyond) = (surface?, beyond?);
    let across = match (&one.placed.place, &other.placed.place) {
        (here, there) if here == there => None,
        (here, None) => *here,
        (None, Some(there)) => Some(inverted(there)),
        (Some(here), Some(there)) => Some(chained(&inverted(there), here)),
    };
    let at = |uv: [f64; 2]| {
        let point = surface.point(uv);
        across.map_or(point, |matrix| moved(&matrix, &point))
    };
    let begin = uv(shapes, one.used, surface, 0.5)?;
    let guess = uv(shapes, other.used, beyond, 0.5)?;
    let middle = at(begin);
    let [low, high] = extent(shapes, one.placed, surface)?;
    for corner in [low, high, [low[0], high[1]], [high[0], low[1]]] {
        let mut found = guess;
        for i in 1..=POINTS {
            let share = REACH * i as f64 / POINTS as f64;
            let point = at([0, 1].map(|k| begin[k] + share * (corner[k] - begin[k])));
            found = near(beyond, &point, found)?;
            let way = length(&sub(&point, &middle));
            if length(&sub(&point, &beyond.point(found))) > tolerance.clamp(NEAR * way, FAR * way) {
                return Some(false);
            }
        }
    }
    Some(true)
}

/// The least and the largest (u, v) of a face's edges.
fn extent(shapes: Shapes, placed: &PartFace, surface: &Surface) -> Option<[[f64; 2]; 2]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for used in shapes.faces[placed.face as usize].wires.iter().flatten() {
        for share in PLACES {
            let uv = uv(shapes, used, surface, share)?;
            (low, high) = ([0, 1].map(|k| low[k].min(uv[k])), [0, 1].map(|k| high[k].max(uv[k])));
        }
    }
    [low, high].as_flattened().iter().all(|c| c.is_finite()).then_some([low, high])
}

/// Where an edge of a face lies on its surface. A file need not hold the edge's curve in (u, v) of a plane.
fn uv(shapes: Shapes, used: &Use, surface: &Surface, share: f64) -> Option<[f64; 2]> {
    let at = |[first, last]: [f64; 2]| first + share * (last - first);
    if let Surface::Plane(_) = surface {
        let edge = &shapes.edges[used.edge as usize];
        let point = edge.curve.as_ref()?.point(at(edge.range));
        let (origin, x, y) = surface.d1([0.0; 2]);
        let off = sub(&used.place.as_ref().map_or(point, |place| moved(place, &point)), &origin);
        return Some([dot(&off, &x), dot(&off, &y)]);
    }
    let (curve, range) = used.curve2?;
    let [u, v, _] = shapes.curves2[curve].as_ref()?.point(at(range));
    Some([u, v])
}
