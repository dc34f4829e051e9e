//! Outlines of simple bodies, traced by all steps together.

use std::f64::consts::TAU;

use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, dot, length, scaled, sub};
use hlr_mesh::topology::topology;

use super::face::{Face, middle};
use super::refine::Stretch;
use super::trace::{Traced, fill_shallow, trace};
use super::{FaceRecord, Model};
use crate::lines::View;

/// Chords around.
const SIDES: usize = 24;
const RADIUS: f64 = 2.0;

/// One face without a seam in its mesh: u of its corners continues beyond a whole turn.
struct Body {
    points: Vec<Vector>,
    triangles: Vec<[i32; 3]>,
    corner: Vec<[i32; 3]>,
    uv: Vec<[f64; 2]>,
    surface: Surface,
}

impl Body {
    /// Rows of nodes at heights v, between u = 0 and a whole turn.
    fn around(kind: u8, heights: &[f64]) -> Body {
        let frame = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, RADIUS];
        let surface = Surface::read(kind, &frame).expect("a surface");
        let mut body = Body { points: vec![], triangles: vec![], corner: vec![], uv: vec![], surface };
        for &v in heights {
            for k in 0..=SIDES {
                // Half a chord aside, so that no node is seen edge-on.
                let u = TAU * (k as f64 + 0.5) / SIDES as f64;
                body.uv.push([u, v]);
                if k < SIDES {
                    body.points.push(body.surface.d1([u, v]).0);
                }
            }
        }
        let point = |row: usize, k: usize| (row * SIDES + k % SIDES) as i32;
        let place = |row: usize, k: usize| (row * (SIDES + 1) + k) as i32;
        for row in 0..heights.len() - 1 {
            for k in 0..SIDES {
                for cell in [[(0, 0), (0, 1), (1, 1)], [(0, 0), (1, 1), (1, 0)]] {
                    body.triangles.push(cell.map(|(up, on)| point(row + up, k + on)));
                    body.corner.push(cell.map(|(up, on)| place(row + up, k + on)));
                }
            }
        }
        body
    }

    fn traced(&self, inward: bool, stop: bool) -> Option<Traced> {
        self.seen(inward, |model| trace(model, &|| stop))
    }

    fn seen<T>(&self, inward: bool, ask: impl Fn(&Model) -> T) -> T {
        let t = topology(&self.triangles, self.points.len());
        let model = Model {
            points: &self.points,
            triangles: &self.triangles,
            // A face without a surface has no parameters.
            triangle_face: &self.corner.iter().map(|c| i32::from(c[0] < 0)).collect::<Vec<_>>(),
            edges: &t.edges,
            offsets: &t.offsets,
            incident: &t.incident,
            crossed: &[],
            smooth: &vec![true; t.edges.len()],
            source: &vec![-1; t.edges.len()],
            corner: &self.corner,
            uv: &self.uv,
            faces: [Some(0), None]
                .map(|surface| FaceRecord {
                    surface,
                    place: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
                    sign: if inward { -1.0 } else { 1.0 },
                    curved: true,
                })
                .into(),
            surfaces: &[Some(self.surface.clone())],
            view: View { origin: [0.0; 3], away: [0.0, 1.0, 0.0], perspective: false },
            chord: 0.01,
        };
        ask(&model)
    }
}

fn cylinder() -> Body {
    Body::around(2, &[0.0, 3.0])
}

/// A sphere without its poles.
fn zone() -> Body {
    Body::around(4, &[-1.2, -0.6, 0.0, 0.6, 1.2])
}

#[test]
fn a_cylinder_from_the_side_has_two_straight_outlines() {
    let found = cylinder().traced(false, false).expect("an answer").silhouettes;
    assert_eq!(found.len(), 2);
    let mut sides = Vec::new();
    for line in &found {
        assert!(line.source == -1 && line.face == 0 && !line.concave);
        let x = line.points[0][0];
        for p in &line.points {
            assert!((p[0] - x).abs() < 1e-9 && p[1].abs() < 1e-5, "{p:?}");
        }
        let mut ends = [line.points[0][2], line.points[line.points.len() - 1][2]];
        ends.sort_by(f64::total_cmp);
        assert!(ends[0].abs() < 1e-9 && (ends[1] - 3.0).abs() < 1e-9, "{ends:?}");
        sides.push(x);
    }
    sides.sort_by(f64::total_cmp);
    assert!((sides[0] + RADIUS).abs() < 1e-9 && (sides[1] - RADIUS).abs() < 1e-9, "{sides:?}");
}

