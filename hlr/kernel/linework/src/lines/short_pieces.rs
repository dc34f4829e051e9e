//! Visible pieces of sunk edges that are too short to leave anything out of the shallow intersection line beside them: what
//! covers less of a line counts as crossing it. They are left out instead.
//!
//! ```text
//!      .-.         short piece of the sunk edge, beside the intersection line: left out
//!   ___________
//!
//!      .-.         short piece of the same part, no such line beside it: stays
//! ```

use super::Polyline;
use super::drawn::Drawn;
use super::gaps::{Side, Widths};
use super::owners::Owners;
use super::stretches::covered;
use hlr_accuracy::COVER_CROSSING;

/// Per line the visible shallow intersection line of its part that runs beside its middle, if the line is such a piece.
pub fn short_pieces(lines: &[Polyline], owners: &[Owners], widths: Widths) -> Vec<Option<u32>> {
    let mut found = vec![None; lines.len()];
    let mut sides = Vec::new();
    let shallow = |i: &usize| lines[*i].visible && owners[*i].shallow;
    for i in (0..lines.len()).filter(shallow) {
        let of_line = lines[i].flat.windows(2).map(|w| (w[0], w[1]));
        sides.extend(of_line.map(|(from, to)| Side {
            visible: true,
            shallow: true,
            line: i as u32,
            from,
            to,
            start: 0.0,
        }));
    }
    let shallow_sides = sides.len() as u32;
    let mut middles = Vec::new();
    for i in short_of_sunk(lines, owners, widths) {
        if let Some((side, middle)) = middle(&lines[i], i as u32) {
            sides.push(side);
            middles.push(middle);
        }
    }
    // Without pieces there is nothing to look for. Where a coordinate is no number, nothing is found.
    let reach = widths.under.max(widths.same);
    let Some(mut drawn) = (!middles.is_empty()).then(|| Drawn::none_of(&sides, reach)).flatten() else { return found };
    (0..shallow_sides).for_each(|side| drawn.add(side));
    for (number, middle) in (shallow_sides..).zip(middles) {
        let piece = &sides[number as usize];
        let of = &owners[piece.line as usize];
        let mut beside: Option<u32> = None;
        drawn.each_near(
            number,
            |_| true,
            |by| {
                let line = &sides[by as usize];
                if of.is_sunk_in(&owners[line.line as usize])
                    && covered(piece, line, widths.under, widths.same).is_some_and(|(a, b)| a <= middle && middle <= b)
                {
                    beside = Some(beside.map_or(line.line, |first| first.min(line.line)));
                }
            },
        );
        found[piece.line as usize] = beside;
    }
    found
}

/// The short visible pieces of the edges of all parts that have a shallow line.
fn short_of_sunk(lines: &[Polyline], owners: &[Owners], widths: Widths) -> Vec<usize> {
    let mut sunk: Vec<i32> = owners.iter().filter(|of| of.shallow).flat_map(|of| of.parts).collect();
    sunk.sort_unstable();
    sunk.dedup();
    let of_sunk = |of: &Owners| !of.shallow && sunk.binary_search(&of.parts[0]).is_ok();
    let short = |line: &Polyline| line.visible && line.length() < COVER_CROSSING * widths.under;
    (0..lines.len()).filter(|&i| of_sunk(&owners[i]) && short(&lines[i])).collect()
}

/// The side of a line that holds its middle, and the parameter of the middle on it.
fn middle(line: &Polyline, number: u32) -> Option<(Side, f64)> {
    let half = 0.5 * line.length();
    let mut start = 0.0;
    line.flat.windows(2).find_map(|w| {
        let side = Side { visible: true, shallow: false, line: number, from: w[0], to: w[1], start };
        let length = side.length();
        start += length;
        (length > 0.0 && start >= half).then(|| (side, (half - (start - length)) / length))
    })
}

#[cfg(test)]
mod tests {
    use super::super::View;
    use super::super::cut::{Trait, ranked};
    use super::*;

