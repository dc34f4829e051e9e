//! Cleans a triangle mesh: equal corners are joined, impossible triangles are left out.

use rayon::prelude::*;

#[derive(Debug, Default, PartialEq)]
pub struct Clean {
    /// Each used and each once, in order of first use by number.
    pub points: Vec<[f64; 3]>,
    /// Without repeated corners.
    pub triangles: Vec<[i32; 3]>,
    /// Original numbers of the triangles; None where all were kept, in order.
    pub kept: Option<Vec<u32>>,
    pub not_finite: usize,
    pub out_of_range: usize,
    pub degenerate: usize,
}

/// Joins corners with exactly equal coordinates. Drops triangles whose corners do not exist, are not finite or are
/// repeated.
pub fn clean(points: &[[f64; 3]], triangles: &[[i32; 3]]) -> Clean {
    let mut out = Clean::default();
    let inside = |t: &[i32; 3]| t.iter().all(|&v| usize::try_from(v).is_ok_and(|v| v < points.len()));
    let finite = |v: i32| points[v as usize].iter().all(|c| c.is_finite());
    let mut used = vec![false; points.len()];
    for t in triangles {
        if !inside(t) {
            out.out_of_range += 1;
        } else if !t.iter().all(|&v| finite(v)) {
            out.not_finite += 1;
        } else {
            t.iter().for_each(|&v| used[v as usize] = true);
        }
    }
    let (number, kept) = joined(points, &used);
    drop(used);
    out.points = kept.into_par_iter().map(|v| plain(&points[v as usize])).collect();
    let sound = |t: &[i32; 3]| inside(t) && t.iter().all(|&v| finite(v));
    let whole = |t: &[i32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    let mut kept = Vec::new();
    let every = out.out_of_range + out.not_finite == 0;
    out.triangles = triangles.par_iter().filter(|t| every || sound(t)).map(|t| t.map(|v| number[v as usize])).collect();
    out.degenerate = out.triangles.par_iter().filter(|t| !whole(t)).count();
    if !every || out.degenerate > 0 {
        let is_kept = |t: &[i32; 3]| (every || sound(t)) && whole(&t.map(|v| number[v as usize]));
        kept.extend(triangles.iter().enumerate().filter(|(_, t)| is_kept(t)).map(|(k, _)| k as u32));
        out.triangles.retain(whole);
        out.kept = Some(kept);
    }
    out
}

/// Turns minus zero into zero: equal numbers then have equal bits.
fn plain(p: &[f64; 3]) -> [f64; 3] {
    p.map(|c| c + 0.0)
}

/// Returns the new number of every used point, and the first of each set of equal points, in order.
fn joined(points: &[[f64; 3]], used: &[bool]) -> (Vec<i32>, Vec<u32>) {
    let bits = |v: u32| plain(&points[v as usize]).map(f64::to_bits);
    // One 64-bit hash sorts several times faster than three columns.
    let mut keys: Vec<(u64, u32)> =
        (0..points.len() as u32).into_par_iter().filter(|&v| used[v as usize]).map(|v| (mixed(bits(v)), v)).collect();
    keys.par_sort_unstable();
    let mut number: Vec<i32> = vec![-1; points.len()];
    // A point that equals an earlier point v first gets the number -2 - v.
    for run in keys.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1) {
        let mut run: Vec<([u64; 3], u32)> = run.iter().map(|&(_, v)| (bits(v), v)).collect();
        run.sort_unstable();
        for same in run.chunk_by(|a, b| a.0 == b.0) {
            same[1..].iter().for_each(|&(_, v)| number[v as usize] = -2 - same[0].1 as i32);
        }
    }
    drop(keys);
    let mut first = Vec::with_capacity(points.len());
    for v in (0..points.len()).filter(|&v| used[v]) {
        number[v] = if number[v] <= -2 {
            number[(-2 - number[v]) as usize]
        } else {
            first.push(v as u32);
            first.len() as i32 - 1
        };
    }
    (number, first)
}

fn mixed(bits: [u64; 3]) -> u64 {
    let mut mixed = bits[0].wrapping_mul(0x9E37_79B9_7F4A_7C15);
    mixed ^= mixed >> 29;
    mixed = mixed.wrapping_add(bits[1]).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    mixed ^= mixed >> 32;
    mixed = mixed.wrapping_add(bits[2]).wrapping_mul(0x94D0_49BB_1331_11EB);
    mixed ^ (mixed >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_joined_by_equality_alone() {
        let tiny = 1.0f64.next_up();
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-0.0, 0.0, 0.0],
            [tiny, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [7.0, 7.0, 7.0],
            [f64::NAN, 0.0, 0.0],
        ];
        let found = clean(&points, &[[0, 1, 2], [3, 4, 5], [0, 3, 1], [0, 1, 7], [0, 1, 99], [0, -1, 1]]);
        assert_eq!(found.points, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [tiny, 0.0, 0.0]]);
        assert_eq!((found.triangles, found.kept), (vec![[0, 1, 2], [0, 3, 2]], Some(vec![0, 1])));
        assert_eq!((found.degenerate, found.not_finite, found.out_of_range), (1, 1, 2));
    }

    #[test]
    fn what_is_clean_stays() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let found = clean(&points, &[[2, 0, 1]]);
        assert_eq!((found.points, found.triangles, found.kept), (points.to_vec(), vec![[2, 0, 1]], None));
        assert_eq!(clean(&[], &[]), Clean::default());
    }
}
