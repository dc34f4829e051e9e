//! Light: Lambert's, in linear light, from the viewer's shoulder; highlights, shadows and occlusion where asked for.

use super::Model;
use super::lens::Lens;
use super::occlusion::Occlusion;
use super::shadow::Shadow;
use super::surface::Surface;
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
pub struct Ready {
    surface: Surface,
    colours: [[f32; 4]; 3],
    /// One colour all over.
    plain: bool,
    /// The light where it is the same all over.
    constant: Option<[f32; 4]>,
}

impl Scene<'_> {
    pub fn ready(&self, triangle: u32) -> Ready {
        let surface = Surface::new(self.model, self.lens, triangle);
        let paint = self.model.paint[triangle as usize];
        let colours = paint.map(|i| self.model.colours[i as usize]);
        let plain = paint[0] == paint[1] && paint[1] == paint[2];
        let matt = self.light.specular == 0.0 && self.shadow.is_none();
        let constant = (plain && surface.flat && matt && self.occlusion.is_none())
            .then(|| self.lit(colours[0], self.facing(surface.normal([1.0, 0.0, 0.0])), 1.0));
        Ready { surface, colours, plain, constant }
    }

    /// Linear light and opacity of what is seen at a place, in pixels.
    #[inline(always)]
    pub fn shade(&self, ready: &Ready, place: [f64; 2]) -> [f32; 4] {
        match ready.constant {
            Some(colour) => colour,
            None => self.shade_anew(ready, place),
        }
    }

    #[inline(always)]
    fn shade_anew(&self, ready: &Ready, place: [f64; 2]) -> [f32; 4] {
        let surface = &ready.surface;
        let place = [place[0] - self.lens.centre[0], place[1] - self.lens.centre[1]];
        let plain = self.light.specular == 0.0 && self.shadow.is_none() && self.occlusion.is_none();
        if plain && ready.plain {
            return self.lit(ready.colours[0], surface.facing(place, self.light.toward.map(|c| c as f32)), 1.0);
        }
        let w = surface.weights(place);
        let n = surface.normal(w);
        let colour = mixed(&ready.colours, w);
        if plain {
            return self.lit(colour, self.facing(n), 1.0);
        }
        self.effects(surface, w, n, colour)
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
