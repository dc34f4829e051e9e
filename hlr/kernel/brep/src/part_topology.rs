//! The topology of a part: its edges, its faces, which faces share an edge, and where each of them is placed.

use rustc_hash::{FxBuildHasher, FxHashMap};
use smallvec::SmallVec;

use crate::explore::Part;
use crate::format::{Locations, Matrix};
use crate::shapes::{Edge, Face, Vertex};

pub struct PartTopology {
    pub edges: Vec<PartEdge>,
    pub faces: Vec<PartFace>,
    /// The uses of each edge by faces: face, wire, and number in the wire, in the order of the faces.
    places: Vec<[u32; 3]>,
    /// Index in `places` of the first use of each edge.
    first_place: Vec<u32>,
}

impl PartTopology {
    /// The uses of an edge by a face, in order: wire, and number in the wire.
    pub fn places(&self, edge: u32, face: u32) -> impl Iterator<Item = [usize; 2]> + '_ {
        let [begin, end] = [0, 1].map(|k| self.first_place[edge as usize + k] as usize);
        let all = self.places[begin..end].iter().filter(move |place| place[0] == face);
        all.map(|&[_, wire, number]| [wire as usize, number as usize])
    }
}

pub struct PartEdge {
    pub edge: u32,
    pub location: u32,
    pub place: Option<Matrix>,
    pub ends: [Vertex; 2],
    /// The faces of the part that share the edge, each once.
    pub faces: SmallVec<[u32; 2]>,
    /// Whether a face has the edge more than once.
    pub twice: bool,
    /// Whether the edge lies inside a face.
    pub inner: bool,
}

pub struct PartFace {
    pub face: u32,
    pub place: Option<Matrix>,
    pub reversed: bool,
    pub mirrored: bool,
    /// Numbers in the part of the edges that the face's wires use, one wire after another.
    pub uses: Vec<u32>,
    /// Locations within the part by locations within the face, where the two differ.
    locations: FxHashMap<u32, u32>,
}

impl PartFace {
    pub fn location(&self, within: u32) -> u32 {
        self.locations.get(&within).copied().unwrap_or(within)
    }
}

pub fn part_topology(
    part: &Part,
    model_faces: &[Face],
    model_edges: &[Edge],
    locations: &mut Locations,
) -> PartTopology {
    let place = |locations: &mut Locations, number: u32| (number != 0).then(|| locations.matrix(number));
    let mut numbers: FxHashMap<(u32, u32), u32> = FxHashMap::with_capacity_and_hasher(part.edges.len(), FxBuildHasher);
    let mut edges = Vec::with_capacity(part.edges.len());
    for (i, placed) in (0..).zip(&part.edges) {
        numbers.insert((placed.edge, placed.location), i);
        let ends = model_edges[placed.edge as usize]
            .ends(placed.edge)
            .map(|(shape, within)| (shape, locations.product(placed.location, within)));
        edges.push(PartEdge {
            edge: placed.edge,
            location: placed.location,
            place: place(locations, placed.location),
            ends,
            faces: SmallVec::new(),
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
    let faces: Vec<PartFace> = part
        .faces
        .iter()
        .map(|placed| {
            let matrix = place(locations, placed.location);
            let mut within = FxHashMap::default();
            let wires = &model_faces[placed.face as usize].wires;
            let mut uses = Vec::with_capacity(wires.iter().map(Vec::len).sum());
            for used in wires.iter().flatten() {
                let mut location = used.location;
                if placed.location != 0 {
                    for number in [used.location, used.ends[0].1, used.ends[1].1] {
                        within.entry(number).or_insert_with(|| locations.product(placed.location, number));
                    }
                    location = within[&location];
                }
                uses.push(numbers.get(&(used.edge, location)).copied().unwrap_or(u32::MAX));
            }
            PartFace {
                face: placed.face,
                place: matrix,
                reversed: placed.reversed,
                mirrored: placed.mirrored,
                uses,
                locations: within,
            }
        })
        .collect();
    let (places, first_place) = places(&faces, model_faces, edges.len());
    PartTopology { edges, faces, places, first_place }
}

fn places(faces: &[PartFace], model_faces: &[Face], edges: usize) -> (Vec<[u32; 3]>, Vec<u32>) {
    let known = |edge: &&u32| (**edge as usize) < edges;
    let mut first = vec![0u32; edges + 1];
    faces.iter().flat_map(|face| &face.uses).filter(known).for_each(|&edge| first[edge as usize + 1] += 1);
    for i in 0..edges {
        first[i + 1] += first[i];
    }
    let mut next = first.clone();
    let mut places = vec![[0; 3]; first[edges] as usize];
    for (number, face) in (0..).zip(faces) {
        let mut uses = face.uses.iter();
        for (w, wire) in (0..).zip(&model_faces[face.face as usize].wires) {
            for (k, edge) in (0..wire.len() as u32).zip(&mut uses) {
                if known(&edge) {
                    let place = &mut next[*edge as usize];
                    places[*place as usize] = [number, w, k];
                    *place += 1;
                }
            }
        }
    }
    (places, first)
}
