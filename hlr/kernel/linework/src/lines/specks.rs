//! Drops figures that are shorter than the accuracy, even together with everything they connect to.
//!
//! An edge shorter than the accuracy may be one of a thousand that make up a long profile, so length is measured over
//! whole connected figures: lines of one visibility whose ends meet.
//!
//! Edges seen almost end-on appear as dots at longer lines. Those shorter than a quarter of the accuracy are dropped
//! even where they meet other lines, unless many of them in a row make up something longer.

use std::collections::HashMap;

use super::Polyline;
use hlr_accuracy::SPECK_DOT;

pub fn drop_specks(lines: &mut Vec<Polyline>, shortest: f64) {
    drop_small(lines, |line| line.length() < SPECK_DOT * shortest, SPECK_DOT * shortest);
    drop_small(lines, |_| true, shortest);
}

/// Drops figures shorter than `shortest` made of `chosen` lines, even where they meet lines that are not chosen.
fn drop_small(lines: &mut Vec<Polyline>, chosen: impl Fn(&Polyline) -> bool, shortest: f64) {
    let chosen: Vec<bool> = lines.iter().map(chosen).collect();
    let mut group: Vec<usize> = (0..lines.len()).collect();
    fn root(group: &mut [usize], mut i: usize) -> usize {
        while group[i] != i {
            group[i] = group[group[i]];
            i = group[i];
        }
        i
    }
    let mut at: HashMap<(bool, u64, u64), usize> = HashMap::new();
    for (i, line) in lines.iter().enumerate().filter(|(i, _)| chosen[*i]) {
        for end in [&line.flat[0], &line.flat[line.flat.len() - 1]] {
            let key = (line.visible, (end[0] + 0.0).to_bits(), (end[1] + 0.0).to_bits());
            let other = *at.entry(key).or_insert(i);
            let (a, b) = (root(&mut group, i), root(&mut group, other));
            group[a.max(b)] = a.min(b);
        }
    }
    let mut total = vec![0.0; lines.len()];
    let roots: Vec<usize> = (0..lines.len()).map(|i| root(&mut group, i)).collect();
    for (line, &r) in lines.iter().zip(&roots) {
        total[r] += line.length();
    }
    let mut i = 0..lines.len();
    lines.retain(|_| i.next().is_none_or(|i| !chosen[i] || total[roots[i]] >= shortest));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_pieces_of_a_long_profile_stay() {
        let piece = |x: f64| Polyline {
            chain: 0,
            visible: true,
            flat: vec![[x, 0.0], [x + 0.5, 0.0]],
            space: vec![[0.0; 3]; 2],
        };
        let mut lines = vec![piece(0.0), piece(0.5), piece(1.0), piece(9.0)];
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 3);
    }

    #[test]
    fn a_dot_at_the_end_of_a_line_goes_and_a_row_of_dots_stays() {
        let piece = |x: f64, length: f64| Polyline {
            chain: 0,
            visible: true,
            flat: vec![[x, 0.0], [x + length, 0.0]],
            space: vec![[0.0; 3]; 2],
        };
        let mut lines = vec![piece(0.0, 8.0), piece(8.0, 0.0625)];
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 1);
        let mut lines: Vec<Polyline> = (0..32).map(|i| piece(f64::from(i) * 0.0625, 0.0625)).collect();
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 32);
    }
}
