//! Measures how deep two crossing triangles go through each other's surfaces, and whether that is more than a contact.
//!
//! ```text
//!           |                         |
//!     ______|______ crosses     ______|______ stands on it: beyond the wall's lower edge follows its
//!           |                    -----+       bottom, which goes no deeper
//! ```
//!
//! On B-reps the surface is followed near the crossing (`reach`): a corner far away that lies beyond the other's plane
//! does not tell how deep the surface goes here. In meshes without B-rep the facets may be the shape itself, and bend by
//! any angle: their corners decide. Where facets of two bodies cross at more than a small angle the surface is followed,
//! too, for a row of corners may lie right at the plane, and triangles may be as small as the accuracy; at smaller angles
//! where they are that small.

use super::planes::{Plane, Planes};
use super::reach::{Sheet, Vec3};
use super::search::Clash;
use hlr_accuracy::{CONTACT_AT_RIGHT_ANGLES, CONTACT_OF_ONE_SOLID, CONTACT_POINT, FLUSH, INTERSECTION_SHALLOW};
use hlr_mesh::vector::{dot, sub};

/// Sine of an angle: two tessellations of one curved surface never cross at more, as chords turn by at most half a
/// radian.
pub const SLIGHT_ANGLE: f64 = 0.35;
/// The same of an angle at which facets of one curved surface cross that is divided in two ways. Two bodies that meet at
/// less are judged by their corners alone: their line would run to and fro between facets.
const FACETS_ANGLE: f64 = 0.1;
/// Planar faces are flat within this share of a triangle's size.
const ROUNDING: f64 = 1e-9;

/// What is known of the surfaces. `without_brep`: per group, whether it belongs to a mesh without B-rep. `touch`: per
/// group, the distance (model units) within which it touches another surface. `face`: per triangle its planar face, or
/// NO_PLANE. `planes`: of all planar faces that take part in a clash.
pub struct Bodies<'a> {
    pub sheet: Sheet<'a>,
    pub group: &'a [i32],
    pub face: &'a [i32],
    pub planes: &'a Planes,
    pub without_brep: &'a [bool],
    pub touch: &'a [f64],
    pub deflection: f64,
}

/// The depth of one crossing; lengths in model units.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    /// Within this distance the two surfaces touch.
    pub touch: f64,
    /// How far one surface goes beyond the other on its shallower side, near the crossing.
    pub level: f64,
    /// How much deeper that is than a contact at right angles; negative for a contact.
    pub beyond: f64,
    /// How much deeper that is than the whole contact depth.
    pub certain: f64,
    /// How far one surface reaches beyond the other; hardly at all where it stands flush on it.
    pub reach: f64,
}

impl Depth {
    /// Whether one surface stands flush on the other: it is steep (`sine`), and reaches hardly beyond it.
    pub fn flush(&self, sine: f64, deflection: f64) -> bool {
        self.reach < FLUSH * deflection && sine >= SLIGHT_ANGLE
    }
}

/// A triangle and the opposite corners of its neighbours (`apex`). Where a side has no neighbour, `apex` is the
/// triangle's own first corner; where it has several, the corner of one of them.
struct Around {
    corners: [Vec3; 3],
    apex: [Vec3; 3],
    /// The ends of the sides beyond which the surface continues in the triangle's own plane.
    goes_on: [Option<[Vec3; 2]>; 3],
    /// Shorter lengths count as 0.
    little: f64,
}