#[test]
fn a_bore_hides_its_own_outlines() {
    let found = cylinder().traced(true, false).expect("an answer").silhouettes;
    assert_eq!(found.iter().map(|line| line.concave).collect::<Vec<_>>(), [true, true]);
    // The outer side of a bore is where its axis is.
    assert!(found.iter().all(|line| dot(&line.normals[0], &line.points[0]) < 0.0));
}

#[test]
fn outlines_of_a_sphere_are_circles_on_it_where_it_is_seen_edge_on() {
    let found = zone().traced(false, false).expect("an answer").silhouettes;
    assert_eq!(found.len(), 2, "one at each side, as the poles are missing");
    for line in &found {
        assert!(line.points.len() > 4);
        for (p, n) in line.points.iter().zip(&line.normals) {
            assert!((length(p) - RADIUS).abs() < 1e-9 && n[1].abs() < 1e-6, "{p:?} {n:?}");
            assert!(length(&sub(p, &n.map(|c| RADIUS * c))) < 1e-9);
        }
        let Some(Curve::Ellipse { p, a, b }) = &line.curve else { panic!("{:?}", line.curve) };
        assert!(length(p) < 1e-9 && (length(a) - RADIUS).abs() < 1e-9 && (length(b) - RADIUS).abs() < 1e-9);
    }
}

#[test]
fn the_middle_of_a_stretch_on_a_sphere_lies_on_it_and_on_the_outline() {
    for inward in [false, true] {
        zone().seen(inward, |model| {
            let face = Face::new(model, 0).expect("a face");
            let half = 0.5 * TAU;
            // Along a meridian, also where u has turned around, and over the pole.
            for (a, b, want) in [
                ([0.0, 0.2], [0.0, 0.5], [0.0, 0.35]),
                ([TAU + half, -0.2], [TAU + half, 0.9], [TAU + half, 0.35]),
                ([0.0, 0.24 * TAU], [half, 0.24 * TAU], [0.5 * half, 0.25 * TAU]),
            ] {
                let [a, b] = [a, b].map(|uv| face.at(uv).expect("a place"));
                let found = middle(&face, &a, &b).expect("a middle");
                assert!(length(&sub(&found.point, &face.point(want))) < 1e-12, "{found:?}");
                assert!(length(&sub(&found.point, &face.point(found.uv))) < 1e-12, "{found:?}");
                assert!((found.uv[0] - want[0]).abs() < 1.6 && (found.uv[1] - want[1]).abs() < 1e-9, "{found:?}");
                let out = if inward { -RADIUS } else { RADIUS };
                assert!(length(&sub(&found.point, &scaled(&found.normal, out))) < 1e-12, "{found:?}");
            }
        });
    }
}

#[test]
fn a_sphere_bends_alike_everywhere_up_to_its_poles() {
    for (inward, sign) in [(false, 1.0), (true, -1.0)] {
        for from_pole in [1.0, 1e-3, 1e-5, 1e-6] {
            let uv = [0.2, 0.25 * TAU - from_pole];
            let (bend, f) = zone().seen(inward, |model| {
                let face = Face::new(model, 0).expect("a face");
                (face.radial(uv), face.f(uv).expect("a normal"))
            });
            let want = sign * (1.0 - f * f) / RADIUS;
            assert!((bend - want).abs() < 1e-9, "{from_pole} {bend} {want}");
        }
        let at_pole = zone().seen(inward, |model| Face::new(model, 0).map(|face| face.radial([0.2, 0.25 * TAU])));
        assert_eq!(at_pole, Some(0.0));
    }
}

