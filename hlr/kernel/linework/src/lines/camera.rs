//! The camera: projects points of the model to paper.

use rayon::prelude::*;

use super::View;
use crate::fit::plane::Vec2;
use crate::fit::project::Projection;
use hlr_visibility::plan::contact::Look;

type Vec3 = [f64; 3];

/// Unit vectors in model coordinates; `direction` points from the object toward the viewer.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub direction: Vec3,
    pub right: Vec3,
    pub up: Vec3,
    /// For a perspective view: the eye, and its distance from the image plane, in model units.
    pub eye: Option<(Vec3, f64)>,
    /// Millimetres on paper per model unit in the image plane.
    pub scale: f64,
}

fn dot(p: &Vec3, v: &Vec3) -> f64 {
    p[0] * v[0] + p[1] * v[1] + p[2] * v[2]
}

impl Look for Camera {
    fn distance(&self) -> Option<f64> {
        self.eye.map(|(_, distance)| distance)
    }

    fn ahead(&self, p: &Vec3) -> f64 {
        let eye = self.eye.map_or([0.0; 3], |(eye, _)| eye);
        -dot(&[p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]], &self.direction)
    }

    fn image(&self, p: &Vec3) -> Vec3 {
        Camera::image(self, p)
    }
}

impl Camera {
    pub fn view(&self) -> View {
        View {
            origin: self.eye.map_or([0.0; 3], |(eye, _)| eye),
            away: self.direction.map(|c| -c),
            perspective: self.eye.is_some(),
        }
    }

    /// Coordinates to the right, up, and away from the viewer, in model units: what lies in front has less depth.
    pub fn image(&self, p: &Vec3) -> Vec3 {
        let Some((eye, distance)) = self.eye else {
            return [dot(p, &self.right), dot(p, &self.up), -dot(p, &self.direction)];
        };
        let away = [p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]];
        let factor = distance / -dot(&away, &self.direction);
        [dot(&away, &self.right) * factor, dot(&away, &self.up) * factor, -distance * factor]
    }

    /// From where to where points reach in the image, to the right and up, in model units; the lower end is beyond the
    /// upper one where there are none.
    pub fn reach(&self, points: &[Vec3]) -> [[f64; 2]; 2] {
        let nothing = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let with = |found: [[f64; 2]; 2], p: &Vec3| {
            let image = self.image(p);
            [0, 1].map(|k| [found[k][0].min(image[k]), found[k][1].max(image[k])])
        };
        let both = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| [0, 1].map(|k| [a[k][0].min(b[k][0]), a[k][1].max(b[k][1])]);
        points.par_chunks(4096).map(|some| some.iter().fold(nothing, with)).reduce(|| nothing, both)
    }

    /// The image of a point, in millimetres on paper.
    pub fn point(&self, p: &Vec3) -> Vec2 {
        let [x, y, _] = self.image(p);
        [x * self.scale, y * self.scale]
    }

    /// A point moved at right angles to the line of sight, at equal depth, so that its image is `image`.
    pub fn moved(&self, p: &Vec3, image: &Vec2) -> Vec3 {
        let at = self.point(p);
        let mut step = [0, 1].map(|k| (image[k] - at[k]) / self.scale);
        if let Some((eye, distance)) = self.eye {
            let away = [p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]];
            let share = -dot(&away, &self.direction) / distance;
            step = step.map(|s| s * share);
        }
        [0, 1, 2].map(|i| p[i] + step[0] * self.right[i] + step[1] * self.up[i])
    }

    /// The matrix from (x, y, z, 1) in the model to (x w, y w, w) on paper.
    pub fn projection(&self) -> Projection {
        let row = |v: &Vec3, factor: f64, origin: &Vec3| {
            let [x, y, z] = v.map(|c| c * factor);
            [x, y, z, -(x * origin[0] + y * origin[1] + z * origin[2])]
        };
        let Some((eye, distance)) = &self.eye else {
            let [right, up] = [self.right, self.up].map(|v| row(&v, self.scale, &[0.0; 3]));
            return Projection([right, up, [0.0, 0.0, 0.0, 1.0]]);
        };
        let factor = distance * self.scale;
        Projection([row(&self.right, factor, eye), row(&self.up, factor, eye), row(&self.direction, -1.0, eye)])
    }
}
