//! One of the two triangles at an edge of the mesh: f = N . v at both ends, and where it changes sign between them.

use super::face::{Face, Place, root};
use super::{Model, TIE};
use hlr_brep::geometry::vector::{Vector, cross, dot, length, sub};

/// One triangle at an edge a-b, with f and the surface parameters at a and b.
pub struct Side<'a> {
    pub triangle: i32,
    pub number: i32,
    pub corners: [i32; 2],
    pub uv: [[f64; 2]; 2],
    pub f: [f64; 2],
    /// None on planes.
    pub face: Option<Face<'a>>,
    pub normal: Vector,
}

impl Side<'_> {
    pub fn away(&self, end: usize) -> bool {
        self.f[end] >= -TIE
    }

    pub fn changes(&self) -> bool {
        self.away(0) != self.away(1)
    }

    /// The parameter along a-b at which f changes sign.
    pub fn change(&self) -> f64 {
        let Some(face) = &self.face else { return 0.5 };
        let back = usize::from(!self.away(0));
        if self.f[back] <= TIE {
            return back as f64;
        }
        root(face, self.uv[0], self.uv[1], self.f[0], self.f[1])
    }

    pub fn at(&self, t: f64) -> Option<Place> {
        let (uv, beside) = self.parameters(t);
        self.face.as_ref()?.at_toward(uv, beside)
    }

    /// The outward normal on the surface; that of the side where there is none.
    pub fn normal_at(&self, t: f64) -> Vector {
        let (uv, beside) = self.parameters(t);
        self.face.as_ref().and_then(|face| face.normal_toward(uv, beside)).unwrap_or(self.normal)
    }

    /// The surface parameters, and those toward which the normal is taken at a pole.
    fn parameters(&self, t: f64) -> ([f64; 2], [f64; 2]) {
        let uv = [0, 1].map(|k| self.uv[0][k] + (self.uv[1][k] - self.uv[0][k]) * t);
        (uv, self.uv[usize::from(t < 0.5)])
    }
}

pub fn side<'a>(model: &'a Model<'a>, values: &[f64], e: usize, t: i32) -> Option<Side<'a>> {
    let [a, b] = model.edges[e];
    let corners = &model.triangles[t as usize];
    let (i, j) = (corners.iter().position(|&c| c == a)?, corners.iter().position(|&c| c == b)?);
    let number = model.triangle_face[t as usize];
    let nodes = &model.corner[t as usize];
    let record = &model.faces[number as usize];
    if !record.curved {
        // A plane has the same normal everywhere.
        let normal = Face::new(model, number)?.normal(model.uv[nodes[i] as usize])?;
        let f = [a, b].map(|v| dot(&normal, &model.sight(&model.points[v as usize])));
        return Some(Side { triangle: t, number, corners: [a, b], uv: [[0.0; 2]; 2], f, face: None, normal });
    }
    let face = Face::new(model, number)?;
    let uv = nodes.map(|n| model.uv[n as usize]);
    if uv.iter().flatten().any(|x| !x.is_finite()) {
        return None;
    }
    let pole = [i, j].map(|k| values[nodes[k] as usize].is_nan());
    let mut ends = [uv[i], uv[j]];
    for k in 0..2 {
        if pole[k] {
            // At a pole one parameter has no meaning; it is taken from the other end.
            let speed = face.speeds(ends[k]);
            let idle = usize::from(speed[1] < speed[0]);
            ends[k][idle] = ends[1 - k][idle];
        }
    }
    let f = [0, 1].map(|k| {
        if pole[k] { face.f_toward(ends[k], ends[1 - k]).unwrap_or(0.0) } else { values[nodes[[i, j][k]] as usize] }
    });
    let half = [0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k]));
    // The surface may have no normal just there.
    let normal = face.normal(half).or_else(|| ends.iter().find_map(|&end| face.normal_toward(half, end)))?;
    Some(Side { triangle: t, number, corners: [a, b], uv: ends, f, face: Some(face), normal })
}

/// The surface parameters of a point on a triangle, from those at its corners; of a triangle without a height, those of
/// its first corner.
pub fn on_triangle(p: &Vector, [a, b, c]: [&Vector; 3], [u, v, w]: [[f64; 2]; 3]) -> [f64; 2] {
    let up = cross(&sub(b, a), &sub(c, a));
    let square = dot(&up, &up);
    let share = |from: &Vector, to: &Vector| dot(&cross(&sub(to, from), &sub(p, from)), &up) / square;
    let (of_b, of_c) = (share(c, a), share(a, b));
    if length(&up) == 0.0 || !of_b.is_finite() {
        return u;
    }
    [0, 1].map(|k| u[k] + of_b * (v[k] - u[k]) + of_c * (w[k] - u[k]))
}
