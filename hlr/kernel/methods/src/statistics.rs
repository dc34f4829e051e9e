//! Counters of work, the same for all methods.

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Polygons given; of those, the number culled as facing away, cut by the view volume, triangulated, edge-on or
    /// empty.
    pub polygons: u64,
    pub culled: u64,
    pub clipped: u64,
    pub triangulated: u64,
    pub edge_on: u64,
    /// Planar pieces that the methods work on.
    pub facets: u64,
    /// Two depths compared at one pixel (or a polygon compared with a plane, in methods that have no pixels).
    pub comparisons: u64,
    /// Of those, comparisons decided in integers because floating point could not.
    pub exact: u64,
    /// Runs of pixels of one polygon in one row that were examined; pixels written, repeated writes included.
    pub spans: u64,
    pub written: u64,
    /// Polygons or spans cut in two.
    pub splits: u64,
    /// Areas or tree nodes visited, and the greatest depth.
    pub recursion: u64,
    pub deepest: u64,
    /// Areas whose sorted list was not read to its end; polygons that this skipped.
    pub early_stops: u64,
    pub passed_over: u64,
    /// Rays cast; boxes and polygons tested against them.
    pub rays: u64,
    pub box_tests: u64,
    pub polygon_tests: u64,
    /// Changes of order: swaps in the active edge list, crossings in the active span list, reorderings in depth sort.
    pub swaps: u64,
    /// Events of the active lists: edges that start and end, row by row; in the active span list also spans, column by
    /// column. The third kind, crossings, are the `swaps`.
    pub edge_starts: u64,
    pub edge_ends: u64,
    pub span_starts: u64,
    pub span_ends: u64,
    /// Pixels at which a painter left a near tie to the exact comparison.
    pub settled: u64,
    /// Bytes of the method's own tables and buffers at their largest, the frame of ids included.
    pub memory: u64,
    /// Seconds before the first pixel: trees, sorting.
    pub setup: f64,
}

impl Statistics {
    /// Updates the largest memory with the bytes held at this moment.
    pub fn holds(&mut self, bytes: usize) {
        self.memory = self.memory.max(bytes as u64);
    }

    pub fn at_depth(&mut self, depth: usize) {
        self.recursion += 1;
        self.deepest = self.deepest.max(depth as u64);
    }
}

/// Bytes that a vector occupies.
pub fn bytes_of<T>(v: &[T]) -> usize {
    std::mem::size_of_val(v)
}
