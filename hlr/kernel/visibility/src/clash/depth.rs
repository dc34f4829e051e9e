//! Measures how deep two crossing triangles go through each other's surfaces, and whether that is more than a contact.
//!
//! ```text
//!           |                         |
//!     ______|______ crosses     ______|______ stands on it: the triangle beyond the wall's lower edge is its
//!           |                    -----+       bottom, which goes no deeper
//! ```
//!
//! In meshes without B-rep the facets may be the shape itself, and bend by any angle: what their corners say is all
//! there is to know. Of B-reps the surface is followed near the crossing (`reach`): that a corner far away lies beyond
//! the other's plane says nothing about how deep it goes here.

use super::reach::{Sheet, Vec3, cross, dot, minus};
use super::search::Clash;
use hlr_accuracy::{CONTACT_OF_ONE_SOLID, FLUSH};

/// Sine: two tessellations of one curved surface never cross at more, turning by half a radian per chord at most.
pub const SLIGHT_ANGLE: f64 = 0.35;
/// Share of a triangle's size: planar faces are flat within this share of it.
const ROUNDING: f64 = 1e-9;

/// What is known of the surfaces. without_brep, touch: per group, a piece of a mesh without B-rep, and nearer than this
/// to another surface it touches it; curved: per triangle, of a face that is not planar, or that may be anything.
pub struct Bodies<'a> {
    pub sheet: Sheet<'a>,
    pub group: &'a [i32],
    pub curved: &'a [bool],
    pub without_brep: &'a [bool],
    pub touch: &'a [f64],
    pub deflection: f64,
}

/// Of one crossing.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    /// Model units: nearer than this the two touch.
    pub touch: f64,
    /// By how much it goes deeper than a contact; below zero where it does not.
    pub beyond: f64,
    /// One surface stands flush on the other.
    pub reach: f64,
}

impl Depth {
    /// Of a crossing at this angle: hardly any of the wall is beyond the face.
    pub fn flush(&self, sine: f64, deflection: f64) -> bool {
        self.reach < FLUSH * deflection && sine >= SLIGHT_ANGLE
    }
}

/// A triangle and the corners beyond its sides; a side beyond which nothing is, or several triangles are, has `apex` of
/// its own first corner or of one of these.
struct Around {
    corners: [Vec3; 3],
    apex: [Vec3; 3],
    /// The ends of the sides beyond which the surface goes on in the triangle's own plane.
    goes_on: [Option<[Vec3; 2]>; 3],
    /// Lengths that count as nothing.
    little: f64,
}

