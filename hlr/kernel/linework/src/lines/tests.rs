//! Tests of the whole way from pieces of edges to the lines of a drawing.

use std::f64::consts::TAU;

use hlr_brep::geometry::curve::Curve;
use hlr_visibility::scan::invisibility::State;

use super::camera::Camera;
use super::candidates::{About, Chains};
use super::coincident::Widths;
use super::cut::{Tolerances, Trait, cut};
use super::drawing::{Curve as Shape, Kind, Lines};
use super::finish::{finish, guide};
use super::geometry::{Geometry, Piece};
use crate::fit::routes::{Curves, Fit};

/// From above, two millimetres on paper per model unit.
const CAMERA: Camera =
    Camera { direction: [0.0, 0.0, 1.0], right: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0], eye: None, scale: 2.0 };
const ACCURACY: f64 = 0.05;

/// A closed walk around these points, of one edge of the source.
struct Ring {
    space: Vec<[f64; 3]>,
    kind: Kind,
    curve: Option<Curve>,
}

impl Ring {
    fn edges(&self) -> Vec<[i32; 2]> {
        let n = self.space.len() as i32;
        (0..n).map(|i| [i, (i + 1) % n]).collect()
    }

    /// The lines of the ring, with one piece per edge. `hidden`: whether hidden lines are drawn.
    fn drawn(&self, state: impl Fn(usize) -> State, hidden: bool, stop: bool) -> Option<Lines> {
        let edges = self.edges();
        let mut chains = Chains::new();
        let numbers: Vec<i32> = (0..edges.len() as i32).collect();
        let about = About {
            kind: self.kind,
            part: 3,
            edge: 7,
            face: -1,
            other: -1,
            noisy: false,
            straight: false,
            shallow: false,
        };
        chains.push(&numbers, &vec![false; edges.len()], about);
        let traits = [Trait { rank: 0, without_brep: false, noisy: false }];
        let pieces: Vec<Piece> = (0..edges.len()).map(|e| Piece { start: 0.0, end: 1.0, state: state(e) }).collect();
        let geometry = Geometry {
            camera: &CAMERA,
            space: &self.space,
            meshed: &self.space,
            edges: &edges,
            pieces: &pieces,
            piece_edge: &numbers,
        };
        let tolerances = Tolerances {
            accuracy: ACCURACY,
            short: ACCURACY,
            flip: ACCURACY,
            stub: 0.5,
            widths: Widths { same: 0.01, under: 0.02 },
            flat: 0.001,
            space: 0.001,
        };
        let mut found = cut(&geometry, &chains, &traits, &tolerances, &|| stop)?;
        if !hidden {
            found.keep_sighted(traits.len());
        }
        let curves = Curves {
            known: self.curve.is_some(),
            ranges: vec![[0.0, TAU]; usize::from(self.curve.is_some())],
            places: vec![[[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]],
            curves: self.curve.iter().cloned().map(Some).collect(),
        };
        let guides = [guide(&chains.about[0], &traits[0], self.curve.is_some().then_some(0), 0, 0.0)];
        let fit = Fit { accuracy: ACCURACY, chord: 0.25, closed: 1e-6, contact: 1e-3 };
        Some(finish(found, &chains.about, &guides, &curves, &CAMERA, &fit, hidden).0)
    }
}

/// Ten by ten model units, its lower left corner away from the origin.
fn square() -> Ring {
    let space = vec![[5.0, 5.0, 0.0], [15.0, 5.0, 0.0], [15.0, 15.0, 0.0], [5.0, 15.0, 0.0]];
    Ring { space, kind: Kind::SHARP, curve: None }
}

fn circle() -> Ring {
    let at = |k: usize| TAU * k as f64 / 32.0;
    let space = (0..32).map(|k| [4.0 * at(k).cos(), 4.0 * at(k).sin(), 1.0]).collect();
    let curve = Curve::Ellipse { p: [0.0, 0.0, 1.0], a: [4.0, 0.0, 0.0], b: [0.0, 4.0, 0.0] };
    Ring { space, kind: Kind::SHARP, curve: Some(curve) }
}

#[test]
fn a_square_is_one_closed_line_from_its_lower_left_corner() {
    let lines = square().drawn(|_| State::Visible, true, false).expect("an answer").0;
    let [line] = &lines[..] else { panic!("{lines:?}") };
    assert!(line.visible && line.curve.is_none() && (line.part, line.edge, line.kind) == (3, 7, Kind::SHARP));
    assert_eq!(line.flat, [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0], [0.0, 0.0]]);
    assert_eq!((line.space[0], line.space[2]), ([5.0, 5.0, 0.0], [15.0, 15.0, 0.0]));
}

#[test]
fn a_hidden_side_is_a_line_of_its_own_that_is_drawn_if_asked_for() {
    let hidden_side = |e: usize| if e == 2 { State::Hidden } else { State::Visible };
    let lines = square().drawn(hidden_side, true, false).expect("an answer").0;
    let hidden: Vec<_> = lines.iter().filter(|line| !line.visible).map(|line| line.flat.clone()).collect();
    assert_eq!(hidden, [vec![[20.0, 20.0], [0.0, 20.0]]]);
    assert_eq!(lines.len(), 2);
    let lines = square().drawn(hidden_side, false, false).expect("an answer").0;
    assert!(lines.len() == 1 && lines[0].visible && lines[0].flat.len() == 4);
    assert!(square().drawn(|_| State::Hidden, false, false).expect("an answer").0.is_empty());
}

#[test]
fn chords_of_a_circle_become_that_circle() {
    let lines = circle().drawn(|_| State::Visible, true, false).expect("an answer");
    let [line] = &lines.0[..] else { panic!("{lines:?}") };
    let Some(Shape::Arc(arc)) = &line.curve else { panic!("{:?}", line.curve) };
    // Eight millimetres around the middle of its box.
    assert!(arc.centre.iter().all(|c| (c - 8.0).abs() < 1e-9), "{arc:?}");
    assert!((arc.axes[0][0].hypot(arc.axes[0][1]) - 8.0).abs() < 1e-9, "{arc:?}");
    assert!(((arc.angles[1] - arc.angles[0]).abs() - TAU).abs() < 1e-9, "{arc:?}");
    let [low, high] = lines.bounds().expect("a line");
    assert!(low.iter().all(|c| c.abs() < 1e-9) && high.iter().all(|c| (c - 16.0).abs() < 1e-9));
}

#[test]
fn it_can_be_stopped() {
    assert!(square().drawn(|_| State::Visible, true, true).is_none());
}
