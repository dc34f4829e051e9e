//! The classic visible-surface methods, side by side on one scene and one camera.
//!
//! Each is its textbook form made exact: coordinates are rounded once, to a 256th of a pixel and to 2^48 steps of
//! depth; after that coverage and depth at a pixel's centre are integer predicates. So all methods give the same
//! picture, pixel by pixel, and differ only in cost (`statistics`).
//!
//! Shared by all:
//! 1. `scene`       polygons as they come: loops of points, an id, an inside rule
//! 2. `clip`        the six planes of the view volume, before anything is divided; 2-D clipping after object space
//! 3. `depth_grid`  depth in whole steps; `plane` of the rounded polygon, in integers; `back_face` its sign
//! 4. `triangulate` polygons whose rounded corners lie in no plane
//! 5. `prepare`     the above, one after another; `screen` its facets, ready for any method, and their depths compared
//! 6. `coverage`    which pixels a polygon owns; `canvas` where they are written, with a trace if wanted
//!
//! The methods:
//! - `z_buffer` (Catmull 1974), `scan_line_z_buffer`
//! - `edge_table`, `active_edges` with their `edge_record`s, `polygon_table`, `scan_line` (Wylie et al. 1967, Bouknight
//!   1970, Watkins 1970), `span_list`
//! - `warnock` (Warnock 1969)
//! - `depth_sort` (Newell, Newell, Sancha 1972) and `bsp` (Fuchs, Kedem, Naylor 1980), on `pieces`
//! - `ray_casting` (Appel 1968) with `boxes`, a hierarchy of them, `grid` and an equal-count `partition`
//!
//! Beside them `patch`, curved patches z = f(x, y) for the z-buffer and the scan lines, `quadric`, depth of quadrics,
//! both by forward differences, and `shading`, values along spans.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod active_edges;
mod back_face;
mod boxes;
pub mod bsp;
pub mod canvas;
pub mod clip;
mod coverage;
mod depth_grid;
pub mod depth_sort;
pub mod edge;
pub mod edge_record;
pub mod edge_table;
mod grid;
pub mod limits;
mod memory;
pub mod non_planar;
mod partition;
mod patch;
mod pieces;
pub mod plane;
pub mod polygon_table;
pub mod prepare;
pub mod quadric;
pub mod ray_casting;
pub mod scan_line;
pub mod scan_line_z_buffer;
pub mod scene;
pub mod screen;
pub mod shading;
pub mod span_list;
pub mod statistics;
pub mod stopwatch;
mod triangulate;
pub mod view;
pub mod warnock;
pub mod z_buffer;

#[cfg(test)]
mod tests;
