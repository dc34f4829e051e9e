//! Shading: Lambert's law in linear light, one light over the viewer's shoulder; highlights, shadows and ambient
//! occlusion as options.

use super::Model;
use super::lens::Lens;
use super::occlusion::Occlusion;
use super::resolve::Encoder;
use super::shadow::Shadow;
use super::surface::{Surface, normals};
use hlr_brep::geometry::vector::{add, dot, sub, unit};

#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Unit vector from the model toward the light, in the model.
    pub toward: [f64; 3],
    /// Share of light that a surface reflects whichever way it faces.
    pub ambient: f32,
    /// Share of light that it reflects in addition where it faces the light.
    pub diffuse: f32,
    /// Strength of highlights; 0 for none.
    pub specular: f32,
}

/// J. F. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977: the exponent.
const SHININESS: i32 = 48;

pub struct Scene<'a> {
    pub model: &'a Model<'a>,
    pub lens: &'a Lens,
    pub light: Light,
    pub shadow: Option<Shadow>,
    pub occlusion: Option<Occlusion>,
}

/// A triangle prepared for shading: all values that are constant over it.
#[derive(Clone, Debug)]
pub enum Ready {
    /// One normal and one colour: a constant result.
    Flat([f32; 4]),
    Round(Round),
    Any(Box<Any>),
}

/// One colour, and a normal that changes over the triangle. Up to its length the interpolated normal is an affine
/// function of position: the common factor of the barycentric coordinates cancels.
#[derive(Clone, Debug)]
pub struct Round {
    colour: [f32; 4],
    /// The position to which `at` belongs, in pixels.
    origin: [f64; 2],
    /// x, y, z of the normal and its product with the light: at the origin, and their growth per pixel in x and in y.
    at: [f32; 4],
    by_x: [f32; 4],
    by_y: [f32; 4],
}

#[derive(Clone, Debug)]
pub struct Any {
    surface: Surface,
    colours: [[f32; 4]; 3],
}

/// Pixels: a triangle lower than this is not interpolated affinely. A sample may lie a grid step outside of the
/// triangle; for larger triangles that does not matter.
const LOW: f64 = 1.0 / 16.0;

