//! Light: Lambert's, in linear light, from the viewer's shoulder; highlights, shadows and occlusion where asked for.

use super::Model;
use super::lens::Lens;
use super::occlusion::Occlusion;
use super::shadow::Shadow;
use super::surface::{Surface, normals};
use crate::geometry::vector::{add, dot, unit};

pub struct Light {
    /// Unit vector from the model toward the light, in the model.
    pub toward: [f64; 3],
    /// What a surface gives back wherever it is turned.
    pub ambient: f32,
    /// What it gives back more where it is turned to the light.
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

/// A triangle made ready: what is the same wherever on it one looks.
#[derive(Clone, Debug)]
pub enum Ready {
    /// One normal, one colour: one light.
    Flat([f32; 4]),
    Round(Round),
    Any(Box<Any>),
}

/// One colour, and a normal that turns. But for its length the interpolated normal is an affine function of the place: the
/// factor by which barycentric coordinates are off cancels.
#[derive(Clone, Debug)]
pub struct Round {
    colour: [f32; 4],
    /// The place to which `at` belongs.
    origin: [f64; 2],
    /// x, y, z of the normal and its product with the light: there, and how they grow by x and by y.
    at: [f32; 4],
    by_x: [f32; 4],
    by_y: [f32; 4],
}

#[derive(Clone, Debug)]
pub struct Any {
    surface: Surface,
    colours: [[f32; 4]; 3],
}

/// Pixels: a triangle lower than this is not interpolated affinely. A sample may lie a grid step outside of it, which is
/// nothing for larger ones.
const LOW: f64 = 1.0 / 16.0;

impl Scene<'_> {
    /// `place`: some place where the triangle is seen, in pixels.
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
        let surface = Surface::new(self.model, self.lens, triangle);
        if flat {
            return Ready::Flat(self.lit(colours[0], self.facing(surface.normal([1.0, 0.0, 0.0])), 1.0));
        }
        // The height over a side is one over the growth of the barycentric coordinate of the corner opposite.
        let steep = surface.rows.iter().any(|r| r[0] * r[0] + r[1] * r[1] > 1.0 / (LOW * LOW));
        if steep || self.lens.distance.is_some() {
            return Ready::Any(Box::new(Any { surface, colours }));
        }
        let origin = [place[0].floor(), place[1].floor()];
        let side = if surface.front { 1.0 } else { -1.0 };
        let mixed = |weight: &dyn Fn(&[f64; 3]) -> f64| {
            let w = [weight(&surface.rows[0]), weight(&surface.rows[1]), weight(&surface.rows[2])];
            let v = [0, 1, 2].map(|k| (0..3).map(|i| w[i] * f64::from(n[i][k])).sum::<f64>() * side);
            let light = dot(&v, &self.light.toward);
            [v[0] as f32, v[1] as f32, v[2] as f32, light as f32]
        };
        let from = [origin[0] - self.lens.centre[0], origin[1] - self.lens.centre[1]];
        Ready::Round(Round {
            colour: colours[0],
            origin,
            at: mixed(&|r| r[0] * from[0] + r[1] * from[1] + r[2]),
            by_x: mixed(&|r| r[0]),
            by_y: mixed(&|r| r[1]),
        })
    }

    /// Linear light and opacity of what is seen at a place, in pixels.
    #[inline(always)]
    pub fn shade(&self, ready: &Ready, place: [f64; 2]) -> [f32; 4] {
        match ready {
            Ready::Flat(colour) => *colour,
            Ready::Round(round) => {
                let (x, y) = ((place[0] - round.origin[0]) as f32, (place[1] - round.origin[1]) as f32);
                let at = |k: usize| round.at[k] + round.by_x[k] * x + round.by_y[k] * y;
                let n = [at(0), at(1), at(2), at(3)];
                let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
                self.lit(round.colour, if square > 0.0 { n[3] / square.sqrt() } else { 0.0 }, 1.0)
            }
            Ready::Any(any) => self.shade_any(any, place),
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

    /// What takes the point itself.
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
        let facing = if facing > 0.0 { facing } else { 0.0 };
        let light = self.light.ambient + self.light.diffuse * facing * sun;
        [colour[0] * light, colour[1] * light, colour[2] * light, colour[3]]
    }
}

#[inline(always)]
fn mixed(colours: &[[f32; 4]; 3], w: [f32; 3]) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| w[0] * colours[0][k] + w[1] * colours[1][k] + w[2] * colours[2][k])
}
