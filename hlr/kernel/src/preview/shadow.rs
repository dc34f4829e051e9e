//! Shadows: what the light sees, looked up from what the viewer sees.
//!
//! L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978, with the edges softened after W. T. Reeves,
//! D. H. Salesin, R. L. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987: not depths are averaged but
//! the answers of neighbouring texels.

use super::Model;
use super::lens::Lens;
use super::maps::seen;
use super::workspace::Workspace;
use crate::geometry::vector::{Vector, along, dot};

/// In texels: how far along its normal a point is moved before it is looked up, so that no surface shades itself.
const LIFT: f64 = 3.0;
/// Texels along a side of the square over which answers are averaged: about two pixels of the picture.
const WIDE: usize = 5;

pub struct Shadow {
    lens: Lens,
    depth: Vec<f32>,
    /// Of a texel, in the model.
    texel: f64,
}

impl Shadow {
    /// `lens`: parallel, as the light looks. None when stopped.
    pub fn new(
        model: &Model,
        lens: Lens,
        space: &mut Workspace,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Option<Shadow> {
        let depth = seen(model, &lens, space, stopped)?.iter().map(|s| s.depth).collect();
        let texel = 1.0 / lens.scale;
        Some(Shadow { lens, depth, texel })
    }

    /// How much of the light reaches a point, 0 to 1; n is its unit normal on the viewer's side.
    pub fn share(&self, point: &Vector, n: [f32; 3]) -> f32 {
        let n = n.map(f64::from);
        let facing = -dot(&n, &self.lens.ahead);
        if facing <= 0.0 {
            return 1.0; // turned away: dark already
        }
        // The steeper the light falls, the farther depths of neighbouring texels lie apart.
        let slope = (1.0 - facing * facing).max(0.0).sqrt() / facing.max(0.1);
        let lifted = along(point, &n, LIFT * self.texel * (0.5 + slope.min(2.0)));
        let v = self.lens.view(&lifted);
        let place = self.lens.place(&v);
        let depth = self.lens.depth(v[2]) as f32;
        // The texels around, each weighted by how much of a square about the point it covers.
        let [x, y] = [place[0] - 0.5 * WIDE as f64, place[1] - 0.5 * WIDE as f64];
        let (i, j) = (x.floor(), y.floor());
        let (u, t) = ((x - i) as f32, (y - j) as f32);
        let weight = |k: usize, part: f32| match k {
            0 => 1.0 - part,
            WIDE => part,
            _ => 1.0,
        };
        let mut lit = 0.0;
        for row in 0..=WIDE {
            for column in 0..=WIDE {
                let free = self.at(i as i64 + column as i64, j as i64 + row as i64) >= depth;
                lit += weight(column, u) * weight(row, t) * f32::from(u8::from(free));
            }
        }
        lit / (WIDE * WIDE) as f32
    }

    fn at(&self, i: i64, j: i64) -> f32 {
        let [width, height] = self.lens.size.map(|c| c as i64);
        if (0..width).contains(&i) && (0..height).contains(&j) { self.depth[(j * width + i) as usize] } else { 2.0 }
    }
}
