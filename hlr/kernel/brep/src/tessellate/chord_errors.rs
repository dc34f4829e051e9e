//! How large the chord errors of a model's faces and edges may be.

use crate::model::Model;

/// The chord error asked for: of the model, and of each of its faces and edges. All in model units.
pub struct ChordErrors {
    pub whole: f64,
    pub faces: Vec<f64>,
    pub edges: Vec<f64>,
}

impl ChordErrors {
    /// The same for all faces and edges.
    pub fn same(model: &Model, error: f64) -> ChordErrors {
        ChordErrors { whole: error, faces: vec![error; model.faces.len()], edges: vec![error; model.edges.len()] }
    }

    /// Of each part a share of the error, at most 1. What several parts have in common keeps the smallest of theirs, and
    /// so do an edge and its copies.
    pub fn of_parts(model: &Model, error: f64, shares: &[f64]) -> ChordErrors {
        let mut errors = ChordErrors::same(model, error);
        if shares.iter().all(|&share| share == 1.0) {
            return errors;
        }
        let lower = |at: &mut f64, share: f64| *at = at.min(share * error);
        for (part, &share) in model.parts.iter().zip(shares) {
            part.faces.iter().for_each(|placed| lower(&mut errors.faces[placed.face as usize], share));
            part.edges.iter().for_each(|placed| lower(&mut errors.edges[placed.edge as usize], share));
        }
        for (face, &own) in model.faces.iter().zip(&errors.faces) {
            for used in face.wires.iter().flatten() {
                lower(&mut errors.edges[used.edge as usize], own / error);
            }
        }
        let copies: Vec<(usize, usize)> = (model.edges.iter().enumerate())
            .filter_map(|(copy, edge)| edge.original.map(|(original, _)| (copy, original as usize)))
            .collect();
        for &(copy, original) in &copies {
            errors.edges[original] = errors.edges[original].min(errors.edges[copy]);
        }
        for &(copy, original) in &copies {
            errors.edges[copy] = errors.edges[original];
        }
        errors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_shares_of_the_error() {
        let model = Model::read(include_bytes!("../../tests/cylinder_4.bin"), None).unwrap();
        let of = |share| ChordErrors::of_parts(&model, 0.2, &vec![share; model.parts.len()]);
        for (share, wanted) in [(1.0, 0.2), (0.5, 0.1)] {
            let errors = of(share);
            assert_eq!(errors.whole, 0.2);
            assert!(errors.faces.iter().chain(&errors.edges).all(|&error| error == wanted), "{share}");
        }
    }
}
