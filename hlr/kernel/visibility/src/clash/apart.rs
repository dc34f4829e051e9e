//! Measures how far two surfaces that cross at a small angle come apart, on either side of where they cross.
//!
//! ```text
//!    \__  first         From the middle of the common segment, the cross-sections of both surfaces are followed side by
//!   ____\x______        side, until they cross again or one of them ends. Their greatest distance is how deep one goes
//!   second \___  gap    beyond the other. Two tessellations of one surface cross at every facet: there it is small.
//! ```

use super::reach::{Exit, PARALLEL, STEPS, Sheet, Vec3};
use hlr_mesh::vector::{cross, dot};

/// The cross-section of one surface. `from`, `to`: the ends of its piece on the current triangle, as (along, up).
struct Section {
    triangle: u32,
    side: usize,
    from: [f64; 2],
    to: [f64; 2],
}

/// Where the cross-sections lie: they run through `at`, in the plane with the normal `across`; `along` and `up` span it.
struct Frame<'a> {
    at: &'a Vec3,
    across: Vec3,
    along: Vec3,
    up: Vec3,
}

impl Frame<'_> {
    fn flat(&self, exit: &Exit) -> [f64; 2] {
        [dot(&exit.place, &self.along), dot(&exit.place, &self.up)]
    }
}

impl Section {
    /// The section that leaves a triangle forward; None if it cannot be followed.
    fn begin(sheet: &Sheet, frame: &Frame, triangle: u32) -> Option<Section> {
        let exits = sheet.exits(triangle, frame.at, &frame.across)?;
        let (exit, to) = exits.iter().map(|e| (e, frame.flat(e))).max_by(|a, b| a.1[0].total_cmp(&b.1[0]))?;
        (to[0] > 0.0).then_some(Section { triangle, side: exit.side, from: [0.0; 2], to })
    }

    /// Goes on to the next triangle; None where the surface ends, has a sharp edge or turns back.
    fn next(self, sheet: &Sheet, frame: &Frame) -> Option<Section> {
        let edge = sheet.edge(self.triangle, self.side)?;
        // However little it turns there: a pocket ends at its rim, and what touches it may go on beyond.
        if sheet.sharp(edge) {
            return None;
        }
        let (triangle, exit) = sheet.onward(self.triangle, edge, frame.at, &frame.across)?;
        let to = frame.flat(&exit);
        (to[0] > self.to[0]).then_some(Section { triangle, side: exit.side, from: self.to, to })
    }

    /// Cosine of its slope: what is apart by a height is nearer by so much, at right angles.
    fn flatness(&self) -> f64 {
        let [along, up] = [0, 1].map(|k| self.to[k] - self.from[k]);
        along / (along * along + up * up).sqrt()
    }

    fn height(&self, along: f64) -> f64 {
        let t = ((along - self.from[0]) / (self.to[0] - self.from[0])).clamp(0.0, 1.0);
        self.from[1] + t * (self.to[1] - self.from[1])
    }
}

/// The way along both surfaces on one side of the crossing.
struct Side<'a> {
    frame: Frame<'a>,
    /// The sections so far; None once they cross again, or one cannot be followed.
    ahead: Option<[Section; 2]>,
    /// The greatest distance so far, up or down; infinite where no section can be followed.
    widest: f64,
    steps: usize,
}

