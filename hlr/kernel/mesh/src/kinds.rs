//! The class of a mesh edge by its triangles: border, crease, or nearly a crease.

use rayon::prelude::*;

pub const SHARP: u8 = 0;
pub const BOUNDARY: u8 = 3;
pub const INTERIOR: u8 = 255;

/// Cosines of folds: below the first an edge is a crease, below the second nearly one.
#[derive(Clone, Copy)]
pub struct Limits {
    pub sharp: f64,
    pub near: f64,
}

/// Returns the class of each edge whose owner is `without_brep`, and which of the interior ones are nearly creases.
/// layered: of an edge of more than two triangles, whether they are layers of one surface (`layers`).
pub fn kinds(
    offsets: &[i32],
    fold: &[f64],
    without_brep: &(dyn Fn(usize) -> bool + Sync),
    layered: &(dyn Fn(usize) -> bool + Sync),
    limits: Limits,
) -> (Vec<u8>, Vec<i64>) {
    let kind: Vec<u8> = (0..fold.len())
        .into_par_iter()
        .with_min_len(1 << 12)
        .map(|e| match offsets[e + 1] - offsets[e] {
            _ if !without_brep(e) => INTERIOR,
            1 => BOUNDARY,
            3.. if !layered(e) => SHARP,
            _ if fold[e] < limits.sharp => SHARP,
            _ => INTERIOR,
        })
        .collect();
    let is_near = |e: &usize| kind[*e] == INTERIOR && fold[*e] < limits.near && without_brep(*e);
    let near = (0..fold.len()).into_par_iter().with_min_len(1 << 12).filter(is_near).map(|e| e as i64).collect();
    (kind, near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind() {
        let limits = Limits { sharp: 0.5, near: 0.9 };
        let fold = [f64::NAN, 0.4, 0.8, 1.0, f64::NAN, 0.4, f64::NAN];
        let found = |layered| kinds(&[0, 1, 3, 5, 7, 10, 12, 14], &fold, &|e| e != 5, &|_| layered, limits);
        assert_eq!(found(true).0, [BOUNDARY, SHARP, INTERIOR, INTERIOR, INTERIOR, INTERIOR, INTERIOR]);
        let found = found(false);
        assert_eq!(found.0, [BOUNDARY, SHARP, INTERIOR, INTERIOR, SHARP, INTERIOR, INTERIOR]);
        assert_eq!(found.1, [2]);
    }
}
