//! The lines in which surfaces pass through one another, and whether a line goes through a surface at a point.
//!
//! ```text
//!    seen \                  Where a line goes through a surface at a shallow angle, it is long before it is hidden by
//!   -------x-----D------     more than the contact tolerance. An intersection line through the point x says that this
//!           \   hidden       is no contact: the line is hidden from x on.
//! ```

use std::sync::OnceLock;

use super::candidates::Chains;
use super::drawing::Kind;
use super::geometry::Geometry;
use crate::fit::pierced::Meeting;
use hlr_brep::geometry::vector::{Vector, along, dot, length, sub};

/// Segments of intersection lines, in model coordinates; sorted when they are first asked for.
pub struct Meetings<'a> {
    geometry: &'a Geometry<'a>,
    chains: &'a Chains,
    /// How near a point must be, model units.
    near: f64,
    sorted: OnceLock<Sorted>,
}

struct Sorted {
    /// By the smaller x.
    segments: Vec<[Vector; 2]>,
    /// The most that a segment reaches along x.
    widest: f64,
}

impl<'a> Meetings<'a> {
    pub fn new(geometry: &'a Geometry<'a>, chains: &'a Chains, near: f64) -> Meetings<'a> {
        Meetings { geometry, chains, near, sorted: OnceLock::new() }
    }

    /// Whether an intersection line runs through a point.
    pub fn at(&self, p: &Vector) -> bool {
        let Sorted { segments, widest } = self.sorted.get_or_init(|| self.sort());
        let first = segments.partition_point(|s| lower(s) < p[0] - self.near - widest);
        let beside = segments[first..].iter().take_while(|s| lower(s) <= p[0] + self.near);
        beside.into_iter().any(|s| distance(p, s) <= self.near)
    }

    /// The points of intersection lines that are not where the meshes meet, sorted by their first coordinate there.
    pub fn moved(&self) -> Vec<Meeting> {
        let g = self.geometry;
        let mut points: Vec<i32> = self.edges().flat_map(|e| g.edges[e as usize]).collect();
        points.sort_unstable();
        points.dedup();
        points.retain(|&v| g.meshed[v as usize] != g.space[v as usize]);
        let meeting = |&v: &i32| {
            let (meshed, space) = (g.meshed[v as usize], g.space[v as usize]);
            Meeting { meshed, space, flat: g.camera.point(&space) }
        };
        let mut out: Vec<Meeting> = points.iter().map(meeting).collect();
        out.sort_by(|a, b| a.meshed[0].total_cmp(&b.meshed[0]));
        out
    }

    fn edges(&self) -> impl Iterator<Item = i32> {
        let met = (0..self.chains.about.len()).filter(|&c| self.chains.about[c].kind == Kind::INTERSECTION);
        met.flat_map(|c| self.chains.of(c).0).copied()
    }

    fn sort(&self) -> Sorted {
        let g = self.geometry;
        let mut segments: Vec<[Vector; 2]> =
            self.edges().map(|e| g.edges[e as usize].map(|v| g.meshed[v as usize])).collect();
        segments.sort_by(|a, b| lower(a).total_cmp(&lower(b)));
        let widest = segments.iter().map(|[a, b]| (a[0] - b[0]).abs()).fold(0.0, f64::max);
        Sorted { segments, widest }
    }
}

fn lower([a, b]: &[Vector; 2]) -> f64 {
    a[0].min(b[0])
}

/// From a point to a segment.
fn distance(p: &Vector, [a, b]: &[Vector; 2]) -> f64 {
    let (to, from) = (sub(b, a), sub(p, a));
    let whole = dot(&to, &to);
    let t = if whole > 0.0 { (dot(&from, &to) / whole).clamp(0.0, 1.0) } else { 0.0 };
    length(&sub(p, &along(a, &to, t)))
}

#[cfg(test)]
mod tests {
    use super::super::camera::Camera;
    use super::super::candidates::About;
    use super::*;

    #[test]
    fn only_intersection_lines_are_met_and_all_along() {
        let camera =
            Camera { direction: [0.0, 0.0, -1.0], right: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0], eye: None, scale: 1.0 };
        let space = [[0.0; 3], [10.0, 0.0, 0.0], [10.0, 5.0, 0.0], [-3.0, 0.0, 0.0]];
        let edges = [[1, 0], [1, 2], [0, 3]];
        let geometry =
            Geometry { camera: &camera, space: &space, meshed: &space, edges: &edges, pieces: &[], piece_edge: &[] };
        let mut chains = Chains::new();
        let about = |kind| About {
            kind,
            part: 0,
            edge: -1,
            face: -1,
            other: -1,
            noisy: false,
            straight: false,
            shallow: false,
        };
        chains.push(&[0, 1], &[true, false], about(Kind::INTERSECTION));
        chains.push(&[2], &[false], about(Kind::SHARP));
        let met = Meetings::new(&geometry, &chains, 0.1);
        assert!(met.at(&[5.0, 0.09, 0.0]) && met.at(&[10.0, 5.09, 0.0]) && met.at(&[-0.09, 0.0, 0.0]));
        assert!(!met.at(&[5.0, 0.09, 0.09]) && !met.at(&[10.0, 5.11, 0.0]) && !met.at(&[-2.0, 0.0, 0.0]));
    }
}