impl<'a> Side<'a> {
    fn new(sheet: &Sheet, frame: Frame<'a>, [a, b]: [u32; 2]) -> Side<'a> {
        let ahead = Section::begin(sheet, &frame, a).zip(Section::begin(sheet, &frame, b)).map(|(a, b)| [a, b]);
        let widest = if ahead.is_some() { 0.0 } else { f64::INFINITY };
        Side { frame, ahead, widest, steps: 0 }
    }

    /// Goes on to where the next of the two sections leaves its triangle.
    fn advance(&mut self, sheet: &Sheet) {
        let Some([a, b]) = self.ahead.take() else { return };
        let here = a.to[0].min(b.to[0]);
        let gap = (a.height(here) - b.height(here)) * a.flatness().min(b.flatness());
        if gap * self.widest < 0.0 {
            return;
        }
        if gap.abs() > self.widest.abs() {
            self.widest = gap;
        }
        self.steps += 1;
        if self.steps == STEPS {
            return;
        }
        let (done_a, done_b) = (a.to[0] <= here, b.to[0] <= here);
        let ahead = |section: Section, done| if done { section.next(sheet, &self.frame) } else { Some(section) };
        self.ahead = ahead(a, done_a).and_then(|a| Some([a, ahead(b, done_b)?]));
    }
}

impl Sheet<'_> {
    /// How far the surfaces of two triangles that cross at `at` come apart on the side where that is less, in model
    /// units, followed until it is `most`. Infinite where it cannot be measured.
    pub fn apart(&self, of: [u32; 2], at: &Vec3, most: f64) -> f64 {
        let normals = of.map(|t| self.normals[t as usize]);
        let across = cross(&normals[0], &normals[1]);
        let sine = dot(&across, &across).sqrt();
        if sine < PARALLEL {
            return f64::INFINITY;
        }
        let across = across.map(|c| c / sine);
        let same = if dot(&normals[0], &normals[1]) < 0.0 { -1.0 } else { 1.0 };
        let up = [0, 1, 2].map(|k| normals[0][k] + same * normals[1][k]);
        let size = dot(&up, &up).sqrt();
        let up = up.map(|c| c / size);
        let along = cross(&across, &up);
        let mut sides = [along, along.map(|c| -c)].map(|along| Side::new(self, Frame { at, across, along, up }, of));
        loop {
            // The lesser distance counts: once one side has ended, the other is followed only while it has less.
            let ended = sides.iter().filter(|side| side.ahead.is_none());
            let limit = ended.map(|side| side.widest.abs()).fold(most, f64::min);
            let mut followed = false;
            for side in sides.iter_mut().filter(|side| side.ahead.is_some() && side.widest.abs() < limit) {
                side.advance(self);
                followed = true;
            }
            if !followed {
                return sides[0].widest.abs().min(sides[1].widest.abs());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::Edges;
    use super::*;
    use hlr_mesh::kinds::{INTERIOR, SHARP};
    use hlr_mesh::topology;

    /// How far two surfaces come apart, each a profile of (x, z) drawn out along y, where their pieces numbered `cross`
    /// cross. All edges are of one class.
    fn apart(profiles: [&[[f64; 2]]; 2], cross: [usize; 2], kind: u8) -> f64 {
        let (mut points, mut triangles, mut of) = (Vec::new(), Vec::new(), [0; 2]);
        for (k, profile) in profiles.iter().enumerate() {
            let first = points.len() as i32;
            of[k] = triangles.len() as u32 + 2 * cross[k] as u32;
            points.extend(profile.iter().flat_map(|&[x, z]| [[x, -5.0, z], [x, 5.0, z]]));
            for piece in 0..profile.len() as i32 - 1 {
                let a = first + 2 * piece;
                triangles.extend([[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]);
            }
        }
        let t = topology::topology(&triangles, points.len());
        let normals = &topology::normals(&points, &triangles)[..];
        let kinds = &vec![kind; t.edges.len()][..];
        let edges = Edges { edges: &t.edges, offsets: &t.offsets, incident: &t.incident };
        let sheet = Sheet::new(&points, (&triangles, normals), (edges, kinds));
        let [[p, q], [r, s]] = [0, 1].map(|k| [profiles[k][cross[k]], profiles[k][cross[k] + 1]]);
        let height = |a: [f64; 2], b: [f64; 2], x: f64| a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
        let gap = |x: f64| height(p, q, x) - height(r, s, x);
        let (low, high) = (p[0].max(r[0]), q[0].min(s[0]));
        let x = low + (high - low) * gap(low) / (gap(low) - gap(high));
        // Near the sides y = -5 of both pieces, where their first triangles are.
        let at = [x, -4.9, height(p, q, x)];
        let found = sheet.apart(of, &at, 100.0);
        assert_eq!(found, sheet.apart([of[1], of[0]], &at, 100.0), "whichever comes first");
        found
    }

    const FLOOR: [[f64; 2]; 4] = [[-9.0, 0.0], [-1.8, 0.0], [0.4, 0.0], [9.0, 0.0]];

    #[test]
    fn surfaces_come_apart_until_they_cross_again() {
        let dome = [[-6.0, -1.0], [-2.0, -0.2], [-1.0, 0.1], [1.0, 0.3], [2.0, 0.1], [3.0, -0.3], [5.0, -3.0]];
        let found = apart([&FLOOR, &dome], [1, 1], INTERIOR);
        assert!((found - 0.3).abs() < 0.01, "{found}");
    }

    #[test]
    fn surfaces_come_apart_until_one_ends() {
        let ramp = [[-6.0, -1.0], [-2.0, -0.2], [-1.0, 0.1]];
        let found = apart([&FLOOR, &ramp], [1, 1], INTERIOR);
        assert!((found - 0.1).abs() < 0.01, "{found}");
        let bent = [[-6.0, -1.0], [-2.0, -0.2], [-1.0, 0.1], [0.0, 0.9], [1.0, 2.0]];
        assert!((apart([&FLOOR, &bent], [1, 1], SHARP) - 0.1).abs() < 0.01, "at a sharp edge");
        assert!(apart([&FLOOR, &bent], [1, 1], INTERIOR) > 0.9);
    }

    #[test]
    fn two_tessellations_of_one_surface_stay_together() {
        // As far round as both are steep.
        let arc = |first: f64| -> Vec<[f64; 2]> {
            let turns = (0..23).map(|k| (first + 8.0 * f64::from(k)).to_radians());
            turns.map(|turn| [-10.0 * turn.cos(), 10.0 * turn.sin()]).collect()
        };
        let found = apart([&arc(1.0), &arc(5.0)], [10, 10], INTERIOR);
        assert!(found > 0.0 && found < 10.0 * (1.0 - 4f64.to_radians().cos()) * 1.01, "{found}");
    }
    #[test]
    fn distances_are_taken_at_right_angles() {
        // Far from where they cross the walls are steep, and one lies high above the other.
        let dome = |middle: f64| -> Vec<[f64; 2]> {
            let turns = (0..41).map(|k| (4.0 * f64::from(k) - 80.0).to_radians());
            turns.map(|turn| [middle + 10.0 * turn.sin(), 10.0 * turn.cos()]).collect()
        };
        let found = apart([&dome(0.0), &dome(0.3)], [20, 19], INTERIOR);
        assert!(found > 0.2 && found < 0.31, "{found}");
    }
}
