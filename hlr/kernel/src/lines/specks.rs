//! Drop what is shorter than the accuracy even together with everything it connects to.
//!
//! An edge shorter than the accuracy may be one of a thousand that make up a long profile, so length is measured over
//! whole connected figures: lines of one visibility whose ends meet.

use std::collections::HashMap;

use super::Polyline;

pub fn drop_specks(lines: &mut Vec<Polyline>, shortest: f64) {
    let mut group: Vec<usize> = (0..lines.len()).collect();
    fn root(group: &mut [usize], mut i: usize) -> usize {
        while group[i] != i {
            group[i] = group[group[i]];
            i = group[i];
        }
        i
    }
    let mut at: HashMap<(bool, u64, u64), usize> = HashMap::new();
    for (i, line) in lines.iter().enumerate() {
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
    let mut r = roots.iter();
    lines.retain(|_| r.next().is_none_or(|&r| total[r] >= shortest));
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
}
