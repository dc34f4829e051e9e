//! Sides of triangles that only one triangle has, and distances along them.

use crate::topology::topology;

pub type Vec3 = [f64; 3];

/// A triangle's side that no other triangle has, in its direction.
#[derive(Clone, Copy, Debug)]
pub struct Border {
    pub ends: [u32; 2],
    pub triangle: u32,
}

pub fn borders(triangles: &[[i32; 3]], n_points: usize) -> Vec<Border> {
    let table = topology(triangles, n_points);
    let mut found = Vec::new();
    for (edge, uses) in table.edges.iter().zip(table.offsets.windows(2)) {
        if uses[1] - uses[0] == 1 {
            let triangle = table.incident[uses[0] as usize] as u32;
            let corners = triangles[triangle as usize];
            let along = (0..3).any(|k| [corners[k], corners[(k + 1) % 3]] == *edge);
            let [a, b] = edge.map(|v| v as u32);
            found.push(Border { ends: if along { [a, b] } else { [b, a] }, triangle });
        }
    }
    found
}

pub fn distance2(p: &Vec3, q: &Vec3) -> f64 {
    (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum()
}

/// Where from a to b (0 to 1) a point lies, and the square of its distance from there.
pub fn along(p: &Vec3, a: &Vec3, b: &Vec3) -> (f64, f64) {
    let way = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let size: f64 = way.iter().map(|w| w * w).sum();
    let dot: f64 = (0..3).map(|k| (p[k] - a[k]) * way[k]).sum();
    let t = if size > 0.0 { (dot / size).clamp(0.0, 1.0) } else { 0.0 };
    (t, distance2(p, &[a[0] + t * way[0], a[1] + t * way[1], a[2] + t * way[2]]))
}

/// Order of points by their coordinates, not by their numbers.
pub fn before(p: &Vec3, q: &Vec3) -> std::cmp::Ordering {
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(p[2].total_cmp(&q[2]))
}
