//! Intersection lines at faces that are seen nearly edge-on: divided where a face turns over, as borders are (`grazing`).
//!
//! Two bodies that pass through one another form a groove along their intersection line: it is visible only where both
//! faces are turned toward the viewer. The outline of a face that turns over ends there, so the line must begin there.
//!
//! ```text
//!        outline of a           the facets of a turn over up to a whole facet before or after the true place x: the
//!      --------------x. . .     line would begin there, and leave a gap, or run on behind the outline
//!                     `- ._
//!      intersection line    ` -
//! ```

use smallvec::SmallVec;

use super::Model;
use super::face::Face;
use super::grazing::{Grazing, Turns, WALL, divided, plane_normal, seen_edge_on, turns};
use super::side::{Side, on_triangle};
use hlr_brep::geometry::vector::{Vector, along, dot, sub};
use hlr_visibility::scan::stretches::Beside;

/// The stretches of edge e, along which two triangles cross.
pub fn grazed_crossing(model: &Model, e: usize, triangles: [i32; 2], out: &mut Vec<Grazing>) {
    let sides: SmallVec<[Side; 2]> = triangles.into_iter().filter_map(|t| curved_side(model, e, t)).collect();
    let found: SmallVec<[(&Side, Turns); 2]> =
        sides.iter().filter(|side| seen_edge_on(model, side)).map(|side| (side, turns(side))).collect();
    let beside = |t: f64| beside(model, e, triangles, &sides, t);
    for (_, _, stretch) in divided(e, &found, beside, |_| None) {
        out.push(Grazing { crossed: Some(triangles), ..stretch });
    }
}

/// The edge on one of its triangles; None where that lies on no curved surface that is known.
fn curved_side<'a>(model: &'a Model<'a>, e: usize, triangle: i32) -> Option<Side<'a>> {
    let t = triangle as usize;
    let number = model.triangle_face[t];
    if !model.faces[number as usize].curved {
        return None;
    }
    let face = Face::new(model, number)?;
    let corners = model.triangles[t].map(|v| &model.points[v as usize]);
    let of_corners = model.corner[t].map(|k| model.uv[k as usize]);
    let uv = model.edges[e].map(|v| on_triangle(&model.points[v as usize], corners, of_corners));
    if uv.iter().flatten().any(|x| !x.is_finite()) {
        return None;
    }
    let [Some(a), Some(b)] = uv.map(|uv| face.f(uv)) else { return None };
    let normal = face.normal([0, 1].map(|k| 0.5 * (uv[0][k] + uv[1][k])))?;
    Some(Side { triangle, number, corners: model.edges[e], uv, f: [a, b], face: Some(face), normal })
}

/// Whether the two faces hide the line at one parameter, if both bodies are closed.
fn beside(model: &Model, e: usize, triangles: [i32; 2], sides: &[Side], t: f64) -> Beside {
    let [a, b] = model.edges[e].map(|v| model.points[v as usize]);
    let sight = model.sight(&along(&a, &sub(&b, &a), t));
    let normal = |triangle: i32| -> Option<Vector> {
        match sides.iter().find(|side| side.triangle == triangle) {
            Some(side) => Some(side.normal_at(t)),
            None if model.faces[model.triangle_face[triangle as usize] as usize].curved => None,
            None => plane_normal(model, triangle),
        }
    };
    let [Some(m), Some(n)] = triangles.map(normal) else { return Beside::Unknown };
    let f = [dot(&m, &sight), dot(&n, &sight)];
    if f.iter().any(|f| *f > WALL) {
        Beside::Hidden
    } else if f.iter().all(|f| *f < -WALL) {
        Beside::Visible
    } else {
        Beside::Unknown
    }
}
