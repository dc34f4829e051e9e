//! Pieces as they are drawn: a line on a surface is visible, and outlines that their own body hides are hidden.

use super::invisibility::{Piece, Segment, State};

/// The pieces that are drawn, by edge, and how many of those found are hidden by less than the contact tolerance.
///
/// found: by edge. on_surface: whether an edge runs on a surface; it is above or below it by rounding alone, so it is
/// visible within the tolerance. hidden: of each edge, whether its own body hides it, so that it has one hidden piece;
/// empty: of none.
pub fn as_drawn(found: &[Piece], on_surface: impl Fn(u32) -> bool, hidden: &[bool]) -> (Vec<Piece>, u64) {
    let mut contacts = 0;
    let mut own = (0u32..).zip(hidden).filter(|(_, is_hidden)| **is_hidden).map(|(edge, _)| edge).peekable();
    let whole = |edge| Piece { edge, segment: Segment { start: 0.0, end: 1.0, state: State::Hidden } };
    let mut out = Vec::with_capacity(found.len());
    for piece in found {
        while let Some(edge) = own.next_if(|edge| *edge < piece.edge) {
            out.push(whole(edge));
        }
        let mut piece = *piece;
        if matches!(piece.segment.state, State::Within | State::Diving) {
            contacts += 1;
            if on_surface(piece.edge) {
                piece.segment.state = State::Visible;
            }
        }
        out.push(piece);
    }
    out.extend(own.map(whole));
    (out, contacts)
}

#[cfg(test)]
mod tests {
    use State::{Diving, Hidden, Visible, Within};

    use super::*;

    /// Of the edges 0, 1 and 3.
    fn found() -> Vec<Piece> {
        [
            (0, 0.0, 0.5, Visible),
            (0, 0.5, 1.0, Within),
            (1, 0.0, 0.25, Hidden),
            (1, 0.25, 1.0, Diving),
            (3, 0.0, 0.75, Within),
            (3, 0.75, 1.0, Diving),
        ]
        .map(|(edge, start, end, state)| Piece { edge, segment: Segment { start, end, state } })
        .to_vec()
    }

    fn states(pieces: &[Piece]) -> Vec<(u32, State)> {
        pieces.iter().map(|piece| (piece.edge, piece.segment.state)).collect()
    }

    #[test]
    fn contacts_are_counted_and_stay() {
        let (drawn, contacts) = as_drawn(&found(), |_| false, &[]);
        assert_eq!((states(&drawn), contacts), (states(&found()), 4));
        assert_eq!(states(&as_drawn(&found(), |_| false, &[false; 4]).0), states(&found()));
    }

    #[test]
    fn a_line_on_a_surface_is_never_nearly_hidden() {
        let drawn = |on: &[u32]| {
            let (pieces, contacts) = as_drawn(&found(), |edge| on.contains(&edge), &[]);
            assert_eq!(contacts, 4);
            pieces.iter().map(|piece| piece.segment.state).collect::<Vec<_>>()
        };
        assert_eq!(drawn(&[0, 3]), [Visible, Visible, Hidden, Diving, Visible, Visible]);
        assert_eq!(drawn(&[1]), [Visible, Within, Hidden, Visible, Within, Diving]);
    }

    #[test]
    fn outlines_that_are_hidden_come_where_their_edges_are() {
        let (drawn, _) = as_drawn(&found(), |_| false, &[false, false, true, false, false, true]);
        let edges: Vec<u32> = drawn.iter().map(|piece| piece.edge).collect();
        assert_eq!(edges, [0, 0, 1, 1, 2, 3, 3, 5]);
        for added in [&drawn[4], &drawn[7]] {
            assert_eq!((added.segment.start, added.segment.end, added.segment.state), (0.0, 1.0, Hidden));
        }
        // After what was found of the same edge.
        let (drawn, _) = as_drawn(&found(), |_| false, &[true; 4]);
        assert_eq!(states(&drawn)[2..4], [(0, Hidden), (1, Hidden)]);
        assert_eq!(states(&drawn).last(), Some(&(3, Hidden)));
        assert_eq!(drawn.len(), 10);
    }
}