impl Bodies<'_> {
    /// Per group: part of a mesh without B-rep.
    pub fn groups(&self, clash: &Clash) -> [usize; 2] {
        clash.triangles.map(|t| self.group[t as usize] as usize)
    }

    /// middle: of the segment in which the two cross.
    pub fn depth(&self, clash: &Clash, middle: &Vec3) -> Depth {
        let ([a, b], groups) = (clash.triangles, self.groups(clash));
        let solid = !groups.iter().any(|&g| self.without_brep[g]);
        let mut touch = groups.iter().fold(0.0f64, |most, &g| most.max(self.touch[g]));
        if groups[0] == groups[1] && solid {
            touch *= CONTACT_OF_ONE_SOLID;
        }
        let (reach, mut level) = self.corners_beyond(clash);
        // A planar face is where it is, and how far a wall goes beyond it is known; a facet is not.
        let steep = clash.meeting.sine >= SLIGHT_ANGLE;
        let known = [a, b].map(|t| steep && !self.curved[t as usize]);
        let lever = self.lever(clash);
        let mut beyond = f64::INFINITY;
        for k in 0..2 {
            if known[k] {
                level[k] *= lever[k];
            }
            if solid {
                let here = self.sheet.reach(clash.triangles[k], clash.triangles[1 - k], middle, touch);
                let told = steep && !known[k] && here.is_finite();
                level[k] = if told { here } else { level[k].min(here) };
            }
            let forgiven = if known[k] { touch.min(FLUSH * self.deflection) } else { touch };
            beyond = beyond.min(level[k] - forgiven);
        }
        Depth { touch, beyond, reach }
    }

    /// How far each of two triangles, with those beyond its edges, reaches beyond the other's plane on its shallower
    /// side, the lesser of both; and how far the other triangle reaches beyond the plane of each, with no more than
    /// what goes on in its own plane beyond an edge along the crossing.
    fn corners_beyond(&self, clash: &Clash) -> (f64, [f64; 2]) {
        let around = clash.triangles.map(|t| self.around(t));
        let (mut every, mut level) = (f64::INFINITY, [0.0; 2]);
        for s in 0..2 {
            let (normal, other) = (&self.sheet.normals[clash.triangles[s] as usize], &around[1 - s]);
            let height = |p: &Vec3| dot(&minus(p, &around[s].corners[0]), normal);
            let (mut own, mut all) = (Span::default(), Span::default());
            other.corners.iter().for_each(|p| own.add(height(p)));
            for k in 0..3 {
                let high = height(&other.apex[k]);
                all.add(high);
                let along = |ends: [Vec3; 2]| ends.iter().all(|end| height(end).abs() <= other.little);
                if other.goes_on[k].is_some_and(along) {
                    own.add(high);
                }
            }
            level[s] = own.shallower();
            all.add(own.low);
            all.add(own.high);
            every = every.min(all.shallower());
        }
        (every, level)
    }

    fn around(&self, t: u32) -> Around {
        let sheet = &self.sheet;
        let triangle = sheet.triangles[t as usize];
        let corners = triangle.map(|v| sheet.points[v as usize]);
        let normal = &sheet.normals[t as usize];
        let mut apex = [corners[0]; 3];
        let mut sides = [None; 3];
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            let Ok(e) = sheet.edges.binary_search(&[a.min(b), a.max(b)]) else { continue };
            let beside = &sheet.incident[sheet.offsets[e] as usize..sheet.offsets[e + 1] as usize];
            let next = if beside[0] == t as i32 { beside.get(1) } else { beside.first() };
            let Some(&next) = next else { continue };
            let Some(v) = sheet.triangles[next as usize].into_iter().find(|&v| v != a && v != b) else { continue };
            apex[k] = sheet.points[v as usize];
            sides[k] = Some([a, b].map(|v| sheet.points[v as usize]));
        }
        let spread = |c: usize| {
            let mut span = Span::default();
            corners.iter().chain(&apex).for_each(|p| span.add(p[c]));
            span.high - span.low
        };
        let little = ROUNDING * (0..3).map(spread).fold(0.0, f64::max);
        let flat = |k: usize| dot(&minus(&apex[k], &corners[0]), normal).abs() <= little;
        let goes_on = [0, 1, 2].map(|k| sides[k].filter(|_| flat(k)));
        Around { corners, apex, goes_on, little }
    }

    /// At most 1: how much of what is measured from each triangle's plane is certain, so far out as the other goes.
    ///
    /// What is rounded at the corners of a sliver tilts its plane, the more, the less high it is.
    fn lever(&self, clash: &Clash) -> [f64; 2] {
        let size = clash.triangles.map(|t| {
            let [p, q, r] = self.sheet.triangles[t as usize].map(|v| self.sheet.points[v as usize]);
            let sides = [minus(&q, &p), minus(&r, &q), minus(&p, &r)];
            let area = cross(&sides[0], &sides[1]);
            let longest = sides.iter().map(|s| dot(s, s)).fold(0.0, f64::max);
            (longest.sqrt(), dot(&area, &area).sqrt())
        });
        [0, 1].map(|k| {
            let lever = size[k].1 / size[k].0 / size[1 - k].0;
            if lever.is_nan() { 0.0 } else { lever.min(1.0) }
        })
    }
}

#[derive(Clone, Copy)]
struct Span {
    low: f64,
    high: f64,
}

impl Default for Span {
    fn default() -> Span {
        Span { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

impl Span {
    fn add(&mut self, x: f64) {
        (self.low, self.high) = (self.low.min(x), self.high.max(x));
    }

    /// How far it reaches beyond zero on the side where it does so less.
    fn shallower(&self) -> f64 {
        self.high.min(-self.low)
    }
}
