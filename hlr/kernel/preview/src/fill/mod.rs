//! The coloured areas under the lines of a filled drawing: the shaded preview as areas, each with one paint.
//!
//! ```text
//! 1. `samples`   what is seen at the points of a grid, by the preview's z-buffer: faces, colour, and how light it is
//! 2. `specks`    pieces smaller than a few points go to their neighbours
//! 3. `tone`      the paint of each face: one colour, a gradient along a line, or bands of equal light; `conical`: where their
//!                borders meet in one place
//! 4. `chains`    the borders between areas, walked from where three of them meet to the next such place
//! 5. `crossing`  where a border really runs between two points of the grid, found on the triangles that are seen there
//! 6. `straighten`  few corners: chains become straight runs, and corners are where these meet
//! 7. `areas`     chains become closed loops again
//! ```
//!
//! What is equal along a row is held and handled as `runs`: passes over single points are few.
//!
//! The grid decides which areas are found; the triangles decide where their borders run. Time and memory are bounded by
//! the number of points of the grid, whatever the model: faces that pass through one another, or overlap in a cycle,
//! need no order. Neighbours share their border, without gap or overlap.

pub mod areas;
mod chains;
mod conical;
mod crossing;
mod runs;
mod samples;
mod specks;
mod straighten;
mod tone;

use crate::shade::Scene;
use crate::workspace::Workspace;

pub use areas::Areas;
use runs::Runs;

/// A face that is visible at fewer adjacent points of the grid than this goes to its neighbour.
const SPECK: usize = 6;
/// The same limit for bands of light within a face.
const BAND_SPECK: usize = 24;

/// All areas of a picture, in the order of painting. `label`: per triangle, equal for triangles of one face; `fine`:
/// least width of a band of light, in points of the grid. None when stopped.
pub fn areas(
    scene: &Scene,
    label: &[i32],
    fine: f64,
    space: &mut Workspace,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Areas> {
    let size = scene.lens.size;
    let mut grid = samples::grid(scene, label, space, stopped)?;
    let mut faces = grid.faces.clone();
    specks::merge(&grid.runs, &mut faces, SPECK, |_, _| 0);
    if stopped() {
        return None;
    }
    let tones = tone::tones(&mut grid, &faces, fine);
    let mut cells = tone::cells(&grid, &faces, &tones);
    let parts = Runs::new(&cells, size[0], u32::eq);
    let mut merged: Vec<u32> = (0..parts.count()).map(|k| cells[parts.places(k).start]).collect();
    specks::merge(&parts, &mut merged, BAND_SPECK, |a, b| tones.alike(a as usize, b as usize));
    for (k, &cell) in merged.iter().enumerate() {
        if cells[parts.places(k).start] != cell {
            cells[parts.places(k)].fill(cell);
        }
    }
    if stopped() {
        return None;
    }
    let found = chains::chains(&cells, &parts, size);
    let at = crossing::Crossing { scene, label, grid: &grid, cells: &cells, tones: &tones };
    let borders = straighten::borders(&found, &at, size, stopped)?;
    Some(areas::collect(&grid, &tones, (&cells, &parts), &found, borders))
}
