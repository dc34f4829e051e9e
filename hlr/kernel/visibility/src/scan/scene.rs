//! The scene in view coordinates before rounding; `solve` runs the whole pass on it.

use hlr_exact::arithmetic::{Double, Exact, Single};
use hlr_exact::snap::Grid;
use rayon::prelude::*;

use super::mesh::{Mesh, SnappedGroup};
use super::own_faces::OwnFaces;
use super::sweep::{Outcome, Steps, visibility_by};

/// A group of the pass, and what may be assumed of it: see `SnappedGroup`. Lengths in depth units of the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group {
    pub cull: bool,
    pub sound: bool,
    pub delta: f64,
    pub cap: f64,
    pub tight: bool,
}

/// Points as the camera has them: x right, y up, z away from the viewer. Groups share no points.
pub struct Scene<'a> {
    pub points: &'a [[f64; 3]],
    pub triangles: &'a [[i32; 3]],
    pub triangle_group: &'a [i32],
    pub edges: &'a [[i32; 2]],
    /// Triangles incident to edge e: incident[offsets[e]..offsets[e + 1]].
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    pub edge_group: &'a [i32],
    /// DRAWN, OUTLINE, both or neither.
    pub role: &'a [u8],
    pub groups: &'a [Group],
    /// Pairs of groups that have an intersection line: the lower number first, ascending.
    pub crossing: &'a [[i32; 2]],
}

/// The arithmetic of the predicates. All but the exact one may give wrong results: for study only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    Exact,
    Double,
    Single,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    NotFinite,
    Stopped,
}

impl<'a> Scene<'a> {
    /// The scene rounded to the finest grid that leaves room for the tolerances; None if a coordinate is not finite.
    pub fn snapped(&self) -> Option<(Mesh<'a>, Grid)> {
        let room = self.groups.iter().map(|group| group.delta).fold(0.0, f64::max);
        let grid = Grid::around(self.points)?.with_room(room);
        let snapped = |group: &Group| SnappedGroup {
            cull: group.cull,
            sound: group.sound,
            delta: grid.delta(group.delta),
            cap: grid.delta(group.cap),
            tight: group.tight,
        };
        let mesh = Mesh {
            points: self.points.par_iter().with_min_len(1 << 13).map(|p| grid.snap(p)).collect(),
            triangles: self.triangles,
            triangle_group: self.triangle_group,
            edges: self.edges,
            offsets: self.offsets,
            incident: self.incident,
            edge_group: self.edge_group,
            crossing: self.crossing,
            role: self.role,
            groups: self.groups.iter().map(snapped).collect(),
        };
        Some((mesh, grid))
    }
}

/// Finds which pieces of the drawn edges are visible.
pub fn solve(
    scene: &Scene,
    own: OwnFaces,
    steps: Steps,
    numbers: Numbers,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Outcome, Refusal> {
    let (mesh, grid) = scene.snapped().ok_or(Refusal::NotFinite)?;
    let own = OwnFaces { depth_scale: grid.scale_z / grid.scale_xy, ..own };
    let pass = match numbers {
        Numbers::Exact => visibility_by::<Exact>,
        Numbers::Double => visibility_by::<Double>,
        Numbers::Single => visibility_by::<Single>,
    };
    pass(&mesh, steps, &own, stopped).ok_or(Refusal::Stopped)
}

#[cfg(test)]
mod tests {
    use super::super::invisibility::State;
    use super::super::mesh::DRAWN;
    use super::*;

    /// A triangle before a wire that it covers in the middle.
    const POINTS: [[f64; 3]; 5] =
        [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-2.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
    const OPEN: Group = Group { cull: false, sound: true, delta: 0.0, cap: 0.0, tight: false };

    fn scene<'a>(points: &'a [[f64; 3]], groups: &'a [Group]) -> Scene<'a> {
        Scene {
            points,
            triangles: &[[0, 1, 2]],
            triangle_group: &[0],
            edges: &[[0, 1], [1, 2], [0, 2], [3, 4]],
            offsets: &[0, 1, 2, 3, 3],
            incident: &[0, 0, 0],
            edge_group: &[0, 0, 0, 1],
            role: &[0, 0, 0, DRAWN],
            groups,
            crossing: &[],
        }
    }

    #[test]
    fn a_wire_behind_a_triangle_is_hidden_in_the_middle() {
        for numbers in [Numbers::Exact, Numbers::Double, Numbers::Single] {
            let found =
                solve(&scene(&POINTS, &[OPEN; 2]), OwnFaces::NONE, Steps::ALL, numbers, &|| false).expect("an answer");
            let pieces: Vec<_> =
                found.pieces.iter().map(|p| (p.segment.start, p.segment.end, p.segment.state)).collect();
            let at = |t: f64| (t * 1e6).round() / 1e6;
            let pieces: Vec<_> = pieces.into_iter().map(|(from, to, state)| (at(from), at(to), state)).collect();
            assert_eq!(
                pieces,
                [(0.0, 0.375, State::Visible), (0.375, 0.625, State::Hidden), (0.625, 1.0, State::Visible)]
            );
        }
    }

    #[test]
    fn what_is_hidden_by_less_than_the_tolerance_is_told() {
        let near = [Group { delta: 2.0, cap: 2.0, ..OPEN }; 2];
        let mut points = POINTS.to_vec();
        // Depth enough that the grid has room for the tolerance.
        points.extend([[0.0, 0.0, -64.0], [0.0, 0.0, 64.0]]);
        let found = solve(&scene(&points, &near), OwnFaces::NONE, Steps::ALL, Numbers::Exact, &|| false);
        let states: Vec<State> = found.expect("an answer").pieces.iter().map(|p| p.segment.state).collect();
        assert_eq!(states, [State::Visible, State::Within, State::Visible]);
    }

    #[test]
    fn what_cannot_be_answered_is_refused() {
        let mut points = POINTS;
        points[4][2] = f64::NAN;
        let asked = |points: &[[f64; 3]], stop: bool| {
            solve(&scene(points, &[OPEN; 2]), OwnFaces::NONE, Steps::ALL, Numbers::Exact, &|| stop).err()
        };
        assert_eq!(asked(&points, false), Some(Refusal::NotFinite));
        assert_eq!(asked(&POINTS, true), Some(Refusal::Stopped));
        assert_eq!(asked(&POINTS, false), None);
    }
}
