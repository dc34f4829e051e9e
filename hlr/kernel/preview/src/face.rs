//! Faces: triangles in the picture, with corners on the grid of 1/256 pixel and a depth at each.

use super::sampling::Sampling;

/// A triangle in the picture, its corners in the order of positive area, y down.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    pub x: [i32; 3],
    pub y: [i32; 3],
    pub depth: [f32; 3],
    pub triangle: u32,
    /// Columns and rows of samples that it may own: first, and one after the last.
    pub reach: [[i32; 2]; 2],
}

impl Face {
    pub const NONE: Face = Face { x: [0; 3], y: [0; 3], depth: [0.0; 3], triangle: 0, reach: [[0; 2]; 2] };

    /// `size`: width and height of the picture, in pixels.
    #[inline(always)]
    pub fn new(
        x: [i32; 3],
        y: [i32; 3],
        depth: [f32; 3],
        triangle: u32,
        sampling: &Sampling,
        size: [usize; 2],
    ) -> Face {
        Face { x, y, depth, triangle, reach: [sampling.reach(&x, size[0]), sampling.reach(&y, size[1])] }
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
    pub depth: f32,
}

impl Vertex {
    /// A vertex that is not on the grid: behind the near plane, or too far outside.
    pub const OFF: Vertex = Vertex { x: i32::MIN, y: 0, depth: 0.0 };

    pub fn is_off(&self) -> bool {
        self.x == i32::MIN
    }
}
