//! f = N . v on the surface of one face, in model coordinates, with its roots and derivatives.

use std::f64::consts::TAU;

use super::Model;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, add, along, cross, dot, length, scaled, sub, unit};
use hlr_exact::elementary::{atan2, hypot};

pub struct Face<'a> {
    surface: &'a Surface,
    place: &'a [[f64; 4]; 3],
    sign: f64,
    model: &'a Model<'a>,
}

/// A point of the surface with its outward normal.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub uv: [f64; 2],
    pub point: Vector,
    pub normal: Vector,
}

/// The circle in which a sphere is seen edge-on, and the sphere's centre.
pub struct SeenCircle {
    pub sphere: Vector,
    pub centre: Vector,
    pub axis: Vector,
    pub radius: f64,
}

impl<'a> Face<'a> {
    pub fn new(model: &'a Model<'a>, number: i32) -> Option<Face<'a>> {
        let record = &model.faces[number as usize];
        let surface = model.surfaces[record.surface? as usize].as_ref()?;
        Some(Face { surface, place: &record.place, sign: record.sign, model })
    }

    fn turned(&self, d: &Vector) -> Vector {
        [0, 1, 2].map(|i| self.place[i][0] * d[0] + self.place[i][1] * d[1] + self.place[i][2] * d[2])
    }

    fn moved(&self, p: &Vector) -> Vector {
        let q = self.turned(p);
        [0, 1, 2].map(|i| q[i] + self.place[i][3])
    }

    pub fn point(&self, uv: [f64; 2]) -> Vector {
        self.moved(&self.surface.d1(uv).0)
    }

    fn outward(&self, normal: Option<Vector>) -> Option<Vector> {
        unit(&scaled(&self.turned(&normal?), self.sign))
    }

    pub fn normal(&self, uv: [f64; 2]) -> Option<Vector> {
        self.outward(self.surface.normal(uv))
    }

    /// f at a place of the surface; None where it has no normal.
    pub fn f(&self, uv: [f64; 2]) -> Option<f64> {
        let (p, n) = self.surface.placed(uv);
        Some(dot(&self.outward(n)?, &self.sight_of(&p)))
    }

    /// Unit vector from the viewer toward a point of the surface's frame.
    fn sight_of(&self, p: &Vector) -> Vector {
        if self.model.view.perspective { self.model.sight(&self.moved(p)) } else { self.model.view.away }
    }

    /// f, its growth per length along u and v, and the speeds of u and v. The change of the line of sight along the
    /// surface is left out, for it vanishes with f.
    fn f_and_slopes(&self, uv: [f64; 2]) -> Option<(f64, [f64; 2], [f64; 2])> {
        let jet = self.surface.jet(uv);
        let (normal, changes) = jet.normal()?;
        let sight = self.sight_of(&jet.point);
        let speed = [&jet.du, &jet.dv].map(|d| length(&self.turned(d)));
        let f = dot(&self.outward(Some(normal))?, &sight);
        // A placement may scale.
        let scale = self.sign * length(&self.turned(&normal));
        let slope = [0, 1].map(|k| dot(&self.turned(&changes[k]), &sight) / (scale * speed[k]));
        Some((f, slope, speed))
    }

    /// How fast f grows along a way in the parameters, as far as the surface alone tells.
    pub fn growth(&self, uv: [f64; 2], way: [f64; 2]) -> Option<f64> {
        let (_, slope, speed) = self.f_and_slopes(uv)?;
        Some(slope[0] * speed[0] * way[0] + slope[1] * speed[1] * way[1])
    }

    /// The normal; at a pole that of a place close by, in the direction of the parameters `beside`.
    pub fn normal_toward(&self, uv: [f64; 2], beside: [f64; 2]) -> Option<Vector> {
        self.outward(self.surface.normal_toward(uv, beside))
    }

    /// f with this normal.
    pub fn f_toward(&self, uv: [f64; 2], beside: [f64; 2]) -> Option<f64> {
        Some(dot(&self.normal_toward(uv, beside)?, &self.model.sight(&self.point(uv))))
    }

    /// The point with this normal.
    pub fn at_toward(&self, uv: [f64; 2], beside: [f64; 2]) -> Option<Place> {
        Some(Place { uv, point: self.point(uv), normal: self.normal_toward(uv, beside)? })
    }

    pub fn at(&self, uv: [f64; 2]) -> Option<Place> {
        let (p, n) = self.surface.placed(uv);
        Some(Place { uv, point: self.moved(&p), normal: self.outward(n)? })
    }

    /// The derivatives of the surface by u and v.
    pub fn derivatives(&self, uv: [f64; 2]) -> [Vector; 2] {
        let (_, du, dv) = self.surface.d1(uv);
        [self.turned(&du), self.turned(&dv)]
    }

    /// The lengths of the derivatives by u and v.
    pub fn speeds(&self, uv: [f64; 2]) -> [f64; 2] {
        self.derivatives(uv).map(|d| length(&d))
    }

    /// Whether f is a cosine of u: on a cylinder in a parallel view. Between places less than half a turn apart at which
    /// it has one sign, it is nowhere nearer to zero than at one of them.
    pub fn is_cosine(&self) -> bool {
        matches!(self.surface, Surface::Cylinder(..)) && !self.model.view.perspective
    }

    pub fn is_sphere(&self) -> bool {
        matches!(self.surface, Surface::Sphere(..))
    }

    /// Whether the surface may have wrinkles. Spheres turn over once, cylinders and cones along whole rulings from border
    /// to border: none of them has.
    pub fn has_wrinkles(&self) -> bool {
        !matches!(self.surface, Surface::Plane(_) | Surface::Cylinder(..) | Surface::Cone(..) | Surface::Sphere(..))
    }

    /// A point on the axis of revolution and the axis direction; None for a sphere.
    pub fn axis(&self) -> Option<(Vector, Vector)> {
        let (origin, axis) = self.surface.axis()?;
        Some((self.moved(&origin), unit(&self.turned(&axis))?))
    }

    /// The circle in which a sphere is seen edge-on; None for other surfaces, and from within the sphere.
    pub fn circle_of_sphere(&self) -> Option<SeenCircle> {
        let sphere = self.moved(&self.surface.centre()?);
        let radius = length(&sub(&self.point([0.0; 2]), &sphere));
        if !self.model.view.perspective {
            return Some(SeenCircle { sphere, centre: sphere, axis: self.model.view.away, radius });
        }
        let away = sub(&sphere, &self.model.view.origin);
        // The circle of contact of the cone from the eye.
        let share = radius * radius / dot(&away, &away);
        let centre = along(&sphere, &away, -share);
        (share < 1.0).then_some(SeenCircle {
            sphere,
            centre,
            axis: unit(&away)?,
            radius: radius * (1.0 - share).sqrt(),
        })
    }

    /// How far the fold between two places rises above its chord, where that is known in closed form: on a cylinder or
    /// a cone it is a ruling, on a sphere seen from infinitely far away a great circle.
    pub fn sagitta(&self, a: &Place, b: &Place) -> Option<f64> {
        match self.surface {
            Surface::Cylinder(..) | Surface::Cone(..) => (dot(&a.normal, &b.normal) > 1.0 - 1e-9).then_some(0.0),
            Surface::Sphere(..) if !self.model.view.perspective => {
                let radius = length(&sub(&a.point, &self.moved(&self.surface.centre()?)));
                let half = 0.5 * length(&sub(&b.point, &a.point));
                Some(radius - (radius * radius - half * half).max(0.0).sqrt())
            }
            _ => None,
        }
    }

    /// The middle of the fold between two places of a sphere seen from infinitely far away: it is a great circle. None
    /// for other surfaces, and in perspective.
    fn middle_on_sphere(&self, a: &Place, b: &Place) -> Option<Place> {
        let Surface::Sphere(frame, _) = self.surface else { return None };
        if self.model.view.perspective {
            return None;
        }
        let [origin, x, y, z] = frame.vectors();
        let centre = self.moved(&origin);
        let arm = sub(&a.point, &centre);
        let normal = unit(&add(&a.normal, &b.normal))?;
        let arm = scaled(&normal, length(&arm) * dot(&arm, &a.normal).signum());
        let [east, north, up] = [x, y, z].map(|d| dot(&self.turned(&d), &arm));
        let beside = 0.5 * (a.uv[0] + b.uv[0]);
        let u = atan2(north, east);
        let u = u + ((beside - u) / TAU).round() * TAU;
        Some(Place { uv: [u, atan2(up, hypot(east, north))], point: add(&centre, &arm), normal })
    }

    /// Steps of u and v per unit of length along the line of sight projected into the tangent plane.
    pub fn along_sight(&self, uv: [f64; 2]) -> Option<[f64; 2]> {
        let (p, du, dv) = self.surface.d1(uv);
        let (du, dv, sight) = (self.turned(&du), self.turned(&dv), self.model.sight(&self.moved(&p)));
        let n = cross(&du, &dv);
        let square = dot(&n, &n);
        let way = [dot(&cross(&sight, &dv), &n) / square, dot(&cross(&du, &sight), &n) / square];
        way.iter().all(|x| x.is_finite()).then_some(way)
    }

    /// The growth of f per length along the line of sight: the curvature of the surface's normal section there.
    /// Positive: the surface bends away from its normal, and the line of sight passes outside the body. Negative: the
    /// surface bends toward its normal, and the line of sight lies within the body. 0 at a pole, where the parameters
    /// do not tell.
    pub fn radial(&self, uv: [f64; 2]) -> f64 {
        let (Some([a, b]), Some(normal)) = (self.along_sight(uv), self.normal(uv)) else { return 0.0 };
        let jet = self.surface.jet(uv);
        let bend = |d: &Vector| dot(&normal, &self.turned(d));
        -(a * a * bend(&jet.duu) + 2.0 * a * b * bend(&jet.duv) + b * b * bend(&jet.dvv))
    }
}

