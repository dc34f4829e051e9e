//! Combs, rings and dots: what is left out of them, and how crowded they are.

use super::grid::STEPS;
use super::ink::Ink;
use super::joints::joined;
use super::left_out::{Fate, left_out};
use super::spacing::{Spacing, spacings};
use crate::fit::plane::Vec2;
use crate::lines::drawing::{Kind, Line, Lines};

const PEN: f64 = 0.25;
const ACCURACY: f64 = 0.05;

fn line(flat: Vec<Vec2>) -> Line {
    let space = vec![[0.0; 3]; flat.len()];
    Line { kind: Kind::SHARP, visible: true, part: 0, edge: -1, face: -1, other: -1, flat, space, curve: None }
}

/// Upright lines, so many pens apart.
fn comb(count: usize, pens: f64) -> Lines {
    let tooth = |i: usize| line(vec![[i as f64 * pens * PEN, 0.0], [i as f64 * pens * PEN, 20.0]]);
    Lines((0..count).map(tooth).collect())
}

/// Of the lines of one visibility beside those of the same or of the other one.
fn spacing(lines: &Lines, sorts: [bool; 2], reach: f64) -> Option<Spacing> {
    let [hidden, visible, under] = spacings(&Ink::of(lines, [reach; 2]), [reach; 3]);
    match sorts {
        [true, _] => visible,
        [false, false] => hidden,
        [false, true] => under,
    }
}

/// Numbers that look random, and are the same on every run: each time one from 0 to below n.
fn below(seed: u64) -> impl FnMut(u64) -> f64 {
    let mut state = seed;
    move |n| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 33) % n) as f64
    }
}

fn fates(lines: &Lines) -> Vec<Fate> {
    left_out(lines, &Ink::of(lines, [2.0 * PEN; 2]), [PEN, PEN], ACCURACY, &[Kind::SHARP])
}

fn drawn(lines: &Lines) -> Vec<usize> {
    (0..lines.0.len()).filter(|&i| fates(lines)[i] == Fate::Drawn).collect()
}

#[test]
fn combs_are_thinned_to_more_than_a_pen_and_keep_their_borders() {
    assert_eq!(drawn(&comb(10, 0.4)), [0, 3, 6, 9]);
    assert_eq!(drawn(&comb(9, 0.6)), [0, 2, 4, 6, 8]);
    assert_eq!(drawn(&comb(9, 0.9)), [0, 2, 4, 6, 8]);
    assert_eq!(drawn(&comb(9, 1.1)).len(), 9);
    // A thin sheet has two outlines, however thin it is.
    assert_eq!(drawn(&comb(2, 0.1)).len(), 2);
}

#[test]
fn rings_are_thinned_and_the_outermost_stays() {
    let ring = |r: f64| {
        let at = |i: i32| [r * (f64::from(i) / 32.0).cos(), r * (f64::from(i) / 32.0).sin()];
        line((0..=201).map(at).collect())
    };
    let rings = Lines((0..10).map(|i| ring(5.0 + 0.6 * PEN * f64::from(i))).collect());
    let left = drawn(&rings);
    assert!(left.contains(&0) && left.contains(&9) && (5..=6).contains(&left.len()), "{left:?}");
}

#[test]
fn a_figure_smaller_than_the_pen_goes_and_a_chain_of_small_pieces_stays() {
    let side = 0.8 * PEN;
    let dot = |x: f64, y: f64| line(vec![[x, y], [x + side, y], [x + side, y + side], [x, y]]);
    let piece = |i: usize| line(vec![[i as f64 * side, 9.0], [(i + 1) as f64 * side, 9.0]]);
    let mut lines = comb(1, 1.0);
    lines.0.push(dot(3.0, 3.0));
    lines.0.extend((0..40).map(piece));
    let found = fates(&lines);
    assert_eq!(found.iter().filter(|f| **f == Fate::Small).count(), 1);
    assert_eq!(found[1], Fate::Small);
    // A drawing that is all dot stays.
    assert_eq!(drawn(&Lines(vec![dot(0.0, 0.0)])), [0]);
}

#[test]
fn a_line_that_goes_on_elsewhere_gets_no_gap() {
    // The middle tooth goes on upward from between its neighbours.
    let mut lines = comb(3, 0.8);
    lines.0.push(line(vec![[0.8 * PEN, 20.0], [0.8 * PEN, 40.0]]));
    assert_eq!(drawn(&lines), [0, 1, 2, 3]);
}

#[test]
fn the_order_of_lines_does_not_matter() {
    let mut lines = comb(40, 0.4);
    let before: Vec<f64> = drawn(&lines).iter().map(|&i| lines.0[i].flat[0][0]).collect();
    lines.0.reverse();
    let mut after: Vec<f64> = drawn(&lines).iter().map(|&i| lines.0[i].flat[0][0]).collect();
    after.reverse();
    assert_eq!(before, after);
}

