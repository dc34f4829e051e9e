//! Checks linework on any points and pieces, step by step and as a whole: it terminates, stays finite, adds nothing and
//! loses nothing.

use hlr_exact::elementary::hypot;
use hlr_linework::lines::camera::Camera;
use hlr_linework::lines::candidates::{About, Chains};
use hlr_linework::lines::coincident::{Widths, uncovered};
use hlr_linework::lines::cut::{Tolerances, Trait, cut as drawn, ranked};
use hlr_linework::lines::drawing::Kind;
use hlr_linework::lines::ends::Ends;
use hlr_linework::lines::geometry::{Geometry, Piece};
use hlr_linework::lines::owners::{Order, Owners};
use hlr_linework::lines::runs::cut;
use hlr_linework::lines::short_pieces::short_pieces;
use hlr_linework::lines::simplify::simplify;
use hlr_linework::lines::specks::drop_specks;
use hlr_linework::lines::turned::begin_at_a_turn;
use hlr_linework::lines::{Polyline, View, distance};
use hlr_visibility::scan::invisibility::State;

use super::bytes::Bytes;
use super::topology::check_chains;

/// The rank of shallow intersection lines.
const SHALLOW: u8 = 10;

struct Case {
    flat: Vec<[f64; 2]>,
    space: Vec<[f64; 3]>,
    camera: Camera,
    view: View,
    edges: Vec<[i32; 2]>,
    pieces: Vec<Piece>,
    piece_edge: Vec<i32>,
    chains: Vec<(Vec<i32>, Vec<bool>)>,
    tolerances: Tolerances,
    traits: Vec<Trait>,
    /// Pieces ascend and do not overlap, as the visibility pass makes them.
    proper: bool,
}

pub fn run(data: &[u8]) {
    let case = read(&mut Bytes::new(data));
    check_chains(&case.edges, &vec![0; case.edges.len()]);
    let geometry = Geometry {
        camera: &case.camera,
        space: &case.space,
        meshed: &case.space,
        edges: &case.edges,
        pieces: &case.pieces,
        piece_edge: &case.piece_edge,
    };
    let mut lines = Vec::new();
    for (id, (edges, reversed)) in case.chains.iter().enumerate() {
        let noise = || geometry.noise(edges, case.tolerances.short);
        let limits = case.tolerances.limits(&case.traits[id], case.kind() == Kind::INTERSECTION, noise);
        lines.extend(cut(&geometry, edges, reversed, id as u32, &limits, &|_| false));
    }
    check_lines(&case, &lines, "cut");
    if case.proper {
        check_length(&case, &lines);
    }
    for line in &mut lines {
        let before = line.clone();
        begin_at_a_turn(line, case.tolerances.widths);
        check_turned(&case, &before, line);
    }
    let owners: Vec<Owners> = lines.iter().map(|line| Owners::of(&case.about(line.chain as usize))).collect();
    let short_pieces = short_pieces(&lines, &owners, case.tolerances.widths);
    let rank = ranked(&lines, &case.traits, &short_pieces, &case.view, case.tolerances.space);
    check_ranks(&lines, &rank);
    let all = lines.clone();
    let mut lines = uncovered(lines, &Order { rank: &rank, owners: &owners }, case.tolerances.widths, &case.view);
    check_lines(&case, &lines, "uncovered");
    check_cover(&case, &all, &lines);
    let kept = lines.clone();
    drop_specks(&mut lines, case.tolerances.short);
    assert!(lines.iter().all(|l| kept.contains(l)), "specks: a line was changed");
    assert!(
        kept.iter().all(|l| l.length() < case.tolerances.short || lines.contains(l)),
        "specks: a long line was lost"
    );
    let ends = Ends::of(&lines);
    let unthinned = lines.clone();
    for line in &mut lines {
        let before = line.clone();
        let without_brep = case.traits[line.chain as usize].without_brep;
        let met = |i: &usize| without_brep && ends.meet(line, &line.flat[*i]);
        let kept: Vec<usize> = (0..line.flat.len()).filter(met).collect();
        simplify(line, &kept, case.tolerances.flat, case.tolerances.space);
        check_thinned(&before, line, case.tolerances.flat);
    }
    check_lines(&case, &lines, "simplified");
    check_driver(&case, &geometry, &unthinned, &lines);
}

