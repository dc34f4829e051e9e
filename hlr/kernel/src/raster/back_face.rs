//! Back-face culling: the sign of C.
//!
//! With depth away from the viewer, the outward normal (A, B, C) of a face turned toward the viewer has C < 0. In
//! perspective the sign of the plane at the eye decides; the projective map has moved the eye to infinity, before z = -inf,
//! where that sign is the sign of -C again: one test for both.
//!
//! Right for closed, consistently oriented solids only; who is one, the scene says. C = 0 is edge-on: never painted, never
//! divided by.

use super::plane::Plane;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    Front,
    Back,
    EdgeOn,
}

pub fn facing(plane: &Plane) -> Facing {
    match plane.c.signum() {
        -1 => Facing::Front,
        1 => Facing::Back,
        _ => Facing::EdgeOn,
    }
}
