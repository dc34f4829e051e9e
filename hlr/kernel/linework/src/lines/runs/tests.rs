use super::super::camera::Camera;
use super::super::geometry::Piece;
use super::*;

/// Along z: x and y are those on paper.
const CAMERA: Camera =
    Camera { direction: [0.0, 0.0, -1.0], right: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0], eye: None, scale: 1.0 };
const LIMITS: Limits = Limits { short: 0.5, stub: 2.0, noise: 0.5, loops: 0.0, end_on: f64::INFINITY };

/// Lines along a straight chain of unit edges with the given states: (visible, x from, x to).
fn lines(states: &[State]) -> Vec<(bool, f64, f64)> {
    lines_within(states, &LIMITS)
}

fn lines_within(states: &[State], limits: &Limits) -> Vec<(bool, f64, f64)> {
    let n = states.len();
    let space: Vec<[f64; 3]> = (0..=n).map(|i| [i as f64, 0.0, 0.0]).collect();
    let edges: Vec<[i32; 2]> = (0..n as i32).map(|i| [i, i + 1]).collect();
    let pieces: Vec<Piece> = states.iter().map(|&state| Piece { start: 0.0, end: 1.0, state }).collect();
    let ids: Vec<i32> = (0..n as i32).collect();
    let g =
        Geometry { camera: &CAMERA, space: &space, meshed: &space, edges: &edges, pieces: &pieces, piece_edge: &ids };
    let found = cut(&g, &ids, &vec![false; n], 0, limits, &|_| false);
    found.iter().map(|l| (l.visible, l.flat[0][0], l.flat[l.flat.len() - 1][0])).collect()
}

/// Lines around a closed chain whose edges have these lengths and states, begun at edge `first`, as stretches
/// (visible, from, to) of its perimeter.
fn around(edges: &[(State, f64)], first: usize, limits: &Limits) -> Vec<(bool, f64, f64)> {
    let n = edges.len();
    // Out along one side and back along the other: the height tells the two sides apart.
    let total: f64 = edges.iter().map(|e| e.1).sum();
    let starts: Vec<f64> = (0..n).map(|i| edges[..i].iter().map(|e| e.1).sum()).collect();
    let corner = (0..n).find(|&i| (starts[i] - 0.5 * total).abs() < 1e-9).expect("a vertex halfway");
    let space: Vec<[f64; 3]> =
        (0..n).map(|i| if i <= corner { [starts[i], 0.0, 0.0] } else { [total - starts[i], 1e-6, 0.0] }).collect();
    let of = |i: usize| (first + i) % n;
    let ends: Vec<[i32; 2]> = (0..n).map(|i| [of(i) as i32, of(i + 1) as i32]).collect();
    let pieces: Vec<Piece> = (0..n).map(|i| Piece { start: 0.0, end: 1.0, state: edges[of(i)].0 }).collect();
    let ids: Vec<i32> = (0..n as i32).collect();
    let g =
        Geometry { camera: &CAMERA, space: &space, meshed: &space, edges: &ends, pieces: &pieces, piece_edge: &ids };
    let place = |p: &[f64; 2]| ((if p[1] > 0.0 { total - p[0] } else { p[0] }) * 1e3).round() * 1e-3;
    let found = cut(&g, &ids, &vec![false; n], 0, limits, &|_| false);
    let mut lines: Vec<_> =
        found.iter().map(|l| (l.visible, place(&l.flat[0]), place(&l.flat[l.flat.len() - 1]))).collect();
    lines.sort_by(|a, b| a.1.total_cmp(&b.1));
    lines
}

