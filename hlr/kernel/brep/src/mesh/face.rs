//! Input and output of the mesher for one face: its loops; its triangles, or the reason why there are none.

/// A point of a loop: a corner of an edge's polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// On the surface. Of a periodic surface the loop goes on without a jump; its last point may be a period away from
    /// its first one.
    ///
    /// Neighbours with one node are a pole: they differ in (u, v) only, and the mesh may have points between them.
    pub uv: [f64; 2],
    /// In space, in the surface's frame.
    pub point: [f64; 3],
    /// Its number among the points of all edges: one place, one node, whatever face it is seen from.
    pub node: u32,
}

/// The border of a face: closed loops, the first point not repeated at the end. The inside is to the left in (u, v): of
/// a loop that runs the other way it is known which side is meant all the same, by the loops around it.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceLoops {
    pub loops: Vec<Vec<LoopPoint>>,
    /// Of u and v; 0 where the surface is not periodic.
    pub periods: [f64; 2],
}

/// Triangles of a face. The loops' points come first, in their order; inner points follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceMesh {
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<[f64; 3]>,
    /// Of the loops' points; and of points that were added on poles, which follow these.
    pub nodes: Vec<u32>,
    /// Counterclockwise in (u, v).
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals du x dv.
    pub normals: Vec<[f64; 3]>,
    /// Numbers of the loops that run the wrong way. They were taken as if they did not.
    pub turned: Vec<usize>,
}

/// Why a face has no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// Chords that cross: loop, chord, loop, chord.
    Crossing(Vec<[usize; 4]>),
    /// A loop that does not close in (u, v), or encloses nothing.
    Open,
    /// The surface has no normal, or no size, where one is needed.
    Degenerate,
    /// More points than fit into memory would be needed.
    TooFine,
    /// The chord error that could be shown, where that is above what was asked.
    NotCertified(f64),
}
