//! Finds chords of a border that cross or touch each other, by exact signs. Used only where meshing a face has failed.

use super::face::FaceLoops;
use super::outline::Outline;
use super::plane::{distance2, side};

/// Limit on the pairs that are listed: more of them would add no information.
const MOST: usize = 1000;

/// Pairs of chords that share more than end points. A chord is given by the point at which it begins.
pub fn crossings(outline: &Outline) -> Vec<[u32; 2]> {
    let ends = |c: u32| [outline.uv[c as usize], outline.uv[outline.after(c) as usize]];
    let range = |c: u32, k: usize| {
        let [a, b] = ends(c);
        (a[k].min(b[k]), a[k].max(b[k]))
    };
    let mut order: Vec<u32> = outline.chords().collect();
    order.sort_by(|&a, &b| range(a, 0).0.total_cmp(&range(b, 0).0).then(a.cmp(&b)));
    let mut found = Vec::new();
    for (k, &one) in order.iter().enumerate() {
        let (right, (low, high)) = (range(one, 0).1, range(one, 1));
        for &other in order[k + 1..].iter().take_while(|&&c| range(c, 0).0 <= right) {
            let (from, to) = range(other, 1);
            if from <= high && to >= low && meet(ends(one), ends(other)) {
                found.push([one.min(other), one.max(other)]);
                if found.len() == MOST {
                    return found;
                }
            }
        }
    }
    found.sort_unstable();
    found
}

/// Share of the loops' extent within which chords lie upon one another.
const UPON: f64 = 1e-9;

/// Which of the pairs (loop, chord, loop, chord) lie upon one another, with two of their ends at least.
pub fn upon_one_another(loops: &FaceLoops, pairs: &[[usize; 4]]) -> Vec<bool> {
    let size = [0, 1].map(|k| {
        let all = loops.loops.iter().flatten().map(|p| p.uv[k]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    });
    let ends = |l: usize, c: usize| {
        let points = loops.loops.get(l).filter(|points| c < points.len())?;
        Some([c, (c + 1) % points.len()].map(|i| [0, 1].map(|k| points[i].uv[k] / size[k])))
    };
    let near = |p: &[f64; 2], [a, b]: &[[f64; 2]; 2]| distance2(p, a, b) <= UPON * UPON;
    let upon = |&[l, c, m, d]: &[usize; 4]| {
        let (Some(one), Some(other)) = (ends(l, c), ends(m, d)) else { return false };
        let (of_one, of_other) = (one.iter().filter(|p| near(p, &other)), other.iter().filter(|p| near(p, &one)));
        of_one.count() + of_other.count() >= 2
    };
    pairs.iter().map(upon).collect()
}

/// Whether two chords with overlapping boxes share a point that is not an end of both. The two sides of a slit, which
/// are the same chord in both senses, do not count.
fn meet([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    if (a == d && b == c) || (a == c && b == d) {
        return a == c;
    }
    let of = |p: &[f64; 2]| side(&a, &b, p);
    let to = |p: &[f64; 2]| side(&c, &d, p);
    let (s, t, u, v) = (of(&c), of(&d), to(&a), to(&b));
    if s == 0.0 && t == 0.0 {
        // On one line: whether an end of one lies strictly between the ends of the other.
        let k = usize::from((b[0] - a[0]).abs() < (b[1] - a[1]).abs());
        let between = |x: f64, e: f64, f: f64| (e < x && x < f) || (f < x && x < e);
        return between(c[k], a[k], b[k])
            || between(d[k], a[k], b[k])
            || between(a[k], c[k], d[k])
            || between(b[k], c[k], d[k]);
    }
    let shared = a == c || a == d || b == c || b == d;
    !shared && s * t <= 0.0 && u * v <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_touches_at_its_ends_does_not_meet() {
        let (o, x, y) = ([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]);
        assert!(!meet([o, x], [x, y]));
        assert!(!meet([o, x], [x, o]));
        assert!(meet([o, x], [o, x]));
        assert!(!meet([o, x], [x, [2.0, 0.0]]));
        assert!(meet([o, x], [[0.5, 0.0], [2.0, 0.0]]));
        assert!(meet([o, x], [[0.5, 0.0], y]));
        assert!(meet([o, x], [[0.5, -1.0], [0.4, 1.0]]));
        assert!(!meet([o, x], [[1.5, -1.0], [1.4, 1.0]]));
    }
    #[test]
    fn chords_upon_one_another_share_two_ends_at_least() {
        use crate::mesh::LoopPoint;
        let chord =
            |[a, b]: [[f64; 2]; 2]| [a, b].map(|uv| LoopPoint { uv, point: [uv[0], uv[1], 0.0], node: 0 }).to_vec();
        let places = [
            [[0.0, 0.0], [4.0, 0.0]],
            [[4.0, 0.0], [0.0, 0.0]],
            [[3.0, 0.0], [9.0, 0.0]],
            [[1.0, 0.0], [1.0, 5.0]],
            [[0.0, 1e-6], [4.0, -1e-6]],
        ];
        let loops = FaceLoops { loops: places.map(chord).to_vec(), periods: [0.0; 2] };
        let pairs = [[0, 0, 1, 0], [0, 0, 2, 0], [0, 0, 3, 0], [0, 0, 4, 0], [0, 0, 9, 0]];
        assert_eq!(upon_one_another(&loops, &pairs), [true, true, false, false, false]);
    }
}
