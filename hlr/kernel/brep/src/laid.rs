//! Parts with everything that stands in them told by its place in the part: what faces and edges share.

use std::collections::HashMap;

use crate::explore::Part;
use crate::format::{Locations, Matrix, determinant};
use crate::model::{Edge, Face, Vertex};

pub struct LaidPart {
    pub edges: Vec<LaidEdge>,
    pub faces: Vec<LaidFace>,
}

pub struct LaidEdge {
    pub edge: u32,
    pub location: u32,
    pub place: Option<Matrix>,
    pub ends: [Vertex; 2],
    /// Faces of the part around it, each once.
    pub faces: Vec<u32>,
    /// A face has it more than once.
    pub twice: bool,
    /// It lies inside a face.
    pub inner: bool,
}

pub struct LaidFace {
    pub face: u32,
    pub place: Option<Matrix>,
    pub reversed: bool,
    pub mirrored: bool,
    /// Numbers in the part of the edges that its wires run through, one wire after another.
    pub uses: Vec<u32>,
    /// From locations within the face to locations within the part.
    locations: HashMap<u32, u32>,
}

impl LaidFace {
    pub fn location(&self, within: u32) -> u32 {
        self.locations.get(&within).copied().unwrap_or(within)
    }
}

pub fn laid(part: &Part, model_faces: &[Face], model_edges: &[Edge], locations: &mut Locations) -> LaidPart {
    let place = |locations: &mut Locations, number: u32| (number != 0).then(|| locations.matrix(number));
    let mut numbers: HashMap<(u32, u32), u32> = HashMap::with_capacity(part.edges.len());
    let mut edges = Vec::with_capacity(part.edges.len());
    for (i, placed) in (0..).zip(&part.edges) {
        numbers.insert((placed.edge, placed.location), i);
        let ends = model_edges[placed.edge as usize]
            .ends(placed.edge)
            .map(|(shape, within)| (shape, locations.product(placed.location, within)));
        edges.push(LaidEdge {
            edge: placed.edge,
            location: placed.location,
            place: place(locations, placed.location),
            ends,
            faces: Vec::new(),
            twice: false,
            inner: false,
        });
    }
    for used in &part.uses {
        let edge = &mut edges[used.edge as usize];
        edge.inner |= !used.orientation.bounds();
        if edge.faces.contains(&used.face) {
            edge.twice = true;
        } else {
            edge.faces.push(used.face);
        }
    }
    let faces = part
        .faces
        .iter()
        .map(|placed| {
            let matrix = place(locations, placed.location);
            let mut within = HashMap::new();
            let mut uses = Vec::new();
            for used in model_faces[placed.face as usize].wires.iter().flatten() {
                for number in [used.location, used.ends[0].1, used.ends[1].1] {
                    within.entry(number).or_insert_with(|| locations.product(placed.location, number));
                }
                uses.push(numbers.get(&(used.edge, within[&used.location])).copied().unwrap_or(u32::MAX));
            }
            LaidFace {
                face: placed.face,
                place: matrix,
                reversed: placed.reversed,
                mirrored: matrix.is_some_and(|m| determinant(&m) < 0.0),
                uses,
                locations: within,
            }
        })
        .collect();
    LaidPart { edges, faces }
}