#[test]
fn the_same_on_any_number_of_threads() {
    let listed = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let found = pool.install(|| zone().traced(false, false)).expect("an answer").silhouettes;
        found.iter().flat_map(|line| line.points.concat()).map(f64::to_bits).collect::<Vec<u64>>()
    };
    assert_eq!(listed(1), listed(3));
}

#[test]
fn it_can_be_stopped() {
    assert!(cylinder().traced(false, true).is_none());
}

/// Only where nothing is hidden from cusp to cusp, a concave run counts as others; of a closed curve a run may go over
/// its start.
#[test]
fn a_valley_is_filled_as_a_whole_or_not_at_all() {
    let stretch = |mark: char| Stretch {
        from: [0.0; 3],
        to: [1.0, 0.0, 0.0],
        normals: [[0.0, 0.0, 1.0]; 2],
        uv: [None; 2],
        source: -1,
        concave: mark != '+',
        rise: [1.0; 2],
        shallow: (mark == 's').then_some([2.0; 2]),
    };
    let filled = |marks: &str, closed: bool| -> String {
        let mut pieces: Vec<(i32, Stretch)> = marks.chars().map(|mark| (0, stretch(mark))).collect();
        fill_shallow(&mut pieces, closed);
        assert!(pieces.iter().all(|(_, s)| s.rise == [1.0; 2] || !s.concave));
        pieces.iter().map(|(_, s)| if s.concave { '-' } else { '+' }).collect()
    };
    assert_eq!(filled("+ss+sd+ss", false), "++++--+++");
    assert_eq!(filled("ss+sd+d", false), "+++--+-");
    assert_eq!(filled("s+ss+d", true), "-++++-");
    assert_eq!(filled("ssd", true), "---");
    assert_eq!(filled("sss", true), "+++");
}

