//! An edge on each of its two faces: normals, the angle between them, and where either surface may have a break.

use crate::format::{Matrix, moved, turned};
use crate::geometry::curve::Curve;
use crate::geometry::surface::Surface;
use crate::geometry::vector::{Vector, cross, dot, length, scaled};
use hlr_exact::elementary::atan2;

/// Radians: surfaces that meet at less are tangent. STEP and IGES readers assume the same.
pub const TANGENT: f64 = 0.01;

/// Radians. An edge that is recorded as tangent counts as tangent if the angle falls to this value somewhere. Smaller
/// angles do not interrupt a tangent edge.
pub const NEARLY_TANGENT: f64 = 0.1;

/// An edge on one of its faces.
pub struct Side<'a> {
    pub surface: &'a Surface,
    /// The curve in (u, v), with its range; a plane needs none.
    pub curve: Option<(&'a Curve, [f64; 2])>,
    pub place: Option<&'a Matrix>,
    pub reversed: bool,
    /// The surface is not elementary.
    pub free: bool,
}

/// A side, with its outward normal if that is the same everywhere.
pub struct Fixed<'a> {
    pub side: &'a Side<'a>,
    normal: Option<Vector>,
}

impl<'a> Fixed<'a> {
    pub fn new(side: &'a Side<'a>) -> Fixed<'a> {
        let flat = matches!(side.surface, Surface::Plane(_));
        Fixed { side, normal: if flat { side.normal([0.0; 2]) } else { None } }
    }

    /// The outward normal at a share of the edge; None where the surface has none.
    pub fn at(&self, share: f64) -> Option<Vector> {
        self.normal.or_else(|| self.side.normal(self.side.uv(share)))
    }
}

impl Side<'_> {
    pub fn normal(&self, uv: [f64; 2]) -> Option<Vector> {
        let (_, mut du, mut dv) = self.surface.d1(uv);
        if let Some(place) = self.place {
            (du, dv) = (turned(place, &du), turned(place, &dv));
        }
        let normal = cross(&du, &dv);
        let area = length(&normal);
        let longest = dot(&du, &du).max(dot(&dv, &dv));
        let sound = area > 1e-7 * longest;
        sound.then(|| scaled(&normal, if self.reversed { -1.0 } else { 1.0 } / area))
    }

    pub fn point(&self, share: f64) -> Vector {
        let point = self.surface.point(self.uv(share));
        self.place.map_or(point, |place| moved(place, &point))
    }

    pub fn uv(&self, share: f64) -> [f64; 2] {
        self.curve.map_or([0.0; 2], |(curve, [first, last])| {
            let [u, v, _] = curve.point(first + share * (last - first));
            [u, v]
        })
    }

    /// Shares of the edge at which its curve in (u, v) may have a corner.
    pub fn breaks(&self, out: &mut Vec<f64>) {
        if let Some((Curve::Spline(n), [first, last])) = self.curve {
            out.extend(n.knots.iter().map(|k| (k - first) / (last - first)).filter(|s| *s > 0.0 && *s < 1.0));
        }
    }
}

/// Angle between the faces' normals in radians; None where a face has no normal.
pub fn angle(sides: &[Fixed; 2], share: f64) -> Option<f64> {
    let (one, two) = (sides[0].at(share)?, sides[1].at(share)?);
    Some(atan2(length(&cross(&one, &two)), dot(&one, &two)))
}

pub fn ascending(shares: &mut Vec<f64>) {
    shares.sort_unstable_by(f64::total_cmp);
    shares.dedup_by(|b, a| *b - *a <= 1e-9);
}

/// Shares of the edge, from 0 to 1, between which the curves in (u, v) are smooth.
pub fn spans(sides: &[Fixed; 2]) -> Vec<f64> {
    let mut spans = vec![0.0, 1.0];
    sides.iter().for_each(|s| s.side.breaks(&mut spans));
    ascending(&mut spans);
    spans
}

/// The spans, each divided into `parts` equal parts.
pub fn divided(spans: &[f64], parts: usize) -> Vec<f64> {
    let part = |w: &[f64], i: usize| w[0] + (w[1] - w[0]) * i as f64 / parts as f64;
    spans.windows(2).flat_map(|w| (0..parts).map(move |i| part(w, i))).chain([1.0]).collect()
}

/// Shares of the edge at which it crosses knots of the surfaces, as far as they lie between neighbouring breaks.
pub fn crossed(sides: &[Fixed; 2], breaks: &[f64]) -> Vec<f64> {
    let mut crossed = Vec::new();
    for Fixed { side, .. } in sides {
        if !matches!(
            side.surface,
            Surface::Spline(_) | Surface::Revolution(..) | Surface::Extrusion(..) | Surface::Offset(..)
        ) {
            continue;
        }
        let uv: Vec<[f64; 2]> = breaks.iter().map(|&share| side.uv(share)).collect();
        let knots = [0, 1].map(|k| {
            let values = uv.iter().map(|uv| uv[k]);
            let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
            side.surface.knots(k, low, high)
        });
        for (step, pair) in uv.windows(2).enumerate() {
            for (k, knots) in knots.iter().enumerate() {
                let (here, there) = (pair[0][k], pair[1][k]);
                let first = knots.partition_point(|&x| x <= here.min(there));
                let last = knots.partition_point(|&x| x < here.max(there));
                for &knot in knots.get(first..last).unwrap_or_default() {
                    let way = (knot - here) / (there - here);
                    crossed.push(breaks[step] + way * (breaks[step + 1] - breaks[step]));
                }
            }
        }
    }
    crossed
}
