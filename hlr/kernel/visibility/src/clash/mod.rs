//! Where surfaces pass through one another: the intersection lines of clashing solids, and whether a solid passes
//! through itself.
//!
//! 0. `surfaces`      the triangles in their groups, on the grid
//! 1. `search`        which triangles may meet: overlapping boxes of groups, then of triangles (`boxes`)
//!    `height_field`  pieces of a surface in which no two triangles meet, recognised by their borders
//!    `planar_faces`  triangles of one planar face, and those that stand on it, do not pass through it
//!    `uncrossed`     planar faces that hardly anything of their body crosses: left out of the search
//! 2. `triangle_pair` the segment that two triangles have in common, decided by exact integers
//! 3. `weld`          ends that fall on one grid point become one point
//! 4. `depth`         how deep the surfaces go through each other: touching ones cross as well, by tessellation errors
//!    `planes`        the planes of planar faces, from which depths are measured
//!    `reach`         how far a surface goes beyond a triangle that it crosses, near the crossing
//!    `apart`         the same of two surfaces that cross at a small angle: how far they come apart
//!    `chord_ends`    planar faces that cross only because their curved borders are drawn as chords
//! 5. `contacts`      which segments are more than a contact
//!
//! `crossings` does all of this one after another.
//!
//! Independent of any view: done once per scene, on a grid of its own in model space. The segments are drawn as edges
//! without triangles, which the visibility pass treats like any wire: their ends, rounded to the grid, lie off both
//! surfaces by less than the contact tolerance.

mod apart;
mod chord_ends;
mod contacts;
pub mod crossings;
mod depth;
mod gaps;
mod height_field;
pub mod planar_faces;
mod planes;
mod reach;
pub mod search;
pub mod surfaces;
pub mod triangle_pair;
mod uncrossed;
pub mod weld;
