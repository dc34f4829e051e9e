//! The lens: projects points of the model into the picture. x right and y down in pixels; depth grows away from the
//! viewer.

use hlr_brep::geometry::vector::{Vector, dot, sub};

#[derive(Clone, Debug)]
pub struct Lens {
    /// Unit vectors of the picture's axes, in the model.
    pub right: Vector,
    pub up: Vector,
    pub ahead: Vector,
    /// The eye; in a parallel view any point.
    pub origin: Vector,
    /// Pixels per model unit, in the image plane.
    pub scale: f64,
    /// The origin in the picture, in pixels from the upper left corner.
    pub centre: [f64; 2],
    /// Distance from the eye to the image plane, in model units; None for parallel views.
    pub distance: Option<f64>,
    /// Least and greatest distance ahead of all that is in view, in model units; both positive in perspective.
    pub range: [f64; 2],
    /// Width and height in pixels.
    pub size: [usize; 2],
}

impl Lens {
    /// x right and y down in pixels of the image plane, z ahead in model units.
    #[inline(always)]
    pub fn view(&self, p: &Vector) -> Vector {
        let q = sub(p, &self.origin);
        [self.scale * dot(&q, &self.right), -self.scale * dot(&q, &self.up), dot(&q, &self.ahead)]
    }

    /// Homogeneous coordinates, relative to the centre, of a point in view coordinates.
    #[inline(always)]
    pub fn homogeneous(&self, v: &Vector) -> Vector {
        match self.distance {
            None => [v[0], v[1], 1.0],
            Some(d) => [v[0] * d, v[1] * d, v[2]],
        }
    }

    /// Pixel position of a point in view coordinates that lies before the eye.
    #[inline(always)]
    pub fn place(&self, v: &Vector) -> [f64; 2] {
        let w = self.distance.map_or(1.0, |d| d / v[2]);
        [self.centre[0] + v[0] * w, self.centre[1] + v[1] * w]
    }

    /// 0 nearest, 1 farthest, and linear in the picture: on a plane it is an affine function of x and y.
    #[inline(always)]
    pub fn depth(&self, z: f64) -> f64 {
        let [a, b] = self.range;
        if self.distance.is_none() { (z - a) / (b - a) } else { (1.0 - a / z) / (1.0 - a / b) }
    }

    /// All of the above in one, prepared for many points.
    pub fn projector(&self) -> Projector {
        let row = |axis: &Vector, scale: f64| {
            [axis[0] * scale, axis[1] * scale, axis[2] * scale, -dot(axis, &self.origin) * scale]
        };
        let [a, b] = self.range;
        let (depth, over) = if self.distance.is_none() { (a, 1.0 / (b - a)) } else { (a, 1.0 / (1.0 - a / b)) };
        Projector {
            rows: [row(&self.right, self.scale), row(&self.up, -self.scale), row(&self.ahead, 1.0)],
            centre: self.centre,
            distance: self.distance.unwrap_or(0.0),
            depth,
            over,
        }
    }

    /// The inverse of `depth`.
    pub fn ahead_at(&self, depth: f64) -> f64 {
        let [a, b] = self.range;
        if self.distance.is_none() { a + depth * (b - a) } else { a / (1.0 - depth * (1.0 - a / b)) }
    }

    /// Distance ahead of the near plane: nothing nearer is visible.
    pub fn near(&self) -> f64 {
        if self.distance.is_none() { f64::NEG_INFINITY } else { self.range[0] }
    }

    /// The direction from a point of the model to the viewer, not of unit length in perspective.
    pub fn toward_viewer(&self, p: &Vector) -> Vector {
        if self.distance.is_none() { self.ahead.map(|c| -c) } else { sub(&self.origin, p) }
    }
}

pub struct Projector {
    rows: [[f64; 4]; 3],
    centre: [f64; 2],
    distance: f64,
    depth: f64,
    over: f64,
}

impl Projector {
    /// x and y in pixels, depth, and z ahead.
    #[inline(always)]
    pub fn project(&self, p: &Vector) -> [f64; 4] {
        let at = |r: &[f64; 4]| r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
        let (x, y, z) = (at(&self.rows[0]), at(&self.rows[1]), at(&self.rows[2]));
        if self.distance == 0.0 {
            return [self.centre[0] + x, self.centre[1] + y, (z - self.depth) * self.over, z];
        }
        let w = self.distance / z;
        [self.centre[0] + x * w, self.centre[1] + y * w, (1.0 - self.depth / z) * self.over, z]
    }
}
