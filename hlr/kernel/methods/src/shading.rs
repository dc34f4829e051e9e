//! Interpolates values along spans: colours (Gouraud 1971) or normals (Phong 1975), first along the edges, then along
//! the row.
//!
//! The textbook interpolates on the screen, where equal steps are not equal steps on the surface, so in perspective the
//! far half of a polygon gets too small a share. Value / w and 1 / w are linear on the screen, so their quotient is
//! right (Blinn 1992). Either way a linear quantity takes one addition per row along an edge (`edge_record`), and one
//! per pixel between two edges.
//!
//! ```text
//!        1 +                row y: left = between 1 and 3, right = between 1 and 2, then from left to right
//!         / \
//!    left/---\right         textbook: of the values;  correct: of value / w and of 1 / w
//!       /     \
//!    3 +-------+ 2
//! ```

use super::active_edges::ActiveEdges;
use super::edge_record::{Active, Colour};
use super::edge_table::EdgeTable;
use super::limits::Watch;
use super::screen::{NONE, Screen};
use super::statistics::Statistics;

/// Per pixel of `frame`, the value at its centre; NaN for the background. None where time ran out.
pub fn shade(screen: &Screen, frame: &[u32], correct: bool, watch: &Watch) -> Option<Vec<[f64; 3]>> {
    if correct { rows::<true>(screen, frame, watch) } else { rows::<false>(screen, frame, watch) }
}

fn rows<const CORRECT: bool>(screen: &Screen, frame: &[u32], watch: &Watch) -> Option<Vec<[f64; 3]>> {
    let width = screen.width as usize;
    let mut out = vec![[f64::NAN; 3]; frame.len()];
    let mut visible = vec![false; screen.facets.len()];
    frame.iter().filter(|&&f| f != NONE).for_each(|&f| visible[f as usize] = true);
    let table = EdgeTable::of(screen, |f| visible[f as usize], watch)?;
    let mut active = ActiveEdges::<Colour<CORRECT>>::new(screen, &table);
    let mut order: Vec<u32> = Vec::new();
    while let Some(row) = active.next_row(&mut Statistics::default()) {
        // Polygon by polygon, the edges from left to right.
        order.clear();
        order.extend(0..active.edges.len() as u32);
        let edge = |k: u32| &active.edges[k as usize];
        order.sort_unstable_by(|&i, &k| {
            let (a, b) = (&edge(i).edge, &edge(k).edge);
            a.facet.cmp(&b.facet).then_with(|| a.compare(b)).then(a.number.cmp(&b.number))
        });
        let start = row as usize * width;
        let (facets, values) = (&frame[start..start + width], &mut out[start..start + width]);
        for pair in order.windows(2) {
            if watch.over() {
                return None;
            }
            let (left, right) = (edge(pair[0]), edge(pair[1]));
            if left.edge.facet == right.edge.facet {
                between(left, right, facets, values);
            }
        }
    }
    Some(out)
}

/// Shades the pixels of a row between two neighbouring edges of a polygon, where it is visible.
fn between<const CORRECT: bool>(
    left: &Active<Colour<CORRECT>>,
    right: &Active<Colour<CORRECT>>,
    facets: &[u32],
    out: &mut [[f64; 3]],
) {
    let within = |column: i64| column.clamp(0, facets.len() as i64) as usize;
    let (from, to) = (within(left.edge.column), within(right.edge.column));
    if from >= to || !facets[from..to].contains(&left.edge.facet) {
        return;
    }
    let (p, q) = (&left.carried.value, &right.carried.value);
    let (start, end) = (left.edge.crossing(), right.edge.crossing());
    let step: [f64; 4] = std::array::from_fn(|k| (q[k] - p[k]) / (end - start));
    let mut here: [f64; 4] = std::array::from_fn(|k| p[k] + step[k] * (from as f64 + 0.5 - start));
    for column in from..to {
        if facets[column] == left.edge.facet {
            out[column] = [here[0] / here[3], here[1] / here[3], here[2] / here[3]];
        }
        for k in 0..4 {
            here[k] += step[k];
        }
    }
}