#[test]
fn lines_around_a_closed_chain_do_not_depend_on_where_it_begins() {
    use State::{Hidden as H, Visible as V};
    // Perimeter 12: a hidden run of 0.3 is too short; the visible ones around it are not, wherever it starts.
    let short_gap = [(V, 0.1), (H, 2.9), (V, 3.0), (V, 1.0), (H, 3.0), (V, 1.25), (H, 0.3), (V, 0.45)];
    let mirrored: Vec<(State, f64)> = short_gap.iter().rev().copied().collect();
    // A visible run of 0.2, which may be cut in two by the start of the chain.
    let short_run = [(V, 0.1), (H, 2.9), (H, 0.1), (V, 2.9), (H, 3.0), (H, 2.9), (V, 0.1)];
    let noisy = Limits { noise: 0.45, ..LIMITS };
    for first in 0..short_gap.len() {
        let found = around(&short_gap, first, &noisy);
        assert_eq!(found, [(false, 0.1, 3.0), (true, 3.0, 7.0), (false, 7.0, 10.0), (true, 10.0, 0.1)], "{first}");
    }
    for first in 0..mirrored.len() {
        let found = around(&mirrored, first, &noisy);
        assert_eq!(found, [(false, 2.0, 5.0), (true, 5.0, 9.0), (false, 9.0, 11.9), (true, 11.9, 2.0)], "{first}");
    }
    for first in 0..short_run.len() {
        let found = around(&short_run, first, &LIMITS);
        assert_eq!(found, [(true, 3.1, 6.0), (false, 6.0, 3.1)], "{first}");
    }
}

#[test]
fn noise_is_a_few_edges_long_within_bounds() {
    let noise = |edge: f64| {
        let space = &[[0.0; 3], [edge, 0.0, 0.0], [edge, edge, 0.0]];
        let g =
            Geometry { camera: &CAMERA, space, meshed: space, edges: &[[0, 1], [1, 2]], pieces: &[], piece_edge: &[] };
        g.noise(&[0, 1], 0.5)
    };
    assert_eq!(noise(0.001), 0.5, "never less than what is too short anyway");
    assert_eq!(noise(0.4), 1.0, "two edges and a half");
    assert_eq!(noise(100.0), 3.0, "six times what is too short");
}

#[test]
fn a_long_run_is_hidden_from_where_the_line_goes_through_a_surface() {
    use State::{Diving as D, Hidden as H, Visible as V, Within as W};
    let through = |states: &[State], at: usize, closed: bool| {
        let run = |(k, &state): (usize, &State)| Run { state, from: (k, 0.0), to: (k + 1, 0.0), length: 3.0 };
        let runs: Runs = states.iter().enumerate().map(run).collect();
        let settled = settle(runs, &LIMITS, closed, |stop| stop.0 == at);
        settled.iter().map(|run| (run.state == V, run.from.0, run.to.0)).collect::<Vec<_>>()
    };
    assert_eq!(through(&[V, D, H], 9, false), [(true, 0, 2), (false, 2, 3)], "a contact");
    assert_eq!(through(&[V, D, H], 1, false), [(true, 0, 1), (false, 1, 3)]);
    assert_eq!(through(&[V, D, H], 2, false), [(true, 0, 2), (false, 2, 3)], "goes through elsewhere");
    assert_eq!(through(&[V, W, D, H], 1, false), [(true, 0, 1), (false, 1, 4)]);
    assert_eq!(through(&[H, D, W, V], 3, false), [(false, 0, 3), (true, 3, 4)]);
    assert_eq!(through(&[D, H, V], 0, true), [(false, 0, 2), (true, 2, 3)], "around a closed chain");
}

#[test]
fn equal_states_join_across_mesh_edges() {
    use State::{Hidden as H, Visible as V};
    assert_eq!(lines(&[V, V, H, H, H]), [(true, 0.0, 2.0), (false, 2.0, 5.0)]);
}

#[test]
fn a_contour_that_its_own_folds_hide_is_whole() {
    use State::{Hidden as H, Visible as V};
    let noisy = Limits { noise: 1.5, ..LIMITS };
    assert_eq!(lines_within(&[V, H, V, V, H, H, V], &noisy), [(true, 0.0, 4.0), (false, 4.0, 6.0), (true, 6.0, 7.0)]);
    assert_eq!(lines_within(&[H, H, V, H], &noisy), [(false, 0.0, 2.0), (true, 2.0, 3.0), (false, 3.0, 4.0)]);
}

#[test]
fn a_stub_is_hidden_and_a_contact_is_seen() {
    use State::{Diving as D, Hidden as H, Visible as V, Within as W};
    assert_eq!(lines(&[V, D, H]), [(true, 0.0, 1.0), (false, 1.0, 3.0)]);
    assert_eq!(lines(&[V, W, H]), [(true, 0.0, 2.0), (false, 2.0, 3.0)]);
    assert_eq!(lines(&[H, W, W, W]), [(false, 0.0, 1.0), (true, 1.0, 4.0)]);
    assert_eq!(lines(&[W]), [(true, 0.0, 1.0)]);
    // A stub that begins on the edge before, and one as long as a contact.
    let limits = Limits { stub: 2.5, ..LIMITS };
    assert_eq!(lines_within(&[V, W, D, H], &limits), [(true, 0.0, 1.0), (false, 1.0, 4.0)]);
    assert_eq!(lines_within(&[V, D, D, D, H], &limits), [(true, 0.0, 4.0), (false, 4.0, 5.0)]);
}

