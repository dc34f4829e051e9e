//! The input scene: polygons as loops of points in one set of arrays, and the camera.

/// Which points are inside where loops overlap or cross themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Crossing a loop toggles inside and outside.
    EvenOdd,
    /// Inside where the loops wind around, whichever way.
    NonZero,
}

impl Rule {
    #[inline(always)]
    pub fn inside(self, winding: i32) -> bool {
        match self {
            Rule::EvenOdd => winding & 1 != 0,
            Rule::NonZero => winding != 0,
        }
    }
}

/// A curved surface z = f(x, y): c[i][j] of (x - origin[0])^i (y - origin[1])^j in pixels, and the least and greatest
/// depth.
#[derive(Clone, Copy, Debug)]
pub struct Cubic {
    pub coefficients: [[f64; 4]; 4],
    pub origin: [f64; 2],
    pub range: [f64; 2],
}

/// Polygon i has the loops polygons[i]..polygons[i + 1], loop k the corners loops[k]..loops[k + 1], a corner is an
/// index into `points`. The id of a polygon is its number.
pub struct Scene<'a> {
    pub points: &'a [[f64; 3]],
    pub corners: &'a [i32],
    pub loops: &'a [i32],
    pub polygons: &'a [i32],
    /// Per polygon: it belongs to a closed, consistently oriented solid, so it may be left out where it faces away.
    pub cull: &'a [bool],
    /// Per point: a colour or normal to interpolate; may be empty.
    pub values: &'a [[f64; 3]],
    pub rule: Rule,
    /// Polygons, ascending, that are the outlines of curved patches.
    pub patches: &'a [(u32, Cubic)],
}

impl Scene<'_> {
    pub fn len(&self) -> usize {
        self.polygons.len().saturating_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The patch that a polygon is the outline of.
    pub fn patch(&self, polygon: u32) -> Option<&Cubic> {
        let at = self.patches.binary_search_by_key(&polygon, |(p, _)| *p).ok()?;
        Some(&self.patches[at].1)
    }

    /// The loops of a polygon, each as indices into `points`.
    pub fn loops_of(&self, polygon: usize) -> impl Iterator<Item = &[i32]> + Clone {
        let (first, end) = (self.polygons[polygon] as usize, self.polygons[polygon + 1] as usize);
        (first..end).map(|k| &self.corners[self.loops[k] as usize..self.loops[k + 1] as usize])
    }
}

/// From the model to the picture, as one matrix: (x, y, z, 1) -> (u, v, q, w), where u / w and v / w are pixels, right
/// and down, and q / w is depth, away from the viewer. Parallel views have w = 1; in perspective w is the distance from
/// the eye's plane, so that u, v and depth are all projective and planes stay planes.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub matrix: [[f64; 4]; 4],
    pub width: u32,
    pub height: u32,
    /// Depths of the front and the back plane; infinite where there is none.
    pub front: f64,
    pub back: f64,
    /// A point with a smaller w is not in front of the eye: the near cut of a perspective view. -inf in parallel views.
    pub near: f64,
    /// Image space clips by all six planes before hiding; object space hides first, and clips in two dimensions.
    pub image_space: bool,
}

impl Camera {
    pub fn project(&self, p: &[f64; 3]) -> [f64; 4] {
        let m = &self.matrix;
        std::array::from_fn(|k| m[k][0] * p[0] + m[k][1] * p[1] + m[k][2] * p[2] + m[k][3])
    }
}
