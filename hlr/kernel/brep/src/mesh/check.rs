//! Proves that the triangles of a face fill its loops in the parameter plane, once and without overlap.

use rustc_hash::FxHashSet;

use super::outline::Outline;
use super::plane::area;

/// Largest rounding error of a zero area, as a share of the largest parameter times the triangle's width plus height.
const ROUNDING: f64 = 4e-15;

/// The result of the proof that triangles fill what the loops enclose.
pub struct Proof {
    /// Whether each chord has its triangle to the left, as it should have.
    pub in_sense: bool,
}

/// Proves that each chord has one triangle beside it, that every other edge has two triangles that run along it in
/// opposite senses, and that no triangle is turned over. The triangles then fill exactly what the loops enclose in
/// (u, v), by the even-odd rule, whatever the sense of a loop.
///
/// `uv`: parameters of all vertices. `stand_in`: for each point of the outline the point that the triangles use in its
/// place.
pub fn proof(outline: &Outline, uv: &[[f64; 2]], stand_in: &[u32], triangles: &[[u32; 3]]) -> Option<Proof> {
    let [low, high] = outline.bounds();
    let size = low.iter().chain(&high).fold(0.0f64, |m, x| m.max(x.abs()));
    let upright = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| uv[i as usize]);
        let spread: f64 = [0, 1].iter().map(|&k| a[k].max(b[k]).max(c[k]) - a[k].min(b[k]).min(c[k])).sum();
        area(&a, &b, &c) >= -ROUNDING * size * spread
    };
    if triangles.iter().all(upright) { filled(outline, uv.len(), stand_in, triangles) } else { None }
}

fn filled(outline: &Outline, count: usize, stand_in: &[u32], triangles: &[[u32; 3]]) -> Option<Proof> {
    let chords = outline.chords().map(|c| [c, outline.after(c)].map(|p| stand_in[p as usize]));
    let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    // A counting sort by the lower end, then a sort by the upper end within each.
    let mut first = vec![0u32; count + 1];
    for [a, b] in edges.clone().chain(chords.clone()) {
        first[a.min(b) as usize + 1] += 1;
    }
    for i in 0..count {
        first[i + 1] += first[i];
    }
    let mut next = first.clone();
    let mut sorted = vec![(0u32, 0u8); first[count] as usize];
    let mut put = |[a, b]: [u32; 2], chord: u8| {
        let place = &mut next[a.min(b) as usize];
        sorted[*place as usize] = (a.max(b), 2 * chord + u8::from(a < b));
        *place += 1;
    };
    edges.for_each(|e| put(e, 0));
    chords.for_each(|e| put(e, 1));
    let mut in_sense = true;
    let sound = first.windows(2).all(|w| {
        let part = &mut sorted[w[0] as usize..w[1] as usize];
        part.sort_unstable();
        // Kinds: 0, 1 triangles in either sense; 2, 3 chords in either sense. A chord may occur in both senses: a slit,
        // or a face without area.
        part.chunk_by(|a, b| a.0 == b.0).all(|group| {
            in_sense &= !matches!(group, [(_, 0), (_, 3)] | [(_, 1), (_, 2)]);
            matches!(
                group,
                [(_, 0), (_, 1)] | [(_, 0 | 1), (_, 2 | 3)] | [(_, 0), (_, 1), (_, 2), (_, 3)] | [(_, 2), (_, 3)]
            )
        })
    });
    sound.then_some(Proof { in_sense })
}

/// Numbers of the loops that have a triangle to the right of one of their chords.
pub fn turned(outline: &Outline, stand_in: &[u32], triangles: &[[u32; 3]]) -> Vec<usize> {
    let edges: FxHashSet<[u32; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let against = |c: &u32| {
        let [a, b] = [*c, outline.after(*c)].map(|p| stand_in[p as usize]);
        !edges.contains(&[a, b]) && edges.contains(&[b, a])
    };
    let mut found: Vec<usize> =
        outline.chords().filter(against).filter_map(|c| Some(outline.origin.get(c as usize)?.0)).collect();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceLoops, LoopPoint};

    /// A square, or a square with a square hole.
    fn outline(hole: bool) -> Outline {
        let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
        let mut loops = vec![square(0.0, 4.0).to_vec()];
        if hole {
            loops.push(square(1.0, 3.0).into_iter().rev().collect());
        }
        let mut node = 0;
        let mut point = |uv: [f64; 2]| {
            node += 1;
            LoopPoint { uv, point: [uv[0], uv[1], 0.0], node }
        };
        let loops = loops.into_iter().map(|l| l.into_iter().map(&mut point).collect()).collect();
        Outline::new(&FaceLoops { loops, periods: [0.0; 2] }, |_, _, _| {}).unwrap()
    }

    fn sound(outline: &Outline, triangles: &[[u32; 3]]) -> bool {
        let same: Vec<u32> = (0..outline.uv.len() as u32).collect();
        proof(outline, &outline.uv, &same, triangles).is_some()
    }

    #[test]
    fn a_lost_turned_doubled_or_foreign_triangle_is_found() {
        // Around the hole, whose corners are 4 upper left, 5 upper right, 6 lower right, 7 lower left.
        let ring = [[0, 1, 7], [1, 6, 7], [1, 2, 6], [2, 5, 6], [2, 3, 5], [3, 4, 5], [3, 0, 4], [0, 7, 4]];
        for (outline, whole) in [(outline(false), &[[0u32, 1, 2], [0, 2, 3]][..]), (outline(true), &ring[..])] {
            assert!(sound(&outline, whole));
            for k in 0..whole.len() {
                let mut fewer = whole.to_vec();
                let [a, b, c] = fewer.remove(k);
                assert!(!sound(&outline, &fewer), "without {k}");
                assert!(!sound(&outline, &[&fewer[..], &[[a, c, b]]].concat()), "{k} turned");
                assert!(!sound(&outline, &[whole, &[[a, b, c]]].concat()), "{k} twice");
                assert!(!sound(&outline, &[whole, &[[a, b, c], [a, c, b]]].concat()), "{k} and a fold");
            }
            assert!(!sound(&outline, &[]));
        }
        // With the hole filled as well.
        assert!(!sound(&outline(true), &[&ring[..], &[[4, 7, 6], [4, 6, 5]]].concat()));
    }
}
