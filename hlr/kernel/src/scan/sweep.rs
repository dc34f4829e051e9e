//! The pass as a whole: the numbered steps of `scan`, one after another.

use rayon::prelude::*;

use super::active_edges::crossings;
use super::active_spans::Seeds;
use super::edge_table::EdgeTable;
use super::exact_query::ExactQuery;
use super::invisibility::{Event, Segment, State, walk};
use super::mesh::Mesh;
use super::piercing::piercings;
use super::polygon_table::PolygonTable;
use crate::exact::arithmetic::{Arithmetic, Exact};

/// One piece of one edge; parameters run from the edge's first to its second vertex.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub edge: u32,
    pub segment: Segment,
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Counters {
    pub triangles: u64,
    pub culled: u64,
    pub contours: u64,
    pub drawn: u64,
    pub hidden_by_culling: u64,
    pub projecting: u64,
    pub bands: u64,
    pub seeds: u64,
    pub crossing_tests: u64,
    pub crossings: u64,
    pub piercing_parts: u64,
    pub piercing_tests: u64,
    pub piercings: u64,
    pub failed_checks: u64,
    pub contradictions: u64,
}

pub struct Outcome {
    pub pieces: Vec<Piece>,
    pub facing: Vec<i8>,
    pub counters: Counters,
}

/// None if `stopped` said so.
pub fn visibility(mesh: &Mesh, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Outcome> {
    visibility_by::<Exact>(mesh, stopped)
}

/// The same with any numbers: with others than exact ones pieces may be wrong, and counts contradict each other.
pub fn visibility_by<A: Arithmetic>(mesh: &Mesh, stopped: &(dyn Fn() -> bool + Sync)) -> Option<Outcome> {
    // 1. facing, contours, drawn edges
    let table = PolygonTable::new::<A>(mesh);
    let edges = EdgeTable::new(mesh, &table);
    // 2. seeds: the count at both ends of every drawn edge
    let seeds = Seeds::new::<A>(mesh, &table, &edges.drawn, stopped);
    // 3. crossings and piercings: the jumps between
    let crossed = crossings::<A>(mesh, &edges.drawn, &edges.contours, stopped);
    let pierced = piercings::<A>(mesh, &table, &edges.drawn, stopped);
    if stopped() {
        return None;
    }
    // 4. count along every drawn edge; check; decide the failed ones polygon by polygon
    let (offsets, mut events) = by_edge(edges.drawn.len(), &crossed.events, &pierced.events);
    let exact = ExactQuery::new(mesh, &table);
    let walked = walk_all::<A>(mesh, &edges.drawn, &seeds, &offsets, &mut events, &exact, stopped);
    if stopped() {
        return None;
    }
    // 5. edges that culling decided
    let whole = Segment { start: 0.0, end: 1.0, state: State::Hidden };
    let mut counters = Counters {
        triangles: mesh.triangles.len() as u64,
        culled: table.culled as u64,
        contours: edges.contours.len() as u64,
        drawn: edges.drawn.len() as u64,
        hidden_by_culling: edges.hidden.len() as u64,
        projecting: edges.projecting as u64,
        bands: crossed.bands as u64,
        seeds: seeds.asked as u64,
        crossing_tests: crossed.tests,
        crossings: crossed.events.iter().map(|e| e.len() as u64).sum(),
        piercing_parts: pierced.parts as u64,
        piercing_tests: pierced.tests,
        piercings: pierced.events.iter().map(|e| e.len() as u64).sum(),
        ..Counters::default()
    };
    let mut pieces = Vec::with_capacity(edges.hidden.len() + walked.iter().map(|w| w.pieces.len()).sum::<usize>());
    let mut hidden = edges.hidden.iter().peekable();
    // Both lists ascend by edge: merge them.
    for chunk in walked {
        counters.failed_checks += chunk.failed;
        counters.contradictions += chunk.contradictions;
        for piece in chunk.pieces {
            while let Some(&edge) = hidden.next_if(|&&e| e < piece.edge) {
                pieces.push(Piece { edge, segment: whole });
            }
            pieces.push(piece);
        }
    }
    pieces.extend(hidden.map(|&edge| Piece { edge, segment: whole }));
    Some(Outcome { pieces, facing: table.facing, counters })
}

/// Counting sort of all events by drawn edge.
fn by_edge<P: Copy>(drawn: usize, crossed: &[Vec<Event<P>>], pierced: &[Vec<Event<P>>]) -> (Vec<u32>, Vec<Event<P>>) {
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

#[derive(Default)]
struct Walked {
    pieces: Vec<Piece>,
    failed: u64,
    contradictions: u64,
}

fn walk_all<A: Arithmetic>(
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
                let part = mesh.edge_part[edge as usize];
                let [a, b] = mesh.edges[edge as usize];
                let own = &mut run[(offsets[i] - base) as usize..(offsets[i + 1] - base) as usize];
                let (start, end) = (seeds.at::<A>(mesh, part, a, b), seeds.at::<A>(mesh, part, b, a));
                if !walk(start, own, end, &mut segments) {
                    out.failed += 1;
                    if !exact.decide::<A>(edge as usize, &mut segments) {
                        out.contradictions += 1;
                        segments.push(Segment { start: 0.0, end: 1.0, state: State::Hidden });
                    }
                }
                out.pieces.extend(segments.iter().map(|&segment| Piece { edge, segment }));
            }
            out
        })
        .collect()
}