impl Model<'_> {
    /// Unit vector from the viewer toward a point.
    pub fn sight(&self, p: &Vector) -> Vector {
        if !self.view.perspective {
            return self.view.away;
        }
        unit(&sub(p, &self.view.origin)).unwrap_or(self.view.away)
    }
}

/// Where f vanishes between two places of a face, one with f > 0 and one with f < 0: regula falsi (Illinois), which
/// keeps the change of sign between its ends.
pub fn root(face: &Face, a: [f64; 2], b: [f64; 2], fa: f64, fb: f64) -> f64 {
    let mix = |t: f64| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    let (mut low, mut high, mut f_low, mut f_high) = (0.0f64, 1.0f64, fa, fb);
    let mut side = 0;
    for round in 0..80 {
        let even = 0.5 * (low + high);
        let t = if round % 8 == 7 { even } else { (low * f_high - high * f_low) / (f_high - f_low) };
        let t = if t > low && t < high { t } else { even };
        let Some(f) = face.f(mix(t)) else { return t };
        if f.abs() < 1e-14 || high - low < 1e-15 {
            return t;
        }
        if (f > 0.0) == (f_low > 0.0) {
            (low, f_low) = (t, f);
            if side == 1 {
                f_high *= 0.5;
            }
            side = 1;
        } else {
            (high, f_high) = (t, f);
            if side == 2 {
                f_low *= 0.5;
            }
            side = 2;
        }
    }
    0.5 * (low + high)
}

