//! The visibility pass as a whole: the numbered steps of `scan`; those that do not need one another run side by side.

use std::ops::Range;
use std::time::Instant;

use rayon::prelude::*;

use super::active_edges::{Crossings, crossings};
use super::active_spans::Seeds;
use super::counting::{Walked, alone, by_edge, gathered, walk_all};
use super::depth_pyramid::DepthPyramid;
use super::edge_table::EdgeTable;
use super::exact_query::ExactQuery;
use super::invisibility::Piece;
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
    // 1. facing, contours, drawn edges
    let table = PolygonTable::new::<A>(mesh);
    let edges = EdgeTable::new(mesh, &table);
    let counters = Counters {
        triangles: mesh.triangles.len() as u64,
        culled: table.culled as u64,
        contours: edges.contours.len() as u64,
        drawn: edges.drawn.len() as u64,
        hidden_by_culling: edges.hidden.len() as u64,
        projecting: edges.projecting as u64,
        ..Counters::default()
    };
    let seconds = Seconds { tables: clock.lap(), ..Seconds::default() };
    let mut pass = Pass { mesh, table: &table, own, stopped, clock, counters, seconds };
    let pieces = if !steps.crossings && is_single_layer(mesh, &edges.contours) {
        pass.of_single_layer::<A>(&edges)
    } else {
        // A body wrongly taken for convex may also pass through itself.
        let piercings = steps.piercings || !steps.crossings;
        pass.of_layers::<A>(edges, Steps { piercings, ..steps })?
    };
    let Pass { counters, seconds, .. } = pass;
    (!stopped()).then(|| Outcome { pieces, facing: table.all_facing(), counters, seconds })
}

/// The pass at work on one image, whose tables are made.
struct Pass<'a> {
    mesh: &'a Mesh<'a>,
    table: &'a PolygonTable,
    own: &'a OwnFaces<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
    clock: Clock,
    counters: Counters,
    seconds: Seconds,
}

/// What is found side by side, for each of these has stretches on one thread.
struct Found<P> {
    seeds: Seeds,
    crossed: Crossings<P>,
    pierced: Piercings<P>,
    /// The edges, each as its stretches, whose own faces are seen edge-on and seem to hide them.
    differing: Vec<Range<usize>>,
}

