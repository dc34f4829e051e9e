//! One face, meshed with the chords of its border as they are.

use hlr_accuracy::MESH_COARSER;

use super::tessellation::MeshedFace;
use crate::edges::Polyline;
use crate::faces::{Border, border};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::mesh::{FaceMesh, Fault, Progress, long_chords, mesh_face, upon_one_another};
use crate::model::Model;
use crate::shapes::Face;

/// What came of a face.
#[derive(Default)]
pub struct Tried {
    pub face: MeshedFace,
    /// Chords to be divided, each as edge and number along the edge.
    pub coarse: Vec<(u32, u32)>,
    /// The face was not meshed, because its chords are to be divided first.
    pub waits: bool,
}

/// Which chords can still be divided.
#[derive(Clone, Copy)]
pub struct Divisible {
    /// Those that are too coarse: the face is meshed only after that.
    pub coarse: bool,
    /// Those that lie upon one another.
    pub upon_one_another: bool,
}

/// A face without a mesh, and the chords to be divided.
pub fn failed(fault: Fault, coarse: Vec<(u32, u32)>) -> Tried {
    Tried { face: MeshedFace { fault: Some(fault), ..MeshedFace::default() }, coarse, waits: false }
}

/// Meshes one face.
pub fn try_face(
    model: &Model,
    face: &Face,
    lines: &[Option<Polyline>],
    deflection: f64,
    angle: f64,
    divisible: Divisible,
    steps: &Progress,
) -> Tried {
    if face.no_area {
        return Tried::default();
    }
    if let Some(own) = &face.own {
        let uv = if own.uv.is_empty() { vec![[f64::NAN; 2]; own.points.len()] } else { own.uv.clone() };
        let mesh = FaceMesh {
            uv,
            normals: vec![[0.0; 3]; own.points.len()],
            points: own.points.clone(),
            nodes: Vec::new(),
            triangles: own.triangles.clone(),
            turned: Vec::new(),
            torn: 0.0,
            unfinished: 0.0,
        };
        return Tried { face: MeshedFace { mesh, ..MeshedFace::default() }, coarse: Vec::new(), waits: false };
    }
    let Some(surface) = &face.surface else { return failed(Fault::Degenerate, Vec::new()) };
    let found = match border(model, face, lines, deflection) {
        Ok(found) => found,
        Err(fault) => return failed(fault, Vec::new()),
    };
    let coarse = if divisible.coarse { found.coarse(surface, deflection) } else { Vec::new() };
    if !coarse.is_empty() {
        return Tried { waits: true, ..failed(Fault::NotCertified(f64::INFINITY, Vec::new()), coarse) };
    }
    let Border { mut loops, nodes, chords, off } = found;
    // Two edges that consist of the same single chord enclose nothing at this deflection.
    let encloses = |l: &Vec<crate::mesh::LoopPoint>| l.len() > 2;
    let kept: Vec<usize> = (0..loops.loops.len()).filter(|&i| encloses(&loops.loops[i])).collect();
    if kept.is_empty() {
        // An edge and its own copy.
        let one = |row: &Vec<Option<(u32, u32)>>| row.iter().all(|c| c.map(|c| c.0) == row[0].map(|c| c.0));
        if chords.iter().all(one) {
            return failed(Fault::Open, Vec::new());
        }
        return Tried { face: MeshedFace { nodes, ..MeshedFace::default() }, coarse: Vec::new(), waits: false };
    }
    let chords: Vec<_> = kept.iter().map(|&i| &chords[i]).collect();
    loops.loops.retain(encloses);
    if divisible.coarse && matches!(surface, Surface::Spline(_) | Surface::Offset(..)) {
        let is_straight = |chord: &(u32, u32)| matches!(model.edges[chord.0 as usize].curve, Some(Curve::Line { .. }));
        if chords.iter().flat_map(|row| row.iter().flatten()).any(is_straight) {
            let long = long_chords(surface, &loops, deflection, angle, steps).into_iter();
            let long: Vec<_> = long.filter_map(|[l, c]| *chords.get(l)?.get(c)?).filter(is_straight).collect();
            if !long.is_empty() {
                return Tried { waits: true, ..failed(Fault::NotCertified(f64::INFINITY, Vec::new()), long) };
            }
        }
    }
    match mesh_face(surface, &loops, deflection, angle, steps) {
        Ok(mesh) => Tried { face: MeshedFace { mesh, nodes, fault: None, off }, coarse: Vec::new(), waits: false },
        Err(fault) => {
            let named: Vec<[usize; 2]> = match &fault {
                Fault::Crossing(pairs) => {
                    let upon = if divisible.upon_one_another {
                        vec![false; pairs.len()]
                    } else {
                        upon_one_another(&loops, pairs)
                    };
                    let parted = pairs.iter().zip(upon).filter(|(_, upon)| !upon);
                    parted.flat_map(|(&[a, i, b, j], _)| [[a, i], [b, j]]).collect()
                }
                Fault::NotCertified(_, coarse) => coarse.clone(),
                _ => Vec::new(),
            };
            let coarse = named.iter().filter_map(|&[l, c]| *chords.get(l)?.get(c)?).collect();
            failed(fault, coarse)
        }
    }
}

/// Meshes a face for a larger chord error, as it is before points are inserted. Any fault is that of too much work.
pub fn coarser(
    model: &Model,
    face: &Face,
    lines: &[Option<Polyline>],
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Tried {
    let most = MESH_COARSER * deflection;
    let mut tried =
        try_face(model, face, lines, most, angle, Divisible { coarse: false, upon_one_another: false }, steps);
    if tried.face.fault.is_some() {
        return failed(Fault::TooMuchWork, Vec::new());
    }
    tried.face.mesh.unfinished = tried.face.mesh.unfinished.max(most);
    tried
}
