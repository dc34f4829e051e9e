//! The visibility pass as a whole: the numbered steps of `scan`; those that do not need one another run side by side.

use std::time::Instant;

use rayon::prelude::*;

use super::active_edges::crossings;
use super::active_spans::Seeds;
use super::depth_pyramid::DepthPyramid;
use super::edge_table::EdgeTable;
use super::exact_query::ExactQuery;
use super::invisibility::{Event, Piece, Segment, State, walk};
use super::mesh::Mesh;
use super::own_faces::OwnFaces;
use super::piercing::{Piercings, piercings};
use super::polygon_table::PolygonTable;
use super::single_layer::is_single_layer;
use super::slanted::compared_again;
use super::touching::touching;
use hlr_exact::arithmetic::Arithmetic;

/// What the pass did. The names are those of a drawing's `counters`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counters {
    /// Triangles of the image.
    pub triangles: u64,
    /// Of them those that are turned away, of bodies whose back is not looked at.
    pub culled: u64,
    /// Edges at which the projection folds.
    pub contours: u64,
    /// Edges whose visibility had to be found.
    pub drawn: u64,
    /// Edges of closed bodies at which all faces are turned away.
    pub hidden_by_culling: u64,
    /// Edges seen end-on.
    pub projecting: u64,
    /// Bands of the image in which crossings were searched side by side.
    pub bands: u64,
    /// Ends of edges at which the faces in front were counted.
    pub seeds: u64,
    /// Pairs of an edge and a contour that were compared.
    pub crossing_tests: u64,
    /// Places where an edge passes behind a contour.
    pub crossings: u64,
    /// Groups of triangles through which edges may pass.
    pub piercing_parts: u64,
    /// Pairs of an edge and a triangle that were compared.
    pub piercing_tests: u64,
    /// Places where an edge passes through a triangle.
    pub piercings: u64,
    /// Edges whose counts did not agree from end to end, and that were decided by the slow test.
    pub failed_checks: u64,
    /// Of those the ones on which the slow test contradicted itself: they count as hidden.
    pub contradictions: u64,
    /// Drawn edges of a convex body, decided without any search.
    pub by_culling_alone: u64,
    /// Groups in the pyramid of depths.
    pub pyramid_parts: u64,
    /// Edges that it showed to lie behind something from end to end.
    pub hidden_by_pyramid: u64,
    /// Edges that the triangles of their own faces would hide or show wrongly.
    pub freed_of_own_faces: u64,
    /// Edges compared once more because they touch polygons seen at a slant.
    pub slanted_contacts: u64,
}

/// Time per step, in seconds; steps side by side share the time by the clock.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seconds {
    pub tables: f64,
    pub pyramid: f64,
    pub seeds: f64,
    pub crossings: f64,
    pub piercings: f64,
    pub counting: f64,
    pub own_faces: f64,
}

pub struct Outcome {
    pub pieces: Vec<Piece>,
    pub facing: Vec<i8>,
    pub counters: Counters,
    pub seconds: Seconds,
}

/// The steps to run. Any choice that meets the conditions below gives the same pieces.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// Seeds and crossings. They may be left out for a scene of one convex body; if that turns out to overlap itself in
    /// the image, they are run all the same.
    pub crossings: bool,
    /// Piercings. They may be left out if no edge comes within the contact tolerance of a polygon of another group, and
    /// all groups are sound.
    pub piercings: bool,
    pub pyramid: bool,
}

impl Steps {
    /// The pass without any shortcut.
    pub const ALL: Steps = Steps { crossings: true, piercings: true, pyramid: false };
}

