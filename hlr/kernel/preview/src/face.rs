//! Faces: triangles in the picture, with corners on the grid of 1/256 pixel and a depth at each.

use super::plane::Plane;
use super::sampling::Sampling;

/// A triangle in the picture, its corners in the order of positive area, y down.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    pub x: [i32; 3],
    pub y: [i32; 3],
    /// At the corners: bounds of the depth of the whole face.
    pub depth: [f32; 3],
    pub plane: Plane,
    pub triangle: u32,
    /// Columns and rows of samples that it may own: first, and one after the last.
    pub reach: [[i32; 2]; 2],
}

impl Face {
    pub const NONE: Face =
        Face { x: [0; 3], y: [0; 3], depth: [0.0; 3], plane: Plane::NONE, triangle: 0, reach: [[0; 2]; 2] };

    /// `size`: width and height of the picture, in pixels.
    #[inline(always)]
    pub fn new(
        x: [i32; 3],
        y: [i32; 3],
        depth: [f32; 3],
        plane: Plane,
        triangle: u32,
        sampling: &Sampling,
        size: [usize; 2],
    ) -> Face {
        Face { x, y, depth, plane, triangle, reach: [sampling.reach(&x, size[0]), sampling.reach(&y, size[1])] }
    }
}

/// The faces of some triangles.
#[derive(Default)]
pub struct Chunk {
    pub faces: Vec<Face>,
    pub nearest: f32,
}

#[derive(Clone, Copy)]
pub struct Vertex {
    pub x: i32,
    pub y: i32,
    /// From the grid point to where the vertex truly is, in steps of the grid.
    pub off: [f32; 2],
    pub depth: f64,
}

impl Vertex {
    /// A vertex that is not on the grid: behind the near plane, or too far outside.
    pub const OFF: Vertex = Vertex { x: i32::MIN, y: 0, off: [0.0; 2], depth: 0.0 };

    /// The vertex at a place in steps of the grid.
    #[inline(always)]
    pub fn at(x: f64, y: f64, depth: f64) -> Vertex {
        let (column, row) = (nearest(x), nearest(y));
        Vertex { x: column, y: row, off: [(x - f64::from(column)) as f32, (y - f64::from(row)) as f32], depth }
    }

    /// Where it truly is, in steps of the grid, and its depth.
    #[inline(always)]
    pub fn place(&self) -> [f64; 3] {
        [f64::from(self.x) + f64::from(self.off[0]), f64::from(self.y) + f64::from(self.off[1]), self.depth]
    }

    pub fn is_off(&self) -> bool {
        self.x == i32::MIN
    }
}

#[inline(always)]
fn nearest(v: f64) -> i32 {
    // Adding this rounds to the nearest integer, ties to even, without a call: at 2^52 a double has no fraction bits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    ((v + ROUND) - ROUND) as i32
}
