//! The mesh of a part, put together from the meshes of its faces. Faces share their nodes along common edges.

use rayon::prelude::*;
use rustc_hash::{FxBuildHasher, FxHashMap};

use crate::faces::Node;
use crate::format::{IDENTITY, Matrix, determinant, moved};
use crate::model::Model;
use crate::outward::inward;
use crate::part_topology::{PartEdge, PartTopology};
use crate::shapes::Vertex;
use crate::tessellate::Tessellation;

/// One part's mesh. Triangles are counterclockwise seen from outside.
#[derive(Default)]
pub struct PartMesh {
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[i32; 3]>,
    pub triangle_face: Vec<i32>,
    /// Indices into `points` of the edges' polylines, one after another; then number and class of each edge.
    pub edge_nodes: Vec<i32>,
    pub edge_counts: Vec<i32>,
    pub edge_index: Vec<i32>,
    pub edge_class: Vec<u8>,
    /// Corners of the triangles as indices into uv: a point on an edge has different parameters on each of its faces.
    pub corner: Vec<[i32; 3]>,
    pub uv: Vec<[f64; 2]>,
    pub face_shape: Vec<i32>,
    pub face_place: Vec<Matrix>,
    pub face_reversed: Vec<bool>,
}

pub fn assemble(model: &Model, meshed: &Tessellation) -> Vec<PartMesh> {
    (0..model.topology.len()).into_par_iter().map(|p| part(model, meshed, p)).collect()
}

/// For each edge of a part the point numbers of its polyline's corners.
struct Corners {
    start: Vec<u32>,
    of_edge: Vec<u32>,
    vertices: FxHashMap<Vertex, u32>,
    points: Vec<[f64; 3]>,
}

impl Corners {
    fn of(&self, edge: usize) -> &[u32] {
        &self.of_edge[self.start[edge] as usize..self.start[edge + 1] as usize]
    }
}

fn corners(model: &Model, meshed: &Tessellation, topology: &PartTopology) -> Corners {
    let lines = topology.edges.iter().filter_map(|edge| meshed.lines[edge.edge as usize].as_ref());
    let count = lines.map(|line| line.points.len()).sum();
    let mut out = Corners {
        start: Vec::with_capacity(topology.edges.len() + 1),
        of_edge: Vec::with_capacity(count),
        vertices: FxHashMap::with_capacity_and_hasher(topology.edges.len(), FxBuildHasher),
        points: Vec::with_capacity(count),
    };
    out.start.push(0);
    for edge in &topology.edges {
        if let Some(line) = &meshed.lines[edge.edge as usize] {
            let place = |p: &[f64; 3]| edge.place.as_ref().map_or(*p, |m| moved(m, p));
            let last = line.points.len() - 1;
            for (k, point) in line.points.iter().enumerate() {
                let next = out.points.len() as u32;
                let number = match k {
                    0 => *out.vertices.entry(edge.ends[0]).or_insert(next),
                    k if k == last => *out.vertices.entry(edge.ends[1]).or_insert(next),
                    _ => next,
                };
                if number == next {
                    out.points.push(place(point));
                }
                out.of_edge.push(number);
            }
        }
        out.start.push(out.of_edge.len() as u32);
    }
    // Copies of edges have the points of their originals, where these are in the part as well.
    for (i, edge) in topology.edges.iter().enumerate() {
        let Some((original, reversed)) = model.edges[edge.edge as usize].original else { continue };
        let is_original = |other: &PartEdge| other.edge == original && other.location == edge.location;
        let Some(other) = topology.edges.iter().position(is_original) else { continue };
        let mut points = out.of(other).to_vec();
        if reversed {
            points.reverse();
        }
        let start = out.start[i] as usize;
        out.of_edge[start..start + points.len()].copy_from_slice(&points);
    }
    out
}

