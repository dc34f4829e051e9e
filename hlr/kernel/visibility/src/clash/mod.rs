//! Where surfaces pass through one another: the intersection lines of clashing solids, and whether a solid passes
//! through itself.
//!
//! 1. `search`        which triangles may meet: boxes of groups, then boxes of triangles, which `tree` searches side by
//!    side `height_field`  and pieces of a surface in which none do, told by their borders: most of a smooth one
//! 2. `triangle_pair` the segment that two triangles have in common, decided by exact integers
//! 3. `weld`          ends that fall on one grid point are one point
//! 4. `depth`         how deep they go: touching surfaces cross as well, by what tessellation rounds
//!    `reach`         and how far a surface goes beyond a triangle that it crosses, right there
//! 5. `contacts`      which segments are more than a contact
//!
//! Independent of any view: done once per scene, on a grid of its own in model space. What is found is drawn as edges
//! without triangles, which the visibility pass treats like any wire: the ends, rounded to the grid, lie off both
//! surfaces by less than the contact tolerance.

pub mod contacts;
pub mod depth;
pub mod height_field;
pub mod reach;
pub mod search;
pub mod tree;
pub mod triangle_pair;
pub mod weld;
