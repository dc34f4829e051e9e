//! Which faces of closed bodies without a solid look inward: how loose faces are turned says nothing of where inside is.

use crate::geometry::vector::{Vector, cross, dot};
use crate::part_topology::PartTopology;
use crate::sets::Sets;
use crate::shapes::Edge;

/// Per face: it belongs to a set that hangs together, is closed, and looks inward.
///
/// `points`, `triangles`, `triangle_face`: the mesh of the part; `edges`: those of the model.
pub fn inward(
    part: &PartTopology,
    edges: &[Edge],
    points: &[Vector],
    triangles: &[[i32; 3]],
    triangle_face: &[i32],
) -> Vec<bool> {
    let mut sets = Sets::new(part.faces.len());
    // Bodies that have but an edge in common, of three faces or more, are looked at one by one.
    for edge in &part.edges {
        if let [one, two] = edge.faces[..] {
            sets.unite(one as usize, two as usize);
        }
    }
    let set_of: Vec<usize> = (0..part.faces.len()).map(|face| sets.first(face)).collect();
    let mut open = vec![false; part.faces.len()];
    for edge in part.edges.iter().filter(|edge| !edge.twice && !edges[edge.edge as usize].degenerate) {
        if let [alone] = edge.faces[..] {
            open[set_of[alone as usize]] = true;
        }
    }
    let mut volume = vec![0.0; part.faces.len()];
    for (t, &face) in triangles.iter().zip(triangle_face) {
        let [a, b, c] = t.map(|i| &points[i as usize]);
        volume[set_of[face as usize]] += dot(a, &cross(b, c));
    }
    set_of.into_iter().map(|set| !open[set] && volume[set] < 0.0).collect()
}
