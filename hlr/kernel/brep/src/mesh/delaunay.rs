//! The constrained Delaunay triangulation of loops and inner points.

use spade::handles::DirectedEdgeHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::outline::Outline;
use super::progress::Progress;

struct Corner<'a> {
    place: Point2<f64>,
    number: u32,
    steps: &'a Progress<'a>,
}

impl HasPosition for Corner<'_> {
    type Scalar = f64;

    /// Called at every step of the triangulation, so a stop is checked here.
    fn position(&self) -> Point2<f64> {
        self.steps.step();
        self.place
    }
}

/// Triangles inside loops. The loops may touch one another.
pub struct Delaunay {
    /// Counterclockwise.
    pub triangles: Vec<[u32; 3]>,
    /// For each point of the outline the first point at the same place.
    pub stand_in: Vec<u32>,
}

type Mesh<'a> = ConstrainedDelaunayTriangulation<Corner<'a>>;

impl Delaunay {
    /// Inner points are numbered after those of the outline. None where chords cross or points are out of range.
    pub fn new(outline: &Outline, inner: &[[f64; 2]], steps: &Progress) -> Option<Delaunay> {
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
        let mut crossed = false;
        let mesh = Mesh::try_bulk_load_cdt(corners, chords, |_| crossed = true).ok()?;
        (!crossed).then(|| Delaunay { triangles: inside(&mesh, &slits), stand_in })
    }
}

/// The triangles inside the loops, counterclockwise: those with an odd number of chords between them and the outside.
///
/// `slits`: chords that occur in both senses, lower point first. Both sides of a slit are inside, or both outside.
fn inside(mesh: &Mesh, slits: &[[u32; 2]]) -> Vec<[u32; 3]> {
    const UNKNOWN: u8 = 2;
    let mut state = vec![UNKNOWN; mesh.num_all_faces()];
    let mut stack = Vec::new();
    for hull in mesh.convex_hull() {
        // An edge of the hull has the outside on one side.
        let edge = if hull.is_outer_edge() { hull.rev() } else { hull };
        let index = edge.face().fix().index();
        if !edge.is_outer_edge() && state[index] == UNKNOWN {
            state[index] = u8::from(toggles(edge, slits));
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
                state[index] = here ^ u8::from(toggles(edge, slits));
                stack.push(beyond);
            }
        }
    }
    let inner = mesh.inner_faces().filter(|f| state[f.fix().index()] == 1);
    inner.map(|f| f.vertices().map(|v| v.data().number)).collect()
}

/// How many times chords that meet at ends only run around what is to the left and to the right of each of them. Each is
/// given as the numbers of its ends, and how many loops have it, those of the other sense deducted. None where they cross.
pub fn winding(places: &[[f64; 2]], chords: &[([u32; 2], i32)], steps: &Progress) -> Option<Vec<[i32; 2]>> {
    let corners = places.iter().zip(0..).map(|(&[x, y], number)| Corner { place: Point2::new(x, y), number, steps });
    let ends = chords.iter().map(|([a, b], _)| [*a as usize, *b as usize]).collect();
    let mut crossed = false;
    let mesh = Mesh::try_bulk_load_cdt(corners.collect(), ends, |_| crossed = true).ok()?;
    if crossed {
        return None;
    }
    let count = |edge: DirectedEdgeHandle<Corner<'_>, (), spade::CdtEdge<()>, ()>| {
        let [a, b] = edge.vertices().map(|v| v.data().number);
        let found = chords.binary_search_by_key(&[a.min(b), a.max(b)], |chord| chord.0);
        found.map_or(0, |i| if a < b { chords[i].1 } else { -chords[i].1 })
    };
    let outside = mesh.outer_face().fix().index();
    let mut turns: Vec<Option<i32>> = vec![None; mesh.num_all_faces()];
    turns[outside] = Some(0);
    let mut stack: Vec<_> = mesh.convex_hull().map(|e| if e.is_outer_edge() { e } else { e.rev() }).collect();
    while let Some(edge) = stack.pop() {
        let (here, beyond) = (turns[edge.face().fix().index()]?, edge.rev().face());
        let place = &mut turns[beyond.fix().index()];
        if place.is_none() {
            *place = Some(here - count(edge));
            stack.extend(beyond.as_inner().into_iter().flat_map(|face| face.adjacent_edges()));
        }
    }
    let mut out = vec![[0; 2]; chords.len()];
    for edge in mesh.directed_edges() {
        let [a, b] = edge.vertices().map(|v| v.data().number);
        if let Ok(i) = chords.binary_search_by_key(&[a, b], |chord| chord.0) {
            out[i] = [edge, edge.rev()].map(|side| turns[side.face().fix().index()].unwrap_or_default());
        }
    }
    Some(out)
}

fn toggles(edge: DirectedEdgeHandle<Corner<'_>, (), spade::CdtEdge<()>, ()>, slits: &[[u32; 2]]) -> bool {
    if !edge.is_constraint_edge() {
        return false;
    }
    let [a, b] = edge.vertices().map(|v| v.data().number);
    slits.binary_search(&[a.min(b), a.max(b)]).is_err()
}

/// For each point of a chord the first point at the same place.
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