impl Bodies<'_> {
    /// The groups of both triangles.
    pub fn groups(&self, clash: &Clash) -> [usize; 2] {
        clash.triangles.map(|t| self.group[t as usize] as usize)
    }

    /// Whether both surfaces have a B-rep.
    pub fn of_breps(&self, clash: &Clash) -> bool {
        !self.groups(clash).iter().any(|&g| self.without_brep[g])
    }

    /// The depth of a clash. `ends`: of the segment in which the two triangles cross.
    pub fn depth(&self, clash: &Clash, ends: [&Vec3; 2]) -> Depth {
        let middle = &[0, 1, 2].map(|k| (ends[0][k] + ends[1][k]) / 2.0);
        let groups = self.groups(clash);
        let solid = self.of_breps(clash);
        let mut touch = groups.iter().fold(0.0f64, |most, &g| most.max(self.touch[g]));
        if groups[0] == groups[1] && solid {
            touch *= CONTACT_OF_ONE_SOLID;
        }
        // Up to this depth surfaces are followed.
        let most = touch.max(INTERSECTION_SHALLOW * self.deflection);
        let planes = clash.triangles.map(|t| self.planes.get(self.face[t as usize]));
        let across = clash.triangles.map(|t| self.across(t));
        let (reach, mut level) = self.corners_beyond(clash, &across);
        let steep = clash.meeting.sine >= SLIGHT_ANGLE;
        let two_bodies = groups[0] != groups[1];
        // A triangle that has only a corner or a side on the other's plane does not tell which way the surfaces cross.
        let astride = level[0].min(level[1]) > CONTACT_POINT * touch;
        let come_apart = |asked| if asked { self.sheet.apart(clash.triangles, middle, most) } else { f64::INFINITY };
        let apart = come_apart(solid && !steep && astride);
        // Of a mesh that meets itself its corners decide, and so they do where large facets cross at a small angle.
        let meshes_followed = !solid && two_bodies && (steep || self.is_fine(clash, touch));
        let meshes_apart = come_apart(meshes_followed);
        // Two planar faces in nearly one plane come apart by what their file rounded, over any length: that closes no gap
        // between lines (`level`), and only where it is more than a contact is it a line (`beyond`).
        let curved = planes.iter().any(Option::is_none);
        // Depth is measured at right angles to the surfaces. An edge that lies deeper than this behind one is hidden by it
        // in some views, so from here on the line has to be there. Facets of meshes without B-rep cross by any depth where
        // two of them stand for one curved surface, but only at small angles.
        let one_solid = solid && groups[0] == groups[1];
        let at_right_angles = if one_solid || !(solid || steep) { 1.0 } else { CONTACT_AT_RIGHT_ANGLES };
        let (mut beyond, mut certain) = (f64::INFINITY, f64::INFINITY);
        for k in 0..2 {
            if curved && apart.is_finite() {
                level[k] = apart;
            } else if solid || meshes_followed {
                let reach = || self.sheet.reach(&across[k].normal, clash.triangles[1 - k], middle, most);
                let here = if solid || steep { reach() } else { meshes_apart };
                if solid {
                    level[k] = if steep && here.is_finite() { here } else { level[k].min(here) };
                } else if here.is_finite() {
                    // The plane of a facet that noise has tilted runs through the other surface, however nearly the two
                    // coincide: how far they leave one another counts as well.
                    level[k] = level[k].max(here.min(meshes_apart));
                }
            }
            let deep = if apart.is_finite() { apart } else { level[k] };
            // A planar face has no chord error: how far a wall goes beyond it is known, and another planar face at any
            // angle.
            let (forgiven, most_forgiven) = match (planes[k], planes[1 - k]) {
                (Some(plane), other) if steep || other.is_some() => {
                    let rounded = touch.min(FLUSH * self.deflection + plane.off);
                    (rounded, rounded)
                }
                _ => (touch * at_right_angles, touch),
            };
            beyond = beyond.min(deep - forgiven);
            certain = certain.min(deep - most_forgiven);
        }
        let way = sub(ends[1], ends[0]);
        if solid && dot(&way, &way).sqrt() <= CONTACT_POINT * self.deflection {
            // A corner that touches: there is no direction in which its depth could be measured.
            (beyond, certain) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        }
        let level = level[0].min(level[1]);
        // The surface goes on beyond a triangle that has no more than a corner on the other side, and beyond its
        // neighbours too.
        let reach = if steep && (solid || two_bodies) { reach.max(level) } else { reach };
        Depth { touch, level, beyond, certain, reach }
    }

    /// Whether a triangle is so small that its corners tell nothing, where meshes cross at a small angle: however deep the
    /// one is sunk into the other, they lie in no more than twice the contact.
    fn is_fine(&self, clash: &Clash, touch: f64) -> bool {
        let longest = |t: u32| {
            let [a, b, c] = self.sheet.triangles[t as usize].map(|v| self.sheet.points[v as usize]);
            [sub(&b, &a), sub(&c, &b), sub(&a, &c)].iter().map(|side| dot(side, side)).fold(0.0, f64::max).sqrt()
        };
        let [one, other] = clash.triangles.map(longest);
        let sine = clash.meeting.sine;
        sine >= FACETS_ANGLE && sine * one.min(other) <= 2.0 * touch
    }

    /// Two measures. First: how far each triangle with its neighbours reaches beyond the other's plane on its shallower
    /// side, the lesser of both. Second, for the plane of each: how far the other triangle reaches beyond it, with only
    /// those neighbours beyond an edge along the crossing that lie in its own plane.
    fn corners_beyond(&self, clash: &Clash, across: &[Plane; 2]) -> (f64, [f64; 2]) {
        let around = clash.triangles.map(|t| self.around(t));
        let (mut every, mut level) = (f64::INFINITY, [0.0; 2]);
        for s in 0..2 {
            let (height, other) = (|p: &Vec3| across[s].height(p), &around[1 - s]);
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
            let Some(edge) = sheet.edge(t, k) else { continue };
            let beside = sheet.along(edge);
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
        let flat = |k: usize| dot(&sub(&apex[k], &corners[0]), normal).abs() <= little;
        let goes_on = [0, 1, 2].map(|k| sides[k].filter(|_| flat(k)));
        Around { corners, apex, goes_on, little }
    }

    /// The plane of a triangle: that of its whole face where it is planar.
    fn across(&self, t: u32) -> Plane {
        let own = || {
            let corner = self.sheet.triangles[t as usize][0];
            Plane { origin: self.sheet.points[corner as usize], normal: self.sheet.normals[t as usize], off: 0.0 }
        };
        self.planes.get(self.face[t as usize]).copied().unwrap_or_else(own)
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

    /// How far the range reaches beyond zero, on the side where it reaches less.
    fn shallower(&self) -> f64 {
        self.high.min(-self.low)
    }
}
