//! The stages of this folder one after another.

use rayon::prelude::*;

use super::chord_ends;
use super::contacts::real;
use super::depth::{Bodies, Depth};
use super::planar_faces::{Edges, NO_PLANE, PlanarFaces};
use super::planes::planes;
use super::reach::{Sheet, Vec3};
use super::search::{Clash, Clashes};
use super::surfaces::Surfaces;
use super::weld::weld;
use hlr_exact::snap::Grid;
use hlr_mesh::facts::Facts;
use hlr_mesh::scene::Scene;
use hlr_mesh::tables::Tables;

/// Crossings whose depth one thread measures before it is worth waking another.
const FEW_CLASHES: usize = 256;
/// Points that one thread rounds before it is worth waking another.
const FEW_POINTS: usize = 1 << 13;

/// Intersection lines of a scene.
pub struct Crossings {
    pub points: Vec<Vec3>,
    /// Segments between the points.
    pub segments: Vec<[i32; 2]>,
    /// The two groups of each segment.
    pub groups: Vec<[i32; 2]>,
    /// A triangle of each group of each segment.
    pub triangles: Vec<[i32; 2]>,
    /// Per segment: one surface is nowhere deep in the other along its line.
    pub shallow: Vec<bool>,
    /// Per group: it passes through itself.
    pub through: Vec<bool>,
    /// Pairs of triangles that were looked at.
    pub tests: u64,
}

/// Every pair of triangles that cross, however little.
pub struct Met {
    pub grid: Grid,
    pub clashes: Clashes,
    /// Distinct ends of the common segments.
    pub points: Vec<Vec3>,
    /// Per clash: the ends of its segment.
    pub ends: Vec<[i32; 2]>,
}

/// All pairs of triangles that cross; incomplete if `stopped` returned true, None for points that are not finite.
pub fn met(
    points: &[Vec3],
    (triangles, group, planar): (&[[i32; 3]], &[i32], &PlanarFaces),
    itself: &[bool],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Met> {
    let grid = Grid::uniform_around(points)?;
    let points: Vec<_> = points.par_iter().with_min_len(FEW_POINTS).map(|p| grid.snap(p)).collect();
    let clashes = Surfaces { points: &points, triangles, group, itself, planar }.clashes(stopped);
    let (points, ends) = weld(&clashes.found);
    let points = points.iter().map(|p| grid.unsnap(p)).collect();
    Some(Met { grid, clashes, points, ends })
}

/// The intersection lines; incomplete if `stopped` returned true, None for points that are not finite. `touch`: contact
/// tolerance of every group, `deflection`: chord error of the triangles, both in model units.
pub fn crossings(
    (tables, facts, scene): (&Tables, &Facts, &Scene),
    touch: &[f64],
    deflection: f64,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Crossings> {
    let group = &scene.bodies.group_of[..];
    let triangles = &scene.turned.as_ref().map_or(&tables.triangles, |turned| &turned.triangles)[..];
    let plane: Vec<i32> = scene.planar_face(tables).map(|face| face.unwrap_or(NO_PLANE)).collect();
    let edges = Edges { edges: &facts.edges, offsets: &facts.offsets, incident: &facts.incident };
    let planar = PlanarFaces::new(plane, triangles, tables.points.len(), &edges);
    let met = met(&tables.points, (triangles, group, &planar), &scene.folded, stopped)?;
    let (found, ends, points) = (&met.clashes.found[..], &met.ends[..], &met.points[..]);
    let groups = &scene.bodies.groups;
    let sheet = Sheet::new(&tables.points, (triangles, &facts.normals), (edges, &scene.kind));
    let planes = planes(&sheet, &planar.of, found);
    let (face, planes) = (&planar.of[..], &planes);
    let bodies = Bodies { sheet, group, face, planes, without_brep: &groups.without_brep, touch, deflection };
    let depth = |(clash, ends): (&Clash, &[i32; 2])| bodies.depth(clash, ends.map(|end| &points[end as usize]));
    let mut depth: Vec<Depth> = found.par_iter().zip(ends).with_min_len(FEW_CLASHES).map(depth).collect();
    chord_ends::limit(&bodies, found, ends, points, &mut depth);
    let width: Vec<f64> = groups.low.iter().zip(&groups.high).map(|(low, high)| widest(low, high)).collect();
    let (real, through) = real(&bodies, found, ends, &depth, points, &width);
    let mut used: Vec<i32> = real.iter().flat_map(|segment| segment.ends).collect();
    used.sort_unstable();
    used.dedup();
    let number = |end: i32| used.partition_point(|&e| e < end) as i32;
    Some(Crossings {
        points: used.iter().map(|&end| points[end as usize]).collect(),
        segments: real.iter().map(|segment| segment.ends.map(number)).collect(),
        groups: real.iter().map(|segment| segment.groups.map(|g| g as i32)).collect(),
        triangles: real.iter().map(|segment| segment.triangles.map(|t| t as i32)).collect(),
        shallow: real.iter().map(|segment| segment.shallow).collect(),
        through,
        tests: met.clashes.tests,
    })
}

fn widest(low: &Vec3, high: &Vec3) -> f64 {
    (0..3).map(|k| high[k] - low[k]).fold(f64::NEG_INFINITY, f64::max)
}
