//! Clipping polygons: by the view volume before the division, or by the frame after object space.
//!
//! I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974: one plane after another, each loop by itself. A
//! concave loop may come out with edges that run there and back along the plane; they enclose nothing, under either
//! inside rule.
//!
//! The volume is a box in parallel views and a frustum in perspective; in homogeneous coordinates both are the six
//! planes
//!
//! ```text
//!   u >= 0    W w - u >= 0      v >= 0    H w - v >= 0      q - front w >= 0    back w - q >= 0
//! ```
//!
//! Polygons wholly beyond one of them are left out. Those that cross front or back are cut there. Those that cross a
//! side are cut only where they reach a guard band thousands of pixels beyond: a new corner would have to be rounded,
//! and would bend the edges that lead to it. Within the guard band the window of pixels clips without any error,
//! because no pixel centre lies on its sides.
//!
//! A new corner is always computed from the lower of its edge's two ends, by the order of their coordinates: both
//! polygons at an edge get the same corner, and no gap opens.

use super::scene::Camera;

/// A corner before projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// u, v, q, w.
    pub at: [f64; 4],
    /// A value to interpolate; zero where there is none.
    pub value: [f64; 3],
}

/// Inside: normal . (u, v, q, w) >= offset.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    pub normal: [f64; 4],
    pub offset: f64,
}

impl Wall {
    pub fn new(normal: [f64; 4]) -> Wall {
        Wall { normal, offset: 0.0 }
    }

    #[inline(always)]
    pub fn height(&self, at: &[f64; 4]) -> f64 {
        let n = &self.normal;
        n[0] * at[0] + n[1] * at[1] + n[2] * at[2] + n[3] * at[3] - self.offset
    }
}

/// The planes of the view volume. In perspective the near cut comes first: beyond it w is positive. The side planes lie
/// `guard` pixels outside the frame.
pub fn walls(camera: &Camera, guard: f64) -> Vec<Wall> {
    let mut out = Vec::with_capacity(7);
    if camera.near.is_finite() {
        out.push(Wall { normal: [0.0, 0.0, 0.0, 1.0], offset: camera.near });
    }
    out.push(Wall::new([1.0, 0.0, 0.0, guard]));
    out.push(Wall::new([-1.0, 0.0, 0.0, f64::from(camera.width) + guard]));
    out.push(Wall::new([0.0, 1.0, 0.0, guard]));
    out.push(Wall::new([0.0, -1.0, 0.0, f64::from(camera.height) + guard]));
    if camera.image_space && camera.front.is_finite() {
        out.push(Wall::new([0.0, 0.0, 1.0, -camera.front]));
    }
    if camera.image_space && camera.back.is_finite() {
        out.push(Wall::new([0.0, 0.0, -1.0, camera.back]));
    }
    out
}

/// Clips one loop by one wall; `out` is emptied first.
pub fn clip_loop(corners: &[Corner], wall: &Wall, out: &mut Vec<Corner>) {
    out.clear();
    let Some(mut p) = corners.last() else { return };
    let mut hp = wall.height(&p.at);
    for q in corners {
        let hq = wall.height(&q.at);
        if (hp >= 0.0) != (hq >= 0.0) {
            out.push(between(p, hp, q, hq));
        }
        if hq >= 0.0 {
            out.push(*q);
        }
        (p, hp) = (q, hq);
    }
}

fn between(p: &Corner, hp: f64, q: &Corner, hq: f64) -> Corner {
    let (p, hp, q, hq) = if p.at < q.at { (p, hp, q, hq) } else { (q, hq, p, hp) };
    let t = hp / (hp - hq);
    Corner {
        at: std::array::from_fn(|k| p.at[k] + (q.at[k] - p.at[k]) * t),
        value: std::array::from_fn(|k| p.value[k] + (q.value[k] - p.value[k]) * t),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64) -> Corner {
        Corner { at: [x, y, 0.0, 1.0], value: [x, 0.0, 0.0] }
    }

    #[test]
    fn a_triangle_loses_its_tip() {
        let mut out = Vec::new();
        clip_loop(
            &[corner(-2.0, 0.0), corner(2.0, 2.0), corner(2.0, -2.0)],
            &Wall::new([1.0, 0.0, 0.0, 0.0]),
            &mut out,
        );
        let at: Vec<_> = out.iter().map(|c| (c.at[0], c.at[1], c.value[0])).collect();
        assert_eq!(at, [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (2.0, 2.0, 2.0), (2.0, -2.0, 2.0)]);
    }

    #[test]
    fn both_neighbours_at_an_edge_get_the_same_corner() {
        let (p, q) = (corner(-0.1, 0.3), corner(0.7, 1.1));
        let wall = Wall::new([1.0, 0.0, 0.0, 0.0]);
        let (hp, hq) = (wall.height(&p.at), wall.height(&q.at));
        assert_eq!(between(&p, hp, &q, hq), between(&q, hq, &p, hp));
    }
}
