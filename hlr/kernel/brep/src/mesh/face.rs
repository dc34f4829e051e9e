//! Input and output of the mesher for one face: its loops; its triangles, or the reason why there are none.

/// A point of a loop: a corner of an edge's polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// Parameters on the surface. On a periodic surface they are continuous along the loop; the last point may be a
    /// period away from the first one.
    ///
    /// Neighbours with the same node are a pole: they differ in (u, v) only, and the mesh may have points between them.
    pub uv: [f64; 2],
    /// The point in space, in the surface's frame.
    pub point: [f64; 3],
    /// Its number among the points of all edges. All faces that share a point share its node.
    pub node: u32,
}

/// The border of a face: closed loops, the first point not repeated at the end. The inside is to the left in (u, v).
/// For a loop that runs the other way, the loops around it tell which side is inside.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceLoops {
    pub loops: Vec<Vec<LoopPoint>>,
    /// Periods of u and v; 0 where the surface is not periodic.
    pub periods: [f64; 2],
}

/// Triangles of a face. The loops' points come first, in their order; inner points follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceMesh {
    pub uv: Vec<[f64; 2]>,
    pub points: Vec<[f64; 3]>,
    /// Nodes of the loops' points, then of points that were added on poles.
    pub nodes: Vec<u32>,
    /// Counterclockwise in (u, v).
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals du x dv.
    pub normals: Vec<[f64; 3]>,
    /// Numbers of the loops that run the wrong way. They were meshed as if they ran the right way.
    pub turned: Vec<usize>,
    /// Where the surface is torn, no mesh keeps the deflection: the chord error there. 0 for all other surfaces.
    pub torn: f64,
    /// Where half of the steps were taken before the mesh kept the deflection, or the border is so far off the surface
    /// that it cannot: the chord error that it has. 0 for all other meshes.
    pub unfinished: f64,
}

/// Why a face has no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// Chords that cross, each pair as (loop, chord, loop, chord).
    Crossing(Vec<[usize; 4]>),
    /// A loop that does not close in (u, v), or encloses nothing.
    Open,
    /// The surface has no normal, or no size, where one is needed.
    Degenerate,
    /// The mesh would need more points than fit into memory.
    TooFine,
    /// The smallest chord error that could be proved, where it exceeds the deflection; and the chords, each as (loop,
    /// chord), that may be the reason, as they meet triangles that exceed it.
    NotCertified(f64, Vec<[usize; 2]>),
    /// More steps were taken than a face may take, before there was any mesh, even a coarse one.
    TooMuchWork,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Fault::Crossing(_) => write!(f, "its borders cross"),
            Fault::Open => write!(f, "its border does not close"),
            Fault::Degenerate => write!(f, "its surface has no normal"),
            Fault::TooFine => write!(f, "it would need too many points"),
            Fault::NotCertified(error, _) => write!(f, "its chord error may be {error:.3e}"),
            Fault::TooMuchWork => write!(f, "its mesh takes too many steps"),
        }
    }
}