/// Wherever a line begins, each place of it is still there, but for the width of a line.
fn check_turned(case: &Case, before: &Polyline, after: &Polyline) {
    assert_eq!((before.chain, before.visible, before.left_out), (after.chain, after.visible, after.left_out));
    assert_eq!(after.flat.len(), after.space.len(), "turned: {after:?}");
    assert!(after.flat.iter().all(|p| before.flat.contains(p)), "turned: a vertex is new");
    if !case.sane() {
        return;
    }
    let slack = (1.0 + 1e-6) * case.tolerances.widths.same + 1e-9 * case.extent();
    let places = before.flat.windows(2).flat_map(|w| [w[0], [0, 1].map(|k| 0.5 * (w[0][k] + w[1][k])), w[1]]);
    for p in places {
        assert!(after.flat.windows(2).any(|w| off(&p, &w[0], &w[1]) <= slack), "turned: {p:?} of {before:?} is lost");
    }
}

/// A strict order, visible lines first.
fn check_ranks(lines: &[Polyline], rank: &[u32]) {
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_by_key(|&i| rank[i]);
    assert!(order.iter().enumerate().all(|(r, &i)| rank[i] as usize == r), "ranks: {rank:?}");
    assert!(order.windows(2).all(|w| lines[w[0]].visible || !lines[w[1]].visible), "ranks: hidden before visible");
}

/// What drawings call does the same steps; contours of meshes are smoothed within the accuracy.
fn check_driver(case: &Case, geometry: &Geometry, unthinned: &[Polyline], thinned: &[Polyline]) {
    let mut chains = Chains::new();
    for (chain, (edges, reversed)) in case.chains.iter().enumerate() {
        chains.push(edges, reversed, case.about(chain));
    }
    let Some(found) = drawn(geometry, &chains, &case.traits, &case.tolerances, &|| false) else {
        panic!("nothing stopped it");
    };
    assert_eq!(found.lines.len(), thinned.len());
    for ((line, smooth), (before, after)) in found.lines.iter().zip(&found.smooth).zip(unthinned.iter().zip(thinned)) {
        let of = case.traits[line.chain as usize];
        if !(of.noisy && of.without_brep) {
            assert!(smooth.is_none());
            assert_eq!(line, after);
            continue;
        }
        assert_eq!((line.chain, line.visible), (before.chain, before.visible));
        assert!(line.flat.len() > 1 && line.flat.len() == line.space.len(), "{line:?}");
        if !case.sane() {
            continue;
        }
        let slack = case.tolerances.accuracy + 1e-9 * case.extent();
        for p in &line.flat {
            let near = before.flat.windows(2).any(|w| off(p, &w[0], &w[1]) <= slack);
            assert!(near, "{p:?} was smoothed away from {before:?}");
        }
    }
}

