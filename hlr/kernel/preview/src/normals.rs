//! Normals of the true surfaces at the corners of their triangles.

use rayon::prelude::*;

use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, cross, dot, sub, unit};

/// The mesh, and where its corners lie on the surfaces of its faces.
pub struct OnSurfaces<'a> {
    pub points: &'a [[f64; 3]],
    pub triangles: &'a [[i32; 3]],
    pub face: &'a [i32],
    /// Per corner its index in `uv`, an entry of one face only; -1 for none.
    pub corner: &'a [[i32; 3]],
    pub uv: &'a [[f64; 2]],
    /// Per face its surface, and the matrix of its placement in the model, by rows.
    pub surface: &'a [i32],
    pub place: &'a [[f64; 12]],
    pub surfaces: &'a [Option<Surface>],
}

/// Per entry of `uv`: the unit normal on the outer side; zero where the surface has none.
///
/// The triangles of a face decide by majority, weighted by area, which side is the outer one.
pub fn normals(on: &OnSurfaces) -> Vec<[f32; 3]> {
    // Where a surface is singular, the normal is taken beside it, toward the middle of a triangle.
    let mut owner = vec![(u32::MAX, [0.0; 2]); on.uv.len()];
    for (t, corner) in on.corner.iter().enumerate() {
        if corner[0] < 0 || on.surface[on.face[t] as usize] < 0 {
            continue;
        }
        let places = corner.map(|c| on.uv[c as usize]);
        let middle = [0, 1].map(|k| (places[0][k] + places[1][k] + places[2][k]) / 3.0);
        for c in corner {
            let entry = &mut owner[*c as usize];
            if entry.0 == u32::MAX {
                *entry = (on.face[t] as u32, middle);
            }
        }
    }
    let raw: Vec<Vector> = owner
        .par_iter()
        .zip(on.uv)
        .map(|(&(face, middle), &uv)| if face == u32::MAX { [0.0; 3] } else { normal(on, face as usize, uv, middle) })
        .collect();
    let mut votes = vec![0.0; on.surface.len()];
    for (t, corner) in on.corner.iter().enumerate() {
        if corner[0] >= 0 {
            let [a, b, c] = on.triangles[t].map(|i| on.points[i as usize]);
            let facet = cross(&sub(&b, &a), &sub(&c, &a));
            votes[on.face[t] as usize] += corner.iter().map(|&k| dot(&facet, &raw[k as usize])).sum::<f64>();
        }
    }
    raw.iter()
        .zip(&owner)
        .map(|(n, &(face, _))| {
            let turned = face != u32::MAX && votes[face as usize] < 0.0;
            n.map(|c| if turned { -c as f32 } else { c as f32 })
        })
        .collect()
}

fn normal(on: &OnSurfaces, face: usize, uv: [f64; 2], beside: [f64; 2]) -> Vector {
    let surface = usize::try_from(on.surface[face]).ok().and_then(|s| on.surfaces[s].as_ref());
    let Some(n) = surface.and_then(|s| s.normal_toward(uv, beside)) else { return [0.0; 3] };
    let m = &on.place[face];
    let column = |k: usize| [m[k], m[4 + k], m[8 + k]];
    // A normal transforms by the cofactors of the matrix.
    let (x, y, z) = (column(0), column(1), column(2));
    let (a, b, c) = (cross(&y, &z), cross(&z, &x), cross(&x, &y));
    unit(&[0, 1, 2].map(|k| a[k] * n[0] + b[k] * n[1] + c[k] * n[2])).unwrap_or([0.0; 3])
}
