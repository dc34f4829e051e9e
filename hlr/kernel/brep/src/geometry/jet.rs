//! A point of a surface with its first and second derivatives.

use super::vector::Vector;

/// A point of a surface with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    pub point: Vector,
    pub du: Vector,
    pub dv: Vector,
    pub duu: Vector,
    pub duv: Vector,
    pub dvv: Vector,
}
