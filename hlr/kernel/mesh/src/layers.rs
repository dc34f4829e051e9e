//! Edges of several layers of one surface: more than two triangles meet at them, but nothing folds or ends there.
//!
//! Exporters list a flat face more than once, each time divided along other diagonals. Where the layers have an edge in
//! common, four triangles or more meet, which is a crease elsewhere:
//!
//! ```text
//!                      |
//!   ====== e ======    |  ====== e ------        seen along the edge e: only through the first one
//!                      |         `------         each layer goes on smoothly
//! ```

use crate::facts::Facts;
use hlr_brep::geometry::vector::{Vector, cross, dot, sub, unit};

/// More triangles at an edge than this are no layers.
const MOST_LAYERS: usize = 32;

/// Whether the triangles at an edge lie in one surface, some on either side of it. smooth: cosine of the largest fold
/// between any two of them. Triangles without area are left out.
pub fn is_layered(edge: usize, facts: &Facts, points: &[[f64; 3]], triangles: &[[i32; 3]], smooth: f64) -> bool {
    let around = facts.around(edge);
    if around.len() > MOST_LAYERS {
        return false;
    }
    let [a, b] = facts.edges[edge].map(|v| points[v as usize]);
    let along = sub(&b, &a);
    // Away from the edge, within each triangle.
    let away: Vec<Vector> = around
        .iter()
        .filter_map(|&t| {
            let across = unit(&cross(&facts.normals[t as usize], &along))?;
            let third = triangles[t as usize].iter().find(|v| !facts.edges[edge].contains(v))?;
            let beyond = dot(&across, &sub(&points[*third as usize], &a)) > 0.0;
            Some(if beyond { across } else { across.map(|c| -c) })
        })
        .collect();
    let folds = || away.iter().enumerate().flat_map(|(k, u)| away[k + 1..].iter().map(|v| dot(u, v)));
    folds().all(|fold| fold.abs() >= smooth) && folds().any(|fold| fold < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edge is 0 1, along x; the other corners lie beside it, above or below.
    fn layered(triangles: &[[i32; 3]]) -> bool {
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.2, 1.0, 0.0],
            [0.7, 2.0, 0.01],
            [0.5, -1.0, 0.0],
            [0.1, -0.5, 0.0],
            [0.5, 0.0, 1.0],
            [0.5, 0.0, -1.0],
            [0.5, 0.0, 0.0],
        ];
        let facts = Facts::of(&points, triangles);
        let edge = facts.edges.iter().position(|edge| *edge == [0, 1]).expect("an edge");
        is_layered(edge, &facts, &points, triangles, 0.9)
    }

    #[test]
    fn layers_that_go_on_are_no_crease() {
        assert!(layered(&[[0, 1, 2], [0, 1, 3], [1, 0, 4], [1, 0, 5]]));
        assert!(layered(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), "whichever way round they are");
        assert!(layered(&[[0, 1, 2], [1, 0, 3], [0, 1, 4], [0, 1, 8]]), "a triangle without area says nothing");
    }

    #[test]
    fn what_ends_or_folds_or_crosses_is_one() {
        assert!(!layered(&[[0, 1, 2], [0, 1, 3], [1, 0, 2]]), "all on one side");
        assert!(!layered(&[[0, 1, 2], [1, 0, 4], [0, 1, 6]]), "a wall on a plate");
        assert!(!layered(&[[0, 1, 2], [1, 0, 4], [0, 1, 6], [1, 0, 7]]), "two plates that cross");
    }
}