    const WIDTHS: Widths = Widths { same: 0.01, under: 0.1 };
    const FOOT: Owners = Owners { parts: [1, -1], shallow: false };
    const STRANGER: Owners = Owners { parts: [7, -1], shallow: false };
    const SHALLOW: Owners = Owners { parts: [0, 1], shallow: true };
    const DEEP: Owners = Owners { parts: [0, 1], shallow: false };

    fn line(points: &[[f64; 2]]) -> Polyline {
        let space = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Polyline { visible: true, flat: points.to_vec(), space, ..Polyline::default() }
    }

    /// The line beside an edge of which line 1, from 0 to 3 along y = 0, is an intersection line.
    fn beside(edge: &Polyline, owners: [Owners; 2]) -> Option<u32> {
        let found = short_pieces(&[edge.clone(), line(&[[0.0, 0.0], [3.0, 0.0]])], &owners, WIDTHS);
        assert_eq!(found[1], None);
        found[0]
    }

    #[test]
    fn short_visible_pieces_of_sunk_edges_give_way() {
        let short = line(&[[2.0, 0.05], [2.5, 0.05]]);
        assert_eq!(beside(&short, [FOOT, SHALLOW]), Some(1));
        assert_eq!(beside(&short, [STRANGER, SHALLOW]), None);
        assert_eq!(beside(&short, [FOOT, DEEP]), None);
        assert_eq!(beside(&line(&[[2.0, 0.05], [2.7, 0.05]]), [FOOT, SHALLOW]), None, "too long");
        assert_eq!(beside(&Polyline { visible: false, ..short }, [FOOT, SHALLOW]), None, "hidden");
    }

    #[test]
    fn pieces_that_no_shallow_line_runs_beside_stay() {
        assert_eq!(beside(&line(&[[2.0, 0.2], [2.5, 0.2]]), [FOOT, SHALLOW]), None, "too far");
        assert_eq!(beside(&line(&[[2.0, -0.25], [2.0, 0.25]]), [FOOT, SHALLOW]), None, "across");
        assert_eq!(beside(&line(&[[2.9, 0.05], [3.3, 0.05]]), [FOOT, SHALLOW]), None, "beyond the end");
        // The middle decides.
        assert_eq!(beside(&line(&[[2.6, 0.05], [2.9, 0.05], [3.1, 0.05]]), [FOOT, SHALLOW]), Some(1));
    }

    #[test]
    fn a_piece_comes_behind_its_line_whatever_the_rank_of_that_is() {
        let piece = Polyline { chain: 1, ..line(&[[2.0, 0.05], [2.5, 0.05]]) };
        let lines = [line(&[[0.0, 0.0], [3.0, 0.0]]), piece];
        let view = View { origin: [0.0; 3], away: [0.0, 0.0, 1.0], perspective: false };
        let order = |shallow: u8, short_pieces: [Option<u32>; 2]| {
            let traits = [shallow, 0].map(|rank| Trait { rank, without_brep: false, noisy: false });
            ranked(&lines, &traits, &short_pieces, &view, 0.01)
        };
        for rank in [2, 10, 26, 250] {
            assert_eq!(order(rank, [None, Some(0)]), [0, 1], "{rank}");
        }
        assert_eq!(order(10, [None, None]), [1, 0]);
    }

    #[test]
    fn a_hidden_line_leaves_nothing_out() {
        let hidden = Polyline { visible: false, ..line(&[[0.0, 0.0], [3.0, 0.0]]) };
        assert_eq!(short_pieces(&[line(&[[2.0, 0.05], [2.5, 0.05]]), hidden], &[FOOT, SHALLOW], WIDTHS), [None, None]);
    }

    #[test]
    fn nothing_is_found_without_numbers() {
        let edge = line(&[[f64::NAN, 0.05], [2.5, 0.05]]);
        assert_eq!(beside(&edge, [FOOT, SHALLOW]), None);
    }
}
