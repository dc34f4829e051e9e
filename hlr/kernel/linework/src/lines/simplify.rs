//! Leaves out vertices that are closer than a tolerance to the line, on paper and in space, after Douglas and Peucker.
//! (D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points required to represent a digitized
//! line", 1973.) In space too: a line that is straight on paper may still bend along the line of sight.

use super::Polyline;

/// Distance to a segment.
pub fn off<const N: usize>(p: &[f64; N], a: &[f64; N], b: &[f64; N]) -> f64 {
    let (mut ab2, mut ap_ab) = (0.0, 0.0);
    for k in 0..N {
        ab2 += (b[k] - a[k]) * (b[k] - a[k]);
        ap_ab += (p[k] - a[k]) * (b[k] - a[k]);
    }
    let t = if ab2 > 0.0 { (ap_ab / ab2).clamp(0.0, 1.0) } else { 0.0 };
    let mut d2 = 0.0;
    for k in 0..N {
        let d = p[k] - (a[k] + (b[k] - a[k]) * t);
        d2 += d * d;
    }
    d2.sqrt()
}

/// Simplifies one line. `wanted`: vertices that must stay.
pub fn simplify(line: &mut Polyline, wanted: &[usize], flat_tolerance: f64, space_tolerance: f64) {
    let n = line.flat.len();
    if n < 3 {
        return;
    }
    let mut keep = vec![false; n];
    wanted.iter().for_each(|&i| keep[i] = true);
    keep[0] = true;
    keep[n - 1] = true;
    if line.flat[0] == line.flat[n - 1] {
        // A closed line has no chord: split it at the middle first.
        keep[n / 2] = true;
    }
    let stops: Vec<usize> = (0..n).filter(|&i| keep[i]).collect();
    let mut stack: Vec<(usize, usize)> = stops.windows(2).map(|w| (w[0], w[1])).collect();
    while let Some((a, b)) = stack.pop() {
        let mut worst = (1.0, 0);
        for i in a + 1..b {
            let flat = off(&line.flat[i], &line.flat[a], &line.flat[b]) / flat_tolerance;
            let space = off(&line.space[i], &line.space[a], &line.space[b]) / space_tolerance;
            let error = flat.max(space);
            if error > worst.0 {
                worst = (error, i);
            }
        }
        if worst.1 > 0 {
            keep[worst.1] = true;
            stack.push((a, worst.1));
            stack.push((worst.1, b));
        }
    }
    let mut k = keep.iter();
    line.flat.retain(|_| *k.next().unwrap_or(&true));
    let mut k = keep.iter();
    line.space.retain(|_| *k.next().unwrap_or(&true));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_what_bends_on_paper_or_in_depth() {
        let flat = vec![[0.0, 0.0], [1.0, 0.001], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0]];
        let space = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 1.0], [4.0, 0.0, 0.0]];
        let mut line = Polyline { visible: true, flat, space, ..Polyline::default() };
        let mut pinned = line.clone();
        simplify(&mut line, &[], 0.01, 0.01);
        assert_eq!(line.flat, [[0.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0]]);
        simplify(&mut pinned, &[1], 0.01, 0.01);
        assert_eq!(pinned.flat.len(), 5);
    }
}
