//! The loops of a face as one list of points.

use super::{FaceLoops, Fault};

/// Points of all loops, one loop after the other; then points that were added on poles.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<[f64; 3]>,
    pub nodes: Vec<u32>,
    /// First point of each loop.
    pub starts: Vec<u32>,
    before: Vec<u32>,
    after: Vec<u32>,
    /// Loop and number of each point in `FaceLoops`; points that were added on poles follow these.
    pub origin: Vec<(usize, usize)>,
}

impl Outline {
    /// Chords whose ends share a node are poles: they are one place in space, and `divide` may put points on them. It gets
    /// the ends of such a chord and appends shares of the way, rising.
    pub fn new(face: &FaceLoops, divide: impl Fn([f64; 2], [f64; 2], &mut Vec<f64>)) -> Result<Outline, Fault> {
        let mut out = Outline::default();
        for (number, points) in face.loops.iter().enumerate() {
            if points.len() < 3 {
                return Err(Fault::Open);
            }
            let (start, count) = (out.uv.len() as u32, points.len() as u32);
            out.starts.push(start);
            for (p, k) in points.iter().zip(0..) {
                if !(p.uv.iter().chain(&p.point).all(|x| x.is_finite())) {
                    return Err(Fault::Degenerate);
                }
                out.add(p.uv, p.point, p.node, start + (k + count - 1) % count, start + (k + 1) % count);
                out.origin.push((number, k as usize));
            }
        }
        out.divide_poles(divide);
        Ok(out)
    }

    fn divide_poles(&mut self, divide: impl Fn([f64; 2], [f64; 2], &mut Vec<f64>)) {
        let mut shares = Vec::new();
        for p in 0..self.origin.len() {
            if !self.is_pole(p as u32) {
                continue;
            }
            let next = self.after[p];
            let (from, to) = (self.uv[p], self.uv[next as usize]);
            shares.clear();
            divide(from, to, &mut shares);
            let mut last = p as u32;
            for t in &shares {
                let uv = [0, 1].map(|i| from[i] + t * (to[i] - from[i]));
                if uv != self.uv[last as usize] && uv != to {
                    let new = self.uv.len() as u32;
                    self.add(uv, self.points[p], self.nodes[p], last, next);
                    self.after[last as usize] = new;
                    self.before[next as usize] = new;
                    last = new;
                }
            }
        }
    }

    fn add(&mut self, uv: [f64; 2], point: [f64; 3], node: u32, before: u32, after: u32) {
        // Minus zero would be another place than zero to whoever compares bits.
        self.uv.push(uv.map(|x| x + 0.0));
        self.points.push(point);
        self.nodes.push(node);
        self.before.push(before);
        self.after.push(after);
    }

    /// The same loops with other parameters.
    pub fn mapped(&self, map: impl Fn([f64; 2]) -> [f64; 2]) -> Outline {
        Outline { uv: self.uv.iter().map(|&p| map(p)).collect(), ..self.clone() }
    }

    pub fn len(&self) -> usize {
        self.uv.len()
    }

    pub fn before(&self, point: u32) -> u32 {
        self.before[point as usize]
    }

    /// The chord of a point leads to this one.
    pub fn after(&self, point: u32) -> u32 {
        self.after[point as usize]
    }

    /// Whether the chord from this point is one place in space.
    pub fn is_pole(&self, point: u32) -> bool {
        self.nodes[point as usize] == self.nodes[self.after(point) as usize]
    }

    /// Least and greatest parameters.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        self.uv
            .iter()
            .fold(start, |[low, high], p| [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))])
    }
}
