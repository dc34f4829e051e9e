//! Sizes of the picture's units: steps per pixel, samples per tile, samples per vector.

/// Steps of the grid per pixel.
pub const GRID: i32 = 256;
/// Largest width and height in pixels: the raster's integers hold tiles of faces twice as large.
pub const MOST_PIXELS: usize = 16384;
/// Size of a tile in samples, across and down: a tile stays in the first-level cache.
pub const TILE_WIDTH: usize = 64;
pub const TILE_HEIGHT: usize = 64;
/// Samples of a row that are computed together.
pub const LANES: usize = 8;