/// Runs the pass; None if `stopped` returned true. With inexact arithmetic, pieces may be wrong and counts contradict
/// each other.
pub fn visibility_by<A: Arithmetic>(
    mesh: &Mesh,
    steps: Steps,
    own: &OwnFaces,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Outcome> {
    let mut clock = Clock::start();
    let mut seconds = Seconds::default();
    // 1. facing, contours, drawn edges
    let table = PolygonTable::new::<A>(mesh);
    let mut edges = EdgeTable::new(mesh, &table);
    let mut counters = Counters {
        triangles: mesh.triangles.len() as u64,
        culled: table.culled as u64,
        contours: edges.contours.len() as u64,
        drawn: edges.drawn.len() as u64,
        hidden_by_culling: edges.hidden.len() as u64,
        projecting: edges.projecting as u64,
        ..Counters::default()
    };
    seconds.tables = clock.lap();
    if !steps.crossings && is_single_layer(mesh, &edges.contours) {
        let exact = ExactQuery::new(mesh, &table, &[]);
        let walked = alone::<A>(mesh, &table, &edges.drawn, &exact, stopped);
        counters.by_culling_alone = edges.drawn.len() as u64;
        seconds.counting = clock.lap();
        let mut pieces = gathered(walked, &edges.hidden, &mut counters);
        let differing = own.differing::<A>(mesh, &table, &exact, stopped);
        (pieces, counters.freed_of_own_faces) = own.applied::<A>(mesh, &table, &exact, &differing, pieces, stopped);
        seconds.own_faces = clock.lap();
        return (!stopped()).then_some(Outcome { pieces, facing: table.all_facing(), counters, seconds });
    }
    // A body wrongly taken for convex may also pass through itself.
    let piercing = steps.piercings || !steps.crossings;
    // 2. edges that surely lie behind something need no search, and what groups that do would hide is hidden without them
    let mut behind = Vec::new();
    if steps.pyramid {
        let pyramid = DepthPyramid::new(mesh, &table, &edges.contours);
        counters.pyramid_parts = pyramid.groups as u64;
        counters.hidden_by_pyramid = discard(mesh, &pyramid, &mut edges) as u64;
        behind = pyramid.hidden;
        edges.contours.retain(|c| !behind[mesh.edge_group[c.edge as usize] as usize]);
        seconds.pyramid = clock.lap();
    }
    let (exact, slant) = (ExactQuery::new(mesh, &table, &behind), own.slant(mesh));
    // Side by side, for each has stretches on one thread:
    // 3. seeds: the count at both ends of every drawn edge
    let seeds = || timed(|| Seeds::new::<A>(mesh, &table, &edges.drawn, &behind, stopped));
    // 4. crossings and piercings: the jumps between
    let crossed = || timed(|| crossings::<A>(mesh, &edges.drawn, &edges.contours, stopped));
    let pierced = || {
        timed(|| {
            if piercing {
                piercings::<A>(mesh, &table, slant, &edges.drawn, &behind, stopped)
            } else {
                Piercings::none()
            }
        })
    };
    // for step 7: edges whose own faces are seen edge-on and seem to hide them
    let differing = || {
        timed(|| {
            let found = own.differing::<A>(mesh, &table, &exact, stopped);
            if !found.is_empty() {
                // All polygons are asked about these; the same tree decides the counts that fail.
                exact.prepare();
            }
            found
        })
    };
    let (((seeds, a), (differing, b)), ((crossed, c), (pierced, d))) =
        rayon::join(|| rayon::join(seeds, differing), || rayon::join(crossed, pierced));
    [seconds.seeds, seconds.own_faces, seconds.crossings, seconds.piercings] = clock.shared([a, b, c, d]);
    if stopped() {
        return None;
    }
    // 5. count along every drawn edge; check; decide the failed ones polygon by polygon
    let (offsets, mut events) = by_edge(edges.drawn.len(), &crossed.events, &pierced.events);
    let walked = walk_all::<A>(mesh, &edges.drawn, &seeds, &offsets, &mut events, &exact, stopped);
    if stopped() {
        return None;
    }
    counters = Counters {
        bands: crossed.bands as u64,
        seeds: seeds.asked as u64,
        crossing_tests: crossed.tests,
        crossings: crossed.events.iter().map(|e| e.len() as u64).sum(),
        piercing_parts: pierced.groups as u64,
        piercing_tests: pierced.tests,
        piercings: pierced.events.iter().map(|e| e.len() as u64).sum(),
        ..counters
    };
    // 6. add the edges that culling and the pyramid decided
    let mut pieces = gathered(walked, &edges.hidden, &mut counters);
    seconds.counting = clock.lap();
    // 7. correct edges that touch polygons seen at a slant, edges whose own faces are seen edge-on, and outlines at which
    // another body touches
    (pieces, counters.slanted_contacts) = compared_again::<A>(&slant, &exact, &pierced.slanted, pieces, stopped);
    let mut differing = differing;
    differing.extend(touching(mesh, own, &exact, &pierced.sought, &pieces, stopped));
    differing.sort_unstable_by_key(|run| run.start);
    differing.dedup();
    (pieces, counters.freed_of_own_faces) = own.applied::<A>(mesh, &table, &exact, &differing, pieces, stopped);
    seconds.own_faces += clock.lap();
    if stopped() {
        return None;
    }
    Some(Outcome { pieces, facing: table.all_facing(), counters, seconds })
}

struct Clock(Instant);

impl Clock {
    fn start() -> Clock {
        Clock(Instant::now())
    }

    /// Seconds since the last call.
    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let past = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        past
    }

    /// Seconds since the last call, shared out among steps that ran side by side and each took so long.
    fn shared<const N: usize>(&mut self, each: [f64; N]) -> [f64; N] {
        let share = self.lap() / each.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        each.map(|own| own * share)
    }
}

/// What a step gives, and its seconds.
fn timed<T>(step: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let found = step();
    (found, start.elapsed().as_secs_f64())
}

/// Moves drawn edges that certainly lie behind something to the hidden ones; returns how many.
fn discard(mesh: &Mesh, pyramid: &DepthPyramid, edges: &mut EdgeTable) -> usize {
    let behind: Vec<bool> = edges
        .drawn
        .par_iter()
        .map(|&e| {
            let (a, b) = mesh.ends(e as usize);
            pyramid.hides(a, b)
        })
        .collect();
    let chosen = |wanted: bool| {
        let both = edges.drawn.iter().zip(&behind);
        both.filter(move |&(_, &b)| b == wanted).map(|(&e, _)| e).collect::<Vec<u32>>()
    };
    let (gone, rest) = (chosen(true), chosen(false));
    edges.drawn = rest;
    edges.hidden.extend(&gone);
    edges.hidden.sort_unstable();
    gone.len()
}

/// The pieces of a single layer, in which no polygon hides another's edge. Edges without polygons, or whose polygons
/// are all turned away or edge-on, are tested one by one.
fn alone<A: Arithmetic>(
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
fn gathered(walked: Vec<Walked>, hidden: &[u32], counters: &mut Counters) -> Vec<Piece> {
    let whole = Segment { start: 0.0, end: 1.0, state: State::Hidden };
    let mut pieces = Vec::with_capacity(hidden.len() + walked.iter().map(|w| w.pieces.len()).sum::<usize>());
    let mut hidden = hidden.iter().peekable();
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
    pieces
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

impl Walked {
    /// An edge by the slow test; hidden where even that contradicts itself.
    fn decide<A: Arithmetic>(&mut self, exact: &ExactQuery, edge: u32, segments: &mut Vec<Segment>) {
        if !exact.decide::<A>(edge as usize, segments) {
            self.contradictions += 1;
            segments.push(Segment { start: 0.0, end: 1.0, state: State::Hidden });
        }
    }
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
