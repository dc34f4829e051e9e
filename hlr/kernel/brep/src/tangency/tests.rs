//! Tests of where two faces are tangent along an edge: angles along an edge of length 10 on the x axis, and the pieces
//! that follow.

use super::*;
use crate::geometry::curve::Curve;

fn even(count: u32) -> Vec<f64> {
    (0..=count).map(|i| f64::from(i) / f64::from(count)).collect()
}

/// Whether each piece is smooth, and the joints in tenths of the edge, rounded to four digits.
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
    // The limit is a hundredth of a radian where the angle does not waver.
    assert_eq!(of(|_| 0.0099), (vec![true], vec![]));
    assert_eq!(of(|_| 0.0101), (vec![false], vec![]));
    assert_eq!(of(|_| 0.5), (vec![false], vec![]));
}

#[test]
fn pieces_of_two_classes() {
    assert_eq!(of(between(0.4, 0.7, 0.5, 0.001)), (vec![true, false, true], vec![4.0, 7.0]));
    assert_eq!(of(between(0.4, 2.0, 0.5, 0.001)), (vec![true, false], vec![4.0]));
    assert_eq!(of(between(-1.0, 0.4, 0.5, 0.001)), (vec![false, true], vec![4.0]));
    // A tangent stretch shorter than a tenth of the edge makes no piece.
    assert_eq!(of(between(0.085, 0.5, 0.5, 0.001)), (vec![false, true], vec![5.0]));
    assert_eq!(of(between(0.115, 0.5, 0.5, 0.001)), (vec![true, false, true], vec![1.15, 5.0]));
}

#[test]
fn a_short_fold_says_nothing() {
    // An angle along less than a fiftieth of the length is ignored.
    assert_eq!(of(between(0.495, 0.505, 0.5, 0.001)), (vec![true], vec![]));
    assert_eq!(of(between(0.485, 0.515, 0.5, 0.001)).0, [true, false, true]);
    // Three short folds, together below the limit for all short folds; five, together above it.
    let three = |at: f64| if [0.2, 0.5, 0.8].iter().any(|s: &f64| (at - s).abs() < 0.005) { 0.5 } else { 0.001 };
    assert_eq!(of(three), (vec![true], vec![]));
    let several = [0.2, 0.35, 0.5, 0.65, 0.8];
    let folds = |at: f64| if several.iter().any(|s: &f64| (at - s).abs() < 0.005) { 0.5 } else { 0.001 };
    assert_ne!(of(folds).0, [true]);
}

#[test]
fn the_last_place_counts_half_a_step() {
    for end in [0.0f64, 1.0] {
        // At an end: a fold over three places (two and a half steps) is longer than a fiftieth, one over two places is
        // not.
        let fold = |width: f64| move |at: f64| if (at - end).abs() < width { 0.5 } else { 0.001 };
        assert_eq!(of(fold(0.005)), (vec![true], vec![]));
        assert_eq!(of(fold(0.015)), (vec![true], vec![]));
        assert_eq!(of(fold(0.025)).0, if end == 0.0 { [false, true] } else { [true, false] });
    }
}

#[test]
fn what_waves_is_whole() {
    // An angle that is clear nowhere makes no piece: the whole edge is tangent or is not.
    assert_eq!(of(between(0.3, 0.7, 0.09, 0.001)).0, [false]);
    assert_eq!(at(&between(0.3, 0.7, 0.09, 0.001), &even(100), true).0, [true]);
    assert_eq!(at(&between(0.3, 0.7, 0.11, 0.001), &even(100), true).0, [true, false, true]);
    // An angle up to 0.02 rad is tangent if the root mean square is small: 0.018 on a fifth of the edge, not on a
    // third.
    assert_eq!(of(between(0.4, 0.58, 0.018, 0.001)).0, [true]);
    assert_eq!(of(between(0.3, 0.7, 0.018, 0.001)).0, [false]);
    assert_eq!(of(between(0.4, 0.46, 0.021, 0.001)).0, [false]);
    assert_eq!(of(between(0.4, 0.46, 0.0195, 0.001)).0, [true]);
}

