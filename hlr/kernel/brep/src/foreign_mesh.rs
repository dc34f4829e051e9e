//! Joins the mesh of a face that another mesher made to the polylines of the face's edges.
//!
//! The border of that mesh has other corners than the polylines. Each of them moves along the edge to the nearest
//! corner of the polyline. Corners of the polyline that none moved to divide the triangle beside them:
//!
//! ```text
//!  ours     o-----o-----o-----o        o-----o-----o-----o
//!           |                 |         \     \   /     /
//!  theirs   x-------x---------x    ->    x     \ /     x
//!            \     / \       /            (fans to the third corners)
//! ```

use rustc_hash::FxHashMap;

use crate::faces::Node;
use crate::format::{Orientation, moved};
use crate::geometry::surface::Surface;
use crate::geometry::vector::{cross, length, sub};
use crate::mesh::FaceMesh;
use crate::model::Model;
use crate::tessellate::{MeshedFace, Tessellation};

/// An edge's corners on the foreign mesh: nodes, in the sense of the edge, and their parameters on its curve.
pub struct Border {
    pub nodes: Vec<u32>,
    pub parameters: Vec<f64>,
}

pub struct ForeignMesh {
    pub points: Vec<[f64; 3]>,
    pub uv: Vec<[f64; 2]>,
    /// Counterclockwise in (u, v).
    pub triangles: Vec<[u32; 3]>,
    /// One border for each edge in each wire of the face.
    pub borders: Vec<Border>,
}

/// The face with the foreign mesh; None if the mesh has another border than the face, or another area than the surface.
pub fn with_foreign_mesh(
    model: &Model,
    meshed: &Tessellation,
    number: usize,
    mut foreign: ForeignMesh,
) -> Option<MeshedFace> {
    let face = &model.faces[number];
    let uses: Vec<_> = face.wires.iter().flatten().collect();
    if uses.len() != foreign.borders.len() || !is_sound(&foreign, uses.iter().map(|used| used.orientation)) {
        return None;
    }
    let mut node_of: FxHashMap<u32, Node> = FxHashMap::default();
    let mut fans: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for (used, border) in uses.into_iter().zip(&foreign.borders) {
        let line = meshed.lines[used.edge as usize].as_ref()?;
        let last = line.points.len() - 1;
        let steps = border.nodes.len().checked_sub(1)?;
        if steps == 0 || border.parameters.len() != border.nodes.len() {
            return None;
        }
        let place = |k: usize| used.place.as_ref().map_or(line.points[k], |m| moved(m, &line.points[k]));
        let corner = |k: usize| match k {
            0 => Node::Vertex(used.ends[0]),
            k if k == last => Node::Vertex(used.ends[1]),
            k => Node::Edge(used.edge, used.location, k as u32),
        };
        let (mut before, mut before_node) = (0, border.nodes[0]);
        node_of.entry(before_node).or_insert_with(|| corner(0));
        foreign.points[before_node as usize] = place(0);
        for j in 1..=steps {
            let at = border.nodes[j];
            let k = if j == steps { last } else { nearest(&line.parameters, border.parameters[j]).clamp(before, last) };
            if model.edges[used.edge as usize].degenerate {
                node_of.insert(at, corner(0));
            } else {
                node_of.entry(at).or_insert_with(|| corner(k));
                foreign.points[at as usize] = place(k);
                // Corners of the polyline that the foreign mesh lacks.
                let mut between = Vec::new();
                for inner in before + 1..k {
                    let share = (inner - before) as f64 / (k - before) as f64;
                    let [p, q] = [before_node, at].map(|n| foreign.uv[n as usize]);
                    let new = foreign.points.len() as u32;
                    foreign.points.push(place(inner));
                    foreign.uv.push([0, 1].map(|c| p[c] + share * (q[c] - p[c])));
                    node_of.insert(new, corner(inner));
                    between.push(new);
                }
                if !between.is_empty() {
                    if used.orientation == Orientation::Internal {
                        return None;
                    }
                    fans.insert([at, before_node], between.iter().rev().copied().collect());
                    fans.insert([before_node, at], between);
                }
            }
            (before, before_node) = (k, at);
        }
    }
    let mut triangles = Vec::with_capacity(foreign.triangles.len());
    foreign.triangles.iter().for_each(|t| divide(*t, &fans, &mut triangles));
    if !face.surface.as_ref().is_none_or(|surface| covers(surface, &foreign, &triangles)) {
        return None;
    }
    Some(ordered(foreign, triangles, &node_of, face.surface.as_ref()))
}

