//! The counts along all drawn edges, and the pieces that come of them.

use rayon::prelude::*;

use super::active_spans::Seeds;
use super::exact_query::ExactQuery;
use super::invisibility::{Event, Piece, Segment, State, walk};
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use hlr_exact::arithmetic::Arithmetic;

/// The pieces of a single layer, in which no polygon hides another's edge. Edges without polygons, or whose polygons
/// are all turned away or edge-on, are tested one by one.
pub fn alone<A: Arithmetic>(
    mesh: &Mesh,
    table: &PolygonTable,
    drawn: &[u32],
    exact: &ExactQuery,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Vec<Walked> {
    drawn
        .par_chunks(512)
        .map(|chunk| {
            let mut out = Walked::default();
            let mut segments = Vec::new();
            for &edge in chunk {
                if stopped() {
                    return out;
                }
                segments.clear();
                if mesh.incident(edge as usize).iter().any(|&t| table.counted(t as usize)) {
                    segments.push(Segment { start: 0.0, end: 1.0, state: State::Visible });
                } else {
                    out.decide::<A>(exact, edge, &mut segments);
                }
                out.pieces.extend(segments.iter().map(|&segment| Piece { edge, segment }));
            }
            out
        })
        .collect()
}

/// All pieces, ascending by edge: those that were walked, and edges (ascending as well) hidden from end to end.
pub fn gathered(walked: Vec<Walked>, hidden: &[u32]) -> Walked {
    let whole = Segment { start: 0.0, end: 1.0, state: State::Hidden };
    let mut all = Walked::default();
    all.pieces.reserve(hidden.len() + walked.iter().map(|w| w.pieces.len()).sum::<usize>());
    let mut hidden = hidden.iter().peekable();
    for chunk in walked {
        all.failed += chunk.failed;
        all.contradictions += chunk.contradictions;
        for piece in chunk.pieces {
            while let Some(&edge) = hidden.next_if(|&&e| e < piece.edge) {
                all.pieces.push(Piece { edge, segment: whole });
            }
            all.pieces.push(piece);
        }
    }
    all.pieces.extend(hidden.map(|&edge| Piece { edge, segment: whole }));
    all
}

/// Counting sort of all events by drawn edge.
pub fn by_edge<P: Copy>(
    drawn: usize,
    crossed: &[Vec<Event<P>>],
    pierced: &[Vec<Event<P>>],
) -> (Vec<u32>, Vec<Event<P>>) {
    let all = || crossed.iter().chain(pierced).flatten();
    let mut offsets = vec![0u32; drawn + 1];
    for e in all() {
        offsets[e.drawn as usize + 1] += 1;
    }
    for k in 0..drawn {
        offsets[k + 1] += offsets[k];
    }
    let mut next = offsets.clone();
    let total = offsets[drawn] as usize;
    let Some(&filler) = all().next() else { return (offsets, Vec::new()) };
    let mut sorted = vec![filler; total];
    for e in all() {
        let at = &mut next[e.drawn as usize];
        sorted[*at as usize] = *e;
        *at += 1;
    }
    (offsets, sorted)
}

/// The pieces of drawn edges.
#[derive(Default)]
pub struct Walked {
    pub pieces: Vec<Piece>,
    /// Edges whose counts did not agree from end to end, and that were decided by the slow test.
    pub failed: u64,
    /// Of those the ones on which the slow test contradicted itself: they count as hidden.
    pub contradictions: u64,
}

impl Walked {
    /// An edge by the slow test; hidden where even that contradicts itself.
    fn decide<A: Arithmetic>(&mut self, exact: &ExactQuery, edge: u32, segments: &mut Vec<Segment>) {
        if !exact.decide::<A>(edge as usize, segments) {
            self.contradictions += 1;
            segments.push(Segment { start: 0.0, end: 1.0, state: State::Hidden });
        }
    }
}

pub fn walk_all<A: Arithmetic>(
    mesh: &Mesh,
    drawn: &[u32],
    seeds: &Seeds,
    offsets: &[u32],
    events: &mut [Event<A::Parameter>],
    exact: &ExactQuery,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Vec<Walked> {
    const CHUNK: usize = 512;
    // Each chunk owns its run of events: split the one array along the chunk borders.
    let mut runs: Vec<&mut [Event<A::Parameter>]> = Vec::new();
    let mut rest = events;
    for first in (0..drawn.len()).step_by(CHUNK) {
        let last = (first + CHUNK).min(drawn.len());
        let (run, tail) = rest.split_at_mut((offsets[last] - offsets[first]) as usize);
        runs.push(run);
        rest = tail;
    }
    runs.into_par_iter()
        .enumerate()
        .map(|(chunk, run)| {
            let mut out = Walked::default();
            if stopped() {
                return out;
            }
            let first = chunk * CHUNK;
            let base = offsets[first];
            let mut segments = Vec::new();
            for i in first..(first + CHUNK).min(drawn.len()) {
                let edge = drawn[i];
                let group = mesh.edge_group[edge as usize];
                let [a, b] = mesh.edges[edge as usize];
                let own = &mut run[(offsets[i] - base) as usize..(offsets[i + 1] - base) as usize];
                let (start, end) = (seeds.at::<A>(mesh, group, a, b), seeds.at::<A>(mesh, group, b, a));
                if !walk(start, own, end, &mut segments) {
                    out.failed += 1;
                    out.decide::<A>(exact, edge, &mut segments);
                }
                out.pieces.extend(segments.iter().map(|&segment| Piece { edge, segment }));
            }
            out
        })
        .collect()
}
