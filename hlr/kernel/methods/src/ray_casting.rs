//! Ray casting: one ray through each pixel's centre, the nearest polygon it hits.
//!
//! A. Appel, "Some techniques for shading machine renderings of solids", 1968.
//!
//! On the ray t = 0 is the eye and t = 1 the image plane; t < 0 is behind the eye, which the near cut has removed.
//! After the projective map t grows with depth, so the nearest hit is the one of least depth.
//!
//! Several ways to spare tests can be chosen, to show what each saves: only a box per polygon (`Flat`), a hierarchy of
//! boxes, a uniform grid, or a partition with equally many polygons in each part.

use super::boxes::{Box3, Hierarchy};
use super::canvas::Canvas;
use super::coverage::owns;
use super::grid::Grid;
use super::limits::Watch;
use super::partition::Partition;
use super::screen::{NEAR_TIE, NONE, Screen};
use super::statistics::{Statistics, bytes_of};
use super::stopwatch::Stopwatch;
use std::cmp::Ordering;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acceleration {
    Flat,
    Hierarchy,
    Grid,
    Partition,
}

enum Index {
    Flat(Vec<Box3>),
    Hierarchy(Hierarchy),
    Grid(Grid),
    Partition(Partition),
}

pub fn render(
    screen: &Screen,
    canvas: &mut Canvas,
    acceleration: Acceleration,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    let started = Stopwatch::start();
    let index = match acceleration {
        Acceleration::Flat => Index::Flat((0..screen.facets.len() as u32).map(|f| Box3::of(screen, f)).collect()),
        Acceleration::Hierarchy => Index::Hierarchy(Hierarchy::new(screen, watch)?),
        Acceleration::Grid => Index::Grid(Grid::new(screen, watch)?),
        Acceleration::Partition => Index::Partition(Partition::new(screen, watch)?),
    };
    statistics.setup = started.seconds();
    let bytes = match &index {
        Index::Flat(boxes) => bytes_of(boxes),
        Index::Hierarchy(h) => h.bytes(),
        Index::Grid(g) => g.bytes(),
        Index::Partition(p) => p.bytes(),
    };
    statistics.holds(bytes + canvas.bytes());
    for row in 0..screen.height as i32 {
        for column in 0..screen.width as i32 {
            if watch.over() {
                return None;
            }
            statistics.rays += 1;
            let hit = cast(screen, &index, column, row, watch, statistics)?;
            if hit != NONE {
                statistics.spans += 1;
                canvas.write(row.into(), column.into(), i64::from(column) + 1, hit, statistics);
            }
        }
    }
    Some(())
}

/// The facet that the ray through a pixel hits first, or NONE.
fn cast(
    screen: &Screen,
    index: &Index,
    column: i32,
    row: i32,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<u32> {
    let (mut best, mut depth) = (NONE, f64::INFINITY);
    let (c, r) = (i64::from(column), i64::from(row));
    // The depth beyond which nothing matters: that of the hit, plus some steps for floating-point error.
    let mut test = |f: u32, statistics: &mut Statistics| -> f64 {
        statistics.polygon_tests += 1;
        let facet = &screen.facets[f as usize];
        if f != best
            && owns(screen, facet, c, r)
            && (best == NONE || screen.compare(f, best, c, r, statistics) == Ordering::Less)
        {
            best = f;
            let z = facet.depth_at(c, r) + NEAR_TIE;
            depth = if z.is_nan() { facet.depth[1] as f64 } else { z };
        }
        depth
    };
    match index {
        Index::Flat(boxes) => {
            for (f, b) in boxes.iter().enumerate() {
                if watch.over() {
                    return None;
                }
                statistics.box_tests += 1;
                if b.is_hit(column, row) {
                    test(f as u32, statistics);
                }
            }
        }
        Index::Hierarchy(h) => h.along(column, row, statistics, test),
        Index::Grid(g) => g.along(column, row, statistics, test),
        Index::Partition(p) => p.along(column, row, statistics, test),
    }
    Some(best)
}
