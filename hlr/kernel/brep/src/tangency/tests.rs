//! Along an edge two faces are tangent or not: the pieces that angles make, of an edge of length 10 along x.

use super::*;

fn even(count: u32) -> Vec<f64> {
    (0..=count).map(|i| f64::from(i) / f64::from(count)).collect()
}

/// Pieces, and joints in tenths of the edge, to four digits.
fn at(angle: &dyn Fn(f64) -> f64, shares: &[f64], recorded: bool) -> (Vec<bool>, Vec<f64>) {
    let found: Vec<(f64, f64, Vector)> = shares.iter().map(|&s| (s, angle(s), [10.0 * s, 0.0, 0.0])).collect();
    match pieces(&found, recorded, &|share| Some(angle(share))) {
        Meeting::Whole(smooth) => (vec![smooth], Vec::new()),
        Meeting::Pieces(smooth, joints) => (smooth, joints.iter().map(|j| (j * 1e5).round() / 1e4).collect()),
        Meeting::Unknown => panic!("the angles are known"),
    }
}

fn between(low: f64, high: f64, inside: f64, outside: f64) -> impl Fn(f64) -> f64 {
    move |at| if at > low && at < high { inside } else { outside }
}

fn of(angle: impl Fn(f64) -> f64) -> (Vec<bool>, Vec<f64>) {
    at(&angle, &even(100), false)
}

#[test]
fn one_class_throughout() {
    assert_eq!(of(|_| 0.0), (vec![true], vec![]));
    assert_eq!(of(|_| 0.5), (vec![false], vec![]));
}

#[test]
fn pieces_of_two_classes() {
    assert_eq!(of(between(0.4, 0.7, 0.5, 0.001)), (vec![true, false, true], vec![4.0, 7.0]));
    assert_eq!(of(between(0.4, 2.0, 0.5, 0.001)), (vec![true, false], vec![4.0]));
    assert_eq!(of(between(-1.0, 0.4, 0.5, 0.001)), (vec![false, true], vec![4.0]));
    // Of less than a tenth of the edge no tangent piece is made.
    assert_eq!(of(between(0.085, 0.5, 0.5, 0.001)), (vec![false, true], vec![5.0]));
    assert_eq!(of(between(0.115, 0.5, 0.5, 0.001)), (vec![true, false, true], vec![1.15, 5.0]));
}

#[test]
fn a_short_fold_says_nothing() {
    // Less than a fiftieth of the length.
    assert_eq!(of(between(0.495, 0.505, 0.5, 0.001)), (vec![true], vec![]));
    assert_eq!(of(between(0.485, 0.515, 0.5, 0.001)).0, [true, false, true]);
    // Three of them, each short, and together more than two may have.
    let several = [0.2, 0.35, 0.5, 0.65, 0.8];
    let folds = |at: f64| if several.iter().any(|s: &f64| (at - s).abs() < 0.005) { 0.5 } else { 0.001 };
    assert_ne!(of(folds).0, [true]);
}

#[test]
fn what_waves_is_whole() {
    // An angle that is nowhere a clear one makes no piece: all or nothing.
    assert_eq!(of(between(0.3, 0.7, 0.09, 0.001)).0, [false]);
    assert_eq!(at(&between(0.3, 0.7, 0.09, 0.001), &even(100), true).0, [true]);
    assert_eq!(at(&between(0.3, 0.7, 0.11, 0.001), &even(100), true).0, [true, false, true]);
    // Up to 0.02 rad it is tangent where the mean square is little: 0.018 on a fifth of the edge, not on a third.
    assert_eq!(of(between(0.4, 0.58, 0.018, 0.001)).0, [true]);
    assert_eq!(of(between(0.3, 0.7, 0.018, 0.001)).0, [false]);
    assert_eq!(of(between(0.4, 0.46, 0.021, 0.001)).0, [false]);
    assert_eq!(of(between(0.4, 0.46, 0.0195, 0.001)).0, [true]);
}

#[test]
fn a_normal_turned_round_says_nothing_where_the_rest_is_tangent() {
    assert_eq!(of(between(0.4, 0.7, PI - 0.05, 0.001)).0, [true]);
    assert_eq!(of(between(0.4, 0.7, PI - 0.15, 0.001)).0, [true, false, true]);
    // But not where next to nothing else is.
    assert_eq!(of(between(0.05, 2.0, PI - 0.05, 0.001)).0, [false]);
}

#[test]
fn length_counts_and_not_the_number_of_places() {
    let mut crowded = even(100);
    crowded.extend(even(200).iter().map(|s| 0.09 * s));
    ascending(&mut crowded);
    assert_eq!(at(&between(-1.0, 0.085, 0.001, 0.5), &crowded, false).0, [false]);
    assert_eq!(at(&between(0.005, 0.0199, 0.5, 0.001), &crowded, false).0, [true]);
    assert_eq!(at(&between(0.005, 0.0299, 0.5, 0.001), &crowded, false).0, [false, true]);
}

#[test]
fn an_edge_without_length_is_one_class() {
    for (angle, smooth) in [(0.001, true), (0.5, false)] {
        let found = [0.0, 0.5, 1.0].map(|share| (share, angle, [0.0; 3]));
        assert_eq!(pieces(&found, false, &|_| Some(angle)), Meeting::Whole(smooth));
    }
}

#[test]
fn faces_that_meet_at_hardly_an_angle_are_tangent() {
    // Planes through the y axis, one tilted by a little.
    let frame = |turn: f64| {
        let (sin, cos) = f64::sin_cos(turn);
        Surface::read(1, &[0.0, 0.0, 0.0, cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos]).unwrap()
    };
    let flat = frame(0.0);
    for (turn, smooth) in [(0.009, true), (0.0108, false), (0.05, false)] {
        let tilted = frame(turn);
        let side = |surface| Side { surface, curve: None, place: None, reversed: false, free: false };
        let sides = [side(&flat), side(&tilted)];
        assert_eq!(meeting(&sides, false), Meeting::Whole(smooth), "{turn}");
        assert_eq!(meeting(&sides, true), Meeting::Whole(true), "{turn}");
    }
}
