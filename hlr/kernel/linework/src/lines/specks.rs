//! Drops figures that are shorter than the accuracy, even together with everything they connect to.
//!
//! An edge shorter than the accuracy may be one of a thousand that make up a long profile, so length is measured over
//! whole connected figures: lines of one visibility whose ends meet.
//!
//! Edges seen almost end-on appear as dots at longer lines. Those shorter than a quarter of the accuracy are dropped
//! even where they meet other lines, unless many of them in a row make up something longer.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::Polyline;
use hlr_accuracy::SPECK_DOT;
use hlr_brep::sets::Sets;

pub fn drop_specks(lines: &mut Vec<Polyline>, shortest: f64) {
    drop_dots(lines, SPECK_DOT * shortest);
    drop_figures(lines, shortest);
}

/// Drops lines shorter than `shortest`, unless together with others so short that they meet they are longer.
fn drop_dots(lines: &mut Vec<Polyline>, shortest: f64) {
    let lengths: Vec<f64> = lines.par_iter().map(Polyline::length).collect();
    let short: Vec<usize> = (0..lines.len()).filter(|&i| lengths[i] < shortest).collect();
    let Figures { total, .. } = Figures::of(lines, &short, &lengths);
    drop_all(lines, short.iter().zip(total).filter(|&(_, total)| total < shortest).map(|(&i, _)| i));
}

/// Drops lines shorter than `shortest` with all they connect to, where that is shorter in all.
fn drop_figures(lines: &mut Vec<Polyline>, shortest: f64) {
    let lengths: Vec<f64> = lines.par_iter().map(Polyline::length).collect();
    let is_short = |i: usize| lengths[i] < shortest;
    let short: Vec<usize> = (0..lines.len()).filter(|&i| is_short(i)).collect();
    if short.is_empty() {
        return;
    }
    let Figures { total, figure, at } = Figures::of(lines, &short, &lengths);
    // A figure that a longer line meets is long enough.
    let mut long = vec![false; short.len()];
    for line in (0..lines.len()).filter(|&i| !is_short(i)).map(|i| &lines[i]) {
        ends(line).iter().filter_map(|end| at.get(end)).for_each(|&k| long[figure[k]] = true);
    }
    let gone = |k: usize| total[k] < shortest && !long[figure[k]];
    drop_all(lines, (0..short.len()).filter(|&k| gone(k)).map(|k| short[k]));
}

/// Removes lines, by their numbers in ascending order.
fn drop_all(lines: &mut Vec<Polyline>, gone: impl Iterator<Item = usize>) {
    let (mut gone, mut i) = (gone.peekable(), 0..);
    if gone.peek().is_some() {
        lines.retain(|_| {
            let i = i.next();
            gone.next_if(|&g| Some(g) == i).is_none()
        });
    }
}

/// An end of a line: its visibility and the place on paper.
type End = (bool, u64, u64);

fn ends(line: &Polyline) -> [End; 2] {
    [0, line.flat.len() - 1].map(|k| {
        let [x, y] = line.flat[k].map(|c| (c + 0.0).to_bits());
        (line.visible, x, y)
    })
}

/// How some of the lines hang together.
struct Figures {
    /// Per chosen line the length of its figure.
    total: Vec<f64>,
    /// Per chosen line the first of its figure, as a number among the chosen ones.
    figure: Vec<usize>,
    /// The first chosen line that ends at a place.
    at: FxHashMap<End, usize>,
}

impl Figures {
    /// The figures that the chosen lines make up; lengths: of all lines.
    fn of(lines: &[Polyline], chosen: &[usize], lengths: &[f64]) -> Figures {
        let mut sets = Sets::new(chosen.len());
        let mut at = FxHashMap::default();
        for (k, &i) in chosen.iter().enumerate() {
            for end in ends(&lines[i]) {
                let other = *at.entry(end).or_insert(k);
                sets.unite(k, other);
            }
        }
        let figure: Vec<usize> = (0..chosen.len()).map(|k| sets.first(k)).collect();
        let mut sum = vec![0.0; chosen.len()];
        for (&f, &i) in figure.iter().zip(chosen) {
            sum[f] += lengths[i];
        }
        Figures { total: figure.iter().map(|&f| sum[f]).collect(), figure, at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_pieces_of_a_long_profile_stay() {
        let piece = |x: f64| Polyline {
            visible: true,
            flat: vec![[x, 0.0], [x + 0.5, 0.0]],
            space: vec![[0.0; 3]; 2],
            ..Polyline::default()
        };
        let mut lines = vec![piece(0.0), piece(0.5), piece(1.0), piece(9.0)];
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 3);
    }

    #[test]
    fn a_dot_at_the_end_of_a_line_goes_and_a_row_of_dots_stays() {
        let piece = |x: f64, length: f64| Polyline {
            visible: true,
            flat: vec![[x, 0.0], [x + length, 0.0]],
            space: vec![[0.0; 3]; 2],
            ..Polyline::default()
        };
        let mut lines = vec![piece(0.0, 8.0), piece(8.0, 0.0625)];
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 1);
        let mut lines: Vec<Polyline> = (0..32).map(|i| piece(f64::from(i) * 0.0625, 0.0625)).collect();
        drop_specks(&mut lines, 1.0);
        assert_eq!(lines.len(), 32);
    }
}