fn read(bytes: &mut Bytes) -> Case {
    let proper = !bytes.byte().is_multiple_of(8);
    let kind = bytes.numbers();
    // On paper and in a model no coordinate is beyond the limits that the entry sets; Any is for panics alone.
    let places = 2 + bytes.below(24);
    // Times the greatest depth they are still finite.
    let mut number = || bytes.number(kind).clamp(-1e300, 1e300);
    let flat: Vec<[f64; 2]> = (0..places).map(|_| [number(), number()]).collect();
    let perspective = bytes.byte().is_multiple_of(4);
    let camera = Camera {
        direction: [0.0, 0.0, -1.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        eye: perspective.then_some(([0.0; 3], 1.0)),
        scale: 1.0,
    };
    let mut in_space = |p: &[f64; 2]| {
        let depth = f64::from(bytes.byte());
        if perspective { [p[0] * (1.0 + depth), p[1] * (1.0 + depth), 1.0 + depth] } else { [p[0], p[1], depth] }
    };
    let space: Vec<[f64; 3]> = flat.iter().map(&mut in_space).collect();
    let flat: Vec<[f64; 2]> = space.iter().map(|p| camera.point(p)).collect();
    let mut edges = Vec::new();
    let mut chains = Vec::new();
    for _ in 0..1 + bytes.below(6) {
        let (mut members, mut reversed) = (Vec::new(), Vec::new());
        let mut at = bytes.below(places);
        for _ in 0..1 + bytes.below(12) {
            let next = bytes.below(places);
            let back = bytes.bit();
            members.push(edges.len() as i32);
            reversed.push(back);
            edges.push(if back { [next as i32, at as i32] } else { [at as i32, next as i32] });
            // A chain may jump, where clipping has cut something out of it.
            at = if bytes.byte().is_multiple_of(16) { bytes.below(places) } else { next };
        }
        chains.push((members, reversed));
    }
    let (mut pieces, mut piece_edge) = (Vec::new(), Vec::new());
    for edge in 0..edges.len() as i32 {
        let mut cuts: Vec<f64> = (0..bytes.below(4)).map(|_| bytes.fraction()).collect();
        if proper {
            cuts.extend([0.0, 1.0]);
            cuts.sort_unstable_by(f64::total_cmp);
            cuts.dedup();
        }
        let drawn = !bytes.byte().is_multiple_of(8);
        for w in cuts.windows(2).filter(|_| drawn) {
            let state = [State::Visible, State::Hidden, State::Within, State::Diving][bytes.below(4)];
            pieces.push(Piece { start: w[0], end: w[1], state });
            piece_edge.push(edge);
        }
    }
    let extent = flat.iter().flatten().map(|c| c.abs()).fold(0.0, f64::max);
    // From the accuracy, as hlr derives them: at most a quarter of the drawing, at least what its grid can tell apart.
    let accuracy = if extent > 0.0 { extent * 0.25f64.powi(1 + (bytes.byte() % 12) as i32) } else { 0.05 };
    let noisy = bytes.bit();
    let traits = chains
        .iter()
        .map(|_| Trait { noisy, rank: [0, 1, SHALLOW, 16][bytes.below(4)], without_brep: bytes.bit() })
        .collect();
    Case {
        flat,
        space,
        view: camera.view(),
        camera,
        edges,
        pieces,
        piece_edge,
        chains,
        tolerances: Tolerances {
            accuracy,
            short: accuracy,
            flip: accuracy,
            stub: 10.0 * accuracy,
            widths: Widths { same: 0.5 * accuracy, under: 3.0 * accuracy },
            flat: 0.25 * accuracy,
            space: 0.25 * accuracy,
        },
        traits,
        proper,
    }
}

impl Case {
    /// All are edges, or all are intersection lines: where both were, edges might go through a surface.
    fn kind(&self) -> Kind {
        if self.chains.len().is_multiple_of(2) { Kind::INTERSECTION } else { Kind::SHARP }
    }

    fn about(&self, chain: usize) -> About {
        let (kind, shallow) = (self.kind(), self.traits[chain].rank == SHALLOW);
        About { kind, part: 0, edge: -1, face: -1, other: -1, noisy: false, straight: false, shallow }
    }

    fn extent(&self) -> f64 {
        self.flat.iter().flatten().map(|c| c.abs()).fold(0.0, f64::max)
    }

    /// Numbers whose squares neither overflow nor vanish.
    fn sane(&self) -> bool {
        self.flat.iter().flatten().all(|c| *c == 0.0 || (1e-60..1e60).contains(&c.abs()))
    }
}

/// Finite, two points or more, and every point on an edge of its own chain.
fn check_lines(case: &Case, lines: &[Polyline], step: &str) {
    if !case.sane() {
        return;
    }
    let slack = 1e-9 * case.extent();
    for line in lines {
        assert!(line.flat.len() > 1 && line.flat.len() == line.space.len(), "{step}: {line:?}");
        assert!(
            line.flat.iter().flatten().chain(line.space.iter().flatten()).all(|c| c.is_finite()),
            "{step}: {line:?}"
        );
        for p in &line.flat {
            let on = |e: &i32| {
                let [a, b] = case.edges[*e as usize].map(|v| case.flat[v as usize]);
                off(p, &a, &b) <= slack
            };
            assert!(case.chains[line.chain as usize].0.iter().any(on), "{step}: {p:?} is on no edge of its chain");
        }
    }
}

/// Settling states moves ends of lines about, but draws each piece of each chain once. Contours of meshes lose loops.
fn check_length(case: &Case, lines: &[Polyline]) {
    if !case.sane() {
        return;
    }
    for (id, (edges, _)) in case.chains.iter().enumerate() {
        let wanted: f64 = edges
            .iter()
            .map(|&e| {
                let [a, b] = case.edges[e as usize].map(|v| case.flat[v as usize]);
                let own = case.pieces.iter().zip(&case.piece_edge).filter(|(_, edge)| **edge == e);
                distance(&a, &b) * own.map(|(p, _)| p.end - p.start).sum::<f64>()
            })
            .sum();
        let found: f64 = lines.iter().filter(|l| l.chain == id as u32).map(Polyline::length).sum();
        if case.traits[id].noisy && case.traits[id].without_brep {
            assert!(found <= wanted + 1e-9 * (wanted + case.extent()), "chain {id}: {found} drawn of {wanted}");
            continue;
        }
        assert!((found - wanted).abs() <= 1e-9 * (wanted + case.extent()), "chain {id}: {found} drawn of {wanted}");
    }
}

/// Nothing is lost where coincident lines are drawn once: beside every point there is still a line.
fn check_cover(case: &Case, before: &[Polyline], after: &[Polyline]) {
    if !case.sane() || case.tolerances.short > 0.2 * case.extent() {
        return;
    }
    // A line yields to another within a width, that one to a third; gaps of two widths are closed along the line.
    let widest = case.tolerances.widths.same.max(case.tolerances.widths.under);
    let reach = 4.0 * widest * (before.len() as f64 + 2.0) + 1e-9 * case.extent();
    for line in before {
        // Both ends of a line may yield by two widths: of a short one that runs back over itself nothing may be left.
        let size = |k: usize| line.flat.iter().map(|p| (p[k] - line.flat[0][k]).abs()).fold(0.0, f64::max);
        if size(0).max(size(1)) < 8.0 * widest {
            continue;
        }
        for p in &line.flat {
            let near = after.iter().any(|l| l.flat.windows(2).any(|w| off(p, &w[0], &w[1]) <= reach));
            assert!(near, "nothing is left near {p:?} of {line:?}");
        }
    }
}

/// Every vertex left out lies within the tolerance of what is left.
fn check_thinned(before: &Polyline, after: &Polyline, thin: f64) {
    let ends = |l: &Polyline| (l.flat[0], l.flat[l.flat.len() - 1]);
    assert_eq!(ends(before), ends(after));
    if before.flat.iter().flatten().any(|c| *c != 0.0 && !(1e-60..1e60).contains(&c.abs())) {
        return;
    }
    for p in &before.flat {
        let near =
            after.flat.windows(2).any(|w| off(p, &w[0], &w[1]) <= thin * (1.0 + 1e-6) + 1e-12 * hypot(p[0], p[1]));
        assert!(near, "{p:?} was left out of {before:?}");
    }
}

fn off(p: &[f64; 2], a: &[f64; 2], b: &[f64; 2]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = u[0] * u[0] + u[1] * u[1];
    let t = if square > 0.0 { ((u[0] * v[0] + u[1] * v[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, &[a[0] + t * u[0], a[1] + t * u[1]])
}
