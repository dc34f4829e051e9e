//! A part in its own frame: each of its faces and edges where it stands, none of them shared with another part.

use rustc_hash::FxHashMap;

use crate::bounds::EMPTY;
use crate::copies::mark_copies;
use crate::explore::{Part, PlacedEdge, PlacedFace, PlacedUse};
use crate::format::{Locations, SurfaceRecord, moved};
use crate::geometry::curve::Curve;
use crate::geometry::moved_surface;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, length, sub};
use crate::model::Model;
use crate::part_topology::part_topology;
use crate::sets::Sets;
use crate::shapes::{Edge, Face, Use, Vertex};

/// A face of a body. `of`: its number in the part that it comes from; None: a cut has made it.
#[derive(Clone)]
pub struct BodyFace {
    pub face: Face,
    pub reversed: bool,
    pub of: Option<u32>,
}

/// Faces and edges in the order of the part's maps. Vertices are numbers with location 0.
#[derive(Clone, Default)]
pub struct Body {
    pub edges: Vec<Edge>,
    pub faces: Vec<BodyFace>,
    pub curves2: Vec<Option<Curve>>,
    pub solids: usize,
}

impl Body {
    /// A part of a model.
    ///
    /// # Errors
    /// Why it cannot be written in its own frame.
    pub fn of_part(model: &Model, number: usize) -> Result<Body, &'static str> {
        let topology = &model.topology[number];
        let mut vertices: FxHashMap<Vertex, u32> = FxHashMap::default();
        let mut vertex = |key: Vertex| {
            let next = vertices.len() as u32;
            (*vertices.entry(key).or_insert(next), 0)
        };
        let mut edges = Vec::with_capacity(topology.edges.len());
        for placed in &topology.edges {
            let mut edge = model.edges[placed.edge as usize].clone();
            edge.ends = placed.ends.map(|end| Some(vertex(end)));
            edge.on.clear();
            edge.joints.clear();
            edge.original = None;
            if let Some(place) = &placed.place {
                if edge.only_on.is_some() {
                    return Err("an edge has no curve in space");
                }
                edge.curve = edge.curve.map(|curve| curve.moved(place));
                edge.end_points = edge.end_points.map(|point| point.map(|p| moved(place, &p)));
                edge.polygon = edge.polygon.map(|points| points.iter().map(|p| moved(place, p)).collect());
            }
            edges.push(edge);
        }
        let mut curves2: Vec<Option<Curve>> = Vec::new();
        let mut numbers: FxHashMap<usize, usize> = FxHashMap::default();
        let mut curve2 = |number: usize| {
            *numbers.entry(number).or_insert_with(|| {
                curves2.push(model.curves2[number].clone());
                curves2.len() - 1
            })
        };
        for edge in &mut edges {
            if let Some((curve, _)) = edge.only_on.as_deref_mut() {
                *curve = curve2(*curve);
            }
        }
        let mut faces = Vec::with_capacity(topology.faces.len());
        for (of, placed) in (0..).zip(&topology.faces) {
            let own = &model.faces[placed.face as usize];
            let mut face = Face { wires: Vec::with_capacity(own.wires.len()), no_area: false, ..own.clone() };
            if let Some(place) = &placed.place {
                let triangles = face.own.iter_mut().flat_map(|own| &mut own.points);
                triangles.for_each(|p| *p = moved(place, p));
                let record = own.record.as_ref().and_then(|r| {
                    Some(SurfaceRecord { kind: r.kind, data: moved_surface::moved(r.kind, &r.data, place)? })
                });
                face.surface = record.as_ref().and_then(|r| Surface::read(r.kind, &r.data));
                face.record = record;
            }
            let mut uses = placed.uses.iter();
            for wire in &own.wires {
                let mut found = Vec::with_capacity(wire.len());
                for (used, &edge) in wire.iter().zip(&mut uses) {
                    let placed = topology.edges.get(edge as usize).ok_or("an edge is missing")?;
                    let ends = placed.ends.map(&mut vertex);
                    let curve2 = used.curve2.map(|(curve, range)| (curve2(curve), range));
                    found.push(Use { edge, location: 0, place: None, orientation: used.orientation, ends, curve2 });
                }
                face.wires.push(found);
            }
            faces.push(BodyFace { face, reversed: placed.reversed != placed.mirrored, of: Some(of) });
        }
        Ok(Body { edges, faces, curves2, solids: model.parts[number].solids })
    }

    /// Whether each edge is used as often in one sense as in the other.
    pub fn is_closed(&self) -> bool {
        let mut sums = vec![0i32; self.edges.len()];
        for face in &self.faces {
            for used in face.face.wires.iter().flatten() {
                sums[used.edge as usize] += used.orientation.sense(face.reversed);
            }
        }
        !self.faces.is_empty() && sums.iter().zip(&self.edges).all(|(sum, edge)| *sum == 0 || edge.degenerate)
    }

    /// Whether some of its faces, which hang together, lie within the box of others: they may be a cavity of these, and
    /// without a solid nothing says so.
    pub fn is_nested(&self) -> bool {
        let mut sets = Sets::new(self.faces.len());
        let mut first = vec![None; self.edges.len()];
        for (f, face) in self.faces.iter().enumerate() {
            for used in face.face.wires.iter().flatten() {
                sets.unite(*first[used.edge as usize].get_or_insert(f), f);
            }
        }
        let mut boxes = vec![EMPTY; self.faces.len()];
        for (edge, f) in self.edges.iter().zip(&first).filter_map(|(edge, f)| Some((edge, (*f)?))) {
            let set = sets.first(f);
            edge_points(edge).for_each(|p| grow(&mut boxes[set], &p));
        }
        let whole: Vec<[Vector; 2]> = (0..boxes.len()).filter(|&f| sets.first(f) == f).map(|f| boxes[f]).collect();
        let within = |a: &[Vector; 2], b: &[Vector; 2]| (0..3).all(|k| a[0][k] >= b[0][k] && a[1][k] <= b[1][k]);
        whole.iter().enumerate().any(|(i, a)| whole.iter().enumerate().any(|(j, b)| i != j && within(a, b)))
    }

    /// The diagonal of the box around the edges' ends and some points between them.
    pub fn size(&self) -> f64 {
        let mut all = EMPTY;
        self.edges.iter().flat_map(edge_points).for_each(|p| grow(&mut all, &p));
        length(&sub(&all[1], &all[0]))
    }
}

