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

    /// Of each face a share of the error, at most 1. An edge keeps the smallest of its faces, one of no face the smallest
    /// of its part, and an edge and its copies the smallest of theirs.
    pub fn of_faces(model: &Model, error: f64, shares: &[f64]) -> ChordErrors {
        let mut errors = ChordErrors::same(model, error);
        if shares.iter().all(|&share| share == 1.0) {
            return errors;
        }
        let lower = |at: &mut f64, share: f64| *at = at.min(share * error);
        for ((face, own), &share) in model.faces.iter().zip(&mut errors.faces).zip(shares) {
            lower(own, share);
            for used in face.wires.iter().flatten() {
                lower(&mut errors.edges[used.edge as usize], share);
            }
        }
        for part in &model.topology {
            let least = part.faces.iter().map(|placed| shares[placed.face as usize]).fold(1.0, f64::min);
            for placed in part.edges.iter().filter(|placed| placed.faces.is_empty()) {
                lower(&mut errors.edges[placed.edge as usize], least);
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
    fn faces_have_shares_of_the_error_and_edges_the_smallest_of_their_faces() {
        let model = Model::read(include_bytes!("../../tests/cylinder_4.bin"), None).unwrap();
        let of = |shares: &[f64]| ChordErrors::of_faces(&model, 0.2, shares);
        let count = model.faces.len();
        for (share, wanted) in [(1.0, 0.2), (0.5, 0.1)] {
            let errors = of(&vec![share; count]);
            assert_eq!(errors.whole, 0.2);
            assert!(errors.faces.iter().chain(&errors.edges).all(|&error| error == wanted), "{share}");
        }
        for fine in 0..count {
            let shares: Vec<f64> = (0..count).map(|face| if face == fine { 0.5 } else { 1.0 }).collect();
            let errors = of(&shares);
            let own = |edge: usize| model.faces[fine].wires.iter().flatten().any(|used| used.edge as usize == edge);
            for (edge, &error) in errors.edges.iter().enumerate() {
                // None of them is a copy.
                assert!(model.edges[edge].original.is_none());
                assert_eq!(error, if own(edge) { 0.1 } else { 0.2 }, "{fine} {edge}");
            }
            assert_eq!(errors.faces, shares.iter().map(|share| 0.2 * share).collect::<Vec<_>>());
        }
    }
}
