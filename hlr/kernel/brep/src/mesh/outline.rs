//! The loops of a face as one list of points with links from each to the next.

use super::face::{FaceLoops, Fault};
use super::progress::Progress;
use rustc_hash::FxHashMap;

/// Points of all loops, one loop after the other; then points that were added on poles.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<[f64; 3]>,
    pub nodes: Vec<u32>,
    before: Vec<u32>,
    after: Vec<u32>,
    /// Loop and number of each point in `FaceLoops`; points that were added on poles follow these.
    pub origin: Vec<(usize, usize)>,
    /// Points at the same place as an earlier point, each with that point. They are in no chord.
    aside: Vec<(u32, u32)>,
}

const NONE: u32 = u32::MAX;
/// Share of the outline's extent: neighbours this close in (u, v) count as one place. Ends of edges that miss their
/// vertex tangle within a smaller distance.
const SAME: f64 = 1e-6;

impl Outline {
    /// Chords whose ends share a node are poles: in space they are one point. `divide` may put points on them: it gets
    /// the ends of such a chord and appends shares of the way, in ascending order.
    pub fn new(face: &FaceLoops, divide: impl Fn([f64; 2], [f64; 2], &mut Vec<f64>)) -> Result<Outline, Fault> {
        let mut out = Outline::with_capacity(face.loops.iter().map(Vec::len).sum());
        for (number, points) in face.loops.iter().enumerate() {
            for (k, p) in points.iter().enumerate() {
                if !(p.uv.iter().chain(&p.point).all(|x| x.is_finite())) {
                    return Err(Fault::Degenerate);
                }
                out.add(p.uv, p.point, p.node, NONE, NONE);
                out.origin.push((number, k));
            }
        }
        let [low, high] = out.bounds();
        let near = [0, 1].map(|k| SAME * (high[k] - low[k]));
        let mut start = 0;
        for points in &face.loops {
            out.link(start, points.len() as u32, near)?;
            start += points.len() as u32;
        }
        out.divide_poles(divide);
        Ok(out)
    }

    /// Links the points of a loop into a ring, and sets aside those that repeat the place before them.
    fn link(&mut self, start: u32, count: u32, near: [f64; 2]) -> Result<(), Fault> {
        let at = |i: u32| (start + i % count.max(1)) as usize;
        let same = |i: usize, j: usize| {
            let (p, q) = (self.uv[i], self.uv[j]);
            (0..2).all(|k| (p[k] - q[k]).abs() <= near[k])
        };
        let Some(first) = (1..=count).find(|&i| !same(at(i - 1), at(i))) else {
            let one = (0..count).all(|i| self.nodes[at(i)] == self.nodes[start as usize]);
            return if one { Ok(()) } else { Err(Fault::Degenerate) };
        };
        let mut kept = Vec::with_capacity(count as usize);
        kept.push(at(first) as u32);
        let mut aside = Vec::new();
        for i in first + 1..first + count {
            let last = kept[kept.len() - 1];
            if same(last as usize, at(i)) {
                aside.push((at(i) as u32, last));
            } else {
                kept.push(at(i) as u32);
            }
        }
        for (k, &p) in kept.iter().enumerate() {
            let next = kept[(k + 1) % kept.len()];
            self.after[p as usize] = next;
            self.before[next as usize] = p;
        }
        for &(point, place) in &aside {
            self.uv[point as usize] = self.uv[place as usize];
        }
        self.aside.append(&mut aside);
        Ok(())
    }

