//! The point nearest to a given one that lies on several surfaces at once.
//!
//! Each surface is replaced by its tangent plane at the foot of the point. Two planes have a line in common, and the
//! point moves to the nearest place of it, square to the line; three have one point. Repeated, this is Newton's method.

use super::face::{Face, Foot};
use hlr_accuracy::{INTERSECTION_MET, INTERSECTION_MOVE};
use hlr_brep::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub};

/// A face, and parameters near a point.
pub struct Near<'a> {
    pub face: Face<'a>,
    pub uv: [f64; 2],
}

/// Sine of the angle between two surfaces below which their common line is not told. A dome that stands an accuracy out
/// of a plate meets it at more, up to a radius of four metres on paper.
pub const NEARLY_TANGENT: f64 = 0.005;
/// Volume between three unit normals below which two of them count as one, as of faces that join smoothly.
const SMOOTHLY_JOINED: f64 = 0.02;
const STEPS: usize = 20;
/// Two points this near, as a share of their distance from the origin, are one.
const ROUNDING: f64 = 1e-13;

/// How many tangent planes a step goes to.
#[derive(Clone, Copy, PartialEq)]
enum Planes {
    Two,
    Three,
}

/// The point on all faces that is nearest to `start`, and changes `uv` of each to the parameters there. None for a single
/// face, where surfaces are nearly tangent, or where the way is longer than chord errors explain.
///
/// Where faces that join smoothly have no such point, it is one on two faces, and within the deflection of the others.
pub fn common(near: &mut [Near], start: &Vector, deflection: f64) -> Option<Vector> {
    if near.len() < 2 {
        return None;
    }
    let before: Vec<[f64; 2]> = near.iter().map(|n| n.uv).collect();
    search(near, start, deflection, Planes::Three).or_else(|| {
        near.iter_mut().zip(before).for_each(|(n, uv)| n.uv = uv);
        (near.len() > 2).then(|| search(near, start, deflection, Planes::Two)).flatten()
    })
}

fn search(near: &mut [Near], start: &Vector, deflection: f64, planes: Planes) -> Option<Vector> {
    let mut p = *start;
    for _ in 0..STEPS {
        let feet = near.iter().map(|n| n.face.foot(&p, n.uv)).collect::<Option<Vec<Foot>>>()?;
        near.iter_mut().zip(&feet).for_each(|(n, foot)| n.uv = foot.uv);
        let (step, certain) = step(&feet, &p, planes)?;
        p = add(&p, &step);
        if length(&sub(&p, start)) > INTERSECTION_MOVE * deflection / certain {
            return None;
        }
        if length(&step) <= ROUNDING * (1.0 + length(&p)) {
            break;
        }
    }
    let away = |n: &Near| n.face.foot(&p, n.uv).map(|foot| length(&sub(&foot.point, &p)) / deflection);
    let mut off = near.iter().map(away).collect::<Option<Vec<f64>>>()?;
    off.sort_by(f64::total_cmp);
    let met = if planes == Planes::Two { 2 } else { off.len() };
    (off[met - 1] <= INTERSECTION_MET && off[off.len() - 1] <= 1.0).then_some(p)
}

/// The step to the common place of the tangent planes, and how certain it is: the volume between three normals, or the
/// sine of the angle between two.
fn step(feet: &[Foot], p: &Vector, planes: Planes) -> Option<(Vector, f64)> {
    let height = |i: usize| dot(&feet[i].normal, &sub(&feet[i].point, p));
    let pairs = (0..feet.len()).flat_map(|i| (i + 1..feet.len()).map(move |j| [i, j]));
    let mut three = (SMOOTHLY_JOINED, None);
    let mut two = (NEARLY_TANGENT, None);
    for [i, j] in pairs {
        let upright = cross(&feet[i].normal, &feet[j].normal);
        if length(&upright) > two.0 {
            two = (length(&upright), Some([i, j]));
        }
        for (k, foot) in feet.iter().enumerate().skip(j + 1) {
            let volume = dot(&upright, &foot.normal).abs();
            if planes == Planes::Three && volume > three.0 {
                three = (volume, Some([i, j, k]));
            }
        }
    }
    if let (volume, Some(of)) = three {
        let [a, b, c] = of.map(|i| feet[i].normal);
        let [x, y, z] = of.map(height);
        let sum = add(&add(&scaled(&cross(&b, &c), x), &scaled(&cross(&c, &a), y)), &scaled(&cross(&a, &b), z));
        return Some((scaled(&sum, 1.0 / dot(&cross(&a, &b), &c)), volume));
    }
    let (sine, of) = two;
    let of = of?;
    let [a, b] = of.map(|i| feet[i].normal);
    let [x, y] = of.map(height);
    let (cosine, square) = (dot(&a, &b), sine * sine);
    let share = [(x - cosine * y) / square, (y - cosine * x) / square];
    Some((along(&scaled(&a, share[0]), &b, share[1]), sine))
}
