//! Silhouettes: the curves on the true surfaces where the normal is square to the line of sight, N . v = 0.
//!
//! After A. Hertzmann, D. Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000: the sign of f = N . v at the nodes of
//! the tessellation, taken from the exact normals, divides the mesh into front and back. The border between them
//! crosses each triangle at most once, so it never branches and never zigzags from facet to facet, as the contour of
//! the mesh does.
//!
//! ```text
//!    `sought`   on which faces
//! 1. `face`     f on the true surface of a face, and how the surface curves along the line of sight
//!    `narrow`   adds nodes to strips that narrow to less than a triangle, in a `divided` mesh
//!    `wrinkle`  removes changes of sign where the surface turns over and back within less than the tolerance
//! 2. `contour`  mesh edges where f changes its sign: the crossing is found on the true surface; where the two faces at
//!               an edge change sign at different places, the edge itself is the fold in between, so no gap is left
//!    `grazing`  borders of faces that are seen nearly edge-on, and whether these faces hide them
//!    `crossed`  the same of intersection lines
//!    `behind`   farther borders of walls seen edge-on, where the surface comes toward the viewer by steps
//! 3. `refine`   adds points on the surface between crossings until the chords are near enough; divides at cusps
//! 4. `trace`    joins these pieces (`link`) into curves, divided where the face, the edge or the sign of the curvature
//!               changes,
//!    `poles`    at poles and apexes, too,
//!    `split`    and where the image of a curve would lie on itself
//! 5. `curve`    a circle where that is exact, else cubic pieces through the points with their tangents
//!    `facing`   which of them face one another, where a body touches itself
//! 6. `outlined` adds them to the `image` as edges, and `own_lines` where edges are compared with their own faces
//! ```
//!
//! It departs from the paper in that the crossings are not those of the linear interpolant but are moved onto the
//! surface, and in that zeros at nodes (views along an axis) count as turned away, on every face alike: a plane seen
//! edge-on that runs into a fillet is a fold along its nearer border only. Where what lies before that border is turned
//! away as well, the farther border is the outline.

mod behind;
mod contour;
mod crossed;
pub(crate) mod curve;
mod divided;
mod face;
mod facing;
pub mod grazing;
pub mod image;
mod link;
mod narrow;
pub mod outlined;
mod own_lines;
mod poles;
mod refine;
pub(crate) mod side;
pub mod sought;
mod split;
pub mod trace;
mod wrinkle;

#[cfg(test)]
mod tests;

use crate::lines::View;
use hlr_brep::geometry::surface::Surface;

/// |N . v| up to this counts as 0, so that views along an axis work although the file rounds its numbers.
pub const TIE: f64 = 5e-7;

/// The mesh and the surfaces under it, borrowed.
pub struct Model<'a> {
    pub points: &'a [[f64; 3]],
    pub triangles: &'a [[i32; 3]],
    pub triangle_face: &'a [i32],
    pub edges: &'a [[i32; 2]],
    /// Triangles incident to edge e: incident[offsets[e]..offsets[e + 1]].
    pub offsets: &'a [i32],
    pub incident: &'a [i32],
    /// Of the last edges, which are intersection lines: the two triangles that cross there.
    pub crossed: &'a [[i32; 2]],
    /// Edges across which the surface continues smoothly.
    pub smooth: &'a [bool],
    /// The edge of the B-rep of which an edge is a chord, -1 for none.
    pub source: &'a [i32],
    /// Per triangle corner, the index of its node in `uv`.
    pub corner: &'a [[i32; 3]],
    pub uv: &'a [[f64; 2]],
    pub faces: Vec<FaceRecord>,
    pub surfaces: &'a [Option<Surface>],
    pub view: View,
    /// How far chords may be off the curve, in model units.
    pub chord: f64,
}

#[derive(Clone, Copy, Debug)]
pub struct FaceRecord {
    /// Index into `surfaces`; None where outlines are not asked for or the surface is not known.
    pub surface: Option<u32>,
    /// Rows of the matrix from the surface's frame into the model.
    pub place: [[f64; 4]; 3],
    /// -1 where the surface's normal points inward.
    pub sign: f64,
    pub curved: bool,
}