fn part(model: &Model, meshed: &Tessellation, number: usize) -> PartMesh {
    let topology = &model.topology[number];
    let mut corners = corners(model, meshed, topology);
    let mut out = PartMesh::default();
    let meshes = || topology.faces.iter().map(|face| &meshed.faces[face.face as usize].mesh);
    let [triangles, points]: [usize; 2] =
        [meshes().map(|mesh| mesh.triangles.len()).sum(), meshes().map(|mesh| mesh.points.len()).sum()];
    out.triangles.reserve(triangles);
    out.triangle_face.reserve(triangles);
    out.corner.reserve(triangles);
    out.uv.reserve(points);
    corners.points.reserve(points);
    let mut degenerate_ends: FxHashMap<Vertex, u32> = FxHashMap::default();
    let edge_number: FxHashMap<(u32, u32), u32> =
        (0..).zip(&topology.edges).map(|(i, edge)| ((edge.edge, edge.location), i)).collect();
    for (f, face) in topology.faces.iter().enumerate() {
        let found = &meshed.faces[face.face as usize];
        let mesh = &found.mesh;
        let place = |p: &[f64; 3]| face.place.as_ref().map_or(*p, |m| moved(m, p));
        // Points of the part for the nodes of the face; the nodes of an edge are consecutive.
        let mut last: Option<((u32, u32), u32)> = None;
        let nodes: Vec<u32> = found
            .nodes
            .iter()
            .map(|node| match *node {
                Node::Vertex((shape, location)) => {
                    let key = (shape, face.location(location));
                    let known = corners.vertices.get(&key).or_else(|| degenerate_ends.get(&key));
                    known.copied().unwrap_or_else(|| {
                        // A vertex of edges without a polyline: its place comes from the first point with its number.
                        let next = corners.points.len() as u32;
                        degenerate_ends.insert(key, next);
                        corners.points.push([f64::NAN; 3]);
                        next
                    })
                }
                Node::Edge(edge, location, corner) => {
                    let edge = match last {
                        Some((key, number)) if key == (edge, location) => number,
                        _ => {
                            let number = edge_number[&(edge, face.location(location))];
                            last = Some(((edge, location), number));
                            number
                        }
                    };
                    corners.of(edge as usize)[corner as usize]
                }
                // Its place comes from the first point with its number.
                Node::Inside(_) => {
                    corners.points.push([f64::NAN; 3]);
                    corners.points.len() as u32 - 1
                }
            })
            .collect();
        let first_uv = out.uv.len() as i32;
        out.uv.extend(&mesh.uv);
        let mut point_of: Vec<u32> = Vec::with_capacity(mesh.points.len());
        for (i, point) in mesh.points.iter().enumerate() {
            let number = match mesh.nodes.get(i) {
                Some(&node) => nodes[node as usize],
                None => {
                    corners.points.push([f64::NAN; 3]);
                    corners.points.len() as u32 - 1
                }
            };
            if corners.points[number as usize][0].is_nan() {
                corners.points[number as usize] = place(point);
            }
            point_of.push(number);
        }
        let turned = face.reversed != face.mirrored;
        for &[a, b, c] in &mesh.triangles {
            let t = if turned { [a, c, b] } else { [a, b, c] };
            let points = t.map(|i| point_of[i as usize] as i32);
            if points[0] != points[1] && points[1] != points[2] && points[2] != points[0] {
                out.triangles.push(points);
                out.triangle_face.push(f as i32);
                out.corner.push(t.map(|i| first_uv + i as i32));
            }
        }
        out.face_shape.push(face.face as i32);
        out.face_place.push(face.place.unwrap_or(IDENTITY));
        // Its surface is placed as its place says, whatever the faces beside it count as.
        let image = face.place.is_some_and(|place| determinant(&place) < 0.0);
        out.face_reversed.push(face.reversed != (face.mirrored != image));
    }
    if model.parts[number].solids == 0 {
        turn_outward(model, topology, &corners.points, &mut out);
    }
    lines(model, meshed, number, &corners, &mut out);
    compress(corners.points, &mut out);
    out
}

fn turn_outward(model: &Model, topology: &PartTopology, points: &[[f64; 3]], out: &mut PartMesh) {
    let inward = inward(topology, &model.edges, points, &out.triangles, &out.triangle_face);
    for ((t, corner), &face) in out.triangles.iter_mut().zip(&mut out.corner).zip(&out.triangle_face) {
        if inward[face as usize] {
            t.swap(1, 2);
            corner.swap(1, 2);
        }
    }
    out.face_reversed.iter_mut().zip(inward).for_each(|(reversed, inward)| *reversed ^= inward);
}

fn lines(model: &Model, meshed: &Tessellation, number: usize, corners: &Corners, out: &mut PartMesh) {
    for (e, topology) in model.topology[number].edges.iter().enumerate() {
        let edge = &model.edges[topology.edge as usize];
        let Some(line) = meshed.lines[topology.edge as usize].as_ref().filter(|_| !edge.degenerate) else { continue };
        let all = corners.of(e);
        let classes = &model.classes[number][e];
        let mut begin = 0;
        let of_pieces = std::iter::once(&classes.first).chain(classes.more.iter().map(|(_, class)| class));
        for (piece, class) in of_pieces.enumerate() {
            let end = classes.more.get(piece).map_or(all.len() - 1, |(joint, _)| {
                let at = line.parameters.partition_point(|t| t < joint);
                at.clamp(begin, all.len() - 1)
            });
            let first = out.edge_nodes.len();
            for &node in &all[begin..=end] {
                if out.edge_nodes[first..].last() != Some(&(node as i32)) {
                    out.edge_nodes.push(node as i32);
                }
            }
            if out.edge_nodes.len() > first + 1 {
                out.edge_counts.push((out.edge_nodes.len() - first) as i32);
                out.edge_index.push(e as i32);
                out.edge_class.push(*class as u8);
            } else {
                out.edge_nodes.truncate(first);
            }
            begin = end;
        }
    }
}

/// Keeps the points that are used, in their order.
fn compress(points: Vec<[f64; 3]>, out: &mut PartMesh) {
    let mut used = vec![false; points.len()];
    out.triangles.iter().flatten().chain(&out.edge_nodes).for_each(|&i| used[i as usize] = true);
    if !used.contains(&false) {
        out.points = points;
        return;
    }
    let mut number = vec![-1i32; points.len()];
    out.points.reserve(points.len());
    for ((n, used), point) in number.iter_mut().zip(used).zip(points) {
        if used {
            *n = out.points.len() as i32;
            out.points.push(point);
        }
    }
    for i in out.triangles.iter_mut().flatten().chain(&mut out.edge_nodes) {
        *i = number[*i as usize];
    }
}