#[test]
fn a_normal_turned_round_says_nothing_where_the_rest_is_tangent() {
    assert_eq!(of(between(0.4, 0.7, PI - 0.05, 0.001)).0, [true]);
    assert_eq!(of(between(0.4, 0.7, PI - 0.15, 0.001)).0, [true, false, true]);
    // But not where almost nothing else of the edge is tangent.
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
fn length_is_a_share_whatever_the_size() {
    for size in [1e-3, 10.0] {
        let smooth = |high: f64| {
            let angle = between(0.495, high, 0.5, 0.001);
            let found: Vec<_> = even(100).iter().map(|&s| (s, angle(s), [size * s, 0.0, 0.0])).collect();
            pieces(&found, false, &|share| Some(angle(share)))
        };
        assert_eq!(smooth(0.505), Meeting::Whole(true), "{size}");
        assert!(matches!(smooth(0.525), Meeting::Pieces(smooth, _) if smooth == [true, false, true]), "{size}");
    }
}

#[test]
fn a_joint_lies_where_the_class_changes() {
    let (smooth, joints) = of(between(0.3123, 0.6456, 0.5, 0.001));
    assert_eq!(smooth, [true, false, true]);
    assert_eq!(joints, [3.123, 6.456]);
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

#[test]
fn elementary_faces_that_waver_about_tangency_are_tangent_where_they_mostly_are() {
    // A nearly flat cone and a plane: the angle between them ranges from the difference of their tilts to the sum.
    let frame = |turn: f64| {
        let (sin, cos) = f64::sin_cos(turn);
        [0.0, 0.0, 0.0, cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos]
    };
    let round = Curve::Line { p: [0.0, 1.0, 0.0], a: [1.0, 0.0, 0.0] };
    for (cone_tilt, plane_tilt, smooth) in [(0.0054, 0.0054, true), (0.002, 0.0088, false), (0.015, 0.015, false)] {
        let cone = Surface::read(3, &[&frame(0.0)[..], &[1.0, 0.5 * PI - cone_tilt]].concat()).unwrap();
        let plane = Surface::read(1, &frame(plane_tilt)).unwrap();
        let curve = Some((&round, [0.0, 2.0 * PI]));
        let sides = [
            Side { surface: &cone, curve, place: None, reversed: true, free: false },
            Side { surface: &plane, curve: None, place: None, reversed: false, free: false },
        ];
        let fixed = sides.each_ref().map(Fixed::new);
        let found = places(&fixed, false).into_iter().map(|s| angle(&fixed, s).unwrap()).fold(0.0, f64::max);
        assert!((found - cone_tilt - plane_tilt).abs() < 1e-6, "{found}");
        assert_eq!(meeting(&sides, false), Meeting::Whole(smooth), "{cone_tilt} {plane_tilt}");
    }
}

/// A flat patch over 0..1 in u, with the given knots along v.
fn patch(knots: &[f64]) -> Surface {
    let (mut data, n) = (vec![1.0, 1.0, 2.0, knots.len() as f64, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, knots[0]], knots.len());
    data.extend(knots);
    data.push(knots[n - 1]);
    for u in [0.0, 1.0] {
        data.extend(knots.iter().flat_map(|&v| [u, v, 0.0, 1.0]));
    }
    Surface::read(8, &data).unwrap()
}

#[test]
fn faces_are_compared_on_either_side_of_each_knot_that_an_edge_passes() {
    let (fine, plain) = (patch(&[0.0, 0.21, 0.4, 0.63, 1.0]), patch(&[0.0, 1.0]));
    let along = Curve::Line { p: [1.0, 0.0, 0.0], a: [0.0, 1.0, 0.0] };
    let side = |surface| Side { surface, curve: Some((&along, [0.0, 1.0])), place: None, reversed: false, free: true };
    let places = |one, other| places(&[Fixed::new(&side(one)), Fixed::new(&side(other))], true);
    let found = places(&fine, &plain);
    for knot in [0.21, 0.4, 0.63] {
        for beside in [-1e-5, 1e-5] {
            let (low, high) = if beside < 0.0 { (knot + beside, knot) } else { (knot, knot + beside) };
            assert!(found.iter().any(|s| low < *s && *s < high), "{knot} {beside}: {found:?}");
        }
    }
    assert!(found.windows(2).all(|w| w[0] < w[1] && w[1] - w[0] < 1.0 / 16.0));
    // Without knots there are fewer places.
    assert!(places(&plain, &plain).len() < found.len());
}

#[test]
fn a_glance_tells_what_is_far_from_every_limit_and_nothing_else() {
    // A flat patch beside one whose outer corners rise: along v the angle goes from one rise to the other.
    let rising = |low: f64, high: f64| {
        let mut data = vec![1.0, 1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
        data.extend([0.0, 0.0, low, 1.0, 0.0, 1.0, high, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0]);
        Surface::read(8, &data).unwrap()
    };
    let flat = patch(&[0.0, 1.0]);
    let along = Curve::Line { p: [1.0, 0.0, 0.0], a: [0.0, 1.0, 0.0] };
    let curve = Some((&along, [0.0, 1.0]));
    for (low, high, told) in [
        (0.0, 0.0, Some(true)),
        (0.001, 0.006, Some(true)),
        (0.001, 0.0099, None),
        (0.0, 0.5, None),
        (0.05, 0.05, None),
        (0.101, 0.2, None),
        (0.2, 0.5, Some(false)),
        (1.0, -1.0, None),
    ] {
        let tilted = rising(low, high);
        let sides = [&flat, &tilted].map(|surface| Side { surface, curve, place: None, reversed: false, free: true });
        assert_eq!(clear_case(&sides.each_ref().map(Fixed::new), 8), told, "{low} {high}");
        assert!(told.is_none_or(|smooth| meeting(&sides, false) == Meeting::Whole(smooth)));
    }
}
