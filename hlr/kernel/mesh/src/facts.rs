//! Edges, normals and fold angles of a triangle mesh, from its points and triangles alone.

use rayon::prelude::*;

use crate::topology::{Topology, balance, folds, normals, repeated, topology};

#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Edges, lower vertex first, ascending. The triangles of edge e are incident[offsets[e]..offsets[e + 1]].
    pub edges: Vec<[i32; 2]>,
    pub offsets: Vec<i32>,
    pub incident: Vec<i32>,
    /// Per edge: triangles along it minus triangles against it.
    pub balance: Vec<i32>,
    /// Per edge: cosine of the fold, NaN where there are not two triangles with area.
    pub fold: Vec<f64>,
    /// Unit normals; zero for triangles without area, whose numbers are in `flat`.
    pub normals: Vec<[f64; 3]>,
    pub flat: Vec<i64>,
    /// Triangles that have the corners of another one: of each set at least one, ascending.
    pub repeated: Vec<i32>,
}

impl Facts {
    pub fn of(points: &[[f64; 3]], triangles: &[[i32; 3]]) -> Facts {
        // Side by side: both have stretches on one thread.
        let around_edges = || {
            let t = topology(triangles, points.len());
            let balance = balance(triangles, &t.edges, &t.offsets, &t.incident);
            (repeated(triangles, &t), balance, t)
        };
        let ((repeated, balance, t), normals) = rayon::join(around_edges, || normals(points, triangles));
        let Topology { edges, offsets, incident } = t;
        let fold = folds(&normals, &offsets, &incident, &balance);
        let flat = (0..normals.len()).into_par_iter().filter(|&t| normals[t] == [0.0; 3]).map(|t| t as i64).collect();
        Facts { edges, offsets, incident, balance, fold, normals, flat, repeated }
    }

    /// The triangles at an edge, ascending.
    pub fn around(&self, edge: usize) -> &[i32] {
        &self.incident[self.offsets[edge] as usize..self.offsets[edge + 1] as usize]
    }
}
