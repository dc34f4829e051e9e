//! Splits a curve so that the image of no piece lies on itself, and decides the direction of each piece.

use hlr_exact::elementary::atan2;
use std::cmp::Ordering;

use super::Model;
use super::refine::Stretch;
use hlr_brep::geometry::vector::{Vector, along, cross, dot, length, sub};

/// Cosine of the angle from straight back within which the image counts as turning back.
const BACK: f64 = 0.7;
/// Radians; a curve that closes after one turn stays whole.
const TURN: f64 = std::f64::consts::TAU;
const SLACK: f64 = 0.2;

/// Whether the image turns back where two stretches meet, so that the two may lie on one another.
pub fn turns_back(model: &Model, a: &Stretch, b: &Stretch) -> bool {
    let sight = model.sight(&b.from);
    let (p, q) = (image(a, &sight), image(b, &sight));
    dot(&p, &q) < -BACK * length(&p) * length(&q)
}

/// A curve whose image winds round more than once may lie on itself: it is cut after every turn.
pub fn unwound<'a>(model: &Model, run: &'a [(i32, Stretch)], closed: bool) -> Vec<&'a [(i32, Stretch)]> {
    let turns: Vec<f64> = run.windows(2).map(|w| turn(model, &w[0].1, &w[1].1)).collect();
    if closed && turns.iter().sum::<f64>().abs() < TURN + SLACK {
        return vec![run];
    }
    let (mut out, mut first, mut total) = (Vec::new(), 0, 0.0f64);
    for (k, turn) in turns.iter().enumerate() {
        total += turn;
        if total.abs() > TURN - SLACK {
            out.push(&run[first..=k]);
            (first, total) = (k + 1, 0.0);
        }
    }
    out.push(&run[first..]);
    out
}

/// The angle between the images of two stretches.
fn turn(model: &Model, a: &Stretch, b: &Stretch) -> f64 {
    let sight = model.sight(&b.from);
    let (p, q) = (image(a, &sight), image(b, &sight));
    atan2(dot(&cross(&p, &q), &sight), dot(&p, &q))
}

fn image(s: &Stretch, sight: &Vector) -> Vector {
    let way = sub(&s.to, &s.from);
    along(&way, sight, -dot(&way, sight))
}

/// The stretches of a curve from its lower end; of a closed curve from its lowest point toward the lower neighbour.
pub fn canonical(run: &[(i32, Stretch)], closed: bool) -> Vec<(i32, Stretch)> {
    let mut out = run.to_vec();
    let last = out.len() - 1;
    let backward = if closed {
        let lowest = (0..=last).min_by(|&i, &j| in_order(&[out[i].1.from], &[out[j].1.from])).unwrap_or(0);
        out.rotate_left(lowest);
        in_order(&[out[last].1.from], &[out[0].1.to]).is_lt()
    } else {
        in_order(&[out[last].1.to], &[out[0].1.from]).is_lt()
    };
    if backward {
        out.reverse();
        out.iter_mut().for_each(|(_, s)| s.turn_round());
    }
    out
}

pub fn in_order(a: &[Vector], b: &[Vector]) -> Ordering {
    let coordinates = a.iter().flatten().zip(b.iter().flatten());
    coordinates.map(|(p, q)| p.total_cmp(q)).find(|o| o.is_ne()).unwrap_or(a.len().cmp(&b.len()))
}
