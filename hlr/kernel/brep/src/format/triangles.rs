//! Reads the sections of polygons and triangulations, which a file may have in place of curves and surfaces.

use super::bytes::{Bytes, Read};
use super::layout::Layout;

/// A face's own triangles; uv is empty if the file has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulation {
    pub points: Vec<[f64; 3]>,
    pub uv: Vec<[f64; 2]>,
    pub triangles: Vec<[u32; 3]>,
}

pub fn polygons(bytes: &mut Bytes) -> Read<Vec<Vec<[f64; 3]>>> {
    let count = bytes.header("Polygon3D", 13)?;
    let one = |_| {
        let size = bytes.count(24)?;
        let parameters = bytes.flag()?;
        bytes.skip(8)?;
        let points = (0..size).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        bytes.skip(if parameters { 8 * size } else { 0 })?;
        Ok(points)
    };
    (0..count).map(one).collect()
}

/// Skips polygons on triangulations, and returns their number.
pub fn skip_polygons_on_triangulations(bytes: &mut Bytes) -> Read<usize> {
    let count = bytes.header("PolygonOnTriangulations", 13)?;
    for _ in 0..count {
        let size = bytes.count(4)?;
        bytes.skip(4 * size + 8)?;
        if bytes.flag()? {
            bytes.skip(8 * size)?;
        }
    }
    Ok(count)
}

pub fn triangulations(bytes: &mut Bytes, layout: Layout) -> Read<Vec<Triangulation>> {
    let count = bytes.header("Triangulations", 17)?;
    let one = |_| {
        let (nodes, triangles) = (bytes.count(24)?, bytes.count(12)?);
        let has_uv = bytes.flag()?;
        let has_normals = layout.normals && bytes.flag()?;
        bytes.skip(8)?;
        let points = (0..nodes).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        let uv = (0..if has_uv { nodes } else { 0 }).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        let corner = |bytes: &mut Bytes| Ok(bytes.index(nodes)? as u32);
        let triangles =
            (0..triangles).map(|_| Ok([corner(bytes)?, corner(bytes)?, corner(bytes)?])).collect::<Read<Vec<_>>>()?;
        bytes.skip(if has_normals { 12 * nodes } else { 0 })?;
        Ok(Triangulation { points, uv, triangles })
    };
    (0..count).map(one).collect()
}
