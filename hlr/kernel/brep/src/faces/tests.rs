use super::*;
use crate::edges::{Polyline, polyline};
use crate::model::Model;

const CYLINDER: &[u8] = include_bytes!("../../tests/cylinder_4.bin");

fn lines(model: &Model) -> Vec<Option<Polyline>> {
    model.edges.iter().map(|edge| polyline(model, edge, 0.01, 0.5)).collect()
}

fn area(border: &Border) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| 0.5 * (a[0] * b[1] - a[1] * b[0]);
    let of_loop = |l: &Vec<crate::mesh::LoopPoint>| -> f64 {
        (0..l.len()).map(|i| cross(l[i].uv, l[(i + 1) % l.len()].uv)).sum()
    };
    border.loops.loops.iter().map(of_loop).sum()
}

#[test]
fn the_side_of_a_cylinder_runs_up_one_side_of_its_seam_and_down_the_other() {
    let model = Model::read(CYLINDER, None).unwrap();
    let lines = lines(&model);
    let borders: Vec<Border> = model.faces.iter().map(|face| border(&model, face, &lines, 0.01).unwrap()).collect();
    assert_eq!(model.faces.len(), 3);
    let side = &borders[0];
    assert_eq!(side.loops.loops.len(), 1);
    assert!((area(side) - 2.0 * std::f64::consts::TAU).abs() < 1e-9);
    // Two circles and the seam: each point has one node, on both sides of the seam.
    let circle = lines.iter().flatten().map(|l| l.points.len()).max().unwrap() - 1;
    assert_eq!((side.loops.loops[0].len(), side.nodes.len()), (2 * circle + 2, 2 * circle));
    // The lids are planes, so the surface at their parameters must be the points themselves.
    for lid in &borders[1..] {
        assert!(area(lid) > 3.0 && area(lid) < std::f64::consts::PI);
        assert!(lid.nodes.iter().all(|node| side.nodes.contains(node)));
    }
}

#[test]
fn no_byte_of_damage_does_more_than_a_fault() {
    for at in 0..CYLINDER.len() {
        for flip in [1u8, 0xff] {
            let mut changed = CYLINDER.to_vec();
            changed[at] ^= flip;
            let Ok(model) = Model::read(&changed, None) else { continue };
            let lines = lines(&model);
            for face in &model.faces {
                let _ = border(&model, face, &lines, 0.01);
            }
        }
    }
}
