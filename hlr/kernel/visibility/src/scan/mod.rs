//! The object-space scan-line pass: which pieces of the drawn edges are hidden.
//!
//! A. Appel, "The notion of quantitative invisibility and the machine rendering of solids", ACM 1967, for the
//! counting; the edge, polygon and active tables after Bouknight and Watkins, with exact bands in place of pixel rows:
//!
//! 1. `mesh`           snapped points, and the properties of each group
//! 2. `polygon_table`  which way each triangle faces and whether it is counted
//! 3. `edge_table`     contour edges with their jumps, drawn edges, and the edges that culling alone decides
//! 4. `active_spans`   how many polygons lie in front of each end point (the seeds and the checks; `query_points`: the
//!    points, by band and column)
//! 5. `active_edges`   where drawn edges pass behind contour edges
//! 6. `piercing`       where drawn edges pierce polygons of other groups, or of groups that pass through themselves
//! 7. `invisibility`   the count along one drawn edge, checked at its far end (`counting`: along all of them)
//! 8. `exact_query`    the slow way, polygon by polygon, for a drawn edge whose check failed
//! 9. `own_faces`      the slow way for edges whose own faces are seen nearly edge-on: hidden only if these turn over
//!    (`stretches`: these edges; `sheets`: the triangles of faces that go on smoothly; `touching`: outlines at which
//!    another body touches)
//! 10. `slanted`       the same for edges that touch polygons seen at a slant (`slant`: the tolerance there)
//! 11. `drawn`         the pieces that lines are made of
//!
//! Two shortcuts, taken where the scene calls for them, with the same result: `single_layer` (a convex body: culling
//! alone decides) before 4, and `depth_pyramid` (deep scenes: what surely lies behind something needs no search).
//!
//! It departs from Appel in that nothing is carried from edge to edge: every drawn edge has its own two counts, so an
//! error cannot spread, and from the classic scan line in that bands are coherence only: parameters are global to
//! the edge, edges are never cut at bands, and bands run in parallel without stitching.

pub mod active_edges;
pub mod active_spans;
mod bands;
mod counting;
mod depth_pyramid;
pub mod drawn;
pub mod edge_table;
mod exact_query;
pub mod invisibility;
mod merged;
pub mod mesh;
pub mod own_faces;
pub mod piercing;
pub mod polygon_table;
mod query_points;
pub mod scene;
mod sheets;
mod single_layer;
mod slant;
mod slanted;
pub mod stretches;
pub mod sweep;
mod touching;