/// Whether the triangles have the same area in space as the part of the surface below them in (u, v). Triangles that
/// join both sides of a seam have no such part; folds have too much area.
fn covers(surface: &Surface, foreign: &ForeignMesh, triangles: &[[u32; 3]]) -> bool {
    let (mut flat, mut true_area) = (0.0, 0.0);
    for t in triangles {
        let [a, b, c] = t.map(|i| foreign.points[i as usize]);
        flat += 0.5 * length(&cross(&sub(&b, &a), &sub(&c, &a)));
        let uv = t.map(|i| foreign.uv[i as usize]);
        let (_, du, dv) = surface.d1([0, 1].map(|k| (uv[0][k] + uv[1][k] + uv[2][k]) / 3.0));
        true_area += area(&uv[0], &uv[1], &uv[2]) * length(&cross(&du, &dv));
    }
    (flat - true_area).abs() <= OTHER_AREA * true_area
}

/// Largest relative difference between the two areas, which allows for the chords.
const OTHER_AREA: f64 = 0.1;

/// Whether no triangle is turned over in (u, v), and each side has its counterpart: the side of a neighbour, or a chord
/// of the border in the right sense.
fn is_sound(foreign: &ForeignMesh, orientations: impl Iterator<Item = Orientation>) -> bool {
    let mut sides: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for t in &foreign.triangles {
        let [a, b, c] = t.map(|i| foreign.uv[i as usize]);
        let size = area(&a, &b, &c);
        if size.is_nan() || size < 0.0 {
            return false;
        }
        for k in 0..3 {
            *sides.entry([t[k], t[(k + 1) % 3]]).or_default() += 1;
        }
    }
    // The counterpart of a chord is a side in the opposite sense.
    let mut chord = |a: u32, b: u32| *sides.entry([b, a]).or_default() += 1;
    for (border, orientation) in foreign.borders.iter().zip(orientations) {
        for w in border.nodes.windows(2) {
            match orientation {
                Orientation::Forward => chord(w[0], w[1]),
                Orientation::Reversed => chord(w[1], w[0]),
                _ => {}
            }
        }
    }
    sides.iter().all(|([a, b], count)| *count == 1 && sides.get(&[*b, *a]) == Some(&1))
}

fn area(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}

fn nearest(parameters: &[f64], t: f64) -> usize {
    let above = parameters.partition_point(|p| *p < t).min(parameters.len() - 1);
    if above > 0 && t - parameters[above - 1] < parameters[above] - t { above - 1 } else { above }
}

/// Divides a triangle at the corners on its sides, one side after another.
fn divide(t: [u32; 3], fans: &FxHashMap<[u32; 2], Vec<u32>>, out: &mut Vec<[u32; 3]>) {
    for k in 0..3 {
        let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
        if let Some(between) = fans.get(&[a, b]) {
            let mut from = a;
            for &to in between.iter().chain([&b]) {
                // The other two sides may be divided as well: they belong to the first and the last piece.
                divide([from, to, c], fans, out);
                from = to;
            }
            return;
        }
    }
    out.push(t);
}

/// Renumbers the nodes: those of the border first, then the others.
fn ordered(
    foreign: ForeignMesh,
    triangles: Vec<[u32; 3]>,
    node_of: &FxHashMap<u32, Node>,
    surface: Option<&crate::geometry::surface::Surface>,
) -> MeshedFace {
    let count = foreign.points.len() as u32;
    let order: Vec<u32> =
        (0..count).filter(|i| node_of.contains_key(i)).chain((0..count).filter(|i| !node_of.contains_key(i))).collect();
    let mut place = vec![0u32; order.len()];
    for (k, &i) in (0..).zip(&order) {
        place[i as usize] = k;
    }
    let mut nodes = Vec::new();
    let mut numbers: FxHashMap<Node, u32> = FxHashMap::default();
    let of_border = order
        .iter()
        .filter_map(|i| node_of.get(i))
        .map(|node| {
            *numbers.entry(*node).or_insert_with(|| {
                nodes.push(*node);
                nodes.len() as u32 - 1
            })
        })
        .collect();
    let pick = |i: &u32| foreign.uv[*i as usize];
    let mesh = FaceMesh {
        uv: order.iter().map(pick).collect(),
        points: order.iter().map(|&i| foreign.points[i as usize]).collect(),
        nodes: of_border,
        triangles: triangles.iter().map(|t| t.map(|i| place[i as usize])).collect(),
        normals: order.iter().map(|i| surface.and_then(|s| s.normal(pick(i))).unwrap_or([0.0; 3])).collect(),
        turned: Vec::new(),
        torn: 0.0,
        unfinished: 0.0,
    };
    MeshedFace { mesh, nodes, ..MeshedFace::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_on_two_sides_divide_a_triangle_into_fans() {
        let fans = FxHashMap::from_iter([([0, 1], vec![5, 6]), ([1, 2], vec![7])]);
        let mut out = Vec::new();
        divide([0, 1, 2], &fans, &mut out);
        assert_eq!(out, [[0, 5, 2], [5, 6, 2], [1, 7, 6], [7, 2, 6]]);
    }
}
