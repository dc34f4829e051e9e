//! From pieces of mesh edges to lines on paper:
//!
//! 1. `chain`     mesh edges that continue one another become chains (source edges come as chains already, and
//!    `candidates` are the contours of the mesh)
//! 2. `runs`      along a chain: equal states join, doubtful and short ones are settled, lines are cut out
//! 3. `coincident`     of lines that coincide on paper one is kept; visible beats hidden; `gaps` are what is left out
//! 4. `specks`    what is shorter than the accuracy, even with all it connects to, is dropped
//! 5. `simplify`  vertices that the accuracy does not need are left out
//!
//! Where others end (`ends`), creases of meshes keep their vertices. Their contours are smoothed instead
//! (`fit::smooth`).
//!
//! `cut` goes through these steps. `finish` puts the lines on their curves: then they are those of a drawing
//! (`drawing`).

pub mod camera;
pub mod candidates;
pub mod chain;
pub mod coincident;
pub mod cut;
pub mod drawing;
pub mod ends;
pub mod finish;
mod gaps;
pub mod runs;
pub mod simplify;
pub mod specks;

#[cfg(test)]
mod tests;

/// A line on paper with its twin in space, point for point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    pub chain: u32,
    pub visible: bool,
    pub flat: Vec<[f64; 2]>,
    pub space: Vec<[f64; 3]>,
}

/// Where depth is measured from, and along what; perspective views map depth z to 1 / z on paper.
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

    /// The parameter in space of the point at parameter t on paper, between depths za and zb.
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
