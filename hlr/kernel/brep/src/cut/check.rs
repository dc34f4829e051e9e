//! Whether the pieces of a body are what a plane leaves of it: closed, and of the right volume.

use super::plane::Plane;
use crate::body::{Body, model_of};
use crate::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub};
use crate::tessellate::{LIMITS, Tessellation, Watch, tessellate};
use hlr_accuracy::CUT_DISPLACED;

/// Of the area of a closed mesh: how far its area, as a vector, may be from zero.
const OPEN: f64 = 1e-7;

/// What a mesh encloses, its volume six times; seen from a point, as cones over its triangles.
#[derive(Default)]
struct Enclosed {
    area: Vector,
    size: f64,
    volume: f64,
}

impl Enclosed {
    /// Adds a triangle as seen from the origin.
    fn add(&mut self, [a, b, c]: [Vector; 3]) {
        let area = scaled(&cross(&sub(&b, &a), &sub(&c, &a)), 0.5);
        self.area = add(&self.area, &area);
        self.size += length(&area);
        self.volume += dot(&a, &cross(&b, &c));
    }
}

/// # Errors
/// What is wrong with the pieces.
pub fn check(
    body: &Body,
    guided: &Tessellation,
    pieces: &[Body],
    plane: &Plane,
    deflection: f64,
    angle: f64,
    watch: &Watch,
) -> Result<(), &'static str> {
    // Seen from a point of the plane, the faces on it enclose nothing with it.
    let from = plane.foot(&guided.lines.iter().flatten().next().map_or([0.0; 3], |line| line.points[0]));
    let mut below = Enclosed::default();
    let each = body.faces.iter().zip(&guided.faces);
    for (own, t) in each.flat_map(|(own, face)| {
        face.mesh.triangles.iter().map(move |t| (own.reversed, t.map(|i| face.mesh.points[i as usize])))
    }) {
        let t = t.map(|p| sub(&p, &from));
        add_below(if own { [t[0], t[2], t[1]] } else { t }, &plane.normal, &mut below);
    }
    let model = model_of(pieces.to_vec(), false);
    let meshed = tessellate(&model, deflection, angle, LIMITS, watch).map_err(|_| "it was stopped")?;
    if meshed.faces.iter().any(|face| face.fault.is_some()) {
        return Err("a face that is cut has no mesh");
    }
    let mut whole = Enclosed::default();
    for part in &model.parts {
        let mut piece = Enclosed::default();
        for placed in &part.faces {
            let mesh = &meshed.faces[placed.face as usize].mesh;
            for t in &mesh.triangles {
                let t = if placed.reversed { [t[0], t[2], t[1]] } else { *t };
                piece.add(t.map(|i| sub(&mesh.points[i as usize], &from)));
            }
        }
        if length(&piece.area) > OPEN * piece.size {
            return Err("a piece does not close");
        }
        whole.volume += piece.volume;
        whole.size += piece.size;
    }
    let most = 6.0 * CUT_DISPLACED * deflection * (below.size + whole.size);
    if (whole.volume - below.volume).abs() > most { Err("what is left has another volume") } else { Ok(()) }
}

/// Adds what lies below a plane through the origin.
fn add_below(t: [Vector; 3], normal: &Vector, to: &mut Enclosed) {
    let height = t.map(|p| dot(&p, normal));
    let mut kept: Vec<Vector> = Vec::with_capacity(4);
    for k in 0..3 {
        let n = (k + 1) % 3;
        if height[k] <= 0.0 {
            kept.push(t[k]);
        }
        if (height[k] <= 0.0) != (height[n] <= 0.0) {
            kept.push(along(&t[k], &sub(&t[n], &t[k]), height[k] / (height[k] - height[n])));
        }
    }
    for k in 2..kept.len() {
        to.add([kept[0], kept[k - 1], kept[k]]);
    }
}
