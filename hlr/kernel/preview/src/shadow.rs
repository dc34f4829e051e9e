//! Shadows: a depth map from the light, looked up for each visible point.
//!
//! L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978. Edges are softened after W. T. Reeves, D.
//! H. Salesin, R. L. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987: the results of the depth
//! comparisons of neighbouring texels are averaged, not their depths.
//!
//! A transparent face takes a share of the light equal to its opacity. A texel stores the depths of its first and its
//! last transparent layer: a point between them is behind the first one only, a point beyond them behind all.

use super::depth_map::depth_map;
use super::faces::faces;
use super::grid::{TILE_HEIGHT, TILE_WIDTH};
use super::lens::Lens;
use super::sampling::Sampling;
use super::tiles::each_tile;
use super::transparent::{Layer, layers};
use super::workspace::Workspace;
use super::{Model, NOTHING};
use hlr_brep::geometry::vector::{Vector, along, dot};

/// Texels: how far a point is moved along its normal before it is looked up, so that no surface shadows itself.
const LIFT: f64 = 3.0;
/// Side in texels of the square over which comparisons are averaged: about two pixels of the picture.
const WIDE: usize = 5;

/// The transparent layers in a texel that the light passes before it meets an opaque face.
#[derive(Clone, Copy)]
struct Glass {
    /// Depth of the first layer, and of the last; 2 for none.
    first: f32,
    last: f32,
    /// Share of the light left behind the first layer, and behind all.
    left: f32,
    rest: f32,
}

impl Glass {
    const NONE: Glass = Glass { first: 2.0, last: 2.0, left: 1.0, rest: 1.0 };

    fn through(&self, depth: f32) -> f32 {
        if depth <= self.first {
            1.0
        } else if depth <= self.last {
            self.left
        } else {
            self.rest
        }
    }
}

pub struct Shadow {
    lens: Lens,
    /// Depth of the nearest opaque face, per texel.
    depth: Vec<f32>,
    /// Transparent layers per texel; empty where all faces are opaque.
    transparent: Vec<Glass>,
    /// Size of a texel in model units.
    texel: f64,
}

impl Shadow {
    /// `lens`: a parallel view in the direction of the light. None when stopped.
    pub fn new(
        model: &Model,
        lens: Lens,
        space: &mut Workspace,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Option<Shadow> {
        let texel = 1.0 / lens.scale;
        if !model.transparent.contains(&true) {
            let depth = depth_map(model, &lens, space, stopped)?.iter().map(|s| s.depth).collect();
            return Some(Shadow { lens, depth, transparent: Vec::new(), texel });
        }
        let sampling = Sampling::CENTRES;
        if !faces(model, &lens, &sampling, space, stopped) {
            return None;
        }
        let [width, height] = lens.size;
        let nothing = (2.0f32, Glass::NONE);
        let mut found = vec![nothing; width * height];
        let done = each_tile(
            space,
            lens.size,
            &sampling,
            model.transparent,
            &mut found,
            None,
            stopped,
            Vec::new,
            |over: &mut Vec<Layer>, filled, rows| {
                layers(filled.tile, filled.transparent, filled.first, &sampling, over);
                let left = filled.first[0];
                for (j, row) in rows.chunks_mut(width).take(TILE_HEIGHT).enumerate() {
                    for (i, texel) in row[left..].iter_mut().take(TILE_WIDTH).enumerate() {
                        if filled.tile.triangle(i, j) != NOTHING {
                            texel.0 = filled.tile.depth(i, j);
                        }
                    }
                }
                for own in over.chunk_by(|a, b| a.sample == b.sample) {
                    let at = own[0].sample as usize;
                    rows[at / TILE_WIDTH * width + left + at % TILE_WIDTH].1 = through(model, own);
                }
            },
        );
        let transparent = found.iter().map(|f| f.1).collect();
        let depth = found.into_iter().map(|f| f.0).collect();
        done.then_some(Shadow { lens, depth, transparent, texel })
    }

    /// Share of the light that reaches a point, 0 to 1; n is its unit normal on the viewer's side.
    pub fn share(&self, point: &Vector, n: [f32; 3]) -> f32 {
        let n = n.map(f64::from);
        let facing = -dot(&n, &self.lens.ahead);
        if facing <= 0.0 {
            return 1.0; // turned away from the light: dark already
        }
        // The more grazing the light, the more the depths of neighbouring texels differ.
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
                let free = self.at(i as i64 + column as i64, j as i64 + row as i64, depth);
                lit += weight(column, u) * weight(row, t) * free;
            }
        }
        lit / (WIDE * WIDE) as f32
    }

    /// Share of the light that reaches a depth in a texel.
    fn at(&self, i: i64, j: i64, depth: f32) -> f32 {
        let [width, height] = self.lens.size.map(|c| c as i64);
        if !(0..width).contains(&i) || !(0..height).contains(&j) {
            return 1.0;
        }
        let at = (j * width + i) as usize;
        if self.depth[at] < depth {
            return 0.0;
        }
        self.transparent.get(at).map_or(1.0, |g| g.through(depth))
    }
}

/// `own`: the layers of one texel, the farthest first.
fn through(model: &Model, own: &[Layer]) -> Glass {
    let left = |l: &Layer| 1.0 - model.colours[model.paint[l.triangle as usize][0] as usize][3];
    let (last, first) = (&own[0], &own[own.len() - 1]);
    Glass { first: first.depth, last: last.depth, left: left(first), rest: own.iter().map(left).product() }
}
