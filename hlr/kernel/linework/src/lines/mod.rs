//! From pieces of mesh edges to lines on paper:
//!
//! 1. `chain`       mesh edges that continue one another become chains (edges of the source are chains already;
//!    `candidates` adds the contours of the mesh)
//! 2. `runs`        along a chain (`geometry`) equal states join, doubtful and short runs are decided, and lines are cut
//!    out; `loops` are cut off the contours of meshes
//! 3. `turned`      a line that runs back over itself begins where that leaves one line
//! 4. `coincident`  of lines that coincide on paper one is kept, visible before hidden; `gaps` cuts out the others,
//!    `stretches` says what covers what, `owners` whose lines may be farther apart, `short_pieces` which of those give
//!    way, `pairs` finds those beside one another, `drawn` where there are very many, both in square `cells` of the paper
//! 5. `specks`      figures shorter than the accuracy, with all they connect to, are dropped
//! 6. `simplify`    vertices that the accuracy does not need are left out
//!
//! Creases of meshes keep their vertices where other lines end (`ends`). Contours of meshes are smoothed instead
//! (`fit::smooth`).
//!
//! `cut` runs these steps. `finish` puts the lines on their curves and returns the lines of a `drawing`.

pub mod camera;
pub mod candidates;
mod cells;
pub mod chain;
pub mod coincident;
pub mod cut;
pub mod drawing;
mod drawn;
pub mod ends;
pub mod finish;
mod gaps;
pub mod geometry;
mod loops;
mod meetings;
mod members;
pub mod owners;
mod pairs;
pub mod runs;
pub mod short_pieces;
pub mod simplify;
pub mod specks;
mod stretches;
pub mod turned;

#[cfg(test)]
mod tests;

use hlr_brep::geometry::vector::{cross, dot, sub, unit};

/// A line as points on paper and the same points in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    pub chain: u32,
    pub visible: bool,
    /// Whether it goes on beyond its start, and beyond its end, where another line coincides with it and is drawn instead.
    pub left_out: [bool; 2],
    pub flat: Vec<[f64; 2]>,
    pub space: Vec<[f64; 3]>,
}

/// The origin and direction of depth. Along a line on paper, z is linear in a parallel view, and 1 / z in perspective.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub origin: [f64; 3],
    pub away: [f64; 3],
    pub perspective: bool,
}

impl View {
    pub fn depth(&self, p: &[f64; 3]) -> f64 {
        let q = [0, 1, 2].map(|k| p[k] - self.origin[k]);
        q[0] * self.away[0] + q[1] * self.away[1] + q[2] * self.away[2]
    }

    /// Two directions across the line of sight, at right angles.
    pub fn across(&self) -> [[f64; 3]; 2] {
        let least = (0..3).min_by(|&i, &j| self.away[i].abs().total_cmp(&self.away[j].abs())).unwrap_or(0);
        let right = cross(&self.away, &[0, 1, 2].map(|k| if k == least { 1.0 } else { 0.0 }));
        let right = unit(&right).unwrap_or([0.0; 3]);
        [right, cross(&right, &self.away)]
    }

    /// Where a point is in the image, along two directions `across`, and what a length there is divided by; None beside
    /// the eye or behind it.
    pub fn seen(&self, p: &[f64; 3], across: &[[f64; 3]; 2]) -> Option<([f64; 2], f64)> {
        let depth = if self.perspective { self.depth(p) } else { 1.0 };
        let from = sub(p, &self.origin);
        (depth > 0.0).then(|| (across.map(|way| dot(&from, &way) / depth), depth))
    }

    /// The parameter in space of the point at parameter t on paper, on a segment between depths za and zb.
    pub fn in_space(&self, t: f64, za: f64, zb: f64) -> f64 {
        if self.perspective { t * za / (t * za + (1.0 - t) * zb) } else { t }
    }
}

pub fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    (x * x + y * y).sqrt()
}

impl Polyline {
    pub fn length(&self) -> f64 {
        self.flat.windows(2).map(|w| distance(&w[0], &w[1])).sum()
    }
}
