//! Meshes a face whose loops cross or lie upon one another, as neither mesher does.

use crate::faces::border;
use crate::mesh::{Progress, mesh_crossed};
use crate::model::Model;
use crate::tessellate::{MeshedFace, Tessellation};

/// The face, filled as far as its loops enclose it; None where they are open, or beyond repair.
pub fn with_crossed_loops(
    model: &Model,
    meshed: &Tessellation,
    number: usize,
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Option<MeshedFace> {
    let face = &model.faces[number];
    let surface = face.surface.as_ref()?;
    let found = border(model, face, &meshed.lines, deflection).ok()?;
    let mesh = mesh_crossed(surface, &found.loops, deflection, angle, steps)?;
    Some(MeshedFace { mesh, nodes: found.nodes, fault: None, off: found.off })
}
