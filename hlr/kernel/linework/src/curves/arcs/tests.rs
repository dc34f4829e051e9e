use super::*;

/// Arcs of many kinds stay within their share of the accuracy when drawn from the written numbers.
#[test]
fn what_is_written_draws_the_arc() {
    let mut pieces = 0;
    for (major, minor) in [(1000.0, 999.0), (300.0, 3.0), (50.0, 50.0), (10.0, 0.02), (3.0, 2.0), (0.06, 0.05)] {
        for turned in [1e-3, 0.1, 1.0, 3.0, PI, 3.2, 6.0, 6.2] {
            for (turn, begin, sign) in [(0.0f64, 0.3, 1.0), (0.7, 2.0, -1.0), (2.5, -1.0, 1.0), (0.0, 0.0, -1.0)] {
                let (s, c) = turn.sin_cos();
                let arc = Arc {
                    centre: [123.4567, -0.98765],
                    axes: [[major * c, major * s], [-minor * s, minor * c]],
                    angles: [begin, begin + sign * turned],
                };
                let ends = arc.angles.map(|t| arc.at(t));
                let mut out = Rows::default();
                rows(&arc, &ends, 3, 0.05, &mut out);
                pieces += out.shapes.len();
                let n = out.shapes.len() as f64;
                for (i, shape) in out.shapes.iter().enumerate() {
                    let [a, b] = [out.points[i], out.points[i + 1]].map(|p| p.map(|c| c as f64 / 1000.0));
                    let angle = |k: f64| begin + sign * turned * k / n;
                    let part = Arc { angles: [angle(i as f64), angle(i as f64 + 1.0)], ..arc };
                    assert!(strays(shape, &a, &b, 1000.0, &part) <= 0.2 * 0.05, "{arc:?} {shape:?}");
                }
            }
        }
    }
    assert!(pieces < 2 * 6 * 8 * 4, "{pieces}");
}

/// Points along what a renderer draws of these rows.
fn rendered(rows: &Rows, scale: f64) -> Vec<Vec2> {
    let at = |i: usize| rows.points[i].map(|c| c as f64 / scale);
    let mut out = vec![at(0)];
    for i in 1..rows.points.len() {
        let shares = (1..=400).map(|k| f64::from(k) / 400.0);
        match rows.op[i] {
            ARC => {
                let shape = &rows.shapes[rows.arc[i] as usize];
                let drawn = Drawn::between(shape, &at(i - 1), &at(i), 1.0 / scale);
                out.extend(drawn.iter().flat_map(|drawn| shares.clone().map(|s| drawn.at(s))));
            }
            CUBIC => {
                let piece: Vec<Vec2> = (i - 3..=i).map(at).collect();
                out.extend(shares.map(|s| crate::fit::bezier::at(&piece, s)));
            }
            _ => {}
        }
    }
    out
}

#[test]
fn a_circle_seen_nearly_edge_on_is_drawn_to_its_ends_and_not_beyond() {
    let (mut arcs, mut cubics) = (0, 0);
    for minor in [0.05, 0.01, 0.002_441_49, 0.001, 1e-4, 1e-6] {
        for begin in [-0.9, -0.02, 0.4, 1.5, 2.9] {
            for turned in [0.991_784, -2.0, 3.0, 5.5] {
                let arc = Arc {
                    centre: [9.230_63, 12.5765],
                    axes: [[9.230_63, 0.0], [0.0, minor]],
                    angles: [begin, begin + turned],
                };
                let mut out = Rows::default();
                rows(&arc, &arc.angles.map(|t| arc.at(t)), 3, 0.01, &mut out);
                arcs += out.op.iter().filter(|op| **op == ARC).count();
                cubics += out.op.iter().filter(|op| **op == CUBIC).count();
                let extent = |points: &[Vec2]| {
                    let along = || points.iter().map(|p| p[0]);
                    [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
                };
                let truth: Vec<Vec2> = (0..=4000).map(|k| arc.at(begin + turned * f64::from(k) / 4000.0)).collect();
                let (drawn, wanted) = (extent(&rendered(&out, 1000.0)), extent(&truth));
                assert!((0..2).all(|k| (drawn[k] - wanted[k]).abs() < 0.003), "{arc:?} {drawn:?} {wanted:?}");
            }
        }
    }
    // Both are needed.
    assert!(arcs > 20 && cubics > 20, "{arcs} {cubics}");
}

#[test]
fn a_radius_rounded_like_a_point_would_stray_near_half_a_turn() {
    let arc = Arc { centre: [0.0; 2], axes: [[10.004_9, 0.0], [0.0, 10.004_9]], angles: [0.0, 3.1] };
    let ends = arc.angles.map(|t| arc.at(t));
    let coarse = Shape { radii: [1_001_000; 2], rotation: 0, large: false, rising: true };
    assert!(strays(&coarse, &ends[0], &ends[1], 1000.0, &arc) > 0.05);
    let mut out = Rows::default();
    rows(&arc, &ends, 2, 0.05, &mut out);
    assert!(out.op.len() > 2 || out.shapes[0] != coarse);
}

#[test]
fn a_full_turn_is_whole() {
    let arc = Arc { centre: [1.0, 2.0], axes: [[3.0, 0.0], [0.0, 2.0]], angles: [0.5, 0.5 + TAU] };
    let mut out = Rows::default();
    rows(&arc, &[arc.at(0.5); 2], 2, 0.05, &mut out);
    assert_eq!((out.op, out.points), (vec![WHOLE], vec![[100, 200]]));
    assert_eq!(out.shapes[0].radii, [30000, 20000]);
}

#[test]
fn cubic_curves_along_a_large_arc() {
    let arc = Arc { centre: [0.0; 2], axes: [[2000.0, 0.0], [0.0, 2000.0]], angles: [0.0, 6.0] };
    let mut out = Rows::default();
    cubic_rows(&arc, &arc.angles.map(|t| arc.at(t)), 4, 0.05, &mut out);
    for w in out.points.windows(4).step_by(3) {
        let piece: Vec<Vec2> = w.iter().map(|p| p.map(|c| c as f64 / 1e4)).collect();
        for i in 0..=10 {
            let p = crate::fit::bezier::at(&piece, f64::from(i) * 0.1);
            assert!((length(&p) - 2000.0).abs() < 0.006);
        }
    }
}