/// The point of the silhouette nearest to a place of the surface, by Newton's method along the gradient of f; None
/// where it is farther away than `reach`, in the model.
pub fn onto(face: &Face, start: [f64; 2], reach: f64) -> Option<Place> {
    let mut uv = start;
    let from = face.point(start);
    for _ in 0..12 {
        let (f, slope, speed) = face.f_and_slopes(uv)?;
        if f.abs() < 1e-12 {
            break;
        }
        let square = slope[0] * slope[0] + slope[1] * slope[1];
        if square == 0.0 {
            return None;
        }
        let way = [0, 1].map(|k| -f * slope[k] / square);
        let size = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let cut = if size > reach { reach / size } else { 1.0 };
        for k in 0..2 {
            uv[k] += cut * way[k] / speed[k];
        }
        // The error of the next step is of the order of this one's square.
        if f.abs() < 1e-7 {
            break;
        }
    }
    let place = face.at(uv)?;
    let near = length(&sub(&place.point, &from)) <= reach;
    let sight = face.model.sight(&place.point);
    (near && dot(&place.normal, &sight).abs() < 1e-8).then_some(place)
}

/// How far a curve over one triangle may rise above its chord, as a share of the chord. Normals turn by at most half a
/// radian there.
const BOW: f64 = 0.2;

/// The middle between two places of one face, moved onto the silhouette.
pub fn middle(face: &Face, a: &Place, b: &Place) -> Option<Place> {
    if let Some(place) = face.middle_on_sphere(a, b) {
        return Some(place);
    }
    let size = length(&sub(&b.point, &a.point));
    let uv = [0, 1].map(|k| 0.5 * (a.uv[k] + b.uv[k]));
    let place = onto(face, uv, BOW * size)?;
    // It has to lie between them, or the curve would turn back.
    let chord = sub(&b.point, &a.point);
    let at = dot(&sub(&place.point, &a.point), &chord) / (size * size);
    (at > 0.02 && at < 0.98).then_some(place)
}

/// A normal between those of two faces.
pub fn mean(a: &Vector, b: &Vector) -> Vector {
    unit(&along(a, b, 1.0)).unwrap_or(*a)
}
