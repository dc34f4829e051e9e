//! The true curves in which faces pass through one another.
//!
//! `hlr_visibility::clash` finds where the meshes cross. A mesh is off its surface by the deflection, so these points are
//! off the true line by that over the sine of the angle between the surfaces, and their line is a polygon. Visibility is
//! decided on the meshes, with these points. Lines are drawn along the curves found here, as they are along edges.
//!
//! ```text
//!          \    ___ mesh of b         1. `face`          a surface in its place, and the point of it nearest to another
//!     a ----x--o---------- true a     2. `common_point`  moves a point x of the meshes to o, on all surfaces at once
//!            \/                       3. `line`          the points of one line, made so dense that cubics suffice
//!            /\__ true b              4. `conic`         the ellipse or the circle that they lie on, where they do
//!                                     5. `trace`         all lines
//! ```
//!
//! After R. E. Barnhill, S. N. Kersey, "A marching method for parametric surface/surface intersection", CAGD 7 (1990):
//! points are moved by the tangent planes of both surfaces. The march itself is not needed: the meshes tell the way.

mod common_point;
mod conic;
mod face;
mod line;
mod trace;

#[cfg(test)]
mod tests;

use crate::silhouette::FaceRecord;
use crate::silhouette::side::on_triangle;
use face::Face;
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::Vector;
pub use trace::curves;

/// Meshes of faces, and the surfaces under them, borrowed.
pub struct Sheets<'a> {
    pub points: &'a [Vector],
    pub triangles: &'a [[i32; 3]],
    pub triangle_face: &'a [i32],
    /// Per triangle corner, the index of its node in `uv`.
    pub corner: &'a [[i32; 3]],
    pub uv: &'a [[f64; 2]],
    pub faces: Vec<FaceRecord>,
    pub surfaces: &'a [Option<Surface>],
    /// Chord error of the meshes, model units.
    pub deflection: f64,
}

/// Segments in which the meshes cross, and the lines that they form: line i walks along the segments
/// `order[offsets[i]..offsets[i + 1]]`, all between one pair of faces.
pub struct Crossed<'a> {
    pub points: &'a [Vector],
    pub segments: &'a [[i32; 2]],
    /// The two triangles of each segment.
    pub triangles: &'a [[i32; 2]],
    pub offsets: &'a [i32],
    pub order: &'a [i32],
    pub reversed: &'a [bool],
}

/// The curve of a line, how far it rises above the chords between the line's points, and these points, on the curve.
#[derive(Clone, Debug)]
pub struct Found {
    pub curve: Curve,
    pub rise: f64,
    /// Of the first end of each segment, then of the last end.
    points: Vec<Vector>,
}

impl Crossed<'_> {
    /// The ends of the k-th segment in the order of lines, in the sense of the walk.
    fn ends(&self, k: usize) -> [usize; 2] {
        let [a, b] = self.segments[self.order[k] as usize].map(|p| p as usize);
        if self.reversed[k] { [b, a] } else { [a, b] }
    }

    /// The points along line i.
    fn nodes(&self, i: usize) -> impl Iterator<Item = usize> {
        let (first, last) = (self.offsets[i] as usize, self.offsets[i + 1] as usize);
        (first..last).map(|k| self.ends(k)[0]).chain([self.ends(last - 1)[1]])
    }
}

impl Sheets<'_> {
    fn face(&self, t: i32) -> Option<Face<'_>> {
        let record = &self.faces[self.triangle_face[t as usize] as usize];
        Some(Face::new(self.surfaces[record.surface? as usize].as_ref()?, &record.place))
    }

    /// The face of a triangle, and the parameters of a point on the triangle.
    fn place(&self, t: i32, p: &Vector) -> Option<(Face<'_>, [f64; 2])> {
        let face = self.face(t)?;
        let corners = self.triangles[t as usize].map(|v| &self.points[v as usize]);
        Some((face, on_triangle(p, corners, self.corner[t as usize].map(|k| self.uv[k as usize]))))
    }
}
