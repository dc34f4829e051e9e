//! Constrained Delaunay triangles of loops and inner points.

use spade::handles::{DirectedEdgeHandle, FixedVertexHandle};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::outline::Outline;
use super::steps::Steps;

struct Corner<'a> {
    place: Point2<f64>,
    number: u32,
    steps: &'a Steps<'a>,
}

impl HasPosition for Corner<'_> {
    type Scalar = f64;

    /// Asked at every step: that is where one can stop.
    fn position(&self) -> Point2<f64> {
        self.steps.step();
        self.place
    }
}

pub struct Delaunay<'a> {
    mesh: ConstrainedDelaunayTriangulation<Corner<'a>>,
    steps: &'a Steps<'a>,
    /// Of points of the outline at one place, the first one.
    pub stand_in: Vec<u32>,
    /// Of all numbers.
    handles: Vec<FixedVertexHandle>,
    /// Chords that run to and fro, lower point first: the same is on either side.
    slits: Vec<[u32; 2]>,
}

impl<'a> Delaunay<'a> {
    /// Inner points are numbered after those of the outline. None where chords cross or points are out of range.
    pub fn new(outline: &Outline, inner: &[[f64; 2]], steps: &'a Steps<'a>) -> Option<Delaunay<'a>> {
        let stand_in = stand_ins(outline);
        let count = outline.len();
        let mut corners = Vec::with_capacity(count + inner.len());
        let mut place = vec![0usize; count];
        for c in outline.chords() {
            let i = c as usize;
            place[i] = corners.len();
            if stand_in[i] == c {
                let [x, y] = outline.uv[i];
                corners.push(Corner { place: Point2::new(x, y), number: c, steps });
            } else {
                place[i] = place[stand_in[i] as usize];
            }
        }
        for (&[x, y], number) in inner.iter().zip(count as u32..) {
            corners.push(Corner { place: Point2::new(x, y), number, steps });
        }
        let chords: Vec<_> = outline.chords().map(|c| [place[c as usize], place[outline.after(c) as usize]]).collect();
        if chords.iter().any(|[a, b]| a == b) {
            return None;
        }
        let mut slits = Vec::new();
        if stand_in.iter().zip(0..).any(|(&a, i)| a != i) {
            let named = |c: u32| {
                let [a, b] = [c, outline.after(c)].map(|i| stand_in[i as usize]);
                [a.min(b), a.max(b)]
            };
            let mut all: Vec<_> = outline.chords().map(named).collect();
            all.sort_unstable();
            slits = all.chunk_by(|a, b| a == b).filter(|g| g.len() == 2).map(|g| g[0]).collect();
        }
        // The triangulation keeps the order of corners, which are all in different places.
        let handles = place
            .iter()
            .copied()
            .chain(corners.len() - inner.len()..corners.len())
            .map(FixedVertexHandle::from_index)
            .collect();
        let mut crossed = false;
        let mesh = ConstrainedDelaunayTriangulation::try_bulk_load_cdt(corners, chords, |_| crossed = true).ok()?;
        (!crossed).then_some(Delaunay { mesh, steps, stand_in, handles, slits })
    }

    /// One more inner point near a known one, which gets the next number. False where it is no new one, or lies on a chord.
    pub fn insert(&mut self, [x, y]: [f64; 2], near: u32) -> bool {
        use spade::PositionInTriangulation::{OnEdge, OnFace};
        let (place, near) = (Point2::new(x, y), self.handles[near as usize]);
        let free = match self.mesh.locate_with_hint(place, near) {
            OnFace(_) => true,
            OnEdge(edge) => !self.mesh.directed_edge(edge).is_constraint_edge(),
            _ => false,
        };
        let corner = Corner { place, number: self.handles.len() as u32, steps: self.steps };
        let Some(handle) = free.then(|| self.mesh.insert_with_hint(corner, near).ok()).flatten() else { return false };
        self.handles.push(handle);
        true
    }

    /// The triangles around an inner point.
    pub fn around(&self, number: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        let edges = self.mesh.vertex(self.handles[number as usize]).out_edges();
        edges.filter_map(|e| e.face().as_inner()).map(|f| f.vertices().map(|v| v.data().number))
    }

    /// Whether a triangle that was one is one still.
    pub fn has(&self, [a, b, c]: [u32; 3]) -> bool {
        let [a, b, c] = [a, b, c].map(|i| self.handles[i as usize]);
        let edge = self.mesh.get_edge_from_neighbors(a, b);
        edge.and_then(|e| e.opposite_vertex()).is_some_and(|v| v.fix() == c)
    }

    /// The triangles inside the loops, counterclockwise: those with an odd number of chords between them and the outside.
    pub fn inside(&self) -> Vec<[u32; 3]> {
        const UNKNOWN: u8 = 2;
        let mut state = vec![UNKNOWN; self.mesh.num_all_faces()];
        let mut stack = Vec::new();
        for hull in self.mesh.convex_hull() {
            // The hull's edges have the outside on one hand.
            let edge = if hull.is_outer_edge() { hull.rev() } else { hull };
            let index = edge.face().fix().index();
            if !edge.is_outer_edge() && state[index] == UNKNOWN {
                state[index] = u8::from(self.toggles(edge));
                stack.push(edge.face());
            }
        }
        while let Some(face) = stack.pop() {
            let Some(face) = face.as_inner() else { continue };
            let here = state[face.fix().index()];
            for edge in face.adjacent_edges() {
                let beyond = edge.rev().face();
                let index = beyond.fix().index();
                if !beyond.is_outer() && state[index] == UNKNOWN {
                    state[index] = here ^ u8::from(self.toggles(edge));
                    stack.push(beyond);
                }
            }
        }
        let inner = self.mesh.inner_faces().filter(|f| state[f.fix().index()] == 1);
        inner.map(|f| f.vertices().map(|v| v.data().number)).collect()
    }

    fn toggles(&self, edge: DirectedEdgeHandle<Corner, (), spade::CdtEdge<()>, ()>) -> bool {
        if !edge.is_constraint_edge() {
            return false;
        }
        let [a, b] = edge.vertices().map(|v| v.data().number);
        self.slits.binary_search(&[a.min(b), a.max(b)]).is_err()
    }
}

/// For each point of a chord the first one at its place.
fn stand_ins(outline: &Outline) -> Vec<u32> {
    let mut order: Vec<u32> = outline.chords().collect();
    let at = |i: u32| outline.uv[i as usize];
    order.sort_unstable_by(|&a, &b| at(a)[0].total_cmp(&at(b)[0]).then(at(a)[1].total_cmp(&at(b)[1])).then(a.cmp(&b)));
    let mut out: Vec<u32> = (0..outline.len() as u32).collect();
    for group in order.chunk_by(|&a, &b| at(a) == at(b)) {
        for &i in group {
            out[i as usize] = group[0];
        }
    }
    out
}
