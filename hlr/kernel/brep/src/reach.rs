//! How far placed parts reach to the right and up, as a view sees them: closer than boxes along the axes of the model,
//! whose corners stand out in an oblique view. The scale that fits a page is known from it before anything is meshed.

use rayon::prelude::*;

use crate::bounds::{Box3, EMPTY, Range, add_ends, add_range, add_spline, around, stands, union};
use crate::certificate::control_net::ControlNet;
use crate::format::{Matrix, chained};
use crate::geometry::spline_surface::SplineSurface;
use crate::geometry::vector::Vector;
use crate::model::Model;
use crate::part_topology::PartTopology;

/// A part of the model, and where it stands.
pub type Placed = (usize, Matrix);

/// The range of placed parts along two directions; the lower end is beyond the upper one where there is nothing.
///
/// Free-form surfaces reach as far as the control points of small pieces; all else as in `bounds::boxes`.
pub fn reach(model: &Model, parts: &[Placed], [right, up]: [Vector; 2]) -> [[f64; 2]; 2] {
    // The view's depth is left out: nothing then reaches beyond the rest in depth, and most parts need no closer look.
    let view = [right, up, [0.0; 3]].map(|[x, y, z]| [x, y, z, 0.0]);
    let each =
        || parts.par_iter().with_min_len(FEW).map(|(part, place)| (&model.topology[*part], chained(&view, place)));
    let known = each().map(|(part, place)| around_ends(model, part, &place)).reduce(|| EMPTY, union);
    let found =
        each().map(|(part, place)| around(model, part, Some(&place), add_pieces, known)).reduce(|| known, union);
    [0, 1].map(|k| [found[0][k], found[1][k]])
}

/// With fewer parts a second thread gains nothing.
const FEW: usize = 16;

fn around_ends(model: &Model, part: &PartTopology, place: &Matrix) -> Box3 {
    let mut found = EMPTY;
    for edge in &part.edges {
        add_ends(&model.edges[edge.edge as usize], &stands(Some(place), edge.place), &mut found);
    }
    found
}

/// Adds a spline surface over ranges of u and v, piece by piece: the control points of a piece lie closer to the surface
/// the smaller it is. Those of a surface of many knots lie close anyway.
fn add_pieces(spline: &SplineSurface, ranges: [Range; 2], place: &Matrix, found: &mut Box3) {
    let (degree, count, _) = spline.net();
    let spans = [0, 1].map(|k| count[k] - degree[k]);
    let pieces = spans.map(|spans| (PIECES / spans).max(1));
    if spline.is_rational() || spans[0] * spans[1] > MANY {
        return add_spline(spline, ranges, place, found);
    }
    let net = ControlNet::of_spline(spline);
    let ends = [0, 1].map(|k| spline.within(k, ranges[k]));
    let at = |k: usize, i: usize| ends[k][0] + (ends[k][1] - ends[k][0]) * (i as f64 / pieces[k] as f64);
    for k in 0..2 {
        // A block of pieces encloses what each of them does: most blocks need no closer look.
        let mut blocks = vec![[[0, pieces[0]], [0, pieces[1]]]];
        while let Some(block) = blocks.pop() {
            let range = net.range(&place[k], [0, 1].map(|side| block[side].map(|i| at(side, i))));
            if found[0][k] <= range[0] && range[1] <= found[1][k] {
                continue;
            }
            let sizes = block.map(|[first, end]| end - first);
            let side = usize::from(sizes[1] > sizes[0]);
            if sizes[side] == 1 {
                add_range(k, range, found);
                continue;
            }
            let [first, end] = block[side];
            for half in [[first, usize::midpoint(first, end)], [usize::midpoint(first, end), end]] {
                let mut part = block;
                part[side] = half;
                blocks.push(part);
            }
        }
    }
    // No depth: as everything in this view.
    add_range(2, [0.0; 2], found);
}

/// Spans between knots of a surface whose control points are close enough.
const MANY: usize = 1000;

/// Pieces of a spline surface along u and v, its spans counted. What the control points are off by falls with the square.
const PIECES: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::IDENTITY;

    /// Over the unit square, a bump in its middle: 3 x 3 poles, of which the middle one lies at `height`.
    fn bump(height: f64) -> SplineSurface {
        let mut data = vec![2.0, 2.0, 3.0, 3.0, 0.0, 0.0];
        (0..2).for_each(|_| data.extend([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]));
        for i in 0..3 {
            for j in 0..3 {
                let z = if (i, j) == (1, 1) { height } else { 0.0 };
                data.extend([0.5 * f64::from(i), 0.5 * f64::from(j), z, 1.0]);
            }
        }
        SplineSurface::read(&data).unwrap()
    }

    #[test]
    fn a_bump_between_the_edges_reaches_beyond_them() {
        // The view sees z upward. The surface rises to a quarter of its middle pole.
        let place = [IDENTITY[0], IDENTITY[2], [0.0; 4]];
        for height in [8.0, -8.0] {
            let mut found = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
            add_pieces(&bump(height), [[0.0, 1.0]; 2], &place, &mut found);
            let [low, high] = [found[0][1], found[1][1]];
            let (far, near) = if height > 0.0 { (high, low) } else { (-low, high) };
            assert!((2.0..2.1).contains(&far) && near == 0.0, "{found:?}");
            assert_eq!([found[0][0], found[1][0]], [0.0, 1.0]);
        }
    }
}