impl Pass<'_> {
    /// The pieces where no polygon hides another's edge.
    fn of_single_layer<A: Arithmetic>(&mut self, edges: &EdgeTable) -> Vec<Piece> {
        let Pass { mesh, table, own, stopped, .. } = *self;
        let exact = ExactQuery::new(mesh, table, &[]);
        let walked = alone::<A>(mesh, table, &edges.drawn, &exact, stopped);
        self.counters.by_culling_alone = edges.drawn.len() as u64;
        self.seconds.counting = self.clock.lap();
        let pieces = self.all_pieces(walked, edges);
        let differing = own.differing::<A>(mesh, table, &exact, stopped);
        let (pieces, freed) = own.applied::<A>(mesh, table, &exact, &differing, pieces, stopped);
        self.counters.freed_of_own_faces = freed;
        self.seconds.own_faces = self.clock.lap();
        pieces
    }

    /// The pieces where polygons may hide edges of others; None if the work was stopped.
    fn of_layers<A: Arithmetic>(&mut self, mut edges: EdgeTable, steps: Steps) -> Option<Vec<Piece>> {
        let Pass { mesh, table, own, stopped, .. } = *self;
        // 2. edges that surely lie behind something need no search, and what groups that do would hide is hidden without
        // them
        let behind = if steps.pyramid { self.set_aside(&mut edges) } else { Vec::new() };
        let exact = ExactQuery::new(mesh, table, &behind);
        let Found { seeds, crossed, pierced, mut differing } =
            self.found::<A>(&edges, &behind, &exact, steps.piercings);
        if stopped() {
            return None;
        }
        // 5. count along every drawn edge; check; decide the failed ones polygon by polygon
        let (offsets, mut events) = by_edge(edges.drawn.len(), &crossed.events, &pierced.events);
        let walked = walk_all::<A>(mesh, &edges.drawn, &seeds, &offsets, &mut events, &exact, stopped);
        if stopped() {
            return None;
        }
        self.counters = Counters {
            bands: crossed.bands as u64,
            seeds: seeds.asked as u64,
            crossing_tests: crossed.tests,
            crossings: crossed.events.iter().map(|e| e.len() as u64).sum(),
            piercing_parts: pierced.groups as u64,
            piercing_tests: pierced.tests,
            piercings: pierced.events.iter().map(|e| e.len() as u64).sum(),
            ..self.counters
        };
        // 6. add the edges that culling and the pyramid decided
        let mut pieces = self.all_pieces(walked, &edges);
        self.seconds.counting = self.clock.lap();
        // 7. correct edges that touch polygons seen at a slant, edges whose own faces are seen edge-on, and outlines at
        // which another body touches
        let slant = own.slant(mesh);
        (pieces, self.counters.slanted_contacts) =
            compared_again::<A>(&slant, &exact, &pierced.slanted, pieces, stopped);
        differing.extend(touching::<A>(mesh, own, &exact, &pierced.sought, &pieces, stopped));
        differing.sort_unstable_by_key(|run| run.start);
        differing.dedup();
        (pieces, self.counters.freed_of_own_faces) = own.applied::<A>(mesh, table, &exact, &differing, pieces, stopped);
        self.seconds.own_faces += self.clock.lap();
        Some(pieces)
    }

    /// Takes out the edges that surely lie behind something, and the contours of groups that do. Returns per group
    /// whether it does.
    fn set_aside(&mut self, edges: &mut EdgeTable) -> Vec<bool> {
        let pyramid = DepthPyramid::new(self.mesh, self.table, &edges.contours);
        self.counters.pyramid_parts = pyramid.groups as u64;
        self.counters.hidden_by_pyramid = discard(self.mesh, &pyramid, edges) as u64;
        let behind = pyramid.hidden;
        edges.contours.retain(|c| !behind[self.mesh.edge_group[c.edge as usize] as usize]);
        self.seconds.pyramid = self.clock.lap();
        behind
    }

    /// The pieces that were walked, and those of edges that culling and the pyramid decided.
    fn all_pieces(&mut self, walked: Vec<Walked>, edges: &EdgeTable) -> Vec<Piece> {
        let all = gathered(walked, &edges.hidden);
        self.counters.failed_checks = all.failed;
        self.counters.contradictions = all.contradictions;
        all.pieces
    }

    fn found<A: Arithmetic>(
        &mut self,
        edges: &EdgeTable,
        behind: &[bool],
        exact: &ExactQuery,
        piercing: bool,
    ) -> Found<A::Parameter> {
        let Pass { mesh, table, own, stopped, .. } = *self;
        // 3. seeds: the count at both ends of every drawn edge
        let seeds = || timed(|| Seeds::new::<A>(mesh, table, &edges.drawn, behind, stopped));
        // 4. crossings and piercings: the jumps between
        let crossed = || timed(|| crossings::<A>(mesh, &edges.drawn, &edges.contours, stopped));
        let pierced = || {
            timed(|| {
                if piercing {
                    piercings::<A>(mesh, table, own.slant(mesh), &edges.drawn, behind, stopped)
                } else {
                    Piercings::none()
                }
            })
        };
        // for step 7
        let differing = || {
            timed(|| {
                let found = own.differing::<A>(mesh, table, exact, stopped);
                if !found.is_empty() {
                    // All polygons are asked about these; the same tree decides the counts that fail.
                    exact.prepare();
                }
                found
            })
        };
        let (((seeds, a), (differing, b)), ((crossed, c), (pierced, d))) =
            rayon::join(|| rayon::join(seeds, differing), || rayon::join(crossed, pierced));
        let seconds = &mut self.seconds;
        [seconds.seeds, seconds.own_faces, seconds.crossings, seconds.piercings] = self.clock.shared([a, b, c, d]);
        Found { seeds, crossed, pierced, differing }
    }
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