impl Scene<'_> {
    /// `place`: a position where the triangle is visible, in pixels.
    pub fn ready(&self, triangle: u32, place: [f64; 2]) -> Ready {
        let paint = self.model.paint[triangle as usize];
        let colours = paint.map(|i| self.model.colours[i as usize]);
        let plain = paint[0] == paint[1] && paint[1] == paint[2];
        let matt = self.light.specular == 0.0 && self.shadow.is_none() && self.occlusion.is_none();
        if !plain || !matt {
            return Ready::Any(Box::new(Any { surface: Surface::new(self.model, self.lens, triangle), colours }));
        }
        let n = normals(self.model, triangle);
        let flat = n[0] == n[1] && n[1] == n[2];
        if flat && self.model.cull[triangle as usize] {
            return Ready::Flat(self.lit(colours[0], self.facing(n[0]), 1.0));
        }
        if flat || self.lens.distance.is_some() {
            let surface = Surface::new(self.model, self.lens, triangle);
            if flat {
                return Ready::Flat(self.lit(colours[0], self.facing(surface.normal([1.0, 0.0, 0.0])), 1.0));
            }
            return Ready::Any(Box::new(Any { surface, colours }));
        }
        let origin = [place[0].floor(), place[1].floor()];
        match self.round(triangle, &n, origin, colours[0]) {
            Some(round) => Ready::Round(round),
            None => Ready::Any(Box::new(Any { surface: Surface::new(self.model, self.lens, triangle), colours })),
        }
    }

    /// For a parallel view: the normal as an affine function of position, from its values at the corners. None for a
    /// triangle too low for that.
    #[inline(always)]
    fn round(&self, triangle: u32, n: &[[f32; 3]; 3], origin: [f64; 2], colour: [f32; 4]) -> Option<Round> {
        let lens = self.lens;
        let corners = self.model.triangles[triangle as usize].map(|i| {
            let q = sub(&self.model.points[i as usize], &lens.origin);
            [lens.scale * dot(&q, &lens.right) + lens.centre[0], lens.centre[1] - lens.scale * dot(&q, &lens.up)]
        });
        let [x0, y0] = corners[0];
        let [x1, y1] = [corners[1][0] - x0, corners[1][1] - y0];
        let [x2, y2] = [corners[2][0] - x0, corners[2][1] - y0];
        let turn = x1 * y2 - x2 * y1;
        // The height over the longest side is the least height.
        let square = |x: f64, y: f64| x * x + y * y;
        let longest = square(x1, y1).max(square(x2, y2)).max(square(x2 - x1, y2 - y1));
        if turn * turn <= longest * (LOW * LOW) {
            return None;
        }
        // With y down, a triangle that is counter-clockwise to the viewer has a negative area.
        let side = if turn < 0.0 { 1.0 } else { -1.0 };
        let light = n.map(|n| self.facing(n));
        let values = |k: usize| [0, 1, 2].map(|i: usize| side * f64::from(if k < 3 { n[i][k] } else { light[i] }));
        let (mut at, mut by_x, mut by_y) = ([0.0f32; 4], [0.0f32; 4], [0.0f32; 4]);
        let (over, from) = (1.0 / turn, [origin[0] - x0, origin[1] - y0]);
        for k in 0..4 {
            let [v0, v1, v2] = values(k);
            let x = ((v1 - v0) * y2 - (v2 - v0) * y1) * over;
            let y = ((v2 - v0) * x1 - (v1 - v0) * x2) * over;
            (at[k], by_x[k], by_y[k]) = ((v0 + x * from[0] + y * from[1]) as f32, x as f32, y as f32);
        }
        Some(Round { colour, origin, at, by_x, by_y })
    }

    /// Linear light and opacity at a position where the triangle is visible, in pixels.
    #[inline(always)]
    pub fn shade(&self, ready: &Ready, place: [f64; 2]) -> [f32; 4] {
        match ready {
            Ready::Flat(colour) => *colour,
            Ready::Round(round) => {
                let [x, y] = [place[0] - round.origin[0], place[1] - round.origin[1]].map(|c| c as f32);
                self.lit(round.colour, round.facing(x, y), 1.0)
            }
            Ready::Any(any) => self.shade_any(any, place),
        }
    }

    /// Shades adjacent pixels, the first of which has its centre at `place`.
    #[inline(always)]
    pub fn shade_run(&self, ready: &Ready, place: [f64; 2], row: &mut [[u8; 4]], encoder: &Encoder) {
        if let Ready::Flat(colour) = ready {
            row.fill(encoder.pixel(*colour));
            return;
        }
        if let Ready::Round(round) = ready
            && round.colour[3] >= 1.0
        {
            let from = [place[0] - round.origin[0], place[1] - round.origin[1]].map(|c| c as f32);
            for (i, pixel) in row.iter_mut().enumerate() {
                let light = self.share(round.facing(from[0] + i as f32, from[1]), 1.0);
                *pixel = encoder.opaque([0, 1, 2].map(|k: usize| round.colour[k] * light));
            }
            return;
        }
        for (i, pixel) in row.iter_mut().enumerate() {
            *pixel = encoder.pixel(self.shade(ready, [place[0] + i as f64, place[1]]));
        }
    }

    #[inline(never)]
    fn shade_any(&self, any: &Any, place: [f64; 2]) -> [f32; 4] {
        let w = any.surface.weights([place[0] - self.lens.centre[0], place[1] - self.lens.centre[1]]);
        let n = any.surface.normal(w);
        let colour = mixed(&any.colours, w);
        if self.light.specular == 0.0 && self.shadow.is_none() && self.occlusion.is_none() {
            return self.lit(colour, self.facing(n), 1.0);
        }
        self.effects(&any.surface, w, n, colour)
    }

    /// Shading that needs the point itself (shadows, occlusion, highlights).
    #[inline(never)]
    fn effects(&self, surface: &Surface, w: [f32; 3], n: [f32; 3], colour: [f32; 4]) -> [f32; 4] {
        let point = surface.point(w);
        let sun = self.shadow.as_ref().map_or(1.0, |s| s.share(&point, n));
        let mut out = self.lit(colour, self.facing(n), sun);
        let wide = n.map(f64::from);
        if self.light.specular > 0.0
            && let Some(viewer) = unit(&self.lens.toward_viewer(&point))
            && let Some(half) = unit(&add(&viewer, &self.light.toward))
        {
            let shine = (dot(&half, &wide).max(0.0) as f32).powi(SHININESS) * self.light.specular * sun;
            for c in &mut out[..3] {
                *c += shine;
            }
        }
        if let Some(occlusion) = &self.occlusion {
            let view = self.lens.view(&point);
            let (place, depth) = (self.lens.place(&view), self.lens.depth(view[2]) as f32);
            let open = occlusion.open(place, depth);
            for c in &mut out[..3] {
                *c *= open;
            }
        }
        out
    }

    /// The cosine between a unit normal and the light.
    fn facing(&self, n: [f32; 3]) -> f32 {
        let l = self.light.toward.map(|c| c as f32);
        n[0] * l[0] + n[1] * l[1] + n[2] * l[2]
    }

    #[inline(always)]
    fn lit(&self, colour: [f32; 4], facing: f32, sun: f32) -> [f32; 4] {
        let light = self.share(facing, sun);
        [colour[0] * light, colour[1] * light, colour[2] * light, colour[3]]
    }

    /// The share of light that a surface reflects.
    #[inline(always)]
    fn share(&self, facing: f32, sun: f32) -> f32 {
        let facing = if facing > 0.0 { facing } else { 0.0 };
        self.light.ambient + self.light.diffuse * facing * sun
    }
}

impl Round {
    /// The cosine between the normal and the light, at a place relative to the origin.
    #[inline(always)]
    fn facing(&self, x: f32, y: f32) -> f32 {
        let at = |k: usize| self.at[k] + self.by_x[k] * x + self.by_y[k] * y;
        let n = [at(0), at(1), at(2), at(3)];
        let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        if square > 0.0 { n[3] / square.sqrt() } else { 0.0 }
    }
}

#[inline(always)]
fn mixed(colours: &[[f32; 4]; 3], w: [f32; 3]) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| w[0] * colours[0][k] + w[1] * colours[1][k] + w[2] * colours[2][k])
}
