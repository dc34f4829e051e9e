//! Sizes of the picture's units: steps per pixel, samples per tile, samples per vector.

/// Steps of the grid in a pixel.
pub const GRID: i32 = 256;
/// Most pixels a side: the raster's integers hold tiles of faces twice as large.
pub const MOST_PIXELS: usize = 16384;
/// Samples of a tile, across and down: what stays in the first cache.
pub const TILE_WIDTH: usize = 64;
pub const TILE_HEIGHT: usize = 64;
/// Samples of a row that are computed side by side.
pub const LANES: usize = 8;
