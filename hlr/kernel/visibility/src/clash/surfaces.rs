//! The surfaces that are searched for crossings: triangles in groups, on an integer grid.

use super::planar_faces::PlanarFaces;
use super::triangle_pair::Numbered;
use crate::boxes::aabb::Aabb;
use hlr_exact::Point;

pub struct Surfaces<'a> {
    pub points: &'a [Point],
    pub triangles: &'a [[i32; 3]],
    pub group: &'a [i32],
    /// Per group, whether it is searched for passing through itself.
    pub itself: &'a [bool],
    pub planar: &'a PlanarFaces,
}

impl Surfaces<'_> {
    #[inline]
    pub fn numbered(&self, t: u32) -> Numbered<'_> {
        let number = self.triangles[t as usize];
        Numbered { corner: number.map(|v| &self.points[v as usize]), number }
    }

    #[inline]
    pub fn bounds(&self, t: u32) -> Aabb {
        let [a, b, c] = self.triangles[t as usize].map(|v| self.points[v as usize]);
        let mut out = Aabb { low: a, high: a };
        for k in 0..3 {
            out.low[k] = a[k].min(b[k]).min(c[k]);
            out.high[k] = a[k].max(b[k]).max(c[k]);
        }
        out
    }
}
