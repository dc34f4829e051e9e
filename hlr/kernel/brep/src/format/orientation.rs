//! The orientation of a shape inside another one.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    Forward,
    Reversed,
    Internal,
    External,
}

impl Orientation {
    /// Whether a shape of this orientation bounds the shape that contains it.
    pub fn bounds(self) -> bool {
        matches!(self, Orientation::Forward | Orientation::Reversed)
    }

    /// 1 where a face uses an edge of this orientation in its sense, -1 where against it, 0 where it does not bound it.
    /// reversed: whether the face is.
    pub fn sense(self, reversed: bool) -> i32 {
        let along = match self {
            Orientation::Forward => 1,
            Orientation::Reversed => -1,
            _ => 0,
        };
        if reversed { -along } else { along }
    }

    /// The orientation of a child, seen from the frame of its parent. Internal and external children keep theirs; a
    /// reversed parent reverses the others.
    pub fn compose(self, inner: Orientation) -> Orientation {
        use Orientation::{Forward, Reversed};
        match (self, inner) {
            (Forward, inner) => inner,
            (Reversed, Forward) => Reversed,
            (Reversed, Reversed) => Forward,
            (Reversed, inner) => inner,
            (outer, _) => outer,
        }
    }
}
