//! The shaded preview: a z-buffer in tiles, shaded once per pixel and triangle.
//!
//! ```text
//! 1. `lens`         model -> view -> picture, with a depth that is linear in the picture
//! 2. `near_clip`    clips by six planes, only triangles that cross the near plane or leave the range of integers
//! 3. `faces`        triangles in integers of 1/256 pixel, without what cannot be visible, sorted by depth in chunks
//! 4. `tiles`        lists the faces of each tile (`tile_lists`), and goes through the tiles, which fit the first cache
//! 5. `raster`       which samples a face owns (top-left rule, exact), and depth test into the z-buffer (`tile`):
//!                   `row_spans` and `narrow_faces` for one sample per pixel, `edge_functions` for sixteen;
//!                   `pyramid` skips faces that are hidden as a whole
//! 6. `transparent`  all layers of transparent faces before the nearest opaque one, sorted by depth
//! 7. `surface`      the point of the unrounded triangle under a sample: perspective-correct, no clipping needed
//! 8. `shade`        light
//! 9. `resolve`      samples to a pixel, in linear light
//! ```
//!
//! `shadow` and `occlusion` look depths up in maps that the same steps 1 to 5 made before; `stroke` draws lines on top;
//! `normals` evaluates the true surfaces.
//!
//! Every tile is computed by one thread, from faces in the order of the model: the bytes do not depend on the number of
//! threads.

#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod depth_map;
mod edge_functions;
pub mod face;
pub mod faces;
pub mod fill;
pub mod grid;
pub mod lens;
mod narrow_faces;
mod near_clip;
pub mod normals;
pub mod occlusion;
pub mod picture;
mod plane;
mod pyramid;
mod raster;
mod resolve;
mod row_spans;
pub mod sampling;
pub mod shade;
mod shading_cache;
pub mod shadow;
mod slope;
pub mod stroke;
mod surface;
mod tile;
mod tile_lists;
mod tiles;
mod transparent;
pub mod workspace;

/// A model to be shown, borrowed. Colours are linear light, not premultiplied; alpha below one is transparent.
pub struct Model<'a> {
    pub points: &'a [[f64; 3]],
    /// Counter-clockwise seen from outside.
    pub triangles: &'a [[i32; 3]],
    /// Per corner its normal in `normals`; -1 for the triangle's own.
    pub corner: &'a [[i32; 3]],
    pub normals: &'a [[f32; 3]],
    /// Per corner its colour in `colours`.
    pub paint: &'a [[i32; 3]],
    pub colours: &'a [[f32; 4]],
    /// Per triangle: it is not visible from behind.
    pub cull: &'a [bool],
    /// Per triangle: some of its corners are transparent.
    pub transparent: &'a [bool],
}

/// Marks a sample that nothing covers.
pub const NOTHING: u32 = u32::MAX;
