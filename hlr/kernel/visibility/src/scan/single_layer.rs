//! Tells whether the counted polygons form a single layer in the image. Then none of them hides another, and back-face
//! culling alone decides every edge.
//!
//! The number of them that cover a place is the winding number of their contours around it (every polygon contributes
//! its own border, turned one way; sides that two share cancel). If the contours form one convex polygon, traversed
//! once, that number is 1 inside and 0 outside. This is so for any convex body from any direction. The test uses the
//! snapped points, so it holds for the rounded body that the pass works on.
//!
//! ```text
//!        ______            every turn to the left or none,
//!       /      \           the heading comes round once,
//!      /        \          and all contours belong to this one walk
//!      \________/
//! ```

use std::collections::HashMap;

use super::edge_table::Contour;
use super::mesh::Mesh;

type Place = [i32; 2];

/// True only where it is certain. `contours`: those of the counted polygons, none of them seen end-on.
pub fn is_single_layer(mesh: &Mesh, contours: &[Contour]) -> bool {
    let mut next: HashMap<Place, Place> = HashMap::with_capacity(contours.len());
    for c in contours {
        let (a, b) = mesh.ends(c.edge as usize);
        let (a, b) = ([a[0], a[1]], [b[0], b[1]]);
        // The covered side is the left one.
        let (from, to) = match c.jump {
            1 => (a, b),
            -1 => (b, a),
            _ => return false,
        };
        if next.insert(from, to).is_some() {
            return false;
        }
    }
    let Some(contour) = contours.first() else { return false };
    let start = {
        let (a, _) = mesh.ends(contour.edge as usize);
        [a[0], a[1]]
    };
    let way = |p: Place, q: Place| [0, 1].map(|k| i64::from(q[k]) - i64::from(p[k]));
    let upward = |w: [i64; 2]| w[1] > 0 || (w[1] == 0 && w[0] > 0);
    let (mut at, mut steps, mut rounds) = (start, 0, 0);
    loop {
        let Some(&then) = next.get(&at) else { return false };
        let Some(&after) = next.get(&then) else { return false };
        let (u, v) = (way(at, then), way(then, after));
        let cross = i128::from(u[0]) * i128::from(v[1]) - i128::from(u[1]) * i128::from(v[0]);
        let along = i128::from(u[0]) * i128::from(v[0]) + i128::from(u[1]) * i128::from(v[1]);
        if cross < 0 || (cross == 0 && along <= 0) {
            return false;
        }
        rounds += usize::from(!upward(u) && upward(v));
        (at, steps) = (then, steps + 1);
        if at == start {
            return steps == contours.len() && rounds == 1;
        }
        if steps > contours.len() {
            return false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{Mesh, SnappedGroup};
    use super::*;

    /// Whether the ring of these image points, in this order, is a single layer.
    fn ring(places: &[[i32; 2]]) -> bool {
        let n = places.len() as i32;
        let edges: Vec<[i32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let contours: Vec<Contour> = (0..n as u32).map(|edge| Contour { edge, jump: 1 }).collect();
        let mesh = Mesh {
            points: places.iter().map(|p| [p[0], p[1], 0]).collect(),
            triangles: &[],
            triangle_group: &[],
            edges: &edges,
            offsets: &vec![0; edges.len() + 1],
            incident: &[],
            edge_group: &vec![0; edges.len()],
            crossing: &[],
            role: &vec![0; edges.len()],
            groups: vec![SnappedGroup { cull: true, sound: true, delta: 0, cap: 0, tight: false }],
        };
        is_single_layer(&mesh, &contours)
    }

    #[test]
    fn convex_rings_are_a_single_layer() {
        assert!(ring(&[[0, 0], [4, 0], [4, 3]]));
        assert!(ring(&[[0, 0], [2, 0], [4, 0], [4, 3], [0, 3]]));
        assert!(ring(&[[4, 3], [0, 3], [0, 0], [2, 0], [4, 0]]));
        assert!(ring(&[[0, 0], [1, 0], [1, 1], [0, 1]]), "steps of one unit");
        assert!(ring(&[[0, 0], [4, 0], [4, 1], [0, 1]]), "steps of one unit upward");
        let m = (1 << 30) - 1;
        assert!(ring(&[[-m, -m], [m, -m], [m, m], [-m, m]]));
    }

    #[test]
    fn others_may_cover_themselves() {
        // A notch; clockwise; a pentagram, which turns left throughout but twice round; a spike; two rings.
        assert!(!ring(&[[0, 0], [4, 0], [2, 1], [4, 3], [0, 3]]));
        assert!(!ring(&[[0, 0], [4, 3], [4, 0]]));
        assert!(!ring(&[[0, 10], [-6, -8], [9, 3], [-9, 3], [6, -8]]));
        assert!(!ring(&[[0, 0], [4, 0], [2, 0], [2, 3]]));
        assert!(!ring(&[[0, 0], [4, 0], [0, 0], [4, 3]]));
    }
}