#[test]
fn spacing_counts_lines_alongside_and_neither_crossings_nor_what_goes_on() {
    let found = spacing(&comb(3, 1.0), [true; 2], 1.0).expect("little ink");
    assert_eq!((found.ink, found.bins[16], found.smallest), (60.0, 60.0, 20.0));
    let cross = Lines(vec![
        line(vec![[0.0, 0.0], [10.0, 0.0]]),
        line(vec![[10.0, 0.0], [20.0, 0.0]]),
        line(vec![[5.0, -5.0], [5.0, 5.0]]),
    ]);
    let found = spacing(&cross, [true; 2], 1.0).expect("little ink");
    assert_eq!(found.bins.iter().sum::<f64>(), 0.0);
    assert!(spacing(&Lines(vec![line(vec![[0.0, 0.0], [1e9, 0.0]])]), [true; 2], 1.0).is_none());
}

#[test]
fn hidden_lines_are_measured_beside_visible_ones() {
    let mut lines = comb(3, 1.0);
    lines.0[1].visible = false;
    let found = spacing(&lines, [false, true], 1.0).expect("little ink");
    assert_eq!((found.ink, found.bins[16], found.bins.iter().sum::<f64>()), (20.0, 20.0, 20.0));
    // The visible ones are two pens apart from one another.
    assert_eq!(spacing(&lines, [true; 2], 1.0).map(|found| found.bins[32]), Some(40.0));
    lines.0.retain(|line| !line.visible);
    assert_eq!(spacing(&lines, [false, true], 1.0).map(|found| found.bins.iter().sum()), Some(0.0));
    lines.0[0].visible = true;
    assert_eq!(spacing(&lines, [false, true], 1.0).map(|found| found.ink), Some(0.0));
}

#[test]
fn all_ink_of_a_line_is_counted_however_many_chords_it_has() {
    // Two lines side by side, in one piece or in many: each piece of ink lies a millimetre from the other line.
    let ink = |chords: usize| {
        let at = |k: usize| 20.0 * k as f64 / chords as f64;
        let along = |y: f64| line((0..=chords).map(|k| [at(k), y]).collect());
        spacing(&Lines(vec![along(0.0), along(1.0)]), [true; 2], 2.0).expect("little ink").bins[64]
    };
    assert_eq!([1, 2, 20, 640].map(ink), [40.0; 4]);
    // So it is where a place lies in the last of its chords, or each chord is shorter than a piece.
    let uneven = line([0.0, 0.1, 0.15, 7.3, 19.99, 20.0].map(|x| [x, 0.0]).to_vec());
    let found = spacing(&Lines(vec![uneven, line(vec![[0.0, 1.0], [20.0, 1.0]])]), [true; 2], 2.0).expect("little ink");
    assert!((found.bins[64] - 40.0).abs() < 0.01);
}

#[test]
fn what_meets_no_sought_line_changes_nothing_about_those() {
    let mut random = below(5);
    let (mut alone, mut together, mut met) = (0, 0, 0);
    for _ in 0..200 {
        let some: Vec<Line> = (0..60)
            .map(|_| {
                let (x, y) = (random(12), random(12));
                let far = if random(3) == 0.0 { 8.0 } else { 1.0 };
                line(vec![[x, y], [x + far * random(2), y + far * random(2)]])
            })
            .collect();
        let lines = Lines(some);
        let short: Vec<bool> = lines.0.iter().map(|l| (0..2).all(|k| l.flat[1][k] - l.flat[0][k] < 2.0)).collect();
        let tolerance = ACCURACY * STEPS;
        let all = joined(&lines, |_| true, |_| true, tolerance, false);
        let few = joined(&lines, |_| true, |i| short[i], tolerance, false);
        let members = |set: &[usize], i: usize| (0..60).filter(|&k| set[k] == set[i]).collect::<Vec<_>>();
        for i in (0..60).filter(|&i| short[i]) {
            let (whole, found) = (members(&all, i), members(&few, i));
            let only_short = whole.iter().all(|&k| short[k]);
            assert_eq!(only_short, found.iter().all(|&k| short[k]));
            assert!(!only_short || whole == found);
            alone += usize::from(only_short && whole.len() == 1);
            together += usize::from(only_short && whole.len() > 1);
            met += usize::from(!only_short);
        }
    }
    assert!(alone > 20 && together > 20 && met > 20, "{alone} {together} {met}");
}

#[test]
fn segments_beside_which_nothing_lies_at_any_place_are_told_at_once() {
    let mut random = below(9);
    let (mut found, mut told) = (0, 0);
    for _ in 0..300 {
        let mut end = || [random(40), random(40)];
        let lines = Lines((0..6).map(|_| line(vec![end(), end()])).collect());
        let [_, Some(grid)] = Ink::of(&lines, [1.0; 2]).grids else { panic!("little ink") };
        for own in &grid.segments {
            for reach in [0.5 * STEPS, 3.0 * STEPS] {
                let mut some = false;
                own.places(0.05 * STEPS)
                    .for_each(|place| grid.beside(own, &place, reach, |_, _| std::mem::replace(&mut some, true)));
                let may = grid.any_beside(own, reach);
                assert!(may || !some);
                found += usize::from(some);
                told += usize::from(!may);
            }
        }
    }
    assert!(found > 200 && told > 1000, "{found} {told}");
}

#[test]
fn shares_add_up_from_bin_to_bin() {
    let shares = |ink: f64| Spacing { bins: vec![1.0, 0.0, 3.0], ink, smallest: 1.0 }.shares();
    assert_eq!(shares(8.0), [0.125, 0.125, 0.5]);
    // Ink of less than a millimetre counts as a millimetre.
    assert_eq!(shares(0.5), [1.0, 1.0, 4.0]);
}