#[test]
fn a_line_is_divided_where_it_runs_far_along_the_line_of_sight() {
    let lines = |depths: &[f64], end_on: f64| -> Vec<Vec<[f64; 3]>> {
        let mut space: Vec<[f64; 3]> = vec![[0.0, 0.0, depths[0]]];
        space.extend(depths.iter().map(|&z| [1.0, 0.0, z]));
        space.push([2.0, 0.0, depths[depths.len() - 1]]);
        let edges: Vec<[i32; 2]> = (1..space.len() as i32).map(|i| [i - 1, i]).collect();
        let ids: Vec<i32> = (0..edges.len() as i32).collect();
        let whole = Piece { start: 0.0, end: 1.0, state: State::Visible };
        let g = Geometry {
            camera: &CAMERA,
            space: &space,
            meshed: &space,
            edges: &edges,
            pieces: &[whole; 2],
            piece_edge: &[0, ids[ids.len() - 1]],
        };
        let found = cut(&g, &ids, &vec![false; ids.len()], 0, &Limits { end_on, ..LIMITS }, &|_| false);
        assert!(found.iter().all(|line| line.visible && line.flat.len() == line.space.len()));
        found.into_iter().map(|line| line.space).collect()
    };
    assert_eq!(lines(&[0.0, 3.0], 1.0), [[[0.0; 3], [1.0, 0.0, 0.0]], [[1.0, 0.0, 3.0], [2.0, 0.0, 3.0]]]);
    // Not far, one after another far enough, and not asked for.
    assert_eq!(lines(&[0.0, 0.9], 1.0).len(), 1);
    assert_eq!(lines(&[0.0, 0.6, 1.2], 1.0).len(), 2);
    assert_eq!(lines(&[0.0, 3.0], f64::INFINITY), [[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 3.0]]]);
}

#[test]
fn a_contour_goes_on_at_where_a_loop_is_cut_off() {
    use State::{Hidden as H, Visible as V};
    // Two edges that cross at (5, 0.5), and one that leads back; the loop reaches 0.13 beside them.
    let space = [[0.0, 0.0, 0.0], [6.0, 0.6, 2.0], [4.0, 0.6, 4.0], [10.0, 0.0, 6.0]];
    let edges = [[0, 1], [2, 1], [2, 3]];
    let found = |states: [State; 3], loops: f64| {
        let pieces = states.map(|state| Piece { start: 0.0, end: 1.0, state });
        let g = Geometry {
            camera: &CAMERA,
            space: &space,
            meshed: &space,
            edges: &edges,
            pieces: &pieces,
            piece_edge: &[0, 1, 2],
        };
        let limits = Limits { short: 0.1, noise: 0.1, loops, ..LIMITS };
        cut(&g, &[0, 1, 2], &[false, true, false], 0, &limits, &|_| false)
    };
    assert_eq!(found([V, H, V], 0.0).len(), 3, "not asked for");
    let whole = found([V, H, V], 0.01);
    assert_eq!(whole.len(), 1, "{whole:?}");
    assert!(whole[0].visible && whole[0].flat.len() == 3 && whole[0].space.len() == 3);
    assert!(distance(&whole[0].flat[1], &[5.0, 0.5]) < 1e-9);
    // Of what is seen the nearer place stands for both, of what is hidden the farther one.
    assert!((whole[0].space[1][2] - 5.0 / 3.0).abs() < 1e-9, "{whole:?}");
    let hidden = found([H, H, H], 0.01);
    assert!(hidden.len() == 1 && !hidden[0].visible && (hidden[0].space[1][2] - 13.0 / 3.0).abs() < 1e-9, "{hidden:?}");
    assert_eq!(found([H, V, H], 0.01).len(), 3, "what is seen is not lost");
    // What is seen does not go on as what is hidden.
    assert_eq!(found([V, V, H], 0.01).iter().map(|line| line.flat.len()).collect::<Vec<_>>(), [3, 2]);
}