/// The saddle z = y (0.2 - x / 10), written so that dv vanishes in the middle of its border y = 0. The border is three
/// chords there, the middle of one of which has no normal.
fn saddle() -> Body {
    let (still, away) = ([1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0], [1.0, 1.0 / 3.0, -1.0 / 3.0, -1.0]);
    let along = [-10.0, -10.0 / 3.0, 10.0 / 3.0, 10.0];
    let mut record = vec![3.0, 2.0, 4.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    record.extend([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    for k in 0..4 {
        let cubed = if k % 2 == 0 { 1.0 } else { -1.0 };
        record.extend([along[k], 0.0, 0.0, 1.0]);
        record.extend([along[k], still[k], cubed + 0.2 * still[k], 1.0]);
        record.extend([along[k], 10.0, 10.0 * (away[k] + 0.2), 1.0]);
    }
    let surface = Surface::read(8, &record).expect("a surface");
    let (across, up) = ([0.0, 0.25, 0.75, 1.0], [0.0, 0.3, 0.6, 1.0]);
    let uv: Vec<[f64; 2]> = up.iter().flat_map(|&v| across.map(|u| [u, v])).collect();
    let cells = (0..3).flat_map(|row| (0..3).map(move |k| 4 * row + k));
    let triangles: Vec<[i32; 3]> = cells.flat_map(|k| [[k, k + 1, k + 5], [k, k + 5, k + 4]]).collect();
    let points = uv.iter().map(|&uv| surface.d1(uv).0).collect();
    Body { points, corner: triangles.clone(), triangles, uv, surface }
}

#[test]
fn an_outline_reaches_a_border_although_the_middle_of_its_chord_has_no_normal() {
    let body = saddle();
    assert!(body.surface.normal([0.5, 0.0]).is_none() && body.surface.normal([0.5, 0.1]).is_some());
    for p in &body.points {
        assert!((p[2] - p[1] * (0.2 - p[0] / 10.0)).abs() < 1e-12, "{p:?}");
    }
    let found = body.traced(false, false).expect("an answer").silhouettes;
    // The slope toward y vanishes at x = 2.
    let points: Vec<&Vector> = found.iter().flat_map(|line| &line.points).collect();
    assert!(points.iter().all(|p| (p[0] - 2.0).abs() < 1e-6), "{points:?}");
    let reach = |y: f64| points.iter().any(|p| (p[1] - y).abs() < 1e-6);
    assert!(reach(0.0) && reach(10.0), "{points:?}");
}

/// z = y³ - (d + x²) y for x and y from -1 to 1: between y = ±√((d + x²) / 3) it falls away from the viewer. No node
/// lies in the middle of this strip.
fn furrow(d: f64) -> Body {
    let (still, steady, squared, cubed) =
        ([1.0; 4], [-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0], [1.0, -1.0 / 3.0], [-1.0, 1.0]);
    let mut record = vec![3.0, 3.0, 4.0, 4.0, 0.0, 0.0];
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    record.extend(knots.iter().chain(&knots));
    for i in 0..4 {
        let width = d * still[i] + squared[usize::from(i == 1 || i == 2)];
        for j in 0..4 {
            record.extend([steady[i], steady[j], cubed[j % 2] - width * steady[j], 1.0]);
        }
    }
    let surface = Surface::read(8, &record).expect("a surface");
    let side = 8;
    let uv: Vec<[f64; 2]> =
        (0..side * side).map(|k| [k % side, k / side].map(|step| f64::from(step) / f64::from(side - 1))).collect();
    let cells = (0..side - 1).flat_map(|row| (0..side - 1).map(move |k| side * row + k));
    let triangles: Vec<[i32; 3]> =
        cells.flat_map(|k| [[k, k + 1, k + side + 1], [k, k + side + 1, k + side]]).collect();
    let points = uv.iter().map(|&uv| surface.d1(uv).0).collect();
    Body { points, corner: triangles.clone(), triangles, uv, surface }
}

#[test]
fn two_outlines_go_on_where_less_than_a_triangle_lies_between_them() {
    for d in [0.05, 0.01, 3e-3, 1e-3] {
        let body = furrow(d);
        for p in &body.points {
            assert!((p[2] - p[1].powi(3) + (d + p[0] * p[0]) * p[1]).abs() < 1e-12, "{p:?}");
        }
        let found = body.traced(false, false).expect("an answer").silhouettes;
        assert_eq!(found.len(), 2, "{d}");
        for line in &found {
            let sign = line.points[0][1].signum();
            assert_eq!(line.concave, sign > 0.0, "{d}");
            for [x, y, _] in &line.points {
                assert!((y - sign * ((d + x * x) / 3.0).sqrt()).abs() < 1e-6, "{d} {x} {y}");
            }
            let ends = [line.points[0][0], line.points[line.points.len() - 1][0]];
            assert!((ends[0] - ends[1]).abs() > 2.0 - 1e-9, "{d} {ends:?}");
            let step = line.points.windows(2).map(|p| (p[1][0] - p[0][0]).abs()).fold(0.0, f64::max);
            assert!(step < 0.5, "{d} {step}");
        }
    }
}

/// Where the strip closes before it comes to other changes of sign, or nowhere opens, there is nothing to go on with.
#[test]
fn outlines_of_a_strip_that_closes_turn_back() {
    let found = furrow(-0.1).traced(false, false).expect("an answer").silhouettes;
    assert!(found.iter().flat_map(|line| &line.points).all(|p| p[0] * p[0] > 0.1), "{found:?}");
    let reach = found.iter().flat_map(|line| &line.points).map(|p| p[0].abs()).fold(1.0, f64::min);
    assert!(reach < 0.8, "{reach}");
}

#[test]
fn a_strip_ends_at_triangles_without_parameters() {
    let mut body = furrow(3e-3);
    let middle = |t: &[i32; 3]| t.iter().map(|&v| body.points[v as usize][0]).sum::<f64>().abs() < 0.5;
    for (corner, _) in body.corner.iter_mut().zip(&body.triangles).filter(|(_, t)| middle(t)) {
        *corner = [-1; 3];
    }
    let found = body.traced(false, false).expect("an answer").silhouettes;
    assert!(found.len() > 2 && found.iter().flat_map(|line| &line.points).all(|p| p[0].abs() > 0.1), "{found:?}");
}