    /// Restores points set aside that have a node of their own, each with a triangle of zero area.
    pub fn rejoin(&mut self, triangles: &mut Vec<[u32; 3]>, steps: &Progress) {
        let mut aside = std::mem::take(&mut self.aside);
        aside.retain(|&(point, beside)| self.nodes[point as usize] != self.nodes[beside as usize]);
        let mut around = at_places(aside.iter().map(|&(_, beside)| beside), triangles);
        for (point, beside) in aside.into_iter().rev() {
            let next = self.after[beside as usize];
            let turns = |t: &[u32; 3]| [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]);
            let on_chord = |[a, b, _]: &[u32; 3]| (*a == beside && *b == next) || (*a == next && *b == beside);
            let Some(near) = around.get_mut(&beside) else { continue };
            steps.steps(near.len() as u64);
            let found = near
                .iter()
                .enumerate()
                .find_map(|(k, &i)| Some((k, i, turns(&triangles[i]).into_iter().find(on_chord)?)));
            let Some((k, number, [a, b, c])) = found else { continue };
            // Of the two triangles the new one is at `beside`, and both are at `c`.
            near.remove(k);
            near.push(triangles.len());
            if let Some(near) = around.get_mut(&c) {
                near.push(triangles.len());
            }
            triangles[number] = if a == beside { [point, b, c] } else { [a, point, c] };
            triangles.push(if a == beside { [a, point, c] } else { [point, b, c] });
            self.after[beside as usize] = point;
            self.before[point as usize] = beside;
            self.after[point as usize] = next;
            self.before[next as usize] = point;
        }
    }

    /// The point at which each chord begins.
    pub fn chords(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        (0..self.uv.len() as u32).filter(|&c| self.after[c as usize] != NONE)
    }

    /// The chords that end or begin at a point, or at one set aside there; none at a point that is set aside itself.
    pub fn chords_at(&self, point: u32) -> impl Iterator<Item = u32> + '_ {
        let own = [self.before[point as usize], point].into_iter().filter(move |_| self.after[point as usize] != NONE);
        own.chain(self.aside.iter().filter(move |aside| aside.1 == point).map(|aside| aside.0))
    }

    fn divide_poles(&mut self, divide: impl Fn([f64; 2], [f64; 2], &mut Vec<f64>)) {
        let mut shares = Vec::new();
        for p in 0..self.origin.len() {
            if self.after[p] == NONE || !self.is_pole(p as u32) {
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
        // Adding zero turns minus zero into zero: the two differ where bits are compared.
        self.uv.push(uv.map(|x| x + 0.0));
        self.points.push(point);
        self.nodes.push(node);
        self.before.push(before);
        self.after.push(after);
    }

    fn with_capacity(count: usize) -> Outline {
        Outline {
            uv: Vec::with_capacity(count),
            points: Vec::with_capacity(count),
            nodes: Vec::with_capacity(count),
            before: Vec::with_capacity(count),
            after: Vec::with_capacity(count),
            origin: Vec::with_capacity(count),
            aside: Vec::new(),
        }
    }

    /// The same loops with other parameters.
    pub fn mapped(&self, map: impl Fn([f64; 2]) -> [f64; 2]) -> Outline {
        Outline {
            uv: self.uv.iter().map(|&p| map(p)).collect(),
            points: self.points.clone(),
            nodes: self.nodes.clone(),
            before: self.before.clone(),
            after: self.after.clone(),
            origin: self.origin.clone(),
            aside: self.aside.clone(),
        }
    }

    pub fn len(&self) -> usize {
        self.uv.len()
    }

    pub fn before(&self, point: u32) -> u32 {
        self.before[point as usize]
    }

    /// The point at which the chord from this point ends.
    pub fn after(&self, point: u32) -> u32 {
        self.after[point as usize]
    }

    /// Whether the chord from this point is a single point in space.
    pub fn is_pole(&self, point: u32) -> bool {
        self.nodes[point as usize] == self.nodes[self.after(point) as usize]
    }

    /// Smallest and largest parameters.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        self.uv
            .iter()
            .fold(start, |[low, high], p| [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))])
    }
}

/// The triangles at each of some points, by number.
fn at_places(places: impl Iterator<Item = u32>, triangles: &[[u32; 3]]) -> FxHashMap<u32, Vec<usize>> {
    let mut out: FxHashMap<u32, Vec<usize>> = places.map(|place| (place, Vec::new())).collect();
    if out.is_empty() {
        return out;
    }
    for (number, corners) in triangles.iter().enumerate() {
        for corner in corners {
            if let Some(found) = out.get_mut(corner) {
                found.push(number);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::LoopPoint;

    /// A loop around a polygon of so many corners, each of which is there twice, as two nodes.
    fn doubled(corners: u32) -> FaceLoops {
        let point = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i / 2) / f64::from(corners);
            let uv = [hlr_exact::elementary::cos(angle), hlr_exact::elementary::sin(angle)];
            LoopPoint { uv, point: [uv[0], uv[1], 0.0], node: i }
        };
        FaceLoops { loops: vec![(0..2 * corners).map(point).collect()], periods: [0.0; 2] }
    }

    #[test]
    fn points_that_were_set_aside_come_back_in_few_steps() {
        const CORNERS: u32 = 3000;
        let mut outline = Outline::new(&doubled(CORNERS), |_, _, _| ()).unwrap();
        let kept: Vec<u32> = outline.chords().collect();
        assert_eq!(kept.len(), CORNERS as usize);
        // Triangles in strips: no corner has more than a few.
        let (mut low, mut high, mut triangles) = (0, kept.len() - 1, Vec::new());
        while low + 1 < high {
            let next = if triangles.len() % 2 == 0 { low + 1 } else { high - 1 };
            triangles.push([kept[low], kept[next], kept[high]]);
            if triangles.len() % 2 == 1 { low = next } else { high = next }
        }
        let steps = Progress::free();
        outline.rejoin(&mut triangles, &steps);
        assert_eq!(triangles.len(), 2 * CORNERS as usize - 2);
        assert_eq!(outline.chords().count(), 2 * CORNERS as usize);
        for chord in outline.chords() {
            let next = outline.after(chord);
            let on = triangles.iter().filter(|t| t.contains(&chord) && t.contains(&next)).count();
            assert_eq!(on, 1, "each chord is the side of one triangle");
        }
        assert!(steps.count() < 8 * u64::from(CORNERS), "{} steps", steps.count());
    }
}
