//! The differences between layouts of the dump, and the nesting limit common to all.

/// Limit on the nesting of trimmed and offset curves and surfaces.
pub const MOST_NESTED: usize = 16;

#[derive(Clone, Copy)]
pub struct Layout {
    /// A curve on a surface is followed by the (u, v) of its ends.
    pub ends_in_uv: bool,
    /// A triangulation says whether it has normals.
    pub normals: bool,
}