/// The ends of an edge, and some points between them.
fn edge_points(edge: &Edge) -> impl Iterator<Item = Vector> {
    let [first, last] = edge.range;
    let between = move |quarter: f64| edge.curve.as_ref().map(|curve| curve.point(first + quarter * (last - first)));
    edge.end_points.into_iter().chain([0.25, 0.5, 0.75].map(between)).flatten()
}

fn grow([low, high]: &mut [Vector; 2], p: &Vector) {
    for k in 0..3 {
        (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
    }
}

/// A model of bodies, one part each. Without classes of edges it can be meshed, but not drawn.
pub fn model_of(bodies: Vec<Body>, classified: bool) -> Model {
    let (mut edges, mut faces, mut curves2, mut parts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for body in bodies {
        let [edge, face, curve2] = [edges.len(), faces.len(), curves2.len()];
        let mut part = Part { solids: body.solids, ..Part::default() };
        part.edges.extend((0..body.edges.len()).map(|i| PlacedEdge { edge: (edge + i) as u32, location: 0 }));
        for (i, mut own) in (0..).zip(body.faces) {
            part.faces.push(PlacedFace { face: face as u32 + i, location: 0, reversed: own.reversed, mirrored: false });
            for used in own.face.wires.iter_mut().flatten() {
                part.uses.push(PlacedUse { edge: used.edge, face: i, orientation: used.orientation });
                used.edge += edge as u32;
                used.curve2 = used.curve2.map(|(curve, range)| (curve2 + curve, range));
            }
            faces.push(own.face);
        }
        edges.extend(body.edges.into_iter().map(|mut own| {
            if let Some((curve, _)) = own.only_on.as_deref_mut() {
                *curve += curve2;
            }
            own
        }));
        curves2.extend(body.curves2);
        parts.push(part);
    }
    mark_copies(&mut faces, &mut edges);
    let mut locations = Locations::none();
    let topology = parts.iter().map(|part| part_topology(part, &faces, &edges, &mut locations)).collect();
    let mut model =
        Model { locations, edges, faces, parts, topology, classes: Vec::new(), folded: Vec::new(), curves2 };
    if classified {
        model.classify();
    }
    model
}
